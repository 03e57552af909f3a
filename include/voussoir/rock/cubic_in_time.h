// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_cubic_in_time_h
#define voussoir_cubic_in_time_h

#include <cmath>
#include <cstddef>

namespace Voussoir
{
  /** Returns the value at a time by cubic interpolation of the values of four steps. @p step: time in steps.
   * @p value: value of a step from 1 on. Earlier values are zero. */
  template <class Value> double cubic_in_time(const double step, const Value &value)
  {
    const long   first = static_cast<long>(std::floor(step)) - 1;
    const double f = step - first - 1.; // 0 to 1, between the second and the third step
    const double weight[4] = {-f * (f - 1.) * (f - 2.) / 6., (f + 1.) * (f - 1.) * (f - 2.) / 2.,
                              -(f + 1.) * f * (f - 2.) / 2., (f + 1.) * f * (f - 1.) / 6.};
    double       result = 0.;
    for (unsigned int j = 0; j < 4; ++j)
      if (first + static_cast<long>(j) > 0)
        result += weight[j] * value(static_cast<std::size_t>(first + j));
    return result;
  }
} // namespace Voussoir

#endif
