// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/error.h>
#include <voussoir/base/number_text.h>
#include <voussoir/motion/spectrum_file.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <locale>
#include <sstream>

namespace Voussoir
{
  namespace
  {
    /** Adds a line of the file to the table. @p place: file and number of the line, for messages. */
    void add_line(const std::string &line, const std::string &place, SpectrumTable &table)
    {
      std::istringstream words(line);
      words.imbue(std::locale::classic());
      double      period = 0., acceleration = 0.;
      std::string more;
      if (!(words >> period >> acceleration) || words >> more)
        throw InputError(
            place + " is \"" + line +
            "\". Write two numbers: the period [s] and the acceleration [m/s^2]. Put # before other text.");
      if (!(period >= 0. && acceleration >= 0.))
        throw InputError(place + " has a negative number. Periods and accelerations are at least 0.");
      if (!table.period.empty() && !(period > table.period.back()))
        throw InputError(place + ": the periods must ascend, but " + number_text(period) + " s follows " +
                         number_text(table.period.back()) + " s. Sort the lines by period.");
      table.period.push_back(period);
      table.acceleration.push_back(acceleration);
    }
  } // namespace

  double SpectrumTable::at(const double T) const
  {
    const std::size_t i = std::lower_bound(period.begin(), period.end(), T) - period.begin();
    if (i == period.size())
      throw InputError("The spectrum " + file + " ends at the period " + number_text(period.back()) +
                       " s, but a mode has " + number_text(T) + " s. Extend the table.");
    if (i == 0)
      return acceleration.front();
    const double share = (T - period[i - 1]) / (period[i] - period[i - 1]);
    return acceleration[i - 1] + share * (acceleration[i] - acceleration[i - 1]);
  }

  SpectrumTable read_spectrum(const std::string &file)
  {
    std::error_code error;
    std::ifstream   in;
    if (std::filesystem::is_regular_file(file, error))
      in.open(file);
    if (!in.is_open())
      throw InputError(
          "The spectrum " + file +
          " cannot be read. Give --spectrum design, or the path of a table with the columns period "
          "[s], acceleration [m/s^2].");
    SpectrumTable table;
    table.file = file;
    std::string line;
    for (unsigned int number = 1; std::getline(in, line); ++number)
    {
      line = line.substr(0, line.find('#'));
      std::replace_if(
          line.begin(), line.end(), [](const char c) { return c == ',' || c == ';' || c == '\r'; }, ' ');
      std::string first;
      if (!(std::istringstream(line) >> first) ||
          (table.period.empty() && std::isalpha(static_cast<unsigned char>(first[0]))))
        continue; // empty line or headings
      add_line(line, "The spectrum " + file + ", line " + std::to_string(number), table);
    }
    if (table.period.size() < 2)
      throw InputError("The spectrum " + file +
                       " has fewer than two periods. Write one line per period: "
                       "period [s], acceleration [m/s^2].");
    if (table.period.front() > SpectrumTable::rigid_period)
      throw InputError(
          "The spectrum " + file + " begins at the period " + number_text(table.period.front()) +
          " s. Add a line with the period 0 and the peak ground acceleration, which acts on rigid "
          "parts of the dam.");
    return table;
  }
} // namespace Voussoir
