// SPDX-License-Identifier: GPL-3.0-or-later
// Meshes of hexahedra for tests: boxes, walls, bars of cubes, columns and distorted blocks.

#ifndef voussoir_tests_grids_h
#define voussoir_tests_grids_h

#include <voussoir/base/tensor3.h>
#include <voussoir/mesh/mesh.h>

#include <algorithm>
#include <array>
#include <functional>
#include <map>
#include <random>
#include <string>
#include <vector>

namespace Grids
{
  using namespace Voussoir;

  /** n[0] x n[1] x n[2] cells, without faces. Node (i, j, k) is at place(i, j, k), cell (i, j, k) in
   * volume(i, j, k); both are numbered i first, then j, then k. */
  struct Brick
  {
    std::array<unsigned int, 3> n;

    unsigned int node(const unsigned int i, const unsigned int j, const unsigned int k) const
    {
      return (k * (n[1] + 1) + j) * (n[0] + 1) + i;
    }

    HexMesh mesh(const std::function<Vector3(unsigned int, unsigned int, unsigned int)> &place,
                 const std::function<int(unsigned int, unsigned int, unsigned int)>     &volume) const
    {
      HexMesh mesh;
      for (unsigned int k = 0; k <= n[2]; ++k)
        for (unsigned int j = 0; j <= n[1]; ++j)
          for (unsigned int i = 0; i <= n[0]; ++i)
            mesh.nodes.push_back(place(i, j, k));
      for (unsigned int k = 0; k < n[2]; ++k)
        for (unsigned int j = 0; j < n[1]; ++j)
          for (unsigned int i = 0; i < n[0]; ++i)
          {
            HexMesh::Cell cell{{}, volume(i, j, k)};
            for (unsigned int v = 0; v < 8; ++v)
              cell.nodes[v] = node(i + (v % 4 == 1 || v % 4 == 2), j + (v % 4 > 1), k + (v > 3));
            mesh.cells.push_back(cell);
          }
      return mesh;
    }
  };

  /** A box of rock; node (i, j, k) at @p place. The faces named in @p artificial ("x-", "y+", "z-", ...) are
   * the artificial boundary. */
  inline HexMesh box(const std::array<unsigned int, 3> &n, const std::vector<std::string> &artificial,
                     const std::function<Vector3(double, double, double)> &place)
  {
    const Brick brick{n};
    HexMesh     mesh =
        brick.mesh(place, [](unsigned int, unsigned int, unsigned int) { return PhysicalId::first_rock; });
    for (std::size_t c = 0; c < mesh.cells.size(); ++c)
    {
      const unsigned int i = c % n[0], j = c / n[0] % n[1], k = c / (n[0] * n[1]);
      const auto         add =
          [&](const char *name, const unsigned int at, const unsigned int where, const unsigned int face)
      {
        if (at == where && std::find(artificial.begin(), artificial.end(), name) != artificial.end())
        {
          HexMesh::Face f{{}, PhysicalId::artificial};
          for (unsigned int v = 0; v < 4; ++v)
            f.nodes[v] = mesh.cells[c].nodes[hex_faces[face][v]];
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

  /** A dam that is a wall of the size @p size [m]: x = 0 is upstream, z = 0 the base; monolith 2 begins at
   * the place y of node @p split. @p place moves the nodes. */
  inline HexMesh wall(const Vector3 &size, const std::array<unsigned int, 3> &n, const unsigned int split,
                      const std::function<Vector3(const Vector3 &)> &place = nullptr)
  {
    const Brick brick{n};
    const auto  at = [&](const unsigned int i, const unsigned int j, const unsigned int k)
    {
      const Vector3 x = {{size[0] * i / n[0], size[1] * j / n[1], size[2] * k / n[2]}};
      return place ? place(x) : x;
    };
    HexMesh mesh =
        brick.mesh(at, [&](unsigned int, const unsigned int j, unsigned int) { return j < split ? 1 : 2; });
    const auto id = [&](const unsigned int i, const unsigned int j, const unsigned int k)
    { return brick.node(i, j, k); };
    for (unsigned int j = 0; j < n[1]; ++j)
      for (unsigned int k = 0; k < n[2]; ++k)
        for (const unsigned int i : {0u, n[0]})
          mesh.faces.push_back({{id(i, j, k), id(i, j + 1, k), id(i, j + 1, k + 1), id(i, j, k + 1)},
                                i == 0 ? PhysicalId::upstream : PhysicalId::downstream});
    for (unsigned int j = 0; j < n[1]; ++j)
      for (unsigned int i = 0; i < n[0]; ++i)
        for (const unsigned int k : {0u, n[2]})
          mesh.faces.push_back({{id(i, j, k), id(i + 1, j, k), id(i + 1, j + 1, k), id(i, j + 1, k)},
                                k == 0 ? PhysicalId::base : PhysicalId::crest});
    return mesh;
  }

  /** A bar of unit cubes along y, one monolith each, fixed at their bottom. */
  inline HexMesh bar(const unsigned int n)
  {
    HexMesh mesh;
    for (unsigned int j = 0; j <= n; ++j)
      for (const auto &p : {std::array<double, 2>{0, 0}, {1, 0}, {0, 1}, {1, 1}})
        mesh.nodes.push_back({p[0], double(j), p[1]});
    for (unsigned int j = 0; j < n; ++j)
    {
      const unsigned int a = 4 * j, b = a + 4;
      mesh.cells.push_back({{a, a + 1, b + 1, b, a + 2, a + 3, b + 3, b + 2}, int(j + 1)});
      mesh.faces.push_back({{a, a + 1, b + 1, b}, PhysicalId::base});
    }
    return mesh;
  }

  /** Bars of one cell each in cross-section, 1 m x 1 m, along x: bar b has its layers of nodes at layers[b].
   * Two bars that meet have a joint. */
  inline HexMesh columns(const std::vector<std::vector<double>> &layers)
  {
    HexMesh mesh;
    for (unsigned int b = 0; b < layers.size(); ++b)
      for (unsigned int i = 0; i < layers[b].size(); ++i)
      {
        const bool         is_last = i + 1 == layers[b].size();
        const unsigned int k = mesh.nodes.size();
        for (const auto &p : {std::array<double, 2>{0, 0}, {1, 0}, {1, 1}, {0, 1}})
          mesh.nodes.push_back({layers[b][i], p[0], p[1]});
        if (!is_last)
          mesh.cells.push_back({{k, k + 1, k + 2, k + 3, k + 4, k + 5, k + 6, k + 7}, int(b + 1)});
        if (is_last && b + 1 < layers.size())
          mesh.faces.push_back({{k, k + 1, k + 2, k + 3}, int(PhysicalId::joint_side_1 + b + 1)});
        if (i == 0 && b > 0)
          mesh.faces.push_back({{k, k + 1, k + 2, k + 3}, int(PhysicalId::joint_side_2 + b)});
      }
    return mesh;
  }

  /** The axes of blocks(). */
  const inline Matrix3 turn = {
      {2. / 3., -2. / 3., 1. / 3., 1. / 3., 2. / 3., 2. / 3., -2. / 3., -1. / 3., 2. / 3.}};

  /** Blocks of n_x x 3 x 3 distorted elements side by side along x, each 1 x 1.5 x 2, turned in space. */
  inline HexMesh blocks(const unsigned int n_blocks, const bool shared, const unsigned int n_x = 2)
  {
    std::mt19937 engine(3);
    const auto   shift = [&](const bool inside)
    { return inside ? .2 * (engine() / 2147483647.5 - 1.) : engine() * 0.; };
    HexMesh mesh;
    mesh.zones.resize(n_blocks);
    std::map<std::array<unsigned int, 4>, unsigned int> number;
    const auto                                          node =
        [&](const unsigned int block, const unsigned int i, const unsigned int j, const unsigned int k)
    {
      return number.at(
          {shared && i == 0 && block > 0 ? block - 1 : block, shared && i == 0 && block > 0 ? n_x : i, j, k});
    };
    for (unsigned int b = 0; b < n_blocks; ++b)
      for (unsigned int i = 0; i <= n_x; ++i)
        for (unsigned int j = 0; j < 4; ++j)
          for (unsigned int k = 0; k < 4; ++k)
          {
            if (i == 0 && b > 0) // the face of the block before
            {
              const unsigned int before = number.at({b - 1, n_x, j, k});
              number[{b, i, j, k}] = shared ? before : mesh.nodes.size();
              if (!shared)
                mesh.nodes.push_back(std::array<double, 3>(mesh.nodes[before]));
              continue;
            }
            const Vector3 x = {{b + (i + shift(i > 0 && i < n_x)) / n_x, (j + shift(j > 0 && j < 3)) * .5,
                                (k + shift(k > 0 && k < 3)) * 2. / 3.}};
            number[{b, i, j, k}] = mesh.nodes.size();
            mesh.nodes.push_back(turn * x);
          }
    for (unsigned int b = 0; b < n_blocks; ++b)
      for (unsigned int j = 0; j < 3; ++j)
        for (unsigned int k = 0; k < 3; ++k)
        {
          const auto face = [&](const unsigned int i) -> std::array<unsigned int, 4> {
            return {node(b, i, j, k), node(b, i, j + 1, k), node(b, i, j + 1, k + 1), node(b, i, j, k + 1)};
          };
          for (unsigned int i = 0; i < n_x; ++i)
          {
            HexMesh::Cell cell;
            for (unsigned int c = 0; c < 4; ++c)
              cell.nodes[c] = face(i)[c], cell.nodes[c + 4] = face(i + 1)[c];
            cell.volume = shared ? 1 : b + 1;
            cell.zone = b; // each block is one
            mesh.cells.push_back(cell);
          }
          if (b == 0)
            mesh.faces.push_back({face(0), PhysicalId::base});
          if (b + 1 == n_blocks)
            mesh.faces.push_back({face(n_x), PhysicalId::base});
          if (!shared && b > 0)
            mesh.faces.push_back({face(0), int(PhysicalId::joint_side_2 + b)});
          if (!shared && b + 1 < n_blocks)
            mesh.faces.push_back({face(n_x), int(PhysicalId::joint_side_1 + b + 1)});
        }
    return mesh;
  }
} // namespace Grids

#endif
