// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_blas_buffers_h
#define voussoir_blas_buffers_h

namespace Voussoir
{
  /** Allocates the OpenBLAS buffers of all OpenMP threads (up to 128 MB of address space each, depending on
   * the processor). The function has an effect with OpenBLAS and a limit of the address space (RLIMIT_AS)
   * only. Under such a limit the buffers must be allocated early: OpenBLAS retries a failed allocation
   * indefinitely. Throws std::bad_alloc if the buffers do not fit. */
  void take_blas_buffers();
} // namespace Voussoir

#endif
