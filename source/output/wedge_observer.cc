// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/output/archive.h>
#include <voussoir/output/wedge_observer.h>

#include <limits>

namespace Voussoir
{
  WedgeObserver::WedgeObserver(const RunState &run) : run(run)
  {
    history.columns = {"time"};
    for (LoadedWedge &loaded : loaded_wedges(run.scene(), *run.dam->model))
    {
      for (const char *column : {"force_x", "force_y", "force_z", "acceleration_x", "acceleration_y",
                                 "acceleration_z", "mode", "safety"})
        history.columns.push_back(column + ("_" + loaded.wedge.name));
      BaseForces forces(*run.dam, run.statics.joint_water, &loaded.part);
      wedges.push_back({std::move(loaded), std::move(forces), {}, {}, {}});
    }
    follow();
    for (OfWedge &one : wedges)
    {
      one.at_start = one.now;
      one.least.safety = std::numeric_limits<double>::infinity();
    }
  }

  /** Returns the acceleration of the wedge on a part of the base: the mean over the area [m/s^2]. */
  Vector3 WedgeObserver::acceleration_of(const BasePart &part) const
  {
    Vector3 sum{};
    for (const auto &[node, area] : part.area_of_node)
    {
      const Vector3 a = run.absolute_acceleration(node);
      for (unsigned int c = 0; c < 3; ++c)
        sum[c] += area / part.area * a[c];
    }
    return sum;
  }

  void WedgeObserver::follow()
  {
    run.with_last_step(
        [this](const StepOfDam &step)
        {
          for (OfWedge &one : wedges)
          {
            const RockWedge &rock = one.wedge.wedge;
            const Wrench     on_dam = one.forces.of(step).front();
            Result          &now = one.now;
            now.acceleration = acceleration_of(one.wedge.part);
            Vector3 total{};
            for (unsigned int c = 0; c < 3; ++c)
            {
              now.force[c] = -on_dam[c];
              total[c] = now.force[c] - rock.mass() * now.acceleration[c];
            }
            total[2] -= rock.mass() * run.scene().statics.gravity;
            const WedgeState state = wedge_equilibrium(rock.planes, total);
            now.safety = state.safety;
            now.mode = state.mode();
          }
        });
  }

  void WedgeObserver::record()
  {
    const double        time = run.integrator->state().time;
    std::vector<double> row = {time};
    for (OfWedge &one : wedges)
    {
      Result &now = one.now;
      now.time = time;
      row.insert(row.end(), now.force.begin(), now.force.end());
      row.insert(row.end(), now.acceleration.begin(), now.acceleration.end());
      row.insert(row.end(), {double(now.mode), now.safety});
      if (now.safety < one.least.safety || history.rows.empty())
        one.least = now;
    }
    history.rows.push_back(row);
  }

  void WedgeObserver::report(Log &log) const
  {
    const char *title = "Wedges";
    for (const OfWedge &one : wedges)
    {
      const RockWedge &rock = one.wedge.wedge;
      log.line("%-9s %s: smallest sliding safety %.3g at t = %.3f s, %s; static %.3g", title,
               rock.name.c_str(), one.least.safety, one.least.time, in_words(rock, one.least.mode).c_str(),
               one.at_start.safety);
      title = "";
    }
  }

  void WedgeObserver::save(boost::archive::binary_oarchive &archive) const
  {
    archive << history;
    for (const OfWedge &one : wedges)
      archive << one.least;
  }

  void WedgeObserver::load(boost::archive::binary_iarchive &archive)
  {
    archive >> history;
    for (OfWedge &one : wedges)
      archive >> one.least;
  }

  double WedgeObserver::least_safety() const
  {
    double least = std::numeric_limits<double>::infinity();
    for (const OfWedge &one : wedges)
      least = std::min(least, one.least.safety);
    return least;
  }

  Json WedgeObserver::json() const
  {
    Json json;
    for (const OfWedge &one : wedges)
    {
      const RockWedge         &rock = one.wedge.wedge;
      std::vector<std::string> planes;
      for (const WedgePlane &plane : rock.planes)
        planes.push_back(plane.name);
      const auto of = [&](const Result &result)
      {
        Json json;
        return json.add("value", result.safety)
            .add("time", result.time)
            .add("mode", result.mode)
            .add("mode_in_words", in_words(rock, result.mode))
            .add_list("force", result.force)
            .add_list("acceleration", result.acceleration);
      };
      Json of_wedge;
      of_wedge.add_texts("planes", planes)
          .add("base_area", one.wedge.part.area)
          .add_list("base_centroid", one.wedge.part.centroid)
          .add("mass", rock.mass())
          .add("static_safety", of(one.at_start))
          .add("min_safety", of(one.least));
      json.add(rock.name, of_wedge);
    }
    return json;
  }
} // namespace Voussoir
