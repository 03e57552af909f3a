// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_scene_relations_h
#define voussoir_scene_relations_h

#include <voussoir/app/scene_ranges.h>
#include <voussoir/dam/scene.h>

namespace Voussoir
{
  /** Returns warnings about implausible combinations of entries. @p entries: entries in the input file. */
  std::vector<Warning> odd_relations(const Scene &scene, const std::vector<WrittenEntry> &entries);
} // namespace Voussoir

#endif
