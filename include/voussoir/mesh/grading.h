// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_grading_h
#define voussoir_grading_h

#include <vector>

namespace Voussoir
{
  /** Returns 1 - x^2 (3 - 2x): it decreases from 1 at x = 0 to 0 at x = 1, with zero slope at both ends. */
  double fade(double x);

  /** Returns the n + 1 end points of n elements on [0, length] [m]. Their sizes grade from the neighbour of
   * size @p first at 0 to the neighbour of size @p last at @p length [m]. The result is a continuous
   * function of @p length, @p first and @p last. */
  std::vector<double> graded(unsigned int n, double length, double first, double last);

  /** Returns the number of elements, at least 2, that graded() requires to fill @p length [m] with sizes of
   * at most @p largest [m] and with the largest admissible growth (factor 1.35). */
  unsigned int n_graded(double length, double first, double last, double largest);
} // namespace Voussoir

#endif
