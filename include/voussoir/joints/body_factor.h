// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_body_factor_h
#define voussoir_body_factor_h

#include <voussoir/solid/structure.h>

#include <memory>

namespace Voussoir
{
  class PackedFactor;

  /** Linear system of a step: A u = load + share G^T f with A = mass M + stiffness K + damped K_c +
   * reaction E + springs, and the joint forces f. A static system has the mass 0. */
  struct StepOperator
  {
    double mass = 0.;      ///< factor of the mass matrix M [1/s^2]
    double stiffness = 1.; ///< factor of the stiffness matrix K [-]
    double share = 1.;     ///< 1: f are forces at the end of the step; 2: means over the step [-]

    double reaction = 0.; ///< factor of the reaction E of the water, Body::reaction [-]

    /** Additional factor of the mass matrix in a static system whose bodies only the joints hold [1/s^2]. */
    double proximal = 0.;

    double damped = 0.; ///< factor of the matrix K_c of Damping, Body::damped [-]

    bool has_mean_forces() const { return share != 1.; } ///< true if f are means over the step
  };

  /** Operator A of a body, see StepOperator, and its Cholesky factor L by CHOLMOD. The interface is in natural
   * order: component c of node i of body.interface has the number 3 i + c.
   *
   * Order of the calls: analyse(), factorise(), then the functions that return parts of the factor, and
   * take_leading_columns() last. analyse() begins a new order. */
  class BodyFactor
  {
  public:
    /** Order of elimination. */
    enum class Order
    {
      any,           ///< order with the least fill-in
      interface_last ///< interface last; the trailing block of L is the factor of the condensed operator
    };

    /** Assembles A of one body.
     * @param structure masses of all bodies
     * @param body stiffness and interface of the body; must outlive the object
     * @param step factors of the matrices
     * @param springs springs to the ground, three values per node of the structure [N/m]; empty: none
     *
     * Throws std::bad_alloc. */
    BodyFactor(const Structure &structure, const Body &body, const StepOperator &step,
               const Unknowns &springs = Unknowns());
    ~BodyFactor();
    BodyFactor(const BodyFactor &) = delete;

    /** Chooses the order and counts the entries of L. Discards an earlier factor. Throws FactorTooLarge. */
    void analyse(Order order);

    /** Computes A = L L^T in the order of analyse(). Throws ComputationError if A is not positive definite
     * (no support, or distorted elements). */
    void factorise();

    /** Returns the number of entries of L, after analyse(): those of the leading columns for
     * Order::interface_last, else of all columns. */
    double n_entries() const;

    /** Moves the columns that n_entries() counts to the result, in @p single or double precision. Call it
     * once, after the other functions: only permutation() remains valid. Requires factorise(). */
    std::unique_ptr<PackedFactor> take_leading_columns(bool single);

    /** Returns the unknown of the body, 3 node + component, for each of the n() rows of L. Requires
     * analyse(). */
    std::vector<unsigned int> permutation() const;

    /** Returns the condensed operator S of the interface, n_interface() x n_interface(), symmetric, by column
     * [N/m]. Requires factorise() with Order::interface_last. */
    std::vector<double> condensed_stiffness() const;
    /** Returns S^-1 in the same format [m/N]. Requires factorise() with Order::interface_last. */
    std::vector<double> flexibility() const;

    unsigned int n() const { return 3 * body.n_nodes(); } ///< number of unknowns of the body
    /** Returns the number of unknowns of the interface, three per entry of body.interface. */
    unsigned int n_interface() const { return 3 * body.interface.size(); }

  private:
    struct Cholmod;
    std::vector<double> trailing_block() const;
    std::vector<double> in_natural_order(const std::vector<double> &S) const;

    const Body              &body;
    Order                    order = Order::any;
    std::unique_ptr<Cholmod> cholmod;
  };

  /** Estimated memory of a CondensedBody, in numbers of eight bytes, accurate to a tenth. */
  struct FactorSize
  {
    double entries = 0.;   ///< factor
    double leading = 0.;   ///< leading columns of the factor with the interface last
    double interface = 0.; ///< flexibility of the interface, before take_flexibility()
    double kept = 0.;      ///< part that remains after take_flexibility()
  };

  /** Estimates the memory of a CondensedBody without computing the factor.
   * @param neighbours neighbours of each node, ascending, including the node itself
   * @param is_interface per node: whether it belongs to a pair
   * @param single factor in single precision */
  FactorSize factor_size(const std::vector<std::vector<unsigned int>> &neighbours,
                         const std::vector<bool> &is_interface, bool single);

  /** Returns whether two solutions with a factor of @p free entries cost less than one solution with
   * @p leading entries before an interface of @p n_interface unknowns. The flexibility of the interface is
   * applied twice. */
  bool prefer_free_order(double free, double leading, double n_interface);
} // namespace Voussoir

#endif
