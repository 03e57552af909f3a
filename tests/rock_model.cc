// SPDX-License-Identifier: GPL-3.0-or-later
// The model of the rock: its elements, and the lines and columns of cells at its artificial boundary.

#include <voussoir/rock/sections.h>

#include "box.h"

#include <random>

namespace
{
  using namespace Voussoir;
  using namespace Boxes;
  using namespace Testing;

  const std::vector<std::string> open_box = {"x-", "x+", "y-", "y+", "z-"};

  Vector3 unit_cells(const double i, const double j, const double k)
  {
    return {{i, j, k}};
  }

  RockParameters parameters(const bool nodal)
  {
    RockParameters p;
    p.materials[rock] = unit_rock();
    p.nodal_everywhere = nodal;
    p.nodal_layers = 0;
    return p;
  }

  /** The largest component of K u, over the largest of |K| |u|; of the nodes that are @p wanted. */
  double largest_force(const RockModel &model, const std::function<Vector3(const Vector3 &)> &u,
                       const std::function<bool(const Vector3 &)> &wanted)
  {
    Unknowns x(3 * model.points.size()), f(x), size(x.size(), 0.);
    for (std::size_t i = 0; i < model.points.size(); ++i)
      set(x, i, u(model.points[i]));
    const BlockSparseMatrix &K = model.stiffness;
    K.multiply(x.data(), f.data());
    double force = 0., scale = 0.;
    for (std::size_t i = 0; i < model.points.size(); ++i)
      for (unsigned int c = 0; c < 3; ++c)
      {
        double sum = 0.;
        for (std::size_t k = K.start[i]; k < K.start[i + 1]; ++k)
          for (unsigned int d = 0; d < 3; ++d)
            sum += std::abs(K.value[k][3 * c + d] * x[3 * std::size_t(K.column[k]) + d]);
        scale = std::max(scale, sum);
        if (wanted(model.points[i]))
          force = std::max(force, std::abs(f[3 * i + c]));
      }
    return force / scale;
  }

  /** Bent cells in a box with flat faces: mass, rigid motion and, of Gauss points, constant strain. */
  void elements()
  {
    std::mt19937 engine(5);
    const auto   place = [&](const double i, const double j, const double k) -> Vector3
    {
      Vector3 x = {{i, j, k}};
      for (unsigned int d = 0; d < 3; ++d)
        if (x[d] > 0. && x[d] < 5.)
          x[d] += .25 * (engine() / 2147483647.5 - 1.);
      return x;
    };
    const HexMesh mesh = box({5, 5, 5}, open_box, place);
    for (const bool nodal : {true, false})
    {
      const std::string name = nodal ? "nodal" : "Gauss";
      const RockModel   model = make_rock_model(mesh, parameters(nodal));
      double            mass = 0.;
      for (const double m : model.mass)
        mass += m;
      below(name + ": mass of a box / exact - 1", mass / 125. - 1., 1e-13);
      const auto all = [](const Vector3 &) { return true; };
      const auto inside = [](const Vector3 &x)
      { return *std::min_element(x.begin(), x.end()) > 0. && *std::max_element(x.begin(), x.end()) < 5.; };
      below("  force of a motion without strain",
            largest_force(
                model,
                [](const Vector3 &x) -> Vector3 {
                  return {{1. - 3. * x[1] + .5 * x[2], 2. + 3. * x[0] - x[2], 3. - .5 * x[0] + x[1]}};
                },
                all),
            1e-13);
      const double strained = largest_force(
          model,
          [](const Vector3 &x) -> Vector3 {
            return {{x[0] + 2. * x[1], .5 * x[1] - x[2], 3. * x[2] + x[0]}};
          },
          inside);
      if (nodal)
        note("  of one with constant strain, inside", strained);
      else
        below("  of one with constant strain, inside", strained, 1e-13);
    }
  }

  /** Where the cells couple the two ends of a diagonal: nowhere with nodal quadrature, else in the core. */
  void layers()
  {
    const HexMesh  mesh = box({6, 6, 6}, open_box, unit_cells);
    RockParameters p = parameters(false);
    p.nodal_layers = 2;
    const RockModel model = make_rock_model(mesh, p);
    unsigned int    wrong = 0;
    for (unsigned int i = 0; i < model.points.size(); ++i)
    {
      const Vector3 &x = model.points[i];
      expect(x == mesh.nodes[i] && model.node[i] == i, "nodes have the mesh's order");
      bool is_coupled = false; // to the node behind the cell that it is the lowest corner of
      for (std::size_t k = model.stiffness.start[i]; k < model.stiffness.start[i + 1]; ++k)
      {
        const Vector3 d = model.points[model.stiffness.column[k]] - x;
        is_coupled = is_coupled || (d[0] == 1. && d[1] == 1. && d[2] == 1.);
      }
      const bool is_inner = x[0] >= 2. && x[0] < 4. && x[1] >= 2. && x[1] < 4. && x[2] >= 2. && x[2] < 6.;
      wrong += is_coupled != is_inner;
    }
    expect(wrong == 0, std::to_string(wrong) + " cells have another quadrature than their layer");
    expect(model.lines.size() == 7 * 7 * 7 - 5 * 5 * 6, "a line for each node of the boundary");
    for (const BoundaryLine &line : model.lines)
      expect(line.nodes.size() == 7 && line.position.back() == 6., "lines through the box");
    expect(model.columns.size() == 24, "columns around the box");
    double area = 0.;
    for (const BoundaryFace &face : model.faces)
      area += face.area;
    expect_within(area, 5. * 36., 1e-12, "area of the artificial boundary");
  }

  /** Ground with a step: of the stacks of cells beside a line, the longest counts. */
  void step()
  {
    HexMesh    mesh = box({4, 4, 4}, {"y-", "z-"}, unit_cells);
    const auto is_air = [&](const std::array<unsigned int, 8> &nodes)
    {
      const auto x = centre(mesh, nodes);
      return x[0] < 2. && x[2] > 2.;
    };
    std::vector<HexMesh::Cell> cells;
    for (const auto &cell : mesh.cells)
      if (!is_air(cell.nodes))
        cells.push_back(cell);
    mesh.cells = cells;
    const RockModel model = make_rock_model(mesh, parameters(true));
    expect(model.points.size() == 125 - 2 * 5 * 2, "nodes of the air are none of the rock's");
    expect(model.columns.size() == 5, "columns at the side");
    for (const RockColumn &column : model.columns)
    {
      const Vector3 &foot = model.points[column.nodes[0]];
      expect(column.nodes.size() == (foot[0] < 2. ? 3 : 5), "the column at x = " + text(foot[0]));
      expect(column.z.back() == (foot[0] < 2. ? 2. : 4.), "and its height");
    }
    for (const BoundaryLine &line : model.lines)
    {
      const Vector3 &from = model.points[line.nodes[0]];
      const bool     is_side = from[1] == 0.;
      expect(line.nodes.size() == (is_side || from[0] >= 2. ? 5 : 3), "the line from x = " + text(from[0]));
    }
  }

  /** A column between two rocks has the mean of both, by their cells' widths, whichever the mesh names first.
   */
  void two_rocks()
  {
    for (const bool exchanged : {false, true})
    {
      HexMesh        mesh = box({2, 1, 3}, {"y-", "z-"},
                                [](const double i, const double j, const double k) -> Vector3 {
                           return {{i < 2. ? i : 4., j, k}};
                         });
      RockParameters p = parameters(true);
      p.materials[rock + 1] = Material{4., .1, 5.};
      for (HexMesh::Cell &cell : mesh.cells)
      {
        const auto x = centre(mesh, cell.nodes);
        cell.volume = x[0] > 1. && x[2] < 2. ? rock + 1 : rock;
      }
      if (exchanged)
        std::reverse(mesh.cells.begin(), mesh.cells.end());
      const RockModel model = make_rock_model(mesh, p);
      expect(model.columns.size() == 3, "three columns");
      for (const BoundaryLine &line : model.lines)
        if (const Vector3 &x = model.points[line.nodes[0]]; x[0] == 1. && x[1] == 0. && x[2] == 1.)
          expect_close(line.c_s, std::sqrt((.25 * 1. + .75 * 4. / 2.2) / (.25 * 1. + .75 * 5.)), 1e-13,
                       "speed between two rocks");
      for (const RockColumn &column : model.columns)
      {
        const double    x = model.points[column.nodes[0]][0];
        const Material &a = p.materials[rock], &b = p.materials[rock + 1];
        for (unsigned int k = 0; k < 3; ++k)
        {
          const double    share = k == 2 || x < 1. ? 0. : x > 1. ? 1. : .75;
          const Material &m = column.material.at(k);
          const auto      close = [&](double (*of)(const Material &), const std::string &what)
          { expect_close(of(m), share * of(b) + (1. - share) * of(a), 1e-13, what); };
          close([](const Material &y) { return y.density; }, "density");
          close([](const Material &y) { return y.density * std::pow(s_wave_speed(y), 2); }, "shear modulus");
          close([](const Material &y) { return y.density * std::pow(p_wave_speed(y), 2); }, "axial modulus");
          if (share == 0.)
            expect(m.young == a.young && m.poisson == a.poisson, "one rock is left as it is");
        }
      }
    }
  }

  /** The section of a valley's end, from the faces of the model. */
  void sections()
  {
    const HexMesh   mesh = box({3, 4, 5}, open_box,
                               [](const double i, const double j, const double k) -> Vector3 {
                               return {{i, j, k < 5. ? k : 5. - .2 * j}};
                             });
    const RockModel model = make_rock_model(mesh, parameters(true));
    for (const int sense : {-1, 1})
    {
      const HexMesh section = extruded_section(model, 0, sense);
      expect(section.cells.size() == 20 && section.nodes.size() == 60, "cells and nodes of a section");
      expect(section.faces.size() == 4 + 2 * 5, "artificial faces of a section");
      expect_within(volume(section), 20. - .2 * 4. * 4. / 2., 1e-12, "volume of a layer 1 m thick");
      for (const auto &cell : section.cells)
        expect(min_jacobian(section, cell) > 0., "cells are not inverted");
      const auto ends = bounding_box(section);
      expect((sense > 0 ? ends.second : ends.first)[0] == (sense > 0 ? 3. : 0.), "it ends at the face");
      const RockModel slice = make_rock_model(section, parameters(true), tie_layer(section, 0));
      expect(slice.points.size() == 30 && slice.columns.size() == 2, "its nodes are tied");
      expect(slice.lines.size() == 5 + 2 * 5, "its lines");
    }
    expect(extruded_section(make_rock_model(box({2, 2, 2}, {"z-"}, unit_cells), parameters(true)), 0, 1)
               .cells.empty(),
           "no side, no section");
  }
} // namespace

int main(int argc, char **argv)
{
  return run({{"elements", elements},
              {"layers", layers},
              {"step", step},
              {"two_rocks", two_rocks},
              {"sections", sections}},
             argc, argv);
}
