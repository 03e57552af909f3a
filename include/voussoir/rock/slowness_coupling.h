// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_slowness_coupling_h
#define voussoir_slowness_coupling_h

#include <voussoir/rock/rock_model.h>

namespace Voussoir
{
  /** Terms that a slowness p along x adds to a section in the y-z plane, whose fields have the form U(y, z, t - p x):
   * M_x u_x'' = -K_x u_x - G u_yz', M_yz u_yz'' = -K_yz u_yz + G^T u_x'. With nodal quadrature of weights w these are
   * - the masses of the nodes, less w p^2 (lambda + 2 mu) for u_x and w p^2 mu for u_y and u_z,
   * - the coupling G_ij = p sum of w (lambda N_i grad N_j - mu grad N_i N_j) of u_x at i with u_y, u_z at j. */
  class SlownessCoupling
  {
  public:
    /** Computes the terms. @p mesh: one layer of cells across x; @p model: its model, with tied nodes. */
    SlownessCoupling(const HexMesh &mesh, const RockModel &model, const std::map<int, Material> &materials,
                     double p);

    /** Adds G w_yz to the forces in x. @p w: three values per node. */
    void add_along(const Unknowns &w, Unknowns &force) const;

    /** Adds -G' w_x to the forces in y and z. */
    void add_across(const Unknowns &w, Unknowns &force) const;

    /** Masses to subtract, per node: for u_x, and for u_y and u_z [kg]. */
    std::vector<double> mass_along, mass_across;

  private:
    struct Entry
    {
      unsigned int i, j;
      double       y, z;
    };
    void               merge();
    std::vector<Entry> entries;
  };
} // namespace Voussoir

#endif
