// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_excess_h
#define voussoir_excess_h

#include <voussoir/base/tensor3.h>

#include <cstddef>

namespace Voussoir
{
  /** How many of the @p n numbers are larger than @p bound in size, or no numbers? */
  std::size_t count_excess(const double *x, std::size_t n, double bound);

  /** Index of the component of @p x of largest size if that exceeds @p bound, of the first that is not a
   * number before all others; else x.size(). */
  std::size_t find_excess(const Unknowns &x, double bound);
} // namespace Voussoir

#endif
