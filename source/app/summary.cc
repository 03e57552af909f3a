// SPDX-License-Identifier: GPL-3.0-or-later
#include <deal.II/base/config.h>

#include <voussoir/app/memory_need.h>
#include <voussoir/app/run_report.h>
#include <voussoir/base/output_file.h>
#include <voussoir/base/ranks.h>
#include <voussoir/base/version.h>
#include <voussoir/motion/motion_report.h>
#include <voussoir/output/assessment.h>

#include <omp.h>

#include <sstream>

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

    Json json_of_mesh(const Dam &dam)
    {
      std::vector<double>
          bases; // monoliths of the base joints, whose numbers follow those of the other joints
      std::vector<std::string> names;
      for (const Joint &joint : dam.layout.joints)
      {
        names.push_back(joint.name());
        if (joint.is_base())
          bases.push_back(joint.monolith_2());
      }
      Json json;
      json.add("cells", dam.facts.n_cells)
          .add("degree", dam.scene.elements.degree)
          .add("nodes", dam.structure.n_nodes())
          .add("dofs", 3. * dam.structure.n_nodes())
          .add("monoliths", dam.facts.n_monoliths)
          .add("joints", dam.layout.n_contraction)
          .add_texts("joint_names", names)
          .add_list("base_joints", bases)
          .add("pairs", dam.structure.pairs.size())
          .add("volume", dam.facts.volume)
          .add("crest_length", dam.facts.crest_length);
      return json;
    }

    Json json_of_zones(const Dam &dam)
    {
      Json json;
      json.add("concrete", json_of(dam.facts.concrete_zones));
      if (!dam.facts.rock_zones.empty())
        json.add("rock", json_of(dam.facts.rock_zones));
      return json;
    }

    Json json_of_statics(const Dam &dam, const StaticState &statics)
    {
      const auto &crown = dam.model->points[dam.geometry->crown];
      Json        json;
      json.add_list("crest_point", Vector3{{crown[0], crown[1], crown[2]}})
          .add_list("crest_displacement", statics.crown)
          .add_list("self_weight_crest_displacement", dam.staged.crown)
          .add("newton_iterations", statics.contact.iterations)
          .add("path", std::string(name(statics.contact.path)))
          .add("residual", statics.contact.residual)
          .add("open_pairs", statics.n_open);
      return json;
    }

    Json json_of_extremes(const RunObservers &observers)
    {
      Json json;
      for (const NamedExtremes &extremes : {observers.joints.extremes(), observers.stresses.extremes()})
        for (const auto &[name, extreme] : extremes)
          json.add(name, json_of(extreme));
      return json;
    }
  } // namespace

  Assessment assessment_of(const RunState &run, const RunObservers &observers)
  {
    return assess(run, observers.joints, observers.stresses, observers.blocks ? &*observers.blocks : nullptr,
                  observers.wedges ? std::optional<double>(observers.wedges->least_safety()) : std::nullopt);
  }

  namespace
  {
    Json json_of_damping(const Dam &dam)
    {
      const DampingParameters &damping = dam.scene.damping;
      Json                     json;
      json.add("model", damping.is_uniform() ? "uniform" : "Rayleigh").add("ratio", damping.ratio);
      if (damping.is_uniform())
      {
        const double first = dam.facts.frequencies.empty() ? 0. : dam.facts.frequencies[0];
        json.add("band_begin", damping.band_begin)
            .add("band_end", damping.band_end)
            .add("reference_frequency", damping.needs_first_frequency() ? first : damping.reference_frequency)
            .add("static_modulus", dam.structure.damping.modulus);
        for (const Damping::Zone &zone : dam.structure.damping.zones)
          json.add("ratio_" + (zone.name.empty() ? "rest" : zone.name), zone.ratio);
      }
      else
        json.add("frequency_1", damping.frequency_1)
            .add("frequency_2", damping.frequency_2)
            .add("mass_factor", damping.mass_factor())
            .add("stiffness_factor", damping.stiffness_factor());
      return json;
    }

    Json json_of_water(const Dam &dam)
    {
      const ReservoirParameters &reservoir = dam.scene.reservoir;
      Json                       json;
      json.add_flag("reaches_dam", dam.has_water)
          .add("level", reservoir.level)
          .add("model", reservoir.kind());
      if (dam.water)
        json.add("sound_speed", reservoir.sound_speed).add("reflection", reservoir.reflection);
      else
        json.add("added_mass", reservoir.kind())
            .add("factor", reservoir.factor)
            .add("added_mass_x", dam.facts.added_mass);
      return json;
    }

    /** Returns duration and largest absolute values of the ground motion. */
    Json json_of_motion(const RunState &run)
    {
      MotionParameters measures_only;
      measures_only.source = "file"; // without the errors of an artificial motion's spectrum
      const auto components = report_motion(run.motion, measures_only).components;
      Vector3    a, v, u;
      for (unsigned int d = 0; d < 3; ++d)
      {
        a[d] = components[d].peak_acceleration;
        v[d] = components[d].peak_velocity;
        u[d] = components[d].peak_displacement;
      }
      Json json;
      json.add("duration", run.motion.duration())
          .add_list("peak_acceleration", a)
          .add_list("peak_velocity", v)
          .add_list("peak_displacement", u);
      return json;
    }

    Json json_of_joints(const Scene &scene)
    {
      Json json, overrides;
      for (const auto &[joint, model] : scene.joints.overrides)
        overrides.add(joint, model);
      json.add("model", scene.joints.model).add("overrides", overrides);
      if (scene.joints.any_reads("Joints/Friction"))
        json.add("friction", scene.joints.friction);
      return json;
    }

    Json json_of_memory(const Scene &scene)
    {
      const MemoryNeed need = memory_need(scene, scene.hex_mesh());
      Json             json;
      json.add("run", need.run).add("other_ranks", need.of_others).add("halved_step", need.halved_step);
      return json;
    }
  } // namespace

  Json json_of_setup(const RunState &run, const Log &log)
  {
    const Dam               &dam = *run.dam;
    const Scene             &scene = run.scene();
    std::vector<std::string> groups;
    std::istringstream       rows(dam.facts.groups);
    for (std::string row; std::getline(rows, row);)
      groups.push_back(row);
    Json json, unknowns;
    unknowns.add("monoliths", 3. * dam.structure.n_nodes()).add("joints", 3. * dam.structure.pairs.size());
    json.add("scene", scene.name)
        .add("law", dam.layout.tied ? "tied" : scene.joints.model)
        .add("foundation", scene.foundation.model)
        .add("version", version())
        .add("revision", revision())
        .add("ranks", double(Ranks::size()))
        .add("mesh", json_of_mesh(dam))
        .add_texts("groups", groups)
        .add("zones", json_of_zones(dam))
        .add("joints", json_of_joints(scene))
        .add("unknowns", unknowns)
        .add("damping", json_of_damping(dam))
        .add("water", json_of_water(dam))
        .add("loads", json_of_loads(dam));
    if (run.n_steps > 0)
      json.add("motion", json_of_motion(run)).add_texts("motion_notes", run.motion.notes);
    json.add("steps", run.n_steps).add("time_step", run.motion.dt);
    if (dam.facts.critical_step > 0.)
      json.add("critical_step", dam.facts.critical_step).add("critical_place", dam.facts.critical_place);
    dam.foundation->add_to_summary(json, run.grid());
    json.add("memory_bytes", json_of_memory(scene)).add("warnings", log.warnings());
    return json;
  }

  void report_limits(const RunState &run, const RunObservers &observers, Log &log)
  {
    if (const std::string words = assessment_of(run, observers).in_words(); !words.empty())
      log.line("Limits    %s", words.c_str());
  }

  namespace
  {
    /** Returns the members at the beginning of summary.json: model and program. */
    Json json_of_model(const RunState &run)
    {
      const Dam   &dam = *run.dam;
      const Scene &scene = run.scene();
      Json         json;
      return json.add("scene", scene.name)
          .add("law", dam.layout.tied ? "tied" : scene.joints.model)
          .add("foundation", scene.foundation.model)
          .add("version", version())
          .add("revision", revision())
          .add("dealii", DEAL_II_PACKAGE_VERSION)
          .add("ranks", double(Ranks::size()))
          .add("threads", omp_get_max_threads())
          .add("mesh", json_of_mesh(dam))
          .add("zones", json_of_zones(dam));
    }

    void write_json(const std::string &file, const Json &json)
    {
      OutputFile out(file);
      out << json.text() << "\n";
      out.check();
    }
  } // namespace

  void write_ensemble_summary(const std::string &directory, const RunState &run, const Json &ensemble,
                              const RunCounters &counters, const Log &log)
  {
    Json summary = json_of_model(run), seconds;
    seconds.add("wall", counters.wall())
        .add("cpu", counters.cpu())
        .add("setup", counters.setup)
        .add("static", counters.statics)
        .add("shaking", counters.shaking);
    summary.add("time_step", run.motion.dt)
        .add("seconds", seconds)
        .add("memory_bytes", largest_memory_consumption())
        .add("ensemble", ensemble)
        .add("loads", json_of_loads(*run.dam))
        .add("warnings", log.warnings());
    write_json(directory + "/summary.json", summary);
  }

  void write_summary(const std::string &directory, const RunState &run, const RunObservers &observers,
                     const RunCounters &counters, const RankCounters &ranks, const Log &log)
  {
    const Dam       &dam = *run.dam;
    const Scene     &scene = run.scene();
    const Assessment assessment = assessment_of(run, observers);
    Json             summary = json_of_model(run);
    summary.add("steps", run.step)
        .add("time_step", run.motion.dt)
        .add("seconds", counters.json_of_times(run, observers.stresses.seconds))
        .add("memory_bytes", largest_memory_consumption())
        .add("newton_iterations", counters.json_of_newton(run.step))
        .add("contact_path", counters.json_of_path())
        .add("contact_residual", counters.residual)
        .add("energy_balance_error", observers.history.balance_error())
        .add("largest_energy", run.largest_energy())
        .add("static", json_of_statics(dam, run.statics))
        .add("loads", json_of_loads(dam))
        .add("extremes", json_of_extremes(observers));
    summary.add("end_kinetic_energy", observers.history.kinetic_share());
    if (run.n_steps > 0)
      summary.add("accelerations", observers.history.json_of_accelerations());
    assessment.add_to(summary);
    if (run.motion.parts.size() > 1 && run.n_steps > 0)
      summary.add("motion_parts", observers.joints.json_of_parts());
    if (observers.water)
      summary.add("water", observers.water->json());
    if (observers.blocks)
      summary.add("blocks", observers.blocks->json());
    if (observers.wedges)
      summary.add("wedges", observers.wedges->json());
    summary.add("warnings", log.warnings());
    summary.add("per_rank", ranks.json());
    if (observers.stresses.is_recording() && scene.strength_of_area() > 0.)
      summary.add("tension_above_strength", observers.stresses.json_of_strength());
    dam.foundation->add_to_summary(summary, run.grid());
    write_json(directory + "/summary.json", summary);
  }
} // namespace Voussoir
