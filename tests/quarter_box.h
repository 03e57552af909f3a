// SPDX-License-Identifier: GPL-3.0-or-later
// A quarter box of rock (corner, edges, free surface) and a half plane after a push on the ground, and the
// known mistakes at their boundary: for the tests of long runs, and the gallery of failures.

#ifndef voussoir_tests_quarter_box_h
#define voussoir_tests_quarter_box_h

#include "box.h"

#include <voussoir/rock/sections.h>
#include <voussoir/rock/transmitting_boundary.h>

#include <algorithm>
#include <array>
#include <functional>
#include <map>

namespace QuarterBoxes
{
  using namespace Boxes;

  constexpr unsigned int n = 12; ///< cells of the quarter box in each direction

  struct Result
  {
    double       peak = 0., end = 0., energy_error = 0.; ///< max |u| of the first 1000 steps, at the end
    unsigned int steps = 0;                              ///< until it blew up
  };

  inline RockRegionParameters parameters(const std::string &boundary)
  {
    RockRegionParameters p;
    p.rock.materials[rock] = unit_rock();
    p.rock.nodal_everywhere = true;
    p.rock.centre = {{0., 0., double(n)}};
    p.boundary = boundary;
    p.dt = .3;
    return p;
  }

  /** A dam stands on the two cells of the ground next to x = y = 0. */
  inline void add_base(HexMesh &mesh, const double top)
  {
    const auto in = [&](const unsigned int node)
    { return mesh.nodes[node][0] < 2.5 && mesh.nodes[node][1] < 2.5 && mesh.nodes[node][2] == top; };
    for (const HexMesh::Cell &cell : mesh.cells)
    {
      HexMesh::Face f{{}, PhysicalId::base};
      for (unsigned int v = 0; v < 4; ++v)
        f.nodes[v] = cell.nodes[hex_faces[1][v]];
      if (std::all_of(f.nodes.begin(), f.nodes.end(), in))
        mesh.faces.push_back(f);
    }
  }

  inline RockModel quarter(const RockRegionParameters &p)
  {
    HexMesh mesh = box({n, n, n}, {"x+", "y+", "z-"},
                       [](const double i, const double j, const double k) -> Vector3 {
                         return {{i, j, k}};
                       });
    add_base(mesh, n);
    return make_rock_model(mesh, p.rock);
  }

  /** Plane strain in x and z, a half, the ground on top. */
  inline RockModel half_plane(const RockRegionParameters &p, const unsigned int nx, const unsigned int nz)
  {
    HexMesh mesh = box({nx, 1, nz}, {"x+", "z-"},
                       [](const double i, const double j, const double k) -> Vector3 {
                         return {{i, j, k}};
                       });
    add_base(mesh, nz);
    auto rock = p.rock;
    rock.centre = {{0., 0., double(nz)}};
    return make_rock_model(mesh, rock, tie_layer(mesh, 1));
  }

  inline std::array<long, 3> key(const std::array<double, 3> &p)
  {
    return {{std::lround(2. * p[0]), std::lround(2. * p[1]), std::lround(2. * p[2])}};
  }

  /** Components across the planes of symmetry x = 0 and y = 0. */
  inline std::vector<unsigned int> symmetry(const RockModel &model)
  {
    std::vector<unsigned int> fixed;
    for (unsigned int i = 0; i < model.points.size(); ++i)
      for (unsigned int c = 0; c < 2; ++c)
        if (model.points[i][c] == 0.)
          fixed.push_back(3 * i + c);
    return fixed;
  }

  /** @p see: called after each step with the region and its largest |u|. */
  inline Result run(const RockRegionParameters &p, const RockModel &model, const unsigned int n_steps,
                    const std::function<void(const ExplicitRegion &, double)> &see = nullptr)
  {
    auto         region = make_region(model, p);
    unsigned int source = 0;
    for (unsigned int i = 0; i < model.points.size(); ++i)
    {
      const auto &x = model.points[i];
      if (x[0] == 0. && x[1] == 0. && x[2] >= model.points[source][2])
        source = i; // on the ground
    }
    region->fix(symmetry(model));
    region->keep_energy();
    region->force.assign(3 * model.points.size(), 0.);
    Result result;
    double largest = 0.;
    for (unsigned int i = 0; i < n_steps; ++i)
    {
      const double t = (region->time() - 25.) / 8.;
      region->force[3 * source + 2] = -.25 * std::exp(-t * t);
      region->advance();
      ++result.steps;
      if (see || i < 1000 || i % 100 == 0 || i + 1 == n_steps)
      {
        double most = 0.;
        for (const double u : region->displacement())
          most = std::abs(u) <= most ? most : std::abs(u); // NaN stays
        result.end = most;
        if (see)
          see(*region, most);
        if (!(most < 1e6))
          break;
        if (i < 1000)
          result.peak = std::max(result.peak, most);
        const RegionEnergy &e = region->energy();
        largest = std::max(largest, e.kinetic + e.strain);
        result.energy_error = std::max(result.energy_error, std::abs(e.balance()));
      }
    }
    result.energy_error /= largest;
    return result;
  }

  /** mtf2 without its terms of geometric spreading. */
  inline std::unique_ptr<ArtificialBoundary> mtf2_without_gamma()
  {
    TransmittingFormula formula = mtf2();
    for (auto &f : formula.factors)
      f.gamma_p = f.gamma_s = 0.;
    return std::make_unique<TransmittingBoundary>(formula);
  }

  /** Lines of nodes on edges go inward at 45 degrees. */
  inline RockModel with_diagonal_lines(RockModel model, const std::array<int, 3> &cells, const bool plane)
  {
    std::map<std::array<long, 3>, unsigned int> number;
    for (unsigned int i = 0; i < model.points.size(); ++i)
      number[key(model.points[i])] = i;
    for (BoundaryLine &line : model.lines)
    {
      Vector3    x = model.points[line.nodes[0]];
      const auto step = [&](const unsigned int d) -> double {
        return d == 2 ? (x[2] == 0. ? 1. : 0.) : d == 1 && plane ? 0. : x[d] == cells[d] ? -1. : 0.;
      };
      const Vector3 inward = {{step(0), step(1), step(2)}};
      const double  square = inward[0] * inward[0] + inward[1] * inward[1] + inward[2] * inward[2];
      if (square < 1.5)
        continue;
      for (unsigned int k = 0; k < line.nodes.size(); ++k)
      {
        line.nodes[k] = number.at(key(x));
        line.position[k] = k * std::sqrt(square);
        for (unsigned int d = 0; d < 3; ++d)
          x[d] += inward[d];
      }
    }
    return model;
  }

} // namespace QuarterBoxes

#endif
