// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_error_h
#define voussoir_error_h

#include <stdexcept>
#include <string>

namespace Voussoir
{
  /** Bad input: what() is one paragraph that says what is wrong, where (entry, file, line, mesh name)
   *  and how to mend it. The program prints it after "voussoir: error: " and ends with status 2. */
  class InputError : public std::runtime_error
  {
  public:
    using std::runtime_error::runtime_error;
  };

  /** The computation failed (no convergence, not a number): says at which step and why. Exit status 1. */
  class ComputationError : public std::runtime_error
  {
  public:
    using std::runtime_error::runtime_error;
  };
} // namespace Voussoir

#endif
