// SPDX-License-Identifier: GPL-3.0-or-later
#ifdef VOUSSOIR_WITH_ARPACK
#include <deal.II/lac/arpack_solver.h>
#endif
#include <deal.II/lac/vector.h>

#include <voussoir/base/error.h>
#include <voussoir/base/number_text.h>
#include <voussoir/base/reason.h>
#include <voussoir/dynamics/modes.h>
#include <voussoir/joints/joint_system.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <numeric>

namespace Voussoir
{
  using namespace dealii;

  Vector3 NaturalMode::participation(const Structure &structure) const
  {
    Vector3 sum{};
    for (unsigned int i = 0; i < structure.n_nodes(); ++i)
      for (unsigned int d = 0; d < 3; ++d)
        for (unsigned int c = 0; c < 3; ++c)
          sum[d] += shape[3 * i + c] * structure.mass[i][3 * c + d];
    return sum;
  }

  Vector3 free_mass(const Structure &structure)
  {
    Vector3 sum{};
    for (const Matrix3 &mass : structure.mass)
      for (unsigned int d = 0; d < 3; ++d)
        sum[d] += mass[4 * d];
    if (structure.plane_strain)
      sum[1] = 0.;
    return sum;
  }

  Vector3 NaturalMode::mass_share(const Structure &structure) const
  {
    const Vector3 factor = participation(structure), whole = free_mass(structure);
    Vector3       share{};
    for (unsigned int d = 0; d < 3; ++d)
      if (whole[d] > 0.)
        share[d] = factor[d] * factor[d] / whole[d];
    return share;
  }

  double NaturalMode::scale(const Structure &structure) const
  {
    const Unknowns damped = structure.damped_force(shape);
    if (damped.empty())
      return 1.;
    Unknowns Ku;
    structure.multiply_stiffness(shape, Ku);
    return std::inner_product(shape.begin(), shape.end(), damped.begin(), 0.) /
           std::inner_product(shape.begin(), shape.end(), Ku.begin(), 0.);
  }

#ifndef VOUSSOIR_WITH_ARPACK
  std::vector<NaturalMode> natural_modes(const Structure &, unsigned int, unsigned int, const AddMass &)
  {
    throw InputError(
        "This program was built without ARPACK, so it computes no natural frequencies. Build with a deal.II that "
        "has ARPACK and -DVOUSSOIR_WITH_ARPACK=ON.");
  }
#else
  namespace
  {
    struct Operator
    {
      std::function<void(Vector<double> &, const Vector<double> &)> apply;
      void vmult(Vector<double> &y, const Vector<double> &x) const { apply(y, x); }
    };

    /** Returns the residual of lambda K^-1 M phi = phi relative to phi. Without its assertions deal.II does
     * not report that ARPACK has not converged. */
    double relative_residual(const Operator &inverse_stiffness, const Operator &mass, const double lambda,
                             const Vector<double> &phi)
    {
      Vector<double> Mphi(phi.size()), result(phi.size());
      mass.vmult(Mphi, phi);
      inverse_stiffness.vmult(result, Mphi);
      result.sadd(lambda, -1., phi);
      return result.l2_norm() / phi.l2_norm();
    }

    ComputationError not_converged(const unsigned int n_modes, const std::string &reason)
    {
      return ComputationError(
          "The " + std::to_string(n_modes) + " natural frequencies were not found (ARPACK: " + reason +
          "). Reduce the number of modes (--count), or check Young's moduli and densities of the zones; "
          "voussoir SCENE.prm --validate prints them.");
    }
  } // namespace

  std::vector<NaturalMode> natural_modes(const Structure &structure, const unsigned int n_modes,
                                         const unsigned int max_iterations, const AddMass &add_mass)
  {
    const unsigned int n = 3 * structure.n_nodes();
    if (2 * n_modes + 2 > n)
      throw InputError("The dam has only " + std::to_string(n) +
                       " unknowns. Reduce the number of modes (--count).");
    JointSystem    system(structure, JointLaws(), ContactParameters(), {});
    Unknowns       load(n), u;
    const Operator mass{[&](Vector<double> &y, const Vector<double> &x)
                        {
                          const Unknowns copy(x.begin(), x.end());
                          Unknowns       Mx(n);
                          for (unsigned int i = 0; i < structure.n_nodes(); ++i)
                            set(Mx, i, structure.mass[i] * get(copy, i));
                          if (add_mass)
                            add_mass(copy, Mx);
                          structure.remove_held_forces(Mx); // no modes along y in plane strain
                          std::copy(Mx.begin(), Mx.end(), y.begin());
                        }};
    const Operator inverse_stiffness{[&](Vector<double> &y, const Vector<double> &x)
                                     {
                                       std::copy(x.begin(), x.end(), load.begin());
                                       system.solve_free(load, u);
                                       std::copy(u.begin(), u.end(), y.begin());
                                     }};

    SolverControl                     control(max_iterations, 1e-10);
    ArpackSolver                      arpack(control,
                                             ArpackSolver::AdditionalData(2 * n_modes + 2, ArpackSolver::largest_magnitude, true));
    std::vector<std::complex<double>> eigenvalues(n_modes);
    std::vector<Vector<double>>       eigenvectors(n_modes, Vector<double>(n));
    try
    {
      arpack.solve(inverse_stiffness, mass, inverse_stiffness, eigenvalues, eigenvectors, n_modes);
    }
    catch (const ExceptionBase &error)
    {
      throw not_converged(n_modes, reason(error));
    }
    std::vector<NaturalMode> modes;
    for (unsigned int k = 0; k < n_modes; ++k)
    {
      const double    lambda = eigenvalues[k].real();
      Vector<double> &phi = eigenvectors[k], Mphi(n);
      mass.vmult(Mphi, phi);
      phi /= std::sqrt(phi * Mphi);
      if (const double residual = relative_residual(inverse_stiffness, mass, lambda, phi);
          !(residual <= 1e-6))
        throw not_converged(n_modes, "relative residual " + number_text(residual) + " of mode " +
                                         std::to_string(k + 1));
      modes.push_back({std::sqrt(lambda) / (2. * M_PI), Unknowns(phi.begin(), phi.end())});
    }
    std::sort(modes.begin(), modes.end(),
              [](const NaturalMode &a, const NaturalMode &b) { return a.frequency < b.frequency; });
    return modes;
  }
#endif
} // namespace Voussoir
