// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_rock_wedge_h
#define voussoir_rock_wedge_h

#include <voussoir/dam/base_part.h>
#include <voussoir/dam/wedge_equilibrium.h>

namespace Voussoir
{
  struct Scene;

  /** Rock wedge under or behind an abutment. */
  struct RockWedge
  {
    std::string             name;
    std::vector<WedgePlane> planes;       ///< with contact, one to three
    std::vector<WedgePlane> sides = {};   ///< all planes; those with area 0 only bound the part of the base
    double                  volume = 0.;  ///< [m^3]
    double                  density = 0.; ///< of the rock [kg/m^3]

    double mass() const { return volume * density; } ///< returns the mass [kg]

    /** Returns true if @p place [m] is on the side of the wedge of all planes. */
    bool contains(const Vector3 &place) const;
  };

  /** Returns the unit normal into a wedge [-].
   * @param dip angle between the plane and the horizontal [degrees]. From 0 to 90 the wedge is above the plane;
   * from 90 to 180 it is below an overhanging plane
   * @param direction direction of the horizontal part of the normal, which is the direction of the steepest
   * descent of a plane under the wedge, from downstream (x) to the left bank (y) [degrees] */
  Vector3 normal_of(double dip, double direction);

  /** Returns the wedges of the file "Limits/Wedges" (doc/base_joints.md); empty if the entry is empty. Throws
   * InputError with file and line if the file cannot be read, if a value is wrong, or if the planes of a wedge
   * are parallel to each other or to one line. */
  std::vector<RockWedge> rock_wedges(const Scene &scene);

  /** Wedge with the part of the base on it. */
  struct LoadedWedge
  {
    RockWedge wedge;
    BasePart  part; ///< faces of the base with their centre in the wedge
  };

  /** Returns the wedges of the file "Limits/Wedges" with their parts of the base. Throws InputError as
   * rock_wedges(), and if no face of the base is on a wedge. */
  std::vector<LoadedWedge> loaded_wedges(const Scene &scene, const SolidModel &model);

  /** Returns a mode of a wedge in words, such as "slides on bottom". @p mode: WedgeState::mode(). */
  std::string in_words(const RockWedge &wedge, unsigned int mode);
} // namespace Voussoir

#endif
