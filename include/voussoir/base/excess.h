// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_excess_h
#define voussoir_excess_h

#include <voussoir/base/tensor3.h>

#include <cstddef>

namespace Voussoir
{
  /** Returns how many of the @p n values of @p x are not finite or exceed @p bound in absolute value. */
  std::size_t count_excess(const double *x, std::size_t n, double bound);

  /** Returns the index of the component of @p x with the largest absolute value if that exceeds @p bound.
   * Returns the index of the first component that is not finite if there is one, and x.size() if all
   * components are within the bound. */
  std::size_t find_excess(const Unknowns &x, double bound);
} // namespace Voussoir

#endif
