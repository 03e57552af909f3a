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

  /** Static load history: the stages of "Statics/Stages", then the final water level and temperature. If base or lift
   * joints with friction make the state depend on the path, a stage with the weight alone comes first. Stages are
   * counted from 0. The share of a stage is that of its loads, up to 1. */
  class StaticPath
  {
  public:
    /** Creates the stages. Throws InputError for levels outside of the dam, days outside of the temperature table,
     * and stages without effect. */
    explicit StaticPath(const Dam &dam);

    /** Returns the number of stages. */
    std::size_t n_parts() const { return parts.size(); }

    /** Returns a stage. */
    const StaticPart &part(const std::size_t stage) const { return parts[stage]; }

    /** Returns true if the state depends on the increments: with friction in base or lift joints. */
    bool depends_on_increments() const { return is_dependent; }

    /** Returns true if a stage has the weight alone. */
    bool is_weight_alone(const std::size_t stage) const { return is_dependent && stage == 0; }

    /** Returns the number of a stage in stages.csv: from 1, or 0 for the weight alone. */
    unsigned int number(const std::size_t stage) const { return stage + 1 - is_dependent; }

    /** Returns the (smallest) number of increments of a stage. */
    unsigned int increments(const std::size_t stage) const
    {
      return is_weight_alone(stage) ? 1 : dam.scene.statics.water_increments;
    }

    /** Returns the height up to which the joints are grouted before a stage [m]. */
    double grouted_before(std::size_t stage) const;

    /** Returns the sum of all static loads, three values per node [N]. */
    Unknowns load(std::size_t stage, double share) const;

    /** Returns the pressure of the reservoir at the height @p z [Pa]. */
    double water_pressure(std::size_t stage, double share, double z) const;

    /** Returns the pressure of the fluid grout in a pair [Pa]. */
    double grout_pressure(std::size_t stage, double share, std::size_t pair) const;

    /** Returns the width that a stage cuts from a joint of JointLayout::joints [m]. */
    double cut_width(std::size_t stage, std::size_t joint) const;

    /** Returns warnings about stages that are outside of the dam. */
    std::vector<std::string> warnings() const { return warned; }

  private:
    void        add_stages();
    void        check_stages(const std::vector<StaticStage> &stages, bool has_lifts) const;
    StaticPart &add_part(const std::string &name, const Scene &at, double grouted);
    StaticPart &add_empty_part(const std::string &name, double level, double grouted);

    void add_grout(const StaticStage &stage, const Scene &at, double grouted);
    void add_cut(const StaticStage &stage, const Scene &at, double grouted);
    void check_fill(double level) const;
    void check_grout(double height);

    const Dam               &dam;
    const bool               is_dependent;
    std::vector<StaticPart>  parts;
    std::vector<std::string> warned;
    double                   grouted_at_start = 0.; ///< [m]
  };

  /** Returns the joint laws of a partly grouted dam. Pairs above the height @p grouted [m] have the law in
   * @p ungrouted. Tied pairs and base joints keep their law. */
  PairLaws laws_up_to(double grouted, const Dam &dam, const PairLaws &ungrouted);
} // namespace Voussoir

#endif
