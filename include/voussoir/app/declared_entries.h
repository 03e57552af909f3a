// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_declared_entries_h
#define voussoir_declared_entries_h

#include <iosfwd>
#include <string>
#include <vector>

namespace dealii
{
  class ParameterHandler;
}

namespace Voussoir
{
  /** Declaration of an entry of the input file. */
  struct DeclaredEntry
  {
    std::vector<std::string> path; ///< subsections, then the entry
    std::string              default_value, documentation;
    std::string              pattern; ///< deal.II's description of the allowed values

    /** Returns "Section/Subsection/Entry". */
    std::string name() const;

    /** Returns the first unit in square brackets in the documentation, such as "Pa", or "". */
    std::string unit() const;
  };

  /** Returns all entries, in the order of declaration. */
  std::vector<DeclaredEntry> declared_entries(const dealii::ParameterHandler &prm);

  /** Returns the path as text: "Section/Subsection/Entry". */
  std::string joined(const std::vector<std::string> &path);

  /** Returns a pattern in words, such as "a number of at least 0" or "one of: tied, FJA, FJB". */
  std::string pattern_in_words(const std::string &pattern);

  /** Returns the separator of a map or a list with this pattern, or 0. */
  char separator_of(const std::string &pattern);

  /** Sets an entry, with its value converted to the declared unit, and returns this value. Throws InputError for
   * an invalid value; the message begins with @p what. */
  std::string set_entry(dealii::ParameterHandler &prm, const DeclaredEntry &declared,
                        const std::string &value, const std::string &what);

  /** Prints entries. Throws InputError for an unknown format or section.
   * @param prm all declarations
   * @param format "prm", "json" or "markdown"
   * @param section such as "Joints/Keys", or a single entry; empty: all
   * @param out stream */
  void print_entries(const dealii::ParameterHandler &prm, const std::string &format,
                     const std::string &section, std::ostream &out);
} // namespace Voussoir

#endif
