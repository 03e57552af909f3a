// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/output/block_recorder.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace Voussoir
{
  BlockRecorder::BlockRecorder(Dam &dam, const std::vector<double> &joint_water)
      : friction(dam.scene.limits.base_friction), cohesion(dam.scene.limits.base_cohesion),
        forces(dam, joint_water)
  {
    constexpr double endless = std::numeric_limits<double>::infinity();
    history.columns = {"time"};
    for (const BlockBase &base : forces.bases())
    {
      for (const char *quantity : {"N", "V_stream", "V_arch", "M_stream", "M_arch", "torsion"})
        history.columns.push_back(quantity + ("_" + std::to_string(base.monolith)));
      if (has_safety())
        history.columns.push_back("safety_" + std::to_string(base.monolith));
      const Vector3 &c = base.centroid;
      extremes.push_back({{-endless, 0., c}, {endless, 0., c}, {-endless, 0., c}, {endless, 0., c}});
    }
  }

  void BlockRecorder::follow(const StepOfDam &step, const std::vector<double> &water)
  {
    now = forces.of(step);
    more = forces.uplift_by(water);
  }

  void BlockRecorder::record(const double time)
  {
    const auto lower = [time](Extreme &extreme, const double value)
    {
      if (value < extreme.value)
        extreme.value = value, extreme.time = time;
    };
    std::vector<double> row = {time};
    for (std::size_t b = 0; b < now.size(); ++b)
    {
      const BlockBase     &base = forces.bases()[b];
      const BaseResultants force = resultants(base, now[b]);
      row.insert(row.end(), {force.normal, force.shear[0], force.shear[1], force.moment[0], force.moment[1],
                             force.moment[2]});
      Extremes &most = extremes[b];
      most.compression.raise(-force.normal, time, base.centroid);
      lower(most.least_compression, -force.normal);
      most.shear.raise(std::hypot(force.shear[0], force.shear[1]), time, base.centroid);
      if (!has_safety())
        continue;
      row.push_back(safety_of(b));
      lower(most.safety, row.back());
    }
    history.rows.push_back(row);
  }

  Extreme BlockRecorder::least_safety() const
  {
    Extreme least{std::numeric_limits<double>::infinity()};
    for (const Extremes &most : extremes)
      if (most.safety.value < least.value)
        least = most.safety;
    return least;
  }

  double BlockRecorder::safety_of(const std::size_t b) const
  {
    BlockBase base = forces.bases()[b];
    base.uplift += more[b];
    return sliding_safety(base, resultants(base, now[b]), friction, cohesion);
  }

  std::pair<double, int> BlockRecorder::last_safety() const
  {
    std::pair<double, int> least{std::numeric_limits<double>::infinity(), 0};
    for (std::size_t b = 0; b < now.size(); ++b)
      least = std::min(least, {safety_of(b), forces.bases()[b].monolith});
    return least;
  }

  Json BlockRecorder::json() const
  {
    const auto of = [](const Extreme &extreme)
    {
      Json json;
      return json.add("value", extreme.value).add("time", extreme.time);
    };
    Json blocks;
    for (std::size_t b = 0; b < extremes.size(); ++b)
    {
      const BlockBase &base = forces.bases()[b];
      Json             json;
      json.add("area", base.area)
          .add_list("centroid", base.centroid)
          .add_list("stream", base.axes[0])
          .add_list("arch", base.axes[1])
          .add_list("normal", base.axes[2])
          .add("uplift", base.uplift)
          .add("max_compression", of(extremes[b].compression))
          .add("min_compression", of(extremes[b].least_compression))
          .add("max_shear", of(extremes[b].shear));
      if (has_safety())
        json.add("min_sliding_safety", of(extremes[b].safety)).add("end_sliding_safety", safety_of(b));
      blocks.add("monolith " + std::to_string(base.monolith), json);
    }
    return blocks;
  }
} // namespace Voussoir
