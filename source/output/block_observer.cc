// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/output/archive.h>
#include <voussoir/output/block_observer.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace Voussoir
{
  BlockObserver::BlockObserver(const RunState &run)
      : run(run), friction(run.scene().limits.base_friction), cohesion(run.scene().limits.base_cohesion),
        forces(*run.dam, run.statics.joint_water)
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
    follow();
  }

  void BlockObserver::follow()
  {
    run.with_last_step([&](const StepOfDam &step) { now = forces.of(step); });
    more = forces.uplift_by(run.crack_water ? run.crack_water->acting() : std::vector<double>());
  }

  void BlockObserver::record()
  {
    const double time = run.integrator->state().time;
    const auto   lower = [time](Extreme &extreme, const double value)
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

  Extreme BlockObserver::least_safety() const
  {
    Extreme least{std::numeric_limits<double>::infinity()};
    for (const Extremes &most : extremes)
      if (most.safety.value < least.value)
        least = most.safety;
    return least;
  }

  double BlockObserver::safety_of(const std::size_t b) const
  {
    BlockBase base = forces.bases()[b];
    base.uplift += more[b];
    return sliding_safety(base, resultants(base, now[b]), friction, cohesion);
  }

  void BlockObserver::report(Log &log) const
  {
    std::pair<double, int> least{std::numeric_limits<double>::infinity(), 0};
    for (std::size_t b = 0; b < now.size(); ++b)
      least = std::min(least, {safety_of(b), forces.bases()[b].monolith});
    if (has_safety() && run.n_steps > 0)
      log.line("Residual  at the end: sliding safety %.3g (monolith %d)", least.first, least.second);
  }

  void BlockObserver::save(boost::archive::binary_oarchive &archive) const
  {
    archive << history << extremes;
  }

  void BlockObserver::load(boost::archive::binary_iarchive &archive)
  {
    archive >> history >> extremes;
  }

  Json BlockObserver::json() const
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
