// SPDX-License-Identifier: GPL-3.0-or-later
// Siconos' measure of Coulomb's law at one contact, written anew from fc3d_compute_error.c.

#ifndef voussoir_tests_natural_map_h
#define voussoir_tests_natural_map_h

#include <voussoir/base/tensor3.h>

namespace Columns
{
  using namespace Voussoir;

  /** r - P(r - u - mu |u_t| n), P: projection on the cone of friction. */
  inline Vector3 natural_map_of_contact(const Vector3 &r, const Vector3 &u, const double mu)
  {
    Vector3      x = {{r[0] - u[0] - mu * std::hypot(u[1], u[2]), r[1] - u[1], r[2] - u[2]}};
    const double t = std::hypot(x[1], x[2]);
    if (mu * t <= -x[0])
      x = {};
    else if (t > mu * x[0])
    {
      x[0] = (x[0] + mu * t) / (1. + mu * mu);
      x[1] *= mu * x[0] / t;
      x[2] *= mu * x[0] / t;
    }
    return r - x;
  }
} // namespace Columns

#endif
