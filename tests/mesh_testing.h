// SPDX-License-Identifier: GPL-3.0-or-later
// Helpers of the tests of the mesh module.

#ifndef voussoir_tests_mesh_testing_h
#define voussoir_tests_mesh_testing_h

#include "grids.h"
#include "testing.h"

#include <voussoir/mesh/mesh.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace MeshTesting
{
  using namespace Voussoir;

  using namespace Testing;
  using Grids::bar;

  inline double smallest_jacobian(const HexMesh &mesh)
  {
    double result = 1e300;
    for (const auto &cell : mesh.cells)
      result = std::min(result, min_jacobian(mesh, cell));
    return result;
  }

  using Point = std::array<long, 3>; // rounded to about a micrometre

  inline Point rounded(const std::array<double, 3> &p)
  {
    const double scale = 0.7310587e6; // no decimal fraction is halfway between two integers
    return {std::lround(p[0] * scale), std::lround(p[1] * scale), std::lround(p[2] * scale)};
  }

  inline void expect_same(const HexMesh &a, const HexMesh &b)
  {
    expect(a.nodes.size() == b.nodes.size() && a.cells.size() == b.cells.size() &&
               a.faces.size() == b.faces.size(),
           "different numbers of nodes, cells or faces");
    for (unsigned int n = 0; n < a.nodes.size(); ++n)
      for (unsigned int d = 0; d < 3; ++d)
        expect(std::abs(a.nodes[n][d] - b.nodes[n][d]) <= 1e-15 * 300, "different coordinates");
    for (unsigned int c = 0; c < a.cells.size(); ++c)
      expect(a.cells[c].nodes == b.cells[c].nodes && a.cells[c].volume == b.cells[c].volume,
             "different cells");
    const auto sorted = [](const HexMesh &mesh)
    {
      std::multiset<std::pair<int, std::array<unsigned int, 4>>> faces;
      for (const auto &face : mesh.faces)
        faces.insert({face.surface, face.nodes});
      return faces;
    };
    expect(sorted(a) == sorted(b), "different faces");
    expect(a.names == b.names, "different names");
  }
} // namespace MeshTesting

#endif
