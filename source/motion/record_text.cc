// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/error.h>
#include <voussoir/base/number_text.h>
#include <voussoir/motion/record_text.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>

namespace Voussoir
{
  namespace
  {
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
  } // namespace

  void RecordText::fail(const std::size_t line, const std::string &message) const
  {
    throw InputError("Ground motion file '" + file + "', line " + std::to_string(line + 1) + ": " + message +
                     (format.empty() ? "" : " The file was read as " + format + "."));
  }

  std::size_t RecordText::find(const std::string &phrase, const std::size_t begin,
                               const std::size_t end) const
  {
    for (std::size_t line = begin; line < std::min(end, lines.size()); ++line)
      if (lower_case(lines[line]).find(phrase) != std::string::npos)
        return line;
    return lines.size();
  }

  std::string RecordText::value(const std::string &key) const
  {
    const std::size_t line = find(key);
    if (line == lines.size())
      return "";
    const std::string rest = lines[line].substr(lower_case(lines[line]).find(key) + key.size());
    return trimmed(rest.substr(rest.find_first_of(":=") + 1)); // without both: from 0
  }

  double RecordText::positive(const std::string &key) const
  {
    const double number = leading_number(value(key));
    if (!(number > 0. && std::isfinite(number)))
      fail(std::min(find(key), lines.size() - 1),
           "expected a positive number after '" + key + "'. Download the file again, or correct its header.");
    return number;
  }

  std::vector<double> RecordText::numbers(std::size_t &line, const double stated, const std::size_t width,
                                          const bool to_end) const
  {
    std::vector<double> result;
    const std::size_t   before = line - 1, n_numbers = stated >= 2. && stated <= 1e8 ? stated : 0.;
    if (n_numbers == 0 || n_numbers != stated)
      fail(before, "the header states " + number_text(stated) +
                       " values, but their number must be whole, from 2 to 1e8. Correct the header.");
    for (; line < lines.size() && (to_end || result.size() < n_numbers); ++line)
    {
      std::vector<std::string> words = words_of(lines[line]);
      if (width > 0 && !std::all_of(words.begin(), words.end(), is_number))
      {
        words.clear();
        for (std::size_t begin = 0; begin < lines[line].size(); begin += width)
          if (const std::string word = trimmed(lines[line].substr(begin, width)); !word.empty())
            words.push_back(word);
      }
      for (const std::string &word : words)
        if (result.push_back(0.); !to_number(word, result.back()) || !std::isfinite(result.back()))
          fail(line, "'" + word + "' is not a finite number (value " + std::to_string(result.size()) +
                         " of " + std::to_string(n_numbers) +
                         "). Download the file again, or correct the line.");
    }
    if (result.size() != n_numbers)
      fail(before, "the header states " + std::to_string(n_numbers) + " values, but there are " +
                       std::to_string(result.size()) + ". Download the file again, or correct the header.");
    return result;
  }

  RecordText read_record_text(const std::string &file)
  {
    std::string text = read_text(file);
    if (text.compare(0, 2, "\xFF\xFE") == 0 || text.compare(0, 2, "\xFE\xFF") == 0) // UTF-16
    {
      text.erase(0, 2);
      text.erase(std::remove(text.begin(), text.end(), '\0'), text.end());
    }
    if (text.find('\0') != std::string::npos)
      throw InputError("The ground motion file '" + file +
                       "' is not plain text (it has zero bytes). Save it as text, in ASCII or UTF-8.");
    RecordText result{file, "", {}};
    for (std::size_t begin = text.compare(0, 3, "\xEF\xBB\xBF") == 0 ? 3 : 0, end; begin < text.size();
         begin = end + 1)
    {
      end = std::min(text.find_first_of("\r\n", begin), text.size());
      if (end - begin > longest_line)
        result.fail(
            result.lines.size(),
            "the line has more than a million characters, so the file is not a record. Check the path.");
      result.lines.push_back(text.substr(begin, end - begin));
      if (end + 1 < text.size() && text[end] == '\r' && text[end + 1] == '\n')
        ++end;
    }
    return result;
  }

  std::vector<std::string> words_of(const std::string &line)
  {
    const char              *separators = " \t\r,;=\x1A"; // 1A: end of a file of DOS
    std::vector<std::string> words;
    for (std::size_t end = 0, begin; (begin = line.find_first_not_of(separators, end)) != std::string::npos;)
    {
      end = std::min(line.find_first_of(separators, begin), line.size());
      words.push_back(line.substr(begin, end - begin));
    }
    return words;
  }

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

  double leading_number(const std::string &text)
  {
    const std::string word = trimmed(text);
    double            number = 0.;
    return std::from_chars(word.data(), word.data() + word.size(), number).ec == std::errc() ? number : NAN;
  }

  std::string lower_case(std::string text)
  {
    std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
    return text;
  }

  std::string trimmed(const std::string &text)
  {
    const char       *ends = " \t\r\"'\x1A";
    const std::size_t first = text.find_first_not_of(ends);
    return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(ends) - first + 1);
  }
} // namespace Voussoir
