// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_rock_operator_h
#define voussoir_rock_operator_h

#include <voussoir/base/node_matrix.h>
#include <voussoir/rock/nodal_kernel.h>
#include <voussoir/rock/rock_split.h>

namespace Voussoir
{
  /** Trilinear cell with nodal quadrature of its stiffness. */
  struct NodalCell
  {
    std::array<unsigned int, 8> nodes;      ///< corners in lexicographic order: x fastest, then y, then z
    double                      lambda, mu; ///< Lame's constants [Pa]
  };

  /** Stiffness operator of a region. Nodes whose cells all have nodal quadrature need no matrix rows: their
   * forces are computed from the cells (nodal_kernel.h), with a tenth of the data. All other nodes have rows
   * of the matrix.
   *
   * The cells are divided into blocks of neighbours. The displacements and forces of a block fit into the
   * cache of a core. Contributions of several blocks to a node are added in the order of the blocks, so that
   * products do not depend on the number of threads. Products share a work array, so only one product may run
   * at a time.
   *
   * With several MPI processes each process has some of the blocks and the rows of its own nodes. A product
   * is complete at all nodes that the process integrates. It receives the missing forces from other processes
   * and adds them in the same order. */
  class RockOperator
  {
  public:
    /** Creates the operator of a whole region.
     * @param stiffness stiffness matrix [N/m]
     * @param points positions of the nodes [m]
     * @param cells cells with nodal quadrature: at least all cells of the nodes without rows
     * @param has_row per node: whether it keeps its matrix rows. Without a @p kernel all nodes keep them.
     * @param kernel see nodal_kernel() */
    RockOperator(const BlockSparseMatrix &stiffness, const std::vector<Vector3> &points,
                 const std::vector<NodalCell> &cells, const std::vector<bool> &has_row,
                 NodalKernel kernel = nodal_kernel());

    /** Creates the part of this MPI process. @p split: receives the nodes that the parts of
     * the processes require. */
    RockOperator(const BlockSparseMatrix &stiffness, const std::vector<Vector3> &points,
                 const std::vector<NodalCell> &cells, const std::vector<bool> &has_row, NodalKernel kernel,
                 RockSplit &split);

    /** Computes y = K x. Both arrays have 3 n_rows() values. */
    void multiply(const double *x, double *y) const;

    /** Begins the product of multiply(). The caller must exchange the appended @p messages
     * before end_product(). */
    void begin_product(const double *x, double *y, std::vector<Ranks::Message> &messages) const;
    /** Completes the product of begin_product(). */
    void end_product(double *y) const;

    unsigned int n_rows() const { return n_nodes; } ///< number of nodes of the region
    /** Returns the number of nodes with matrix rows. */
    unsigned int n_matrix_rows() const { return static_cast<unsigned int>(row.size()); }
    std::size_t  memory() const; ///< memory consumption [bytes]

  private:
    /** Block of neighbouring cells. Nodes in this order: own nodes of the block, nodes shared with other
     * blocks, nodes with matrix rows. The block computes no force for the last group. */
    struct Block
    {
      std::size_t  first_node; ///< index in node and place
      unsigned int n_own, n_shared, n_nodes;
      unsigned int first_shared; ///< index in shared_force, divided by 3
      unsigned int number;       ///< number among the blocks of all processes
      unsigned int first_pack, n_packs;
    };

    /** Eight numbers, which one access to memory reads. */
    struct alignas(64) CacheLine
    {
      double value[8];
    };

    struct Numbering;

    /** Forces exchanged with another process: indices in y, or in shared_force behind 3 n_nodes. */
    struct Partner
    {
      unsigned int                rank;
      std::vector<std::size_t>    send, receive;
      mutable std::vector<double> out, in;
    };

    void keep_rows(const BlockSparseMatrix &stiffness, const std::vector<bool> &has_row);
    void find_partners(const RockSplit &split, const Numbering &numbering);
    void pack_forces(const double *y, std::vector<Ranks::Message> &messages) const;
    void unpack_forces(double *y) const;
    void add_block(const std::vector<NodalCell> &cells, const std::vector<unsigned int> &part,
                   const std::vector<Vector3> &points, Numbering &numbering);
    void add_pack(const std::vector<const NodalCell *> &cells, Numbering &numbering);
    void find_shared_nodes(const RockSplit &split, Numbering &numbering);
    /** Returns the size of the work memory of a block [cache lines]. */
    std::size_t scratch_size() const { return std::size_t(most_nodes) + (most_nodes + 1) / 2; }
    void        multiply_row(std::size_t r, const double *x, double *y) const;
    void        multiply_block(const Block &block, const double *x, double *y, CacheLine *scratch) const;
    void        sum_shared(std::size_t i, double *y) const;

    NodalKernel  kernel;
    unsigned int n_nodes;        ///< number of nodes of the region
    unsigned int most_nodes = 0; ///< largest number of nodes of a block

    std::vector<Block>         blocks;
    std::vector<unsigned int>  node;    ///< nodes of the region, block after block
    std::vector<Vector3>       place;   ///< positions of these nodes [m]
    std::vector<std::uint16_t> corner;  ///< as in NodalPacks, of all packs
    std::vector<double>        lame;    ///< as in NodalPacks
    std::vector<unsigned int>  lame_of; ///< as in NodalPacks, of all packs

    mutable std::vector<double> shared_force; ///< forces on shared nodes, block after block [N]
    std::vector<unsigned int>   shared_node;  ///< nodes of several blocks
    std::vector<unsigned int>   shared_start; ///< begin of each shared node in shared_place
    std::vector<unsigned int>   shared_place; ///< index in shared_force, divided by 3

    std::vector<Partner> partners;

    std::vector<unsigned int> row; ///< nodes with matrix rows
    std::vector<std::size_t>  start;
    std::vector<unsigned int> column;
    std::vector<Matrix3>      value;
  };
} // namespace Voussoir

#endif
