// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_interrupt_h
#define voussoir_interrupt_h

#include <voussoir/base/error.h>

#include <array>

namespace Voussoir
{
  /** Exception: the user or the job scheduler has requested the program to stop. The program prints the
   * message after "voussoir: stopped: " and exits with status 1. */
  class Interrupted : public ComputationError
  {
  public:
    using ComputationError::ComputationError;
  };

  /** Handler of SIGINT, SIGTERM and SIGHUP during the life of the object. The first signal is recorded, so
   * that the program can save its state, and a line is printed to stderr. A second signal ends the program
   * immediately. A signal that was ignored at the start of the program (nohup) remains ignored. At most one
   * object may exist at a time. */
  class InterruptGuard
  {
  public:
    InterruptGuard();
    ~InterruptGuard();
    InterruptGuard(const InterruptGuard &) = delete;
    InterruptGuard &operator=(const InterruptGuard &) = delete;

    static bool lives(); ///< returns whether an object exists

    /** Returns "SIGINT", "SIGTERM" or "SIGHUP" if that signal was received, else a null pointer. */
    static const char *received();

  private:
    std::array<void (*)(int), 3> before; ///< handlers that the destructor restores
  };
} // namespace Voussoir

#endif
