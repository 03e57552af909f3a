// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/blas_buffers.h>

#include <cstdlib>
#include <new>
#include <omp.h>
#include <vector>

#include <sys/resource.h>

// Functions of OpenBLAS. They are null with another library.
extern "C" void *blas_memory_alloc(int) __attribute__((weak));
extern "C" void  blas_memory_free(void *) __attribute__((weak));

namespace Voussoir
{
  void take_blas_buffers()
  {
    constexpr std::size_t buffer = std::size_t(130) << 20;
    rlimit                limit;
    if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY ||
        blas_memory_alloc == nullptr || blas_memory_free == nullptr)
      return;
    const int           n_threads = omp_get_max_threads();
    std::vector<void *> trial;
    for (int i = 0; i < n_threads; ++i)
      trial.push_back(std::malloc(buffer));
    bool enough = true;
    for (void *place : trial)
    {
      enough = enough && place != nullptr;
      std::free(place);
    }
    if (!enough)
      throw std::bad_alloc();

    for (void *&place : trial) // all before the first release, so that each thread has its own
      place = blas_memory_alloc(0);
    for (void *place : trial)
      blas_memory_free(place);
  }
} // namespace Voussoir
