// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/error.h>
#include <voussoir/base/number_text.h>
#include <voussoir/motion/ground_motion.h>
#include <voussoir/motion/motion_record.h>
#include <voussoir/motion/spectrum_file.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <regex>
#include <tuple>

namespace Voussoir
{
  namespace
  {
    /** Throws InputError. @p line: 0 if the whole file is meant */
    [[noreturn]] void fail_in(const std::string &file, const std::string &message, const std::size_t line = 0)
    {
      throw InputError(line == 0 ? "The spectrum '" + file + "' " + message
                                 : "Spectrum '" + file + "', line " + std::to_string(line) + ": " + message);
    }

    /** One spectrum of a file. */
    struct Candidate
    {
      std::string                                          name, unit;
      std::vector<std::tuple<double, double, std::size_t>> points = {}; ///< period [s], acceleration, line
    };

    /** Returns the period of PGA or SA(0.2) [s], or NaN for other text. */
    double period_of_name(const std::string &text)
    {
      const std::string name = lower_case(trimmed(text));
      return name == "pga" ? 0. : name.rfind("sa(", 0) == 0 ? leading_number(name.substr(3)) : NAN;
    }

    /** Removes the lines before the headings, and those after the block of PEER. Replaces PGA before a number by the
     * period 0. Returns the name of the format. */
    std::string cut_to_table(RecordText &text)
    {
      for (std::string &line : text.lines)
        if (const auto words = words_of(line);
            words.size() > 1 && lower_case(words[0]) == "pga" && is_number(words[1]))
          line.replace(line.find(words[0]), 3, "0");
      const std::size_t n = text.lines.size(), marker = text.find("spectra used in search", 0, n);
      std::size_t       k = marker < n ? marker + 1 : 0;
      std::string       word; // the first one of line k
      for (; k < n; ++k)
        if (const auto words = words_of(lower_case(text.lines[k])); !words.empty())
          if (word = trimmed(words[0]);
              is_number(word) || word.rfind("period", 0) == 0 || word.rfind("freq", 0) == 0)
            break;
      if (k < n && !is_number(word))
        std::fill_n(text.lines.begin(), k, "");
      for (bool is_end = false; marker < n && k < n; ++k)
        if (is_end = is_end || trimmed(text.lines[k]).empty(); is_end)
          text.lines[k].clear();
      return marker < n ? "PEER search" : "table";
    }

    /** Returns the damping ratio in text such as "5% damping" or "Damping ratio: 0.05", or 0. */
    double damping_in(const RecordText &text)
    {
      const std::regex phrase("([0-9.]+) ?%[ -]*damp|damping[^0-9]{0,12}([0-9.]+) ?(%?)");
      std::smatch      found;
      for (std::size_t k = 0; k < std::min<std::size_t>(text.lines.size(), 200); ++k)
        if (const std::string line = lower_case(text.lines[k].substr(0, 200)); // the search is recursive
            std::regex_search(line, found, phrase))
          if (const double number = leading_number(found[1].str() + found[2].str());
              number > 0. && number < 100.)
            return (found[1].matched || found[3].length() > 0 || number >= 1. ? .01 : 1.) * number;
      return 0.;
    }

    /** Returns the spectra of OpenQuake: one for each site (line) and each probability (heading before ~). */
    std::vector<Candidate> hazard_spectra(const NumberTable &table)
    {
      std::vector<Candidate> result;
      for (std::size_t i = 0; i < table.rows.size(); ++i)
        for (std::size_t c = 2, first = result.size(); c < table.rows[i].size(); ++c)
        {
          const std::string &heading = table.headings[c].text;
          const std::size_t  tilde = heading.rfind('~');
          const double       period = period_of_name(heading.substr(tilde + 1));
          const std::string  site = number_text(table.rows[i][0]) + " " + number_text(table.rows[i][1]),
                            name = (tilde < heading.size() ? heading.substr(0, tilde) : "spectrum") +
                                   (table.rows.size() > 1 ? " at " + site : "");
          if (!std::isfinite(period))
            continue;
          auto same = std::find_if(result.begin() + first, result.end(),
                                   [&](const Candidate &other) { return other.name == name; });
          if (same == result.end())
            same = result.insert(same, {name, "g"});
          same->points.emplace_back(period, table.rows[i][c], table.lines[i]);
        }
      for (Candidate &spectrum : result)
        std::sort(spectrum.points.begin(), spectrum.points.end());
      return result;
    }

    /** Returns the spectra in the columns of a table: those of unknown quantity, or accelerations. */
    std::vector<Candidate> columns_of_table(const std::string &file, const NumberTable &table)
    {
      if (table.rows.empty())
        fail_in(file, "has no numbers. Write one line per period: period [s], pseudo-acceleration.");
      std::vector<Heading> columns = table.headings;
      const std::size_t    n = table.rows[0].size();
      if (columns.empty())
        columns.resize(n);
      else if (columns.size() == 2 && n == 4) // one heading for x, y, z
        columns[1].text.clear(), columns.resize(n, columns[1]);
      for (std::size_t i = 0; i < table.rows.size(); ++i)
        if (table.rows[i].size() != columns.size() || n < 2 || (table.headings.empty() && n != 2 && n != 4))
          fail_in(
              file,
              std::to_string(table.rows[i].size()) +
                  " columns. Expected two, period and pseudo-acceleration, or four, with those in x, y, z, or one for each "
                  "heading, equal in all lines. Put # before text other than one line of headings.",
              table.lines[i]);
      const auto is = [](const Heading &column, const char quantity, const char *name)
      { return column.quantity == quantity || lower_case(column.text).rfind(name, 0) == 0; };
      const auto        first = std::find_if(columns.begin(), columns.end(),
                                             [&](const Heading &column)
                                             { return is(column, 't', "period") || is(column, 'f', "freq"); });
      const std::size_t at = first == columns.end() ? 0 : first - columns.begin();
      const bool        is_frequency = is(columns[at], 'f', "freq");
      if (const std::string unit = is_frequency ? "Hz" : "s";
          !columns[at].unit.empty() && columns[at].unit != unit)
        fail_in(file, "has the column '" + columns[at].text + "'. Give it in " + unit + ".");
      const std::regex       other("p?s[vd]([^a-z].{0,99})?"); // velocity or displacement
      std::vector<Candidate> result;
      for (std::size_t c = 0; c < n; ++c)
        if (const Heading &column = columns[c];
            c != at && (column.quantity == 'a' ||
                        (column.quantity == '?' && !std::regex_match(lower_case(column.text), other))))
        {
          result.push_back({column.text, column.unit.empty() ? table.unit : column.unit});
          auto &points = result.back().points;
          for (std::size_t i = 0; i < table.rows.size(); ++i)
            points.emplace_back(is_frequency ? 1. / table.rows[i][at] : table.rows[i][at], table.rows[i][c],
                                table.lines[i]);
          if (is_frequency)
            std::sort(points.begin(), points.end());
        }
      return result;
    }

    /** Returns the chosen spectrum, or three for x, y, z. Throws InputError if the choice is unknown or ambiguous. */
    std::vector<Candidate> selected(const std::string &file, const std::string &choice,
                                    const std::vector<Candidate> &all)
    {
      std::vector<Candidate> found;
      std::string            names, ends; // ends: last letters before the units
      for (const Candidate &spectrum : all)
      {
        const std::string name = lower_case(spectrum.name);
        if (choice.empty() ? name.rfind("target", 0) == 0 : name == lower_case(choice))
          found.push_back(spectrum);
        if (const std::string stem = trimmed(name.substr(0, name.find_first_of("([,"))); !stem.empty())
          ends += stem.back();
        if (&spectrum - all.data() < 12)
          names += (names.empty() ? "" : "; ") + spectrum.name;
      }
      if (found.size() == 1)
        return found;
      if (choice.empty() && (all.size() == 1 || (all.size() == 3 && (ends.empty() || ends == "xyz"))))
        return all;
      if (all.empty())
        fail_in(file, "has no column of accelerations. Give one with a heading such as \"Sa (g)\".");
      fail_in(file, "has " + std::to_string(all.size()) + " spectra" +
                        (choice.empty() ? "" : ", none or several of them named '" + choice + "'") + ": " +
                        names + (all.size() > 12 ? "; ..." : "") +
                        ". Write the name of one of them after the file, as in \"" + file + ": " +
                        all[0].name + "\".");
    }

    void check_points(const std::string &file, const Candidate &spectrum, const PeriodRange &range)
    {
      if (spectrum.unit.find_first_of("([") == 0)
        fail_in(file, "has the column '" + spectrum.name + "' with the unit " + spectrum.unit +
                          ", which is unknown. Use g, %g, gal, cm/s^2 or m/s^2.");
      for (std::size_t i = 0; i < spectrum.points.size(); ++i)
      {
        const auto &[period, a, line] = spectrum.points[i];
        if (!(period >= 0. && std::isfinite(period)) ||
            (i > 0 && period <= std::get<0>(spectrum.points[i - 1])))
          fail_in(file,
                  "the period is " + number_text(period) +
                      " s. Periods must not be negative, and must increase from line to line.",
                  line);
        if (!(a > 0.))
          fail_in(file,
                  "the acceleration is " + number_text(a) +
                      ". It must be positive. Set Motion/Scale x, y or z to 0 for a component at rest.",
                  line);
      }
      const double first = std::get<0>(spectrum.points.front()), last = std::get<0>(spectrum.points.back());
      if (first > range.first || last < range.last)
        fail_in(file, "must begin at a period of at most " + number_text(range.first) +
                          " s (0: peak acceleration) and end at " + number_text(range.last) +
                          " s or later, but it has " + number_text(first) + " s to " + number_text(last) +
                          " s. Add the missing lines" + range.advice + ".");
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

  std::pair<std::string, std::string> file_and_choice(const std::string &text)
  {
    std::error_code   error;
    const std::size_t colon = std::filesystem::exists(text, error) ? std::string::npos : text.rfind(':');
    return colon == std::string::npos
               ? std::make_pair(text, std::string())
               : std::make_pair(trimmed(text.substr(0, colon)), trimmed(text.substr(colon + 1)));
  }

  SpectrumTable read_spectrum(const std::string &text, const std::string &unit, const double vertical_ratio,
                              const PeriodRange &range)
  {
    const auto [file, choice] = file_and_choice(text);
    RecordText    content = read_record_text(file);
    SpectrumTable spectrum;
    spectrum.damping = damping_in(content);
    std::string       format = cut_to_table(content);
    const NumberTable table = read_number_table(content);
    const bool        of_sites = table.headings.size() > 2 && lower_case(table.headings[0].text) == "lon";
    if (of_sites)
      format = "OpenQuake", spectrum.damping = .05;
    const std::vector<Candidate> all = columns_of_table(file, table);
    std::vector<Candidate>       found = selected(file, choice, of_sites ? hazard_spectra(table) : all);
    spectrum.states_unit = !found[0].unit.empty();
    for (Candidate &component : found)
    {
      check_points(file, component, range);
      if (component.unit.empty())
        component.unit = unit.empty() ? "m/s^2" : unit;
    }
    for (const auto &point : found[0].points)
      spectrum.periods.push_back(std::get<0>(point));
    for (unsigned int d = 0; d < 3; ++d)
    {
      const Candidate &component = found[found.size() == 3 ? d : 0];
      const double     factor =
          unit_of_acceleration(component.unit) * (found.size() == 1 && d == 2 ? vertical_ratio : 1.);
      for (const auto &point : component.points)
        spectrum.acceleration[d].push_back(factor * std::get<1>(point));
    }
    spectrum.note =
        format + (found[0].name.empty() ? "" : " '" + found[0].name + "'") + ", unit " + found[0].unit +
        (spectrum.states_unit ? "" : " (assumed: the file has none)") + ", damping ratio " +
        (spectrum.damping > 0. ? number_text(spectrum.damping) : "not stated") + ", " +
        std::to_string(spectrum.periods.size()) + " periods from " + number_text(spectrum.periods.front()) +
        " s to " + number_text(spectrum.periods.back()) + " s";
    return spectrum;
  }
} // namespace Voussoir
