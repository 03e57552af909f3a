// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_scene_warnings_h
#define voussoir_scene_warnings_h

#include <voussoir/app/declared_entries.h>
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

  /** Sentences about those entries that have no effect, because of what the others say, and about those whose
   *  value is outside of what dams have. Entries that repeat the default are not spoken of. */
  std::vector<std::string> scene_warnings(const Scene &scene, const std::vector<WrittenEntry> &entries);

  /** The entries and sections ("Joints/Keys/") that the tables behind scene_warnings() name, for tests. */
  std::vector<std::string> entries_with_warnings();
} // namespace Voussoir

#endif
