// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/error.h>
#include <voussoir/contact/law_table.h>
#include <voussoir/dam/base_uplift.h>
#include <voussoir/dam/dam.h>
#include <voussoir/dam/dam_loads.h>
#include <voussoir/dam/mesh_warnings.h>
#include <voussoir/dynamics/impact.h>
#include <voussoir/foundation/foundation_table.h>
#include <voussoir/joints/pairs.h>
#include <voussoir/mesh/footings.h>
#include <voussoir/mesh/mesh_axes.h>
#include <voussoir/mesh/mesh_groups.h>
#include <voussoir/mesh/mesh_joints.h>
#include <voussoir/mesh/plane_section.h>
#include <voussoir/solid/cell_elasticity.h>
#include <voussoir/solid/solid_grid.h>
#include <voussoir/solid/solid_model.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <map>
#include <set>
#include <sstream>

namespace Voussoir
{
  namespace
  {
    /** Throws InputError if there is no joint j between the monoliths j and j + 1. */
    void check_joint_numbers(const HexMesh &opened, const std::string &source)
    {
      std::set<int> numbers, monoliths;
      for (const Joint &joint : joints_of(opened))
        if (joint.is_contraction())
          numbers.insert(joint.contraction_number());
      for (const HexMesh::Cell &cell : opened.cells)
        monoliths.insert(monolith_of(cell.volume));
      const int n_joints = std::max(numbers.empty() ? 0 : *numbers.rbegin(),
                                    monoliths.size() > 1 ? *monoliths.rbegin() - 1 : 0);
      for (int j = 1; j <= n_joints; ++j)
        if (numbers.count(j) == 0)
          throw InputError("mesh " + source + ": joint " + std::to_string(j) + " has no faces: monoliths " +
                           std::to_string(j) + " and " + std::to_string(j + 1) +
                           " do not meet. Number the monoliths consecutively from the right bank to the "
                           "left. If they are, make their nodes on the joint coincide.");
    }

    /** Throws InputError for a monolith without base nodes. */
    void check_base(const HexMesh &opened, const std::string &source)
    {
      std::set<int> base_joints;
      for (const Joint &joint : joints_of(opened))
        if (joint.is_base())
          base_joints.insert(PhysicalId::joint_side_2 + joint.number);
      std::set<unsigned int> base;
      for (const HexMesh::Face &face : opened.faces)
        if (face.surface == PhysicalId::base || base_joints.count(face.surface) > 0)
          base.insert(face.nodes.begin(), face.nodes.end());
      std::map<int, bool> stands;
      for (const HexMesh::Cell &cell : opened.cells)
        stands[monolith_of(cell.volume)] |= std::any_of(
            cell.nodes.begin(), cell.nodes.end(), [&](const unsigned int n) { return base.count(n) > 0; });
      for (const auto &[monolith, does] : stands)
        if (!does)
          throw InputError("mesh " + source + ": monolith " + std::to_string(monolith) +
                           " has no node on the surface \"base\", so it is unsupported. Extend its joints to "
                           "the base, or add its lowest faces to the surface.");
    }

    /** Throws InputError if the model cannot be in plane strain. */
    void check_plane_strain(const Scene &scene, const Foundation &foundation, const HexMesh &opened)
    {
      if (foundation.uses_rock())
        throw InputError(
            "\"Mesh/Plane strain\" is true, but \"Foundation/Model\" is " + scene.foundation.model +
            ". Plane strain applies to dams on a rigid base. Set \"Foundation/Model\" to rigid, or "
            "\"Mesh/Plane strain\" to false.");
      if (scene.reservoir.is_meshed() && scene.reservoir.model == "acoustic" &&
          scene.reservoir.reflection < 1.)
        throw InputError(
            "\"Mesh/Plane strain\" is true, but \"Reservoir/Reflection\" is " +
            number_text(scene.reservoir.reflection) +
            ": the sides of the channel would absorb waves as the bed does. Set \"Reservoir/Reflection\" "
            "to 1, or \"Reservoir/Model\" to Westergaard.");
      check_plane_section(opened, scene.mesh.name());
    }

    /** Returns true if monoliths have joints inside: lift joints, or base joints on footings. */
    bool has_parts(const std::vector<Joint> &joints)
    {
      return std::any_of(joints.begin(), joints.end(),
                         [](const Joint &joint) { return joint.is_inside_monolith(); });
    }

    /** Ties all joints inside monoliths, or those with the model "tied" in @p models. */
    void tie_parts(const std::vector<Joint> &joints, const std::vector<std::string> *models,
                   SolidModel &model)
    {
      tie_joints(model, joints.size(),
                 [&](const unsigned int j)
                 { return joints[j].is_inside_monolith() && (models == nullptr || (*models)[j] == "tied"); });
    }

    /** Returns true if the entries for single joints have the same meaning in a dam without lifts. They may name lift
     * joints that are tied, but no part of another joint. */
    bool is_without_parts(const Scene &scene, const unsigned int n_joints)
    {
      const auto is_whole = [&](const std::string &key)
      {
        const bool is_number = std::isdigit(static_cast<unsigned char>(key[0])) && key.size() <= 4;
        return key == "contraction" || key == "base" || (is_number && std::stoul(key) <= n_joints);
      };
      const auto has_whole = [&](const auto &entry) { return is_whole(entry.first); };
      const auto is_tied_lift = [&](const auto &entry)
      { return has_whole(entry) || entry.first.compare(0, 4, "lift") == 0; };
      const auto is_no_cut_of_part = [&](const StaticStage &stage)
      { return stage.kind != StaticStage::Kind::cut || is_whole(stage.joint); };
      const std::vector<StaticStage> stages = static_stages(scene.statics.stages);
      return std::all_of(scene.joints.overrides.begin(), scene.joints.overrides.end(), is_tied_lift) &&
             std::all_of(scene.joints.gaps.begin(), scene.joints.gaps.end(), has_whole) &&
             std::all_of(stages.begin(), stages.end(), is_no_cut_of_part);
    }

    /** Returns the mesh without lifts if all lift joints are tied and the entries for single joints allow it.
     * @p merged_lifts: receives the keys of all joints in this case. */
    HexMesh merge_tied_lifts(HexMesh opened, const Scene &scene, const bool tie_all,
                             std::set<std::string> &merged_lifts)
    {
      const std::vector<Joint> all = joints_of(opened);
      std::set<std::string>    lifts;
      for (const Joint &joint : all)
      {
        if (joint.is_lift() && !tie_all && scene.joints.model_of(joint) != "tied")
          return opened;
        const std::vector<std::string> keys = joint.keys();
        lifts.insert(keys.begin(), keys.end());
      }
      if (!has_parts(all) || (!tie_all && !is_without_parts(scene, n_monoliths(opened) - 1)))
        return opened;
      merged_lifts = lifts;
      HexMesh whole = close_joints(opened);
      for (HexMesh::Cell &cell : whole.cells)
        cell.volume = monolith_of(cell.volume);
      return open_joints(whole);
    }

    /** Returns true if a base joint of the opened mesh is not tied. */
    bool has_open_base(const HexMesh &opened, const Scene &scene)
    {
      const std::vector<Joint> joints = joints_of(opened);
      return std::any_of(joints.begin(), joints.end(),
                         [&](const Joint &joint)
                         { return joint.is_base() && scene.joints.model_of(joint) != "tied"; });
    }

    /** Groups and sorts the pairs: the lift and base joints of monolith m belong to the contraction joint m - 1. */
    void group_by_monolith(const std::vector<Joint> &joints, Structure &structure)
    {
      structure.group_of_joint.resize(joints.size());
      for (std::size_t j = 0; j < joints.size(); ++j)
        structure.group_of_joint[j] = joints[j].is_contraction() ? joints[j].contraction_number() - 1
                                                                 : std::max(0, joints[j].monolith_2() - 2);
      std::stable_sort(structure.pairs.begin(), structure.pairs.end(),
                       [&](const Pair &a, const Pair &b) {
                         return std::make_pair(structure.group(a), a.joint) <
                                std::make_pair(structure.group(b), b.joint);
                       });
    }

    /** Removes the pairs of contraction joints with shear keys at nodes of base joints: keys cannot cross joints. */
    void remove_keys_at_base(const std::vector<Joint> &joints, const std::vector<std::string> &joint_models,
                             Structure &structure)
    {
      std::set<unsigned int> standing;
      for (const Pair &pair : structure.pairs)
        if (joints[pair.joint].is_base())
          standing.insert(pair.node_2);
      std::vector<Pair> &pairs = structure.pairs;
      pairs.erase(std::remove_if(pairs.begin(), pairs.end(),
                                 [&](const Pair &pair)
                                 {
                                   return joints[pair.joint].is_contraction() &&
                                          joint_models[pair.joint] == "KSM" &&
                                          standing.count(pair.node_1) + standing.count(pair.node_2) > 0;
                                 }),
                  pairs.end());
    }

    /** Returns the laws of pairs that share nodes with other pairs, per joint. Where joints cross, their conditions are
     * redundant. The compliance of these laws makes the forces unique. It is that of a thin layer of concrete, and about
     * 3e-2 of the flexibility of the concrete around a pair in a step of 10 ms. */
    std::vector<std::unique_ptr<JointLaw>> laws_of_crossings(const Scene &scene, const Structure &structure,
                                                             const std::vector<std::string> &models)
    {
      constexpr double          thickness = .2; // of the layer of concrete, in distances of the nodes
      std::vector<double>       area(models.size(), 0.);
      std::vector<unsigned int> n(models.size(), 0);
      for (const auto &cluster : structure.clusters)
        for (const unsigned int p : cluster)
        {
          area[structure.pairs[p].joint] += structure.pairs[p].area;
          ++n[structure.pairs[p].joint];
        }
      std::vector<std::unique_ptr<JointLaw>> laws;
      for (std::size_t j = 0; j < models.size() && !structure.clusters.empty(); ++j)
      {
        LawParameters parameters = scene.joints.law(scene.concrete.young);
        const double  added = scene.concrete.young / (thickness * std::sqrt(area[j] / std::max(1u, n[j])));
        for (double *stiffness : {&parameters.normal_stiffness, &parameters.tangential_stiffness})
          *stiffness = n[j] == 0          ? *stiffness
                       : *stiffness == 0. ? added
                                          : 1. / (1. / *stiffness + 1. / added);
        laws.push_back(make_joint_law(models[j], parameters));
      }
      return laws;
    }
  } // namespace

  Dam::Dam(const Scene &scene, const bool tie_all) : scene(scene)
  {
    const HexMesh     mesh = scene.hex_mesh();
    const std::string source = scene.mesh.name();
    check_axes_and_units(mesh, scene.mesh, source);
    groups = group_table(mesh);
    water_volumes = mesh.water;
    ungrouped = faces_without_group(mesh, scene.mesh.plane_strain);
    const HexMesh opened = open_monoliths(mesh, source, tie_all);
    choose_laws(tie_all);
    if (!tied || scene.statics.self_weight == "staged")
      check_base(opened, source);
    FoundationParameters founded = scene.foundation;
    if (founded.coupling == "auto" && scene.impact_rule != "mean-force")
      founded.coupling = "partition"; // the other coupling requires mean forces
    foundation =
        make_foundation({founded, mesh, source, scene.elements.degree, scene.elements.incompatible_modes,
                         is_one_body(scene, tied), scene.mesh.source == "file" ? "" : scene.mesh.section()});
    neighbours = {foundation.get()};
    const auto listed = zone_materials(scene.concrete_zones, "Concrete/Zones");
    materials = materials_of(mesh.zones, scene.concrete, listed);
    sustained = materials;
    for (Material &material : sustained)
      material.young *= scene.sustained_ratio();
    concrete_zones = zones_of(mesh, false, scene.concrete, listed, "Concrete/Zones");
    if (foundation->uses_rock())
      rock_zones =
          zones_of(mesh, true, scene.foundation.rock, scene.foundation.zone_materials(), "Foundation/Zones");
    if (scene.mesh.plane_strain)
      check_plane_strain(scene, *foundation, opened);
    mesh_warnings = Voussoir::mesh_warnings(opened, scene, concrete_zones);
    assemble(opened, source);
    tie_base(tie_all);
    add_loads();
    foundation->add_mass(structure);
    for (const auto &probe : scene.output.probe_places())
      probe_node(*model, probe.first, {probe.second[0], probe.second[1], probe.second[2]});
    if (!has_open_bases && scene.loads.uplift.joints && scene.loads.uplift.below_closed_part != "none")
      mesh_warnings.push_back(
          "Entry \"Loads/Uplift/Below closed part\" has no effect: the dam has no base joint that can "
          "open. Remove it, or add base joints (surface \"base joint\").");
    find_lowest_base();
    check_water_level();
  }

  /** Returns the mesh of the monoliths with open joints. Sets the dimensions and numbers of the dam. */
  HexMesh Dam::open_monoliths(const HexMesh &mesh, const std::string &source, const bool tie_all)
  {
    const HexMesh concrete = monoliths_only(mesh);
    volume = Voussoir::volume(concrete);
    crest_length = Voussoir::crest_length(concrete);
    const auto box = bounding_box(concrete);
    size =
        std::hypot(box.second[0] - box.first[0], box.second[1] - box.first[1], box.second[2] - box.first[2]);
    n_cells = concrete.cells.size();
    n_monoliths = Voussoir::n_monoliths(concrete);
    HexMesh opened = merge_tied_lifts(open_joints(concrete), scene, tie_all, merged_lifts);
    if (scene.foundation.model != "rigid" && !tie_all && has_open_base(opened, scene))
      opened = with_footings(opened);
    for (const Joint &joint : joints_of(opened))
    {
      for (int number = joints.size() + 1; number < joint.number; ++number)
        joints.push_back({number, number, number + 1}); // without faces
      joints.push_back(joint);
      if (joint.is_contraction())
        n_joints = std::max<unsigned int>(n_joints, joint.contraction_number());
    }
    check_joint_numbers(opened, source);
    return opened;
  }

  void Dam::choose_laws(const bool tie_all)
  {
    tied = true;
    for (const Joint &joint : joints)
    {
      joint_models.push_back(tie_all ? "tied" : scene.joints.model_of(joint));
      initial_gaps.push_back(tie_all ? 0. : scene.joints.gap_of(joint));
      tied = tied && joint_models.back() == "tied";
      laws.of_joint.push_back(make_joint_law(joint_models.back(), scene.joints.law(scene.concrete.young)));
      if (initial_gaps.back() > 0. && joint_models.back() == "tied")
        throw InputError("Entry \"Joints/Initial gaps\" has a gap of " + joint.name() +
                         ", but this joint is tied. Set another model (\"Joints/Model\" or "
                         "\"Joints/Overrides\"), or remove the gap.");
    }
    for (const auto &joint : scene.joints.overrides)
      joints_named(joint.first, "Entry \"Joints/Overrides\" names ");
    for (const auto &joint : scene.joints.gaps)
      joints_named(joint.first, "Entry \"Joints/Initial gaps\" names ");
  }

  std::vector<std::size_t> Dam::joints_named(const std::string &key, const std::string &what) const
  {
    std::vector<std::size_t>           named;
    std::map<std::string, std::string> examples; // a name of each kind
    for (std::size_t j = 0; j < joints.size(); ++j)
    {
      const std::vector<std::string> keys = joints[j].keys();
      if (std::find(keys.begin(), keys.end(), key) != keys.end())
        named.push_back(j);
      examples[joints[j].kind()] = keys[joints[j].is_contraction()];
    }
    if (!named.empty() || key == "contraction" || merged_lifts.count(key) > 0)
      return named;
    std::string text;
    for (const auto &[kind, name] : examples)
      text += (text.empty() ? "" : ", ") + name + ", " + kind;
    throw InputError(
        what +
        (std::isdigit(static_cast<unsigned char>(key[0])) ? "joint " + key : "the joint \"" + key + "\"") +
        ", but the dam has " + std::to_string(joints.size()) +
        " joints, and none with this number, name or kind (such as " + (text.empty() ? "contraction" : text) +
        "). Correct or remove it.");
  }

  bool Dam::is_tied(const std::size_t pair) const
  {
    return joint_models[structure.pairs[pair].joint] == "tied" ||
           laws.of_pair[pair] == laws.of_joint.back().get();
  }

  bool Dam::is_one_body(const Scene &scene, const bool tied)
  {
    return tied || impact_rule(scene.impact_rule) != ImpactRule::mean_force || scene.contact.write_problems;
  }

  /** Creates the model and the structure with the foundation. */
  void Dam::assemble(const HexMesh &opened, const std::string &source)
  {
    model = std::make_unique<SolidModel>(opened, scene.elements.degree);
    model->plane_strain = scene.mesh.plane_strain;
    const bool        incompatible_modes = scene.elements.incompatible_modes;
    const auto        n_all = static_cast<unsigned int>(joints.size());
    std::vector<Pair> pairs = find_pairs(*model, n_all);
    structure = assemble_structure(*model, materials, incompatible_modes);
    geometry = std::make_unique<DamGeometry>(*model, pairs, n_all, source);
    initial_stress.assign(model->n_nodes(), Stress{});
    if (scene.statics.self_weight == "staged")
      stage_self_weight(); // on a rigid base; later displacements are relative to this state
    if (has_parts(joints))
    {
      model = std::make_unique<SolidModel>(opened, scene.elements.degree);
      model->plane_strain = scene.mesh.plane_strain;
      tie_parts(joints, &joint_models, *model);
      structure = assemble_structure(*model, materials, incompatible_modes);
      pairs = find_pairs(*model, n_all);
    }
    if (foundation->base() != Foundation::Base::fixed)
    {
      model->free_base();
      if (foundation->base() == Foundation::Base::merged)
        tie_base_nodes(*model, n_all); // the monoliths share their base nodes
      structure = assemble_structure(*model, materials, incompatible_modes);
      pairs = find_pairs(*model, n_all);
      if (foundation->base() == Foundation::Base::coupled)
        remove_base_pairs(pairs);
      geometry = std::make_unique<DamGeometry>(*model, pairs, n_all, source);
    }
    if (tied && n_joints + has_parts(joints) > 0)
    {
      tie_joints(*model, n_all);
      structure = assemble_structure(*model, materials, incompatible_modes);
    }
    else if (!tied)
    {
      structure.pairs = std::move(pairs);
      open_base_joints();
      cross_joints();
      geometry = std::make_unique<DamGeometry>(*model, structure.pairs, n_all, source);
    }
    structure.mass_damping = scene.damping.mass_factor();
    structure.stiffness_damping = scene.damping.stiffness_factor();
    foundation->add_stiffness(*model, structure);
    structure.n_joints = tied ? 0 : n_all;
    structure.collect_interfaces();
  }

  /** Frees the nodes of base joints that are not tied, and finds their pairs. Where a contraction joint meets the
   * base, the two nodes have pairs with the ground only, so that no node belongs to two pairs. */
  void Dam::open_base_joints()
  {
    std::set<int> sides;
    for (std::size_t j = 0; j < joints.size(); ++j)
      if (joints[j].is_base() && joint_models[j] != "tied")
        sides.insert(PhysicalId::joint_side_2 + joints[j].number);
    has_open_bases = !sides.empty();
    if (!has_open_bases)
      return;
    if (scene.loads.uplift.joints && scene.loads.uplift.base)
      throw InputError(
          "With base joints, either \"Loads/Uplift/Joints\" or \"Loads/Uplift/Base\" can be true: the "
          "full pressure in open pairs of the base, or the pressure below the whole base. Set one of "
          "them to false.");
    if (foundation->base() == Foundation::Base::merged)
      throw InputError(
          "Base joints on massless rock require \"Dynamics/Impact\" = mean-force and "
          "\"Contact/Write problems\" = false. Set these entries, or \"Joints/Overrides\" = base: tied.");
    if (foundation->uses_rock()) // the joints lie between dam and footings
      return;
    model->free_base_joints(sides);
    structure = assemble_structure(*model, materials, scene.elements.incompatible_modes);
    std::vector<Pair>     &pairs = structure.pairs = find_pairs(*model, joints.size());
    std::set<unsigned int> standing;
    for (const Pair &pair : pairs)
      if (joints[pair.joint].is_base())
        standing.insert(pair.node_2);
    pairs.erase(std::remove_if(pairs.begin(), pairs.end(),
                               [&](const Pair &pair) {
                                 return !joints[pair.joint].is_base() &&
                                        standing.count(pair.node_1) + standing.count(pair.node_2) > 0;
                               }),
                pairs.end());
    group_by_monolith(joints, structure);
    find_weight_on_joints();
  }

  /** Finds the clusters of pairs where joints cross, and checks that their joints can. */
  void Dam::cross_joints()
  {
    if (has_parts(joints))
      group_by_monolith(joints, structure);
    remove_keys_at_base(joints, joint_models, structure);
    structure.clusters = clusters_of(structure.pairs);
    has_open_lifts = std::any_of(joints.begin(), joints.end(),
                                 [&](const Joint &joint)
                                 { return joint.is_lift() && joint_models[joint.number - 1] != "tied"; });
    for (const auto &cluster : structure.clusters)
      for (const unsigned int p : cluster)
        if (const unsigned int j = structure.pairs[p].joint; joint_models[j] == "KSM")
          throw InputError(
              "The law of " + joints[j].name() +
              " is KSM, but the joint crosses other joints, and shear keys cannot cross joints. Set "
              "\"Joints/Overrides\" to \"lift: tied\" or \"base: tied\", or the model of this joint to FJA, FJB or "
              "cohesive.");
    if (has_open_lifts || (has_open_bases && foundation->uses_rock()))
      find_weight_on_joints();
  }

  /** Finds the load of the staged weight on free nodes of base and lift joints. Displacements are relative to the
   * state after the self-weight, in which these joints and the rock already carry it. */
  void Dam::find_weight_on_joints()
  {
    weight_on_joints.assign(3 * std::size_t(structure.n_nodes()), 0.);
    for (unsigned int i = 0; i < model->n_nodes() && !staged_reaction.empty(); ++i)
      if (const unsigned int e = model->equation[i];
          e != rigid_ground && !(foundation->uses_rock() && model->on_surface(i, PhysicalId::base)))
        for (unsigned int c = 0; c < 3; ++c)
          weight_on_joints[3 * e + c] -= staged_reaction[3 * i + c];
    for (const Pair &pair : structure.pairs) // at the border of a bonded part of the base
      if (joints[pair.joint].is_base() && pair.node_1 != rigid_ground && staged_reaction.size() > 0)
        set(weight_on_joints, pair.node_2, Vector3{} - get(weight_on_joints, pair.node_1));
    structure.remove_held_forces(weight_on_joints);
  }

  bool Dam::has_sustained_moduli() const
  {
    return scene.sustained_ratio() != 1. ||
           (foundation->uses_rock() && scene.foundation.sustained_ratio() != 1.);
  }

  Structure Dam::sustained_structure() const
  {
    Structure    result = structure;
    const double ratio = scene.sustained_ratio();
    for (Body &body : result.bodies)
      for (Matrix3 &block : body.stiffness.value)
        for (double &x : block)
          x *= ratio;
    foundation->add_sustained_stiffness(ratio, result);
    return result;
  }

  /** Removes the pairs at the base, which the foundation couples. */
  void Dam::remove_base_pairs(std::vector<Pair> &pairs) const
  {
    const std::set<unsigned int> base = nodes_of_base();
    pairs.erase(std::remove_if(pairs.begin(), pairs.end(),
                               [&](const Pair &pair)
                               { return base.count(pair.node_1) > 0 && base.count(pair.node_2) > 0; }),
                pairs.end());
  }

  std::set<unsigned int> Dam::nodes_of_base() const
  {
    std::set<unsigned int> base;
    for (unsigned int i = 0; i < model->n_nodes(); ++i)
      if (model->on_surface(i, PhysicalId::base))
        base.insert(model->equation[i]);
    return base;
  }

  /** Assigns the laws of the pairs. Pairs at the base are tied if the foundation requires it. */
  void Dam::tie_base(const bool tie_all)
  {
    if (!structure.clusters.empty() && impact_rule(scene.impact_rule) != ImpactRule::mean_force)
    {
      std::set<unsigned int> crossing;
      for (const unsigned int p : structure.clusters[0])
        crossing.insert(structure.pairs[p].joint);
      std::string names;
      for (const unsigned int j : crossing)
        names += (names.empty() ? "" : ", ") + joints[j].name();
      throw InputError("Joints cross at " + place(structure.pairs[structure.clusters[0][0]].place) + " (" +
                       names + "), which requires \"Dynamics/Impact\" = mean-force, not " +
                       scene.impact_rule + ".");
    }
    laws.of_crossings = laws_of_crossings(scene, structure, joint_models);
    laws.assign(structure);
    if (laws.need_mean_force() && impact_rule(scene.impact_rule) != ImpactRule::mean_force)
      throw InputError("The joint models " + joint_laws_of_mean_force() +
                       " require \"Dynamics/Impact\" = mean-force, not " + scene.impact_rule + ".");
    std::set<unsigned int> base;
    if (foundation->base() == Foundation::Base::tied)
      base = nodes_of_base();
    laws.of_joint.push_back(make_joint_law("tied", LawParameters()));
    for (std::size_t p = 0; p < structure.pairs.size(); ++p)
      if (base.count(structure.pairs[p].node_1) > 0 && base.count(structure.pairs[p].node_2) > 0)
        laws.of_pair[p] = laws.of_joint.back().get();
    for (const JointLaw *law : laws.of_pair)
      if (scene.contact.write_problems && !tie_all && law->flat_friction() < 0. && !law->surfaces_law())
        throw InputError("\"Contact/Write problems\" requires Coulomb friction in all joints. Set "
                         "\"Joints/Model\" to FJA or KSM, or remove the entry.");
  }

  void Dam::add_loads()
  {
    loads = static_loads(scene, {*model, structure, sustained});
    for (const StaticLoad &load : loads)
      for (std::size_t i = 0; i < load.stress.size(); ++i)
        for (unsigned int c = 0; c < 6; ++c)
          initial_stress[i][c] += load.stress[i][c];
    if (has_loose_blocks() && !staged_reaction.empty())
      loads.push_back({has_base_joints() ? "self-weight at the base" : "self-weight in lift joints",
                       false,
                       1.,
                       weight_on_joints,
                       {}});
    if (has_base_joints() && scene.loads.uplift.base && scene.loads.factor("uplift") != 0.)
      loads.push_back({uplift_load, true, scene.loads.factor("uplift"), uplift_at_base(), {}});
    if (scene.reservoir.density > 0. && scene.loads.factor("water") != 0.)
      added_mass = add_added_mass(*model, scene.reservoir, structure);
    if (const ReservoirParameters &r = scene.reservoir; r.is_meshed() && scene.loads.factor("water") != 0.)
    {
      water = std::make_unique<AcousticWater>(
          *model, structure, *foundation,
          WaterProperties{r.density, r.sound_speed, r.reflection, 0., r.length, r.element_size}, r.level,
          water_volumes.get());
      water->gravity = scene.statics.gravity * scene.loads.factor("water");
      neighbours.push_back(water.get());
      if (water_volumes != nullptr && r.element_size > 0.)
        mesh_warnings.push_back(
            "Entry \"Reservoir/Element size\" has no effect: the mesh file has volumes of the water. Remove it.");
    }
    inertia = inertial_loads(structure);
  }

  /** Returns the forces of the uplift on free base nodes, three values per free node [N]. The opposite forces act on
   * footings. */
  Unknowns Dam::uplift_at_base() const
  {
    std::set<int> closed;
    for (const Joint &joint : joints)
      if (joint.is_base() && joint_models[joint.number - 1] == "tied")
        closed.insert(PhysicalId::joint_side_2 + joint.number);
    const BaseUplift uplift = base_uplift(scene, *model, closed);
    Unknowns         force(3 * std::size_t(structure.n_nodes()), 0.);
    for (unsigned int i = 0; i < model->n_nodes(); ++i)
      for (unsigned int c = 0; c < 3 && model->equation[i] != rigid_ground; ++c)
        force[3 * model->equation[i] + c] += uplift.force[3 * i + c];
    for (const Pair &pair : structure.pairs)
      if (joints[pair.joint].is_base() && pair.node_1 != rigid_ground)
        for (unsigned int c = 0; c < 3; ++c)
          force[3 * pair.node_1 + c] -= force[3 * pair.node_2 + c];
    structure.remove_held_forces(force);
    return force;
  }

  void Dam::check_water_level()
  {
    double top = -1e300, bottom = 1e300;
    for (unsigned int i = 0; i < model->n_nodes(); ++i)
      if (model->on_surface(i, PhysicalId::upstream))
      {
        top = std::max(top, model->points[i][2]);
        bottom = std::min(bottom, model->points[i][2]);
      }
    for (const LoadRow &load : load_table())
      if (load.level && load.acts(scene) && load.level(scene) > top + 1e-6 * (top - bottom))
      {
        std::ostringstream text;
        text << std::setprecision(8) << "Entry \"" << load.level_entry << "\" is " << load.level(scene)
             << " m, above the top of the dam at " << top
             << " m. Reduce it, or check the axes and the length unit of the mesh.";
        throw InputError(text.str());
      }
    has_water =
        scene.reservoir.density > 0. && scene.reservoir.level > bottom && scene.loads.factor("water") != 0.;
  }

  void Dam::find_lowest_base()
  {
    double bottom = 1e300;
    if (model->base_is_fixed) // nodes of base joints move relative to the ground
      return;
    for (unsigned int i = 0; i < model->n_nodes(); ++i)
      if (model->on_surface(i, PhysicalId::base))
        bottom = std::min(bottom, model->points[i][2]);
    for (unsigned int i = 0; i < model->n_nodes(); ++i)
      if (model->on_surface(i, PhysicalId::base) && model->equation[i] != rigid_ground &&
          model->points[i][2] < bottom + 1e-3)
        lowest_base.push_back(model->equation[i]);
  }

  Vector3 Dam::base_motion(const Unknowns &u) const
  {
    Vector3 mean{};
    for (const unsigned int node : lowest_base)
      for (unsigned int c = 0; c < 3; ++c)
        mean[c] += u[3 * node + c] / lowest_base.size();
    return mean;
  }

  /** Computes stress and reactions of free-standing monoliths, whose lifts are tied, under their weight. */
  void Dam::stage_self_weight()
  {
    if (has_parts(joints))
    {
      tie_parts(joints, nullptr, *model);
      structure = assemble_structure(*model, materials, scene.elements.incompatible_modes);
    }
    Unknowns     load(3 * structure.n_nodes(), 0.), u;
    const double weight = scene.loads.factor("weight") * scene.statics.gravity;
    add_weight(structure, weight, load);
    StepOperator operation;
    operation.stiffness = scene.sustained_ratio();
    JointSystem system(structure, JointLaws(), ContactParameters(), operation);
    system.solve_free(load, u);
    StressRecovery(*model, sustained, scene.elements.incompatible_modes,
                   scene.output.knows_tractions() ? faces_at_nodes(*model) : std::vector<NodeFace>(),
                   scene.output.knows_tractions())
        .apply(u, {}, initial_stress);
    if (const unsigned int e = model->equation[geometry->crown]; e != rigid_ground)
      self_weight_crown = {{u[3 * e], u[3 * e + 1], u[3 * e + 2]}};
    find_staged_reaction(weight, u);
  }

  /** Computes #staged_reaction: the residuals of the equilibrium at the fixed nodes, and of each block at the nodes of
   * lift joints.
   * @param weight gravity with the factor of the load combination [m/s^2]
   * @param u displacement of the free nodes under staged self-weight [m] */
  void Dam::find_staged_reaction(const double weight, const Unknowns &u)
  {
    staged_reaction.assign(3 * std::size_t(model->n_nodes()), 0.);
    std::vector<dealii::types::global_dof_index> dofs(model->grid->fe.n_dofs_per_cell());
    CellElasticity    elasticity(model->grid->fe, scene.elements.incompatible_modes);
    std::vector<bool> in_joint(model->n_nodes(), false);
    for (unsigned int i = 0; i < model->n_nodes(); ++i)
      in_joint[i] =
          std::any_of(model->surfaces[i].begin(), model->surfaces[i].end(),
                      [&](const int id)
                      { return is_joint_side(id) && joints[number_of_joint(id) - 1].is_inside_monolith(); });
    const auto is_fixed = [&](const auto node) { return model->equation[node] == rigid_ground; };
    const auto is_held = [&](const auto node) { return is_fixed(node) || in_joint[node]; };
    for (const auto &cell : model->grid->dof_handler.active_cell_iterators())
    {
      cell->get_dof_indices(dofs);
      if (std::none_of(dofs.begin(), dofs.end(), is_held))
        continue;
      elasticity.reinit(cell, model->material_of(cell->active_cell_index(), sustained));
      for (unsigned int i = 0; i < dofs.size(); ++i)
      {
        if (!is_held(dofs[i]))
          continue;
        Vector3 force = get(staged_reaction, dofs[i]);
        force[2] += weight * elasticity.mass[i];
        for (unsigned int j = 0; j < dofs.size(); ++j)
          if (!is_fixed(dofs[j]))
            add(force, elasticity.stiffness[i * dofs.size() + j] * get(u, model->equation[dofs[j]]));
        set(staged_reaction, dofs[i], force);
      }
    }
  }
} // namespace Voussoir
