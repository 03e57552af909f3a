// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_idle_entries_h
#define voussoir_idle_entries_h

#include <voussoir/base/names.h>
#include <voussoir/dam/scene.h>

namespace Voussoir
{
  /** Entries without effect under a condition. */
  struct IdleEntries
  {
    const char *reason;           ///< condition, for the message
    bool (*holds)(const Scene &); ///< condition
    EntryNames entries;           ///< entries without effect
    EntryNames exceptions = {};   ///< those among @p entries with an effect
  };
} // namespace Voussoir

#endif
