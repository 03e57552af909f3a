// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_static_path_h
#define voussoir_static_path_h

#include <voussoir/dam/dam.h>

namespace Voussoir
{
  /** Stage of the static load history. The loads change linearly from those of the previous stage to those of
   * this stage. The joints are grouted up to a height. Above it, fluid grout presses on the faces, and in the joints
   * that are cut the material vanishes linearly. */
  struct StaticPart
  {
    std::string name;         ///< such as "fill 100 m"
    double      level = 0.;   ///< of the reservoir [m]
    double      grouted = 0.; ///< height up to which the joints carry forces [m]
    Unknowns    raised;       ///< loads with StaticLoad::is_raised at the end of the stage [N]

    double fluid_to = 0., pressure = 0.; ///< upper end of the fluid grout [m] and its pressure [Pa]
    std::vector<std::size_t> cut = {};   ///< joints that are cut
    double                   width = 0.; ///< of the cut [m]
  };

  /** Static load history: the stages of "Statics/Stages", then the final water level and temperature. Each
   * stage has "Statics/Water increments" steps. */
  class StaticPath
  {
  public:
    /** Creates the stages. Throws InputError for levels above the dam, days outside of the temperature table,
     * and stages without effect. */
    explicit StaticPath(const Dam &dam);

    /** Returns the number of steps. Steps are counted from 0. */
    unsigned int n_steps() const { return increments * parts.size(); }

    /** Returns the number of stages. */
    std::size_t n_parts() const { return parts.size(); }

    /** Returns the height up to which the joints are grouted before a step [m]. */
    double grouted_before(unsigned int step) const;

    /** Returns the number of the stage of a step, from 1. */
    unsigned int number(const unsigned int step) const { return step / increments + 1; }

    /** Returns the stage of a step. */
    const StaticPart &part(const unsigned int step) const { return parts[step / increments]; }

    /** Returns the share of the stage that is reached at the end of a step, up to 1 [-]. */
    double share(const unsigned int step) const;

    /** Returns true if a step is the last one of its stage. */
    bool ends_part(const unsigned int step) const { return step % increments + 1 == increments; }

    /** Returns the sum of all static loads at the end of a step, three values per node [N]. */
    Unknowns load(unsigned int step) const;

    /** Returns the pressure of the reservoir at the height @p z at the end of a step [Pa]. */
    double water_pressure(unsigned int step, double z) const;

    /** Returns the pressure of the fluid grout in a pair at the end of a step [Pa]. */
    double grout_pressure(unsigned int step, std::size_t pair) const;

    /** Returns the width that a step cuts from a joint of Dam::joints [m]. */
    double cut_width(unsigned int step, std::size_t joint) const;

  private:
    void        add_stages();
    StaticPart &add_part(const std::string &name, const Scene &at, double grouted);

    void add_grout(const StaticStage &stage, const Scene &at, double grouted);
    void add_cut(const StaticStage &stage, const Scene &at, double grouted);
    void check_level(double level) const;

    const Dam              &dam;
    const unsigned int      increments;
    std::vector<StaticPart> parts;
    double                  grouted_at_start = 0.; ///< [m]
  };

  /** Returns the joint laws of a partly grouted dam. Pairs above the height @p grouted [m] have the law in
   * @p ungrouted. Tied pairs and base joints keep their law. */
  PairLaws laws_up_to(double grouted, const Dam &dam, const PairLaws &ungrouted);
} // namespace Voussoir

#endif
