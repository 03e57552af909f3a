// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/app/memory_need.h>
#include <voussoir/app/run_report.h>
#include <voussoir/base/python_script.h>
#include <voussoir/dam/dam_geometry.h>
#include <voussoir/dam/rock_wedge.h>
#include <voussoir/dam/static_path.h>
#include <voussoir/motion/motion_report.h>
#include <voussoir/output/figures.h>
#include <voussoir/output/spectrum_table.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace Voussoir
{
  namespace
  {
    void report_zones(Log &log, const std::vector<Zone> &zones, const char *entry)
    {
      for (const Zone &zone : zones)
        if (!zone.name.empty() && zone.listed)
          log.line("          zone %s: %s; %.4g m3", zone.name.c_str(), in_words(zone.material).c_str(),
                   zone.volume);
        else if (!zone.name.empty())
          log.line("          zone %s: not in %s, so as the section; %.4g m3", zone.name.c_str(), entry,
                   zone.volume);
    }

    /** Returns a text such as ", rock 0.7", or an empty string for a rigid foundation. */
    std::string sustained_rock(const Dam &dam)
    {
      std::ostringstream text;
      if (dam.foundation->uses_rock())
        text << ", rock " << dam.scene.foundation.sustained_ratio();
      return text.str();
    }

    /** Prints the planes, the part of the base and the mass of each rock wedge. */
    void report_wedges(const Dam &dam, Log &log)
    {
      const char *title = "Wedges";
      for (const auto &[wedge, part] : loaded_wedges(dam.scene, *dam.model))
      {
        log.line("%-9s %s: %zu plane%s, %.4g kg; under %u faces of the base (%.4g m2)", title,
                 wedge.name.c_str(), wedge.planes.size(), wedge.planes.size() == 1 ? "" : "s", wedge.mass(),
                 part.n_faces, part.area);
        title = "";
      }
      if (*title == '\0')
        log.line(
            "          inertia by the mean acceleration of the base nodes on each wedge; weight and uplift are "
            "constant");
    }

    /** Prints where the probes are. Throws InputError, see probe_place(). */
    void report_probes(const Dam &dam, Log &log)
    {
      for (const auto &[name, given] : dam.scene.output.probe_places())
      {
        const PlaceInDam probe = probe_place(*dam.model, name, given);
        log.line("Probe     %s at %s in %s, %.2g m from the given point", name.c_str(),
                 place(probe.point).c_str(), physical_name(3, probe.block).c_str(),
                 distance_between(probe.point, given));
      }
    }

    /** Prints the peak values of the motion, and a warning for each entry that may be an oversight. */
    void report_motion_and_warnings(const RunState &run, Log &log)
    {
      const Dam   &dam = *run.dam;
      const Scene &scene = run.scene();
      if (run.n_steps == 0)
        log.line("Motion    none: the static state alone");
      else
      {
        MotionParameters measures_only = scene.motion;
        measures_only.source = "none"; // without the errors of the spectrum
        const MotionReport report = Voussoir::report_motion(run.motion, measures_only);
        const auto        &c = report.components;
        const double       g = standard_gravity;
        log.line("Motion    x, y, z: PGA %.3f %.3f %.3f g, PGV %.3f %.3f %.3f m/s, PGD %.3f %.3f %.3f m",
                 c[0].peak_acceleration / g, c[1].peak_acceleration / g, c[2].peak_acceleration / g,
                 c[0].peak_velocity, c[1].peak_velocity, c[2].peak_velocity, c[0].peak_displacement,
                 c[1].peak_displacement, c[2].peak_displacement);
        if (const double delay = dam.foundation->delay(); scene.motion.duration_is_automatic() && delay > 0.)
          log.line("          the run continues for %.2f s after the motion, until its end reaches the dam",
                   run.grid().duration() - run.motion.duration());
        else if (delay > 0.)
          log.line("          the last %.3f s of the motion do not reach the dam: the run ends at "
                   "\"Motion/Duration\"; with -1 the run is longer by the travel time of the waves",
                   delay);
      }
      const ArchRockParameters *rock = scene.mesh.generated_rock();
      if (rock != nullptr && rock->enabled && !dam.foundation->uses_rock())
        log.warn(
            {Warning::Kind::input,
             "the rock of " + scene.mesh.section() +
                 "/Rock is ignored: Foundation/Model is rigid. Set Foundation/Model to rock or massless, or " +
                 scene.mesh.section() + "/Rock/Enabled to false.",
             scene.mesh.section() + "/Rock"});
      if (scene.reservoir.density > 0. && scene.loads.factor("water") != 0. && !dam.has_water)
        log.line(
            "warning: the water does not reach the dam: Reservoir/Water level is %g m, below the upstream "
            "face. Increase the level, in the axes of the scene, or set Reservoir/Density to 0.",
            scene.reservoir.level);
      const auto &crest = dam.geometry->joints;
      if (dam.layout.n_contraction > 1 &&
          crest.front().arc_length > crest[dam.layout.n_contraction - 1].arc_length)
        log.warn({Warning::Kind::input,
                  "the joints are numbered from the left bank (y > 0) to the right bank, also in "
                  "Joints/Overrides and in all results. Usually the numbers begin at the right bank.",
                  "Mesh/File"});
      if (scene.mesh.source == "file" && !dam.facts.ungrouped.empty())
        log.line("warning: %s", dam.facts.ungrouped.c_str());
      for (const std::string &warning : dam.facts.warnings)
        log.line("warning: %s", warning.c_str());
      if (!scene.statics.stages.empty())
        for (const std::string &warning : StaticPath(dam).warnings())
          log.line("warning: %s", warning.c_str());
      for (const Warning &warning : scene.warnings)
        log.warn(warning);
    }

    /** Prints the corrections of records, and a warning about motion that remains at the end. */
    void report_motion_notes(const RunState &run, Log &log)
    {
      for (const std::string &note : run.motion.notes)
        log.line("%s%s", note.rfind("warning: ", 0) == 0 ? "" : "Records   ", note.c_str());
      if (run.n_steps > 0)
        report_motion_warnings(run.motion, run.scene(), "", log);
    }

    void report_joints(const Dam &dam, Log &log)
    {
      if (dam.layout.tied)
      {
        log.line("Joints    %u joint%s, tied: the monolithic dam", dam.layout.n_contraction,
                 dam.layout.n_contraction == 1 ? "" : "s");
        return;
      }
      const JointParameters &joints = dam.scene.joints;
      std::ostringstream     laws;
      laws << joints.model;
      for (const auto &entry : joints.overrides)
        laws << (std::isdigit(entry.first[0]) ? ", joint " : ", ") << entry.first << ": " << entry.second;
      if (joints.any_reads("Joints/Friction"))
        laws << " (friction " << joints.friction << ")";
      for (const auto &[value, text] : {std::make_pair(joints.normal_stiffness, " Pa/m along the normal"),
                                        std::make_pair(joints.tangential_stiffness, " Pa/m along the joint"),
                                        std::make_pair(joints.adhesion, " Pa adhesion")})
        if (value > 0.)
          laws << ", " << value << text;
      std::string others;
      for (const std::string kind : {"lift", "base"})
        if (const auto n = std::count_if(dam.layout.joints.begin(), dam.layout.joints.end(),
                                         [&](const Joint &joint) { return joint.kind() == kind; });
            n > 0)
          others += ", " + std::to_string(n) + " " + kind + " joint" + (n == 1 ? "" : "s");
      log.line("Joints    %u joint%s%s, %zu pairs, law %s", dam.layout.n_contraction,
               dam.layout.n_contraction == 1 ? "" : "s", others.c_str(), dam.structure.pairs.size(),
               laws.str().c_str());
    }

    void report_damping(const Dam &dam, Log &log)
    {
      const std::vector<double> &f = dam.facts.frequencies;
      log.line("Damping   %s",
               dam.scene.damping.in_words(f.empty() ? 0. : f[0], dam.structure.damping.zones).c_str());
      std::ostringstream moved;
      for (const double frequency : f)
        moved << (moved.tellp() > 0 ? ", " : "") << frequency << " Hz x "
              << std::round(1e4 * dam.structure.damping.of_mode(2. * M_PI * frequency).second) / 1e4;
      if (!f.empty() && !dam.structure.has_zones())
        log.line("          first modes of the tied dam, and factor by the damping: %s", moved.str().c_str());
    }

    /** Writes the critical step, and the steps of the explicit scheme or whether it is worth a trial. */
    void report_explicit(const RunState &run, Log &log)
    {
      const Dam   &dam = *run.dam;
      const Scene &scene = dam.scene;
      if (dam.facts.critical_step > 0.)
        log.line("Critical  step of an explicit scheme for the dam %.4g ms%s, from the elements at %s",
                 1e3 * dam.facts.critical_step,
                 scene.is_explicit() ? "" : " (without rock and Rayleigh damping)",
                 dam.facts.critical_place.c_str());
      if (dam.facts.critical_step > .1 * run.motion.dt && !scene.is_explicit() && // see benchmarks/schemes.py
          scene.foundation.model == "rigid" && scene.impact_rule == "mean-force" &&
          scene.joints.model == "FJA")
        log.line(
            "          \"Dynamics/Scheme\" = explicit is probably three to five times cheaper at equal error");
      if (run.n_steps > 0 && scene.is_explicit())
        log.line("Explicit  %u steps of %.4g ms in a time step", scene.n_explicit,
                 1e3 * run.motion.dt / scene.n_explicit);
    }
  } // namespace

  void report_motion_warnings(const GroundMotion &motion, const Scene &scene, const std::string &name,
                              Log &log)
  {
    MotionParameters any = scene.motion;
    any.source = "none"; // without the errors of the spectrum
    const MotionReport report = report_motion(motion, any);
    for (const std::string &warning :
         {scene.motion.source == "none" ? std::string() : size_warning(report), end_warning(report)})
      if (!warning.empty())
        log.line("warning: %s%s", name.c_str(), warning.c_str());
  }

  void report_setup(const RunState &run, const bool validate, Log &log)
  {
    const Dam         &dam = *run.dam;
    const Scene       &scene = run.scene();
    const unsigned int n_nodes = dam.structure.n_nodes();
    log.line("Mesh      %s: %zu cells, degree %u, %u dofs, %u monoliths; volume %.4g m3, crest %.1f m",
             scene.name.c_str(), dam.facts.n_cells, scene.elements.degree, 3 * n_nodes, dam.facts.n_monoliths,
             dam.facts.volume, dam.facts.crest_length);
    if (!dam.facts.remark.empty())
      log.line("          %s", dam.facts.remark.c_str());
    if (scene.mesh.plane_strain)
      log.line(
          "          plane strain: no displacements along y; forces and masses are those of a slice of %.4g m",
          dam.facts.crest_length);
    log.line("Concrete  %s", in_words(scene.concrete).c_str());
    report_zones(log, dam.facts.concrete_zones, "Concrete/Zones");
    if (dam.has_sustained_moduli())
      log.line("          sustained moduli in the static state: %.4g of Young's modulus%s",
               scene.sustained_ratio(), sustained_rock(dam).c_str());
    report_joints(dam, log);
    dam.foundation->report(log, run.grid());
    report_zones(log, dam.facts.rock_zones, "Foundation/Zones");
    report_damping(dam, log);
    if (!dam.has_water)
      log.line("Water     none: the reservoir is empty");
    else if (dam.water)
      dam.water->report(log, scene.output.pressure_depths);
    else
      log.line("Water     level %g m; added mass %s, %.4g kg along x", scene.reservoir.level,
               scene.reservoir.name_of_mass().c_str(), dam.facts.added_mass);
    if (dam.water_volumes != nullptr && !dam.water)
      log.line("          the volumes \"water\" of the mesh file are not used: Reservoir/Model is %s",
               scene.reservoir.model.c_str());
    report_loads(dam, log);
    report_wedges(dam, log);
    report_probes(dam, log);
    report_motion_and_warnings(run, log);
    report_motion_notes(run, log);
    report_explicit(run, log);
    if (validate)
    {
      std::istringstream groups(dam.facts.groups);
      const char        *title = "Groups";
      for (std::string row; std::getline(groups, row); title = "")
        log.line("%-9s %s", title, row.c_str());
      log.line("Unknowns  %u of the monoliths, %zu of the joints", 3 * n_nodes,
               3 * dam.structure.pairs.size());
      log.line("Steps     %u of %g s%s", run.n_steps, run.motion.dt,
               scene.is_explicit() ? "" : dam.foundation->about_steps().c_str());
      log.line("Memory    %s", in_words(memory_need(scene, scene.hex_mesh())).c_str());
    }
  }

  void write_tables_of_start(const RunState &run, const std::string &directory)
  {
    const Scene &scene = run.scene();
    if (run.n_steps > 0)
    {
      MotionParameters as_run = scene.motion;
      as_run.factor *= scene.loads.factor("earthquake"); // of the combination, as in run.motion
      spectrum_table(run.motion, as_run).write(directory + "/spectrum.csv");
    }
    if (scene.statics.stages.empty())
      return;
    Table table;
    table.columns = {"stage",   "share",      "level",      "crest_x",   "crest_y",
                     "crest_z", "open_pairs", "slip_pairs", "wet_pairs", "max_opening"};
    for (const StaticStep &s : run.statics.steps)
      table.rows.push_back({double(s.stage), s.share, s.level, s.crown[0], s.crown[1], s.crown[2],
                            double(s.n_open), double(s.n_slip), double(s.n_wet), s.opening});
    table.write(directory + "/stages.csv");
  }

  void report_error_bars(const Scene &scene, const std::string &directory, Log &log)
  {
    namespace fs = std::filesystem;
    std::error_code error;
    const fs::path  run = fs::canonical(directory, error), script = find_script("error_bars.py");
    if (script.empty() ||
        (!fs::exists(run / "accuracy" / "accuracy.json", error) &&
         !fs::exists(run.parent_path() / (scene.name + "-accuracy") / "accuracy.json", error)))
    {
      log.line("Errors    no error bar: run voussoir accuracy %s.prm", scene.name.c_str());
      return;
    }
    const fs::path file = run / "error_bars.log";
    for (const std::string &python : python_interpreters())
      if (run_process({python, script.string(), run.string()}, file.string()) != 3) // 3: no numpy
        break;
    std::ifstream in(file);
    const char   *title = "Errors";
    for (std::string line; std::getline(in, line); title = "")
      log.line("%-9s %s", title, line.c_str());
    if (*title != '\0')
      log.line(
          "Errors    no error bar: no python3 with numpy was found. Install it, or set VOUSSOIR_PYTHON.");
    in.close();
    fs::remove(file, error);
  }

  void report_figures(const std::string &directory, Log &log)
  {
    const std::string error = draw_figures_of(directory, directory + "/figures.log");
    if (error.empty())
      log.line("Figures   %s/figures", directory.c_str());
    else
      log.line("warning: the figures could not be drawn: %s. The results are complete.", error.c_str());
  }
} // namespace Voussoir
