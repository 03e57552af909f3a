// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/give_back.h>

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace Voussoir
{
  void give_back_memory()
  {
#ifdef __GLIBC__
    malloc_trim(0);
#endif
  }
} // namespace Voussoir
