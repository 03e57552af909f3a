// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_section_motion_h
#define voussoir_section_motion_h

#include <voussoir/base/ranks.h>
#include <voussoir/base/tensor3.h>

#include <vector>

namespace Voussoir
{
  /** Motion of a section through the valley, of the waves with one slowness along the valley. */
  class SectionMotion
  {
  public:
    virtual ~SectionMotion() = default;

    /** Advances the motion by one time step in two parts; see IncidentField::begin_step(). */
    virtual void begin_step(std::vector<Ranks::Message> &messages) = 0;
    virtual void end_step() = 0;

    /** Returns the displacement of a node of the section at the current time, at the coordinate @p x along
     * the valley [m]. */
    virtual Vector3 displacement(unsigned int node, double x) const = 0;

    /** Returns all state variables, for checkpoints. */
    virtual std::vector<std::vector<double> *> state() = 0;

    /** Gathers the motion in the arrays of state() on the first process. All processes must call it. */
    virtual void gather_on_root() {}
  };
} // namespace Voussoir

#endif
