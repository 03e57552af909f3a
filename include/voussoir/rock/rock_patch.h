// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_rock_patch_h
#define voussoir_rock_patch_h

#include <voussoir/rock/rock_model.h>

namespace Voussoir
{
  /** The rock about some of its nodes, the feet of a dam, for a few steps of ExplicitRegion ahead: no wave
   * that is farther than as many layers of elements gets to the feet meanwhile. At step j of n only nodes
   * within n - j layers are stepped, which need no others.
   *
   *  A foot's place is u + dt w/2, w the velocity of half a step later: that of half a step after u. */
  class RockPatch
  {
  public:
    /** For at most @p n_steps. InputError where the artificial boundary is as near as that. */
    RockPatch(const RockModel &model, const RayleighDamping &damping, double dt,
              const std::vector<unsigned int> &feet, unsigned int n_steps);

    /** Places of the feet, three values each, after @p n_steps from the region's displacement @p u and
     * half-step velocity @p w [m, m/s], without forces of the dam. */
    Unknowns places(unsigned int n_steps, const Unknowns &u, const Unknowns &w) const;

    /** Places of the feet after @p n_steps from rest for unit forces held at the feet [m/N], symmetric. After
     * one step dt^2/(2 M). */
    BlockSparseMatrix compliance(unsigned int n_steps) const;

    const std::vector<unsigned int> &nodes() const { return node; } ///< of the region

    unsigned int n_feet() const { return n_layer[0]; }
    double       memory() const; ///< [bytes]

  private:
    void add_layers(const RockModel &model, unsigned int n_steps);
    void step(unsigned int n_left, const double *force, Unknowns &u, Unknowns &w, Unknowns &x) const;
    std::vector<std::vector<unsigned int>> reach(unsigned int n_steps) const;
    Unknowns                               feet_of(const Unknowns &u, const Unknowns &w) const;

    RayleighDamping           damping;
    double                    dt;
    std::vector<unsigned int> node;         ///< of the region, the feet first, then layer after layer
    std::vector<unsigned int> n_layer;      ///< nodes within 0, 1, ... layers of the feet
    std::vector<double>       inverse_mass; ///< of nodes with rows
    std::vector<std::size_t>  start;        ///< of the rows, all but those of the last layer
    std::vector<unsigned int> column;       ///< in node
    std::vector<Matrix3>      value;
  };
} // namespace Voussoir

#endif
