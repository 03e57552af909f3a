// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_scene_warnings_h
#define voussoir_scene_warnings_h

#include <voussoir/app/scene_ranges.h>
#include <voussoir/dam/scene.h>

namespace Voussoir
{
  /** Returns warnings about @p entries without effect because of other entries, and about values outside of
   * their @p usual range. Entries with their default value are not reported. */
  std::vector<Warning> scene_warnings(const Scene &scene, const std::vector<WrittenEntry> &entries,
                                      const UsualRanges &usual);

  /** Returns all entries and sections ("Joints/Keys/") with such warnings, for tests. */
  std::vector<std::string> entries_with_warnings();
} // namespace Voussoir

#endif
