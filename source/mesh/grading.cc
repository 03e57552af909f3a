// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/mesh/grading.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace Voussoir
{
  namespace
  {
    constexpr double growth = 1.35; ///< largest ratio of the sizes of neighbours if possible

    /** Returns the root of @p f between @p lower and @p upper, where @p f has different signs. */
    double root(const std::function<double(double)> &f, double lower, double upper)
    {
      const bool rises = f(upper) > 0;
      for (unsigned int i = 0; i < 60; ++i)
      {
        const double middle = 0.5 * (lower + upper);
        ((f(middle) < 0) == rises ? lower : upper) = middle;
      }
      return 0.5 * (lower + upper);
    }

    /** Returns the sizes of @p n elements between neighbours of sizes @p first and @p last [m]. The sizes are
     * @p middle, bounded by the @p ratio of neighbouring sizes. */
    std::vector<double> sizes(const unsigned int n, const double first, const double last,
                              const double middle, const double ratio)
    {
      std::vector<double> up(n + 1, 1.), result(n);
      for (unsigned int j = 1; j <= n; ++j)
        up[j] = up[j - 1] * ratio;
      for (unsigned int j = 0; j < n; ++j)
      {
        const double a = up[j + 1], b = up[n - j];
        const double smallest = std::max(first / (a * a), last / (b * b)),
                     largest = std::min(first * a, last * b);
        result[j] =
            smallest < largest ? std::clamp(middle, smallest, largest) : std::sqrt(smallest * largest);
      }
      return result;
    }

    double sum(const std::vector<double> &values)
    {
      double result = 0;
      for (const double value : values)
        result += value;
      return result;
    }
  } // namespace

  double fade(const double x)
  {
    return 1 - x * x * (3 - 2 * x);
  }

  std::vector<double> graded(const unsigned int n, const double length, const double first, const double last)
  {
    const auto excess = [&](const double middle, const double ratio)
    { return sum(sizes(n, first, last, middle, ratio)) - length; };
    const bool   too_long = excess(0, growth) > 0, too_short = excess(length, growth) < 0;
    const double extreme = too_long ? 0 : length;
    const auto   s =
        too_long || too_short
              ? sizes(n, first, last, extreme,
                      root([&](const double ratio) { return excess(extreme, ratio); }, growth, 1e3))
              : sizes(n, first, last,
                      root([&](const double middle) { return excess(middle, growth); }, 0, length), growth);
    std::vector<double> ends = {0};
    for (const double size : s)
      ends.push_back(ends.back() + size);
    for (double &end : ends)
      end *= length / ends.back();
    ends.back() = length;
    return ends;
  }

  unsigned int n_graded(const double length, const double first, const double last, const double largest)
  {
    unsigned int n = 2;
    while (sum(sizes(n, first, last, 0, growth)) < length)
    {
      double filled = 0;
      for (const double size : sizes(n, first, last, largest, growth))
        filled += std::min(size, largest);
      if (filled >= length)
        break;
      ++n;
    }
    return n;
  }
} // namespace Voussoir
