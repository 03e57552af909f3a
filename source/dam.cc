#include <voussoir/dam.h>
#include <voussoir/error.h>
#include <voussoir/mesh_joints.h>

#include <cmath>
#include <numeric>

namespace Voussoir
{
  Dam::Dam(const Scene &scene, const bool tie_all) : scene(scene)
  {
    const HexMesh mesh = make_mesh(scene.mesh, scene.directory);
    for (const HexMesh::Cell &cell : mesh.cells)
      if (!is_monolith(cell.volume))
        throw InputError(
            "The mesh has rock (volumes from id 1000 on). This version computes dams on a rigid base only: "
            "leave the rock out and mark the dam's foot as the surface \"base\".");
    volume = Voussoir::volume(mesh);
    crest_length = Voussoir::crest_length(mesh);
    const auto box = bounding_box(mesh);
    size =
        std::hypot(box.second[0] - box.first[0], box.second[1] - box.first[1], box.second[2] - box.first[2]);
    n_cells = mesh.cells.size();
    n_monoliths = Voussoir::n_monoliths(mesh);
    const HexMesh opened = open_joints(mesh);
    for (const Joint &joint : joints_of(opened))
      n_joints = std::max<unsigned int>(n_joints, joint.number);

    tied = true;
    for (unsigned int j = 1; j <= n_joints; ++j)
    {
      const std::string &law = tie_all ? "tied" : scene.joints.model_of(j);
      tied = tied && law == "tied";
      laws.of_joint.push_back(make_joint_law(law, scene.joints.friction,
                                             equations_from_name(scene.joints.equations), scene.joints.keys));
    }
    for (const auto &entry : scene.joints.overrides)
      if (entry.first > n_joints)
        throw InputError("Entry \"Joints/Overrides\" names joint " + std::to_string(entry.first) +
                         ", but the dam has " + std::to_string(n_joints) + " joints.");

    model = std::make_unique<SolidModel>(opened, scene.elements.degree);
    const bool        incompatible_modes = scene.elements.incompatible_modes;
    std::vector<Pair> pairs = find_pairs(*model, n_joints);
    structure = assemble_structure(*model, {scene.concrete}, incompatible_modes);
    geometry = std::make_unique<DamGeometry>(*model, pairs, n_joints);
    initial_stress.assign(model->n_nodes(), Stress{});
    if (scene.statics.self_weight == "staged")
      stage_self_weight();
    if (tied && n_joints > 0)
    {
      model->tie_joints(n_joints);
      structure = assemble_structure(*model, {scene.concrete}, incompatible_modes);
    }
    else
      structure.pairs = std::move(pairs);
    structure.n_joints = tied ? 0 : n_joints;
    structure.mass_damping = scene.damping.mass_factor();
    structure.stiffness_damping = scene.damping.stiffness_factor();
    structure.collect_interfaces();
    laws.assign(structure.pairs);

    const std::size_t n = 3 * structure.n_nodes();
    weight.assign(n, 0.);
    water.assign(n, 0.);
    add_weight(structure, scene.statics.gravity, weight);
    if (scene.reservoir.density > 0.)
    {
      add_water_pressure(*model, scene.reservoir, scene.statics.gravity, water);
      if (scene.reservoir.added_mass != "none")
        added_mass = add_westergaard_mass(*model, scene.reservoir, structure);
    }
    inertia = inertial_loads(structure);

    double top = -1e300, bottom = 1e300;
    for (unsigned int i = 0; i < model->n_nodes(); ++i)
      if (model->on_surface(i, PhysicalId::upstream))
      {
        top = std::max(top, model->points[i][2]);
        bottom = std::min(bottom, model->points[i][2]);
      }
    if (scene.reservoir.density > 0. && scene.reservoir.level > top + 1e-6 * (top - bottom))
      throw InputError("Entry \"Reservoir/Water level\" is " + std::to_string(scene.reservoir.level) +
                       " m, above the dam, which ends at " + std::to_string(top) +
                       " m. Lower the water, or check the axes and the length unit of the mesh.");
    has_water = scene.reservoir.density > 0. && scene.reservoir.level > bottom;
  }

  void Dam::stage_self_weight()
  {
    Unknowns load(3 * structure.n_nodes(), 0.), u;
    add_weight(structure, scene.statics.gravity, load);
    JointSystem system(structure, JointLaws(), ContactParameters(), 0., 1., 0.);
    system.solve_free(load, u);
    StressRecovery(*model, {scene.concrete}, scene.elements.incompatible_modes).apply(u, initial_stress);
    if (const unsigned int e = model->equation[geometry->crown]; e != rigid_ground)
      self_weight_crown = {{u[3 * e], u[3 * e + 1], u[3 * e + 2]}};
  }

  Unknowns Dam::static_load(const double water_part) const
  {
    Unknowns load = water;
    for (std::size_t i = 0; i < load.size(); ++i)
      load[i] = water_part * water[i] + (scene.statics.self_weight == "monolithic" ? weight[i] : 0.);
    return load;
  }
} // namespace Voussoir
