// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_cholmod_objects_h
#define voussoir_cholmod_objects_h

#include <cholmod.h>

namespace Voussoir
{
  /** Workspace, matrix and factor of CHOLMOD with automatic release of their memory. CHOLMOD prints nothing. */
  struct CholmodObjects
  {
    mutable cholmod_common common;
    cholmod_sparse        *A = nullptr; ///< matrix, or a null pointer
    cholmod_factor        *L = nullptr; ///< factor, or a null pointer

    CholmodObjects()
    {
      cholmod_start(&common);
      common.print = 0;
    }
    ~CholmodObjects()
    {
      cholmod_free_sparse(&A, &common);
      cholmod_free_factor(&L, &common);
      cholmod_finish(&common);
    }
    CholmodObjects(const CholmodObjects &) = delete;
    CholmodObjects &operator=(const CholmodObjects &) = delete;
  };
} // namespace Voussoir

#endif
