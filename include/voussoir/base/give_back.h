// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_give_back_h
#define voussoir_give_back_h

namespace Voussoir
{
  /** Memory that was freed goes back to the system, where the C library knows how to (glibc). It keeps what
   * lies between things in use, and does not find all of it again. To be called when much has been freed. */
  void give_back_memory();
} // namespace Voussoir

#endif
