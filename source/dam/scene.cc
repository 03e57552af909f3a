// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/entries.h>
#include <voussoir/base/error.h>
#include <voussoir/contact/law_table.h>
#include <voussoir/dam/scene.h>
#include <voussoir/dynamics/newmark.h>

#include <algorithm>
#include <filesystem>
#include <sstream>

namespace Voussoir
{
  using namespace dealii;

  void ElementParameters::add_parameters(Entries &prm)
  {
    prm.enter_subsection("Elements");
    prm.add_parameter("Degree", degree, "Polynomial degree of the hexahedra: 1 (8 nodes) or 2 (27 nodes).",
                      Patterns::Integer(1, 2));
    prm.add_parameter(
        "Incompatible modes", incompatible_modes,
        "Add bending modes to elements of degree 1, which lock without them. They cost nothing after the "
        "set-up.");
    prm.leave_subsection();
  }

  void DampingParameters::add_parameters(Entries &prm)
  {
    prm.enter_subsection("Damping");
    prm.add_parameter("Ratio", ratio,
                      "Rayleigh damping, as a ratio of critical damping at the two frequencies [-].",
                      {.001, .2, true}, Patterns::Double(0., 1.));
    prm.add_parameter("Frequency 1", frequency_1, "Lower frequency at which the ratio holds [Hz].", {0., 20.},
                      Patterns::Double(1e-6));
    prm.add_parameter("Frequency 2", frequency_2, "Upper frequency at which the ratio holds [Hz].",
                      {.5, 100.}, Patterns::Double(1e-6));
    prm.leave_subsection();
  }

  void DampingParameters::check() const
  {
    if (!(frequency_2 > frequency_1))
      throw InputError("Entry \"Damping/Frequency 2\" must be larger than \"Damping/Frequency 1\".");
  }

  constexpr double two_pi = 6.28318530717958647693;

  double DampingParameters::mass_factor() const
  {
    return 2. * ratio * two_pi * frequency_1 * frequency_2 / (frequency_1 + frequency_2);
  }

  double DampingParameters::stiffness_factor() const
  {
    return 2. * ratio / (two_pi * (frequency_1 + frequency_2));
  }

  void JointParameters::add_parameters(Entries &prm)
  {
    prm.enter_subsection("Joints");
    prm.add_parameter("Model", model, "What happens in the joints: " + joint_law_docs() + ".",
                      Patterns::Selection(joint_law_names()));
    LawParameters::add_parameters(prm);
    prm.add_parameter(
        "Overrides", overrides,
        "Models of single joints, as \"number: model, number: model\"; joints are numbered from the right "
        "bank.",
        Patterns::Map(Patterns::Integer(1), Patterns::Selection(joint_law_names())));
    prm.add_parameter("Equations", equations_name,
                      "Form of the joint equations: alart-curnier (the paper's, with the slip angle of the "
                      "trial force; always "
                      "converges), paper (slip angle of the force itself, as printed) or fischer-burmeister; "
                      "the last two for "
                      "comparison.",
                      Patterns::Selection(equations_names()));
    keys.add_parameters(prm);
    prm.leave_subsection();
  }

  LawParameters JointParameters::law(const double young) const
  {
    LawParameters result = *this;
    result.equations = equations_from_name(equations_name);
    if (keys.seat_compliance < 0.)
      result.keys.seat_compliance = 20. * keys.height / young;
    return result;
  }

  bool JointParameters::any_reads(const std::string &entry) const
  {
    return joint_law_reads(model, entry) ||
           std::any_of(overrides.begin(), overrides.end(),
                       [&](const auto &joint) { return joint_law_reads(joint.second, entry); });
  }

  void JointParameters::check() const
  {
    // KSM takes a key for seated on a flank within 1e-9 of its height. Steps begin where the one before was
    // solved to, some 1e-12 m: in keys below a millimetre they begin beyond their flanks, where the pair's
    // problem takes 200 times as long, or for ever.
    constexpr double smallest = 1e-3;
    if (keys.height != 0. && !(keys.height >= smallest))
    {
      std::ostringstream message;
      message << "Entry \"Joints/Keys/Height\" must be at least " << smallest
              << " m, or 0 for a joint without keys, and is " << keys.height << " m.";
      throw InputError(message.str());
    }
    // Steps begin where the one before was solved to; a stiffer seat is not told from that.
    constexpr double stiffest = 1e-12;
    if (keys.seat_compliance > 0. && keys.seat_compliance < stiffest)
    {
      std::ostringstream message;
      message << "Entry \"Joints/Keys/Seat compliance\" must be at least " << stiffest
              << " m/Pa, or 0 for rigid seats, or -1, and is " << keys.seat_compliance << " m/Pa.";
      throw InputError(message.str());
    }
  }

  void StaticParameters::add_parameters(Entries &prm)
  {
    prm.enter_subsection("Statics");
    prm.add_parameter(
        "Self-weight", self_weight,
        "staged: on free-standing monoliths, before the joints are closed, as dams are built; monolithic: "
        "on the finished dam, together with the water; none.",
        Patterns::Selection("staged|monolithic|none"));
    prm.add_parameter(
        "Water increments", water_increments,
        "Increments in which the water is raised; friction makes the result depend on the path a little.",
        Patterns::Integer(1));
    prm.add_parameter("Gravity", gravity, "Acceleration of gravity [m/s^2].", {9.7, 9.9},
                      Patterns::Double(0.));
    prm.add_parameter(
        "Stages", stages,
        "What comes before the water is raised to Reservoir/Water level, one after the other, as \"grout "
        "140, "
        "fill 100, day 90, grout 210\": fill Z, the reservoir to the level z [m]; grout Z, the joints up to "
        "z, "
        "which carry nothing before (without it all are grouted at first); day D, the temperatures of that "
        "day of Loads/Temperature/Table. Each in \"Water increments\" steps.",
        Patterns::Anything());
    prm.leave_subsection();
  }

  void OutputParameters::add_parameters(Entries &prm)
  {
    prm.enter_subsection("Output");
    prm.add_parameter(
        "Probes", probes,
        "Points whose displacement goes into history.csv, as \"name: x y z; name: x y z\" [m]; the nearest "
        "node is taken.",
        Patterns::Map(Patterns::Anything(), Patterns::Anything(), 0, Patterns::Map::max_int_value, ";"));
    prm.add_parameter("Envelope interval", envelope_interval,
                      "Steps between two evaluations of the stresses for their envelopes; 0: no envelopes.",
                      Patterns::Integer(0));
    prm.add_parameter("Solution interval", solution_interval,
                      "Steps between two files of the whole solution for ParaView; 0: none.",
                      Patterns::Integer(0));
    prm.add_parameter("Checkpoint interval", checkpoint_interval, "Steps between two checkpoints; 0: none.",
                      Patterns::Integer(0));
    prm.add_parameter("Progress interval", progress_interval, "Steps between two lines on the screen.",
                      Patterns::Integer(1));
    prm.add_parameter("Figures", figures,
                      "Draw the figures at the end of the run (needs python3-matplotlib).");
    prm.add_parameter(
        "Block forces", block_forces,
        "Write blocks.csv: the force of the foundation on the base of each monolith over time.");
    prm.add_parameter(
        "Stress recovery", stress_recovery,
        "Stresses at the nodes: tractions (from the elements, with the known tractions on faces and "
        "joints, and with the tractions on the base extrapolated to its nodes) or elements (from these "
        "alone).",
        Patterns::Selection("tractions|elements"));
    prm.add_parameter("Tensile strength", tensile_strength,
                      "summary.json says how much of each face has tension above it; 0: above Limits/Tensile "
                      "strength, if that "
                      "is given [Pa].",
                      Patterns::Double(0.));
    prm.leave_subsection();
  }

  void OutputParameters::check() const
  {
    probe_places();
  }

  std::map<std::string, Vector3> OutputParameters::probe_places() const
  {
    std::map<std::string, Vector3> places;
    for (const auto &probe : probes)
    {
      const bool taken = probe.first == "crest" || probe.first == "crest_left" || probe.first == "base" ||
                         probe.first == "base_acceleration";
      if (probe.first.empty() || taken || probe.first.find_first_of(",\"") != std::string::npos)
        throw InputError(
            "Entry \"Output/Probes\": \"" + probe.first +
            "\" cannot be the name of a probe; it becomes a column of history.csv, " +
            std::string(taken ? "which has one of that name" : "where commas and quotes cannot be") +
            ". Separate probes by "
            "semicolons, as in \"name: x y z; name: x y z\".");
      std::istringstream in(probe.second);
      std::string        more;
      Vector3           &p = places[probe.first];
      if (!(in >> p[0] >> p[1] >> p[2]) || in >> more)
        throw InputError("Entry \"Output/Probes\": probe \"" + probe.first + "\" has the place \"" +
                         probe.second + "\"; write three numbers, x y z.");
    }
    return places;
  }

  void Scene::add_parameters(Entries &prm)
  {
    mesh.add_parameters(prm);
    elements.add_parameters(prm);
    prm.enter_subsection("Concrete");
    prm.add_parameter("Young's modulus", concrete.young,
                      "Dynamic modulus of elasticity of the concrete [Pa].", {5e9, 6e10},
                      Patterns::Double(1.));
    prm.add_parameter("Poisson's ratio", concrete.poisson, "Poisson's ratio of the concrete [-].",
                      {.1, .3, true}, Patterns::Double(-.99, .499));
    prm.add_parameter("Density", concrete.density, "Density of the concrete [kg/m^3].", {1800., 3000.},
                      Patterns::Double(1e-3));
    prm.add_parameter("Zones", concrete_zones,
                      "Materials of zones of the dam, as \"NAME: E nu rho, NAME: E nu rho\", modulus of "
                      "elasticity, Poisson's ratio and density, in Pa and kg/m^3 or with units; NAME is that "
                      "of the volumes \"monolith 1 NAME\" of the mesh.",
                      Patterns::Map(Patterns::Anything(), Patterns::Anything()));
    prm.leave_subsection();
    damping.add_parameters(prm);
    reservoir.add_parameters(prm);
    joints.add_parameters(prm);
    statics.add_parameters(prm);
    loads.add_parameters(prm);
    motion.add_parameters(prm);
    foundation.add_parameters(prm);
    prm.enter_subsection("Dynamics");
    prm.add_parameter(
        "Steps per sample", steps_per_sample,
        "Time steps in each sampling interval of the ground motion, which is linear between its samples. "
        "With rock the time step must be below the critical one (--validate prints it).",
        Patterns::Integer(1));
    prm.add_parameter("Error estimate", error_estimate,
                      "Estimate the error that the time step makes in the extremes, by a companion of twice "
                      "the step beside the run: 40 to 90 % more work. Not on rock with mass.");
    prm.add_parameter(
        "Impact", impact_rule,
        "Joint forces and velocities of touching faces: mean-force (forces are means over the step, so that "
        "joints "
        "never create energy); impulse-consistent (forces at the end of the step, with Coulomb's law for "
        "impulses); paper (Taylor and Papadopoulos); none (plain Newmark, which rings). The last three for "
        "comparison.",
        Patterns::Selection(impact_rule_names()));
    prm.add_parameter(
        "Factors", factors,
        "Precision in which the factors of the monoliths' matrices are kept: single halves what a step reads "
        "of "
        "them, and their memory. The displacement of a step is then found as an increment, and what the "
        "equations of motion leave over is carried to the next step (doc/method.md).",
        Patterns::Selection("double|single"));
    prm.leave_subsection();
    contact.add_parameters(prm);
    limits.add_parameters(prm);
    output.add_parameters(prm);
  }

  std::vector<std::pair<std::string, std::string>> Scene::input_files() const
  {
    std::vector<std::pair<std::string, std::string>> files;
    const auto                                       add = [&](const char *entry, const std::string &file)
    {
      if (!file.empty())
        files.emplace_back(entry, (std::filesystem::path(directory) / file).string());
    };
    if (mesh.source == "file")
      add("Mesh/File", mesh.file);
    add("Loads/Temperature/Table", loads.temperature.table);
    if (motion.source == "file")
    {
      constexpr const char *entries[3] = {"Motion/File x", "Motion/File y", "Motion/File z"};
      add("Motion/File", motion.file);
      for (unsigned int d = 0; d < 3; ++d)
        add(entries[d], motion.component_files[d]);
    }
    return files;
  }

  void Scene::check_output(const std::string &file) const
  {
    const std::filesystem::path directory_of_file = std::filesystem::path(file).parent_path();
    if (!directory_of_file.empty() && !std::filesystem::is_directory(directory_of_file))
      throw InputError("There is no directory " + directory_of_file.string() + " for the file " + file +
                       ". Make it, or choose another file with --output.");
    std::vector<std::string> inputs = sources;
    for (const auto &input : input_files())
      inputs.push_back(input.second);
    std::error_code error;
    for (const std::string &input : inputs)
      if (std::filesystem::equivalent(input, file, error))
        throw InputError("The file " + file + " would be overwritten, and is input (" + input +
                         "). Choose another one with --output.");
  }

  void Scene::check() const
  {
    mesh.check();
    zone_materials(concrete_zones, "Concrete/Zones");
    foundation.zone_materials();
    damping.check();
    if (foundation.model == "rock" && error_estimate)
      throw InputError(
          "Entry \"Dynamics/Error estimate\" is for a dam on a rigid base or on massless rock: rock "
          "with mass moves at steps of its own. Leave it out; `voussoir accuracy` estimates the "
          "error there.");
    if (foundation.model == "rock" && foundation.has_own_steps() && impact_rule != "mean-force")
      throw InputError(
          "Rock with steps of its own (\"Foundation/Substeps\" above 1, or "
          "\"Foundation/Coupling\" = mean traction) needs \"Dynamics/Impact\" = mean-force, not " +
          impact_rule + ".");
    if (foundation.model == "rock" && contact.write_problems)
      throw InputError(
          "Entry \"Contact/Write problems\" is for a dam on a rigid base or on massless rock: on "
          "rock the feet of the joints are tied, or couple all joints, which no problem file "
          "has. Leave it out, or set \"Foundation/Model\" to rigid or massless.");
    joints.check();
    loads.check();
    static_stages(statics.stages);
    motion.check();
    output.check();
  }
} // namespace Voussoir
