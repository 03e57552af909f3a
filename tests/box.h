// Boxes of rock with an artificial boundary, for the tests of the explicit region.

#ifndef voussoir_tests_box_h
#define voussoir_tests_box_h

#include <voussoir/rock/rock_region.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

namespace Boxes
{
  using namespace Voussoir;

  constexpr int    rock = 1000;
  constexpr double pi = 3.14159265358979323846;

  /** c_s = 1 m/s, density 1 kg/m^3. */
  inline Material unit_rock(const double nu = .25)
  {
    Material m;
    m.density = 1.;
    m.poisson = nu;
    m.young = 2. * (1. + nu);
    return m;
  }

  /** n[0] x n[1] x n[2] cells; node (i, j, k) at @p place. The faces named in @p artificial ("x-", "y+",
   * "z-",
   * ...) are the artificial boundary. */
  inline HexMesh box(const std::array<unsigned int, 3> &n, const std::vector<std::string> &artificial,
                     const std::function<Vector3(double, double, double)> &place)
  {
    HexMesh    mesh;
    const auto id = [&](const unsigned int i, const unsigned int j, const unsigned int k)
    { return (k * (n[1] + 1) + j) * (n[0] + 1) + i; };
    for (unsigned int k = 0; k <= n[2]; ++k)
      for (unsigned int j = 0; j <= n[1]; ++j)
        for (unsigned int i = 0; i <= n[0]; ++i)
          mesh.nodes.push_back(place(i, j, k));
    for (unsigned int k = 0; k < n[2]; ++k)
      for (unsigned int j = 0; j < n[1]; ++j)
        for (unsigned int i = 0; i < n[0]; ++i)
        {
          HexMesh::Cell cell{{}, rock};
          for (unsigned int v = 0; v < 8; ++v)
            cell.nodes[v] = id(i + (v % 4 == 1 || v % 4 == 2), j + (v % 4 > 1), k + (v > 3));
          mesh.cells.push_back(cell);
          const auto add =
              [&](const char *name, const unsigned int at, const unsigned int where, const unsigned int face)
          {
            if (at == where && std::find(artificial.begin(), artificial.end(), name) != artificial.end())
            {
              HexMesh::Face f{{}, PhysicalId::artificial};
              for (unsigned int v = 0; v < 4; ++v)
                f.nodes[v] = cell.nodes[hex_faces[face][v]];
              mesh.faces.push_back(f);
            }
          };
          add("z-", k, 0, 0);
          add("z+", k + 1, n[2], 1);
          add("y-", j, 0, 2);
          add("x+", i + 1, n[0], 3);
          add("y+", j + 1, n[1], 4);
          add("x-", i, 0, 5);
        }
    return mesh;
  }

  /** Ricker wavelet with the dominant frequency @p f, its peak 1 at @p t0. */
  inline double ricker(const double t, const double f, const double t0)
  {
    const double a = pi * f * (t - t0);
    return (1. - 2. * a * a) * std::exp(-a * a);
  }
} // namespace Boxes

#endif
