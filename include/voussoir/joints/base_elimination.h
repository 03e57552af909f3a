// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_base_elimination_h
#define voussoir_base_elimination_h

#include <voussoir/joints/condensed_body.h>

#include <map>

namespace Voussoir
{
  /** Values at the interface nodes of all bodies, such as displacements: three values per node, body after
   * body. */
  struct InterfaceValues
  {
    std::vector<double>      value;       ///< the values
    std::vector<std::size_t> begin = {0}; ///< index of the first value of each body, and the end

    /** Returns the first value of body @p b. */
    double       *of_body(const unsigned int b) { return value.data() + begin[b]; }
    const double *of_body(const unsigned int b) const { return value.data() + begin[b]; }
  };

  /** Elimination of the base nodes on a compliant support from the joint problem. L selects the base nodes.
   * Their displacement is L u = d - R f, with their displacement d without forces, the forces f of the support
   * on them and the compliance R of the support.
   *
   * With the operator A of the step, the matrix G of the jumps, F = share L A^-1 L^T, B = share G A^-1 L^T and
   * H = F + R,
   *
   * f = H^-1 (d - L u_0 - B^T f_joints),
   *
   * gap = (W - B H^-1 B^T) f_joints + b + B H^-1 (d - L u_0),
   *
   * where u_0 and b belong to zero forces at joints and base nodes. H couples the base nodes of one body, and
   * the base nodes that R couples; its Cholesky factor is sparse. B has dense blocks by body and group of pairs. */
  class BaseElimination
  {
  public:
    /** Base nodes and the compliance of the support. */
    struct Nodes
    {
      std::vector<unsigned int> node;       ///< interface nodes, numbered as in the structure, ascending
      BlockSparseMatrix         compliance; ///< R, symmetric [m/N]
    };

    /** Prepares the elimination. Call add_body() for all bodies, then factorise().
     * @param structure bodies and pairs; must outlive the object
     * @param nodes base nodes and compliance of the support
     * @param group group of each pair, ascending */
    BaseElimination(const Structure &structure, Nodes nodes, const std::vector<unsigned int> &group);

    /** Adds a body to H and B.
     * @param body index of the body
     * @param flexibility StepOperator::share times CondensedBody::take_flexibility() of the body [m/N] */
    void add_body(unsigned int body, const std::vector<double> &flexibility);

    /** Factorises H. Call it after add_body() of all bodies. */
    void factorise();

    /** Returns the number of unknowns, three per base node. */
    unsigned int n() const { return 3 * static_cast<unsigned int>(nodes.node.size()); }

    /** Copies the values of the base nodes from @p values to @p of_base, three values per base node. */
    void take_from(const InterfaceValues &values, Unknowns &of_base) const;

    /** Adds @p of_base, three values per base node, to @p values at the base nodes. */
    void add_to(InterfaceValues &values, const Unknowns &of_base) const;

    /** Computes @p x = H^-1 @p x. Before: displacements [m]; after: forces [N]; n() values. */
    void solve(Unknowns &x) const;

    /** Adds @p factor B @p f to @p gap. @p f: forces on the base nodes, n() values [N]; @p gap: three values
     * per pair [m]. */
    void add_gaps(double factor, const Unknowns &f, double *gap) const;

    /** Computes @p x = B^T @p f, the displacement of the base nodes by joint forces, n() values [m]. @p f:
     * three values per pair [N]. */
    void take_gaps(const double *f, Unknowns &x) const;

    /** Subtracts B H^-1 B^T @p f from @p gap. @p f: joint forces [N]; @p gap: gaps [m], three values per pair. */
    void subtract(const double *f, double *gap) const;

    /** Computes blocks of B H^-1 B^T for groups j <= k, counted from 0.
     * @param wants called as wants(j, k); returns true if the block is required
     * @param take called as take(j, k, part); receives the part of one body in the block, by column [m/N] */
    template <class Wants, class Take> void for_blocks(const Wants &wants, const Take &take) const;

    /** Returns the memory consumption [bytes]. */
    double memory() const;

  private:
    using Key = std::pair<unsigned int, unsigned int>; ///< group and body
    unsigned int        n_base_nodes(const unsigned int body) const { return first[body + 1] - first[body]; }
    unsigned int        n_rows(const unsigned int g) const { return begin[g + 1] - begin[g]; }
    std::vector<double> inverse_columns(unsigned int body) const;
    std::vector<double> product(const Key &rows, const std::vector<double> &columns, unsigned int n) const;
    std::vector<double> times_transposed(const std::vector<double> &columns, const Key &key) const;

    const Structure                   &structure;
    Nodes                              nodes;     ///< the compliance is moved to H
    std::vector<unsigned int>          group;     ///< of each pair
    std::vector<unsigned int>          begin;     ///< first row of each group
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
