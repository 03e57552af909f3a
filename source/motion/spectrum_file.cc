// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/error.h>
#include <voussoir/base/number_text.h>
#include <voussoir/base/units.h>
#include <voussoir/motion/ground_motion.h>
#include <voussoir/motion/motion_record.h>
#include <voussoir/motion/spectrum_file.h>

#include <algorithm>
#include <cmath>

namespace Voussoir
{
  namespace
  {
    [[noreturn]] void fail_in_spectrum(const std::string &file, const std::size_t line,
                                       const std::string &message)
    {
      throw InputError("Spectrum '" + file + "', line " + std::to_string(line) + ": " + message);
    }

    void check_row(const std::string &file, const NumberTable &table, const std::size_t i)
    {
      const std::vector<double> &row = table.rows[i];
      const std::size_t          line = table.lines[i];
      if (row.size() != table.rows[0].size() || (row.size() != 2 && row.size() != 4))
        fail_in_spectrum(
            file, line,
            std::to_string(row.size()) + " columns. Expected two, period and pseudo-acceleration, or four, " +
                "period and pseudo-acceleration in x, y, z, equal in all lines. One line of headings without " +
                "numbers may come first; put # before other text.");
      if (row[0] < 0. || (i > 0 && row[0] <= table.rows[i - 1][0]))
        fail_in_spectrum(file, line,
                         "the period is " + number_text(row[0]) +
                             " s. Periods must not be negative, and must increase from line to line.");
      for (std::size_t c = 1; c < row.size(); ++c)
        if (!(row[c] > 0.))
          fail_in_spectrum(
              file, line,
              "the acceleration is " + number_text(row[c]) +
                  ". It must be positive. Set Motion/Scale x, y or z to 0 for a component at rest.");
    }

    void check_range(const std::string &file, const NumberTable &table, const PeriodRange &range)
    {
      if (table.rows.empty())
        throw InputError("The spectrum '" + file +
                         "' has no numbers. Write one line per period: period [s], " +
                         "pseudo-acceleration.");
      const double first = table.rows.front()[0], last = table.rows.back()[0];
      if (first > range.first || last < range.last)
        throw InputError("The spectrum '" + file + "' must begin at a period of at most " +
                         number_text(range.first) + " s (0: peak acceleration) and end at " +
                         number_text(range.last) + " s or later, but it has " + number_text(first) +
                         " s to " + number_text(last) + " s. Add the missing lines.");
    }
  } // namespace

  double SpectrumTable::at(const unsigned int direction, const double period) const
  {
    const std::vector<double> &value = acceleration[direction];
    const std::size_t          i = std::upper_bound(periods.begin(), periods.end(), period) - periods.begin();
    if (i == 0)
      return value.front();
    const double before = periods[i - 1];
    if (i == periods.size())
      return value.back() * (before / period) * (before / period);
    if (before == 0.)
      return value[0] + (value[1] - value[0]) * period / periods[1];
    const double share = std::log(period / before) / std::log(periods[i] / before);
    return value[i - 1] * std::pow(value[i] / value[i - 1], share);
  }

  SpectrumTable read_spectrum(const std::string &file, const std::string &unit, const double vertical_ratio,
                              const PeriodRange &range)
  {
    const NumberTable table = read_number_table(file);
    if (!table.unit.empty() && !unit.empty() && table.unit != unit_name(unit, "acceleration"))
      throw InputError("The spectrum '" + file + "' has headings with the unit " + table.unit +
                       ", but Motion/Unit is " + unit + ". Set Motion/Unit = " + table.unit +
                       ", or correct the headings.");
    for (std::size_t i = 0; i < table.rows.size(); ++i)
      check_row(file, table, i);
    check_range(file, table, range);
    const double  factor = unit_of_acceleration(!unit.empty()         ? unit
                                                : !table.unit.empty() ? table.unit
                                                                      : "m/s^2");
    SpectrumTable spectrum;
    spectrum.states_unit = !table.unit.empty();
    for (const std::vector<double> &row : table.rows)
    {
      spectrum.periods.push_back(row[0]);
      for (unsigned int d = 0; d < 3; ++d)
        spectrum.acceleration[d].push_back(
            factor * (row.size() == 4 ? row[d + 1] : row[1] * (d == 2 ? vertical_ratio : 1.)));
    }
    return spectrum;
  }
} // namespace Voussoir
