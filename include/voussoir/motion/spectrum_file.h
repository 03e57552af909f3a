// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_spectrum_file_h
#define voussoir_spectrum_file_h

#include <array>
#include <string>
#include <vector>

namespace Voussoir
{
  /** Response spectrum of a file: the target of artificial motions and of matched records, and the spectrum of
   * `voussoir modes --spectrum`. */
  struct SpectrumTable
  {
    /** Periods up to this one are rigid: the acceleration is the peak ground acceleration [s]. 33 Hz: US NRC
     * Regulatory Guide 1.60. */
    static constexpr double rigid_period = 1. / 33.;

    std::vector<double> periods; ///< [s], increasing; the first may be 0
    std::array<std::vector<double>, 3>
         acceleration;        ///< pseudo-acceleration in x, y, z at the periods [m/s^2]
    bool states_unit = false; ///< the headings of the file have a unit

    /** Returns the pseudo-acceleration at a period [m/s^2].
     *
     * Between two positive periods its logarithm is linear in the logarithm of the period, after a first
     * period of 0 the value is linear in the period. Before the first period it is constant. Beyond the last
     * period it decreases with the square of the period: the spectral displacement is constant.
     * @param direction 0, 1 or 2 for x, y or z
     * @param period [s] */
    double at(unsigned int direction, double period) const;
  };

  /** Periods that a spectrum must cover [s]. */
  struct PeriodRange
  {
    double first; ///< largest first period: its value is the peak acceleration
    double last;  ///< smallest last period
  };

  /** Reads a table of period [s] and pseudo-acceleration, or of period and pseudo-acceleration in x, y and z.
   *
   * @param file path
   * @param unit of the accelerations, "Motion/Unit"; empty: that of the headings, m/s^2 without headings
   * @param vertical_ratio of z to x and y, for files with one spectrum [-]
   * @param range periods that the file must cover
   *
   * Throws InputError with file and line in these cases:
   *  - The file cannot be read, or its headings have another unit than @p unit.
   *  - The number of columns is neither 2 nor 4, or it changes.
   *  - A period is negative or does not increase, or an acceleration is not positive.
   *  - The periods do not cover @p range. */
  SpectrumTable read_spectrum(const std::string &file, const std::string &unit, double vertical_ratio,
                              const PeriodRange &range);
} // namespace Voussoir

#endif
