#include <voussoir/interrupt.h>

#include <csignal>

namespace Voussoir
{
  namespace
  {
    volatile std::sig_atomic_t noted = 0;

    void note(const int signal)
    {
      noted = signal;
      std::signal(SIGINT, SIG_DFL);
      std::signal(SIGTERM, SIG_DFL);
    }
  } // namespace

  InterruptGuard::InterruptGuard()
  {
    noted = 0;
    std::signal(SIGINT, note);
    std::signal(SIGTERM, note);
  }

  InterruptGuard::~InterruptGuard()
  {
    std::signal(SIGINT, SIG_DFL);
    std::signal(SIGTERM, SIG_DFL);
  }

  const char *InterruptGuard::received() const
  {
    return noted == 0 ? nullptr : noted == SIGINT ? "SIGINT" : "SIGTERM";
  }
} // namespace Voussoir
