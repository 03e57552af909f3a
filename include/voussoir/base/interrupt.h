// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_interrupt_h
#define voussoir_interrupt_h

#include <voussoir/base/error.h>

#include <array>

namespace Voussoir
{
  /** The user, or the machine's scheduler, has asked the program to stop. */
  class Interrupted : public ComputationError
  {
  public:
    using ComputationError::ComputationError;
  };

  /** While an object of this class lives, the first SIGINT, SIGTERM or SIGHUP is only noted, so that the work
   * can be put away, and one line on stderr says so; a second one ends the program at once. A signal that the
   * program was started to ignore (nohup) stays ignored. At most one may live at a time. */
  class InterruptGuard
  {
  public:
    InterruptGuard();
    ~InterruptGuard();
    InterruptGuard(const InterruptGuard &) = delete;
    InterruptGuard &operator=(const InterruptGuard &) = delete;

    static bool lives(); ///< is there one?

    /** "SIGINT", "SIGTERM" or "SIGHUP" if one has come, else a null pointer. */
    const char *received() const;

  private:
    std::array<void (*)(int), 3> before; ///< the handlers
  };
} // namespace Voussoir

#endif
