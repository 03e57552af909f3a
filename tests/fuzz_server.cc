// SPDX-License-Identifier: GPL-3.0-or-later
// Many short runs of the program without its start-up, for fuzz.py: most of a start is the dynamic linker's.
//
// Each line of stdin is one run, words divided by tabs: directory, seconds, then the command line. The run is
// a child process, with files "out" and "err" in its directory. Answer: "exit N" or "signal N" (14: time is
// over).

#include <voussoir/app/program.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <fcntl.h>
#include <iostream>
#include <sstream>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

namespace
{
  void redirect(const char *name, const int descriptor)
  {
    const int file = open(name, O_WRONLY | O_CREAT | O_TRUNC, 0644);
    if (file < 0 || dup2(file, descriptor) < 0)
      std::abort();
    close(file);
  }

  [[noreturn]] void run(const std::vector<std::string> &words)
  {
    if (words.size() < 2 || chdir(words[0].c_str()) != 0)
      std::abort();
    const int nothing = open("/dev/null", O_RDONLY);
    dup2(nothing, STDIN_FILENO);
    redirect("out", STDOUT_FILENO);
    redirect("err", STDERR_FILENO);
    const int       seconds = std::atoi(words[1].c_str());
    const itimerval limit = {{0, 0}, {seconds, 0}};
    setitimer(ITIMER_PROF, &limit, nullptr);
    alarm(6u * static_cast<unsigned int>(seconds)); // on a busy machine, or one that waits for something
    std::exit(Voussoir::run_program({words.begin() + 2, words.end()}));
  }
} // namespace

int main()
{
  for (std::string line; std::getline(std::cin, line);)
  {
    std::vector<std::string> words;
    std::istringstream       in(line);
    for (std::string word; std::getline(in, word, '\t');)
      words.push_back(word);
    const pid_t child = fork();
    if (child == 0)
      run(words);
    int status = 0;
    while (waitpid(child, &status, 0) < 0 && errno == EINTR)
      ;
    std::cout << (WIFEXITED(status) ? "exit " : "signal ")
              << (WIFEXITED(status) ? WEXITSTATUS(status) : WTERMSIG(status)) << std::endl;
  }
}
