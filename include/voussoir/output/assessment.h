// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_assessment_h
#define voussoir_assessment_h

#include <voussoir/base/log.h>
#include <voussoir/dam/limits.h>
#include <voussoir/output/block_recorder.h>
#include <voussoir/output/recorders.h>

#include <optional>
#include <utility>

namespace Voussoir
{
  /** A result against its limit. */
  struct Verdict
  {
    std::string name, unit;
    double      value, limit;
    bool        is_least = false; ///< the limit is a lower one
    bool        kept() const { return is_least ? value >= limit : value <= limit; }
  };

  /** The numbers that reports are written with: demand and capacity with the duration of overstress and its
   * share of the faces, openings and slips at the waterstops, what remains of them, the shear of keys; and
   * all against the limits. */
  class Assessment
  {
  public:
    /** @p envelope: of the stresses; null: not recorded. @p joints: null: a tied dam. @p blocks: null: not
     * recorded. */
    Assessment(const LimitParameters &limits, const SolidModel &model, const EnvelopeRecorder *envelope,
               const JointRecorder *joints, const BlockRecorder *blocks);

    /** "overstress", "waterstop", "residual", "keys", "limits": name -> value, limit, kept, and
     * "limits_not_judged": name -> why there is no result to hold against it. */
    void add_to(Json &summary) const;

    std::string
    in_words() const; ///< which limits are exceeded, by how much, or not judged; empty: there are none

  private:
    void hold(const std::string &name, const std::string &unit, double value, double limit);
    void leave(const std::string &name, double limit, const std::string &reason); ///< not judged
    void add_stresses(const SolidModel &model, const EnvelopeRecorder &envelope);
    void add_demand(const SolidModel &model, const EnvelopeRecorder &envelope);
    void add_duration(const Overstress::Levels &worst);
    void add_joints(const JointRecorder &joints);
    void add_blocks(const BlockRecorder *blocks);
    void add_keys(const KeyForces &of_joints);

    const LimitParameters                            limits;
    std::vector<Verdict>                             verdicts;
    std::vector<std::pair<std::string, std::string>> unjudged; ///< names of limits, and why
    std::optional<Json>                              overstress, waterstop, residual, keys;
  };

  Json json_of(const Extreme &extreme); ///< value, place, time
} // namespace Voussoir

#endif
