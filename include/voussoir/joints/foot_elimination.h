// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_foot_elimination_h
#define voussoir_foot_elimination_h

#include <voussoir/joints/condensed_body.h>

#include <map>

namespace Voussoir
{
  /** Three numbers for each node of the interfaces, body after body. */
  struct InterfaceValues
  {
    std::vector<double>      value;
    std::vector<std::size_t> begin = {0}; ///< of each body, and the end

    double       *of_body(const unsigned int b) { return value.data() + begin[b]; }
    const double *of_body(const unsigned int b) const { return value.data() + begin[b]; }
  };

  /** Feet on a support that gives way: L u = place - R f, L u the displacement of the feet, f the forces on
   * them, eliminated from the problem of the joints. With F = L A^-1 L^T, B = G A^-1 L^T and H = F + R,
   *
   *      f = H^-1 (place - L u_0 - B^T f_joints),    gap = (W - B H^-1 B^T) f_joints + b + B H^-1 (place - L
   * u_0),
   *
   *  u_0, b without forces at joints and feet. H couples feet of a body, and through R neighbours; its
   * Cholesky factor is sparse. B is dense by body and joint. */
  class FootElimination
  {
  public:
    struct Feet
    {
      std::vector<unsigned int> node;       ///< of the structure, ascending; interface nodes of their bodies
      BlockSparseMatrix         compliance; ///< R, symmetric [m/N]
    };

    FootElimination(const Structure &structure, Feet feet);

    /** S^-1 of a body's interface, as CondensedBody::take_flexibility() gives it; of all bodies, one after
     * the other. */
    void add_body(unsigned int body, const std::vector<double> &flexibility);
    void factorise(); ///< after that

    unsigned int n() const { return 3 * static_cast<unsigned int>(feet.node.size()); }

    /** Of each body what its interface's @p values say of the feet, and back. */
    void take_from(const InterfaceValues &values, Unknowns &of_feet) const;
    void add_to(InterfaceValues &values, const Unknowns &of_feet) const;

    void solve(Unknowns &x) const;                                      ///< x = H^-1 x
    void add_gaps(double factor, const Unknowns &f, double *gap) const; ///< gap += factor B f
    void take_gaps(const double *f, Unknowns &x) const;                 ///< x = B^T f
    void subtract(const double *f, double *gap) const;                  ///< gap -= B H^-1 B^T f

    /** The block of joints @p j and @p k of B H^-1 B^T, handed to @p take by column for all that @p wants
     * names. */
    template <class Wants, class Take> void for_blocks(const Wants &wants, const Take &take) const;

    double memory() const; ///< [bytes]

  private:
    using Key = std::pair<unsigned int, unsigned int>; ///< joint and body
    unsigned int        n_feet(const unsigned int body) const { return first[body + 1] - first[body]; }
    unsigned int        n_rows(const unsigned int joint) const { return begin[joint + 1] - begin[joint]; }
    std::vector<double> inverse_columns(unsigned int body) const;
    std::vector<double> product(const Key &rows, const std::vector<double> &columns, unsigned int n) const;
    std::vector<double> times_transposed(const std::vector<double> &columns, const Key &key) const;

    const Structure                   &structure;
    Feet                               feet;      ///< its compliance until H has it
    std::vector<unsigned int>          begin;     ///< rows of each joint
    std::vector<unsigned int>          first;     ///< foot of each body
    std::vector<unsigned int>          interface; ///< of each foot, number among those of its body
    Structure                          H;         ///< its one body has the matrix
    mutable std::vector<CondensedBody> factor;    ///< of H
    std::map<Key, std::vector<double>> B;         ///< by column
  };

  template <class Wants, class Take>
  void FootElimination::for_blocks(const Wants &wants, const Take &take) const
  {
    for (unsigned int c = 0; c + 1 < first.size(); ++c)
    {
      if (n_feet(c) == 0)
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
