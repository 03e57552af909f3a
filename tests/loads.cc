// SPDX-License-Identifier: GPL-3.0-or-later
// Temperature, silt, tail water, uplift and concentrated loads against closed forms.
// Usage: loads temperature|joints|faces|nodes|combinations

#include <voussoir/contact/law_table.h>
#include <voussoir/dam/base_uplift.h>
#include <voussoir/dam/face_distance.h>
#include <voussoir/dam/face_pressure.h>
#include <voussoir/dam/joint_water.h>
#include <voussoir/dam/load_table.h>
#include <voussoir/dam/nodal_forces.h>
#include <voussoir/dam/static_path.h>
#include <voussoir/dam/static_state.h>
#include <voussoir/dam/temperature.h>
#include <voussoir/joints/joint_system.h>
#include <voussoir/joints/pairs.h>
#include <voussoir/mesh/gmsh_io.h>
#include <voussoir/mesh/mesh_groups.h>
#include <voussoir/mesh/mesh_joints.h>

#include "grids.h"
#include "testing.h"

using namespace Voussoir;
using namespace Testing;

namespace
{
  constexpr double thick = 10., wide = 20., tall = 30.;

  HexMesh wall(const std::array<unsigned int, 3>             &n = {{2, 3, 4}},
               const std::function<Vector3(const Vector3 &)> &place = nullptr)
  {
    return Grids::wall({{thick, wide, tall}}, n, n[1], place);
  }

  Vector3 sum(const Unknowns &f)
  {
    Vector3 result{};
    for (std::size_t k = 0; k < f.size(); ++k)
      result[k % 3] += f[k];
    return result;
  }

  double largest(const Unknowns &f)
  {
    double result = 0.;
    for (const double x : f)
      result = std::max(result, std::abs(x));
    return result;
  }

  // Temperature

  /** A model without supports with its structure, under a temperature. */
  struct Heated
  {
    Heated(const HexMesh &mesh, const unsigned int degree, const TemperatureParameters &temperature,
           const double poisson = .2)
        : model(mesh, degree)
    {
      concrete.poisson = poisson;
      model.free_base();
      structure = assemble_structure(model, {concrete}, true);
      thermal = temperature_load(model, {concrete}, true, temperature, ".");
    }

    Unknowns displacement(const std::function<Vector3(const Vector3 &)> &u) const
    {
      Unknowns result(3 * structure.n_nodes());
      for (unsigned int i = 0; i < model.n_nodes(); ++i)
        set(result, model.equation[i], u({{model.points[i][0], model.points[i][1], model.points[i][2]}}));
      return result;
    }

    Unknowns residual(const Unknowns &u) const ///< K u - f [N]
    {
      Unknowns r;
      structure.multiply_stiffness(u, r);
      for (std::size_t k = 0; k < r.size(); ++k)
        r[k] -= thermal.load[k];
      return r;
    }

    std::vector<Stress> stress(const Unknowns &u) const
    {
      std::vector<Stress> s;
      StressRecovery(model, {concrete}, true).apply(u, {}, s);
      for (std::size_t i = 0; i < s.size(); ++i)
        for (unsigned int c = 0; c < 6; ++c)
          s[i][c] += thermal.stress[i][c];
      return s;
    }

    Material      concrete;
    SolidModel    model;
    Structure     structure;
    InitialStrain thermal;
  };

  TemperatureParameters heat(const double upstream, const double downstream)
  {
    TemperatureParameters t;
    t.upstream = upstream;
    t.downstream = downstream;
    t.grouting = 10.;
    return t;
  }

  /** The free wall: T = T_0 + G x makes u = alpha ((T_0 - T_g) r + G ((x^2 - y^2 - z^2)/2, x y, x z)) and no
   * stress (Boley and Weiner 1960). */
  void free_wall(const unsigned int degree, const double upstream, const double downstream)
  {
    const Heated   bar(wall(), degree, heat(upstream, downstream));
    const double   a = 1e-5, t = upstream - 10., g = (downstream - upstream) / thick;
    const Unknowns u = bar.displacement(
        [=](const Vector3 &x)
        {
          return Vector3{{a * (t * x[0] + g * (x[0] * x[0] - x[1] * x[1] - x[2] * x[2]) / 2.),
                          a * (t * x[1] + g * x[0] * x[1]), a * (t * x[2] + g * x[0] * x[2])}};
        });
    const std::string name = "free wall, degree " + std::to_string(degree) + ", " + text(upstream) + " to " +
                             text(downstream) + " degC: ";
    below(name + "exact u is in balance", largest(bar.residual(u)) / largest(bar.thermal.load), 1e-10);
    float stress = 0.f;
    for (const Stress &s : bar.stress(u))
      for (const float x : s)
        stress = std::max(stress, std::abs(x));
    below(name + "no stress [of E alpha dT]", stress / (bar.concrete.young * a * 20.),
          3e-5); // in single precision
  }

  /** A table with elevations on two days, halfway between. */
  TemperatureParameters heights(const std::string &lines)
  {
    write_text("heights.csv", "day, elevation, upstream, downstream\n" + lines);
    TemperatureParameters t;
    t.table = "heights.csv";
    t.grouting = 10.;
    t.day = 5.;
    return t;
  }

  /** The free wall with T = T_g + t + G x + H z: u = alpha ((t + g.r) r - g r^2/2) with g = (G, 0, H), and no
   * stress (Boley and Weiner 1960). */
  void free_wall_with_profile(const unsigned int degree)
  {
    const double   a = 1e-5, t = 5., g = 2., h = -.5; // 15 to 35 degC at z = 0, 0 to 20 degC at z = 30 m
    const Heated   bar(wall(), degree, heights("0 0 10 30\n0 30 -10 10\n10 0 20 40\n10 30 10 30\n"));
    const Unknowns u = bar.displacement(
        [=](const Vector3 &x)
        {
          const double rise = t + g * x[0] + h * x[2], square = dot(x, x) / 2.;
          return Vector3{{a * (rise * x[0] - g * square), a * rise * x[1], a * (rise * x[2] - h * square)}};
        });
    const std::string name = "free wall, degree " + std::to_string(degree) + ", profile: ";
    below(name + "exact u is in balance", largest(bar.residual(u)) / largest(bar.thermal.load), 1e-10);
    float stress = 0.f;
    for (const Stress &s : bar.stress(u))
      for (const float x : s)
        stress = std::max(stress, std::abs(x));
    below(name + "no stress [of E alpha dT]", stress / (bar.concrete.young * a * 20.), 3e-5);
  }

  /** Without displacements the stress is -E alpha (T - T_g) (nu = 0, elements without incompatible modes). The
   * temperature T is linear in x and between 7.5, 15 and 22.5 m, the elevations of nodes, and constant elsewhere. */
  void clamped_profile()
  {
    const Heated bar(
        wall(), 2, heights("0 7.5 20 0\n0 15 12 4\n0 22.5 6 9\n10 7.5 24 2\n10 15 10 8\n10 22.5 0 5\n"), 0.);
    const Unknowns u(3 * bar.structure.n_nodes(), 0.);
    const auto     stress = bar.stress(u);
    const auto     face = [](const double z, const double low, const double middle, const double high)
    {
      return z <= 7.5    ? low
             : z <= 15.  ? low + (z - 7.5) / 7.5 * (middle - low)
             : z <= 22.5 ? middle + (z - 15.) / 7.5 * (high - middle)
                         : high;
    };
    for (unsigned int i = 0; i < bar.model.n_nodes(); ++i)
    {
      const double x = bar.model.points[i][0], z = bar.model.points[i][2], up = face(z, 22., 11., 3.),
                   down = face(z, 1., 6., 7.),
                   exact = -bar.concrete.young * 1e-5 * (up + x / thick * (down - up) - 10.);
      expect_within(stress[i][2], exact, 1e-5 * bar.concrete.young * 1e-5 * 12., "stress of the profile");
    }
  }

  /** The work of the thermal load in a uniform vertical strain 1/H is the force E alpha m A of a bar held at both
   * ends (nu = 0). m is the mean temperature change over the height H. */
  void column_with_profile()
  {
    const Heated bar(
        wall(), 2, heights("0 0 30 30\n0 15 18 18\n0 30 10 10\n10 0 30 30\n10 15 18 18\n10 30 10 10\n"), 0.);
    double force = 0.; // of the nodes z > 0 along z, for u = z/H: E alpha m A
    for (unsigned int i = 0; i < bar.model.n_nodes(); ++i)
      force += bar.thermal.load[3 * bar.model.equation[i] + 2] * bar.model.points[i][2] / tall;
    const double mean = (.5 * (20. + 8.) + .5 * (8. + 0.)) / 2.;
    expect_close(force, bar.concrete.young * 1e-5 * mean * thick * wide, 1e-10, "force of the profile");
  }

  /** Held along y at both ends, free across: sigma_y = -E alpha dT. */
  void clamped_bar(const unsigned int degree)
  {
    const double   dt = 15., a = 1e-5;
    const Heated   bar(wall(), degree, heat(10. + dt, 10. + dt));
    const double   e = bar.concrete.young, nu = bar.concrete.poisson;
    const Unknowns u = bar.displacement(
        [=](const Vector3 &x) {
          return Vector3{{(1. + nu) * a * dt * x[0], 0., (1. + nu) * a * dt * x[2]}};
        });
    for (const Stress &s : bar.stress(u))
      for (unsigned int c = 0; c < 6; ++c)
        expect_within(s[c], c == 1 ? -e * a * dt : 0., 1e-5 * e * a * dt, "stress of the clamped bar");
    const Unknowns r = bar.residual(u);
    double         reaction = 0., rest = 0.;
    for (unsigned int i = 0; i < bar.model.n_nodes(); ++i)
      for (unsigned int c = 0; c < 3; ++c)
      {
        const double y = bar.model.points[i][1], f = r[3 * bar.model.equation[i] + c];
        if (c == 1 && y < 1e-6)
          reaction += f;
        else if (c != 1 || y < wide - 1e-6)
          rest = std::max(rest, std::abs(f));
      }
    expect_close(reaction, e * a * dt * thick * tall, 1e-10, "reaction of the clamped bar");
    expect(rest < 1e-10 * reaction, "balance of the clamped bar");
  }

  constexpr double inner = 20., outer = 30.;

  /** A closed ring of the height @p h, its outer face upstream. */
  HexMesh ring(const unsigned int n, const unsigned int n_through, const double h)
  {
    HexMesh    mesh;
    const auto node = [&](const unsigned int i, const unsigned int j, const unsigned int k)
    { return (k * n + j % n) * (n_through + 1) + i; };
    for (unsigned int k = 0; k < 2; ++k)
      for (unsigned int j = 0; j < n; ++j)
        for (unsigned int i = 0; i <= n_through; ++i)
        {
          const double r = outer + (inner - outer) * i / n_through, angle = 2. * pi * j / n;
          mesh.nodes.push_back({r * std::cos(angle), r * std::sin(angle), h * k});
        }
    for (unsigned int j = 0; j < n; ++j)
    {
      for (unsigned int i = 0; i < n_through; ++i)
        mesh.cells.push_back({{node(i, j, 0), node(i, j + 1, 0), node(i + 1, j + 1, 0), node(i + 1, j, 0),
                               node(i, j, 1), node(i, j + 1, 1), node(i + 1, j + 1, 1), node(i + 1, j, 1)},
                              1});
      for (const unsigned int i : {0u, n_through})
        mesh.faces.push_back({{node(i, j, 0), node(i, j + 1, 0), node(i, j + 1, 1), node(i, j, 1)},
                              i == 0 ? PhysicalId::upstream : PhysicalId::downstream});
    }
    return mesh;
  }

  /** Hoop stress of a thin free ring whose temperature is T (b - r)/(b - a): Timoshenko and Goodier 1970,
   * section 151. */
  double hoop_stress(const double r, const double e_alpha_t)
  {
    const double a = inner, b = outer;
    const auto   integral = [=](const double s) // of T r from a to s
    { return (b * (s * s - a * a) / 2. - (s * s * s - a * a * a) / 3.) / (b - a); };
    return e_alpha_t *
           ((r * r + a * a) / (b * b - a * a) * integral(b) + integral(r) - r * r * (b - r) / (b - a)) /
           (r * r);
  }

  void free_ring()
  {
    Heated      disc(ring(64, 4, .5), 2, heat(10., 30.), 0.);
    JointSystem system(disc.structure, JointLaws(), ContactParameters(), {1e-3}); // soft springs hold it
    Unknowns    u;
    system.solve_free(disc.thermal.load, u);
    const auto   stress = disc.stress(u);
    double       error = 0.;
    const double scale = disc.concrete.young * 1e-5 * 20.;
    for (unsigned int i = 0; i < disc.model.n_nodes(); ++i)
    {
      const double  x = disc.model.points[i][0], y = disc.model.points[i][1], r = std::hypot(x, y);
      const Stress &s = stress[i];
      const double  hoop = (y * y * s[0] + x * x * s[1] - 2. * x * y * s[3]) / (r * r);
      error = std::max(error, std::abs(hoop - hoop_stress(r, scale)) / scale);
    }
    note("ring: hoop stress inside [of E alpha T]", hoop_stress(inner, 1.));
    below("ring: hoop stress at all nodes [of E alpha T]", error, .01);
  }

  /** A uniform temperature with the factor of a combination. Without displacements the stress is -E alpha
   * dT/(1 - 2 nu) in all directions. The force on the fixed base is this stress times its area. */
  void factor_of_combination()
  {
    const SolidModel            model(wall(), 1);
    const std::vector<Material> materials(1);
    const Structure             structure = assemble_structure(model, materials, true);
    Scene                       scene;
    scene.reservoir.density = 0.;
    scene.loads.temperature = heat(30., 30.);
    scene.loads.combinations["cold"] = "temperature -0.5";
    scene.loads.combination = "cold";
    const auto loads = static_loads(scene, {model, structure, materials});
    expect(loads.size() == 1 && loads[0].factor == -.5, "loads of the combination");
    const double exact = .5 * materials[0].young * 1e-5 * 20. / (1. - 2. * materials[0].poisson);
    for (const Stress &s : loads[0].stress)
      for (unsigned int c = 0; c < 6; ++c)
        expect_within(s[c], c < 3 ? exact : 0., 1e-6 * exact, "stress of the temperature");
    expect_close(loads[0].resultant()[2], -exact * thick * wide, 1e-12, "force of the temperature");
  }

  /** Nodes between two materials have the stress of the stiffer one, above or below. */
  void interface()
  {
    for (const bool stiff_above : {false, true})
    {
      HexMesh mesh = wall(); // 7.5 m high layers
      for (HexMesh::Cell &cell : mesh.cells)
        cell.zone = zone_index(mesh, centre(mesh, cell.nodes)[2] > 15. ? "above" : "");
      std::vector<Material> materials(2);
      materials[stiff_above].young *= 2.;
      const SolidModel model(mesh, 1);
      const auto       stress = temperature_load(model, materials, true, heat(30., 30.), ".").stress;
      for (unsigned int i = 0; i < model.n_nodes(); ++i)
      {
        const double z = model.points[i][2], young = materials[stiff_above ? z > 14. : z > 16.].young,
                     exact = -young * 1e-5 * 20. / (1. - 2. * materials[0].poisson);
        expect_close(stress[i][2], exact, 1e-6, "stress of the temperature at z = " + text(z));
      }
    }
  }

  void tables()
  {
    write_text("temperatures.csv", "day, upstream, downstream\n0, 4, 2\n100, 8, 22 # summer\n\n200; 6; 2\n");
    TemperatureParameters t;
    t.table = "temperatures.csv";
    for (const auto &[day, up, down] :
         {std::array<double, 3>{0., 4., 2.}, {25., 5., 7.}, {150., 7., 12.}, {200., 6., 2.}})
    {
      t.day = day;
      const auto faces = face_temperatures(t, ".").at(-5.);
      expect_within(faces[0], up, 1e-12, "upstream face");
      expect_within(faces[1], down, 1e-12, "downstream face");
    }
    t.day = 201.;
    expect_error([&] { face_temperatures(t, "."); }, {"Loads/Temperature/Table", "day 201", "0 to 200"});
    t.table = "none.csv";
    expect_error([&] { face_temperatures(t, "."); }, {"none.csv", "relative"});
    for (const auto &[content, part] :
         {std::make_pair("0 1\n", "line 1"),
          {"0 1 2\n0 1 2\n", "the days must ascend"},
          {"0 1 2 3 4\n", "three numbers"},
          {"0 1 2 x\n", "three numbers"},
          {"0 1 2 +\n", "three numbers"},
          {"0 1 nan\n", "three numbers"},
          {"0 1 2\n1 5 2 3\n", "line 2 has 4 numbers"},
          {"0 5 2 3\n0 4 2 3\n", "4 m follows 5 m"},
          {"0 5 2 3\n0 6 2 3\n2 6 2 3\n", "no temperatures of day 2 at the elevation 5 m"},
          {"0 5 2 3\n2 5 2 3\n2 7 2 3\n",
           "no temperatures of day 0 at the elevation 7 m, but those of day 2"},
          {"0 5 2 3\n2 5 2 3\n0 7 2 3\n", "the days must ascend"}})
    {
      write_text("bad.csv", content);
      t.table = "bad.csv";
      expect_error([&] { face_temperatures(t, "."); }, {"bad.csv", part});
    }
  }

  void temperature()
  {
    for (const unsigned int degree : {1, 2})
    {
      free_wall(degree, 30., 30.);
      free_wall(degree, 30., -10.);
      clamped_bar(degree);
      free_wall_with_profile(degree);
    }
    clamped_profile();
    column_with_profile();
    free_ring();
    factor_of_combination();
    interface();
    tables();
    HexMesh bare = wall();
    bare.faces.clear();
    const SolidModel model(bare, 1);
    throws("a linear temperature without faces",
           [&] { places_in_thickness(model, "Loads/Temperature", false); },
           {"Loads/Temperature", "\"upstream\"", "Mark it"});
  }

  // Joints: two bars of 2 m x 1 m x 1 m that meet, held at their far ends.

  struct TwoBars
  {
    TwoBars(const unsigned int degree, const double dt) : model(mesh(), degree)
    {
      concrete.poisson = 0.;
      structure = assemble_structure(model, {concrete}, true);
      structure.pairs = find_pairs(model, 1);
      structure.n_joints = 1;
      structure.collect_interfaces();
      laws.of_joint.push_back(make_joint_law("FJA", LawParameters(.8)));
      laws.assign(structure);
      load = temperature_load(model, {concrete}, true, heat(10. + dt, 10. + dt), ".").load;
      system = std::make_unique<JointSystem>(structure, laws, ContactParameters(), StepOperator());
    }

    static HexMesh mesh()
    {
      HexMesh mesh = Grids::columns({{0., 1., 2.}, {2., 3., 4.}});
      mesh.faces.push_back({{0, 1, 2, 3}, PhysicalId::base});
      mesh.faces.push_back({{20, 21, 22, 23}, PhysicalId::base});
      for (const unsigned int k : {0, 4, 12, 16}) // y = 0 is upstream
        mesh.faces.push_back({{k, k + 3, k + 7, k + 4}, PhysicalId::upstream});
      return mesh;
    }

    void solve()
    {
      const std::size_t n = 3 * structure.pairs.size();
      force.assign(n, 0.);
      gap.assign(n, 0.);
      expect(system->solve(load, Unknowns(n, 0.), Unknowns(n, 0.), force, gap, u).converged, "convergence");
    }

    double mean_gap() const ///< over the joint of 1 m^2
    {
      double result = 0.;
      for (std::size_t p = 0; p < structure.pairs.size(); ++p)
        result += structure.pairs[p].area * gap[3 * p];
      return result;
    }

    double joint_force() const
    {
      double result = 0.;
      for (std::size_t p = 0; p < structure.pairs.size(); ++p)
        result += force[3 * p];
      return result;
    }

    Material                     concrete;
    SolidModel                   model;
    Structure                    structure;
    JointLaws                    laws;
    Unknowns                     load, force, gap, u;
    std::unique_ptr<JointSystem> system;
  };

  void joints()
  {
    const double a = 1e-5, dt = 15.;
    for (const unsigned int degree : {1, 2})
    {
      TwoBars cold(degree, -dt), warm(degree, dt);
      cold.solve();
      expect_close(cold.mean_gap(), a * dt * 4., 1e-9, "opening under cooling");
      expect(std::abs(cold.joint_force()) < 1e-9 * warm.concrete.young * a * dt,
             "an open joint has no force");
      warm.solve();
      expect_close(warm.joint_force(), warm.concrete.young * a * dt, 1e-9, "force under warming");
      below("gap of the warm bars, of what they would grow", std::abs(warm.mean_gap()) / (a * dt * 4.),
            1e-10);

      // Water in the open joint, up to z = 1 and to z = 0.6; then a closed one stays dry.
      const Unknowns dry = cold.load;
      for (const double level : {1.5, .6})
      {
        const auto pressure = [=](const double z) { return 1e4 * std::max(0., level - z); };
        JointWater water(cold.model, cold.structure);
        expect(water.spread(cold.system->states(), pressure) &&
                   !water.spread(cold.system->states(), pressure),
               "the water goes all the way at once");
        cold.load = dry;
        water.add_forces(pressure, cold.load);
        unsigned int n_below = 0;
        double       push = 0.;
        for (const Pair &pair : cold.structure.pairs)
        {
          n_below += pair.place[2] < level;
          push += pressure(pair.place[2]) * pair.area;
        }
        expect(water.n_wet() == n_below && n_below > 0, "pairs below the level are wet");
        if (level > 1.)
          expect_close(push, 1e4, 1e-12, "water in the joint");
        const double before = cold.mean_gap();
        cold.solve();
        // each bar of 2 m is compressed by the push over its section of 1 m^2
        expect_close(cold.mean_gap() - a * dt * 4., 4. * push / cold.concrete.young, 1e-9,
                     "opening by the water");
        expect(before > 0., "open");
        expect(std::abs(sum(cold.load)[0] - sum(dry)[0]) < 1e-6 * push, "the water pushes both sides alike");
      }
      JointWater shut(warm.model, warm.structure);
      expect(!shut.spread(warm.system->states(), [](double) { return 1e4; }) && shut.n_wet() == 0,
             "no water enters a closed joint");
    }
  }

  // Faces

  void add_tail_water(const SolidModel &model, const TailWaterParameters &water, Unknowns &load)
  {
    Scene scene;
    scene.loads.tail_water = water;
    add_traction(
        model, PhysicalId::downstream,
        [&](const double z, const Vector3 &normal) { return tail_water_traction(scene, 1., z, normal); },
        load);
  }

  void add_silt(const SolidModel &model, const SiltParameters &silt, Unknowns &load)
  {
    Scene scene;
    scene.loads.silt = silt;
    add_traction(
        model, PhysicalId::upstream,
        [&](const double z, const Vector3 &normal) { return silt_traction(scene, 1., z, normal); }, load);
  }

  /** The tractions of the table give the forces of the loads, with the factors of the combination. */
  void tractions_of_table()
  {
    SolidModel model(wall({{2, 4, 6}}), 1);
    model.free_base();
    const Structure structure = assemble_structure(model, {Material()}, true);
    Scene           scene;
    scene.reservoir.level = scene.loads.silt.level = scene.loads.tail_water.level = .7 * tall;
    scene.loads.combinations["all"] = "water 1.5, silt 2, tail water 0.5";
    scene.loads.combination = "all";
    const KnownTraction           known = known_traction(scene);
    const std::vector<StaticLoad> loads = static_loads(scene, {model, structure, {Material()}});
    expect(loads.size() == 3 && loads[0].name == "water" && loads[1].name == "tail water", "three loads");
    Unknowns by_traction(3 * structure.n_nodes(), 0.), by_load(by_traction);
    for (const int surface : {PhysicalId::upstream, PhysicalId::downstream})
      add_traction(
          model, surface, [&](const double z, const Vector3 &n) { return known(surface, z, n); },
          by_traction);
    double error = 0., size = 0.;
    for (std::size_t i = 0; i < by_load.size(); ++i)
    {
      for (const StaticLoad &load : loads)
        by_load[i] += load.force[i];
      error = std::max(error, std::abs(by_load[i] - by_traction[i]));
      size = std::max(size, std::abs(by_load[i]));
    }
    below("forces of the loads against their tractions", error / size, 1e-13);
  }

  void faces()
  {
    for (const unsigned int degree : {1, 2})
    {
      SolidModel model(wall({{2, 4, 6}}), degree);
      model.free_base();
      TailWaterParameters tail;
      SiltParameters      silt;
      for (const double level : {30., 20., 17.}) // between nodes, too
      {
        tail.level = silt.level = level;
        Unknowns load(3 * model.first_equation.back(), 0.);
        add_tail_water(model, tail, load);
        expect_close(sum(load)[0], -9810. * level * level / 2. * wide, 1e-3, "push of the tail water");
        TailWaterParameters salty = tail;
        salty.density = 1030.;
        Unknowns heavy(load.size(), 0.);
        add_tail_water(model, salty, heavy);
        expect_close(sum(heavy)[0], 1.03 * sum(load)[0], 1e-12, "push of tail water of 1030 kg/m3");
        Unknowns of_silt(load.size(), 0.);
        add_silt(model, silt, of_silt);
        expect_close(sum(of_silt)[0], 900. * 9.81 / 3. * level * level / 2. * wide, 1e-3,
                     "push of the silt, K = 1/3");
        silt.coefficient = .5;
        Unknowns half(load.size(), 0.);
        add_silt(model, silt, half);
        expect_close(sum(half)[0], 1.5 * sum(of_silt)[0], 1e-12, "K = 1/2");
        expect(std::abs(sum(half)[1]) + std::abs(sum(half)[2]) < 1e-9 * sum(half)[0], "along x");
        silt.coefficient = -1.;
      }
    }
    // The upstream face leans downstream by 0.2: silt rests on it; upstream: it bears nothing below.
    for (const double lean : {.2, -.2})
    {
      SolidModel model(wall({{2, 4, 6}},
                            [=](const Vector3 &x) {
                              return Vector3{{x[0] + lean * x[2], x[1], x[2]}};
                            }),
                       1);
      model.free_base();
      SiltParameters silt;
      silt.level = tall;
      Unknowns load(3 * model.first_equation.back(), 0.);
      add_silt(model, silt, load);
      const double vertical = 900. * 9.81 * tall * tall / 2. * wide;
      expect_close(sum(load)[0], vertical / 3., 1e-9, "push of the silt");
      expect_within(sum(load)[2], lean > 0. ? -.2 * vertical : 0., 1e-9 * vertical, "weight of the silt");
    }
  }

  /** A wall that is turned about the vertical by 30 degrees is pushed along its own axis. */
  void turned()
  {
    const double c = std::cos(pi / 6.), s = std::sin(pi / 6.);
    SolidModel   model(wall({{2, 4, 6}},
                            [=](const Vector3 &x) {
                            return Vector3{{c * x[0] - s * x[1], s * x[0] + c * x[1], x[2]}};
                          }),
                       1);
    model.free_base();
    SiltParameters      silt;
    TailWaterParameters tail;
    silt.level = tail.level = tall;
    Unknowns of_silt(3 * model.first_equation.back(), 0.), of_tail(of_silt);
    add_silt(model, silt, of_silt);
    add_tail_water(model, tail, of_tail);
    const double push = 900. * 9.81 / 3. * tall * tall / 2. * wide, back = 9810. * tall * tall / 2. * wide;
    expect_close(sum(of_silt)[0], push * c, 1e-9, "push of the silt on a turned wall, x");
    expect_close(sum(of_silt)[1], push * s, 1e-9, "push of the silt on a turned wall, y");
    expect_close(sum(of_tail)[0], -back * c, 1e-9, "push of the tail water on a turned wall, x");
    expect_close(sum(of_tail)[1], -back * s, 1e-9, "push of the tail water on a turned wall, y");
  }

  void uplift()
  {
    Scene scene;
    scene.reservoir.level = 24.;
    scene.loads.tail_water.level = 6.;
    const SolidModel model(wall({{4, 3, 2}}), 1); // held: the base has its uplift all the same
    const double     unit = 1000. * 9.81 * thick * wide;
    expect_close(sum(base_uplift(scene, model).force)[2], unit * (24. + 6.) / 2., 1e-12,
                 "uplift without drains");
    scene.loads.uplift.drain_position = .25;
    scene.loads.uplift.drain_efficiency = .5;
    const double at_drains = 6. + .5 * .75 * 18.;
    expect_close(sum(base_uplift(scene, model).force)[2],
                 unit * (.25 * (24. + at_drains) / 2. + .75 * (at_drains + 6.) / 2.), 1e-12,
                 "uplift with drains");
    scene.loads.uplift.drain_efficiency = 1.;
    expect_close(uplift_head(.6, 24., 6., scene.loads.uplift), 6., 1e-12, "behind perfect drains");
    const auto of_monolith = base_uplift(scene, model).of_monolith;
    expect(of_monolith.size() == 1, "monoliths");
    expect_close(of_monolith.at(1)[2], unit * (.25 * 15. + .75 * 6.), 1e-12, "uplift of the monolith");
    for (const double slope :
         {.4, .65, .8}) // of the downstream face: the toe is not the nearest point of the face
    {
      const SolidModel sloped(
          wall({{4, 3, 2}},
               [=](const Vector3 &x) {
                 return Vector3{{x[0] * (1. + slope * (tall - x[2]) / thick), x[1], x[2]}};
               }),
          1);
      for (const double efficiency : {0., .5})
      {
        scene.loads.uplift.drain_efficiency = efficiency;
        const double drained = 6. + (1. - efficiency) * .75 * 18.;
        expect_close(sum(base_uplift(scene, sloped).force)[2],
                     unit * (1. + slope * tall / thick) *
                         (.25 * (24. + drained) / 2. + .75 * (drained + 6.) / 2.),
                     1e-12, "uplift below a sloped face");
      }
    }
    // A base at z = 100 m; factors of water, tail water and uplift.
    const SolidModel high(wall({{4, 3, 2}},
                               [](const Vector3 &x) {
                                 return Vector3{{x[0], x[1], x[2] + 100.}};
                               }),
                          1);
    scene.reservoir.level = 124.;
    scene.loads.tail_water.level = 106.;
    scene.loads.uplift = UpliftParameters();
    expect_close(sum(base_uplift(scene, high).force)[2], unit * (24. + 6.) / 2., 1e-12,
                 "uplift of a high base");
    scene.loads.combinations["flood"] = "uplift 0.8, water 1.25, tail water 0.5";
    scene.loads.combination = "flood";
    expect_close(sum(base_uplift(scene, high).force)[2], .8 * unit * (1.25 * 24. + .5 * 6.) / 2., 1e-12,
                 "uplift with the factors of a combination");
  }

  void faces_and_base()
  {
    faces();
    turned();
    tractions_of_table();
    uplift();
  }

  // Nodes

  void nodes()
  {
    for (const unsigned int degree : {1, 2})
    {
      // Two monoliths, a joint at y = 10.
      const SolidModel model(open_joints(Grids::wall({{thick, wide, tall}}, {{2, 4, 3}}, 2)), degree);
      LoadParameters   loads;
      loads.concentrated = {{"hook", "0 10 30 1e3 -2e3 5e2"}, {"crane", "9.7 0.1 29 0 0 -7e4"}};
      Unknowns load(3 * model.first_equation.back(), 0.);
      add_concentrated(model, loads, load);
      const Vector3 total = sum(load);
      expect(distance_between(total, {{1e3, -2e3, -69500.}}) < 1e-9 * 7e4, "concentrated loads");
      loads.concentrated = {{"far", "0 10 80 1 0 0"}};
      expect_error([&] { add_concentrated(model, loads, load); },
                   {"Loads/Concentrated", "\"far\"", "from the dam"});
      loads.concentrated = {{"foot", "0 10 0 1 0 0"}};
      expect_error([&] { add_concentrated(model, loads, load); }, {"\"foot\"", "fixed base"});
      loads.concentrated = {{"short", "0 10 0 1 0"}};
      expect_error([&] { loads.check(); }, {"\"short\"", "six numbers"});
      loads.concentrated.clear();
      for (const std::string edge : {"upstream", "downstream"})
      {
        loads.crest_line = "2e3 0 -5e3";
        loads.crest_edge = edge;
        Unknowns line(load.size(), 0.);
        add_crest_line(model, loads, line);
        expect_close(sum(line)[0], 2e3 * wide, 1e-12, "line load along x");
        expect_close(sum(line)[2], -5e3 * wide, 1e-12, "line load along z");
        for (unsigned int i = 0; i < model.n_nodes(); ++i)
          if (model.equation[i] != rigid_ground && line[3 * model.equation[i]] != 0.)
            expect(model.points[i][2] == tall && model.points[i][0] == (edge == "upstream" ? 0. : thick),
                   "on the edge");
      }
      loads.crest_line = "1 2";
      expect_error([&] { loads.check(); }, {"Loads/Crest line", "three numbers"});
    }
  }

  /** The static state of a linear dam is that of one step without stages; a stop ends it before its end. */
  void static_state_of(Dam &dam, const double *levels)
  {
    Log               log(true);
    unsigned int      n_asked = 0;
    const StaticState state = static_state(dam, dam.scene.contact, log, [&] { ++n_asked; });
    expect(state.steps.size() == 6 && n_asked >= 6, "steps of the static state");
    for (unsigned int i = 0; i < 6; ++i)
      expect(state.steps[i].level == levels[i / 2 + 1] && state.steps[i].stage == i / 2 + 1 &&
                 state.steps[i].share == (i % 2 == 0 ? .5 : 1.),
             "row of step " + std::to_string(i));
    expect(state.steps[1].crown[0] > 0. && state.steps[5].crown[0] > 5. * state.steps[1].crown[0],
           "the crest moves downstream with the water");
    Scene at_once = dam.scene;
    at_once.statics.stages = "";
    at_once.statics.water_increments = 1;
    Dam               other(at_once);
    const StaticState whole = static_state(other, at_once.contact, log, [] {});
    expect(whole.steps.size() == 1, "one step without stages");
    double largest = 0., difference = 0.;
    for (std::size_t k = 0; k < state.u.size(); ++k)
    {
      largest = std::max(largest, std::abs(whole.u[k]));
      difference = std::max(difference, std::abs(whole.u[k] - state.u[k]));
    }
    below("static state in stages and at once, difference / largest displacement", difference / largest,
          1e-12);
    expect_error(
        [&]
        {
          n_asked = 0;
          static_state(other, at_once.contact, log,
                       [&]
                       {
                         if (++n_asked == 2)
                           throw InputError("stopped");
                       });
        },
        {"stopped"});
  }

  /** A reservoir that is filled to 10 m, to 24 m and to 30 m, each in two steps, with factors of weight and
   * water. Checks the water pressure after each step, and the crest under the staged weight: -rho g h^2/(2 E)
   * for nu = 0.
   */
  void stages()
  {
    write_gmsh(wall({{2, 4, 6}}), "stages_wall.msh");
    Scene scene;
    scene.mesh.source = "file";
    scene.mesh.file = "stages_wall.msh";
    scene.directory = ".";
    scene.joints.model = "tied";
    scene.concrete.poisson = 0.;
    scene.statics.gravity = 10.;
    scene.statics.stages = "fill 10, fill 24";
    scene.statics.water_increments = 2;
    scene.reservoir.level = 30.;
    scene.loads.combinations["flood"] = "weight 2, water 1.5";
    scene.loads.combination = "flood";
    Dam dam(scene);
    expect_close(dam.staged.crown[2], -2. * 2400. * 10. * tall * tall / (2. * scene.concrete.young), 1e-9,
                 "crest under twice its weight");
    const StaticPath path(dam);
    expect(path.n_parts() == 3 && !path.depends_on_increments(), "stages");
    const double levels[] = {0., 10., 24., 30.};
    for (unsigned int step = 0; step < 6; ++step)
      for (const double z : {4., 12.})
      {
        const double share = step % 2 == 0 ? .5 : 1., before = std::max(0., levels[step / 2] - z),
                     after = std::max(0., levels[step / 2 + 1] - z);
        expect_within(path.water_pressure(step / 2, share, z),
                      1.5e4 * (share * after + (1. - share) * before), 1e-6,
                      "pressure at z = " + text(z) + " in step " + std::to_string(step));
      }
    static_state_of(dam, levels);
  }

  void combinations()
  {
    stages();
    LoadParameters loads;
    expect(loads.factor("water") == 1. && loads.factor("earthquake") == 1., "without a combination");
    loads.combination = "usual";
    expect(loads.factor("tail water") == 1. && loads.factor("earthquake") == 0., "usual");
    loads.combinations["flood"] = "weight, water 1.1 , tail  water -0.5";
    loads.combination = "flood";
    expect(loads.factor("water") == 1.1 && loads.factor("tail water") == -.5 && loads.factor("silt") == 0.,
           "flood");
    loads.check();
    loads.combination = "Flood";
    expect_error([&] { loads.check(); }, {"Loads/Combination\"", "\"Flood\"", "Did you mean \"flood\"?"});
    loads.combinations["bad"] = "weight, watre 2";
    expect_error([&] { loads.check(); }, {"\"bad\"", "\"watre 2\"", "Did you mean \"water\"?"});
    loads.combinations["bad"] = "weight, weight 2";
    expect_error([&] { loads.check(); }, {"\"bad\"", "\"weight\" twice"});
    const auto stages = static_stages("grout 140, fill 100,day 90 , grout 210");
    expect(stages.size() == 4 && stages[1].kind == StaticStage::Kind::fill && stages[2].value == 90.,
           "stages");
    const auto joints = static_stages("grout 140 at 0.5 MPa, cut base 2 by 10 mm");
    expect(joints.size() == 2 && joints[0].value == 140. && joints[0].pressure == 5e5 &&
               joints[1].kind == StaticStage::Kind::cut && joints[1].joint == "base 2" &&
               joints[1].value == .01,
           "stages of joints");
    for (const char *bad :
         {"fill", "fill x", "fill 3 4", "empty 100", "fill -", "day 3 at 1", "cut 3", "cut 3 by 0"})
      expect_error([&] { static_stages(bad); }, {"Statics/Stages", bad});
  }
} // namespace

int main(int argc, char **argv)
{
  return run({{"temperature", temperature},
              {"joints", joints},
              {"faces", faces_and_base},
              {"nodes", nodes},
              {"combinations", combinations}},
             argc, argv);
}
