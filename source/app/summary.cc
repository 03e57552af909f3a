// SPDX-License-Identifier: GPL-3.0-or-later
#include <deal.II/base/config.h>

#include <voussoir/app/simulation.h>
#include <voussoir/base/error.h>
#include <voussoir/output/assessment.h>

#include <sys/resource.h>

#include <ctime>
#include <omp.h>

namespace Voussoir
{
  namespace
  {
    Json json_of(const std::vector<Zone> &zones)
    {
      Json json;
      for (const Zone &zone : zones)
      {
        Json of_zone;
        of_zone.add("young", zone.material.young)
            .add("poisson", zone.material.poisson)
            .add("density", zone.material.density)
            .add("volume", zone.volume)
            .add_flag("listed", zone.listed);
        json.add(zone.name.empty() ? "(no zone)" : zone.name, of_zone);
      }
      return json;
    }
  } // namespace

  Json Simulation::json_of_mesh() const
  {
    Json json;
    json.add("cells", dam->n_cells)
        .add("degree", scene.elements.degree)
        .add("nodes", dam->structure.n_nodes())
        .add("dofs", 3. * dam->structure.n_nodes())
        .add("monoliths", dam->n_monoliths)
        .add("joints", dam->n_joints)
        .add("pairs", dam->structure.pairs.size())
        .add("volume", dam->volume)
        .add("crest_length", dam->crest_length);
    return json;
  }

  Json Simulation::json_of_times() const
  {
    Json json;
    json.add("wall", clock_before + clock.seconds())
        .add("cpu", cpu_before + double(std::clock()) / CLOCKS_PER_SEC)
        .add("setup", count.seconds_setup)
        .add("static", count.seconds_static)
        .add("shaking", count.seconds_shaking)
        .add("shaking_cpu", count.cpu_shaking)
        .add("substitutions", count.seconds_substitutions)
        .add("sweeps", count.seconds_substitutions) // the name until 0.3
        .add("joints", count.seconds_joints)
        .add("stepping", count.seconds_stepping)
        .add("rock", count.seconds_rock)
        .add("stresses", count.seconds_stresses)
        .add("output", count.seconds_output)
        .add("per_second_of_earthquake", n_steps > 0 ? count.seconds_shaking / grid().duration() : 0.);
    return json;
  }

  Json Simulation::json_per_rank() const
  {
    Json json;
    json.add_list("work_seconds", per_rank.work)
        .add_list("rock_work_seconds", per_rank.rock_work)
        .add_list("messages_per_step", per_rank.messages)
        .add_list("memory_bytes", per_rank.memory);
    return json;
  }

  Json Simulation::json_of_newton() const
  {
    const double n = std::max(1u, step);
    Json         json;
    json.add("mean", count.newton / n)
        .add("max", count.newton_max)
        .add("linear_iterations_mean", count.krylov / n)
        .add("joint_factorisations_mean", count.factorisations / n)
        .add("gauss_seidel_iterations", count.gauss_seidel)
        .add("sweeps", count.gauss_seidel); // the name until 0.3
    return json;
  }

  Json Simulation::json_of_statics() const
  {
    const auto &crown = dam->model->points[dam->geometry->crown];
    Json        json;
    json.add_list("crest_point", Vector3{{crown[0], crown[1], crown[2]}})
        .add_list("crest_displacement", statics.crown)
        .add_list("self_weight_crest_displacement", dam->self_weight_crown)
        .add("newton_iterations", statics.contact.iterations)
        .add("path", std::string(name(statics.contact.path)))
        .add("residual", statics.contact.residual)
        .add("open_pairs", statics.n_open);
    return json;
  }

  Json Simulation::json_of_extremes() const
  {
    Json json;
    json.add("max_opening", json_of(joints->opening)).add("max_slip", json_of(joints->slip));
    if (scene.output.envelope_interval > 0)
      json.add("max_tension_upstream", json_of(envelope->extreme(*dam->model, PhysicalId::upstream, true)))
          .add("max_tension_downstream",
               json_of(envelope->extreme(*dam->model, PhysicalId::downstream, true)))
          .add("max_compression", json_of(envelope->extreme(*dam->model, 0, false)))
          .add("max_compression_away_from_base",
               json_of(tension->smallest_away_from_base(*envelope, *dam->model)));
    for (const auto &[name, surface] :
         {std::make_pair(std::string("max_tension_upstream"), PhysicalId::upstream),
          {"max_tension_downstream", PhysicalId::downstream}})
      if (scene.output.envelope_interval > 0)
      {
        const Json largest = json_of(tension->largest_away_from_base(*envelope, *dam->model, surface));
        json.add(name + "_away_from_base", largest).add(name + "_above_foot", largest); // for one release
      }
    return json;
  }

  Json Simulation::json_of_time_error() const
  {
    const TimeError error = companion->of(*joints, *envelope, *tension);
    Json            json;
    json.add("openings", error.opening)
        .add("largest_opening", error.largest_opening)
        .add("tension_upstream", error.tension_upstream)
        .add("tension_downstream", error.tension_downstream);
    return json;
  }

  /** How much of the faces has tension above the strength. */
  Json Simulation::json_of_strength() const
  {
    Json json;
    json.add("strength", scene.strength_of_area());
    for (const auto &face :
         {std::make_pair("upstream", PhysicalId::upstream), {"downstream", PhysicalId::downstream}})
    {
      const FaceTension::Part part = tension->above(*envelope, face.second, scene.strength_of_area());
      Json                    of_face;
      json.add(face.first, of_face.add("area", part.area).add("share", part.share()));
    }
    return json;
  }

  void Simulation::write_summary()
  {
    Json path, zones, summary;
    for (unsigned int i = 0; i < count.path.size(); ++i)
      path.add(name(static_cast<ContactPath>(i)), count.path[i]);
    zones.add("concrete", json_of(dam->concrete_zones));
    if (!dam->rock_zones.empty())
      zones.add("rock", json_of(dam->rock_zones));
    rusage usage;
    getrusage(RUSAGE_SELF, &usage);
    summary.add("scene", scene.name)
        .add("law", dam->tied ? "tied" : scene.joints.model)
        .add("foundation", scene.foundation.model)
        .add("version", VOUSSOIR_VERSION)
        .add("revision", VOUSSOIR_REVISION)
        .add("dealii", DEAL_II_PACKAGE_VERSION)
        .add("ranks", double(Ranks::size()))
        .add("threads", omp_get_max_threads())
        .add("mesh", json_of_mesh())
        .add("zones", zones)
        .add("steps", step)
        .add("time_step", motion.dt)
        .add("seconds", json_of_times())
        .add("memory_bytes", 1024. * usage.ru_maxrss)
        .add("newton_iterations", json_of_newton())
        .add("contact_path", path)
        .add("contact_residual", count.residual)
        .add("energy_balance_error", balance_error())
        .add("largest_energy", largest_energy())
        .add("static", json_of_statics())
        .add("loads", json_of_loads())
        .add("extremes", json_of_extremes());
    const StressesOfRun stresses{*envelope, *tension, n_steps > 0 ? scene.output.envelope_interval : 1};
    const Assessment    assessment(scene.limits, *dam->model,
                                scene.output.envelope_interval > 0 ? &stresses : nullptr,
                                dam->structure.pairs.empty() ? nullptr : joints.get(), blocks.get());
    assessment.add_to(summary);
    if (blocks)
      summary.add("blocks", blocks->json());
    summary.add_texts("warnings", log.warnings());
    summary.add("per_rank", json_per_rank());
    if (companion)
      summary.add("error_estimate", json_of_time_error());
    if (scene.output.envelope_interval > 0 && scene.strength_of_area() > 0.)
      summary.add("tension_above_strength", json_of_strength());
    dam->foundation->add_to_summary(summary, grid());
    if (!assessment.in_words().empty())
      log.line("Limits    %s", assessment.in_words().c_str());
    OutputFile out(directory + "/summary.json");
    out << summary.text() << "\n";
    out.check();
  }
} // namespace Voussoir
