// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_arch_shape_h
#define voussoir_arch_shape_h

#include <array>

namespace Voussoir
{
  /** Bank of the valley, seen downstream. */
  enum class Bank
  {
    right,
    left
  };

  /** Faces and abutments of an arch dam.
   *
   * The functions describe one half of the dam, from the crown (y = 0) to a bank. The coordinate y is positive
   * towards this bank, x downstream, z up [m]. u >= 0 is the parameter of the arc at a height; it is 0 at the
   * crown and increases towards the bank. */
  class ArchShape
  {
  public:
    virtual ~ArchShape() = default;

    /** Returns z of the lowest arc [m]. */
    virtual double bottom() const = 0;

    /** Returns z of the crest [m]. */
    virtual double top() const = 0;

    /** Returns the point of the arc at the height @p z with the parameter @p u. @p w runs from -1 at the
     * upstream face to 1 at the downstream face. Throws InputError if the faces meet before @p u. */
    virtual std::array<double, 3> point(Bank bank, double u, double z, double w) const = 0;

    /** Returns u at the abutment. */
    virtual double end(Bank bank, double z) const = 0;

    /** Returns the largest u, beyond the abutment, to which the arc can be continued into the rock. */
    virtual double reach(Bank bank, double z) const = 0;

    /** Returns the slope dx/dy of the centre line of the crest at @p u [-]. Default: central differences. */
    virtual double slope(Bank bank, double u) const;

    /** Returns the length of the centre line of the crest from the crown to @p u [m]. Default: by
     * chords and extrapolation, with a relative error of about 1e-7. */
    virtual double crest_length(Bank bank, double u) const;
  };

  /** Returns the root of @p f by bisection, to the last digit. @p f is negative at @p lower and positive at
   * @p upper. */
  template <typename Function> double bisect(const Function &f, double lower, double upper)
  {
    for (unsigned int i = 0; i < 60; ++i)
    {
      const double middle = 0.5 * (lower + upper);
      (f(middle) < 0 ? lower : upper) = middle;
    }
    return 0.5 * (lower + upper);
  }
} // namespace Voussoir

#endif
