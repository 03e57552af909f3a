// SPDX-License-Identifier: GPL-3.0-or-later
// The rock around arch210, the grid lines of the artificial boundary, and bad meshes with rock.
// Writes its files into the working directory.

#include "mesh_testing.h"

#include <voussoir/mesh/boundary_lines.h>
#include <voussoir/mesh/coincident.h>
#include <voussoir/mesh/gmsh_io.h>
#include <voussoir/mesh/grading.h>
#include <voussoir/mesh/mesh_joints.h>
#include <voussoir/mesh/mesh_source.h>

#include <cstdio>

using namespace MeshTesting;

namespace
{
  MeshParameters parameters(const unsigned int n_joints, const unsigned int along, const unsigned int up,
                            const unsigned int through)
  {
    MeshParameters result;
    result.arch210.n_joints = n_joints;
    result.arch210.elements_along = along;
    result.arch210.elements_up = up;
    result.arch210.elements_through = through;
    result.arch210_rock.enabled = true;
    return result;
  }

  std::vector<bool> nodes_of(const HexMesh &mesh, const int surface)
  {
    std::vector<bool> result(mesh.nodes.size(), false);
    for (const auto &face : mesh.faces)
      if (face.surface == surface)
        for (const unsigned int node : face.nodes)
          result[node] = true;
    return result;
  }

  /** Every artificial node has a line as promised, to round-off; faces and ground of the block are right. */
  void expect_lines(const HexMesh &mesh, const unsigned int n_layers)
  {
    const auto lines = boundary_lines(mesh, n_layers, "rock");
    const auto artificial = nodes_of(mesh, PhysicalId::artificial),
               free = nodes_of(mesh, PhysicalId::free_surface);
    expect(lines.size() == static_cast<std::size_t>(std::count(artificial.begin(), artificial.end(), true)),
           "a line for every node");
    const auto   box = bounding_box(mesh);
    unsigned int of_face[5] = {};
    for (std::size_t l = 0; l < lines.size(); ++l)
    {
      const auto &line = lines[l];
      expect(artificial[line.nodes[0]] && (l == 0 || lines[l - 1].nodes[0] < line.nodes[0]),
             "the order of the lines");
      const auto &p = mesh.nodes[line.nodes[0]];
      const auto  expected = p[0] == box.first[0]    ? CutFace::upstream
                             : p[0] == box.second[0] ? CutFace::downstream
                             : p[1] == box.first[1]  ? CutFace::right
                             : p[1] == box.second[1] ? CutFace::left
                                                     : CutFace::bottom;
      expect(line.face == expected, "the face of a line at " + place(p));
      ++of_face[static_cast<unsigned int>(line.face)];
      expect(line.nodes.size() == n_layers + 1 && line.volume == 1000, "a line's nodes and volume");
      const unsigned int axis = normal_axis(line.face);
      for (unsigned int k = 0; k <= n_layers; ++k)
      {
        const auto &q = mesh.nodes[line.nodes[k]];
        for (unsigned int d = 0; d < 3; ++d)
          expect(d == axis ? std::abs(std::abs(q[d] - p[d]) - k * line.spacing) < 1e-10 : q[d] == p[d],
                 "the line at " + place(p) + " is not straight and uniform");
        expect(free[line.nodes[k]] == free[line.nodes[0]], "a line from the ground's edge leaves the ground");
      }
    }
    expect(of_face[0] == of_face[1] && of_face[2] == of_face[3], "symmetric numbers of lines");
    for (const unsigned int count : of_face)
      expect(count > 0, "all five faces have lines");
  }

  void test_shapes()
  {
    struct Case
    {
      unsigned int joints, along, up, through, layers;
      double       size, extent;
    };
    for (const Case &c :
         {Case{0, 58, 20, 1, 6, 22, 210}, Case{5, 60, 16, 2, 6, 22, 210}, Case{28, 58, 20, 3, 6, 22, 210},
          Case{5, 12, 4, 1, 8, 30, 300}, Case{28, 29, 8, 2, 6, 50, 100}, Case{1, 2, 1, 1, 6, 40, 210},
          Case{5, 60, 16, 3, 10, 15, 150}})
    {
      MeshParameters p = parameters(c.joints, c.along, c.up, c.through);
      auto          &rock = p.arch210_rock;
      rock.n_layers = c.layers;
      rock.element_size = c.size;
      rock.upstream = rock.downstream = rock.sides = rock.depth = c.extent;
      const HexMesh     mesh = make_mesh(p, "");
      const MeshQuality quality = mesh_quality(mesh, true);
      std::printf(
          "  %2u joints, %2u x %2u x %u, %2.0f m: %zu cells, edges %.2f to %.1f m, height %.2f m, scaled "
          "Jacobian %.3f\n",
          c.joints, c.along, c.up, c.through, c.size, mesh.cells.size(), quality.shortest_edge,
          quality.longest_edge, quality.smallest_height, quality.smallest_scaled_jacobian);
      expect(smallest_jacobian(mesh) > 0, "negative Jacobian");
      expect(quality.smallest_scaled_jacobian > 0.3, "distorted elements");
      expect_lines(mesh, c.layers);
    }
  }

  void test_conformity()
  {
    const MeshParameters p = parameters(28, 58, 20, 2);
    const HexMesh        dam = make_arch210(p.arch210), mesh = make_mesh(p, "");
    for (unsigned int n = 0; n < dam.nodes.size(); ++n)
      expect(mesh.nodes[n] == dam.nodes[n], "the dam's nodes stay");
    for (unsigned int c = 0; c < dam.cells.size(); ++c)
      expect(mesh.cells[c].nodes == dam.cells[c].nodes, "the dam's cells stay");
    const FaceTable table(mesh);
    unsigned int    n_base = 0;
    for (const auto &face : mesh.faces)
      if (face.surface == PhysicalId::base)
      {
        const auto owners = table.owners(face.nodes);
        expect(owners.second != nullptr && is_monolith(mesh.cells[owners.first->cell].volume) &&
                   mesh.cells[owners.second->cell].volume == 1000,
               "a base face without dam and rock");
        ++n_base;
      }
    expect(n_base == 58 * 2, "all of the base and none of the end walls is base");
    std::vector<bool> of_rock(mesh.nodes.size(), false);
    for (const auto &cell : mesh.cells)
      if (!is_monolith(cell.volume))
        for (const unsigned int node : cell.nodes)
          of_rock[node] = true;
    expect(std::count(of_rock.begin(), of_rock.begin() + dam.nodes.size(), true) == 59 * 3,
           "the rock shares the base nodes only");

    // Opened, the joints end at the rock.
    const HexMesh     opened = open_joints(mesh);
    const std::size_t doubled = open_joints(dam).nodes.size() - dam.nodes.size();
    expect(opened.nodes.size() == mesh.nodes.size() + doubled - 28 * 3 && joints_of(opened).size() == 28,
           "joints on rock");
    check_mesh(opened, "opened");
  }

  void test_volume()
  {
    // The block less the valley, whose width is integrated by Simpson's rule in t = (z/H)^(1/4).
    const MeshParameters p = parameters(5, 120, 16, 2);
    const HexMesh        mesh = make_mesh(p, "");
    const auto           box = bounding_box(mesh);
    const double         top = arch210_height - p.arch210.smallest_height;
    double               section = 0;
    const unsigned int   n = 1000;
    for (unsigned int i = 0; i <= n; ++i)
    {
      const double t = double(i) / n, weight = (i == 0 || i == n ? 1. : i % 2 == 1 ? 4. : 2.) / (3 * n);
      section += weight * 2 * arch210_half_width(top * std::pow(t, 4)) * top * 4 * std::pow(t, 3);
    }
    const double length = box.second[0] - box.first[0], width = box.second[1] - box.first[1];
    const double expected = length * (width * (top - box.first[2]) - section);
    std::printf("  valley section %.1f m2; rock %.6g m3, block less prism %.6g m3\n", section,
                volumes(mesh)[1000], expected);
    expect_close(volumes(mesh)[1000], expected, 0.002, "volume of the rock");
    const auto &r = p.arch210_rock;
    double      foot_min = 0, foot_max = 0; // of the base, along the stream
    for (const auto &face : mesh.faces)
      if (face.surface == PhysicalId::base)
        for (const unsigned int node : face.nodes)
        {
          foot_min = std::min(foot_min, mesh.nodes[node][0]);
          foot_max = std::max(foot_max, mesh.nodes[node][0]);
        }
    expect(std::abs(box.first[2] + r.depth) < 1e-9 && std::abs(box.first[0] - foot_min + r.upstream) < 1e-9 &&
               std::abs(box.second[0] - foot_max - r.downstream) < 1e-9,
           "extents");

    // The layers upstream are the prism over the section's polygon.
    double     polygon = width * (top - box.first[2]);
    const auto valley = arch_valley(arch210_shape(), p.arch210);
    for (std::size_t c = 1; c < valley.size(); ++c)
      polygon -= (top - 0.5 * (valley[c][1] + valley[c - 1][1])) * (valley[c][0] - valley[c - 1][0]);
    HexMesh layers = mesh;
    layers.cells.clear();
    const double h = std::min(r.element_size, r.upstream / (r.n_layers + 6));
    for (const auto &cell : mesh.cells)
      if (!is_monolith(cell.volume) && centre(mesh, cell.nodes)[0] < box.first[0] + r.n_layers * h)
        layers.cells.push_back(cell);
    expect_close(volume(layers), polygon * r.n_layers * h, 1e-10, "volume of the layers upstream");
  }

  /** Returns a measure of the dispersion of a vertical wave in a corner of the block: the sum of h^3 over its cells.
   */
  double dispersion(const double depth)
  {
    MeshParameters p = parameters(5, 30, 10, 1);
    p.arch210_rock.depth = depth;
    const HexMesh    mesh = make_mesh(p, "");
    const auto       box = bounding_box(mesh);
    std::set<double> heights;
    for (const auto &node : mesh.nodes)
      if (node[0] == box.first[0] && node[1] == box.second[1])
        heights.insert(node[2]);
    double sum = 0, below = *heights.begin();
    for (const double z : heights)
    {
      sum += std::pow(z - below, 3);
      below = z;
    }
    std::printf("  depth %g m: %zu cells from bottom to ground, sum of h^3 %.3g m3\n", depth,
                heights.size() - 1, sum);
    return sum;
  }

  void test_depth()
  {
    const double usual = dispersion(210), height = 210;
    for (const double depth : {315., 420., 630.})
      expect(dispersion(depth) / (depth + height) < 1.01 * usual / (210 + height),
             "waves disperse more per length of their path in deeper rock");
  }

  /** The cubic that fades from 1 to 0, level at both ends; sizes between two neighbours, each at most 1.35
   * times the next one. */
  void test_grading()
  {
    for (const auto &[x, exact] :
         {std::make_pair(0., 1.), {.25, 27. / 32.}, {.5, .5}, {.75, 5. / 32.}, {1., 0.}})
      expect(std::abs(fade(x) - exact) < 1e-12, "fade(" + std::to_string(x) + ")");
    for (const double last : {2., 10., 16.})
    {
      const double length = 100., first = 2.;
      const auto   ends = graded(n_graded(length, first, last, 16.), length, first, last);
      expect(ends[0] == 0. && ends.back() == length, "ends");
      double before = first;
      for (std::size_t i = 1; i <= ends.size(); ++i)
      {
        const double size = i < ends.size() ? ends[i] - ends[i - 1] : last;
        expect(size < 1.351 * before && before < 1.351 * size,
               std::to_string(before) + " m beside " + std::to_string(size) + " m");
        before = size;
      }
    }
  }

  void test_section()
  {
    // The grids of the up- and the downstream face are the same.
    const HexMesh                            mesh = make_mesh(parameters(5, 60, 16, 2), "");
    const auto                               box = bounding_box(mesh);
    std::multiset<std::pair<double, double>> upstream, downstream;
    for (const auto &node : mesh.nodes)
    {
      if (node[0] == box.first[0])
        upstream.insert({node[1], node[2]});
      if (node[0] == box.second[0])
        downstream.insert({node[1], node[2]});
    }
    expect(!upstream.empty() && upstream == downstream, "sections differ");
  }

  /** A larger block adds layers: it contains all nodes of the smaller one. */
  void test_nested()
  {
    MeshParameters p = parameters(5, 30, 10, 1);
    const HexMesh  small = make_mesh(p, "");
    for (double *length :
         {&p.arch210_rock.upstream, &p.arch210_rock.downstream, &p.arch210_rock.sides, &p.arch210_rock.depth})
      *length = 420;
    const HexMesh large = make_mesh(p, "");
    expect_close(bounding_box(large).first[2], -420., 1e-12, "depth of the larger block");
    expect(large.nodes.size() > 2 * small.nodes.size(), "larger block");
    const PointFinder finder(large.nodes, 1e-9);
    for (const auto &node : small.nodes)
      expect(finder.find(node) != PointFinder::none, "node of the smaller block at " + place(node));
    expect_lines(large, p.arch210_rock.n_layers);
  }

  void test_files()
  {
    MeshParameters p = parameters(5, 12, 4, 1);
    const HexMesh  mesh = make_mesh(p, "");
    for (const double version : {4.1, 2.2})
    {
      write_gmsh(mesh, "rock.msh", version);
      p.source = "file";
      p.file = "rock.msh";
      const HexMesh again = make_mesh(p, ".");
      expect_same(again, mesh);
      expect_lines(again, 6);
    }
  }

  /** A block of n x n x n unit cubes of rock, cut at five sides, with one cube of dam on its middle. */
  HexMesh block(const unsigned int n)
  {
    HexMesh    mesh;
    const auto node = [&](const unsigned int i, const unsigned int j, const unsigned int k)
    { return (k * (n + 1) + j) * (n + 1) + i; };
    for (unsigned int k = 0; k <= n; ++k)
      for (unsigned int j = 0; j <= n; ++j)
        for (unsigned int i = 0; i <= n; ++i)
          mesh.nodes.push_back({double(i), double(j), double(k)});
    for (unsigned int k = 0; k < n; ++k)
      for (unsigned int j = 0; j < n; ++j)
        for (unsigned int i = 0; i < n; ++i)
        {
          const HexMesh::Cell cell{{node(i, j, k), node(i + 1, j, k), node(i + 1, j + 1, k),
                                    node(i, j + 1, k), node(i, j, k + 1), node(i + 1, j, k + 1),
                                    node(i + 1, j + 1, k + 1), node(i, j + 1, k + 1)},
                                   1000};
          mesh.cells.push_back(cell);
          const bool outside[6] = {k == 0, k + 1 == n, j == 0, i + 1 == n, j + 1 == n, i == 0};
          for (unsigned int f = 0; f < 6; ++f)
            if (outside[f])
            {
              const bool    is_foot = f == 1 && i == n / 2 && j == n / 2;
              HexMesh::Face face{{},
                                 is_foot ? PhysicalId::base
                                         : (f == 1 ? PhysicalId::free_surface : PhysicalId::artificial)};
              for (unsigned int v = 0; v < 4; ++v)
                face.nodes[v] = cell.nodes[hex_faces[f][v]];
              mesh.faces.push_back(face);
            }
        }
    const unsigned int  m = n / 2, first = mesh.nodes.size();
    const HexMesh::Cell dam{{node(m, m, n), node(m + 1, m, n), node(m + 1, m + 1, n), node(m, m + 1, n),
                             first, first + 1, first + 2, first + 3},
                            1};
    for (unsigned int v = 0; v < 4; ++v)
    {
      auto p = mesh.nodes[dam.nodes[v]];
      p[2] += 1;
      mesh.nodes.push_back(p);
    }
    mesh.cells.push_back(dam);
    return mesh;
  }

  void test_bad_lines()
  {
    const HexMesh good = block(9);
    check_mesh(good, "block");
    expect(boundary_lines(good, 4, "block").size() == 36 * 10 + 8 * 8, "lines of the block");

    const auto bad = [&](const std::function<void(HexMesh &)> &spoil, const std::vector<std::string> &parts)
    {
      HexMesh mesh = good;
      spoil(mesh);
      expect_error([&] { boundary_lines(mesh, 4, "some.msh"); }, parts);
    };
    const auto shift = [](HexMesh &mesh, const unsigned int axis, const double at, const double by)
    {
      for (auto &node : mesh.nodes)
        if (node[axis] == at)
          node[axis] += by;
    };
    bad([&](HexMesh &m) { shift(m, 0, 2, 0.1); },
        {"some.msh", "upstream", "unequal spacing", "1 m", "equally thick"});
    bad([&](HexMesh &m) { shift(m, 1, 7, 0.1); }, {"left bank", "unequal spacing"});
    bad([&](HexMesh &m) { shift(m, 2, 1, 0.1); }, {"bottom", "unequal spacing"});
    bad([&](HexMesh &m) { m.nodes[5 * 100 + 5 * 10 + 3][2] += 0.2; },
        {"(0, 5, 5)", "upstream", "not straight", "node 3 of 4", "0.2 m in z", "extrude"});
    bad([&](HexMesh &m) { m.nodes[5 * 100 + 5 * 10][0] -= 0.2; }, {"in none of the planes"});
    bad(
        [](HexMesh &m) {
          m.faces.push_back({{900, 901, 911, 910}, PhysicalId::artificial});
        },
        {"in none of the planes", "free surface"});
    bad([](HexMesh &m) { m.cells[5 * 81 + 5 * 9 + 2].volume = 1001; }, {"material", "rock 1001", "layer 3"});
    expect_error([&] { boundary_lines(block(3), 4, "some.msh"); }, {"only 3 layers", "4 are needed"});

    // Layers of rock that end at the boundary are as they should be.
    HexMesh layered = good;
    for (auto &cell : layered.cells)
      if (!is_monolith(cell.volume) && centre(layered, cell.nodes)[2] > 5)
        cell.volume = 1001;
    expect(boundary_lines(layered, 4, "layered").size() == boundary_lines(good, 4, "good").size(),
           "layered rock");
    // The spacing may differ from line to line, but the lines of the faces across must stay straight.
    HexMesh sloping = good;
    for (auto &node : sloping.nodes)
      node[2] *= 1 + 0.02 * node[0] * (node[0] < 5 ? 0 : 1) + 1e-7 * node[1];
    expect_error([&] { boundary_lines(sloping, 4, "sloping"); }, {"downstream", "not straight"});
  }

  void test_bad_meshes()
  {
    const auto bad = [](const std::function<void(HexMesh &)> &spoil, const std::vector<std::string> &parts)
    {
      HexMesh mesh = block(3);
      spoil(mesh);
      expect_error([&] { check_mesh(mesh, "some.msh"); }, parts);
    };
    const auto erase = [](HexMesh &mesh, const int surface)
    {
      mesh.faces.erase(std::remove_if(mesh.faces.begin(), mesh.faces.end(),
                                      [&](const auto &face) { return face.surface == surface; }),
                       mesh.faces.end());
    };
    const auto part = [](HexMesh &mesh) // the dam gets nodes of its own
    {
      for (unsigned int v = 0; v < 4; ++v)
      {
        mesh.nodes.push_back(mesh.nodes[mesh.cells.back().nodes[v]]);
        mesh.cells.back().nodes[v] = mesh.nodes.size() - 1;
      }
    };
    bad([&](HexMesh &m) { part(m); }, {"'base'", "one hexahedron only", "share their nodes"});
    bad([&](HexMesh &m) { part(m), erase(m, PhysicalId::base); }, {"do not touch"});
    bad([&](HexMesh &m) { erase(m, PhysicalId::base); }, {"in no surface", "'base'"});
    bad([&](HexMesh &m) { erase(m, PhysicalId::artificial); }, {"the rock has no supports"});
    bad(
        [&](HexMesh &m) {
          m.faces.push_back({{64, 65, 66, 67}, PhysicalId::free_surface});
        },
        {"'free surface'", "belongs to the dam"});
    bad(
        [&](HexMesh &m) {
          m.faces.push_back({{64, 65, 66, 67}, PhysicalId::base});
        },
        {"between dam and rock"});
  }

  void test_bad_parameters()
  {
    const auto bad = [](const std::function<void(ArchRockParameters &)> &spoil, const std::string &part)
    {
      MeshParameters p = parameters(5, 12, 4, 1);
      spoil(p.arch210_rock);
      expect_error([&] { make_mesh(p, ""); }, {"\"Mesh/Arch210/Rock/" + part + "\""});
    };
    bad([](auto &rock) { rock.sides = 10; }, "Sides");
    bad([](auto &rock) { rock.element_size = 0; }, "Element size");
    bad([](auto &rock) { rock.n_layers = 3; }, "Boundary layers");
  }
} // namespace

int main()
{
  return run({{"shapes", test_shapes},
              {"conformity", test_conformity},
              {"volume", test_volume},
              {"depth", test_depth},
              {"grading", test_grading},
              {"section", test_section},
              {"nested", test_nested},
              {"files", test_files},
              {"bad lines", test_bad_lines},
              {"bad meshes", test_bad_meshes},
              {"bad parameters", test_bad_parameters}});
}
