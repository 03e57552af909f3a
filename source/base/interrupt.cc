// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/interrupt.h>

#include <csignal>
#include <unistd.h>

namespace Voussoir
{
  namespace
  {
    constexpr int         numbers[3] = {SIGINT, SIGTERM, SIGHUP};
    constexpr const char *names[3] = {"SIGINT", "SIGTERM", "SIGHUP"};

    volatile std::sig_atomic_t noted = 0;
    bool                       living = false;

    void note(const int signal)
    {
      noted = signal;
      for (const int number : numbers)
        std::signal(number, SIG_DFL);
      constexpr char text[] =
          "voussoir: stopping when the state is saved; a second signal ends the program immediately\n";
      if (write(STDERR_FILENO, text, sizeof(text) - 1) < 0) // stderr is closed
        return;
    }
  } // namespace

  InterruptGuard::InterruptGuard()
  {
    living = true;
    noted = 0;
    std::signal(SIGPIPE, SIG_IGN); // a closed stdout must not end the run
    for (unsigned int i = 0; i < 3; ++i)
      if ((before[i] = std::signal(numbers[i], note)) == SIG_IGN)
        std::signal(numbers[i], SIG_IGN);
  }

  InterruptGuard::~InterruptGuard()
  {
    for (unsigned int i = 0; i < 3; ++i)
      std::signal(numbers[i], before[i]);
    living = false;
  }

  bool InterruptGuard::lives()
  {
    return living;
  }

  const char *InterruptGuard::received()
  {
    for (unsigned int i = 0; i < 3; ++i)
      if (noted == numbers[i])
        return names[i];
    return nullptr;
  }
} // namespace Voussoir
