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

  /** Error of writing a file: the disk is full, a directory has the same name, or the
   * permission is missing. */
  class WriteError : public ComputationError
  {
  public:
    using ComputationError::ComputationError;

    /** Returns the error "The file FILE cannot be written: REASON" with the reason of the last failed
     * system call (errno). */
    static WriteError of(const std::string &file);
  };

  /** Error because a factor exceeds the integers of CHOLMOD. */
  struct FactorTooLarge : ComputationError
  {
    explicit FactorTooLarge(const std::string &body = "A monolith")
        : ComputationError(body + " is too large for the solver: its factor has more than 2^31 entries. "
                                  "Divide it by joints, or use fewer elements in it.")
    {
    }
  };
} // namespace Voussoir

#endif
