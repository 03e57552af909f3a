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
  /** An entry of a scene as it is declared. */
  struct DeclaredEntry
  {
    std::vector<std::string> path; ///< subsections, then the entry
    std::string              default_value, documentation;
    std::string              pattern; ///< deal.II's description of what is allowed

    std::string name() const; ///< "Section/Subsection/Entry"

    /** The first unit in square brackets in the documentation ("Pa", "-"), empty if there is none. */
    std::string unit() const;
  };

  std::vector<DeclaredEntry> declared_entries(const dealii::ParameterHandler &prm);

  /** The path as text: "Section/Subsection/Entry". */
  std::string joined(const std::vector<std::string> &path);

  /** A pattern in words: "a number of at least 0", "an integer from 1 to 2", "one of: tied, FJA, FJB". */
  std::string pattern_in_words(const std::string &pattern);

  /** The separator of the entries of a map or a list with this pattern, else 0. */
  char separator_of(const std::string &pattern);

  /** Prints the entries in @p section ("Joints/Keys", or a single entry; empty: all) as @p format "prm",
   * "json" or "markdown" (a table). Throws InputError for another format, and for an unknown section with the
   *  nearest known one. */
  void print_entries(const dealii::ParameterHandler &prm, const std::string &format,
                     const std::string &section, std::ostream &out);
} // namespace Voussoir

#endif
