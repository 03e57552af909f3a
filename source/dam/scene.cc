// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/entries.h>
#include <voussoir/base/error.h>
#include <voussoir/base/number_text.h>
#include <voussoir/base/units.h>
#include <voussoir/contact/law_table.h>
#include <voussoir/dam/scene.h>
#include <voussoir/dynamics/integrator_table.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <regex>
#include <set>
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
        "true: incompatible bending modes in elements of degree 1, which lock without them. The modes do not "
        "increase the time of a step.");
    prm.leave_subsection();
  }

  void JointParameters::add_parameters(Entries &prm)
  {
    prm.enter_subsection("Joints");
    prm.add_parameter("Model", model, "Joint law. " + joint_law_docs() + ".",
                      Patterns::Selection(joint_law_names()));
    LawParameters::add_parameters(prm);
    prm.add_parameter(
        "Overrides", overrides,
        "Models of single joints, as \"3: tied, base: cohesive, lift 2.1: FJB\": number, kind (contraction, lift, "
        "base) or name of the joints. base 2 is the base joint of monolith 2, lift 2.1 the joint between its lifts 1 "
        "and 2, joint 3.2 the part of joint 3 between lifts 2. Joints are numbered from the right bank.",
        Patterns::Map(Patterns::Anything(), Patterns::Selection(joint_law_names())));
    prm.add_parameter(
        "Initial gaps", gaps,
        "Gaps between the faces of the joints before grouting, as \"3: 2 mm, 4: 1 mm, base: 1 mm\" [m]: number, "
        "kind or name of the joints as in Overrides. The gap of a pair remains, without bond, until a stage grout "
        "of Statics/Stages fills it. Reported openings include it: they count from closed faces.",
        Patterns::Map(Patterns::Anything(), Patterns::Anything()));
    prm.add_parameter(
        "Equations", equations_name,
        "Form of the joint equations. alart-curnier: slip angle of the trial force. paper: "
        "slip angle of the joint force, as printed, for comparison. Default alart-curnier, because the other "
        "form often does not converge.",
        Patterns::Selection(equations_names()));
    keys.add_parameters(prm);
    prm.enter_subsection("Keys");
    prm.add_parameter(
        "Clearances", clearances,
        "Clearance in single joints, as \"3: 2 mm, lift: 1 mm\" [m]: number, kind or name of the joints as "
        "in Overrides.",
        Patterns::Map(Patterns::Anything(), Patterns::Anything()));
    prm.leave_subsection();
    prm.leave_subsection();
  }

  namespace
  {
    /** Returns the value of a joint by its name, number or kind, in this order; otherwise @p other. */
    const std::string &value_of(const std::map<std::string, std::string> &values, const Joint &joint,
                                const std::string &other)
    {
      for (const std::string &key : joint.keys())
        if (const auto found = values.find(key); found != values.end())
          return found->second;
      return other;
    }

    /** Returns a length of the @p entry [m]. */
    double length_from(const std::string &value, const std::string &entry)
    {
      const double length = number_in_unit(value, "m", "Entry \"" + entry + "\"");
      if (!(length >= 0. && std::isfinite(length)))
        throw InputError("Entry \"" + entry + "\" has the value \"" + value +
                         "\", which must be a length of at least 0, such as \"2 mm\".");
      return length;
    }
  } // namespace

  LawParameters JointParameters::law(const double young, const Joint *joint) const
  {
    LawParameters result = *this;
    result.equations = equations_from_name(equations_name);
    if (keys.seat_compliance < 0.)
      result.keys.seat_compliance = 20. * keys.height / young;
    if (const std::string own = joint ? value_of(clearances, *joint, "") : ""; !own.empty())
      result.keys.clearance = length_from(own, "Joints/Keys/Clearances");
    return result;
  }

  const std::string &JointParameters::model_of(const Joint &joint) const
  {
    return value_of(overrides, joint, model);
  }

  double JointParameters::gap_of(const Joint &joint) const
  {
    return length_from(value_of(gaps, joint, "0"), "Joints/Initial gaps");
  }

  bool JointParameters::any_reads(const std::string &entry) const
  {
    return joint_law_reads(model, entry) ||
           std::any_of(overrides.begin(), overrides.end(),
                       [&](const auto &joint) { return joint_law_reads(joint.second, entry); });
  }

  void JointParameters::add_choices(ModelChoices &choices) const
  {
    if (choices.n_joints == 0 && !choices.has_base_joints && !choices.has_lift_joints)
      return;
    add_law_choices(model, *this, choices);
    if (choices.has_base_joints && overrides.empty() && model != "tied")
      choices.add("joints", "bonded base", {{"Joints/Overrides", "base: tied"}}, true);
    if (choices.has_lift_joints && overrides.empty() && model != "tied")
      choices.add("joints", "tied lift joints", {{"Joints/Overrides", "lift: tied"}}, true);
    if (overrides.empty() && model != "tied" && choices.n_joints > 1)
    {
      std::string tied;
      for (unsigned int joint = 2; joint <= choices.n_joints; joint += 2)
        tied += (tied.empty() ? "" : ", ") + std::to_string(joint) + ": tied";
      choices.add("joints", "every second joint", {{"Joints/Overrides", tied}}, true);
    }
    if (any_reads("Joints/Friction") && friction > 0.)
    {
      choices.add("joints", "friction 25 % lower", "Joints/Friction", .75 * friction);
      choices.add("joints", "friction 25 % higher", "Joints/Friction", 1.25 * friction);
    }
  }

  void JointParameters::check() const
  {
    for (const auto &joint : gaps)
      length_from(joint.second, "Joints/Initial gaps");
    for (const auto &joint : clearances)
      length_from(joint.second, "Joints/Keys/Clearances");
    // KSM treats a flank as closed within 1e-9 of the key height. A step starts with the error of the
    // previous solution, about 1e-12 m. Smaller keys would start beyond their flanks, where the problem of
    // the pair takes 200 times as long, or does not converge.
    constexpr double smallest = 1e-3;
    if (keys.height != 0. && !(keys.height >= smallest))
    {
      std::ostringstream message;
      message << "Entry \"Joints/Keys/Height\" must be at least " << smallest
              << " m, or 0 for a joint without keys, but it is " << keys.height << " m.";
      throw InputError(message.str());
    }
    // The compression of a stiffer flank contact is below the error of the previous solution.
    constexpr double stiffest = 1e-12;
    if (keys.seat_compliance > 0. && keys.seat_compliance < stiffest)
    {
      std::ostringstream message;
      message << "Entry \"Joints/Keys/Seat compliance\" must be at least " << stiffest
              << " m/Pa, or 0 for rigid flanks, or -1 for 20 Height/E, but it is " << keys.seat_compliance
              << " m/Pa.";
      throw InputError(message.str());
    }
  }

  void StaticParameters::add_choices(ModelChoices &choices) const
  {
    for (const char *kind : {"staged", "monolithic"})
      if (self_weight != "none" && self_weight != kind)
        choices.add("loads", "self-weight " + std::string(kind), {{"Statics/Self-weight", kind}});
  }

  void StaticParameters::add_parameters(Entries &prm)
  {
    prm.enter_subsection("Statics");
    prm.add_parameter(
        "Self-weight", self_weight,
        "Application of the self-weight. staged: to free-standing monoliths, before the joints are grouted. "
        "monolithic: to the finished dam, together with the water. none: no self-weight. Default staged, "
        "because dams are built in this way.",
        Patterns::Selection("staged|monolithic|none"));
    prm.add_parameter(
        "Water increments", water_increments,
        "Number of load increments of each static stage [-]. The result depends slightly on it "
        "because of friction. With stages and friction in base or lift joints, the program halves "
        "the increments until the state agrees.",
        Patterns::Integer(1));
    prm.add_parameter("Gravity", gravity, "Acceleration of gravity [m/s^2].", {9.7, 9.9},
                      Patterns::Double(0.));
    prm.add_parameter(
        "Stages", stages,
        "Static stages before the final stage with Reservoir/Water level, such as \"grout 140, "
        "fill 100, day 90, grout 210 at 0.5 MPa, cut 5 by 10 mm\". fill Z: reservoir at the level "
        "Z [m]. grout Z: joints grouted up to the height Z [m]; with \"at P\" the fluid grout "
        "first presses on the faces with P [Pa]. Joints above have contact without friction. "
        "Without a grout stage all joints are grouted at the start. cut J by W: the joints J "
        "(number, kind or name) lose material of the width W [m] and their bond. day D: "
        "temperatures of the day D of Loads/Temperature/Table. Each stage has \"Water "
        "increments\" steps.",
        Patterns::Anything());
    prm.leave_subsection();
  }

  void OutputParameters::add_parameters(Entries &prm)
  {
    prm.enter_subsection("Output");
    prm.add_parameter(
        "Probes", probes,
        "Points whose displacement, velocity (both relative to the base) and absolute acceleration are written to history.csv, as \"name: x y z; name: x y z\" [m]. Values "
        "are interpolated in the element; at a joint it is that towards the right bank.",
        Patterns::Map(Patterns::Anything(), Patterns::Anything(), 0, Patterns::Map::max_int_value, ";"));
    prm.add_parameter(
        "Pressure depths", pressure_depths,
        "Depths below the water level whose dynamic pressure is written to history.csv, such as \"20, "
        "50\" [m]. Reservoir/Model acoustic only. The point is the middle of the upstream face at the depth.",
        Patterns::List(Patterns::Double(0.)));
    const auto add = [&](const char *name, OutputInterval &interval, const std::string &help)
    {
      prm.add_parameter(name, interval.text,
                        help + " Number of samples of the motion, or a time with its unit, as 50 ms: a "
                               "multiple of Motion/Time step.");
    };
    add("Envelope interval", envelope_interval, "Interval of the stress envelopes. 0: no envelopes.");
    add("Solution interval", solution_interval, "Interval of the solution's ParaView files. 0: none.");
    prm.add_parameter(
        "Frames", frames,
        "Largest number of frames in frames.bin [-], from which the report makes its view of the "
        "moving dam. They are at equal intervals in the strong part of the motion. 0: none.",
        Patterns::Integer(0));
    add("Checkpoint interval", checkpoint_interval, "Interval of the checkpoints. 0: none.");
    add("Progress interval", progress_interval, "Interval of the progress lines.");
    prm.add_parameter("Figures", figures,
                      "true: draw the figures at the end of the run. Requires python3-matplotlib.");
    prm.add_parameter(
        "Block forces", block_forces,
        "true: write blocks.csv, the force of the foundation on the base of each monolith over time.");
    prm.add_parameter(
        "Stress recovery", stress_recovery,
        "Computation of the nodal stresses. tractions: from the elements and the known tractions on faces "
        "and joints, with tractions on the base extrapolated to its nodes. elements: from the elements only.",
        Patterns::Selection("tractions|elements"));
    prm.add_parameter("Tensile strength", tensile_strength,
                      "Strength for the share of each face with larger tension in summary.json [Pa]. 0: "
                      "Limits/Tensile strength, if it is set.",
                      Patterns::Double(0.));
    prm.leave_subsection();
  }

  void OutputParameters::check() const
  {
    probe_places();
    if (std::set<double>(pressure_depths.begin(), pressure_depths.end()).size() < pressure_depths.size())
      throw InputError("Entry \"Output/Pressure depths\" has a depth twice. Remove one.");
  }

  void OutputParameters::read_intervals(const double sample)
  {
    const auto read = [&](const std::string &name, OutputInterval &interval, const unsigned int least)
    {
      const std::string entry = "Entry \"Output/" + name + " interval\"", &text = interval.text;
      char             *end = nullptr;
      double            n = std::strtod(text.c_str(), &end);
      const bool        is_time = *end != '\0' && !unit_name(end, "time").empty();
      if (is_time)
        n = number_in_unit(text, "s", entry) / sample;
      const double whole = std::round(n);
      if (text.empty() || (*end != '\0' && !is_time) || !(n >= least && n <= 1e9) ||
          std::abs(n - whole) > (is_time ? 1e-6 * whole : 0.))
        throw InputError(entry + " is \"" + text + "\"" +
                         (is_time ? ", " + number_text(n) + " samples of the motion" : "") +
                         ". It must be a number of samples from " + std::to_string(least) +
                         ", or a time with its unit that is a multiple of Motion/Time step, " +
                         number_text(sample) + " s.");
      interval.samples = static_cast<unsigned int>(whole);
    };
    read("Envelope", envelope_interval, 0);
    read("Solution", solution_interval, 0);
    read("Checkpoint", checkpoint_interval, 0);
    read("Progress", progress_interval, 1);
  }

  std::map<std::string, Vector3> OutputParameters::probe_places() const
  {
    std::map<std::string, Vector3> places;
    for (const auto &probe : probes)
    {
      const bool taken = probe.first == "crest" || probe.first == "crest_left" || probe.first == "base" ||
                         probe.first == "ground" ||
                         std::regex_match(probe.first, std::regex(".*_(acceleration|velocity)|pressure_.*"));
      const std::string entry = "Entry \"Output/Probes\": ";
      const std::string example = " Separate probes by semicolons, as in \"name: x y z; name: x y z\".";
      if (probe.first.empty())
        throw InputError(entry + "the probe has no name." + example);
      if (taken)
        throw InputError(
            entry + "\"" + probe.first +
            "\" cannot be the name of a probe, because it names another column of history.csv or "
            "floor_spectra.csv. Choose another name, without \"_acceleration\" or \"_velocity\" at its end.");
      if (probe.first.find_first_of(",\"") != std::string::npos)
        throw InputError(entry + "\"" + probe.first +
                         "\" cannot be the name of a probe, because it becomes a column of history.csv, "
                         "where commas and quotes are not allowed." +
                         example);
      std::istringstream in(probe.second);
      std::string        more;
      Vector3           &p = places[probe.first];
      if (!(in >> p[0] >> p[1] >> p[2]) || in >> more)
        throw InputError("Entry \"Output/Probes\": probe \"" + probe.first + "\" has the position \"" +
                         probe.second + "\". Write three numbers, x y z.");
    }
    return places;
  }

  namespace
  {
    void add_dynamics(Scene &scene, Entries &prm)
    {
      prm.enter_subsection("Dynamics");
      prm.add_parameter(
          "Steps per sample", scene.steps_per_sample,
          "Number of time steps per sampling interval of the ground motion [-]. The motion is linear between "
          "its samples. With rock the time step must be below the critical one, which --validate prints.",
          Patterns::Integer(1));
      prm.add_parameter("Scheme", scene.scheme, "Time integration. " + integrator_docs() + ".",
                        Patterns::Selection(integrator_names()));
      prm.add_parameter(
          "Explicit step", scene.explicit_step,
          "Length of the steps of the scheme explicit [s]; they are shortened to divide a time step, at whose end results are recorded. "
          "-1: 0.95 of the critical step.",
          {-1., .01}, Patterns::Double(-1.));
      prm.add_parameter(
          "Mass scaling", scene.mass_scaling,
          "Step of the scheme explicit that mass added to the smallest elements of a mesh from a file allows [s]. The log "
          "tells the mass, which is an error of the model. 0: none.",
          {0., .005}, Patterns::Double(0.));
      prm.add_parameter(
          "Initial velocity", scene.initial_velocity,
          "Velocities of blocks at the start, relative to the base, as \"BLOCK: vx vy vz; BLOCK: ...\" in "
          "m/s. BLOCK is all, or a name such as monolith 2 or monolith 2 lift 1.",
          Patterns::Map(Patterns::Anything(), Patterns::Anything(), 0, Patterns::Map::max_int_value, ";"));
      prm.add_parameter(
          "Impact", scene.impact_rule,
          "Joint forces and velocities of closed joints. mean-force: the forces are means over "
          "the step, so joints never create energy. For comparison: paper (Taylor and Papadopoulos) and none "
          "(plain Newmark, which oscillates).",
          Patterns::Selection(impact_rule_names()));
      prm.add_parameter(
          "Factors", scene.factors,
          "Precision of the matrix factors of the monoliths. single: half of the memory and of "
          "the memory traffic of a step. The unknown is then the displacement increment, and the "
          "residual of the equations of motion is added to the next step (doc/method.md). Always "
          "double on subcycled rock, and on massless rock that is not one body with the dam.",
          Patterns::Selection("double|single"));
      prm.leave_subsection();
    }
  } // namespace

  void Scene::add_parameters(Entries &prm)
  {
    mesh.add_parameters(prm);
    elements.add_parameters(prm);
    prm.enter_subsection("Concrete");
    prm.add_parameter("Young's modulus", concrete.young, "Dynamic Young's modulus of the concrete [Pa].",
                      {5e9, 6e10}, Patterns::Double(1.));
    prm.add_parameter("Sustained modulus", sustained,
                      "Modulus of elasticity of the concrete in the static state [Pa], which includes creep. "
                      "The moduli of \"Zones\" have the same ratio to their sustained moduli. 0: Young's "
                      "modulus.",
                      {3e9, 6e10, true}, Patterns::Double(0.));
    prm.add_parameter("Poisson's ratio", concrete.poisson, "Poisson's ratio of the concrete [-].",
                      {.1, .3, true}, Patterns::Double(-.99, .499));
    prm.add_parameter("Density", concrete.density, "Density of the concrete [kg/m^3].", {1800., 3000.},
                      Patterns::Double(1e-3));
    prm.add_parameter(
        "Zones", concrete_zones,
        "Materials of dam zones, as \"NAME: E nu rho, NAME: E nu rho\". E is Young's modulus, nu "
        "Poisson's ratio and rho the density, with units or in Pa and kg/m^3. NAME is the zone of the "
        "mesh volumes \"monolith 1 NAME\".",
        Patterns::Map(Patterns::Anything(), Patterns::Anything()));
    prm.leave_subsection();
    damping.add_parameters(prm);
    reservoir.add_parameters(prm);
    joints.add_parameters(prm);
    statics.add_parameters(prm);
    loads.add_parameters(prm);
    motion.add_parameters(prm);
    foundation.add_parameters(prm);
    add_dynamics(*this, prm);
    contact.add_parameters(prm);
    limits.add_parameters(prm);
    output.add_parameters(prm);
  }

  std::vector<ModelChoice> Scene::model_choices() const
  {
    ModelChoices  choices;
    const HexMesh hexes = hex_mesh();
    choices.bottom = 1e300, choices.top = -1e300;
    choices.has_rock = mesh.source != "file";
    choices.time_step = motion.time_step / steps_per_sample;
    choices.has_base_joints =
        std::any_of(hexes.faces.begin(), hexes.faces.end(),
                    [](const HexMesh::Face &face) { return face.surface == PhysicalId::base_joint; });
    for (const HexMesh::Cell &cell : hexes.cells)
      if (is_monolith(cell.volume))
      {
        choices.n_joints = std::max<unsigned int>(choices.n_joints, monolith_of(cell.volume) - 1);
        choices.has_lift_joints = choices.has_lift_joints || lift_of(cell.volume) > 1;
        for (const unsigned int node : cell.nodes)
        {
          choices.bottom = std::min(choices.bottom, hexes.nodes[node][2]);
          choices.top = std::max(choices.top, hexes.nodes[node][2]);
        }
      }
      else
        choices.has_rock = true;
    reservoir.add_choices(choices);
    foundation.add_choices(choices);
    joints.add_choices(choices);
    add_load_choices(*this, choices);
    statics.add_choices(choices);
    motion.add_choices(choices);
    damping.add_choices(choices);
    choices.add("material", "Young's modulus 20 % lower", "Concrete/Young's modulus", .8 * concrete.young);
    mesh.add_choices(foundation_reads(foundation.model, "Foundation/Young's modulus"), choices);
    if (elements.degree == 1)
      choices.add("numerics", "elements of degree 2", "Elements/Degree", 2.);
    if (!is_explicit())
      choices.add("numerics", "half the time step", "Dynamics/Steps per sample", 2. * steps_per_sample);
    if (!is_explicit() && steps_per_sample % 2 == 0)
      choices.add("numerics", "twice the time step", "Dynamics/Steps per sample", .5 * steps_per_sample,
                  true);
    if (!is_explicit() && foundation.model == "rigid" && damping.model != "Rayleigh" &&
        reservoir.model != "incompressible")
      choices.add("numerics", "explicit scheme", {{"Dynamics/Scheme", "explicit"}}, true);
    if (!has_single_factors() && !is_explicit())
      choices.add("numerics", "factors in single precision", {{"Dynamics/Factors", "single"}}, true);
    contact.add_choices(choices);
    const auto has_stage = [&](const char *kind) { return statics.stages.find(kind) != std::string::npos; };
    const auto refused = [&](const ModelChoice &choice) // by check()
    {
      const bool moves = !motion.abutments.empty(); // requires massless rock
      return (has_stage("fill") && choice.name == "empty reservoir") ||
             (has_stage("grout") && choice.name == "self-weight monolithic") ||
             ((has_stage("grout") || has_stage("cut")) && choice.name == "tied") ||
             ((moves || !initial_velocity.empty()) && choice.entries.count("Foundation/Model") > 0) ||
             (hexes.water && reservoir.is_meshed() && choice.entries.count("Reservoir/Water level") > 0) ||
             (reservoir.is_acoustic() && choice.name == "twice the time step");
    };
    choices.list.erase(std::remove_if(choices.list.begin(), choices.list.end(), refused), choices.list.end());
    return choices.list;
  }

  HexMesh Scene::hex_mesh() const
  {
    MeshParameters parameters = mesh;
    parameters.arch210_rock.enabled = parameters.arcs_rock.enabled =
        foundation.ignores_rock || foundation_reads(foundation.model, "Foundation/Young's modulus");
    return make_mesh(parameters, directory);
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
    if (mesh.source == "arcs")
      add("Mesh/Arcs/Table", mesh.arcs.table);
    for (const ForceHistory &force : loads.force_histories())
      add("Loads/Force history", force.file);
    add("Loads/Temperature/Table", loads.temperature.table);
    if (reservoir.model == "added mass table")
      add("Reservoir/Table", reservoir.table);
    add("Limits/Wedges", limits.wedges);
    if (motion.source == "file")
    {
      constexpr const char *entries[3] = {"Motion/File x", "Motion/File y", "Motion/File z"};
      for (const MotionParameters &part : motion.parts())
      {
        const bool in_sequence = !motion.sequence.empty();
        add(in_sequence ? "Motion/Sequence" : "Motion/File", part.file);
        for (unsigned int d = 0; d < 3; ++d)
          add(in_sequence ? "Motion/Sequence" : entries[d], part.component_files[d]);
      }
    }
    for (const EnsembleMember &member : motion.members())
      for (const auto &[entry, value] : member.entries)
        if (entry.rfind("Motion/File", 0) == 0)
          add("Motion/Ensemble", value);
    for (const StationParameters &station : motion.stations())
    {
      add("Motion/Abutments", station.record.file);
      for (const std::string &component : station.record.component_files)
        add("Motion/Abutments", component);
    }
    if (motion.has_target() && !motion.target_file.empty())
      files.emplace_back(
          "Motion/Target spectrum",
          file_and_choice((std::filesystem::path(directory) / motion.target_file).string()).first);
    return files;
  }

  void Scene::check_output(const std::string &file) const
  {
    const std::filesystem::path directory_of_file = std::filesystem::path(file).parent_path();
    if (!directory_of_file.empty() && !std::filesystem::is_directory(directory_of_file))
      throw InputError("There is no directory " + directory_of_file.string() + " for the file " + file +
                       ". Create it, or choose another file with --output.");
    std::vector<std::string> inputs = sources;
    for (const auto &input : input_files())
      inputs.push_back(input.second);
    std::error_code error;
    for (const std::string &input : inputs)
      if (std::filesystem::equivalent(input, file, error))
        throw InputError("The file " + file + " would be overwritten, but it is an input (" + input +
                         "). Choose another one with --output.");
  }

  void Scene::check_explicit() const
  {
    const auto refuse = [](const std::string &why) {
      throw InputError("\"Dynamics/Scheme\" = explicit " + why + ", or \"Dynamics/Scheme\" to trapezoidal.");
    };
    if (foundation.model == "rock" && damping.law().mass > 0. && (motion.source != "none" || moves_alone()))
      refuse("on rock has no mass-proportional damping, which would brake the motion of the rock. Set "
             "\"Damping/Model\" to uniform");
    if (reservoir.model == "incompressible")
      refuse("has no incompressible water. Set \"Reservoir/Model\" to acoustic");
    if (mass_scaling > 0. && reservoir.is_meshed())
      throw InputError(
          "Entry \"Dynamics/Mass scaling\" does not consider compressible water, which shortens the critical "
          "step, too. Remove the entry, or set \"Reservoir/Model\" to Westergaard.");
    if (mass_scaling > 0. && mesh.source != "file")
      throw InputError(
          "Entry \"Dynamics/Mass scaling\" is for meshes from files. Remove it, and enlarge the smallest elements of the "
          "generated mesh (\"" +
          mesh.section() + "/Smallest height\").");
    if (!(explicit_step > 0. || explicit_step == -1.))
      refuse("requires a step. Set \"Dynamics/Explicit step\" to -1");
    if (impact_rule != "mean-force" || contact.write_problems)
      refuse("has no rule of impact and no contact problems. Set \"Dynamics/Impact\" to mean-force and "
             "\"Contact/Write problems\" to false");
    if (damping.law().stiffness > 0. && (motion.source != "none" || moves_alone()))
      refuse(
          "has no stiffness-proportional damping, which would require very short steps. Set "
          "\"Damping/Model\" to uniform, or \"Damping/Mass coefficient\" with \"Stiffness coefficient\" = 0");
  }

  void Scene::complete()
  {
    damping.with_explicit = is_explicit();
    check();
    output.read_intervals(motion.time_step);
    motion.read_target(directory);
  }

  std::map<int, Vector3> Scene::initial_velocities() const
  {
    std::map<int, Vector3> velocities;
    for (const auto &[name, text] : initial_velocity)
    {
      std::istringstream in(text);
      std::string        more;
      Vector3            v{};
      const int          block = name == "all" ? 0 : physical_id(3, name);
      if (block < 0 || (block > 0 && !is_monolith(block)) || !(in >> v[0] >> v[1] >> v[2]) || in >> more)
        throw InputError(
            "Entry \"Dynamics/Initial velocity\" has \"" + name + ": " + text +
            "\"; write \"BLOCK: vx vy vz\" in m/s, where BLOCK is all, or a name such as monolith 2.");
      velocities[block] = v;
    }
    return velocities;
  }

  void Scene::check() const
  {
    if (!initial_velocities().empty() && foundation.model != "rigid")
      throw InputError("Entry \"Dynamics/Initial velocity\" requires \"Foundation/Model\" = rigid, not " +
                       foundation.model + ".");
    mesh.check();
    zone_materials(concrete_zones, "Concrete/Zones");
    foundation.zone_materials();
    damping.check();
    if (damping.is_uniform() && foundation.model == "massless" &&
        (impact_rule != "mean-force" || contact.write_problems))
      throw InputError(
          "\"Damping/Model\" = uniform on massless rock requires \"Dynamics/Impact\" = mean-force and "
          "\"Contact/Write problems\" = false. Set these entries, or \"Damping/Model\" = Rayleigh.");
    if (foundation.model == "rock" && foundation.substeps > 1 && !foundation.is_subcycled() && !is_explicit())
      throw InputError("\"Foundation/Coupling\" = partition with \"Foundation/Substeps\" above 1 was removed "
                       "in version 0.4.0. Set \"Foundation/Coupling\" to auto or mean traction, or "
                       "\"Foundation/Substeps\" to 1.");
    if (is_explicit())
      check_explicit();
    if (foundation.model == "rock" && foundation.is_subcycled() && impact_rule != "mean-force")
      throw InputError("Subcycled rock (\"Foundation/Substeps\" above 1, or \"Foundation/Coupling\" = mean "
                       "traction) requires \"Dynamics/Impact\" = mean-force, not " +
                       impact_rule + ".");
    if (foundation.model == "rock" && contact.write_problems)
      throw InputError("Entry \"Contact/Write problems\" requires a rigid base or massless rock, because the "
                       "files cannot contain the coupling of base nodes by rock. Remove the entry, or set "
                       "\"Foundation/Model\" to rigid or massless.");
    if (!motion.abutments.empty() && foundation.model != "massless")
      throw InputError("Entry \"Motion/Abutments\" requires \"Foundation/Model\" = massless, not " +
                       foundation.model +
                       ": a rigid base moves as one body, and rock with mass receives the ground motion from "
                       "below. Set the model to massless, or remove the entry.");
    joints.check();
    loads.check();
    static_stages(statics.stages);
    motion.check(moves_alone());
    output.check();
  }
} // namespace Voussoir
