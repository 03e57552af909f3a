// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_scene_warnings_h
#define voussoir_scene_warnings_h

#include <voussoir/app/scene_ranges.h>
#include <voussoir/dam/scene.h>

namespace Voussoir
{
  /** Sentences about those entries that have no effect, because of what the others say, and about those whose
   *  value is outside of its usual range. Entries that repeat the default are not spoken of. */
  std::vector<std::string> scene_warnings(const Scene &scene, const std::vector<WrittenEntry> &entries,
                                          const UsualRanges &usual);

  /** The entries and sections ("Joints/Keys/") that the tables behind scene_warnings() name, for tests. */
  std::vector<std::string> entries_with_warnings();
} // namespace Voussoir

#endif
