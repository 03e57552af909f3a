// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_assessment_h
#define voussoir_assessment_h

#include <voussoir/base/log.h>
#include <voussoir/dam/limits.h>
#include <voussoir/output/block_observer.h>
#include <voussoir/output/face_tension.h>
#include <voussoir/output/recorders.h>

#include <optional>
#include <utility>

namespace Voussoir
{
  /** Comparison of a result with its limit. */
  struct Verdict
  {
    std::string           name;             ///< name of the limit in summary.json
    std::string           unit;             ///< unit of value and limit
    double                value, limit;     ///< in @p unit
    bool                  is_least = false; ///< true: the limit is a lower bound; false: an upper bound
    std::optional<double> with_base{};      ///< of stresses: value including the nodes near the base

    /** Returns true if the limit is not exceeded. */
    bool satisfied() const { return is_least ? value >= limit : value <= limit; }
  };

  /** Stress results of a run. */
  struct StressesOfRun
  {
    const EnvelopeRecorder &envelope; ///< principal stresses over time
    const FaceTension      &tension;  ///< evaluation of the envelope
    unsigned int            interval; ///< number of steps between two records of the envelope
  };

  /** Assessment of a run: demand-capacity ratios with duration and share of overstress, openings and slips at
   * the waterstops, residual openings and slips, shear of the keys, and the comparison with the limits.
   * Stresses are compared away from the base (FaceTension), because elastic stresses at the base grow with
   * refinement. They are compared only if every step was recorded. */
  class Assessment
  {
  public:
    /** Compares all results with the limits.
     * @param limits limits of the input file, section "Limits"
     * @param model mesh of the dam
     * @param stresses stress results; nullptr: not recorded
     * @param joints joint results; nullptr: tied dam
     * @param blocks forces at the base; nullptr: not recorded
     * @param wedge_safety smallest sliding safety of the rock wedges [-]; empty: no wedges */
    Assessment(const LimitParameters &limits, const SolidModel &model, const StressesOfRun *stresses,
               const JointRecorder *joints, const BlockObserver *blocks, std::optional<double> wedge_safety);

    /** Adds the members "overstress", "waterstop", "residual", "keys", "limits" (value, limit and satisfied, by
     * name of the limit) and "limits_not_evaluated" (reason, by name of the limit) to @p summary. */
    void add_to(Json &summary) const;

    /** Returns a text for the log: the exceeded limits with their values, and the limits that are not
     * evaluated. Empty: the input file has no limits. */
    std::string in_words() const;

    /** Returns the evaluated limits. */
    const std::vector<Verdict> &all() const { return verdicts; }

    /** Returns the limits that are not evaluated, and the reasons. */
    const std::vector<std::pair<std::string, std::string>> &not_evaluated() const { return unevaluated; }

    /** Returns the longest duration for which the stress at a node of a face away from the base exceeds the static
     * tensile strength [s]. Empty: there is no strength. */
    std::optional<double> overstress_seconds() const { return longest; }

  private:
    void hold(const std::string &name, const std::string &unit, double value, double limit,
              std::optional<double> with_base = {});
    void leave(const std::string &name, double limit, const std::string &reason); ///< limit is not evaluated
    void leave_stresses(const std::string &reason);
    void leave_demand(const std::string &reason);
    void add_stresses(const SolidModel &model, const StressesOfRun &stresses);
    void add_demand(const SolidModel &model, const StressesOfRun &stresses);
    void hold_by_level(const std::string &name, const std::string &unit, const Overstress::Levels &worst,
                       const Overstress::Levels &with_base, double limit);
    void add_joints(const JointRecorder &joints);
    void add_blocks(const BlockObserver *blocks);
    void add_keys(const KeyForces &of_joints);

    const LimitParameters                            limits;
    std::vector<Verdict>                             verdicts;
    std::vector<std::pair<std::string, std::string>> unevaluated; ///< limits and reasons
    std::optional<double>                            longest;     ///< see overstress_seconds()
    std::optional<Json>                              overstress, waterstop, residual, keys;
  };

  /** Returns the members value, position and time of an extreme. */
  Json json_of(const Extreme &extreme);
} // namespace Voussoir

#endif
