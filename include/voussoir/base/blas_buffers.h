// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_blas_buffers_h
#define voussoir_blas_buffers_h

namespace Voussoir
{
  /** Lets OpenBLAS take the buffers of all threads (up to 128 MB of addresses each, by the processor) while
   * there is memory, if the process has a limit of it (RLIMIT_AS): where OpenBLAS gets none it tries for
   * ever. Throws std::bad_alloc. */
  void take_blas_buffers();
} // namespace Voussoir

#endif
