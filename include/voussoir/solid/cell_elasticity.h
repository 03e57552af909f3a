// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_cell_elasticity_h
#define voussoir_cell_elasticity_h

#include <deal.II/fe/fe_values.h>
#include <deal.II/lac/full_matrix.h>

#include <voussoir/solid/material.h>
#include <voussoir/solid/structure.h>

namespace Voussoir
{
  /** Stiffness, mass and stress of one cell, node by node, the incompatible modes condensed out.
   *
   *  The stiffness of the dam is integrated at Gauss points. Nodal quadrature (QGaussLobatto(degree + 1)) is
   * for explicit wave propagation; the lumped mass is the same.
   *
   *  Modes 1 - xi^2 (Wilson), with the Jacobian of the centre and the factor j_0/j (Taylor, Beresford and
   * Wilson 1976), so that a constant stress does no work on them and the patch test holds. */
  class CellElasticity
  {
  public:
    CellElasticity(const dealii::FiniteElement<3> &fe, bool incompatible_modes);
    CellElasticity(const dealii::FiniteElement<3> &fe, bool incompatible_modes,
                   const dealii::Quadrature<3> &of_stiffness);

    void reinit(const dealii::DoFHandler<3>::active_cell_iterator &cell, const Material &material);

    std::vector<Matrix3> stiffness; ///< n x n blocks, row by row [N/m]
    std::vector<double>  mass;      ///< n row sums [kg]

    /** Stress at the n nodes per displacement of the n nodes: blocks of 6 x 3 (xx yy zz xy yz zx), row by
     * row, node of the stress first [Pa/m]. From the 2x2x2 Gauss points, where it is most accurate,
     * extrapolated trilinearly. After reinit(). */
    void stress_operator(std::vector<std::array<double, 18>> &blocks);

    /** Nodal forces [N], 3 per node, that hold the isotropic @p strain (of the n nodes) [-], and what it adds
     * to the stress at the n nodes (xx yy zz xy yz zx) [Pa]: sigma = D (eps - strain). After reinit(). */
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
    dealii::FullMatrix<double>                  mode_of_force;        ///< 9 x 9, the modes' flexibility
    dealii::DoFHandler<3>::active_cell_iterator cell;
    double                                      lambda = 0., mu = 0.;
  };
} // namespace Voussoir

#endif
