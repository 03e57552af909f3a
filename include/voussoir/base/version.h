// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_version_h
#define voussoir_version_h

namespace Voussoir
{
  /** Returns the version of the program. */
  const char *version();

  /** Returns the commit of the sources, "unknown" without git. */
  const char *revision();
} // namespace Voussoir

#endif
