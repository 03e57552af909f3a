// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_rock_operator_h
#define voussoir_rock_operator_h

#include <voussoir/base/node_matrix.h>
#include <voussoir/rock/nodal_kernel.h>
#include <voussoir/rock/rock_split.h>

namespace Voussoir
{
  /** A trilinear cell whose stiffness is integrated at its nodes. */
  struct NodalCell
  {
    std::array<unsigned int, 8> nodes;      ///< those along x first, then y, then z
    double                      lambda, mu; ///< Lame's constants [Pa]
  };

  /** The stiffness of a region, for products: without a matrix at nodes that have cells with nodal quadrature
   * only, whose forces come from the cells themselves (nodal_kernel.h), with a tenth of the data. All other
   * nodes have their rows of the matrix.
   *
   *  Cells are parted into blocks of neighbours, whose displacements and forces fit into a core's cache.
   * Nodes of several blocks get the sum of theirs in the blocks' order, so that products do not depend on the
   * number of threads. One product at a time: they share an array.
   *
   *  With several ranks each has its share of the blocks, and the rows of its own nodes. A product is right
   * at all nodes that the rank steps: it gets the forces that other ranks' blocks and rows give them, and
   * adds them up in the same order. */
  class RockOperator
  {
  public:
    /** @p stiffness: the whole matrix [N/m]; @p points: places of its nodes [m]; @p has_row: of each node,
     * does it keep its row? (All do without a @p kernel.) @p cells: at least all cells of the nodes that do
     * not. */
    RockOperator(const BlockSparseMatrix &stiffness, const std::vector<Vector3> &points,
                 const std::vector<NodalCell> &cells, const std::vector<bool> &has_row,
                 NodalKernel kernel = nodal_kernel());

    /** This rank's part of it. @p split: receives the nodes that the ranks' parts ask for. */
    RockOperator(const BlockSparseMatrix &stiffness, const std::vector<Vector3> &points,
                 const std::vector<NodalCell> &cells, const std::vector<bool> &has_row, NodalKernel kernel,
                 RockSplit &split);

    /** y = K x; both arrays have 3 n_rows() entries. */
    void multiply(const double *x, double *y) const;

    /** The same in two parts, between which the @p messages that it adds are to be exchanged. */
    void begin_product(const double *x, double *y, std::vector<Ranks::Message> &messages) const;
    void end_product(double *y) const;

    unsigned int n_rows() const { return n_nodes; }
    unsigned int n_matrix_rows() const { return static_cast<unsigned int>(row.size()); }
    std::size_t  memory() const; ///< of its arrays [bytes]

  private:
    /** Cells that are neighbours. Its nodes: first its own, then those that other blocks have, too, then
     * those with a row of the matrix, whose force it does not give. */
    struct Block
    {
      std::size_t  first_node; ///< in node and place
      unsigned int n_own, n_shared, n_nodes;
      unsigned int first_shared; ///< in shared_force, over 3
      unsigned int number;       ///< among those of all ranks
      unsigned int first_pack, n_packs;
    };

    /** Eight numbers that one read from memory brings. */
    struct alignas(64) CacheLine
    {
      double value[8];
    };

    struct Numbering;

    /** Forces to and from another rank: place in y, or in shared_force behind 3 n_nodes. */
    struct Partner
    {
      unsigned int                rank;
      std::vector<std::size_t>    send, receive;
      mutable std::vector<double> out, in;
    };

    void        keep_rows(const BlockSparseMatrix &stiffness, const std::vector<bool> &has_row);
    void        find_partners(const RockSplit &split, const Numbering &numbering);
    void        pack_forces(const double *y, std::vector<Ranks::Message> &messages) const;
    void        unpack_forces(double *y) const;
    void        add_block(const std::vector<NodalCell> &cells, const std::vector<unsigned int> &part,
                          const std::vector<Vector3> &points, Numbering &numbering);
    void        add_pack(const std::vector<const NodalCell *> &cells, Numbering &numbering);
    void        find_shared_nodes(const RockSplit &split, Numbering &numbering);
    std::size_t scratch_size() const
    {
      return std::size_t(most_nodes) + (most_nodes + 1) / 2;
    } ///< cache lines
    void multiply_row(std::size_t r, const double *x, double *y) const;
    void multiply_block(const Block &block, const double *x, double *y, CacheLine *scratch) const;
    void sum_shared(std::size_t i, double *y) const;

    NodalKernel  kernel;
    unsigned int n_nodes;        ///< of the region
    unsigned int most_nodes = 0; ///< of a block

    std::vector<Block>         blocks;
    std::vector<unsigned int>  node;    ///< of the region, block after block
    std::vector<Vector3>       place;   ///< of these nodes [m]
    std::vector<std::uint16_t> corner;  ///< as in NodalPacks, of all packs
    std::vector<double>        lame;    ///< as in NodalPacks
    std::vector<unsigned int>  lame_of; ///< as in NodalPacks, of all packs

    mutable std::vector<double> shared_force; ///< of the shared nodes, block after block
    std::vector<unsigned int>   shared_node;  ///< of several blocks
    std::vector<unsigned int>   shared_start; ///< of each of them, in shared_place
    std::vector<unsigned int>   shared_place; ///< in shared_force, over 3

    std::vector<Partner> partners;

    std::vector<unsigned int> row; ///< nodes that have one
    std::vector<std::size_t>  start;
    std::vector<unsigned int> column;
    std::vector<Matrix3>      value;
  };
} // namespace Voussoir

#endif
