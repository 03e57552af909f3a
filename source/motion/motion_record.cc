// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/error.h>
#include <voussoir/base/number_text.h>
#include <voussoir/base/units.h>
#include <voussoir/motion/motion_record.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <set>
#include <sstream>

namespace Voussoir
{
  namespace
  {
    /** Returns the unit of acceleration in headings such as "a_x [cm/s2]" or "X (g)", as unit_name(). The letter
     * g is a unit in parentheses only. Returns an empty string for no unit and for several units. */
    std::string unit_in(const std::string &headings)
    {
      const std::string text = lower_case(headings);
      const auto        is_part = [](const unsigned char c)
      { return std::isalnum(c) || c == '/' || c == '^' || c == '%' || c >= 0x80; };
      std::set<std::string> found;
      for (std::size_t begin = 0, end; begin < text.size(); begin = end)
      {
        for (end = begin + 1; end < text.size() && is_part(text[begin]) && is_part(text[end]); ++end)
          ;
        const std::string word = text.substr(begin, end - begin);
        const bool        in_parentheses =
            begin > 0 && end < text.size() &&
            (text[begin - 1] == '(' ? text[end] == ')' : text[begin - 1] == '[' && text[end] == ']');
        if (word != "g" || in_parentheses)
          found.insert(unit_name(word, "acceleration"));
      }
      found.erase("");
      return found.size() == 1 ? *found.begin() : "";
    }

    /** Line of a table with at least one word. */
    struct Line
    {
      std::size_t              number;
      std::vector<std::string> words;
    };

    /** Returns all lines with words, without comments. Throws InputError for decimal commas. @p headings receives
     * the text before the first number. */
    std::vector<Line> lines_of(const RecordText &text, std::string &headings)
    {
      std::vector<Line> lines;
      for (std::size_t k = 0; k < text.lines.size(); ++k)
      {
        const std::string content = text.lines[k].substr(0, text.lines[k].find('#'));
        Line              line{k, words_of(content)};
        if (lines.empty() || std::none_of(lines.back().words.begin(), lines.back().words.end(), is_number))
          headings += text.lines[k] + "\n";
        const auto is_digit = [&](const std::size_t at)
        { return at < content.size() && std::isdigit(static_cast<unsigned char>(content[at])); };
        std::size_t n_commas = 0; // between numbers, as in 0,01 and 0,-1
        for (std::size_t at = 1; at < content.size(); ++at)
          n_commas += content[at] == ',' && is_digit(at - 1) &&
                      is_digit(at + 1 + (content[at + 1] == '-' || content[at + 1] == '+'));
        if (n_commas > 0 && line.words.size() > n_commas + 1 && content.find('.') == std::string::npos)
          text.fail(
              k, std::to_string(line.words.size()) +
                     " columns, or decimal commas. Decimals have a point, not a comma: replace the commas.");
        if (!line.words.empty())
          lines.push_back(std::move(line));
      }
      return lines;
    }

    double number_of(const RecordText &text, const Line &line, const std::string &word, const bool is_first)
    {
      double number = 0.;
      if (!to_number(word, number) || !std::isfinite(number))
        text.fail(line.number, "'" + word + "' is not a finite number. " +
                                   (is_first ? "The file is no table, and none of the known formats (" +
                                                   record_format_names() + "). Give one of these."
                                             : "Correct or remove it."));
      return number;
    }

    /** Returns the time step of @p times [s]. Throws InputError if the steps differ by more than the rounding
     * of the times. */
    double equal_step(const RecordText &text, const std::vector<double> &times,
                      const std::vector<std::size_t> &lines)
    {
      std::vector<double> steps;
      for (std::size_t k = 1; k < times.size(); ++k)
      {
        steps.push_back(times[k] - times[k - 1]);
        if (steps.back() <= 0.)
          text.fail(lines[k],
                    "time does not increase. Sort the lines, and write the times with more digits.");
      }
      std::vector<double> sorted = steps;
      std::nth_element(sorted.begin(), sorted.begin() + sorted.size() / 2, sorted.end());
      const double usual = sorted[sorted.size() / 2];
      for (std::size_t k = 0; k < steps.size(); ++k)
        if (std::abs(steps[k] - usual) > 0.05 * usual)
          text.fail(lines[k + 1], "the time step is " + number_text(steps[k]) + " s, elsewhere " +
                                      number_text(usual) + " s. Resample the record at equal steps.");
      const double step = (times.back() - times.front()) / steps.size();
      for (std::size_t k = 0; k < times.size(); ++k)
        if (std::abs(times[k] - times.front() - k * step) > 0.1 * step)
          text.fail(lines[k], "the time is " + number_text(times[k]) +
                                  " s, but with equal steps between the first and " +
                                  "the last it would be " + number_text(times.front() + k * step) +
                                  " s. Resample the record at equal steps.");
      return step;
    }

    /** Returns the meaning of a heading such as "a_x [cm/s2]", "Acc. N-S (g)", EW or "Time (s)". */
    Heading column_of(const std::string &heading)
    {
      const std::string keys = "acceleration accel acc a velocity vel v displacement disp d u time t ";
      Heading           column{trimmed(heading), "", '?', {}};
      const std::string text = lower_case(column.text) + " ";
      std::string       name;
      for (std::size_t begin = 0, end; begin < text.size(); begin = end + 1)
      {
        end = text.find_first_of(" ,()[]", begin);
        const std::string part = text.substr(begin, end - begin);
        const std::size_t slash = std::min(part.find('/'), part.size());
        std::size_t       n_name = part.size(); // of these characters
        MotionChannel     direction;            // N/S is none per second
        direction.set_direction(part);
        const bool in_parentheses = text[end] == ')' || text[end] == ']';
        if (slash < part.size() ? direction.axis == '?' : in_parentheses || part == "gal")
          for (const char *dimension : {"acceleration", "velocity", "length", "time", "frequency"})
            for (const std::size_t first : {std::size_t(0), slash + 1}) // cm/s2, ax/gal
              if (n_name == part.size() && first <= slash + (slash < part.size()))
                if (const std::string of_part = part.substr(first),
                    unit = unit_name(of_part == "hz" ? "Hz" : of_part, dimension);
                    !unit.empty())
                  n_name = first, column.unit = unit,
                  column.quantity = dimension[0] == 'l' ? 'd' : dimension[0];
        if (in_parentheses && !part.empty() && n_name == part.size() && direction.axis == '?' &&
            (" " + keys).find(" " + part + " ") == std::string::npos)
          column.unit = (text[end] == ')' ? "(" : "[") + column.text.substr(begin, part.size()) + text[end];
        for (const unsigned char c : column.text.substr(begin, n_name))
          if (std::isalnum(c))
            name += c;
      }
      MotionChannel     whole, rest;
      const std::string lower = lower_case(name);
      whole.set_direction(name);
      char quantity = '?';
      if (whole.axis != '?' && (name.size() > 1 || std::string("xyznew").find(lower) != std::string::npos))
        quantity = 'a', column.channel = whole;
      std::istringstream words(keys);
      for (std::string key; quantity == '?' && words >> key; rest = {})
        if (const bool begins = lower.compare(0, key.size(), key) == 0;
            begins || (key.size() > 2 && lower.size() > key.size() &&
                       lower.compare(lower.size() - key.size(), key.size(), key) == 0)) // X acceleration
        {
          rest.set_direction(begins ? name.substr(key.size()) : name.substr(0, name.size() - key.size()));
          if (rest.axis == 'h' && rest.name.size() == 1 && std::isdigit(rest.name[0] & 0x7f))
            rest.axis = '?'; // a1: a number, not an azimuth
          if (rest.axis != '?' || (begins && key.size() > 2) || lower == key)
            quantity = key[0] == 'u' ? 'd' : key[0], column.channel = rest;
        }
      if (column.quantity == '?')
        column.quantity = quantity;
      return column;
    }

    /** Returns the headings of the columns, separated by semicolons, tabs, commas or blanks. */
    std::vector<Heading> columns_of(const std::string &line)
    {
      const std::size_t    at = std::min(line.find_first_of(";\t"), line.find(','));
      const char           separator = line.find(';') < line.size() ? ';' : at < line.size() ? line[at] : ' ';
      std::vector<Heading> columns;
      std::istringstream   cells(line);
      for (std::string cell; std::getline(cells, cell, separator);)
        if (separator == ' ' && !columns.empty() && !cell.empty() && (cell[0] == '(' || cell[0] == '['))
          columns.back() = column_of(columns.back().text + " " + cell);
        else if (separator != ' ' || !trimmed(cell).empty())
          columns.push_back(column_of(cell));
      while (!columns.empty() && columns.back().text.empty())
        columns.pop_back();
      const bool is_north_known =
          std::any_of(columns.begin(), columns.end(), [](const Heading &c) { return c.channel.axis == 'h'; });
      for (Heading &column : columns)
        if (const std::string cell = lower_case(column.text) + " ";
            is_north_known && cell[0] == 'u' && cell.find_first_of(" ([") == 1) // E, N, U
          column = column_of("up" + column.text.substr(1));
      return columns;
    }

    /** Throws InputError unless the columns are accelerations of one unit, and one time if @p is_timed. */
    void check_columns(const RecordText &text, const std::size_t line, const std::vector<Heading> &columns,
                       const bool is_timed)
    {
      unsigned int                      n_times = 0;
      std::string                       unit;
      std::set<std::pair<char, double>> directions;
      for (const Heading &column : columns)
      {
        const std::string name = "the column '" + column.text + "' ";
        if (column.unit.find_first_of("([") == 0)
          text.fail(line, "unit '" + column.unit + "' is unknown. Use g, gal, cm/s^2 or m/s^2.");
        if (column.quantity == 'v' || column.quantity == 'd')
          text.fail(line, name + "is a " + (column.quantity == 'v' ? "velocity" : "displacement") +
                              ", not an acceleration. Give accelerations, or remove the column.");
        if (column.quantity == '?' || column.quantity == 'f')
          text.fail(line,
                    name + "is unknown. Use headings such as t, a_x, a_y, a_z, or Time (s), Acc. NS (g).");
        if (column.quantity == 't' && (++n_times > 1 || (!column.unit.empty() && column.unit != "s")))
          text.fail(line,
                    name + "is " + (n_times > 1 ? "a second time." : "not in s.") + " Correct the table.");
        if (column.quantity == 'a' && !column.unit.empty() && !unit.empty() && unit != column.unit)
          text.fail(line, name + "has another unit than " + unit + ". Give all columns in one unit.");
        if (column.quantity == 'a' && !column.unit.empty())
          unit = column.unit;
        if (column.channel.axis != '?' &&
            !directions.insert({column.channel.axis, column.channel.azimuth}).second)
          text.fail(line, name + "has the direction of another one. Correct the headings.");
      }
      if (!columns.empty() && n_times != (is_timed ? 1 : 0))
        text.fail(line, "there is no column for the time. Name it t, or set Motion/File step.");
    }

    /** Reads the rows. Throws InputError if the number of columns differs from @p n_columns (0: that of the first
     * row). */
    std::vector<std::vector<double>> rows_of(const RecordText &text, const std::vector<Line> &lines,
                                             const std::size_t n_columns, const std::size_t n_channels)
    {
      std::vector<std::vector<double>> rows;
      for (const Line &line : lines)
      {
        const std::size_t n = line.words.size();
        if (n != (n_columns > 0 ? n_columns : lines[0].words.size()))
          text.fail(
              line.number,
              std::to_string(n) + (n == 1 ? " column. " : " columns. ") +
                  (n_channels == 1
                       ? "Expected two, t and a, or one and Motion/File step, or a record of an agency; "
                         "a file with t, a_x, a_y, a_z belongs to the entry Motion/File. "
                       : "Motion/File expects four, t, a_x, a_y, a_z; files with one component belong "
                         "to the entries File x, File y, File z. ") +
                  "One line of headings without numbers may come first; put # before other text. Decimals have "
                  "a point, not a comma.");
        rows.emplace_back();
        for (const std::string &word : line.words)
          rows.back().push_back(number_of(text, line, word, rows.size() == 1));
      }
      return rows;
    }

    /** Returns true if the first line of a table has headings. */
    bool has_headings(const std::vector<Line> &lines)
    {
      return !lines.empty() && std::none_of(lines[0].words.begin(), lines[0].words.end(), is_number);
    }

    /** Returns the columns that the first line names, and removes it from @p lines. Without headings, or if no
     * word is known, there are none. Throws InputError if their number differs from that of the numbers. */
    std::vector<Heading> take_headings(const RecordText &text, std::vector<Line> &lines, std::string &notes)
    {
      if (!has_headings(lines))
        return {};
      const std::size_t          first = lines[0].number;
      const std::vector<Heading> columns =
          columns_of(text.lines[first].substr(0, text.lines[first].find('#')));
      lines.erase(lines.begin());
      if (lines.empty() || lines[0].words.size() == columns.size() ||
          has_headings(lines)) // reported by rows_of()
        return columns;
      if (std::any_of(columns.begin(), columns.end(), [](const Heading &c) { return c.quantity != '?'; }))
        text.fail(first, std::to_string(columns.size()) + " headings, " +
                             std::to_string(lines[0].words.size()) +
                             " columns. Give each column one heading, and put # before other text.");
      notes += ", headings not understood";
      return {};
    }

    MotionRecord read_table(const RecordText &text, const unsigned int n_channels, const double step)
    {
      MotionRecord      record;
      std::string       headings;
      std::vector<Line> lines = lines_of(text, headings);
      const std::size_t first = lines.empty() ? 0 : lines[0].number;
      record.notes = "table";
      const std::vector<Heading> columns = take_headings(text, lines, record.notes);
      const bool                 is_time_named = std::any_of(columns.begin(), columns.end(),
                                                             [](const Heading &c) { return c.quantity == 't'; }),
                 is_timed = !(step > 0. && (columns.empty() ? !lines.empty() && lines[0].words.size() == 1
                                                            : !is_time_named));
      const auto rows = rows_of(text, lines, n_channels == 0 ? 0 : n_channels + is_timed, n_channels);
      if (rows.size() < 2)
        throw InputError("The ground motion file '" + text.file + "' holds fewer than two times.");
      check_columns(text, first, columns, is_timed);
      for (const std::string other : {"velocity", "displacement"})
        if (columns.empty() && lower_case(headings).find(other) != std::string::npos)
          text.fail(first, "the headings name a " + other + ". Give accelerations, and name them.");
      for (std::size_t c = 0, channel = 0; c < rows[0].size(); ++c)
      {
        const bool          is_time = columns.empty() ? is_timed && c == 0 : columns[c].quantity == 't';
        std::vector<double> values;
        for (const auto &row : rows)
          values.push_back(row[c]);
        if (is_time)
        {
          std::vector<std::size_t> numbers;
          for (const Line &line : lines)
            numbers.push_back(line.number);
          record.start = values.front();
          record.dt = equal_step(text, values, numbers);
          continue;
        }
        record.channels.push_back(columns.empty() ? MotionChannel() : columns[c].channel);
        if (columns.empty() && n_channels == 3)
          record.channels.back().set_direction(std::string(1, "xyz"[channel++]));
        record.channels.back().values = std::move(values);
        if (!columns.empty() && record.unit.empty())
          record.unit = columns[c].unit;
      }
      if (!is_timed)
        record.dt = step;
      if (record.unit.empty())
        record.unit = unit_in(headings);
      if (columns.empty() && n_channels == 3)
        record.notes += ", columns taken as t, a_x, a_y, a_z without headings";
      return record;
    }
  } // namespace

  MotionRecord read_motion_record(const std::string &file, const unsigned int n_channels, const double step)
  {
    RecordText          text = read_record_text(file);
    const RecordFormat *format = record_format_of(text);
    if (format != nullptr)
      text.format = std::string(format->name) + " (" + format->source + ")";
    MotionRecord record = format == nullptr ? read_table(text, n_channels, step) : format->read(text);
    std::size_t  length = record.channels.empty() ? 0 : record.channels[0].values.size();
    for (const MotionChannel &channel : record.channels)
      length = std::min(length, channel.values.size());
    if (length < 2)
      text.fail(0, "there is no channel of acceleration with 2 values or more. Give a file with one.");
    if (step > 0. && std::abs(step - record.dt) > 1e-6 * record.dt)
      text.fail(0, "the file states steps of " + number_text(record.dt) + " s, but Motion/File step is " +
                       number_text(step) + " s. Set it to 0, or correct the file.");
    if (format == nullptr)
      return record;
    const std::size_t n = record.channels.size();
    if (n_channels != 0 && n != n_channels)
      text.fail(
          0,
          n == 1
              ? "the file has one component. Give it as File x, File y or File z, or in Motion/Sequence as one "
                "of three files, for x, y, z."
              : "the file has " + std::to_string(n) +
                    " channels. Give it as Motion/File, with Motion/Azimuths.");
    for (MotionChannel &channel : record.channels)
      channel.values.resize(length);
    record.is_table = false;
    record.notes = format->name + (record.notes.empty() ? "" : "; " + record.notes);
    return record;
  }

  NumberTable read_number_table(const RecordText &text)
  {
    NumberTable       table;
    std::string       headings;
    std::vector<Line> lines = lines_of(text, headings);
    if (has_headings(lines))
    {
      const std::string &first = text.lines[lines[0].number];
      table.headings = columns_of(first.substr(0, first.find('#')));
      lines.erase(lines.begin());
    }
    for (const Line &line : lines)
    {
      table.lines.push_back(line.number + 1);
      table.rows.emplace_back();
      for (const std::string &word : line.words)
        table.rows.back().push_back(number_of(text, line, word, false));
    }
    table.unit = unit_in(headings);
    return table;
  }
} // namespace Voussoir
