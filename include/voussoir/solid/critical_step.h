// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_critical_step_h
#define voussoir_critical_step_h

#include <functional>
#include <vector>

namespace Voussoir
{
  /** Returns the largest circular frequency of M^-1 K [1/s], by Lanczos' method. The residual is added, so the result is
   * an upper bound; it is too large by at most 5e-6 of its value.
   * @param multiply computes y = K x, with three values per node
   * @param mass of each node [kg]
   * @param node receives the node that moves most in a mode near the highest one, unless nullptr */
  double largest_frequency(const std::function<void(const double *x, double *y)> &multiply,
                           const std::vector<double> &mass, unsigned int *node = nullptr);

  /** The same for a matrix with the function multiply(x, y). */
  template <class Matrix> double largest_frequency(const Matrix &stiffness, const std::vector<double> &mass)
  {
    const std::function<void(const double *, double *)> multiply = [&](const double *x, double *y)
    { stiffness.multiply(x, y); };
    return largest_frequency(multiply, mass);
  }
} // namespace Voussoir

#endif
