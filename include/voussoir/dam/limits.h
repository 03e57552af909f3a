// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_limits_h
#define voussoir_limits_h

#include <string>

namespace Voussoir
{
  class Entries;

  /** Parameters of the subsection "Limits": limit values of the results. Zero: no limit. */
  struct LimitParameters
  {
    double tensile_strength = 0.;        ///< dynamic tensile strength [Pa]; 0: none
    double static_tensile_strength = 0.; ///< f_t; 0: see static_strength() [Pa]

    /** Returns the static tensile strength f_t, the reference of demand-capacity ratios and overstress [Pa]. If it is not
     * given, it is two thirds of the dynamic one (J. M. Raphael, "Tensile strength of concrete", ACI Journal, 1984). */
    double static_strength() const
    {
      return static_tensile_strength > 0. ? static_tensile_strength : tensile_strength / 1.5;
    }
    double demand_capacity = 0.;   ///< largest principal stress divided by f_t [-]
    double overstress_seconds = 0; ///< allowed duration above f_t, decreasing linearly to zero at 2 f_t [s]
    double overstress_share = 0.;  ///< share of either face above f_t [-]
    double tension = 0.;           ///< largest principal stress on the faces [Pa]
    double compression = 0.;       ///< magnitude of the smallest principal stress [Pa]
    double opening = 0.;           ///< largest opening of the joints [m]
    double slip = 0.;              ///< largest slip of the joints [m]
    double waterstop_depth = 1.;   ///< distance of the waterstops from the upstream face [m]
    double waterstop_opening = 0.; ///< largest opening at the waterstops [m]
    double waterstop_slip = 0.;    ///< largest slip at the waterstops [m]
    double base_friction = 0.;     ///< tan(phi) between monoliths and foundation [-]
    double base_cohesion = 0.;     ///< between monoliths and foundation [Pa]
    double sliding_safety = 0.;    ///< smallest allowed safety against sliding [-]
    double key_shear_stress = 0.;  ///< shear force of the keys of a joint, divided by its area [Pa]

    std::string wedges;            ///< file of the rock wedges, relative to the input file; empty: none
    double      wedge_safety = 0.; ///< smallest allowed sliding safety of the wedges [-]

    /** Declares the entries of the subsection. */
    void add_parameters(Entries &prm);

  private:
    void add_stresses(Entries &prm);
    void add_joints_and_base(Entries &prm);
    void add_wedges(Entries &prm);
  };
} // namespace Voussoir

#endif
