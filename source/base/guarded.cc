// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/error.h>
#include <voussoir/base/guarded.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <fstream>
#include <iomanip>
#include <new>
#include <omp.h>
#include <poll.h>
#include <sstream>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace Voussoir
{
  namespace
  {
    enum class Outcome : unsigned char
    {
      done,
      bad_input,
      failed,
      no_memory,
      exception
    };

    double seconds_now()
    {
      return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
    }

    /** Returns the address space of this process [bytes]; 0 without /proc. */
    double address_space()
    {
      double pages = 0.;
      std::ifstream("/proc/self/statm") >> pages;
      return pages * double(sysconf(_SC_PAGESIZE));
    }

    /** Sets the limits of this process. Exceeding them causes SIGXCPU or std::bad_alloc. */
    void set_limits(const GuardLimits &limits)
    {
      const auto set = [](const auto resource, const double limit)
      {
        rlimit now{};
        if (getrlimit(resource, &now) == 0 && limit < double(now.rlim_max))
        {
          now.rlim_cur = now.rlim_max = static_cast<rlim_t>(limit);
          setrlimit(resource, &now);
        }
      };
      set(RLIMIT_CORE, 0.);
      set(RLIMIT_CPU, std::ceil(limits.cpu_seconds));
#ifndef __SANITIZE_ADDRESS__ // its shadow memory exceeds any limit
      if (const double used = address_space(); used > 0.)
        set(RLIMIT_AS, used + limits.memory);
#endif
    }

    void silence()
    {
      const int nowhere = open("/dev/null", O_RDWR);
      for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
        dup2(nowhere, descriptor);
    }

    /** Runs @p work. Returns the outcome and the @p message of an exception. */
    Outcome attempt(const std::function<void()> &work, std::string &message)
    {
      try
      {
        work();
        return Outcome::done;
      }
      catch (const InputError &error)
      {
        message = error.what();
        return Outcome::bad_input;
      }
      catch (const ComputationError &error)
      {
        message = error.what();
        return Outcome::failed;
      }
      catch (const std::bad_alloc &)
      {
        return Outcome::no_memory;
      }
      catch (const std::exception &error)
      {
        message = error.what();
        return Outcome::exception;
      }
    }

    /** Runs the child process: @p work, then @p send. Never returns. */
    [[noreturn]] void child(const int descriptor, const GuardLimits &limits,
                            const std::function<void()> &work, const std::function<void(PipeWriter &)> &send)
    {
      prctl(PR_SET_PDEATHSIG, SIGKILL);
      for (const int number : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGXCPU})
        std::signal(number, SIG_DFL); // the program may have other handlers
      for (const int number : {SIGINT, SIGTERM, SIGHUP})
        std::signal(number, SIG_IGN); // only for the parent, which ends its child
      std::signal(SIGPIPE, SIG_IGN);
      std::atexit([] { _exit(1); }); // skips the exit functions of the parent if a library calls exit()
      omp_set_num_threads(1);        // the child has a single thread
      silence();
      set_limits(limits);
      try
      {
        std::string   message;
        const Outcome outcome = attempt(work, message);
        PipeWriter    pipe(descriptor);
        pipe.put(outcome);
        if (outcome == Outcome::done)
          send(pipe);
        else
          pipe.put(message);
      }
      catch (...) // the parent does not read any more
      {
        _exit(1);
      }
      _exit(0);
    }

    /** Child process, which the destructor kills if it still runs. */
    class Child
    {
    public:
      explicit Child(const pid_t id) : id(id) {}
      ~Child() { end(); }
      Child(const Child &) = delete;
      Child &operator=(const Child &) = delete;

      /** Kills the child if it still runs, and returns its exit status. */
      int end()
      {
        int status = 0;
        if (id > 0)
        {
          kill(id, SIGKILL); // no effect on an ended process
          while (waitpid(id, &status, 0) < 0 && errno == EINTR)
            ;
        }
        id = 0;
        return status;
      }

    private:
      pid_t id;
    };

    std::string reason_of_death(const int status, const GuardLimits &limits)
    {
      constexpr const char *damaged = ". The file is damaged; write it again.";
      if (WIFSIGNALED(status) && (WTERMSIG(status) == SIGXCPU || WTERMSIG(status) == SIGKILL))
        return "reading did not end within " + std::to_string(std::lround(std::ceil(limits.cpu_seconds))) +
               " s of CPU time, or the reading process was killed, for example for lack of memory. Check the "
               "file.";
      if (WIFSIGNALED(status))
        return std::string("the library that reads the file crashed (") + strsignal(WTERMSIG(status)) + ")" +
               damaged;
      return std::string("the library that reads the file ended the process") + damaged;
    }

    ComputationError no_child(const std::string &problem)
    {
      return ComputationError(problem + ": no second process can be started (" + std::strerror(errno) +
                              "). Free memory, or increase the limit of processes (ulimit -u).");
    }

    /** File descriptor, closed by the destructor. */
    struct Descriptor
    {
      int value;
      ~Descriptor()
      {
        if (value >= 0)
          close(value);
      }
    };
  } // namespace

  void PipeWriter::put(const void *bytes, std::size_t n)
  {
    for (auto *p = static_cast<const char *>(bytes); n > 0;)
    {
      const ssize_t written = write(descriptor, p, n);
      if (written < 0 && errno == EINTR)
        continue;
      if (written <= 0)
        throw std::runtime_error("the reading end of the pipe is closed");
      p += written;
      n -= static_cast<std::size_t>(written);
    }
  }

  PipeReader::PipeReader(const int descriptor, const double seconds)
      : descriptor(descriptor), deadline(seconds_now() + seconds)
  {
  }

  void PipeReader::get(void *bytes, std::size_t n)
  {
    for (auto *p = static_cast<char *>(bytes); n > 0;)
    {
      const double left = deadline - seconds_now();
      pollfd       waiting{descriptor, POLLIN, 0};
      const int    ready = left > 0. ? poll(&waiting, 1, 1 + static_cast<int>(1e3 * std::min(left, 1e6))) : 0;
      if (ready < 0 && errno == EINTR)
        continue;
      if (ready <= 0)
        throw End();
      const ssize_t got = read(descriptor, p, n);
      if (got < 0 && errno == EINTR)
        continue;
      if (got <= 0)
        throw End();
      p += got;
      n -= static_cast<std::size_t>(got);
    }
  }

  GuardLimits limits_for_file(const double size)
  {
    return {10. + 5e-6 * size, 4e9 + 100. * size};
  }

  void run_guarded(const std::string &problem, const GuardLimits &limits, const std::function<void()> &work,
                   const std::function<void(PipeWriter &)> &send,
                   const std::function<void(PipeReader &)> &receive)
  {
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0)
      throw no_child(problem);
    const Descriptor reading{ends[0]};
    pid_t            id = -1;
    {
      const Descriptor writing{ends[1]};
      if ((id = fork()) == 0)
      {
        close(ends[0]);
        child(ends[1], limits, work, send);
      }
    }
    if (id < 0)
      throw no_child(problem);

    Child       reader(id);
    PipeReader  pipe(ends[0], 10. * limits.cpu_seconds);
    Outcome     outcome{};
    std::string message;
    try
    {
      pipe.get(outcome);
      if (outcome == Outcome::done)
        receive(pipe);
      else
        pipe.get(message);
    }
    catch (const PipeReader::End &)
    {
      throw InputError(problem + ": " + reason_of_death(reader.end(), limits));
    }
    switch (outcome)
    {
    case Outcome::done:
      return;
    case Outcome::bad_input:
      throw InputError(message);
    case Outcome::failed:
      throw ComputationError(message);
    case Outcome::no_memory:
    {
      std::ostringstream text;
      text << problem << ": a size in the file requires more than " << std::setprecision(2)
           << 1e-9 * limits.memory << " GB of memory. The file is damaged; write it again.";
      throw InputError(text.str());
    }
    case Outcome::exception:
      throw InputError(problem + ": " + message);
    }
    throw InputError(problem +
                     ": its reader (gmsh or HDF5) ended without a complete result. The file is probably "
                     "damaged: export it again. If another program can open it, report this error.");
  }
} // namespace Voussoir
