// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_record_text_h
#define voussoir_record_text_h

#include <cstddef>
#include <string>
#include <vector>

namespace Voussoir
{
  /** Lines of a text file with numbers. Line numbers of the functions begin with 0, those of messages with 1. */
  struct RecordText
  {
    std::string              file;   ///< path, for messages
    std::string              format; ///< name and source of the format for messages, or empty
    std::vector<std::string> lines;

    /** Throws InputError with file, line and format. */
    [[noreturn]] void fail(std::size_t line, const std::string &message) const;

    /** Returns the first line from @p begin on, before @p end, that contains @p phrase in lower or upper case.
     * Returns lines.size() if there is none. @param phrase in lower case */
    std::size_t find(const std::string &phrase, std::size_t begin = 0, std::size_t end = 100) const;

    bool has(const std::string &phrase) const { return find(phrase) < lines.size(); }

    /** Returns the text after @p key in the first line that contains it, or else an empty string. If a colon or
     * an equal sign follows, the text begins there. @param key in lower case */
    std::string value(const std::string &key) const;

    /** Returns the number after @p key. Throws InputError unless it is positive. */
    double positive(const std::string &key) const;

    /** Reads the numbers of successive lines, @p stated by the header, to the end of the file if @p to_end.
     * @param line first line; receives the first line that is not read
     * @param width columns of a number, for numbers without blanks between them; 0: they have blanks
     *
     * Throws InputError for other text, for another number of values, and unless @p stated is whole, from 2 to 1e8. */
    std::vector<double> numbers(std::size_t &line, double stated, std::size_t width = 0,
                                bool to_end = false) const;
  };

  /** Reads a file in ASCII, UTF-8 or UTF-16 whose lines end in LF, CR LF or CR. Throws InputError if it is no
   * regular text file of at most 100 MB, or a line exceeds a million characters. */
  RecordText read_record_text(const std::string &file);

  /** Returns the words of a line between blanks, commas, semicolons and equal signs. */
  std::vector<std::string> words_of(const std::string &line);

  /** Returns true if the whole word is a number, and stores it in @p number. Infinity and NaN are numbers here.
   * Accepts +1., -.64E-02 and 1.0D-3. The decimal sign is a point in every locale. */
  bool to_number(std::string word, double &number);

  bool is_number(const std::string &word);

  /** Returns the number at the beginning of a text, as in ".0050SEC", or else NaN. */
  double leading_number(const std::string &text);

  std::string lower_case(std::string text);

  /** Returns a text without blanks and quotation marks at its ends. */
  std::string trimmed(const std::string &text);
} // namespace Voussoir

#endif
