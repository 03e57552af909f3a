// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_base_elimination_h
#define voussoir_base_elimination_h

#include <voussoir/joints/condensed_body.h>

#include <map>

namespace Voussoir
{
  /** Three values for each interface node, body after body. */
  struct InterfaceValues
  {
    std::vector<double>      value;
    std::vector<std::size_t> begin = {0}; ///< begin of each body, and the end

    double       *of_body(const unsigned int b) { return value.data() + begin[b]; } ///< values of body b
    const double *of_body(const unsigned int b) const { return value.data() + begin[b]; }
  };

  /** Elimination of the base nodes on a compliant support from the joint problem. The displacement L u of the
   * base nodes is place - R f, with their displacement place without forces, the forces f on them and the
   * compliance R of the support.
   *
   * With F = share L A^-1 L^T, B = share G A^-1 L^T and H = F + R,
   *
   * f = H^-1 (place - L u_0 - B^T f_joints),
   *
   * gap = (W - B H^-1 B^T) f_joints + b + B H^-1 (place - L u_0),
   *
   * where u_0 and b belong to zero forces at joints and base nodes. H couples base nodes of one body, and
   * neighbours through R; its Cholesky factor is sparse. B has dense blocks by body and joint. */
  class BaseElimination
  {
  public:
    /** Base nodes and the compliance of the support. */
    struct Nodes
    {
      std::vector<unsigned int> node;       ///< interface nodes, numbered as in the structure, ascending
      BlockSparseMatrix         compliance; ///< R, symmetric [m/N]
    };

    /** Prepares the elimination. Call add_body() for all bodies, then factorise(). @p structure must outlive
     * the object. */
    BaseElimination(const Structure &structure, Nodes nodes);

    /** Adds share times the flexibility S^-1 of the interface of @p body (CondensedBody::take_flexibility(),
     * StepOperator::share). Call it for all bodies. */
    void add_body(unsigned int body, const std::vector<double> &flexibility);
    void factorise(); ///< factorises H; after add_body() of all bodies

    /** Returns the number of unknowns, three per base node. */
    unsigned int n() const { return 3 * static_cast<unsigned int>(nodes.node.size()); }

    /** Copies the values of the base nodes from the interface @p values to @p of_base. */
    void take_from(const InterfaceValues &values, Unknowns &of_base) const;
    /** Adds @p of_base to the interface @p values of the base nodes. */
    void add_to(InterfaceValues &values, const Unknowns &of_base) const;

    void solve(Unknowns &x) const;                                      ///< computes x = H^-1 x
    void add_gaps(double factor, const Unknowns &f, double *gap) const; ///< computes gap += factor B f
    void take_gaps(const double *f, Unknowns &x) const;                 ///< computes x = B^T f
    void subtract(const double *f, double *gap) const;                  ///< computes gap -= B H^-1 B^T f

    /** Computes blocks of B H^-1 B^T for pairs of joints j <= k. @p wants(j, k): whether the block is
     * required. @p take(j, k, part): receives the contribution of one body to the block, by column. */
    template <class Wants, class Take> void for_blocks(const Wants &wants, const Take &take) const;

    double memory() const; ///< memory consumption [bytes]

  private:
    using Key = std::pair<unsigned int, unsigned int>; ///< joint and body
    unsigned int        n_base_nodes(const unsigned int body) const { return first[body + 1] - first[body]; }
    unsigned int        n_rows(const unsigned int joint) const { return begin[joint + 1] - begin[joint]; }
    std::vector<double> inverse_columns(unsigned int body) const;
    std::vector<double> product(const Key &rows, const std::vector<double> &columns, unsigned int n) const;
    std::vector<double> times_transposed(const std::vector<double> &columns, const Key &key) const;

    const Structure                   &structure;
    Nodes                              nodes;     ///< the compliance is moved to H
    std::vector<unsigned int>          begin;     ///< first row of each joint
    std::vector<unsigned int>          first;     ///< first base node of each body
    std::vector<unsigned int>          interface; ///< per base node: its number in the interface of its body
    Structure                          H;         ///< stores the matrix H in its only body
    mutable std::vector<CondensedBody> factor;    ///< of H
    std::map<Key, std::vector<double>> B;         ///< blocks of B, by column
  };

  template <class Wants, class Take>
  void BaseElimination::for_blocks(const Wants &wants, const Take &take) const
  {
    for (unsigned int c = 0; c + 1 < first.size(); ++c)
    {
      if (n_base_nodes(c) == 0)
        continue;
      const std::vector<double> columns = inverse_columns(c);
      for (const auto &right : B)
      {
        if (right.first.second != c)
          continue;
        const unsigned int        k = right.first.first;
        const std::vector<double> Y = times_transposed(columns, right.first);
        for (const auto &left : B)
          if (const unsigned int j = left.first.first; j <= k && wants(j, k))
            take(j, k, product(left.first, Y, n_rows(k)));
      }
    }
  }
} // namespace Voussoir

#endif
