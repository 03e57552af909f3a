// SPDX-License-Identifier: GPL-3.0-or-later
// Forces of the foundation on the bases of the monoliths: from the cells there (BaseForces), against the
// balance of momentum of each whole monolith, and against closed forms; rock wedges on parts of the base.
// Usage: base_forces rigid|rock|wall|equilibrium|wedge_files

#include <voussoir/dam/base_force.h>
#include <voussoir/dynamics/integrator_table.h>
#include <voussoir/mesh/gmsh_io.h>
#include <voussoir/motion/ground_motion.h>
#include <voussoir/solid/solid_grid.h>

#include "grids.h"
#include "testing.h"
#include "wedges.h"

#include <cstring>
#include <numeric>

using namespace Voussoir;
using namespace Testing;

namespace
{
  Vector3 cross(const Vector3 &a, const Vector3 &b)
  {
    return {{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]}};
  }

  /** A force that acts at @p place, with its moment about the origin. */
  void add_at(Wrench &wrench, const Vector3 &place, const Vector3 &force)
  {
    const Vector3 moment = cross(place, force);
    for (unsigned int c = 0; c < 3; ++c)
      wrench[c] += force[c], wrench[3 + c] += moment[c];
  }

  Wrench about_origin(const BlockBase &base, const Wrench &wrench)
  {
    Wrench result{};
    add_at(result, base.centroid, {{wrench[0], wrench[1], wrench[2]}});
    for (unsigned int c = 0; c < 3; ++c)
      result[3 + c] += wrench[3 + c];
    return result;
  }

  /** Largest difference of forces and moments, over their sizes and a lever of 100 m. */
  double difference(const Wrench &a, const Wrench &b)
  {
    double size = 0., worst = 0.;
    for (unsigned int c = 0; c < 6; ++c)
    {
      const double lever = c < 3 ? 1. : 100.;
      size = std::max(size, std::abs(b[c]) / lever);
      worst = std::max(worst, std::abs(a[c] - b[c]) / lever);
    }
    return worst / size;
  }

  Scene arch()
  {
    Scene scene;
    scene.mesh.source = "arch210";
    scene.mesh.arch210.n_joints = 2;
    scene.mesh.arch210.elements_along = 6;
    scene.mesh.arch210.elements_up = 3;
    scene.mesh.arch210.elements_through = 1;
    scene.joints.model = "FJA";
    return scene;
  }

  /** Masses and loads of all nodes, each of one monolith, also where the base is held or shared. */
  struct Whole
  {
    explicit Whole(const Scene &scene) : dam(scene)
    {
      std::iota(dam.model->master.begin(), dam.model->master.end(),
                0); // each node alone, also of tied joints
      dam.model->free_base();
      structure = assemble_structure(*dam.model, dam.materials, scene.elements.incompatible_modes);
      load.assign(3 * structure.n_nodes(), 0.);
      for (const StaticLoad &one : static_loads(scene, {*dam.model, structure, dam.materials}))
        for (std::size_t k = 0; k < load.size(); ++k)
          load[k] += one.force[k];
      for (unsigned int i = 0; i < structure.n_nodes(); ++i)
        weight.push_back(structure.mass[i][8] * scene.statics.gravity);
      if (scene.reservoir.density > 0.)
        add_added_mass(*dam.model, scene.reservoir, structure);
    }

    /** Returns the forces that the foundation must exert on each monolith in this step, by number, about the origin. */
    std::map<int, Wrench> balance(const Dam &as_run, const StepOfDam &step, const bool staged) const
    {
      const double                                 factor = as_run.scene.loads.factor("weight");
      std::map<int, Wrench>                        result;
      const SolidModel                            &model = *dam.model;
      std::vector<bool>                            seen(model.n_nodes(), false);
      std::vector<dealii::types::global_dof_index> dofs(model.grid->fe.n_dofs_per_cell());
      for (const auto &cell : model.grid->dof_handler.active_cell_iterators())
      {
        cell->get_dof_indices(dofs);
        for (const auto i : dofs)
        {
          if (seen[i])
            continue;
          seen[i] = true;
          const unsigned int e = as_run.model->equation[i], all = model.equation[i];
          Vector3            a = step.ground;
          if (e != rigid_ground)
            for (unsigned int c = 0; c < 3; ++c)
              a[c] = step.acceleration[3 * e + c] +
                     as_run.structure.damping.mass *
                         ((step.after[3 * e + c] - step.before[3 * e + c]) / step.dt - step.base_velocity[c]);
          Vector3 force = structure.mass[all] * a - get(load, all);
          if (staged)
            force[2] += factor * weight[all];
          add_at(result[cell->material_id()], {{model.points[i][0], model.points[i][1], model.points[i][2]}},
                 force);
        }
      }
      std::set<unsigned int> base;
      for (unsigned int i = 0; i < model.n_nodes(); ++i)
        if (model.on_surface(i, PhysicalId::base))
          base.insert(as_run.model->equation[i]);
      for (std::size_t p = 0; p < as_run.structure.pairs.size(); ++p)
      {
        const Pair &pair = as_run.structure.pairs[p];
        if (base.count(pair.node_1) > 0 &&
            base.count(pair.node_2) > 0) // base nodes: the foundation ties the monoliths there
          continue;
        const Vector3 f = get(step.joint_force, p);
        Vector3       on_2{};
        for (unsigned int i = 0; i < 3; ++i)
          add(on_2, scaled(f[i], pair.frame[i]));
        add_at(result[int(pair.joint) + 1], pair.place, on_2); // minus the joint force on side 1, -f
        add_at(result[int(pair.joint) + 2], pair.place, scaled(-1., on_2));
      }
      return result;
    }

    Dam                 dam;
    Structure           structure;
    Unknowns            load;
    std::vector<double> weight;
  };

  /** Forces on the whole base as one part, and on two parts without and with a cut through a monolith. */
  struct Parts
  {
    explicit Parts(Dam &dam)
    {
      const auto add = [&](const std::function<bool(const Vector3 &)> &contains)
      {
        parts.push_back(base_part(*dam.model, contains));
        forces.emplace_back(dam, std::vector<double>(), &parts.back());
      };
      add([](const Vector3 &) { return true; });
      for (const double y : {10., 5.})
      {
        add([y](const Vector3 &x) { return x[1] < y; });
        add([y](const Vector3 &x) { return x[1] >= y; });
      }
    }

    /** Largest difference to @p sum, the wrench about the origin of the monoliths together. */
    double difference_to(const Wrench &sum, const StepOfDam &step) const
    {
      std::vector<Wrench> found;
      for (const BaseForces &one : forces)
        found.push_back(about_origin(one.bases()[0], one.of(step)[0]));
      for (unsigned int c = 0; c < 6; ++c)
        found[1][c] += found[2][c], found[3][c] += found[4][c];
      return std::max({difference(found[0], sum), difference(found[1], sum), difference(found[3], sum)});
    }

    std::vector<BasePart>   parts;
    std::vector<BaseForces> forces;
  };

  /** Both ways through a sudden load and a shaking: the largest difference of any step. @p each: of every
   * monolith; else of all together. */
  double momentum(const Scene &scene, const bool each, const double dt = .01, const unsigned int n = 40)
  {
    Dam dam(scene);
    dam.set_damping(0.);
    const Whole      whole(scene);
    const BaseForces forces(dam);
    const Parts      parts(dam);
    const bool       staged = scene.statics.self_weight == "staged";
    GroundMotion     motion;
    motion.dt = dt;
    for (unsigned int k = 0; k <= n; ++k)
      motion.acceleration.push_back(
          {{2. * std::sin(17. * k * dt), std::cos(23. * k * dt), std::sin(29. * k * dt)}});
    const TimeGrid grid{dt, scene.foundation.n_substeps(), n};
    const Unknowns zero(3 * dam.structure.n_nodes(), 0.), none(3 * dam.structure.pairs.size(), 0.);
    Unknowns       steady = zero;
    for (const StaticLoad &load : dam.loads)
      for (std::size_t k = 0; k < steady.size(); ++k)
        steady[k] += load.force[k];
    dam.foundation->start(motion, grid, zero);
    const auto owner = make_integrator(
        scene.scheme, {dam.structure, dam.layout.laws, scene.contact, dt, ImpactRule::mean_force,
                       dam.foundation->support(dam.structure), false, scene.is_explicit() ? 4u : 1u});
    Integrator &newmark = *owner;
    const bool  moves = dam.foundation->moves_base();
    const auto  load_at = [&](const unsigned int k)
    {
      Unknowns load = steady;
      for (std::size_t i = 0; moves && i < load.size(); ++i)
        for (unsigned int d = 0; d < 3; ++d)
          load[i] += motion.acceleration[k][d] * dam.inertia[d][i];
      return load;
    };
    newmark.start(zero, zero, none, load_at(0), none);
    double worst = 0.;
    bool   moved = false;
    for (unsigned int k = 1; k <= n; ++k)
    {
      Unknowns load = load_at(k);
      dam.foundation->advance(load);
      const DynamicState  before = newmark.state();
      const ContactResult result = newmark.advance(load, dam.foundation->base_velocity());
      expect(result.path != ContactPath::smaller_step, "no step is halved");
      dam.foundation->update_from_dam(newmark.state());
      for (const PairState state : newmark.pair_states())
        moved = moved || state != PairState::stick;
      const DynamicState &after = newmark.state();
      Vector3             ground{}, velocity{};
      for (unsigned int c = 0; c < 3; ++c)
      {
        const double weight = newmark.weight_of_end();
        ground[c] =
            moves ? (1. - weight) * motion.acceleration[k - 1][c] + weight * motion.acceleration[k][c] : 0.;
        velocity[c] = .5 * (before.base_velocity[c] + after.base_velocity[c]);
      }
      Unknowns a(zero), f = newmark.impulses();
      for (std::size_t i = 0; i < a.size(); ++i)
        a[i] = (after.v[i] - before.v[i]) / dt + ground[i % 3];
      for (double &x : f)
        x /= dt;
      const StepOfDam step{
          before.u, after.u, a, f, ground, velocity, dt, {}, after.relaxation.mean, after.relaxation.lag};
      const auto ours = forces.of(step);
      const auto theirs = whole.balance(dam, step, staged);
      Wrench     our_sum{}, their_sum{};
      expect(ours.size() == theirs.size() && ours.size() == forces.bases().size(),
             "a base for each monolith");
      for (std::size_t b = 0; b < ours.size(); ++b)
      {
        const Wrench mine = about_origin(forces.bases()[b], ours[b]),
                     &other = theirs.at(forces.bases()[b].monolith);
        if (each)
          worst = std::max(worst, difference(mine, other));
        for (unsigned int c = 0; c < 6; ++c)
          our_sum[c] += mine[c], their_sum[c] += other[c];
      }
      worst = std::max({worst, difference(our_sum, their_sum), parts.difference_to(our_sum, step)});
    }
    expect(moved || dam.layout.tied, "joints open or slide");
    return worst;
  }

  /** Two monoliths. The base of one is a layer higher: at the lower end of their joint one node of each pair
   * is fixed. @p first: the base of the first monolith is the higher one. */
  void write_step(const std::string &file, const bool first)
  {
    const std::array<unsigned int, 3> n = {{2, 4, 6}};
    const unsigned int                split = 2;
    const Grids::Brick                brick{n};
    HexMesh                           mesh = Grids::wall({{10., 20., 30.}}, n, split), step = mesh;
    const auto                        is_gone = [&](const auto &nodes) // below z = 5, on its side of y = 10
    {
      const auto x = centre(mesh, nodes);
      return (x[1] < 10.) == first && x[2] < 5. - 1e-9;
    };
    step.cells.clear();
    step.faces.clear();
    for (const HexMesh::Cell &cell : mesh.cells)
      if (!is_gone(cell.nodes))
        step.cells.push_back(cell);
    for (const HexMesh::Face &face : mesh.faces)
      if (!is_gone(face.nodes))
        step.faces.push_back(face);
    for (unsigned int j = first ? 0 : split; j < (first ? split : n[1]); ++j)
      for (unsigned int i = 0; i < n[0]; ++i)
        step.faces.push_back({{brick.node(i, j, 1), brick.node(i + 1, j, 1), brick.node(i + 1, j + 1, 1),
                               brick.node(i, j + 1, 1)},
                              PhysicalId::base});
    normalize(step);
    write_gmsh(step, file);
  }

  void rigid()
  {
    Scene stepped;
    stepped.mesh.source = "file";
    stepped.mesh.file = "step_of_blocks.msh";
    stepped.directory = ".";
    stepped.joints.model = "FJA";
    stepped.reservoir.level = 28.;
    for (const bool first : {false, true})
    {
      const std::string which = first ? "first" : "second";
      write_step(stepped.mesh.file, first);
      below("a base with a step under the " + which + " monolith", momentum(stepped, true), 1e-11);
      // Water of 1 MPa in the joint: its force on the fixed nodes of the joint, whose part is 10 m x 2.5 m.
      Dam              dam(stepped);
      const BaseForces dry(dam), wet(dam, std::vector<double>(dam.structure.pairs.size(), 1e6));
      const Unknowns   zero(3 * dam.structure.n_nodes(), 0.), none(3 * dam.structure.pairs.size(), 0.);
      const StepOfDam  still{zero, zero, zero, none};
      const auto       without = dry.of(still), with = wet.of(still);
      for (unsigned int b = 0; b < 2; ++b)
      {
        const double push = with[b][1] - without[b][1], expected = (b == 0) == first ? 2.5e7 : 0.;
        expect_within(push, first ? expected : -expected, 1e-3, "water on the fixed nodes of the joint");
      }
    }
    stepped.loads.combinations["heavy"] = "weight 1.5, water";
    stepped.loads.combination = "heavy";
    below("staged weight with a factor", momentum(stepped, true), 1e-11);
    stepped.loads.combination = "";
    below("joints that open and slide, each monolith", momentum(arch(), true), 1e-11);
    stepped.elements.degree = 2;
    stepped.statics.self_weight = "monolithic";
    below("degree 2, weight on the finished dam", momentum(stepped, true), 1e-11);
    Scene scene = arch();
    scene.joints.model = "tied";
    below("tied joints, all monoliths", momentum(scene, false), 1e-11);
    scene = arch();
    scene.loads.temperature.upstream = 20.;
    scene.loads.temperature.downstream = 5.;
    scene.loads.temperature.grouting = 10.;
    scene.loads.silt.level = 90.;
    scene.loads.tail_water.level = 40.;
    below("temperature, silt and tail water", momentum(scene, true), 1e-11);
    scene.damping.model = "uniform";
    scene.damping.reference_frequency = 2.;
    below("uniform damping", momentum(scene, true), 1e-11);
    HexMesh mesh = scene.hex_mesh();
    mesh.zones.push_back("low");
    for (HexMesh::Cell &cell : mesh.cells)
      cell.zone = mesh.nodes[cell.nodes[0]][2] < 60. ? mesh.zones.size() - 1 : 0;
    write_gmsh(mesh, "zones.msh");
    Scene zoned = scene;
    zoned.mesh.source = "file";
    zoned.mesh.file = "zones.msh";
    zoned.damping.zones = {{"low", "0.1"}};
    below("zones with damping ratios of their own", momentum(zoned, true), 1e-11);
    zoned.scheme = scene.scheme = "explicit";
    below("explicit scheme with steps of its own", momentum(scene, true, .04), 1e-11);
    below("the same with zones", momentum(zoned, true, .04), 1e-11);
    scene.scheme = "trapezoidal";
    scene.reservoir.density = 0.;
    scene.damping.ratio = 0.;
    below("no water, no damping", momentum(scene, true), 1e-11);
  }

  void rock()
  {
    Scene scene = arch();
    scene.mesh.arch210_rock.enabled = true;
    scene.mesh.arch210_rock.element_size = 60.;
    scene.foundation.model = "massless";
    below("massless rock, each monolith", momentum(scene, true), 1e-11);
    scene.foundation.model = "rock";
    below("rock, each monolith", momentum(scene, true, .002, 60), 1e-11);
    scene.foundation.substeps = 2;
    below("rock with steps of its own", momentum(scene, true, .004, 40), 1e-11);
  }

  /** A base with its lowest line at x = 2: it rises by .75 per m upstream and by 1/3 per m downstream. Area
   * of its projection on the mean plane, and centroid of its surface. */
  void notch()
  {
    const auto place = [](const Vector3 &x)
    {
      const double foot = x[0] < 2. ? .75 * (2. - x[0]) : (x[0] - 2.) / 3.;
      return Vector3{{x[0], x[1], foot + x[2] / 30. * (30. - foot)}};
    };
    write_gmsh(Grids::wall({{10., 20., 30.}}, {{5, 4, 6}}, 4, place), "notch.msh");
    Scene scene;
    scene.mesh.source = "file";
    scene.mesh.file = "notch.msh";
    scene.directory = ".";
    scene.reservoir.level = 28.;
    Dam             dam(scene);
    const BlockBase base = BaseForces(dam).bases().at(0);
    const double    rise = 8. / 3. - 1.5, length = 2. * 1.25 + 8. * std::sqrt(10.) / 3.;
    expect_close(base.area, 20. * std::hypot(10., rise), 1e-12, "area of the projection");
    expect_close(base.centroid[0], (2.5 * 1. + (length - 2.5) * 6.) / length, 1e-12, "centroid, x");
    expect_close(base.centroid[2], (2.5 * .75 + (length - 2.5) * 4. / 3.) / length, 1e-12, "centroid, z");
  }

  /** A wall of two monoliths, 10 m x (10 + 10) m, 30 m high, in one axis with the river: closed forms. */
  void wall()
  {
    notch();
    write_gmsh(Grids::wall({{10., 20., 30.}}, {{2, 4, 6}}, 2), "wall_of_blocks.msh");
    Scene scene;
    scene.mesh.source = "file";
    scene.mesh.file = "wall_of_blocks.msh";
    scene.directory = ".";
    scene.joints.model = "tied";
    scene.concrete.density = 2500.;
    scene.concrete.poisson = 0.;
    scene.statics.gravity = 10.;
    scene.reservoir.level = 25.; // levels of nodes
    scene.loads.uplift.base = true;
    scene.loads.tail_water.level = 5.;
    const double weight = 2500. * 10. * 10. * 10. * 30., push = 1e4 * 10. * (25. * 25. - 5. * 5.) / 2.;
    const double tilt = 1e4 * 10. * (25. * 25. * 25. - 5. * 5. * 5.) / 6.; // of the water about the base
    for (const char *weighing : {"staged", "monolithic"})
    {
      scene.statics.self_weight = weighing;
      Dam              dam(scene);
      const BaseForces forces(dam);
      JointSystem      system(dam.structure, JointLaws(), ContactParameters(), {});
      Unknowns         load(3 * dam.structure.n_nodes(), 0.), u;
      for (const StaticLoad &one : dam.loads)
        for (std::size_t k = 0; k < load.size(); ++k)
          load[k] += one.force[k];
      system.solve_free(load, u);
      const auto found = forces.of({u, u, {}, {}});
      expect(found.size() == 2, "two blocks");
      double normal = 0., stream = 0., arch = 0., overturning = 0., torsion = 0.;
      for (unsigned int b = 0; b < 2; ++b)
      {
        const BlockBase     &base = forces.bases()[b];
        const BaseResultants force = resultants(base, found[b]);
        expect_close(base.area, 100., 1e-12, "area");
        below("centroid", std::abs(base.centroid[0] - 5.) + std::abs(base.centroid[1] - (b == 0 ? 5. : 15.)),
              1e-10);
        below("axes",
              std::abs(base.axes[0][0] - 1.) + std::abs(base.axes[1][1] - 1.) +
                  std::abs(base.axes[2][2] - 1.),
              1e-12);
        expect_close(base.uplift, 1e4 * 100. * (25. + 5.) / 2., 1e-10, "uplift");
        normal += force.normal, stream += force.shear[0], arch += force.shear[1];
        overturning += force.moment[1], torsion += force.moment[2];
        // Each monolith alone, by symmetry, also where the joint is tied.
        below("each has half", std::abs(force.normal / -weight - 1.) + std::abs(force.shear[0] / -push - 1.),
              1e-10);
        const double compression = weight - 1e4 * 100. * 15.;
        expect_close(sliding_safety(base, force, .8, 2e5), (2e5 * 100. + .8 * compression) / push, 1e-8,
                     "safety against sliding");
        BlockBase dry = base;
        dry.uplift = 0.;
        expect_close(sliding_safety(dry, force, .8, 0.), .8 * weight / push, 1e-8, "safety without uplift");
        dry.uplift = 2. * weight;
        expect_close(sliding_safety(dry, force, .8, 2e5), 2e5 * 100. / push, 1e-8,
                     "lifted: the cohesion alone");
      }
      const std::string with = std::string(weighing) + ": ";
      below(with + "weight", normal / (2. * -weight) - 1., 1e-10);
      below(with + "push of the water", stream / (2. * -push) - 1., 1e-10);
      below(with + "across", arch / push, 1e-10);
      below(with + "overturning", overturning / (2. * -tilt) - 1., 1e-8);
      below(with + "torsion", torsion / tilt, 1e-10);
    }
  }
} // namespace

int main(int argc, char **argv)
{
  return run({{"rigid", rigid},
              {"rock", rock},
              {"wall", wall},
              {"equilibrium",
               []
               {
                 Wedges::incline();
                 Wedges::line_of_intersection();
                 Wedges::enumeration();
               }},
              {"wedge_files", Wedges::files}},
             argc, argv);
}
