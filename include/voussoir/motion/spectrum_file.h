// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_spectrum_file_h
#define voussoir_spectrum_file_h

#include <voussoir/base/curve_file.h>

namespace Voussoir
{
  /** Response spectrum of a file: pseudo-acceleration over the natural period. */
  struct SpectrumTable
  {
    /** Periods up to this one are rigid: the acceleration is the peak ground acceleration [s]. 33 Hz: US NRC
     * Regulatory Guide 1.60. */
    static constexpr double rigid_period = 1. / 33.;

    std::string file;
    Curve       curve; ///< pseudo-acceleration [m/s^2] over the period [s]; the first is at most rigid_period

    /** Returns the acceleration at a period [m/s^2]: linear between the rows, constant before the first.
     * Throws InputError if the table ends at a shorter period. */
    double at(double period) const;
  };

  /** Reads a table with the columns period [s], acceleration [m/s^2]. Throws InputError like read_curve(), and if
   * the table begins at a period above SpectrumTable::rigid_period. */
  SpectrumTable read_spectrum(const std::string &file);
} // namespace Voussoir

#endif
