// SPDX-License-Identifier: GPL-3.0-or-later
// Loads, stresses, places, oscillators and rock against closed forms. Usage: physics loads|model|newmark|rock

#include <voussoir/base/lanes.h>
#include <voussoir/contact/law_table.h>
#include <voussoir/dam/dam_geometry.h>
#include <voussoir/dam/dam_loads.h>
#include <voussoir/dam/face_pressure.h>
#include <voussoir/dam/reservoir.h>
#include <voussoir/dynamics/modes.h>
#include <voussoir/dynamics/newmark.h>
#include <voussoir/dynamics/spectrum_response.h>
#include <voussoir/joints/pairs.h>
#include <voussoir/mesh/gmsh_io.h>
#include <voussoir/mesh/mesh_joints.h>
#include <voussoir/mesh/mesh_source.h>
#include <voussoir/motion/motion.h>
#include <voussoir/motion/motion_report.h>
#include <voussoir/motion/spectrum_file.h>
#include <voussoir/rock/explicit_region.h>
#include <voussoir/rock/free_field.h>
#include <voussoir/rock/rock_model.h>
#include <voussoir/rock/viscous_boundary.h>
#include <voussoir/solid/stress.h>

#include "box.h"
#include "mesh_testing.h"

using namespace Voussoir;
using namespace MeshTesting;

namespace
{
  constexpr double thick = 10., wide = 20., tall = 30.;

  HexMesh wall(const unsigned int nx, const unsigned int ny, const unsigned int nz, const unsigned int split,
               const std::function<Vector3(const Vector3 &)> &place = nullptr)
  {
    return Grids::wall({{thick, wide, tall}}, {{nx, ny, nz}}, split, place);
  }

  Vector3 sum(const Unknowns &f)
  {
    Vector3 result{};
    for (std::size_t k = 0; k < f.size(); ++k)
      result[k % 3] += f[k];
    return result;
  }

  Matrix3 sum(const std::vector<Matrix3> &m)
  {
    Matrix3 result{};
    for (const Matrix3 &node : m)
      for (unsigned int k = 0; k < 9; ++k)
        result[k] += node[k];
    return result;
  }

  // Loads

  void weight_and_water()
  {
    SolidModel model(wall(2, 4, 6, 4), 1);
    model.free_base(); // no force is lost in a support
    Material concrete;
    concrete.density = 2400.;
    Structure    structure = assemble_structure(model, {concrete}, true);
    const double weight = 2400. * 9.81 * thick * wide * tall;
    Scene        scene;
    scene.statics.gravity = 9.81;
    for (const double level : {30., 25., 22.}) // between nodes, too
    {
      scene.reservoir.level = level;
      Unknowns load(3 * structure.n_nodes(), 0.);
      add_traction(
          model, PhysicalId::upstream,
          [&](const double z, const Vector3 &normal) { return water_traction(scene, 1., z, normal); }, load);
      const Vector3 force = sum(load);
      expect_close(force[0], 1000. * 9.81 * level * level / 2. * wide, 1e-3, "push of the water");
      expect(std::abs(force[1]) + std::abs(force[2]) < 1e-9 * force[0], "the water pushes along x");
      double moment = 0.;
      for (unsigned int i = 0; i < model.n_nodes(); ++i)
        moment += model.points[i][2] * load[3 * model.equation[i]];
      expect_close(moment, 1000. * 9.81 * std::pow(level, 3) / 6. * wide, 2e-3, "moment of the water");
    }

    // Westergaard: the integral of 7/8 rho sqrt(H h).
    scene.reservoir.level = 30.;
    const double expected = add_added_mass(model, scene.reservoir, structure);
    expect_close(expected, .875 * 1000. * wide * 2. / 3. * 900., 1e-3, "added mass, integral");
    const Matrix3 total = sum(structure.mass), added = sum(structure.added_mass);
    for (unsigned int k = 0; k < 9; ++k)
    {
      const double concrete_part = k % 4 == 0 ? weight / 9.81 : 0., water_part = k == 0 ? expected : 0.;
      expect(std::abs(added[k] - water_part) < 1e-9 * expected, "added mass along the normal only");
      expect(std::abs(total[k] - concrete_part - water_part) < 1e-9 * expected, "mass of concrete and water");
    }

    Unknowns load(3 * structure.n_nodes(), 0.);
    add_weight(structure, 9.81, load);
    expect_close(sum(load)[2], -weight, 1e-12, "weight, that of the concrete alone");
    const auto inertia = inertial_loads(structure);
    for (unsigned int d = 0; d < 3; ++d)
      expect_close(sum(inertia[d])[d], -total[4 * d], 1e-12, "inertia, water included");
  }

  /** The water level of a wall lies between nodes. Total and moment of the added mass are exact, and the mass of
   * each node is positive. With the formula at the nodes, the mass is 7/8 rho sqrt(H h) times the area. */
  void wet_mass()
  {
    for (const unsigned int degree : {1, 2})
      for (const double level : {30., 28.8, 26.3, 21.})
      {
        SolidModel model(wall(1, 4, 6, 4), degree);
        model.free_base();
        Structure           structure = assemble_structure(model, {Material()}, true);
        const auto          concrete = structure.mass;
        ReservoirParameters water;
        water.level = level;
        const double total = add_added_mass(model, water, structure), area = .875 * 1000. * wide;
        expect_close(total, area * 2. / 3. * level * level, 2e-3, "added mass");
        expect_close(sum(structure.added_mass)[0], total, 1e-12, "added mass of the nodes");
        double moment = 0.;
        for (unsigned int i = 0; i < model.n_nodes(); ++i)
        {
          const unsigned int e = model.equation[i];
          const double       m = structure.added_mass[e][0];
          moment += m * (level - model.points[i][2]);
          expect(m >= 0. && (m > 0.) == (model.points[i][0] == 0. && structure.mass[e][0] > concrete[e][0]),
                 "added masses are positive, and upstream");
        }
        expect_close(moment, area * .4 * level * level * level, 6e-3, "moment of the added mass");
      }
    SolidModel model(wall(2, 4, 6, 4), 1);
    model.free_base();
    Structure           structure = assemble_structure(model, {Material()}, true);
    ReservoirParameters water;
    water.level = 30.;
    double nodal = 0.; // the nodes' part of the height is 5 m, at the bottom 2.5
    for (unsigned int k = 0; k < 6; ++k)
      nodal += .875 * 1000. * std::sqrt(30. * (30. - 5. * k)) * wide * (k == 0 ? 2.5 : 5.);
    water.model = "Westergaard-nodal";
    expect_close(add_added_mass(model, water, structure), nodal, 1e-12, "added mass at the nodes");
    std::ofstream("mass.csv") << "\xEF\xBB\xBF"
                                 "depth,mass\n0,1000\n20,5000\n30,5000\n";
    water.model = "added mass table";
    water.table = "mass.csv";
    expect_close(add_added_mass(model, water, structure), (20. * 3000. + 10. * 5000.) * wide, 1e-3,
                 "added mass of a table");
    const std::vector<double> per_area = added_mass_per_area(model, water);
    for (unsigned int i = 0; i < model.n_nodes(); ++i)
      expect_close(per_area[i],
                   model.points[i][0] > 0. || model.points[i][2] >= 30.
                       ? 0.
                       : std::min(5000., 1000. + 200. * (30. - model.points[i][2])),
                   1e-12, "added mass per area of a table");
    water.level = 31.;
    throws<InputError>("short table", [&] { add_added_mass(model, water, structure); },
                       {"mass.csv", "ends at the depth 30 m", "31 m", "Extend"});
    water.level = 30.;
    for (const auto &[table, warning] : {std::make_pair("0 0\n30 11700\n", ""),
                                         {"0 0\n30 11600\n", "is 0.33"}, // 17500 / 3
                                         {"0 0\n30 104900\n", ""},
                                         {"0 0\n30 105200\n", "is 3.0"}})
    {
      std::ofstream("mass.csv") << table; // Westergaard's formula has a mean of 17500 kg/m2
      const std::string found = added_mass_warning(model, water);
      expect(found.empty() == (*warning == '\0') && found.find(warning) != std::string::npos, table + found);
    }
    for (const char *wrong : {"0 0\n1000 20\n5000 30\n", "0 20000\n30 5000\n"}) // exchanged; elevations
    {
      std::ofstream("mass.csv") << wrong;
      throws<InputError>("wrong table", [&] { add_added_mass(model, water, structure); },
                         {"mass.csv", "exchanged", "elevations", "30 m"});
    }
    water.table = "nothing.csv";
    throws<InputError>("no table", [&] { add_added_mass(model, water, structure); },
                       {"nothing.csv", "cannot be read", "depth [m]", "kg/m^2"});
  }

  /** The valley's bottom rises by 1 m in 2 m from the middle to the banks, and the upstream face leans. */
  void local_depth()
  {
    const auto place = [](const Vector3 &x)
    {
      const double bottom = .5 * std::abs(x[1] - 10.);
      return Vector3{{x[0] - .2 * x[2], x[1], bottom + x[2] / tall * (tall - bottom)}};
    };
    SolidModel model(wall(1, 4, 6, 4, place), 1);
    model.free_base();
    ReservoirParameters water;
    water.level = 28.;
    std::array<Structure, 2> structure;
    for (const bool local : {false, true})
    {
      water.depth = local ? "local" : "global";
      structure[local] = assemble_structure(model, {Material()}, true);
      const double mass = sum(structure[local].mass)[8];
      water.model = "Westergaard-nodal";
      add_added_mass(model, water, structure[local]);
      expect(sum(structure[local].added_mass)[8] > 1e-3 * mass, "added mass for vertical motion");
      Unknowns load(3 * structure[local].n_nodes(), 0.);
      add_weight(structure[local], 9.81, load);
      expect_close(sum(load)[2], -9.81 * mass, 1e-12, "the added mass has no weight");
    }
    unsigned int n = 0;
    for (unsigned int i = 0; i < model.n_nodes(); ++i)
      if (const double global = structure[0].added_mass[model.equation[i]][0]; global > 0.)
      {
        const double depth = 28. - .5 * std::abs(model.points[i][1] - 10.);
        expect_close(structure[1].added_mass[model.equation[i]][0] / global, std::sqrt(depth / 28.), 1e-12,
                     "added mass by the local depth over that by the global one");
        ++n;
      }
    expect(n == 30, "nodes under water"); // all except those of the crest
  }

  // Elements and stresses

  Unknowns field(const SolidModel &model, const std::function<Vector3(const Vector3 &)> &u)
  {
    Unknowns result(3 * std::size_t(model.first_equation.back()));
    for (unsigned int i = 0; i < model.n_nodes(); ++i)
      if (model.equation[i] != rigid_ground)
        for (unsigned int c = 0; c < 3; ++c)
          result[3 * model.equation[i] + c] = u(model.points[i])[c];
    return result;
  }

  void expect_stress(const SolidModel &model, const std::vector<Stress> &stress,
                     const std::function<std::array<double, 6>(const Vector3 &)> &exact, const double size,
                     const std::string &what)
  {
    for (unsigned int i = 0; i < model.n_nodes(); ++i)
      for (unsigned int c = 0; c < 6; ++c)
        expect(std::abs(stress[i][c] - exact(model.points[i])[c]) < 2e-5 * size,
               what + ", component " + std::to_string(c) + ": " + std::to_string(stress[i][c]) + ", not " +
                   std::to_string(exact(model.points[i])[c]));
  }

  void stresses()
  {
    Material m;
    m.young = 25e9;
    m.poisson = .2;
    const double mu = m.young / (2. * 1.2), lambda = m.young * .2 / (1.2 * .6);
    // A linear displacement on distorted elements: Hooke's law. Components xx, yy, zz, xy, yz, zx.
    const auto distort = [](const Vector3 &x) {
      return Vector3{{x[0] + .4 * std::sin(x[1] + x[2]), x[1] + .5 * std::sin(x[0] + x[2]), x[2]}};
    };
    for (const unsigned int degree : {1, 2})
    {
      SolidModel model(wall(2, 3, 3, 3, distort), degree);
      model.free_base();
      const double         e[6] = {1e-5, -2e-5, 4e-5, 3e-5, -1e-5, 2e-5}; // shear: angles
      std::vector<Stress>  stress;
      const StressRecovery recovery(model, {m}, true);
      recovery.apply(field(model,
                           [&](const Vector3 &x) {
                             return Vector3{{e[0] * x[0] + e[3] * x[1], e[1] * x[1] + e[4] * x[2],
                                             e[2] * x[2] + e[5] * x[0]}};
                           }),
                     {}, stress);
      const double trace = e[0] + e[1] + e[2];
      expect_stress(
          model, stress,
          [&](const Vector3 &)
          {
            return std::array<double, 6>{{lambda * trace + 2. * mu * e[0], lambda * trace + 2. * mu * e[1],
                                          lambda * trace + 2. * mu * e[2], mu * e[3], mu * e[4], mu * e[5]}};
          },
          1e6, "uniform stress, degree " + std::to_string(degree));
      // No force inside of the body under uniform stress (patch test).
      const Structure structure = assemble_structure(model, {m}, true);
      Unknowns        force;
      structure.multiply_stiffness(field(model,
                                         [&](const Vector3 &x) {
                                           return Vector3{{e[0] * x[0], e[1] * x[1] + e[4] * x[2], 0.}};
                                         }),
                                   force);
      for (unsigned int i = 0; i < model.n_nodes(); ++i)
        if (model.surfaces[i].empty() && model.points[i][1] > 2. && model.points[i][1] < wide - 2.)
          for (unsigned int c = 0; c < 3; ++c)
            expect(std::abs(force[3 * model.equation[i] + c]) < 1e-9 * m.young * 1e-5 * wide * wide,
                   "patch test, degree " + std::to_string(degree));
    }
    // Pure bending of one brick: what incompatible modes are for.
    SolidModel model(wall(1, 1, 1, 1), 1);
    model.free_base();
    const double        curvature = 1e-6;
    std::vector<Stress> stress;
    StressRecovery(model, {m}, true)
        .apply(field(model,
                     [&](const Vector3 &p)
                     {
                       const double x = p[0] - 5., y = p[1] - 10., z = p[2] - 15.;
                       return Vector3{{-.5 * curvature * (z * z + m.poisson * (x * x - y * y)),
                                       -curvature * m.poisson * x * y, curvature * x * z}};
                     }),
               {}, stress);
    expect_stress(
        model, stress,
        [&](const Vector3 &p) {
          return std::array<double, 6>{{0., 0., m.young * curvature * (p[0] - 5.), 0., 0., 0.}};
        },
        m.young * curvature * 5., "pure bending of a brick");
  }

  void principal()
  {
    const auto changes = [](const Stress &stress, const float maximum, const float minimum)
    {
      const std::size_t none[2] = {0, 0};
      StressView        view;
      float             all[6 * most_lanes];
      view.start = view.face = none;
      view.added = &stress;
      view.maximum = &maximum;
      view.minimum = &minimum;
      view.lowest = 1e30f;
      return stress_kernel()(view, 0, all) != 0;
    };
    const Matrix3 Q = {{2. / 3., -2. / 3., 1. / 3., 1. / 3., 2. / 3., 2. / 3., -2. / 3., -1. / 3., 2. / 3.}};
    for (const Vector3 &values : {Vector3{{5., 1., -3.}}, {{4., 4., -2.}}, {{-1., -6., -7.}}, {{3., 3., 3.}}})
    {
      Matrix3 s{};
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = 0; j < 3; ++j)
          for (unsigned int k = 0; k < 3; ++k)
            s[3 * i + j] += Q[3 * i + k] * values[k] * Q[3 * j + k];
      const Stress stress = {{float(s[0]), float(s[4]), float(s[8]), float(s[1]), float(s[5]), float(s[2])}};
      const auto   p = principal_stresses(stress);
      const float  high = values[0], low = values[2], step = 2e-5f;
      // Round-off makes the limits stricter, at double roots by the root of its size.
      expect(!changes(stress, high + .02f, low - .02f) && changes(stress, high - step, low - step) &&
                 changes(stress, high + step, low + step) && changes(stress, low - step, -100.f) &&
                 changes(stress, 100.f, high + step) && !changes(stress, 100.f, -100.f),
             "comparison of principal stresses with limits");
      expect(std::abs(p[0] - values[0]) < 2e-5 && std::abs(p[1] - values[2]) < 2e-5,
             "principal stresses " + std::to_string(p[0]) + ", " + std::to_string(p[1]));
    }
    // Nearly double roots beside a large mean: round-off of the deviator changes the polynomial near its root.
    for (const auto &[stress, high, low] :
         {std::tuple{Stress{{-0x1.81f56cp+7f, -0x1.87d03ep+7f, -0x1.87d20cp+7f, -0x1.0fc9d2p-2f,
                             -0x1.a1528p-6f, 0x1.16ae3ep-2f}},
                     4.f, -0x1.87deccp+7f},
          {Stress{{-0x1.6e6794p+7f, -0x1.708542p+7f, -0x1.7154a4p+7f, 0x1.c66a94p-2f, -0x1.678c46p+0f,
                   0x1.071728p-1f}},
           -0x1.6e1472p+7f, -0x1.74168ap+8f},
          {Stress{{-0x1.0c771p+7f, -0x1.0c695ap+7f, -0x1.0b4c42p+7f, 0x1.1e319ep-8f, 0x1.111d44p-3f,
                   0x1.516c26p-6f}},
           0x1.3444b2p+1f, -0x1.0c78dep+7f}})
    {
      const auto p = principal_stresses(stress);
      expect((p[0] > high || p[1] < low) && changes(stress, high, low), "an extreme beside a double root");
    }
    for (unsigned int k = 1; k < 200;
         ++k) // double roots whose mean is no float: a rounded mean counts as its root
    {
      const float a = 1e6f + 1.1f * k, b = -7e5f - .7f * k;
      for (const auto &stress : {Stress{{a, a, b}}, Stress{{a, b, b}}})
      {
        const auto p = principal_stresses(stress);
        expect(std::abs(p[0] - a) < 2e-7 * a && std::abs(p[1] - b) < 2e-7 * a,
               "principal stresses of a double root");
      }
    }
  }

  /** A rectangular key is pressed against its flank by 1 and pulled out of it and along it. The friction of the
   * flank holds the key while the face is open. */
  void flanks()
  {
    KeyParameters keys;
    keys.height = 10.;
    keys.flank_angle = 0.;
    keys.direction = "radial";
    for (const double friction : {.2, -1.})
    {
      keys.friction = friction;
      const auto    law = make_joint_law("KSM", LawParameters(.6, Equations::alart_curnier, keys));
      const Vector3 f = law->solve({{1., 0., 0., 0., 1., 0., 0., 0., 1.}}, {{.5, 1., .5}}, {});
      expect_close(std::abs(f[1]), 1., 1e-9, "force of the flank");
      expect_close(std::hypot(f[0], f[2]), friction < 0. ? .6 : friction, 1e-9, "friction of the flank");
    }
  }

  // Places

  void places()
  {
    const HexMesh closed = wall(2, 5, 6, 2), mesh = open_joints(closed); // a joint at y = 8
    expect_close(crest_length(closed), wide, 1e-12, "length of the crest");
    expect_close(volume(closed), thick * wide * tall, 1e-12, "volume");
    SolidModel model(mesh, 1);
    model.free_base();
    const std::vector<Pair> pairs = find_pairs(model, 1);
    double                  area = 0.;
    for (const Pair &pair : pairs)
    {
      area += pair.area;
      expect(std::abs(pair.frame[0][1] - 1.) < 1e-12, "the normal points to monolith 2");
      expect(std::abs(pair.frame[2][2] - 1.) < 1e-12, "the last axis points upwards");
    }
    expect_close(area, thick * tall, 1e-12, "area of the joint");
    const DamGeometry geometry(model, pairs, 1, "of the test");
    for (const double y : {0., 3., 10., 17., 20.})
      for (const double x : {0., 5.})
        expect(std::abs(geometry.arc_length(Vector3{{x, y, 11.}}) - (y - 10.)) < 1e-12, "arc length");
    expect(std::abs(geometry.joints[0].arc_length + 2.) < 1e-12, "arc length of the joint");
    const auto place = [&](const unsigned int pair) { return pairs[pair].place; };
    expect(place(geometry.joints[0].upstream)[0] == 0. && place(geometry.joints[0].upstream)[2] == tall &&
               place(geometry.joints[0].downstream)[0] == thick &&
               place(geometry.joints[0].downstream)[2] == tall,
           "the joint's pairs at the crest");
    const auto &crown = model.points[geometry.crown];
    expect(crown[0] == 0. && crown[2] == tall && std::abs(crown[1] - 10.) <= 2., "crown");
  }

  /** The same mesh with its nodes and cells numbered in reverse, or with nodes moved by some 1e-9 m. */
  HexMesh disturbed(HexMesh mesh, const bool reversed, const unsigned int seed)
  {
    std::mt19937 engine(seed);
    if (seed > 0)
      for (auto &node : mesh.nodes)
        for (double &x : node)
          x += 1e-9 * (engine() / 2147483647.5 - 1.);
    if (!reversed)
      return mesh;
    const unsigned int last = mesh.nodes.size() - 1;
    std::reverse(mesh.nodes.begin(), mesh.nodes.end());
    std::reverse(mesh.cells.begin(), mesh.cells.end());
    for (HexMesh::Cell &cell : mesh.cells)
      for (unsigned int &node : cell.nodes)
        node = last - node;
    for (HexMesh::Face &face : mesh.faces)
      for (unsigned int &node : face.nodes)
        node = last - node;
    return mesh;
  }

  /** If a joint ends at the crown, the crown belongs to the monolith towards the right bank. Of two nodes at
   * equal distances from the middle, the crown is the node towards the right bank. */
  void crown_without_round_off()
  {
    for (const bool reversed : {false, true})
      for (unsigned int seed = 0; seed < 8; ++seed)
      {
        const std::string what = ", seed " + std::to_string(seed) + (reversed ? ", numbered in reverse" : "");
        SolidModel        model(disturbed(open_joints(wall(2, 4, 3, 2)), reversed, seed), 1);
        const DamGeometry joint(model, {}, 1, "of the test");
        expect(model.body_numbers[model.body[joint.crown]] == 1,
               "the crown is on the right bank's side" + what);
        expect(model.body_numbers[model.body[joint.crown_left]] == 2, "the other side is its own" + what);
        SolidModel        odd(disturbed(wall(2, 5, 3, 5), reversed, seed), 1);
        const DamGeometry between(odd, {}, 0, "of the test");
        expect_close(odd.points[between.crown][1], 8., 1e-8, "of the nodes at 8 m and 12 m" + what);
        expect(between.crown_left == between.crown, "no joint ends at the crown" + what);
      }
  }

  void feet()
  {
    write_gmsh(wall(1, 2, 2, 1), "physics_feet.msh");
    MeshParameters parameters;
    parameters.source = "file";
    parameters.file = "physics_feet.msh";
    for (const auto &unit : {std::make_pair("m", 1.), {"ft", .3048}})
    {
      parameters.length_unit = unit.first;
      expect_close(bounding_box(make_mesh(parameters, "")).second[2], tall * unit.second, 1e-12,
                   std::string("height in ") + unit.first);
    }
  }

  void motion_reports()
  {
    // Sines of 60 degrees difference in whole periods; a constant; an acceleration that rises as t.
    GroundMotion motion;
    motion.dt = .001;
    for (unsigned int k = 0; k < 4000; ++k)
      motion.acceleration.push_back(
          {{std::sin(2. * pi * k / 400.), std::sin(2. * pi * k / 400. + pi / 3.), 2.}});
    MotionParameters parameters;
    parameters.source = "file";
    MotionReport report = report_motion(motion, parameters);
    expect_close(report.correlations[0], .5, 1e-9, "correlation");
    expect_close(report.components[2].arias_intensity, pi / (2. * 9.80665) * 4. * 3.999, 1e-9, "Arias");
    // Of the constant one the energy grows linearly: 5 to 95 % of it in 90 % of the time.
    expect_within(report.components[2].significant_duration, .9 * 3.999, motion.dt, "duration of a constant");
    for (std::size_t k = 0; k < motion.acceleration.size(); ++k)
      motion.acceleration[k] = {{k * motion.dt, -1. * k * motion.dt, 0.}};
    report = report_motion(motion, parameters);
    expect_within(report.components[0].significant_duration, 3.999 * (std::cbrt(.95) - std::cbrt(.05)),
                  motion.dt, "duration of a ramp");
    for (unsigned int d = 0; d < 2; ++d)
    {
      const auto &c = report.components[d];
      expect_close(c.arias_intensity, pi / (2. * 9.80665) * std::pow(3.999, 3) / 3., 1e-9, "Arias, ramp");
      expect_close(c.peak_acceleration, 3.999, 1e-12, "peak acceleration of a ramp");
      expect_close(c.peak_velocity, std::pow(3.999, 2) / 2., 1e-12, "peak velocity of a ramp");
      expect_close(c.peak_displacement, std::pow(3.999, 3) / 6., 1e-12, "peak displacement of a ramp");
    }
    expect_close(report.components[0].end_velocity, std::pow(3.999, 2) / 2., 1e-12, "velocity");
    expect_close(report.components[0].end_displacement, std::pow(3.999, 3) / 6., 1e-12, "displacement");
  }

  // Time stepping: one node

  Structure oscillator(const double stiffness, const double alpha, const double beta)
  {
    Structure structure;
    Body      body;
    body.stiffness = BlockSparseMatrix(std::vector<std::vector<unsigned int>>{{0}});
    body.stiffness.value[0] = {{stiffness, 0., 0., 0., stiffness, 0., 0., 0., stiffness}};
    structure.bodies.push_back(std::move(body));
    structure.mass.assign(1, Matrix3{{4., 0., 0., 0., 4., 0., 0., 0., 4.}});
    structure.added_mass.assign(1, Matrix3{{1., 0., 0., 0., 0., 0., 0., 0., 0.}});
    structure.damping.mass = alpha;
    structure.damping.stiffness = beta;
    return structure;
  }

  void damped_oscillator()
  {
    const double w = 2. * pi, alpha = .5, beta = .01, zeta = .5 * (alpha / w + beta * w),
                 wd = w * std::sqrt(1. - zeta * zeta), dt = 1. / 400.;
    const Structure structure = oscillator(4. * w * w, alpha, beta);
    const JointLaws laws;
    Newmark         newmark(structure, laws, ContactParameters(), dt, ImpactRule::mean_force);
    newmark.start({1., 0., 2.}, {0., 0., 0.}, {}, {0., 0., 0.}, {});
    for (unsigned int k = 1; k <= 800; ++k)
    {
      newmark.advance({0., 0., 0.});
      const double t = k * dt,
                   exact = std::exp(-zeta * w * t) * (std::cos(wd * t) + zeta * w / wd * std::sin(wd * t));
      const DynamicState &now = newmark.state();
      expect(std::abs(now.u[0] - exact) < 3e-4 && std::abs(now.u[2] - 2. * exact) < 6e-4,
             "damped oscillator");
      const Energy &e = now.energy;
      expect_close(e.added_mass, .5 * now.v[0] * now.v[0], 1e-12, "kinetic energy of the water");
      expect_close(e.kinetic, .5 * (3. * now.v[0] * now.v[0] + 4. * now.v[2] * now.v[2]), 1e-12,
                   "kinetic energy of the dam");
      expect(k < 40 || newmark.energy_error() < 1e-10, "balance of the energy");
    }
  }

  /** Participation factors phi^T M r, where the mass couples the directions as that of the water does. */
  void participation()
  {
    Structure structure = oscillator(1., 0., 0.);
    structure.mass[0] = {{4., 1., 0., 1., 5., 2., 0., 2., 6.}};
    const Vector3 factor = NaturalMode{1., {.1, .2, .3}}.participation(structure);
    const double  exact[] = {.4 + .2, .1 + 1. + .6, .4 + 1.8}, mass[] = {4., 5., 6.};
    for (unsigned int d = 0; d < 3; ++d)
    {
      expect_close(factor[d], exact[d], 1e-12, "participation factor");
      expect_close(free_mass(structure)[d], mass[d], 1e-12, "mass along an axis");
    }
  }

  /** Returns @p n masses of 1 kg in a row between two walls: K = tridiag(-c, 2 c, -c), with another c [N/m] for
   * each axis. @p coupled false: every mass has its own springs to the ground, K = 2 c. */
  Structure chain(const unsigned int n, const Vector3 &c, const bool coupled = true)
  {
    std::vector<std::vector<unsigned int>> columns(n);
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = i == 0 ? 0 : i - 1; j < std::min(n, i + 2); ++j)
        columns[i].push_back(j);
    Structure structure;
    Body      body;
    body.stiffness = BlockSparseMatrix(columns);
    for (unsigned int i = 0; i < n; ++i)
      for (const unsigned int j : columns[i])
      {
        const double k = i == j ? 2. : coupled ? -1. : 0.;
        body.stiffness.add(i, j, {{k * c[0], 0., 0., 0., k * c[1], 0., 0., 0., k * c[2]}});
      }
    structure.bodies.push_back(std::move(body));
    structure.mass.assign(n, Matrix3{{1., 0., 0., 0., 1., 0., 0., 0., 1.}});
    structure.added_mass.assign(n, Matrix3{});
    return structure;
  }

  /** Natural frequencies of the chain. Too few iterations are an error. */
  void modes_of_chain()
  {
    constexpr unsigned int n = 40;
    const Vector3          c = {{1., 1.7, 2.9}};
    const Structure        structure = chain(n, c);
    std::vector<double>    exact;
    for (unsigned int k = 1; k <= 6; ++k)
      for (const double stiffness : c)
        exact.push_back(std::sqrt(stiffness * (2. - 2. * std::cos(k * pi / (n + 1)))) / (2. * pi));
    std::sort(exact.begin(), exact.end());
    const std::vector<NaturalMode> modes = natural_modes(structure, 6);
    for (unsigned int k = 0; k < 6; ++k)
      expect_close(modes[k].frequency, exact[k], 1e-9, "frequency of the chain");
    throws<ComputationError>("modes after one iteration", [&] { natural_modes(structure, 6, 1); },
                             {"were not found"});
  }

  /** Coefficients of the CQC: the example of Wilson, Der Kiureghian and Bayo (1981), a building with the damping
   * ratio 0.05, three printed digits; equal and distant frequencies. */
  void cqc_coefficients()
  {
    const double omega[] = {13.87, 13.93, 43.99, 44.19, 54.42};
    const double printed[5][5] = {{1., .998, .006, .006, .004},
                                  {.998, 1., .006, .006, .004},
                                  {.006, .006, 1., .998, .180},
                                  {.006, .006, .998, 1., .186},
                                  {.004, .004, .180, .186, 1.}};
    for (unsigned int i = 0; i < 5; ++i)
      for (unsigned int j = 0; j < 5; ++j)
        expect_within(cqc_coefficient(omega[i], .05, omega[j], .05), printed[i][j], 7e-4,
                      "correlation of two modes");
    expect_within(cqc_coefficient(2., 0., 2., 0.), 1., 0., "correlation of a mode with itself");
    expect_close(cqc_coefficient(2., .02, 2., .08), 8. * .04 * .1 / (4. * .0016 * 2. + 4. * .0068), 1e-12,
                 "equal frequencies, other damping");
    expect_close(cqc_coefficient(2., .02, 3., .08), cqc_coefficient(3., .08, 2., .02), 1e-12, "symmetry");
    expect(cqc_coefficient(1., .05, 100., .05) < 1e-4, "distant frequencies");
  }

  /** Two equal oscillators move together, u = S_a/omega^2, whatever modes a solver returns for their common
   * frequency. A square root of the sum of squares would give less. */
  void spectrum_of_equal_frequencies()
  {
    const Structure structure = chain(2, {{18., 18., 18.}}, false);
    const double    frequency = 6. / (2. * pi), S_a = 1.8;
    for (const double angle : {0., .3, 1., 2.5})
    {
      const double                        c = std::cos(angle), s = std::sin(angle);
      std::vector<SpectrumResponse::Mode> modes = {
          {{frequency, {c, 0., 0., s, 0., 0.}}, .05, {{S_a, 0., 0.}}, {}},
          {{frequency, {-s, 0., 0., c, 0., 0.}}, .05, {{S_a, 0., 0.}}, {{0., 0., .5}}}};
      const SpectrumResponse response(structure, modes, {{1., 0., 0.}});
      std::vector<double>    u, force;
      for (const SpectrumResponse::Part &part : response.parts())
      {
        u.push_back(part.displacement[0]);
        force.push_back(support_force(structure, part)[0]);
      }
      expect_close(response.combine(u), S_a / 36., 1e-12, "displacement of equal oscillators");
      expect_close(response.combine(force), 2. * S_a, 1e-12, "force on the supports of equal oscillators");
    }
  }

  /** The chain under a spectrum, with m modes in x and y: closed forms of modes and static response. Without
   * modes it follows the ground: displacements of the static load, force = mass times peak acceleration. */
  void spectrum_of_chain()
  {
    constexpr unsigned int n = 40;
    const Vector3          c = {{1., 1.7, 2.9}}, peak = {{.2, .5, 0.}};
    const Structure        structure = chain(n, c);
    const double           damping = .07;
    const auto             S_a = [](const unsigned int d, const double f) {
      return d == 0 ? .2 + f : d == 1 ? .5 + 2. * f : 0.;
    };
    const auto share = [](const unsigned int d, const unsigned int k) { return d == 0 ? 0. : .25 * (k - 1); };
    for (const unsigned int m : {0, 1, 3, 4})
    {
      std::vector<SpectrumResponse::Mode> modes;
      std::array<double, 2>               u{}, force{}; // squares, at mass 12 and on the supports
      for (unsigned int d = 0; d < 2; ++d)
      {
        std::vector<double> w, at, sum, S;
        double              rigid_u = peak[d] * 12. * (n + 1 - 12.) / (2. * c[d]), rigid_force = peak[d] * n;
        for (unsigned int k = 1; k <= m; ++k)
        {
          Unknowns shape(3 * n, 0.);
          for (unsigned int i = 1; i <= n; ++i)
            shape[3 * (i - 1) + d] = std::sqrt(2. / (n + 1)) * std::sin(k * pi * i / (n + 1));
          w.push_back(std::sqrt(c[d] * (2. - 2. * std::cos(k * pi / (n + 1)))));
          S.push_back(S_a(d, w.back() / (2. * pi)));
          at.push_back(std::sqrt(2. / (n + 1)) * std::sin(k * pi * 12. / (n + 1)));
          sum.push_back(k % 2 == 0 ? 0. : std::sqrt(2. / (n + 1)) / std::tan(k * pi / (2. * (n + 1))));
          const double part = share(d, k) * S.back() - peak[d]; // of the rigid part
          rigid_u += part * at.back() * sum.back() / (w.back() * w.back());
          rigid_force += part * sum.back() * sum.back();
          modes.push_back({{w.back() / (2. * pi), shape},
                           damping,
                           {{S_a(0, w.back() / (2. * pi)), S_a(1, w.back() / (2. * pi)), 0.}},
                           {{share(0, k), share(1, k), .7}}});
          S.back() *= std::sqrt(1. - share(d, k) * share(d, k));
        }
        u[d] = rigid_u * rigid_u;
        force[d] = rigid_force * rigid_force;
        for (unsigned int i = 0; i < m; ++i)
          for (unsigned int j = 0; j < m; ++j)
          {
            const double r = w[j] / w[i]; // the formula for equal damping ratios
            const double rho = 8. * damping * damping * (1. + r) * std::pow(r, 1.5) /
                               (std::pow(1. - r * r, 2) + 4. * damping * damping * r * std::pow(1. + r, 2));
            u[d] += rho * at[i] * at[j] * sum[i] * sum[j] * S[i] * S[j] / std::pow(w[i] * w[j], 2);
            force[d] += rho * std::pow(sum[i] * sum[j], 2) * S[i] * S[j];
          }
      }
      const SpectrumResponse             response(structure, modes, peak);
      std::array<std::vector<double>, 2> of_u, of_force;
      std::vector<double>                of_both; // both axes in one result
      for (const SpectrumResponse::Part &part : response.parts())
      {
        for (unsigned int d = 0; d < 2; ++d)
        {
          of_u[d].push_back(part.displacement[3 * 11 + d]);
          of_force[d].push_back(support_force(structure, part)[d]);
        }
        of_both.push_back(of_u[0].back() - of_u[1].back());
      }
      for (unsigned int d = 0; d < 2; ++d)
      {
        expect_close(response.combine(of_u[d]), std::sqrt(u[d]), 1e-10, "displacement of the chain");
        expect_close(response.combine(of_force[d]), std::sqrt(force[d]), 1e-10, "force of the chain");
      }
      expect_close(response.combine(of_both), std::sqrt(u[0] + u[1]), 1e-10,
                   "two directions of ground motion");
    }
  }

  /** Files of spectra: units, vertical ratio, interpolation, and messages of invalid files. */
  void spectrum_files()
  {
    const auto write = [](const std::string &text) { std::ofstream("spectrum.csv") << text; };
    const auto read = [](const std::string &unit = "") {
      return read_spectrum("spectrum.csv", unit, .5, {SpectrumTable::rigid_period, .1});
    };
    write("period [s]; a [m/s^2]\n\n# rock\n0.02, 2\n.1\t5 # plateau\r\n.2;5\n3.2 1.25\n");
    const SpectrumTable table = read();
    for (const auto &[period, a] : {std::make_pair(0., 2.), {.02, 2.}, {.15, 5.}, {.8, 2.5}, {3.2, 1.25}})
    {
      expect_close(table.at(0, period), a, 1e-12, "spectrum of a file");
      expect_close(table.at(2, period), .5 * a, 1e-12, "vertical spectrum of a file");
    }
    for (const auto &[headings, factor] : {std::make_pair("T,Sa (g)", standard_gravity),
                                           {"T,Sa [gal]", .01},
                                           {"T,Sa [m/s\u00b2]", 1.},
                                           {"T,Sa [ft/s2]", .3048},
                                           {"T,Sa (%g)", .01 * standard_gravity},
                                           {"T,Sa", 1.}})
    {
      write(headings + std::string("\n0 .28\n4 .1\n"));
      expect_close(read().at(0, 0.), .28 * factor, 1e-12, headings);
      expect(read().states_unit == (std::string(headings) != "T,Sa"), "unit of the headings");
    }
    write("T,Sa [cm/s2]\n0 100\n4 50\n");
    expect_close(read("gal").at(0, 0.), 1., 1e-12, "equal units");
    expect_close(read("g").at(0, 0.), 1., 1e-12, "the unit of the file applies");
    const std::vector<std::pair<std::string, std::vector<std::string>>> wrong = {
        {"0 1\n1 2 3\n", {"line 2", "3 columns"}},
        {"0 1\n1 x\n", {"line 2", "'x'"}},
        {"0 1\n1 nan\n", {"line 2"}},
        {"0 1\n1 -2\n", {"line 2", "positive"}},
        {"0 1\n2 1\n2 1\n", {"line 3", "increase"}},
        {"0 1\n", {"end at 0.1 s"}},
        {"T Sa\n", {"no numbers"}},
        {"0.1 1\n1 1\n", {"begin", "0.1 s"}}};
    for (const auto &[text, parts] : wrong)
    {
      write(text);
      throws<InputError>(
          "spectrum " + parts.back(), [&] { read(); }, parts);
    }
  }

  /** Damped against a base that moves with the velocity t: v = t - (1 - exp(-alpha t))/alpha. */
  void moving_base()
  {
    const double    alpha = 2., dt = .01;
    const Structure structure = oscillator(1e-9, alpha, 0.);
    const JointLaws laws;
    Newmark         newmark(structure, laws, ContactParameters(), dt, ImpactRule::mean_force);
    newmark.start({0., 0., 0.}, {0., 0., 0.}, {}, {0., 0., 0.}, {});
    for (unsigned int k = 1; k <= 200; ++k)
    {
      const double t = k * dt;
      newmark.advance({0., 0., 0.}, {{t, 0., 0.}});
      expect(std::abs(newmark.state().v[0] - (t - (1. - std::exp(-alpha * t)) / alpha)) < 5e-5,
             "damped against a moving base");
    }
  }

  /** A body that slides on a wall: what it loses is work of friction, and nothing is lost in impacts. */
  void sliding_energy()
  {
    Structure structure = oscillator(1e-9, 0., 0.);
    Pair      pair;
    pair.node_2 = 0;
    pair.frame = {{{{1., 0., 0.}}, {{0., 1., 0.}}, {{0., 0., 1.}}}};
    structure.pairs.push_back(pair);
    structure.n_joints = 1;
    structure.collect_interfaces();
    JointLaws laws;
    laws.of_joint.push_back(make_joint_law("FJA", .5));
    laws.assign(structure);
    const double dt = .001, push = 4.;
    Newmark      newmark(structure, laws, ContactParameters(), dt, ImpactRule::mean_force);
    newmark.start({0., 0., 0.}, {0., 1., 0.}, {push, -.5 * push, 0.}, {-push, 0., 0.}, {0., 0., 0.});
    for (unsigned int k = 0; k < 20; ++k)
      newmark.advance({-push, 0., 0.});
    const double v = 1. - .5 * push / 4. * 20 * dt, lost = .5 * 4. * (1. - v * v);
    expect_close(newmark.state().v[1], v, 1e-9, "velocity of the sliding body");
    expect_close(newmark.state().energy.friction, lost, 1e-9, "work of friction");
    expect(std::abs(newmark.state().energy.impact) < 1e-9 * lost, "nothing is lost in impacts");
  }

  // Rock

  void waves()
  {
    Material m;
    m.young = 20e9;
    m.poisson = .25;
    m.density = 2600.;
    const double mu = m.young / 2.5, lambda = m.young * .25 / (1.25 * .5);
    expect_close(2600. * std::pow(p_wave_speed(m), 2), lambda + 2. * mu, 1e-12, "P waves");
    expect_close(2600. * std::pow(s_wave_speed(m), 2), mu, 1e-12, "S waves");
    // The outcrop's acceleration 6 t: half of it comes from below, u = t^3/2.
    GroundMotion outcrop;
    outcrop.dt = .1;
    for (unsigned int k = 0; k <= 20; ++k)
      outcrop.acceleration.push_back({{.6 * k, 0., -.6 * k}});
    const IncidentWave wave = incident_wave(outcrop);
    for (const double t : {.05, .1, .73, 1.9})
    {
      expect_close(wave(t)[0], std::pow(t, 3) / 2., 1e-12, "incident wave");
      expect_close(wave(t)[2], -std::pow(t, 3) / 2., 1e-12, "incident wave");
    }
    // An oscillator w with central differences, damping of the step before: w dt (w dt/4 + xi) = 1.
    RockDamping damping;
    damping.mass = 3.;
    damping.stiffness = .002;
    for (const double w : {10., 100., 1000.})
    {
      const double dt = critical_time_step(w, damping), xi = .5 * (3. / w + .002 * w);
      expect_close(w * dt * (.25 * w * dt + xi), 1., 1e-12, "critical time step");
    }
  }

  void dashpots()
  {
    const HexMesh        mesh = Boxes::box({2, 3, 2}, {"z-"},
                                           [](double i, double j, double k) {
                                      return Vector3{{2. * i, 3. * j, 4. * k}};
                                    });
    RockRegionParameters parameters;
    Material            &m = parameters.rock.materials[Boxes::rock];
    m = Boxes::unit_rock(.2);
    m.density = 3.;
    const RockModel model = make_rock_model(mesh, parameters.rock);
    Matrix3         damping{};
    for (const Dashpot &dashpot : viscous_dashpots(model, {{0., 0., 100.}}, 1., 0.))
      for (unsigned int k = 0; k < 9; ++k)
        damping[k] += dashpot.damping[k];
    // Springs of the face at z = 0: 1.5 G/r and .5 G/r by the parts of its nodes, 2 m x 3 m but at its edges.
    double exact = 0.;
    for (unsigned int i = 0; i <= 2; ++i)
      for (unsigned int j = 0; j <= 3; ++j)
        exact +=
            (i == 1 ? 2. : 1.) * (j == 0 || j == 3 ? 1.5 : 3.) / std::sqrt(4. * i * i + 9. * j * j + 64.);
    Matrix3 springs{};
    for (const Dashpot &dashpot : viscous_dashpots(model, {{0., 0., 8.}}, 1.5, .5))
      for (unsigned int k = 0; k < 9; ++k)
        springs[k] += dashpot.stiffness[k];
    const double shear = 3. * s_wave_speed(m) * s_wave_speed(m);
    expect_close(springs[8], 1.5 * shear * exact, 1e-12, "normal springs");
    expect_close(springs[0], .5 * shear * exact, 1e-12, "tangential springs");
    const double area = 4. * 9.;
    expect_close(damping[8], 3. * p_wave_speed(m) * area, 1e-12, "normal dashpots");
    expect_close(damping[0], 3. * s_wave_speed(m) * area, 1e-12, "tangential dashpots");
    expect_close(damping[4], 3. * s_wave_speed(m) * area, 1e-12, "tangential dashpots");
  }
} // namespace

int main(int argc, char **argv)
{
  const std::string part = argc > 1 ? argv[1] : "";
  if (part == "loads")
    return run(
        {{"weight and water", weight_and_water}, {"local depth", local_depth}, {"wet mass", wet_mass}});
  if (part == "model")
    return run({{"stresses", stresses},
                {"principal stresses", principal},
                {"friction of flanks", flanks},
                {"places", places},
                {"crown", crown_without_round_off},
                {"feet", feet},
                {"reports of motions", motion_reports}});
  if (part == "newmark")
    return run({{"damped oscillator", damped_oscillator},
                {"participation factors", participation},
                {"modes of a chain", modes_of_chain},
                {"coefficients of the CQC", cqc_coefficients},
                {"spectrum, equal frequencies", spectrum_of_equal_frequencies},
                {"spectrum, chain", spectrum_of_chain},
                {"spectra of files", spectrum_files},
                {"moving base", moving_base},
                {"sliding", sliding_energy}});
  if (part == "rock")
    return run({{"waves", waves}, {"dashpots", dashpots}});
  std::cerr << "usage: physics loads|model|newmark|rock\n";
  return 2;
}
