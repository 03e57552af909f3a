// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_assessment_h
#define voussoir_assessment_h

#include <voussoir/base/log.h>
#include <voussoir/dam/limits.h>
#include <voussoir/output/block_recorder.h>
#include <voussoir/output/face_tension.h>
#include <voussoir/output/recorders.h>

#include <optional>
#include <utility>

namespace Voussoir
{
  /** Comparison of a result with its limit. */
  struct Verdict
  {
    std::string           name, unit;
    double                value, limit;     ///< in @p unit
    bool                  is_least = false; ///< true: the limit is a lower bound
    std::optional<double> with_base{};      ///< stresses: value including nodes near the base
    bool                  satisfied() const { return is_least ? value >= limit : value <= limit; }
  };

  /** Stress results of a run. */
  struct StressesOfRun
  {
    const EnvelopeRecorder &envelope;
    const FaceTension      &tension;
    unsigned int            interval; ///< number of steps between two records
  };

  /** Assessment of a run: demand-capacity ratios with duration and share of overstress, openings and slips at
   * the waterstops, residual openings and slips, shear of the keys, and the comparison with the limits.
   * Stresses are compared away from the base (FaceTension), because elastic stresses at the base grow with
   * refinement. They are compared only if every step was recorded. */
  class Assessment
  {
  public:
    /** Compares all results with the limits. @p stresses, @p blocks: nullptr if not recorded. @p joints:
     * nullptr for a tied dam. */
    Assessment(const LimitParameters &limits, const SolidModel &model, const StressesOfRun *stresses,
               const JointRecorder *joints, const BlockRecorder *blocks);

    /** Adds "overstress", "waterstop", "residual", "keys", "limits" (value, limit and satisfied by name) and
     * "limits_not_evaluated" (reasons by name) to @p summary. */
    void add_to(Json &summary) const;

    /** Returns the limits that are exceeded, with their values, or not evaluated. Empty: no limits. */
    std::string in_words() const;

  private:
    void hold(const std::string &name, const std::string &unit, double value, double limit,
              std::optional<double> with_base = {});
    void leave(const std::string &name, double limit, const std::string &reason); ///< limit is not evaluated
    void leave_stresses(const std::string &reason);
    void leave_demand(const std::string &reason);
    void add_stresses(const SolidModel &model, const StressesOfRun &stresses);
    void add_demand(const SolidModel &model, const StressesOfRun &stresses);
    void add_duration(const Overstress::Levels &worst, const Overstress::Levels &with_base);
    void add_joints(const JointRecorder &joints);
    void add_blocks(const BlockRecorder *blocks);
    void add_keys(const KeyForces &of_joints);

    const LimitParameters                            limits;
    std::vector<Verdict>                             verdicts;
    std::vector<std::pair<std::string, std::string>> unevaluated; ///< limits and reasons
    std::optional<Json>                              overstress, waterstop, residual, keys;
  };

  /** Returns value, position and time of an extreme. */
  Json json_of(const Extreme &extreme);
} // namespace Voussoir

#endif
