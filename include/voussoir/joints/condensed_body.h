// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_condensed_body_h
#define voussoir_condensed_body_h

#include <voussoir/solid/structure.h>

#include <memory>

namespace Voussoir
{
  /** A body seen through its interface.
   *
   *  The operator A = mass_factor M + stiffness_factor K + dashpot_factor D + springs is factorised once,
   * A = L L^T, with the interface unknowns ordered last, so that the trailing block of L is the factor of the
   * condensed operator: S = L_GG L_GG^T. A step is then
   *
   *    forward(b)               y = L^-1 b, in which y_G is the condensed load
   *    interface_displacement() u_G = L_GG^-T y_G, without joint forces
   *    add_interface_forces(f)  y_G += L_GG^-1 f, the joint forces
   *    backward()               u = L^-T y
   *
   *  so one forward and one backward sweep per step, whatever the joints do. */
  class CondensedBody
  {
  public:
    /** @p springs: to the ground, per component of the structure [N/m], or empty.
     *  Throws ComputationError when A is not positive definite (a body that nothing holds, or bad elements),
     *  and std::bad_alloc. */
    CondensedBody(const Structure &structure, const Body &body, double mass_factor, double stiffness_factor,
                  double dashpot_factor, const Unknowns &springs = Unknowns());
    ~CondensedBody();
    CondensedBody(CondensedBody &&) noexcept;

    void forward(const double *b);                ///< b: 3 n_nodes, the body's part of the load
    void interface_displacement(double *u) const; ///< u: n_interface()
    void add_interface_forces(const double *f);   ///< f: n_interface()
    void backward(double *u);                     ///< u: 3 n_nodes

    unsigned int n_interface() const { return static_cast<unsigned int>(tail.size()); }

    /** Where component c of the interface node number i (in body.interface) stands in the interface arrays.
     */
    unsigned int position(const unsigned int i, const unsigned int c) const { return slot[3 * i + c]; }

    /** S itself, in the same order [N/m]. */
    std::vector<double> stiffness() const;

    /** S^-1, n_interface() x n_interface(), column by column (it is symmetric) [m/N]. */
    std::vector<double> flexibility() const;

    double memory() const; ///< [bytes]

  private:
    struct Factor;
    void find_interface(const Body &body, const std::vector<bool> &is_interface);
    void copy_interface_factor();

    std::unique_ptr<Factor>   factor;
    std::vector<unsigned int> tail;  ///< local unknown at each interface position
    std::vector<unsigned int> slot;  ///< the inverse, by interface node and component
    std::vector<double>       dense; ///< L_GG, column by column
  };

  /** Entries that the factor of a body would have, without making it: @p neighbours of each node, ascending,
   * the node itself included; @p is_interface: nodes that come last. To a tenth. */
  double entries_of_factor(const std::vector<std::vector<unsigned int>> &neighbours,
                           const std::vector<bool>                      &is_interface);
} // namespace Voussoir

#endif
