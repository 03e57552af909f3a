// SPDX-License-Identifier: GPL-3.0-or-later
// Static loads in the log and in summary.json.

#include <voussoir/app/run_report.h>
#include <voussoir/dam/base_uplift.h>
#include <voussoir/dam/temperature.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace Voussoir
{
  namespace
  {
    /** Returns the temperatures of a face over the height as text, such as "4" or "-2 to 6". */
    std::string range_of(const FaceTemperatures &temperatures, const unsigned int face)
    {
      double low = temperatures.faces[0][face], high = low;
      for (const auto &both : temperatures.faces)
      {
        low = std::min(low, both[face]);
        high = std::max(high, both[face]);
      }
      std::ostringstream text;
      text << low;
      if (high > low)
        text << " to " << high;
      return text.str();
    }

    /** Returns true for forces in joints, whose sum is zero but for round-off. */
    bool acts_between_blocks(const StaticLoad &load)
    {
      double sum = 0.;
      for (const double f : load.force)
        sum += std::abs(f);
      return sum > 0. && norm(load.resultant()) < 1e-9 * sum;
    }
  } // namespace

  void report_loads(const Dam &dam, Log &log)
  {
    const Scene &scene = dam.scene;
    if (!scene.loads.combination.empty())
      log.line("Loads     combination %s: %s", scene.loads.combination.c_str(),
               scene.loads.combinations.at(scene.loads.combination).c_str());
    for (const StaticLoad &load : dam.loads)
    {
      const Vector3 f = load.resultant();
      const bool    usual = load.name == "water" || load.name == "weight";
      if (load.name == "temperature")
      {
        const auto t = face_temperatures(scene.loads.temperature, scene.directory);
        log.line("Loads     temperature x %g: %s degC upstream, %s downstream, %g when grouted", load.factor,
                 range_of(t, 0).c_str(), range_of(t, 1).c_str(), scene.loads.temperature.grouting);
      }
      else if (acts_between_blocks(load))
        continue;
      else if (!usual && norm(f) == 0. && load.name != "force history")
        log.line("warning: the load %s is zero: it does not reach the dam. Check its entries in Loads.",
                 load.name.c_str());
      else if (!usual || load.factor != 1.)
        log.line("Loads     %s x %g: %.4g %.4g %.4g MN (downstream, left bank, up)%s", load.name.c_str(),
                 load.factor, 1e-6 * f[0], 1e-6 * f[1], 1e-6 * f[2],
                 dam.base_is_held() && norm(load.on_fixed) == 0. ? ", without the forces on the fixed base"
                                                                 : "");
    }
    if (scene.loads.uplift.base && scene.loads.factor("uplift") != 0.)
    {
      Vector3 sum{};
      for (const auto &monolith : base_uplift(scene, *dam.model).of_monolith)
        for (unsigned int c = 0; c < 3; ++c)
          sum[c] += 1e-6 * monolith.second[c];
      log.line("Loads     uplift at the base: %.4g %.4g %.4g MN (downstream, left bank, up), a part of the "
               "compression there",
               sum[0], sum[1], sum[2]);
    }
  }

  Json json_of_loads(const Dam &dam)
  {
    const Scene &scene = dam.scene;
    Json         json;
    for (const StaticLoad &load : dam.loads)
    {
      Json one;
      one.add("factor", load.factor)
          .add_list("resultant", load.resultant())
          .add_list("resultant_on_free_nodes", load.resultant() - load.on_fixed);
      json.add(load.name, one);
    }
    if (scene.loads.uplift.base && scene.loads.factor("uplift") != 0.)
    {
      Json uplift;
      for (const auto &monolith : base_uplift(scene, *dam.model).of_monolith)
        uplift.add_list("monolith " + std::to_string(monolith.first), monolith.second);
      json.add("base uplift", uplift);
    }
    return json;
  }
} // namespace Voussoir
