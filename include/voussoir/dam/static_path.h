// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_static_path_h
#define voussoir_static_path_h

#include <voussoir/dam/dam.h>

namespace Voussoir
{
  /** A part of the static history: loads that are raised from those before to its own, with the joints
   * grouted up to a height. */
  struct StaticPart
  {
    std::string name;         ///< "fill 100"
    double      level = 0.;   ///< of the reservoir [m]
    double      grouted = 0.; ///< z up to which the joints carry forces [m]
    Unknowns    raised;       ///< the loads that are raised, at its end [N]
  };

  /** The way to the static state: Statics/Stages, then the scene's level and temperature; each part in
   *  "Statics/Water increments" steps. */
  class StaticPath
  {
  public:
    /** Throws InputError for levels above the dam, days that the table of temperatures does not have, and
     * stages without effect. */
    explicit StaticPath(const Dam &dam);

    unsigned int      n_steps() const { return increments * parts.size(); }
    std::size_t       n_parts() const { return parts.size(); }
    unsigned int      number(const unsigned int step) const { return step / increments + 1; } ///< of its part
    const StaticPart &part(const unsigned int step) const { return parts[step / increments]; }
    double            share(const unsigned int step) const; ///< of its part that is reached, up to 1
    bool              ends_part(const unsigned int step) const { return step % increments + 1 == increments; }
    Unknowns          load(unsigned int step) const; ///< of all static loads at its end [N]

    /** Pressure of the reservoir at the height @p z at the end of a step [Pa]. */
    double water_pressure(unsigned int step, double z) const;

  private:
    void add_stages();
    void add_part(const std::string &name, const Scene &at, double grouted);
    void check_level(double level) const;

    const Dam              &dam;
    const unsigned int      increments;
    std::vector<StaticPart> parts;
  };

  /** The laws of the pairs up to the height @p grouted; those above carry nothing, by the law @p free. Feet
   * of joints that are tied to the ground stay so. */
  PairLaws laws_up_to(double grouted, const Dam &dam, const JointLaw &free);
} // namespace Voussoir

#endif
