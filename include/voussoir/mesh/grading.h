// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_grading_h
#define voussoir_grading_h

#include <vector>

namespace Voussoir
{
  /** 1 at x = 0, 0 at x = 1, level at both. */
  double fade(double x);

  /** The n + 1 ends of n elements on [0, length], between neighbours of sizes @p first and @p last [m].
   *  Depends continuously on all three. */
  std::vector<double> graded(unsigned int n, double length, double first, double last);

  /** How many elements of at most @p largest, growing no faster than they should, fill @p length [m]. */
  unsigned int n_graded(double length, double first, double last, double largest);
} // namespace Voussoir

#endif
