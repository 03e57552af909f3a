// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_body_factor_h
#define voussoir_body_factor_h

#include <voussoir/joints/packed_factor.h>
#include <voussoir/solid/structure.h>

#include <memory>

namespace Voussoir
{
  /** The operator A = mass_factor M + stiffness_factor K + dashpot_factor D + springs of a body, and its
   * Cholesky factor by CHOLMOD. The interface is in natural order: component c of node i of body.interface is
   * number 3 i + c. */
  class BodyFactor
  {
  public:
    enum class Order
    {
      any,           ///< whatever fills least
      interface_last ///< then the trailing block of L is the factor of the condensed operator
    };

    /** @p springs: to the ground, per component of the structure [N/m], or empty. std::bad_alloc. */
    BodyFactor(const Structure &structure, const Body &body, double mass_factor, double stiffness_factor,
               double dashpot_factor, const Unknowns &springs = Unknowns());
    ~BodyFactor();
    BodyFactor(const BodyFactor &) = delete;

    /** Chooses an order and counts; a factor that was there before is gone. ComputationError for bodies whose
     * factor is too large. */
    void analyse(Order order);

    /** A = L L^T in that order. ComputationError when A is not positive definite (a body that nothing holds,
     * or bad elements), or, with the interface last, the body is not in one piece. */
    void factorise();

    double n_entries() const; ///< of L in leading columns (Order::interface_last) or all, once analysed

    /** Those of n_entries(), kept in @p single precision or double. The factor is gone afterwards, but for
     * its permutation. */
    PackedFactor take_leading_columns(bool single);

    /** Unknown of the body at each row of L. */
    std::vector<unsigned int> permutation() const;

    /** The condensed operator S, by column [N/m], and S^-1 [m/N], both symmetric; Order::interface_last. */
    std::vector<double> condensed_stiffness() const;
    std::vector<double> flexibility() const;

    unsigned int n() const { return 3 * body.n_nodes(); }
    unsigned int n_interface() const { return 3 * body.interface.size(); }

  private:
    struct Cholmod;
    void                check_interface_is_last() const;
    std::vector<double> trailing_block() const;
    std::vector<double> in_natural_order(const std::vector<double> &S) const;

    const Body              &body;
    Order                    order = Order::any;
    std::unique_ptr<Cholmod> cholmod;
  };

  /** Numbers of eight bytes that a CondensedBody holds, to a tenth. */
  struct FactorSize
  {
    double entries = 0.;   ///< of the factor
    double leading = 0.;   ///< of that with the interface last, before it
    double interface = 0.; ///< of the interface's flexibility, until it is taken
    double kept = 0.;      ///< of that afterwards
  };

  /** That without making it; @p neighbours of each node, ascending, the node itself included;
   * @p is_interface: nodes in pairs; @p single: kept in single precision. */
  FactorSize factor_size(const std::vector<std::vector<unsigned int>> &neighbours,
                         const std::vector<bool> &is_interface, bool single);

  /** Is it cheaper to solve twice with a factor of @p free entries than once with one of @p leading entries
   * before an interface of @p n_interface unknowns, whose flexibility is applied twice? */
  bool prefer_free_order(double free, double leading, double n_interface);
} // namespace Voussoir

#endif
