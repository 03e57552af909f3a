// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_law_parameters_h
#define voussoir_law_parameters_h

#include <string>

namespace Voussoir
{
  class Entries;

  /** The equations that stand for a law. */
  enum class Equations
  {
    alart_curnier,     ///< the paper's, with the angle of the trial force: a projection, Lipschitz everywhere
    paper,             ///< the paper's own (2b), (3b), (4b): the angle of the force, undefined where it is 0
    fischer_burmeister ///< on second-order cones; smooth merit
  };

  Equations   equations_from_name(const std::string &name); ///< throws InputError for an unknown name
  std::string equations_names(); ///< as a ParameterHandler selection: "alart-curnier|paper|..."

  /** Shear keys: trapezoidal, on a flat face that opens and slides (law KSM). Subsection "Joints/Keys". */
  struct KeyParameters
  {
    double      height = .2;          ///< of the keys [m]: an opening beyond it frees them
    double      clearance = 0.;       ///< of each flank, normal to it [m]
    double      flank_angle = 0.;     ///< of the flanks to the joint's normal [degrees]; 0: rectangular
    std::string direction = "both";   ///< of slip that is restrained: radial, vertical, both
    double      friction = -1.;       ///< of the flanks [-]; -1: that of the face
    double      seat_compliance = 0.; ///< of the flanks, per area of the joint [m/Pa]; 0: rigid

    void add_parameters(Entries &prm);
  };

  /** What makes a joint law of its name. Section "Joints" of a scene. A new law adds its parameters here, and
   * their entries in law_table.cc. */
  struct LawParameters
  {
    LawParameters(const double friction = .8, const Equations equations = Equations::alart_curnier,
                  const KeyParameters &keys = KeyParameters())
        : friction(friction), equations(equations), keys(keys)
    {
    }

    double        friction; ///< of the flat face [-]
    Equations     equations;
    KeyParameters keys;
    double        strength = 0., fracture_energy = 0.; ///< of the bond of law cohesive [Pa], [N/m]

    void add_parameters(Entries &prm); ///< but Equations and Keys
  };
} // namespace Voussoir

#endif
