// SPDX-License-Identifier: GPL-3.0-or-later
// Many runs of the program with one start: most of a short run is the dynamic linker's. This library is loaded with LD_PRELOAD, and takes
// the place of the program's main(), which each run then calls in a child process.
//
// Each line of stdin is one run, words divided by tabs: directory, files of its stdout and stderr, seconds, then the command line.
// Answer: "exit N" or "signal N" (14 and 27: time is over).

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <dlfcn.h>
#include <fcntl.h>
#include <iostream>
#include <sstream>
#include <string>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

namespace
{
  using Main = int (*)(int, char **, char **);
  Main main_of_program;

  void redirect(const char *name, const int flags, const int descriptor)
  {
    const int file = open(name, flags, 0644);
    if (file < 0 || dup2(file, descriptor) < 0)
      std::abort();
    close(file);
  }

  [[noreturn]] void run(std::vector<std::string> words, char *program)
  {
    if (words.size() < 4 || chdir(words[0].c_str()) != 0)
      std::abort();
    redirect("/dev/null", O_RDONLY, STDIN_FILENO);
    redirect(words[1].c_str(), O_WRONLY | O_CREAT | O_TRUNC, STDOUT_FILENO);
    redirect(words[2].c_str(), O_WRONLY | O_CREAT | O_TRUNC, STDERR_FILENO);
    const int       seconds = std::atoi(words[3].c_str());
    const itimerval limit = {{0, 0}, {seconds, 0}};
    setitimer(ITIMER_PROF, &limit, nullptr);
    alarm(6u * static_cast<unsigned int>(seconds)); // on a busy machine, or one that waits for something
    std::vector<char *> arguments = {program};
    for (std::size_t i = 4; i < words.size(); ++i)
      arguments.push_back(words[i].data());
    arguments.push_back(nullptr);
    const int status = main_of_program(static_cast<int>(arguments.size()) - 1, arguments.data(), environ);
    std::cout.flush();
    std::fflush(nullptr);
    _exit(status); // the destructors of 200 libraries take 0.1 s
  }

  int serve(int, char **argv, char **)
  {
    unsetenv("LD_PRELOAD"); // programs that the program starts are themselves
    for (std::string line; std::getline(std::cin, line);)
    {
      std::vector<std::string> words;
      std::istringstream       in(line);
      for (std::string word; std::getline(in, word, '\t');)
        words.push_back(word);
      const pid_t child = fork();
      if (child == 0)
        run(words, argv[0]);
      int status = 0;
      while (waitpid(child, &status, 0) < 0 && errno == EINTR)
        ;
      std::cout << (WIFEXITED(status) ? "exit " : "signal ")
                << (WIFEXITED(status) ? WEXITSTATUS(status) : WTERMSIG(status)) << std::endl;
    }
    return 0;
  }
} // namespace

extern "C" int __libc_start_main(Main main, int argc, char **argv, void (*init)(), void (*fini)(),
                                 void (*rtld_fini)(), void *stack_end)
{
  const auto start = reinterpret_cast<decltype(&__libc_start_main)>(dlsym(RTLD_NEXT, "__libc_start_main"));
  main_of_program = main;
  return start(serve, argc, argv, init, fini, rtld_fini, stack_end);
}
