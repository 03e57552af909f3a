// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_scene_ranges_h
#define voussoir_scene_ranges_h

#include <voussoir/app/declared_entries.h>
#include <voussoir/base/entries.h>
#include <voussoir/dam/scene.h>

namespace Voussoir
{
  /** Entry in the input file or on the command line (--set). */
  struct WrittenEntry
  {
    DeclaredEntry declared;
    std::string   value; ///< in the declared unit
    std::string   place; ///< such as "scene.prm, line 7"
  };

  /** Number from an entry, a table or the material of a zone. */
  struct UsedValue
  {
    std::string what;  ///< text for messages: "Concrete/Density (scene.prm, line 7)"
    std::string range; ///< entry with the usual range of the number
    std::string unit;
    double      value; ///< value in @p unit
    std::string place; ///< such as "scene.prm, line 7", or the entry of a list

    const UsualRange *of_list =
        nullptr;          ///< usual range of a number in a list; null: that of the entry @p range
    bool in_file = false; ///< a number in a file of columns carries no unit
  };

  /** Returns the number of an entry. */
  UsedValue used_value(const WrittenEntry &entry);

  /** Returns the numbers of entries with several numbers: materials of zones, lists, tables. */
  std::vector<UsedValue> values_of_sources(const Scene &scene);

  /** Returns a warning about a value outside of its range in @p usual. Empty: plausible, or no range. */
  std::string implausible(const UsedValue &value, const UsualRanges &usual);

  /** Returns warnings about implausible combinations of entries (scene_relations.cc). @p entries: entries in the input
   * file. */
  std::vector<Warning> odd_relations(const Scene &scene, const std::vector<WrittenEntry> &entries);
} // namespace Voussoir

#endif
