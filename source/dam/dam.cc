// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/error.h>
#include <voussoir/dam/base_uplift.h>
#include <voussoir/dam/dam.h>
#include <voussoir/dam/dam_loads.h>
#include <voussoir/dam/mesh_warnings.h>
#include <voussoir/dynamics/impact.h>
#include <voussoir/foundation/foundation_table.h>
#include <voussoir/joints/pairs.h>
#include <voussoir/mesh/mesh_axes.h>
#include <voussoir/mesh/mesh_groups.h>
#include <voussoir/mesh/mesh_joints.h>
#include <voussoir/mesh/plane_section.h>
#include <voussoir/solid/solid_model.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <set>
#include <sstream>

namespace Voussoir
{
  namespace
  {
    /** Names the first bodies without base nodes, such as "monolith 2"; @p lifts false: of monoliths without any. */
    std::string bodies_without_base(const SolidModel &model, const bool lifts)
    {
      const auto part = [&](const unsigned int b)
      { return lifts ? static_cast<int>(b) : monolith_of(model.body_numbers[b]); };
      std::set<int> standing;
      for (unsigned int i = 0; i < model.n_nodes(); ++i)
        if (model.is_at_base(i))
          standing.insert(part(model.body[i]));
      std::string  names;
      unsigned int n = 0;
      for (unsigned int b = 0; b < model.n_bodies(); ++b)
        if (standing.count(part(b)) == 0 && ++n <= 3)
          names += (n == 1 ? "" : ", ") + physical_name(3, model.body_numbers[b]);
      return n <= 3 ? names : names + " and " + std::to_string(n - 3) + " others";
    }

    /** Throws InputError for a body without base nodes, before its stiffness is factorised alone. */
    void check_base(const SolidModel &model, const std::string &source, const char *why)
    {
      if (const std::string names = bodies_without_base(model, true); !names.empty())
        throw InputError(
            "mesh " + source + ": " + names + (names.find(',') == std::string::npos ? " has" : " have") +
            " no node on the surface \"base\", so nothing holds this part " + why +
            ". Extend its joints to the base, add its lowest faces to the surface, or, for blocks "
            "that only contact holds, set \"Statics/Self-weight\" to monolithic or none, with joints "
            "that are not tied.");
    }

    /** Adds warnings about what a dam has, but other blocks need not have. */
    void note_shape(Dam &dam)
    {
      std::vector<std::string> &warnings = dam.facts.warnings;
      dam.has_free_bodies = !bodies_without_base(*dam.model, true).empty();
      if (const std::string names = bodies_without_base(*dam.model, false); !names.empty())
        warnings.push_back(names +
                           ": no node on the surface \"base\", so only contact holds these blocks. If they "
                           "are part of a dam, extend their joints to the base.");
      if (!dam.geometry->has_crest)
        warnings.push_back(
            "the surfaces \"crest\" and \"upstream\" do not meet, or are missing. Results of the crest are "
            "those of the highest nodes of the mesh. For a dam, add both surfaces.");
      if (const auto &flat = dam.layout.without_keys; !flat.empty())
        warnings.push_back("Shear keys cannot cross joints: " + std::to_string(flat.size()) +
                           " joints with the law KSM, the first " + dam.layout.joints[*flat.begin()].name() +
                           ", are flat (FJA) at the nodes where they cross other joints.");
    }

  } // namespace

  Dam::Dam(const Scene &scene, const bool tie_all) : scene(scene), layout(scene, tie_all)
  {
    const HexMesh     mesh = scene.hex_mesh();
    const std::string source = scene.mesh.name();
    if (const std::string warning = check_axes_and_units(mesh, scene.mesh, source); !warning.empty())
      facts.warnings.push_back(warning);
    facts.groups = group_table(mesh);
    facts.remark = mesh.remark;
    water_volumes = mesh.water;
    facts.ungrouped = faces_without_group(mesh, scene.mesh.plane_strain);
    const HexMesh        opened = open_monoliths(mesh, source);
    FoundationParameters founded = scene.foundation;
    if (founded.coupling == "auto" && scene.impact_rule != "mean-force")
      founded.coupling = "partition"; // the other coupling requires mean forces
    if (scene.is_explicit())
      founded.coupling = "common step";
    if (scene.mesh.plane_strain)
    {
      check_plane_section(opened, source);
      check_plane_section(mesh, source);
      founded.plane_strain = true;
      founded.free_field = "columns"; // the sides of a slice cut no valley
    }
    foundation = make_foundation({founded, mesh, source, scene.elements.degree,
                                  scene.elements.incompatible_modes, is_one_body(scene, layout.tied),
                                  scene.mesh.source == "file" ? "" : scene.mesh.section()});
    neighbours = {foundation.get()};
    const auto listed = zone_materials(scene.concrete_zones, "Concrete/Zones");
    damped = materials = materials_of(mesh.zones, scene.concrete, listed);
    sustained = materials;
    for (Material &material : sustained)
      material.young *= scene.sustained_ratio();
    facts.concrete_zones = zones_of(mesh, false, scene.concrete, listed, "Concrete/Zones");
    zone_names = mesh.zones;
    std::map<std::string, Material> with_ratio;
    for (const auto &zone : scene.damping.zone_ratios())
      with_ratio[zone.first] = scene.concrete;
    zones_of(mesh, false, scene.concrete, with_ratio, "Damping/Zones"); // throws InputError
    if (foundation->uses_rock())
      facts.rock_zones =
          zones_of(mesh, true, scene.foundation.rock, scene.foundation.zone_materials(), "Foundation/Zones");
    for (const std::string &warning : mesh_warnings(opened, scene, facts.concrete_zones))
      facts.warnings.push_back(warning);
    assemble(opened, source);
    note_shape(*this);
    layout.assign_laws(structure, foundation->base() == Foundation::Base::tied ? nodes_of_base()
                                                                               : std::set<unsigned int>());
    add_loads();
    foundation->add_mass(structure);
    if (!layout.has_open_bases && scene.loads.uplift.joints && scene.loads.uplift.below_closed_part != "none")
      facts.warnings.push_back(
          "Entry \"Loads/Uplift/Below closed part\" has no effect: the dam has no base joint that can "
          "open. Remove it, or add base joints (surface \"base joint\").");
    find_lowest_base();
    check_water_level();
  }

  /** Returns the mesh of the monoliths with open joints. Sets the dimensions of the dam. */
  HexMesh Dam::open_monoliths(const HexMesh &mesh, const std::string &source)
  {
    const HexMesh concrete = monoliths_only(mesh);
    facts.volume = volume(concrete);
    facts.crest_length = crest_length(concrete);
    const auto box = bounding_box(concrete);
    size =
        std::hypot(box.second[0] - box.first[0], box.second[1] - box.first[1], box.second[2] - box.first[2]);
    facts.n_cells = concrete.cells.size();
    facts.n_monoliths = n_monoliths(concrete);
    return layout.open(concrete, source);
  }

  bool Dam::is_tied(const std::size_t pair) const
  {
    return layout.models[structure.pairs[pair].joint] == "tied" ||
           layout.laws.of_pair[pair] == layout.laws.of_joint.back().get();
  }

  bool Dam::is_one_body(const Scene &scene, const bool tied)
  {
    return (tied && (scene.is_for_modes || !scene.damping.is_uniform())) ||
           impact_rule(scene.impact_rule) != ImpactRule::mean_force || scene.contact.write_problems ||
           scene.is_explicit();
  }

  /** Creates the model and the structure with the foundation. */
  void Dam::assemble(const HexMesh &opened, const std::string &source)
  {
    model = std::make_unique<SolidModel>(opened, scene.elements.degree);
    model->plane_strain = scene.mesh.plane_strain;
    const bool        incompatible_modes = scene.elements.incompatible_modes;
    const auto        n_all = static_cast<unsigned int>(layout.joints.size());
    std::vector<Pair> pairs = find_pairs(*model, n_all);
    structure = assemble_structure(*model, materials, incompatible_modes);
    geometry = std::make_unique<DamGeometry>(*model, pairs, n_all, source);
    initial_stress.assign(model->n_nodes(), Stress{});
    if (scene.statics.self_weight == "staged")
    { // on a rigid base; later displacements are relative to this state
      if (layout.has_parts())
      {
        layout.tie_parts(*model, true);
        structure = assemble_structure(*model, materials, incompatible_modes);
      }
      check_base(*model, source, "under its staged self-weight");
      staged = staged_weight(scene, sustained, *model, structure, *geometry, layout.joints, initial_stress);
    }
    if (layout.has_parts())
    {
      model = std::make_unique<SolidModel>(opened, scene.elements.degree);
      model->plane_strain = scene.mesh.plane_strain;
      layout.tie_parts(*model, false);
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
    if (layout.tied && layout.n_contraction + layout.has_parts() > 0)
    {
      tie_joints(*model, n_all);
      structure = assemble_structure(*model, materials, incompatible_modes);
    }
    if (layout.tied)
      check_base(*model, source, "with tied joints");
    else
    {
      structure.pairs = std::move(pairs);
      open_base_joints();
      layout.cross(structure);
      if (layout.has_open_lifts || (layout.has_open_bases && foundation->uses_rock()))
        find_weight_on_joints();
      geometry = std::make_unique<DamGeometry>(*model, structure.pairs, n_all, source);
    }
    structure.damping = scene.damping.law();
    foundation->add_stiffness(*model, structure);
    structure.n_joints = layout.tied ? 0 : n_all;
    structure.collect_interfaces();
  }

  /** Frees the nodes of base joints that are not tied, and finds their pairs. Where a contraction joint meets the
   * base, the two nodes have pairs with the ground only, so that no node belongs to two pairs. */
  void Dam::open_base_joints()
  {
    const std::set<int> sides = layout.open_bases();
    if (!layout.has_open_bases)
      return;
    if (scene.loads.uplift.joints && scene.loads.uplift.base)
      throw InputError(
          "With base joints, either \"Loads/Uplift/Joints\" or \"Loads/Uplift/Base\" can be true: the "
          "full pressure in open pairs of the base, or the pressure below the whole base. Set one of "
          "them to false.");
    if (foundation->base() == Foundation::Base::merged)
      throw InputError(
          "Base joints on massless rock require \"Dynamics/Scheme\" = trapezoidal, \"Dynamics/Impact\" = mean-force and "
          "\"Contact/Write problems\" = false. Set these entries, or \"Joints/Overrides\" = base: tied.");
    if (foundation->uses_rock() && scene.is_explicit())
      throw InputError(
          "Base joints on rock require \"Dynamics/Scheme\" = trapezoidal, because the footings below them would "
          "need steps of about 0.02 ms. Set this entry, or leave out the base joints.");
    if (foundation->uses_rock()) // the joints lie between dam and footings
      return;
    model->free_base_joints(sides);
    structure = assemble_structure(*model, materials, scene.elements.incompatible_modes);
    std::vector<Pair>     &pairs = structure.pairs = find_pairs(*model, layout.joints.size());
    std::set<unsigned int> standing;
    for (const Pair &pair : pairs)
      if (layout.joints[pair.joint].is_base())
        standing.insert(pair.node_2);
    pairs.erase(std::remove_if(pairs.begin(), pairs.end(),
                               [&](const Pair &pair)
                               {
                                 return !layout.joints[pair.joint].is_base() &&
                                        standing.count(pair.node_1) + standing.count(pair.node_2) > 0;
                               }),
                pairs.end());
    layout.group_by_monolith(structure);
    find_weight_on_joints();
  }

  /** Finds the load of the staged weight on free nodes of base and lift joints. Displacements are relative to the
   * state after the self-weight, in which these joints and the rock already carry it. */
  void Dam::find_weight_on_joints()
  {
    weight_on_joints.assign(3 * std::size_t(structure.n_nodes()), 0.);
    for (unsigned int i = 0; i < model->n_nodes() && !staged.reaction.empty(); ++i)
      if (const unsigned int e = model->equation[i];
          e != rigid_ground && !(foundation->uses_rock() && model->on_surface(i, PhysicalId::base)))
        for (unsigned int c = 0; c < 3; ++c)
          weight_on_joints[3 * e + c] -= staged.reaction[3 * i + c];
    for (const Pair &pair : structure.pairs) // at the border of a bonded part of the base
      if (layout.joints[pair.joint].is_base() && pair.node_1 != rigid_ground && staged.reaction.size() > 0)
        set(weight_on_joints, pair.node_2, Vector3{} - get(weight_on_joints, pair.node_1));
    structure.remove_held_forces(weight_on_joints);
  }

  Unknowns Dam::initial_velocity() const
  {
    Unknowns v(3 * std::size_t(structure.n_nodes()), 0.);
    for (const auto &[block, velocity] : scene.initial_velocities())
    {
      bool found = false;
      for (unsigned int i = 0; i < model->n_nodes(); ++i)
        if (const int number = model->body_numbers[model->body[i]]; block == 0 || number == block)
        {
          found = true;
          if (model->equation[i] != rigid_ground)
            set(v, model->equation[i], velocity);
        }
      if (!found)
        throw InputError("Entry \"Dynamics/Initial velocity\" names " + physical_name(3, block) +
                         ", which is no block of the mesh, or is tied to another one. Correct the name.");
    }
    structure.remove_held_forces(v);
    return v;
  }

  bool Dam::has_sustained_moduli() const
  {
    return scene.sustained_ratio() != 1. ||
           (foundation->uses_rock() && scene.foundation.sustained_ratio() != 1.);
  }

  void Dam::set_damping(const double first_frequency)
  {
    structure.damping = scene.damping.law(first_frequency, facts.concrete_zones);
    bool differ = false;
    for (const Damping::Zone &zone : structure.damping.zones)
    {
      differ |= zone.scale != 1.;
      for (std::size_t i = 0; i < damped.size(); ++i)
        if (zone_names[i] == zone.name)
          damped[i].young = zone.scale * materials[i].young;
    }
    const bool has_undamped_rock =
        scene.is_for_modes && scene.foundation.model == "massless"; // ratios of modes
    if (!differ && !(has_undamped_rock && structure.damping.relaxes()))
      return;
    Structure scaled = assemble_structure(*model, damped, scene.elements.incompatible_modes);
    for (std::size_t b = 0; b < structure.bodies.size(); ++b)
      structure.bodies[b].damped = std::move(scaled.bodies[b].stiffness);
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

  void Dam::add_loads()
  {
    for (const LoadRow &load : load_table())
      if (load.traction && load.acts(scene) && scene.loads.factor(load.name) != 0. &&
          std::none_of(model->surfaces.begin(), model->surfaces.end(),
                       [&](const std::set<int> &surfaces) { return surfaces.count(load.surface) > 0; }))
        throw InputError("The load \"" + std::string(load.name) + "\" acts on the surface \"" +
                         physical_name(2, load.surface) +
                         "\", which the mesh does not have. Add it to the mesh, or "
                         "remove the load (water: \"Reservoir/Density\" = 0; others: section \"Loads\").");
    loads = static_loads(scene, {*model, structure, sustained});
    if (const double factor = scene.loads.factor("force history"); factor != 0.)
      forces = forces_in_time(scene, *model, structure, factor);
    for (const StaticLoad &load : loads)
      for (std::size_t i = 0; i < load.stress.size(); ++i)
        for (unsigned int c = 0; c < 6; ++c)
          initial_stress[i][c] += load.stress[i][c];
    if (has_loose_blocks() && !staged.reaction.empty())
      loads.push_back({has_base_joints() ? "self-weight at the base" : "self-weight in lift joints",
                       false,
                       1.,
                       weight_on_joints,
                       {}});
    if (has_base_joints() && scene.loads.uplift.base && scene.loads.factor("uplift") != 0.)
      loads.push_back({uplift_load, true, scene.loads.factor("uplift"), uplift_at_base(), {}});
    if (scene.reservoir.density > 0. && scene.loads.factor("water") != 0.)
    {
      facts.added_mass = add_added_mass(*model, scene.reservoir, structure);
      if (const std::string warning = added_mass_warning(*model, scene.reservoir); !warning.empty())
        facts.warnings.push_back(warning);
    }
    if (const ReservoirParameters &r = scene.reservoir; r.is_meshed() && scene.loads.factor("water") != 0.)
    {
      water =
          std::make_unique<AcousticWater>(*model, structure, *foundation,
                                          WaterProperties{r.density, r.sound_speed, r.reflection, 0.,
                                                          r.length, r.element_size, scene.mesh.plane_strain},
                                          r.level, water_volumes.get());
      water->gravity = scene.statics.gravity * scene.loads.factor("water");
      neighbours.push_back(water.get());
      if (water_volumes != nullptr && r.element_size > 0.)
        facts.warnings.push_back(
            "Entry \"Reservoir/Element size\" has no effect: the mesh file has volumes of the water. Remove it.");
    }
    inertia = inertial_loads(structure);
  }

  /** Returns the forces of the uplift on free base nodes, three values per free node [N]. The opposite forces act on
   * footings. */
  Unknowns Dam::uplift_at_base() const
  {
    std::set<int> closed;
    for (const Joint &joint : layout.joints)
      if (joint.is_base() && layout.models[joint.number - 1] == "tied")
        closed.insert(PhysicalId::joint_side_2 + joint.number);
    const BaseUplift uplift = base_uplift(scene, *model, closed);
    Unknowns         force(3 * std::size_t(structure.n_nodes()), 0.);
    for (unsigned int i = 0; i < model->n_nodes(); ++i)
      for (unsigned int c = 0; c < 3 && model->equation[i] != rigid_ground; ++c)
        force[3 * model->equation[i] + c] += uplift.force[3 * i + c];
    for (const Pair &pair : structure.pairs)
      if (layout.joints[pair.joint].is_base() && pair.node_1 != rigid_ground)
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
    std::vector<Vector3> places; // each once, however many monoliths stand on it
    for (unsigned int i = 0; i < model->n_nodes(); ++i)
      if (model->on_surface(i, PhysicalId::base) && model->equation[i] != rigid_ground &&
          model->points[i][2] < bottom + 1e-3)
      {
        lowest_base.push_back(model->equation[i]);
        places.push_back(model->points[i]);
      }
    const auto n_at = [&](const Vector3 &place)
    {
      return std::count_if(places.begin(), places.end(),
                           [&](const Vector3 &x) { return norm(x - place) < 1e-6 * size; });
    };
    double sum = 0.;
    for (const Vector3 &place : places)
    {
      share_of_base.push_back(1. / n_at(place));
      sum += share_of_base.back();
    }
    for (double &share : share_of_base)
      share /= sum;
  }

  Vector3 Dam::base_motion(const Unknowns &u) const
  {
    Vector3 mean{};
    for (std::size_t i = 0; i < lowest_base.size(); ++i)
      for (unsigned int c = 0; c < 3; ++c)
        mean[c] += share_of_base[i] * u[3 * lowest_base[i] + c];
    return mean;
  }

} // namespace Voussoir
