// SPDX-License-Identifier: GPL-3.0-or-later
// Tests of the mesh and the matrices of compressible water.
#include "grids.h"
#include "testing.h"

#include <voussoir/base/error.h>
#include <voussoir/mesh/coincident.h>
#include <voussoir/water/acoustic_water.h>

#include <algorithm>
#include <cmath>
#include <map>

using namespace Voussoir;
using namespace Testing;

namespace
{
  constexpr double height = 60.;

  /** Faces of a wall x = slope (height - z) + bend y^2 over a valley with the half width at the height z. */
  template <class Width>
  std::vector<WetQuad> valley(const Width &half_width, const double slope = 0., const double bend = 0.)
  {
    constexpr unsigned int n_y = 24, n_z = 12;
    const auto             place = [&](const unsigned int i, const unsigned int k)
    {
      const double z = height * k / n_z, y = half_width(z) * (2. * i / n_y - 1.);
      return Vector3{{slope * (height - z) + bend * y * y, y, z}};
    };
    std::vector<WetQuad> faces;
    for (unsigned int i = 0; i < n_y; ++i)
      for (unsigned int k = 0; k < n_z; ++k)
        faces.push_back({{{place(i, k), place(i + 1, k), place(i + 1, k + 1), place(i, k + 1)}},
                         1 + static_cast<int>(i) / 8});
    return faces;
  }

  double area_of(const WaterSection &section)
  {
    double sum = 0.;
    for (const auto &cell : section.cells)
      for (unsigned int k = 0; k < 4; ++k)
      {
        const Point2 &a = section.points[cell[k]], &b = section.points[cell[(k + 1) % 4]];
        sum += .5 * (a[0] * b[1] - a[1] * b[0]);
      }
    return sum;
  }

  /** Sections of a box and of a trapezoid: area, nodes on bank and water line, x of the face, monoliths. */
  void sections()
  {
    const WaterSection box(valley([](double) { return 30.; }), height, 5.);
    expect_close(area_of(box), 60. * height, 1e-12, "area of a box");
    const auto         half = [](const double z) { return 20. + .7 * z; };
    const WaterSection section(valley(half, .2, .004), 45., 4.);
    expect_close(area_of(section), 45. * (40. + .7 * 45.), 3e-3, "area of a trapezoid below the water level");
    double off_bank = 0., off_face = 0., off_line = 0.;
    for (const unsigned int node : section.bank)
    {
      const auto [y, z] = section.points[node];
      off_bank = std::max(off_bank, z < 1e-9 ? 0. : std::abs(std::abs(y) - half(z)));
    }
    for (std::size_t i = 0; i < section.points.size(); ++i)
    {
      const auto [y, z] = section.points[i];
      off_face = std::max(off_face, std::abs(section.face_x[i] - .2 * (height - z) - .004 * y * y));
      off_line = std::max(off_line, section.at_surface[i] ? std::abs(z - 45.) : 0.);
      const double along = 12. * (1. + y / half(z)) / 8.;
      if (std::abs(along - std::round(along)) > 1e-3)
        expect(section.monolith[i] == 1 + static_cast<int>(along), "monolith of a node");
    }
    expect_within(off_bank, 0., 1e-9, "bank nodes on the bank");
    expect_within(off_line, 0., 1e-9, "nodes of the water line");
    // The faces are up to 4.3 m wide, and their columns diverge by 3.5 m: sags of .004 (4.3/2)^2 and .004 (3.5/2)^2.
    expect_within(off_face, 0., .031, "x of the bilinear faces");
  }

  /** Channel of a box: volume, closed surface, masses, stiffness, critical time step, increase of the mass. */
  void channel()
  {
    const WaterSection    section(valley([](double) { return 30.; }), height, 5.);
    const WaterProperties water{1000., 1440., .5, height, 120., 5.};
    const WaterMesh       mesh = make_channel(section, water);
    const WaterModel      model(mesh, water, 0.);
    const double          length = -mesh.points.back()[0];
    expect_close(model.volume, 60. * height * length, 1e-12, "volume");
    const double of_cubes = 5. / 1440.; // the elements at the corners of the bank are distorted
    expect(model.critical_step > .6 * of_cubes && model.critical_step < of_cubes, "critical time step");
    expect_close(model.mass_factor, 1., 1e-12, "no increase of the mass");
    double  mass = 0., bed = 0.;
    Vector3 ground{};
    for (unsigned int i = 0; i < model.n_nodes(); ++i)
    {
      mass += model.mass[i];
      bed += model.bed_damping[i];
      add(ground, model.ground[i]);
    }
    expect_close(mass, 1000. / 1440. / 1440. * model.volume, 1e-12, "mass");
    expect_close(bed, 1000. / 1440. / 3. * length * (60. + 2. * height), 1e-12,
                 "absorption by bed and banks");
    expect_close(ground[2], -60. * length, 1e-12, "area of the bed");
    expect_within(ground[0], 0., 1e-6, "areas along the channel");
    expect_within(ground[1], 0., 1e-6, "areas of both banks");
    std::vector<double> phi, K_phi;
    for (const Vector3 &x : mesh.points)
      phi.push_back(x[0] - 2. * x[1] + 3. * x[2]);
    model.multiply(phi, K_phi);
    double energy = 0.;
    for (std::size_t i = 0; i < phi.size(); ++i)
      energy += phi[i] * K_phi[i];
    expect_close(energy, 1000. * 14. * model.volume, 1e-12, "stiffness of a linear potential");
    const WaterModel increased(mesh, water, 5e-3);
    expect(increased.mass_factor > 1.05 && increased.mass_factor < 3.,
           "increase of the mass for a large step");
  }

  /** The far channel of a trapezoidal section: one layer as long as the last one of the channel. Between two layers a
   * potential that does not depend on x has the same product with K, and the same masses. */
  void far_channel()
  {
    const auto            half = [](const double z) { return 20. + .7 * z; };
    const WaterSection    section(valley(half), 50., 5.);
    const WaterProperties water{1000., 1440., .5, 50., 100., 5.};
    for (const double dt : {0., 2.6e-3})
    {
      const WaterMesh    mesh = make_channel(section, water), of_end = mesh.far_channel();
      const WaterModel   model(mesh, water, dt), far(of_end, water, dt);
      const unsigned int n = section.points.size(), last = model.n_nodes() - n;
      expect(far.n_nodes() == 2 * n && mesh.places.size() == n, "nodes");
      expect_close(of_end.points[0][0] - of_end.points[n][0], mesh.points[last - n][0] - mesh.points[last][0],
                   1e-9, "length of the layer");
      std::vector<double> phi, of_far, K_phi, K_far;
      for (unsigned int i = 0; i < model.n_nodes(); ++i)
        phi.push_back(std::sin(.1 * mesh.points[i][1]) * mesh.points[i][2] * mesh.points[i][2]);
      of_far.assign(phi.begin(), phi.begin() + 2 * n);
      model.multiply(phi, K_phi);
      far.multiply(of_far, K_far);
      double size = 0., off = 0., off_mass = 0., off_ground = 0., off_bed = 0.;
      for (unsigned int j = 0; j < n; ++j)
      {
        size = std::max(size, std::abs(K_far[n + j]));
        off = std::max(off, std::abs(K_far[n + j] - K_phi[last + j]) + std::abs(K_far[j] - K_phi[last + j]));
        off_mass = std::max(off_mass, std::abs(far.mass[n + j] / model.mass[last + j] - 1.));
        off_ground = std::max(off_ground, norm(far.ground[n + j] - model.ground[last + j]));
        off_bed = std::max(off_bed, std::abs(far.bed_damping[n + j] - model.bed_damping[last + j]));
      }
      expect_within(off / size, 0., 1e-9, "stiffness of a layer");
      expect_within(off_mass, 0., 1e-9, "mass of a layer, with its increase");
      expect_within(off_ground, 0., 1e-6, "bed and banks of a layer");
      expect_within(off_bed, 0., 1e-9, "absorption of a layer");
      expect_within(*std::max_element(far.end_damping.begin(), far.end_damping.end()), 0., 0., "free ends");
    }
  }

  /** Potential of incompressible water: a wall that moves with the velocity 1 in an infinite channel, added mass
   * 0.542755 rho H^2 per width. */
  void incompressible()
  {
    const WaterSection    section(valley([](double) { return 10.; }), height, 2.5);
    const WaterProperties water{1000., 1440., 1., height, 180., 2.5};
    const WaterModel      model(make_channel(section, water), water, 0.);
    std::vector<double>   source(model.n_nodes(), 0.);
    for (const auto &cell : section.cells)
      for (unsigned int k = 0; k < 4; ++k)
      {
        const Point2 &a = section.points[cell[k]], &b = section.points[cell[(k + 1) % 4]],
                     &c = section.points[cell[(k + 3) % 4]];
        source[cell[k]] += 1000. * .25 * ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]));
      }
    const std::vector<double> phi = model.solve(source);
    double                    added = 0.;
    for (std::size_t i = 0; i < phi.size(); ++i)
      added += phi[i] * source[i];
    expect_close(added / 20., .542755 * 1000. * height * height, 2e-3, "added mass of a wall");
  }

  /** Dynamic pressures of the wet face of a wall at rest over time, without gravity [Pa]. */
  std::vector<double> pressures(const GroundMotion &motion)
  {
    SolidModel    model(Grids::wall({{10., 20., 30.}}, {{1, 4, 6}}, 4, nullptr), 1);
    Structure     structure = assemble_structure(model, {Material()}, true);
    Foundation    rigid;
    AcousticWater water(model, structure, rigid, {1000., 1440., .8, 0., 0., 5.}, 30.);
    DynamicState  at_rest;
    at_rest.u.assign(3 * structure.n_nodes(), 0.);
    const TimeGrid grid{motion.dt, 1, static_cast<unsigned int>(motion.acceleration.size()) - 1};
    water.prepare(grid.dt, 1);
    water.start(motion, grid, at_rest.u);
    std::vector<double> result;
    Unknowns            load(at_rest.u.size());
    for (unsigned int i = 0; i < grid.n; ++i)
    {
      water.advance(load);
      water.update_from_dam(at_rest);
      const std::vector<double> now = water.pressure();
      result.insert(result.end(), now.begin(), now.end());
    }
    expect_within(water.balance_error(), 0., 1e-11, "energy balance");
    return result;
  }

  /** Both banks have the motion r across the valley and upward, and the ground is at rest. The pressures are those of
   * the ground motion r, because the wet face is normal to x. Then the left bank alone moves. */
  void banks()
  {
    GroundMotion moving, banked;
    moving.dt = banked.dt = 1e-3;
    for (unsigned int k = 0; k < 200; ++k)
    {
      const double s = std::sin(.05 * k);
      moving.acceleration.push_back({0., s, .7 * s * s});
    }
    banked.acceleration.assign(200, {0., 0., 0.});
    for (const bool is_left : {false, true})
      banked.stations.push_back({is_left, 0., moving.acceleration});
    const std::vector<double> expected = pressures(moving), found = pressures(banked);
    banked.stations.erase(banked.stations.begin());
    const std::vector<double> of_left = pressures(banked);
    double                    size = 0., off = 0., other = 0.;
    for (std::size_t i = 0; i < found.size(); ++i)
    {
      size = std::max(size, std::abs(expected[i]));
      off = std::max(off, std::abs(found[i] - expected[i]));
      other = std::max(other, std::abs(of_left[i] - expected[i]));
    }
    expect(size > 1e3, "the banks press the water");
    expect_within(off / size, 0., 1e-3, "motion of both banks against ground motion");
    expect(other > .2 * size, "the left bank alone");
  }

  /** The hexahedra of a channel as volumes of a mesh file. */
  HexMesh volumes_of(const WaterMesh &channel)
  {
    HexMesh mesh;
    mesh.nodes.assign(channel.points.rbegin(), channel.points.rend());
    const unsigned int last = mesh.nodes.size() - 1;
    for (const WaterMesh::Cell &cell : channel.cells) // of right-handed order: from the end to the dam
    {
      mesh.cells.push_back({{}, PhysicalId::water});
      for (unsigned int k = 0; k < 8; ++k)
        mesh.cells.back().nodes[k] = last - cell[(k + 4) % 8];
    }
    return mesh;
  }

  /** A channel whose hexahedra are volumes of a mesh file gives the same matrices. A shorter length adds a damping layer;
   * the named end is found, too. */
  void own_mesh()
  {
    const auto        half = [](const double z) { return 20. + .7 * z; };
    const auto        faces = valley(half);
    WaterProperties   water{1000., 1440., .5, 50., 100., 5.};
    const WaterMesh   channel = make_channel(WaterSection(faces, 50., 5.), water);
    HexMesh           file = volumes_of(channel);
    const WaterMesh   mesh = read_volumes(file, faces, 50., water);
    const WaterModel  expected(channel, water, 2.6e-3), found(mesh, water, 2.6e-3);
    const PointFinder finder(channel.points);
    const WaterMesh   far = mesh.far_channel();
    double            off = 0., off_area = 0., off_end = 0., off_far = 0.;
    expect(mesh.n_wet() == channel.n_wet() && mesh.bed.size() == channel.bed.size() &&
               mesh.end.size() == channel.end.size() && mesh.places.size() == channel.places.size(),
           "numbers of nodes and faces");
    for (unsigned int i = 0; i < found.n_nodes(); ++i)
    {
      const unsigned int j = finder.nearest(mesh.points[i]).number;
      expect(found.at_surface[i] == expected.at_surface[j] && (i < mesh.n_wet()) == (j < channel.n_wet()),
             "place of a node");
      off = std::max(off, std::abs(found.mass[i] / expected.mass[j] - 1.));
      off_area = std::max(off_area, norm(found.ground[i] - expected.ground[j]));
      off_end = std::max(off_end, std::abs(found.end_damping[i] - expected.end_damping[j]));
      const Vector3 &of_far = far.points[mesh.far[i]];
      off_far = std::max(off_far, std::hypot(of_far[1] - mesh.points[i][1], of_far[2] - mesh.points[i][2]));
    }
    expect_within(off, 0., 1e-9, "masses");
    expect_within(off_area, 0., 1e-9, "areas of bed and banks");
    expect_within(off_end, 0., 1e-9, "damping layer and dashpot");
    expect_within(off_far, 0., 1e-9, "node of the far channel with the same y and z");
    expect_close(mesh.wet_area[0], area_of(WaterSection(faces, 50., 5.)), 1e-9,
                 "wet area, normal out of the water");
    expect_close(far.points.back()[0] - far.points[0][0],
                 channel.points.back()[0] - channel.points[channel.points.size() - 1 - channel.n_wet()][0],
                 1e-9, "length of the far layer");
    const WaterMesh whole = read_volumes(file, faces, 50., water = {1000., 1440., .5, 50., 1e3, 5.});
    expect_within(*std::max_element(whole.layer.begin(), whole.layer.end()), 0., 0., "no damping layer");
    for (const WaterMesh::Face &face : channel.end)
      file.faces.push_back({face, PhysicalId::water_end});
    for (HexMesh::Face &face : file.faces)
      for (unsigned int &node : face.nodes)
        node = file.nodes.size() - 1 - node;
    file.faces.pop_back();
    expect(read_volumes(file, faces, 50., water).end.size() == channel.end.size() - 1, "named end");
  }

  void wrong_mesh()
  {
    const auto      faces = valley([](double) { return 30.; });
    WaterProperties water{1000., 1440., .5, height, 120., 10.};
    HexMesh         file = volumes_of(make_channel(WaterSection(faces, height, 10.), water));
    const auto      read = [&](const double level) { read_volumes(file, faces, level, water); };
    throws<InputError>("another level", [&] { read(55.); }, {"z = 60 m", "Water level is 55 m"});
    for (Vector3 &x : file.nodes)
      x[0] -= 3.;
    throws<InputError>("a gap", [&] { read(height); }, {"upstream", "3 m away"});
    for (Vector3 &x : file.nodes)
      x[0] = .1 * (x[0] + 3.);
    throws<InputError>("too short", [&] { read(height); }, {"depth of 60 m"});
  }

  /** The pressure of a height is that in the middle of the face, also between the nodes, at the bottom and at the level. */
  void pressure_points()
  {
    const auto            faces = valley([](const double z) { return 21. + .7 * z; });
    const WaterProperties water{1000., 1440., .5, height, 120., 15.};
    const WaterMesh       mesh = make_channel(WaterSection(faces, height, 15.), water);
    std::vector<double>   z;
    for (unsigned int i = 0; i < mesh.n_wet(); ++i)
      z.push_back(mesh.points[i][2]);
    for (const double at : {0., 7.3, 30., 55., 60.})
    {
      const PressurePoint point = pressure_point(mesh, at);
      expect_within(point.value(z), at, 1e-6, "value at the height");
      expect_within(point.place[1], 0., 1e-6, "middle of the face");
    }
  }

  /** Rigid walls in a mesh file that are errors of the mesh: nodes below the level, nodes that are not shared, a missing
   * layer. */
  void rigid_walls()
  {
    const auto      faces = valley([](double) { return 30.; });
    WaterProperties water{1000., 1440., .5, height, 120., 10.};
    const HexMesh   whole = volumes_of(make_channel(WaterSection(faces, height, 10.), water));
    const auto      read = [&](const HexMesh &file) { read_volumes(file, faces, height, water); };
    read(whole);
    HexMesh low = whole;
    for (Vector3 &x : low.nodes) // the surface near the dam remains at the level
      if (x[2] > height - 1e-6 && x[0] < -25.)
        x[2] -= .02;
    throws<InputError>("surface 2 cm below the level", [&] { read(low); }, {"rigid cover", "0.02 m below"});
    HexMesh apart = whole; // each cell beyond x = -25 m has its own nodes
    HexMesh gap = whole;
    gap.cells.clear();
    std::map<unsigned int, unsigned int> copy;
    for (HexMesh::Cell &cell : apart.cells)
    {
      const double x = centre(whole, cell.nodes)[0];
      if (x < -25. || x > -15.)
        gap.cells.push_back(cell);
      for (unsigned int &node : cell.nodes)
        if (x < -25.)
        {
          const auto [found, is_new] = copy.emplace(node, apart.nodes.size());
          if (is_new)
            apart.nodes.push_back(whole.nodes[node]);
          node = found->second;
        }
    }
    throws<InputError>("a missing layer", [&] { read(gap); }, {"no connection"});
    for (HexMesh::Cell &cell : apart.cells) // the parts remain connected at the banks
      for (unsigned int &node : cell.nodes)
        for (const auto &[old, its_copy] : copy)
          if (node == its_copy && std::abs(whole.nodes[old][1]) > 25.)
            node = old;
    throws<InputError>("nodes that are not shared", [&] { read(apart); }, {"water on both sides", "Merge"});
  }

  void wrong_sections()
  {
    auto faces = valley([](double) { return 30.; });
    throws<InputError>("level above", [&] { WaterSection(faces, 61., 5.); }, {"above", "61"});
    throws<InputError>("level below", [&] { WaterSection(faces, -1., 5.); }, {"level"});
    throws<InputError>("too coarse", [&] { WaterSection(faces, height, 40.); }, {"40 m"});
    faces[40].corners[0][1] += 20.;
    throws<InputError>("folded", [&] { WaterSection(faces, height, 5.); }, {"folded", "Westergaard"});
  }
} // namespace

int main()
{
  return run({{"sections", sections},
              {"channel", channel},
              {"far channel", far_channel},
              {"incompressible", incompressible},
              {"banks", banks},
              {"own mesh", own_mesh},
              {"wrong own mesh", wrong_mesh},
              {"pressure points", pressure_points},
              {"rigid walls", rigid_walls},
              {"wrong sections", wrong_sections}});
}
