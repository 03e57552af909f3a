// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_scene_ranges_h
#define voussoir_scene_ranges_h

#include <voussoir/app/declared_entries.h>

namespace Voussoir
{
  /** An entry that the user gave, in a scene or by --set. */
  struct WrittenEntry
  {
    DeclaredEntry declared;
    std::string   value; ///< in the declared unit
    std::string   place; ///< "scene.prm, line 7"
  };

  /** What is said of a value that no dam, rock, water or earthquake has; empty if it is plausible, or nothing
   * is known about it. */
  std::string implausible(const WrittenEntry &entry);

  std::vector<std::string> entries_with_ranges(); ///< by their names in scene files
} // namespace Voussoir

#endif
