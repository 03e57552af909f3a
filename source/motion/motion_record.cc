// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/error.h>
#include <voussoir/base/number_text.h>
#include <voussoir/base/units.h>
#include <voussoir/motion/motion_record.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <set>

namespace Voussoir
{
  namespace
  {
    /** Line of a file with at least one word. */
    struct Line
    {
      std::size_t              number;
      std::vector<std::string> words; // separated by blanks, commas, semicolons or equal signs
    };

    [[noreturn]] void fail(const std::string &file, std::size_t line, const std::string &message)
    {
      throw InputError("Ground motion file '" + file + "', line " + std::to_string(line) + ": " + message);
    }

    constexpr std::uintmax_t largest_file = 100000000; // bytes
    constexpr std::size_t    longest_line = 1000000;

    /** Returns the content of a file. Throws InputError for pipes and devices, which may have no end. */
    std::string read_text(const std::string &file)
    {
      namespace fs = std::filesystem;
      std::error_code error;
      const auto      status = fs::status(file, error);
      if (fs::exists(status) && !fs::is_regular_file(status))
        throw InputError("The ground motion file '" + file + "' is " +
                         (fs::is_directory(status) ? "a directory" : "a pipe or a device") +
                         ". Give the path of a file in section Motion.");
      std::ifstream in(file, std::ios::binary);
      if (!in)
        throw InputError("The ground motion file '" + file +
                         "' cannot be opened. Paths in section Motion are relative to the input file.");
      const std::uintmax_t size = fs::file_size(file, error);
      if (error || size > largest_file)
        throw InputError("The ground motion file '" + file +
                         "' is larger than 100 MB and cannot be an acceleration record. Check the path.");
      std::string text(size, ' ');
      in.read(text.data(), size);
      if (in.gcount() != static_cast<std::streamsize>(size))
        throw InputError("The ground motion file '" + file + "' cannot be read completely. Check the disk.");
      return text;
    }

    /** Returns the words of a line, without its comment. */
    std::vector<std::string> split(std::string text)
    {
      const char *separators = " \t\r,;=";
      text = text.substr(0, text.find('#'));
      std::vector<std::string> words;
      for (std::size_t end = 0, begin;
           (begin = text.find_first_not_of(separators, end)) != std::string::npos;)
      {
        end = std::min(text.find_first_of(separators, begin), text.size());
        words.push_back(text.substr(begin, end - begin));
      }
      return words;
    }

    /** Returns true if the whole word is a number, and stores it in @p number. Infinity and NaN are numbers
     * here. Accepts +1., -.64E-02 and 1.0D-3. The decimal sign is a point in every locale. */
    bool to_number(std::string word, double &number)
    {
      std::replace_if(
          word.begin(), word.end(), [](char c) { return c == 'D' || c == 'd'; }, 'e');
      const char *begin = word.data(), *end = begin + word.size();
      if (begin != end && *begin == '+')
        ++begin;
      const auto result = std::from_chars(begin, end, number);
      if (result.ec == std::errc::result_out_of_range && word.find("e-") != std::string::npos)
        number = 0.; // smaller than the smallest number
      else if (result.ec != std::errc())
        return false;
      return result.ptr == end;
    }

    bool is_number(const std::string &word)
    {
      double ignored = 0.;
      return to_number(word, ignored);
    }

    /** Returns the unit of acceleration in headings such as "a_x [cm/s2]" or "X (g)", as unit_name(). The letter
     * g is a unit in parentheses only. Returns an empty string for no unit and for several units. */
    std::string unit_in(std::string text)
    {
      std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
      const auto is_part = [](const unsigned char c)
      { return std::isalnum(c) || c == '/' || c == '^' || c >= 0x80; };
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

    /** Returns all lines with words. Lines end in LF, CR LF or CR. @p headings receives the text before the
     * first number. */
    std::vector<Line> read_lines(const std::string &file, std::string &headings)
    {
      const std::string text = read_text(file);
      const std::size_t first = text.compare(0, 3, "\xEF\xBB\xBF") == 0 ? 3 : 0; // byte order mark
      if (text.find('\0') != std::string::npos)
        throw InputError("The ground motion file '" + file +
                         "' is not plain text (it has zero bytes). Save it as text, in ASCII or UTF-8.");
      std::vector<Line> lines;
      std::size_t       number = 0;
      for (std::size_t begin = first, end; begin < text.size(); begin = end + 1)
      {
        end = std::min(text.find_first_of("\r\n", begin), text.size());
        ++number;
        if (end - begin > longest_line)
          fail(file, number,
               "the line has more than a million characters, so the file is not a record. Check the path.");
        Line line{number, split(text.substr(begin, end - begin))};
        if (lines.empty() || std::none_of(lines.back().words.begin(), lines.back().words.end(), is_number))
          headings += text.substr(begin, end - begin) + "\n";
        if (!line.words.empty())
          lines.push_back(std::move(line));
        if (end + 1 < text.size() && text[end] == '\r' && text[end + 1] == '\n')
          ++end;
      }
      return lines;
    }

    double read_number(const std::string &file, const Line &line, const std::string &word)
    {
      double number = 0.;
      if (!to_number(word, number) || !std::isfinite(number))
        fail(file, line.number, "'" + word + "' is not a finite number. Correct or remove it.");
      return number;
    }

    bool contains(const Line &line, const std::string &word)
    {
      return std::find(line.words.begin(), line.words.end(), word) != line.words.end();
    }

    /** Returns the line of an AT2 header (usually the fourth) with the number and the interval of the
     * samples. Returns lines.end() for a table. */
    std::vector<Line>::const_iterator find_at2_header(const std::vector<Line> &lines)
    {
      for (auto line = lines.begin(); line != lines.end() && line - lines.begin() < 8; ++line)
        if (contains(*line, "NPTS") && contains(*line, "DT"))
          return line;
      return lines.end();
    }

    /** Throws InputError if a line of an AT2 header states another unit than "UNITS OF G". */
    void check_at2_unit(const std::string &file, const Line &line)
    {
      for (std::size_t k = 2; k < line.words.size(); ++k)
        if (line.words[k - 2] == "UNITS" && line.words[k - 1] == "OF" && line.words[k] != "G" &&
            line.words[k] != "g")
          fail(file, line.number,
               "the header states \"UNITS OF " + line.words[k] +
                   "\", but AT2 files are read in g. Correct the header, or give a table of t and a with its "
                   "unit in Motion/Unit.");
    }

    MotionRecord read_at2(const std::string &file, const std::vector<Line> &lines,
                          std::vector<Line>::const_iterator header)
    {
      for (auto line = lines.begin(); line != header; ++line)
        if (contains(*line, "VELOCITY") || contains(*line, "DISPLACEMENT"))
          fail(file, line->number, "this is not a record of acceleration. Give the .AT2 file instead.");
        else
          check_at2_unit(file, *line);

      // "4000 .01 NPTS, DT" or "NPTS= 4000, DT= .01 SEC": two numbers in this order.
      std::vector<double> numbers;
      double              number = 0.;
      for (const std::string &word : header->words)
        if (to_number(word, number))
          numbers.push_back(number);
      if (numbers.size() != 2 || !(numbers[0] >= 2.) || !(numbers[1] > 0.) ||
          !std::isfinite(numbers[0] * numbers[1]))
        fail(file, header->number, "expected the number of points NPTS and the time step DT, both positive.");

      MotionRecord record;
      record.dt = numbers[1];
      record.in_g = true;
      record.components.resize(1);
      for (auto line = header + 1; line != lines.end(); ++line)
        for (const std::string &word : line->words)
          record.components[0].push_back(read_number(file, *line, word));
      if (record.components[0].size() != numbers[0])
        fail(file, header->number,
             "NPTS is " + std::to_string(std::lround(numbers[0])) + ", but the file holds " +
                 std::to_string(record.components[0].size()) +
                 " values. Download the file again, or correct NPTS.");
      return record;
    }

    /** Returns the time step of @p times [s]. Throws InputError if the steps differ by more than the rounding
     * of the times. */
    double equal_step(const std::string &file, const std::vector<double> &times,
                      const std::vector<std::size_t> &lines)
    {
      std::vector<double> steps;
      for (std::size_t k = 1; k < times.size(); ++k)
      {
        steps.push_back(times[k] - times[k - 1]);
        if (steps.back() <= 0.)
          fail(file, lines[k],
               "time does not increase. Sort the lines, and write the times with more digits.");
      }
      std::vector<double> sorted = steps;
      std::nth_element(sorted.begin(), sorted.begin() + sorted.size() / 2, sorted.end());
      const double usual = sorted[sorted.size() / 2];
      for (std::size_t k = 0; k < steps.size(); ++k)
        if (std::abs(steps[k] - usual) > 0.05 * usual)
          fail(file, lines[k + 1],
               "the time step is " + number_text(steps[k]) + " s, elsewhere " + number_text(usual) +
                   " s. Resample the record at equal steps.");
      const double step = (times.back() - times.front()) / steps.size();
      for (std::size_t k = 0; k < times.size(); ++k)
        if (std::abs(times[k] - times.front() - k * step) > 0.1 * step)
          fail(file, lines[k],
               "the time is " + number_text(times[k]) + " s, but with equal steps between the first and " +
                   "the last it would be " + number_text(times.front() + k * step) +
                   " s. Resample the record at equal steps.");
      return step;
    }

    /** Returns true if the first line of a table has headings. */
    bool has_headings(const std::vector<Line> &lines)
    {
      return !lines.empty() && std::none_of(lines[0].words.begin(), lines[0].words.end(), is_number);
    }

    MotionRecord read_table(const std::string &file, const std::vector<Line> &lines,
                            unsigned int n_components)
    {
      MotionRecord record;
      record.components.resize(n_components);
      std::vector<double>      times;
      std::vector<std::size_t> numbers;
      for (auto line = lines.begin() + has_headings(lines); line != lines.end(); ++line)
      {
        if (line->words.size() != n_components + 1)
          fail(file, line->number,
               std::to_string(line->words.size()) + " columns. " +
                   (n_components == 1 ? "Expected two, t and a, or an AT2 file; a file with t, a_x, a_y, a_z "
                                        "belongs to the entry Motion/File. "
                                      : "Motion/File expects four, t, a_x, a_y, a_z; files with one "
                                        "component belong to the entries File x, File y, File z. ") +
                   "One line of headings without numbers may come first; put # before other text. Decimals "
                   "have a point, not a comma.");
        times.push_back(read_number(file, *line, line->words[0]));
        numbers.push_back(line->number);
        for (unsigned int c = 0; c < n_components; ++c)
          record.components[c].push_back(read_number(file, *line, line->words[c + 1]));
      }
      if (times.size() < 2)
        throw InputError("The ground motion file '" + file + "' holds fewer than two times.");
      record.start = times.front();
      record.dt = equal_step(file, times, numbers);
      return record;
    }
  } // namespace

  double MotionRecord::duration() const
  {
    return dt * (components.at(0).size() - 1);
  }

  MotionRecord read_motion_record(const std::string &file, unsigned int n_components)
  {
    std::string             headings;
    const std::vector<Line> lines = read_lines(file, headings);
    const auto              header = find_at2_header(lines);
    if (header == lines.end())
    {
      MotionRecord record = read_table(file, lines, n_components);
      record.unit = unit_in(headings);
      return record;
    }
    if (n_components != 1)
      fail(file, header->number,
           "an AT2 file has one component. Give it as File x, File y or File z, or "
           "in Motion/Sequence as one of three files, for x, y, z.");
    return read_at2(file, lines, header);
  }

  NumberTable read_number_table(const std::string &file)
  {
    NumberTable             table;
    std::string             headings;
    const std::vector<Line> lines = read_lines(file, headings);
    for (auto line = lines.begin() + has_headings(lines); line != lines.end(); ++line)
    {
      table.lines.push_back(line->number);
      table.rows.emplace_back();
      for (const std::string &word : line->words)
        table.rows.back().push_back(read_number(file, *line, word));
    }
    table.unit = unit_in(headings);
    return table;
  }
} // namespace Voussoir
