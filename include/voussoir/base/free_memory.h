// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_free_memory_h
#define voussoir_free_memory_h

namespace Voussoir
{
  /** Returns freed memory to the operating system (malloc_trim() of glibc; no effect with other C
   * libraries). Blocks between allocations that are in use remain with the process. Call the function
   * after large deallocations. */
  void release_free_memory();
} // namespace Voussoir

#endif
