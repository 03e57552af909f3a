// SPDX-License-Identifier: GPL-3.0-or-later
// Rows of elements counted from the crest: relations to the mesh of equal rows, and of the mesh itself.
// Writes its files into the working directory.

#include "mesh_testing.h"

#include <voussoir/dam/dam.h>
#include <voussoir/mesh/arch_rock.h>
#include <voussoir/mesh/arch_rows.h>
#include <voussoir/mesh/arch_table.h>
#include <voussoir/mesh/mesh_joints.h>
#include <voussoir/mesh/mesh_source.h>
#include <voussoir/solid/critical_step.h>
#include <voussoir/solid/solid_model.h>
#include <voussoir/water/water_section.h>

#include <cstdio>
#include <functional>
#include <random>

using namespace MeshTesting;

namespace
{
  struct Size
  {
    unsigned int joints, along, up, through;
  };

  ArchGrid grid(const Size &size, const bool equal_rows = false)
  {
    Arch210Parameters result;
    result.n_joints = size.joints;
    result.elements_along = size.along;
    result.elements_up = size.up;
    result.elements_through = size.through;
    result.equal_rows = equal_rows;
    return result;
  }

  using Box = std::multiset<Point>;

  Box corners(const HexMesh &mesh, const std::vector<unsigned int> &nodes, const double sign_of_y = 1.)
  {
    Box result;
    for (const unsigned int node : nodes)
      result.insert(rounded({mesh.nodes[node][0], sign_of_y * mesh.nodes[node][1], mesh.nodes[node][2]}));
    return result;
  }

  std::multiset<Box> cells(const HexMesh &mesh, const double sign_of_y = 1.)
  {
    std::multiset<Box> result;
    for (const auto &cell : mesh.cells)
      result.insert(corners(mesh, {cell.nodes.begin(), cell.nodes.end()}, sign_of_y));
    return result;
  }

  /** Conforming: each face of one cell is on a surface. Both sides of a joint have the same nodes. */
  void expect_conforming(const ArchMesh &arch, const unsigned int through, const std::string &name)
  {
    const HexMesh &mesh = arch.mesh;
    check_mesh(mesh, name); // no inverted cell, no face of three cells
    std::vector<bool> is_base_node(mesh.nodes.size(), false);
    for (const unsigned int first : arch.base)
      std::fill_n(is_base_node.begin() + first, through + 1, true);
    const auto in_end_plane = [&](const unsigned int node, const unsigned int first)
    {
      const auto  &p = mesh.nodes[node], &a = mesh.nodes[first], &b = mesh.nodes[first + through];
      const double dx = b[0] - a[0], dy = b[1] - a[1];
      return std::abs((p[0] - a[0]) * dy - (p[1] - a[1]) * dx) < 1e-6 * std::hypot(dx, dy);
    };
    std::map<int, std::size_t> n_faces;
    for (const auto &face : mesh.faces)
    {
      const auto all = [&](const auto &condition)
      { return std::all_of(face.nodes.begin(), face.nodes.end(), condition); };
      if (face.surface == PhysicalId::base && !all([&](const unsigned int n) { return is_base_node[n]; }))
        expect(all([&](const unsigned int n) { return in_end_plane(n, arch.base.front()); }) ||
                   all([&](const unsigned int n) { return in_end_plane(n, arch.base.back()); }),
               name + ": a face inside has one cell");
      else
        ++n_faces[face.surface];
    }
    for (const int surface : {PhysicalId::base, PhysicalId::crest})
      expect(n_faces[surface] == (arch.base.size() - 1) * through, name + ": faces of base and crest");
    for (const int surface : {PhysicalId::upstream, PhysicalId::downstream})
      expect(n_faces[surface] == mesh.cells.size() / through, name + ": faces upstream and downstream");

    const HexMesh                                    opened = open_joints(mesh);
    std::map<int, std::array<std::multiset<Box>, 2>> sides;
    for (const auto &face : opened.faces)
      if (is_joint_side(face.surface))
        sides[number_of_joint(face.surface)][face.surface > PhysicalId::joint_side_2].insert(
            corners(opened, {face.nodes.begin(), face.nodes.end()}));
    expect(sides.size() == n_monoliths(mesh) - 1, name + ": joints");
    for (const auto &[joint, faces] : sides)
      expect(faces[0] == faces[1] && !faces[0].empty(), name + ": sides of joint " + std::to_string(joint));
  }

  /** Compares the bases, the rock and the volume with those of equal rows. */
  void expect_as_equal_rows(const ArchShape &shape, ArchGrid grid, const double height,
                            const std::string &name)
  {
    ArchMesh rows = make_arch(shape, grid);
    grid.equal_rows = true;
    ArchMesh equal = make_arch(shape, grid);
    expect(rows.base.size() == equal.base.size(), name + ": columns");
    for (std::size_t i = 0; i < rows.base.size(); ++i)
      for (unsigned int l = 0; l <= grid.elements_through; ++l)
        expect(rows.mesh.nodes[rows.base[i] + l] == equal.mesh.nodes[equal.base[i] + l],
               name + ": a base node");
    expect(rows.mesh.nodes.size() <= equal.mesh.nodes.size(), name + ": nodes");
    expect_close(volume(rows.mesh), volume(equal.mesh), 2e-3, name + ": volume");
    expect_close(crest_length(rows.mesh), crest_length(equal.mesh), 1e-12, name + ": crest");

    ArchRockParameters rock;
    rock.element_size = height / 5;
    const std::size_t n_rows = rows.mesh.cells.size(), n_equal = equal.mesh.cells.size();
    for (ArchMesh *arch : {&rows, &equal})
      add_arch_rock(shape, grid, rock.complete(height), *arch);
    expect(rows.mesh.cells.size() - n_rows == equal.mesh.cells.size() - n_equal,
           name + ": cells of the rock");
    for (std::size_t c = n_rows; c < rows.mesh.cells.size(); ++c)
      for (unsigned int v = 0; v < 8; ++v)
        expect(rows.mesh.nodes[rows.mesh.cells[c].nodes[v]] ==
                   equal.mesh.nodes[equal.mesh.cells[c - n_rows + n_equal].nodes[v]],
               name + ": a node of the rock");
    check_mesh(rows.mesh, name);
  }

  void test_arch210()
  {
    for (const Size &size :
         {Size{5, 60, 16, 2}, Size{28, 58, 20, 2}, Size{17, 58, 20, 1}, Size{0, 58, 20, 2},
          Size{5, 36, 12, 1}, Size{28, 87, 30, 3}, Size{5, 12, 4, 1}, Size{2, 6, 3, 1}, Size{60, 58, 20, 1}})
    {
      const std::string name = std::to_string(size.joints) + " joints, " + std::to_string(size.along) +
                               " x " + std::to_string(size.up) + " x " + std::to_string(size.through);
      const ArchGrid    g = grid(size);
      const ArchMesh    arch = make_arch(arch210_shape(), g);
      const HexMesh    &mesh = arch.mesh;
      const MeshQuality quality = mesh_quality(mesh, false),
                        equal = mesh_quality(make_arch(arch210_shape(), grid(size, true)).mesh, false);
      std::printf("  %s: %zu nodes, shortest edge %.3f (%.3f) m, scaled Jacobian %.3f (%.3f)\n", name.c_str(),
                  mesh.nodes.size(), quality.shortest_edge, equal.shortest_edge,
                  quality.smallest_scaled_jacobian, equal.smallest_scaled_jacobian);
      expect(mesh.remark.empty(), name + " has equal rows");
      expect(quality.smallest_scaled_jacobian >= .25, name + ": distorted");
      expect(cells(mesh) == cells(mesh, -1.), name + ": not symmetric");
      expect_conforming(arch, size.through, name);
      expect_as_equal_rows(arch210_shape(), g, arch210_height, name);
    }
  }

  /** Without templates the mesh is that of equal rows. Lift joints and a list of rows keep equal rows. */
  void test_equal_rows()
  {
    const Size size{5, 12, 2, 2};
    const auto equal = make_arch(arch210_shape(), grid(size, true)).mesh;
    expect_same(make_arch(arch210_shape(), grid(size)).mesh, equal);
    ArchGrid lifts = grid({5, 30, 10, 1});
    lifts.lift_joints = 2;
    HexMesh mesh = make_arch(arch210_shape(), lifts).mesh;
    expect(mesh.remark.find("Lift joints") != std::string::npos, "remark about lifts");
    lifts.equal_rows = true;
    const HexMesh old = make_arch(arch210_shape(), lifts).mesh;
    expect(old.remark.empty() && old.nodes == mesh.nodes, "rows with lift joints");
  }

  constexpr double degree = 3.14159265358979324 / 180;

  /** Ten dams with random circular arcs: every mesh is usable; most have rows from the crest, without slivers. */
  void test_arcs()
  {
    std::mt19937 random(57);
    const auto   draw = [&](const double from, const double to)
    { return from + (to - from) * (random() % 1000) / 1000.; };
    unsigned int n_equal = 0;
    for (unsigned int dam = 1; dam <= 10; ++dam)
    {
      const double H = draw(40, 250), width = draw(.35, .9) * H, right = draw(.8, 1.2), left = draw(.8, 1.2);
      std::ostringstream text;
      text << "elevation,upstream_x,upstream_radius,thickness,downstream_radius,right_angle,left_angle\n";
      for (const auto &[share, narrow, thick, x] :
           {std::array<double, 4>{0, .35, .16, -.06}, {.5, .75, .1, -.1}, {1, 1, .045, 0}})
      {
        const double chord = narrow * width, R = 1.25 * chord / (1 - .1 * (1 - share)), t = thick * H;
        const double angle = std::asin(chord / R) / degree;
        text << share * H << "," << x * H << "," << R << "," << t << "," << R - t << "," << right * angle
             << "," << left * angle << "\n";
      }
      write_text("rows.csv", text.str());
      ArcsParameters p;
      p.table = "rows.csv";
      p.grid.n_joints = random() % 12;
      p.grid.elements_along = (1 + random() % 4) * (p.grid.n_joints + 1) + random() % 20;
      p.grid.elements_up = 5 + random() % 16;
      p.grid.elements_through = 1 + random() % 3;
      p.grid.equal_rows = false;
      const auto        shape = p.shape(".");
      const std::string name = "dam " + std::to_string(dam);
      check_grid(*shape, p.grid, "Mesh/Arcs");
      const ArchMesh arch = make_arch(*shape, p.grid);
      const HexMesh &mesh = arch.mesh;
      p.grid.equal_rows = true;
      const HexMesh     old = make_arch(*shape, p.grid).mesh;
      const MeshQuality quality = mesh_quality(mesh, false), equal = mesh_quality(old, false);
      std::printf(
          "  %s: %.0f m, %u joints, %zu (%zu) nodes, least height %.3f (%.3f) m, scaled Jacobian %.3f (%.3f) %s\n",
          name.c_str(), H, p.grid.n_joints, mesh.nodes.size(), old.nodes.size(), quality.smallest_height,
          equal.smallest_height, quality.smallest_scaled_jacobian, equal.smallest_scaled_jacobian,
          mesh.remark.c_str());
      n_equal += !mesh.remark.empty();
      if (mesh.remark.empty())
        expect(quality.smallest_height > 1.1 * equal.smallest_height &&
                   quality.smallest_scaled_jacobian >= std::min(.1, equal.smallest_scaled_jacobian),
               name + ": distorted");
      else
        expect(mesh.nodes == old.nodes, name + ": equal rows");
      expect_conforming(arch, p.grid.elements_through, name);
      p.grid.equal_rows = false;
      expect_as_equal_rows(*shape, p.grid, H, name);
    }
    expect(n_equal > 0 && n_equal < 4, "dams with equal rows");
  }

  Scene scene(const Size &size, const bool equal_rows)
  {
    Scene result;
    result.mesh.source = "arch210";
    static_cast<ArchGrid &>(result.mesh.arch210) = grid(size, equal_rows);
    result.joints.model = "FJA";
    result.reservoir.density = 0.;
    return result;
  }

  /** Returns the critical step of the undamped dam without water [s]. */
  double critical_step(const Scene &scene)
  {
    const Dam           dam(scene);
    const Structure    &structure = dam.structure;
    std::vector<double> mass;
    for (const Matrix3 &m : structure.mass)
      mass.push_back(m[0]);
    Unknowns                                            u(3 * mass.size()), Ku;
    const std::function<void(const double *, double *)> multiply = [&](const double *x, double *y)
    {
      std::copy_n(x, u.size(), u.begin());
      structure.multiply_stiffness(u, Ku);
      std::copy(Ku.begin(), Ku.end(), y);
    };
    return 2. / largest_frequency(multiply, mass);
  }

  void test_critical_step()
  {
    const Size   quickstart{5, 60, 20, 3};
    const double rows = critical_step(scene(quickstart, false)),
                 equal = critical_step(scene(quickstart, true));
    std::printf("  quick start: critical step %.4f ms instead of %.4f ms\n", 1e3 * rows, 1e3 * equal);
    expect(rows > 5 * equal, "critical step");
  }

  /** The section of the reservoir finds its places on the wet face, also beside the distorted faces of the templates. */
  void test_water()
  {
    std::vector<double> x[2];
    for (const bool equal_rows : {false, true})
    {
      const HexMesh        mesh = make_arch(arch210_shape(), grid({5, 60, 20, 1}, equal_rows)).mesh;
      std::vector<WetQuad> faces;
      for (const auto &face : mesh.faces)
        if (face.surface == PhysicalId::upstream)
        {
          WetQuad quad{{}, 1};
          for (unsigned int k = 0; k < 4; ++k)
            quad.corners[k] = mesh.nodes[face.nodes[k]];
          faces.push_back(quad);
        }
      x[equal_rows] = WaterSection(faces, 195., 195. / 16.).face_x;
    }
    expect(x[0].size() == x[1].size(), "nodes of the section");
    double largest = 0.;
    for (std::size_t i = 0; i < x[0].size(); ++i)
      largest = std::max(largest, std::abs(x[0][i] - x[1][i]));
    std::printf("  wet face: largest difference of x from equal rows %.3f m\n", largest);
    expect(largest < .5, "the wet face");
  }

  /** Nodes inside bear no force under a linear displacement, also in the templates. */
  void test_patch()
  {
    const Scene s = scene({5, 60, 16, 2}, false);
    Dam         dam(s);
    dam.model->free_base();
    const Structure structure = assemble_structure(*dam.model, dam.materials, s.elements.incompatible_modes);
    const HexMesh   mesh = open_joints(s.hex_mesh());
    std::set<Point> outer;
    for (const auto &face : mesh.faces)
      for (const unsigned int node : face.nodes)
        outer.insert(rounded(mesh.nodes[node]));
    Unknowns u(3 * structure.n_nodes()), Ku;
    for (unsigned int i = 0; i < dam.model->n_nodes(); ++i)
    {
      const auto &p = dam.model->points[i];
      set(u, dam.model->equation[i],
          {.3 * p[0] - .7 * p[1] + .2 * p[2], .5 * p[0] + .9 * p[1] - .4 * p[2],
           -.6 * p[0] + .1 * p[1] + .8 * p[2]});
    }
    structure.multiply_stiffness(u, Ku);
    double       largest = 0., inner = 0., weight = 0.;
    unsigned int n_inner = 0;
    for (unsigned int i = 0; i < dam.model->n_nodes(); ++i)
    {
      const auto  &p = dam.model->points[i];
      const double force = norm(get(Ku, dam.model->equation[i]));
      const bool   is_inner = outer.count(rounded({p[0], p[1], p[2]})) == 0;
      n_inner += is_inner;
      (is_inner ? inner : largest) = std::max(is_inner ? inner : largest, force);
      weight += structure.mass[dam.model->equation[i]][0];
    }
    std::printf("  patch test: %u nodes inside, %.1e of the largest force\n", n_inner, inner / largest);
    expect(n_inner > 500 && inner < 1e-12 * largest, "patch test");
    expect_close(weight, s.concrete.density * volume(mesh), 1e-12, "mass");
  }
} // namespace

int main()
{
  return run({{"arch210", test_arch210},
              {"equal rows", test_equal_rows},
              {"arcs", test_arcs},
              {"water", test_water},
              {"patch test", test_patch},
              {"critical step", test_critical_step}});
}
