// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_law_parameters_h
#define voussoir_law_parameters_h

#include <string>

namespace Voussoir
{
  class Entries;

  /** Formulation of the equations of a joint law. */
  enum class Equations
  {
    alart_curnier, ///< with the angle of the trial force: a projection, Lipschitz continuous
    paper          ///< (2b), (3b), (4b) of the paper, with the angle of the force, undefined for zero force
  };

  Equations   equations_from_name(const std::string &name); ///< throws InputError for an unknown name
  std::string equations_names(); ///< ParameterHandler selection "alart-curnier|paper|..."

  /** Trapezoidal shear keys on a flat face that opens and slips (law KSM). Subsection "Joints/Keys". */
  struct KeyParameters
  {
    double      height = .2;          ///< height of the keys [m]; a larger opening disengages them
    double      clearance = 0.;       ///< clearance of each flank, normal to the flank [m]
    double      flank_angle = 0.;     ///< angle between flank and joint normal [degrees]; 0: rectangular
    std::string direction = "both";   ///< slip that the keys restrain: radial, vertical, both
    double      friction = -1.;       ///< coefficient of friction of the flanks [-]; -1: as the face
    double      seat_compliance = 0.; ///< contact compliance of the flanks per joint area [m/Pa]; 0: rigid

    /** Declares the entries of the subsection. */
    void add_parameters(Entries &prm);
  };

  /** Parameters of all joint laws. Section "Joints" of the input file. A new law adds its parameters here,
   * and their entries in law_table.cc. */
  struct LawParameters
  {
    LawParameters(const double friction = .8, const Equations equations = Equations::alart_curnier,
                  const KeyParameters &keys = KeyParameters())
        : friction(friction), equations(equations), keys(keys)
    {
    }

    double        friction; ///< coefficient of friction of the face [-]
    Equations     equations;
    KeyParameters keys;
    double        strength = 0., fracture_energy = 0.; ///< of law cohesive [Pa], [N/m]

    double normal_stiffness = 0., tangential_stiffness = 0.; ///< of the joint itself, 0: rigid [Pa/m]
    double adhesion = 0.; ///< shear strength without pressure, while bonded [Pa]

    /** Declares the entries of the section, without "Equations" and the subsection "Keys". */
    void add_parameters(Entries &prm);
  };
} // namespace Voussoir

#endif
