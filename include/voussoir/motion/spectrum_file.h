// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_spectrum_file_h
#define voussoir_spectrum_file_h

#include <array>
#include <string>
#include <utility>
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
    bool        states_unit = false; ///< the file has a unit
    double      damping = 0.;        ///< damping ratio that the file states [-]; 0: none
    std::string note;                ///< what was read, for the log

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
    double      first;       ///< largest first period: its value is the peak acceleration
    double      last;        ///< smallest last period
    std::string advice = ""; ///< for the message: another way to satisfy the range
  };

  /** Returns file and choice of text such as "uhs.csv: 0.1". The choice is empty if the whole text names a file. */
  std::pair<std::string, std::string> file_and_choice(const std::string &text);

  /** Reads a response spectrum. The content of the file determines the format:
   *  - uniform hazard spectra of OpenQuake: one line per site, headings such as 0.1~SA(0.2), values in g, damping 5 %
   *    (docs.openquake.org, "Uniform Hazard Spectra");
   *  - results of a search in PEER's data base (ngawest2.berkeley.edu), block "Scaled Spectra used in Search";
   *  - tables such as those of USGS (earthquake.usgs.gov/nshmp): period [s] or frequency [Hz], and one
   *    pseudo-acceleration, or those in x, y, z. Headings state quantity, unit and damping ratio of the columns. The
   *    first period may be PGA. Lines before a heading that begins with "Period" or "Frequency" are ignored.
   *
   * If a file has several spectra, "FILE: NAME" selects one. Otherwise a column "Target" is selected.
   * @param text path, or path and choice
   * @param unit of the accelerations if the file has none, "Motion/Unit"; empty: m/s^2
   * @param vertical_ratio of z to x and y, for files with one spectrum [-]
   * @param range periods that the file must cover
   *
   * Throws InputError with file and line in these cases:
   *  - The file cannot be read, has an unknown unit, or several spectra without a choice.
   *  - The number of columns differs from that of the headings or the first line, or is not 2 or 4 without headings.
   *  - A period is negative or does not increase, or an acceleration is not positive.
   *  - The periods do not cover @p range. */
  SpectrumTable read_spectrum(const std::string &text, const std::string &unit, double vertical_ratio,
                              const PeriodRange &range);
} // namespace Voussoir

#endif
