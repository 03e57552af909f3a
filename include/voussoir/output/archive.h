// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_archive_h
#define voussoir_archive_h

#include <boost/archive/binary_iarchive.hpp>
#include <boost/archive/binary_oarchive.hpp>
#include <boost/serialization/array.hpp>
#include <boost/serialization/map.hpp>
#include <boost/serialization/string.hpp>
#include <boost/serialization/utility.hpp>
#include <boost/serialization/vector.hpp>

#include <voussoir/dynamics/integrator.h>

namespace Voussoir
{
  /** Writes energies to a boost archive, or reads energies from an archive. */
  template <class Archive> void serialize(Archive &archive, Energy &e, unsigned int)
  {
    archive &e.kinetic &e.added_mass &e.strain &e.damping &e.friction &e.impact &e.input;
    archive &e.joint_stored &e.joint_fracture;
  }

  /** Writes the state of the dam to a boost archive, or reads the state from an archive. */
  template <class Archive> void serialize(Archive &archive, DynamicState &s, unsigned int)
  {
    archive &s.time &s.u &s.v &s.force &s.load &s.Ku &s.base_velocity &s.energy &s.memory;
    archive &s.carried.residual &s.carried.moved &s.carried.resisted &s.carried.dt &s.carried.gap;
    archive &s.relaxation.u_static &s.relaxation.Ku_static &s.relaxation.d &s.relaxation.Kd &s.relaxation
        .mean &s.relaxation.lag &s.relaxation.Ku;
  }
} // namespace Voussoir

#endif
