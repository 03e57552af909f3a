// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_scene_ranges_h
#define voussoir_scene_ranges_h

#include <voussoir/app/declared_entries.h>
#include <voussoir/base/entries.h>
#include <voussoir/dam/scene.h>

namespace Voussoir
{
  /** An entry that the user gave, in a scene or by --set. */
  struct WrittenEntry
  {
    DeclaredEntry declared;
    std::string   value; ///< in the declared unit
    std::string   place; ///< "scene.prm, line 7"
  };

  /** A number that the computation uses, from an entry, a table or the material of a zone. */
  struct UsedValue
  {
    std::string what;  ///< for messages: "Concrete/Density (scene.prm, line 7)"
    std::string range; ///< entry whose usual range holds for it
    std::string unit;
    double      value; ///< in that unit
  };

  UsedValue used_value(const WrittenEntry &entry);

  /** The numbers that do not come from entries of one number each: materials of zones, temperatures of a
   * table. Reads the table. */
  std::vector<UsedValue> values_of_sources(const Scene &scene);

  /** A sentence about a value outside of the usual range of its entry; empty if it is inside, or no range is
   * declared. */
  std::string implausible(const UsedValue &value, const UsualRanges &usual);
} // namespace Voussoir

#endif
