// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_error_h
#define voussoir_error_h

#include <stdexcept>
#include <string>

namespace Voussoir
{
  /** Error in the input. The message what() is one paragraph: what is wrong, where (entry, file, line, mesh
   * name) and what to do. The program prints it after "voussoir: error: " and exits with status 2. */
  class InputError : public std::runtime_error
  {
  public:
    using std::runtime_error::runtime_error;
  };

  /** Failure of the computation, such as no convergence or a value that is not finite. The message states the
   * time step and the cause. The program prints it after "voussoir: failed: " and exits with status 1. */
  class ComputationError : public std::runtime_error
  {
  public:
    using std::runtime_error::runtime_error;
  };
} // namespace Voussoir

#endif
