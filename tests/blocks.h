// SPDX-License-Identifier: GPL-3.0-or-later
// Structures of blocks with joints between them, for tests that need more than a column.

#ifndef voussoir_tests_blocks_h
#define voussoir_tests_blocks_h

#include "column.h"

namespace Columns
{
  using Grids::blocks;
  using Grids::turn;

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
