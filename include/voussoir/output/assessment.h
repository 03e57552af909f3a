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
  /** A result against its limit. */
  struct Verdict
  {
    std::string           name, unit;
    double                value, limit;
    bool                  is_least = false; ///< the limit is a lower one
    std::optional<double> with_base{}; ///< of stresses: the value of all nodes, those near the base included
    bool                  satisfied() const { return is_least ? value >= limit : value <= limit; }
  };

  /** The stresses of a run. */
  struct StressesOfRun
  {
    const EnvelopeRecorder &envelope;
    const FaceTension      &tension;
    unsigned int            interval; ///< steps from one record to the next
  };

  /** The numbers that reports are written with: demand and capacity with the duration of overstress and its
   * share of the faces, openings and slips at the waterstops, what remains of them, the shear of keys; and
   * all against the limits. Stresses are compared away from the base (FaceTension), where an elastic dam has
   * none that grow with refinement; and only if every step was recorded. */
  class Assessment
  {
  public:
    /** @p stresses: null: not recorded. @p joints: null: a tied dam. @p blocks: null: not recorded. */
    Assessment(const LimitParameters &limits, const SolidModel &model, const StressesOfRun *stresses,
               const JointRecorder *joints, const BlockRecorder *blocks);

    /** "overstress", "waterstop", "residual", "keys", "limits": name -> value, limit, satisfied, and
     * "limits_not_evaluated": name -> why there is no result to compare with it. */
    void add_to(Json &summary) const;

    /** Which limits are exceeded, by how much, or not evaluated; empty: there are none. */
    std::string in_words() const;

  private:
    void hold(const std::string &name, const std::string &unit, double value, double limit,
              std::optional<double> with_base = {});
    void leave(const std::string &name, double limit, const std::string &reason); ///< not evaluated
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
    std::vector<std::pair<std::string, std::string>> unevaluated; ///< names of limits, and why
    std::optional<Json>                              overstress, waterstop, residual, keys;
  };

  Json json_of(const Extreme &extreme); ///< value, place, time
} // namespace Voussoir

#endif
