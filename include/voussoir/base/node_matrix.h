// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_node_matrix_h
#define voussoir_node_matrix_h

#include <voussoir/base/tensor3.h>

#include <cstddef>

namespace Voussoir
{
  /** Sparse symmetric matrix of 3x3 blocks with one block row per node. Both triangles are stored. */
  class BlockSparseMatrix
  {
  public:
    BlockSparseMatrix() = default;

    /** Creates a zero matrix. @p columns: for each row the sorted column nodes, with the diagonal. */
    explicit BlockSparseMatrix(const std::vector<std::vector<unsigned int>> &columns);

    /** Adds @p block to the entry A(row, column), which must be in the sparsity pattern. */
    void add(unsigned int row, unsigned int column, const Matrix3 &block);

    /** Computes y = A x. Both arrays have 3 n_rows() entries. */
    void multiply(const double *x, double *y) const;

    /** Adds zero blocks, so that the pattern contains the columns @p more of each row, in any order. */
    void extend(std::vector<std::vector<unsigned int>> more);

    /** Replaces the matrix by (A + A^T)/2, which removes the round-off of the assembly. */
    void symmetrise();

    unsigned int n_rows() const { return start.empty() ? 0 : static_cast<unsigned int>(start.size() - 1); }

    std::vector<std::size_t>  start;  ///< first entry of each row in column and value, and the end
    std::vector<unsigned int> column; ///< column node of each block
    std::vector<Matrix3>      value;  ///< blocks, row by row
  };
} // namespace Voussoir

#endif
