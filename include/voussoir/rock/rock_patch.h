// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_rock_patch_h
#define voussoir_rock_patch_h

#include <voussoir/rock/rock_model.h>

namespace Voussoir
{
  /** Patch of the rock around the base nodes of the dam. It predicts a few steps of ExplicitRegion. A wave
   * crosses at most one layer of elements per step, so n steps need only the nodes within n layers. Step j
   * of n advances the nodes within n - j layers.
   *
   * The displacement of a base node is u + dt w/2: that of half a step after u. w is the velocity half a step
   * after u. */
  class RockPatch
  {
  public:
    /** Creates a patch for at most @p n_steps steps.
     * @param model rock model
     * @param damping Rayleigh damping of the rock
     * @param dt time step of the rock [s]
     * @param base_nodes base nodes of the dam
     * @param n_steps largest number of steps
     *
     * Throws InputError if fewer than @p n_steps layers lie between the base and the artificial boundary. */
    RockPatch(const RockModel &model, const RockDamping &damping, double dt,
              const std::vector<unsigned int> &base_nodes, unsigned int n_steps);

    /** Returns the displacement of the base nodes after @p n_steps steps without forces of the dam, three
     * values each [m]. @p u, @p w and @p damped: displacement [m], half-step velocity [m/s] and memory
     * variables of the region. */
    Unknowns places(unsigned int n_steps, const Unknowns &u, const Unknowns &w,
                    const DampedMotion &damped) const;

    /** Returns the displacement of the base nodes after @p n_steps steps from rest, for constant unit forces
     * on them [m/N]. The matrix is symmetric. After one step it is dt^2/(2 M). */
    BlockSparseMatrix compliance(unsigned int n_steps) const;

    const std::vector<unsigned int> &nodes() const { return node; } ///< nodes of the region in the patch

    unsigned int n_base_nodes() const { return n_layer[0]; } ///< number of base nodes

  private:
    void add_layers(const RockModel &model, unsigned int n_steps);

    /** Motion of the nodes. */
    struct Motion
    {
      Unknowns     u, w, x; ///< as in ExplicitRegion
      DampedMotion damped;
    };
    Motion at_rest(unsigned int n_steps) const;
    void   step(unsigned int n_left, const double *force, Motion &motion) const;

    std::vector<std::vector<unsigned int>> reach(unsigned int n_steps) const;
    Unknowns                               at_base(const Motion &motion) const;

    RockDamping               damping;
    double                    dt;
    std::vector<unsigned int> node;         ///< nodes of the region: base nodes first, then layer after layer
    std::vector<unsigned int> n_layer;      ///< number of nodes within 0, 1, ... layers of the base nodes
    std::vector<double>       inverse_mass; ///< per node with a matrix row [1/kg]
    std::vector<std::size_t>  start;        ///< begin of each row; the last layer has no rows
    std::vector<unsigned int> column;       ///< index in node
    std::vector<Matrix3>      value;
  };
} // namespace Voussoir

#endif
