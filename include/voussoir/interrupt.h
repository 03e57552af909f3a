#ifndef voussoir_interrupt_h
#define voussoir_interrupt_h

#include <voussoir/error.h>

namespace Voussoir
{
  /** The user, or the machine's scheduler, has asked the program to stop. */
  class Interrupted : public ComputationError
  {
  public:
    using ComputationError::ComputationError;
  };

  /** While an object of this class lives, the first SIGINT or SIGTERM is only noted, so that the work can be
   * put away; a second one ends the program at once. At most one may live at a time. */
  class InterruptGuard
  {
  public:
    InterruptGuard();
    ~InterruptGuard();
    InterruptGuard(const InterruptGuard &) = delete;
    InterruptGuard &operator=(const InterruptGuard &) = delete;

    /** "SIGINT" or "SIGTERM" if one has come, else a null pointer. */
    const char *received() const;
  };
} // namespace Voussoir

#endif
