// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_limits_h
#define voussoir_limits_h

namespace Voussoir
{
  class Entries;

  /** Section "Limits" of a scene: what the results are held against. Zero: no limit. */
  struct LimitParameters
  {
    double tensile_strength = 0.;  ///< f_t [Pa], of demand-capacity ratios and what follows from them
    double demand_capacity = 0.;   ///< largest principal stress over f_t [-]
    double overstress_seconds = 0; ///< allowed above f_t, falling in proportion to none above 2 f_t [s]
    double overstress_share = 0.;  ///< of either face above f_t [-]
    double tension = 0.;           ///< on the faces [Pa]
    double compression = 0.;       ///< anywhere, its magnitude [Pa]
    double opening = 0.;           ///< of a joint, anywhere [m]
    double slip = 0.;              ///< [m]
    double waterstop_depth = 1.;   ///< from the upstream face [m]
    double waterstop_opening = 0.; ///< [m]
    double waterstop_slip = 0.;    ///< [m]
    double base_friction = 0.;     ///< tan(phi) of the monoliths on their bases [-]
    double base_cohesion = 0.;     ///< of their bases [Pa]
    double sliding_safety = 0.;    ///< the least that is asked for [-]
    double key_shear_stress = 0.;  ///< of the keys of a joint, over its area [Pa]

    void add_parameters(Entries &prm);

  private:
    void add_stresses(Entries &prm);
    void add_joints_and_base(Entries &prm);
  };
} // namespace Voussoir

#endif
