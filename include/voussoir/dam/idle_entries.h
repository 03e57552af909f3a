// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_idle_entries_h
#define voussoir_idle_entries_h

#include <voussoir/base/names.h>
#include <voussoir/dam/scene.h>

namespace Voussoir
{
  /** When the condition holds, the entries have no effect, but for the exceptions. */
  struct IdleEntries
  {
    const char *reason;
    bool (*holds)(const Scene &);
    EntryNames entries, exceptions = {};
  };
} // namespace Voussoir

#endif
