// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_wedge_equilibrium_h
#define voussoir_wedge_equilibrium_h

#include <voussoir/base/tensor3.h>

#include <string>
#include <vector>

namespace Voussoir
{
  /** Plane between a rock wedge and the rock mass. */
  struct WedgePlane
  {
    std::string name;
    Vector3     point{};       ///< any point on the plane [m]
    Vector3     normal{};      ///< unit normal into the wedge [-]
    double      area = 0.;     ///< contact area [m^2]
    double      friction = 0.; ///< tan(phi) [-]
    double      cohesion = 0.; ///< [Pa]
    double      uplift = 0.;   ///< mean water pressure on the plane [Pa]
  };

  /** State of a wedge in limit equilibrium. */
  struct WedgeState
  {
    std::vector<bool>   contact;        ///< of each plane
    std::vector<double> normal_force;   ///< effective compression of each plane; 0 without contact [N]
    Vector3             driving{};      ///< driving force: total force less the normal forces [N]
    double              resistance = 0; ///< sum of tan(phi) N + c A over the planes in contact [N]
    /** resistance / |driving| [-]. 0: the wedge lifts off all planes. Infinite: three planes are in contact, or
     * there is no driving force. */
    double safety = 0.;

    /** Returns the numbers of the planes in contact as digits: 0 none, 2 the second plane, 12 the line of
     * intersection of the first two planes, 123 all three. */
    unsigned int mode() const;
  };

  /** Returns the state of a rigid wedge by Londe's limit equilibrium of forces, without moments.
   *
   * The total force is R = F + sum U_i n_i with the uplift U_i = p_i A_i on all planes. The planes in contact
   * transmit the compressions N_i, and the driving force is S = R + sum N_i n_i. A mode (set of planes in
   * contact) is admissible if
   *
   *     S . n_i = 0 and N_i >= 0 for each plane in contact,   S . n_j >= 0 for each other plane:
   *
   * the wedge moves along S, which keeps the contacts and opens the other planes. Shear acts against S, so it
   * does not change the compressions. The conditions are those of the projection of R on the cone of the
   * directions that the planes allow. The projection is unique for every R, and so is the mode of independent
   * normals. With round-off, the most admissible mode is used; of equal modes the one with more contacts.
   *
   * Sources: P. Londe, G. Vigier and R. Vormeringer, "Stability of rock slopes, a three-dimensional study",
   * J. Soil Mech. Found. Div. ASCE 95 (1969), SM1; R. E. Goodman and G.-H. Shi, "Block theory and its
   * application to rock engineering", Prentice-Hall 1985, chapter 9.
   *
   * @param planes one to three planes with linearly independent normals
   * @param force sum F of the forces on the wedge without uplift [N] */
  WedgeState wedge_equilibrium(const std::vector<WedgePlane> &planes, const Vector3 &force);

  /** Returns the sine of the smallest angle between two of the planes, or, for three planes, the smaller of this
   * sine and the determinant of the normals. It is 0 for linearly dependent normals and 1 for one plane [-]. */
  double independence(const std::vector<WedgePlane> &planes);
} // namespace Voussoir

#endif
