// Distorted blocks of hexahedra with joints between them, for tests that need more than a column.

#ifndef voussoir_tests_blocks_h
#define voussoir_tests_blocks_h

#include "column.h"

namespace Columns
{
  const inline Matrix3 turn = {
      {2. / 3., -2. / 3., 1. / 3., 1. / 3., 2. / 3., 2. / 3., -2. / 3., -1. / 3., 2. / 3.}};

  /** Blocks of n_x x 3 x 3 distorted elements side by side along x, each 1 x 1.5 x 2, turned in space. */
  inline HexMesh blocks(const unsigned int n_blocks, const bool shared, const unsigned int n_x = 2)
  {
    std::mt19937 engine(3);
    const auto   shift = [&](const bool inside)
    { return inside ? .2 * (engine() / 2147483647.5 - 1.) : engine() * 0.; };
    HexMesh                                             mesh;
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

  inline Structure with_joints(const SolidModel &model, const std::vector<Material> &materials,
                               const bool modes = true)
  {
    Structure structure = assemble_structure(model, materials, modes);
    structure.n_joints = model.n_bodies() - 1;
    structure.pairs = find_pairs(model, structure.n_joints);
    structure.collect_interfaces();
    return structure;
  }

  inline double largest(const Unknowns &x)
  {
    double result = 0.;
    for (const double y : x)
      result = std::max(result, std::abs(y));
    return result;
  }

  inline Vector3 transposed(const Matrix3 &a, const Vector3 &x)
  {
    return {{a[0] * x[0] + a[3] * x[1] + a[6] * x[2], a[1] * x[0] + a[4] * x[1] + a[7] * x[2],
             a[2] * x[0] + a[5] * x[1] + a[8] * x[2]}};
  }
} // namespace Columns

#endif
