// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_node_matrix_h
#define voussoir_node_matrix_h

#include <voussoir/base/tensor3.h>

#include <cstddef>

namespace Voussoir
{
  /** Sparse symmetric matrix of 3x3 blocks, a block row per node; all blocks are stored. */
  class BlockSparseMatrix
  {
  public:
    BlockSparseMatrix() = default;

    /** Pattern: sorted column nodes of every row, the diagonal included. All entries zero. */
    explicit BlockSparseMatrix(const std::vector<std::vector<unsigned int>> &columns);

    /** A(row, column) += block; the entry must be in the pattern. */
    void add(unsigned int row, unsigned int column, const Matrix3 &block);

    /** y = A x; both arrays have 3 n_rows() entries. */
    void multiply(const double *x, double *y) const;

    /** Replace the matrix by (A + A^T)/2: removes the round-off of assembly. */
    void symmetrise();

    unsigned int n_rows() const { return start.empty() ? 0 : static_cast<unsigned int>(start.size() - 1); }

    std::vector<std::size_t>  start; ///< of each row in column and value
    std::vector<unsigned int> column;
    std::vector<Matrix3>      value;
  };
} // namespace Voussoir

#endif
