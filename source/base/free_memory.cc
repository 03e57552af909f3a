// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/free_memory.h>

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace Voussoir
{
  void release_free_memory()
  {
#ifdef __GLIBC__
    malloc_trim(0);
#endif
  }
} // namespace Voussoir
