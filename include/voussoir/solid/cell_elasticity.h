// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_cell_elasticity_h
#define voussoir_cell_elasticity_h

#include <deal.II/fe/fe_values.h>
#include <deal.II/lac/full_matrix.h>

#include <voussoir/solid/material.h>
#include <voussoir/solid/structure.h>

namespace Voussoir
{
  /** Stiffness, mass and stress of one cell with n nodes. Incompatible modes are condensed (footings: zero).
   *
   * The stiffness of the dam is integrated at Gauss points. Nodal quadrature (QGaussLobatto(degree + 1))
   * serves explicit wave propagation. The lumped mass is the same for both.
   *
   * The incompatible modes are 1 - xi^2 (Wilson), with the Jacobian of the cell centre and the factor j_0/j
   * (Taylor, Beresford and Wilson 1976). A constant stress then does no work on the modes, so the patch
   * test is satisfied. */
  class CellElasticity
  {
  public:
    /** @param fe FE_Q of degree 1 or 2; must outlive the object
     * @param incompatible_modes only for degree 1
     *
     * Integrates the stiffness with degree + 1 Gauss points per direction. */
    CellElasticity(const dealii::FiniteElement<3> &fe, bool incompatible_modes);

    /** Integrates the stiffness with the quadrature @p of_stiffness. */
    CellElasticity(const dealii::FiniteElement<3> &fe, bool incompatible_modes,
                   const dealii::Quadrature<3> &of_stiffness);

    /** Computes #stiffness and #mass of a cell. */
    void reinit(const dealii::DoFHandler<3>::active_cell_iterator &cell, const Material &material);

    std::vector<Matrix3> stiffness; ///< n x n blocks, row by row [N/m]
    std::vector<double>  mass;      ///< lumped mass of each node [kg]

    /** Computes the stress at the n nodes for displacements of the n nodes. The stress is evaluated at the
     * 2x2x2 Gauss points, where it is most accurate, and extrapolated trilinearly. Call reinit() first.
     * @param blocks receives n x n blocks of 6 x 3 (xx yy zz xy yz zx), row by row; the block row is the node
     * of the stress [Pa/m] */
    void stress_operator(std::vector<std::array<double, 18>> &blocks);

    /** Computes the effect of an isotropic initial strain: sigma = D (eps - strain). Call reinit() first.
     * @param strain initial strain at the n nodes [-]
     * @param load receives the equivalent nodal forces, three values per node [N]
     * @param stress receives the stress at the n nodes without displacement (xx yy zz xy yz zx) [Pa] */
    void initial_strain(const std::vector<double> &strain, std::vector<double> &load,
                        std::vector<std::array<double, 6>> &stress);

  private:
    dealii::Tensor<1, 3> mode_gradient(const dealii::FEValues<3> &values, unsigned int q,
                                       unsigned int mode) const;
    void                 condense();

    const dealii::FiniteElement<3>             &fe;
    const bool                                  modes;
    dealii::FEValues<3>                         values, mass_values, stress_values, centre;
    dealii::FullMatrix<double>                  mode_of_displacement; ///< 9 x 3n
    dealii::FullMatrix<double>                  mode_of_force;        ///< 9 x 9, flexibility of the modes
    dealii::DoFHandler<3>::active_cell_iterator cell;
    double                                      lambda = 0., mu = 0.;
  };
} // namespace Voussoir

#endif
