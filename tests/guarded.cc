// SPDX-License-Identifier: GPL-3.0-or-later
// Work in a child process: what it sends arrives; whatever happens to it becomes a message.

#include "testing.h"

#include <voussoir/base/guarded.h>

#include <csignal>
#include <numeric>
#include <unistd.h>

using namespace Voussoir;
using namespace Testing;

namespace
{
  const GuardLimits limits = {2., 1e9};

  void nothing_sent(PipeWriter &) {}
  void nothing_received(PipeReader &) {}

  void test_results()
  {
    std::vector<double> numbers, copy;
    std::string         text = "before", text_copy;
    int                 number = 0;
    run_guarded(
        "test", limits,
        [&]
        {
          numbers.resize(5000000); // 40 MB: many times what a pipe holds
          std::iota(numbers.begin(), numbers.end(), 1.);
          text = "in the child";
          std::printf("this must not be seen\n");
        },
        [&](PipeWriter &pipe)
        {
          pipe.put(numbers);
          pipe.put(text);
          pipe.put(17);
        },
        [&](PipeReader &pipe)
        {
          pipe.get(copy);
          pipe.get(text_copy);
          pipe.get(number);
        });
    report("entries of a vector", double(copy.size()), "= 5e6", copy.size() == 5000000);
    double wrong = copy.empty() ? 1. : 0.;
    for (std::size_t i = 0; i < copy.size(); ++i)
      wrong += copy[i] != double(i + 1);
    report("wrong entries", wrong, "= 0", wrong == 0.);
    report("a text and a number", number, "= 17", number == 17 && text_copy == "in the child");
    report("the program's own data are as before", double(numbers.size()), "= 0",
           numbers.empty() && text == "before");
  }

  template <typename Error>
  void thrown(const std::string &name, const std::function<void()> &work, const std::string &part,
              const GuardLimits &limits = ::limits)
  {
    throws<Error>(
        name, [&] { run_guarded("The file X cannot be read", limits, work, nothing_sent, nothing_received); },
        {part});
  }

  void test_deaths()
  {
    const std::string problem = "The file X cannot be read: ";
    for (const int number : {SIGSEGV, SIGABRT, SIGFPE, SIGBUS})
      thrown<InputError>(
          "signal " + std::to_string(number), [&] { raise(number); }, problem + "the library");
    thrown<InputError>(
        "the child ends the program", [] { std::exit(0); }, problem + "the library");
    thrown<InputError>(
        "the child ends at once", [] { _exit(3); }, problem + "the library");
    thrown<InputError>("the child does not end",
                       []
                       {
                         for (volatile unsigned int i = 0;; ++i)
                           ;
                       },
                       problem + "reading did not end", {1., 1e9});
    thrown<InputError>("the child waits", [] { pause(); }, problem + "reading did not end", {.1, 1e9});
    thrown<InputError>(
        "the child takes all memory", [] { std::vector<char>(std::size_t(1) << 40, 'x'); },
        problem + "a size in the file requires more than 1 GB");
    thrown<InputError>(
        "InputError", [] { throw InputError("bad words"); }, "bad words");
    thrown<ComputationError>(
        "ComputationError", [] { throw ComputationError("no luck"); }, "no luck");
    thrown<InputError>(
        "another exception", [] { throw std::logic_error("strange"); }, problem + "strange");
  }

  /** The child dies while it sends; or sends less than is asked for. */
  void test_broken_results()
  {
    for (const bool dies : {true, false})
    {
      std::vector<int> numbers;
      throws(dies ? "dies while it sends" : "sends too little",
             [&]
             {
               run_guarded(
                   "test", limits, [] {},
                   [&](PipeWriter &pipe)
                   {
                     pipe.put(std::size_t(1) << 60); // not to be believed
                     pipe.put(1);
                     if (dies)
                       raise(SIGSEGV);
                   },
                   [&](PipeReader &pipe) { pipe.get(numbers); });
             },
             {});
    }
  }
} // namespace

int main(int argc, char **argv)
{
  return run({{"results", test_results}, {"deaths", test_deaths}, {"broken results", test_broken_results}},
             argc, argv);
}
