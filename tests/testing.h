// SPDX-License-Identifier: GPL-3.0-or-later
// The checks of all C++ tests. Checks of a value (below, above, between, throws) print the value and continue.
// Checks of a condition (expect...) end their test. A value that is not a number fails each check.

#ifndef voussoir_tests_testing_h
#define voussoir_tests_testing_h

#include <voussoir/base/error.h>

#include <cmath>
#include <cstdio>
#include <exception>
#include <fstream>
#include <functional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace Testing
{
  constexpr double pi = 3.14159265358979323846;

  /** Numbers of checks, failures and skipped tests so far. */
  struct Count
  {
    unsigned int checks = 0, failures = 0, skipped = 0; ///< skipped: tests of parts that are not built
  };

  inline Count &count()
  {
    static Count all;
    return all;
  }

  inline std::string text(const double x)
  {
    char s[32];
    std::snprintf(s, sizeof(s), "%.6g", x);
    return s;
  }

  // Checks that print a value

  inline void report(const std::string &what, const double value, const std::string &limit, const bool good)
  {
    std::printf("%-66s %12.4e  %-22s %s\n", what.c_str(), value, limit.c_str(), good ? "OK" : "FAILED");
    std::fflush(stdout);
    ++count().checks;
    count().failures += !good;
  }

  /** |value| < limit. */
  inline void below(const std::string &what, const double value, const double limit)
  {
    report(what, value, "< " + text(limit), std::abs(value) < limit);
  }

  inline void above(const std::string &what, const double value, const double limit)
  {
    report(what, value, "> " + text(limit), value > limit);
  }

  inline void between(const std::string &what, const double value, const double low, const double high)
  {
    report(what, value, "[" + text(low) + ", " + text(high) + "]", value >= low && value <= high);
  }

  /** Prints a value that is known to miss its limit, and the limit. The test continues. */
  inline void missed(const std::string &what, const double value, const double limit)
  {
    report(what, value, "< " + text(limit) + (std::abs(value) < limit ? "" : " MISSED (known)"), true);
  }

  /** A value without limit. */
  inline void note(const std::string &what, const double value)
  {
    report(what, value, "-", true);
  }

  // Checks that end the test

  inline void expect(const bool condition, const std::string &what)
  {
    ++count().checks;
    if (!condition)
      throw std::runtime_error(what);
  }

  /** |value - expected| <= tolerance. */
  inline void expect_within(const double value, const double expected, const double tolerance,
                            const std::string &what)
  {
    std::ostringstream message;
    message << what << " is " << value << ", expected " << expected << " +- " << tolerance;
    expect(std::abs(value - expected) <= tolerance, message.str());
  }

  /** |value - expected| <= relative |expected|. */
  inline void expect_close(const double value, const double expected, const double relative,
                           const std::string &what)
  {
    expect_within(value, expected, relative * std::abs(expected), what);
  }

  /** Returns an empty string if @p action throws an Error whose text contains all of @p words, otherwise the
   * reason of the failure. @p message receives the text of the Error. */
  template <class Error>
  std::string wrong_error(const std::function<void()> &action, const std::vector<std::string> &words,
                          std::string &message)
  {
    try
    {
      action();
    }
    catch (const Error &error)
    {
      message = error.what();
      for (const std::string &part : words)
        if (message.find(part) == std::string::npos)
          return "the message lacks '" + part + "': " + message;
      return message.empty() ? "the message is empty" : "";
    }
    catch (const std::exception &error)
    {
      return std::string("another exception: ") + error.what();
    }
    return "no error" + (words.empty() ? "" : "; expected one with '" + words[0] + "'");
  }

  /** @p action must throw an Error whose text holds all of @p words. */
  template <class Error = Voussoir::InputError>
  void expect_error(const std::function<void()> &action, const std::vector<std::string> &words)
  {
    std::string       message;
    const std::string wrong = wrong_error<Error>(action, words, message);
    expect(wrong.empty(), wrong);
  }

  /** The same; prints the message and continues. */
  template <class Error = Voussoir::InputError>
  void throws(const std::string &what, const std::function<void()> &action,
              const std::vector<std::string> &words)
  {
    std::string       message;
    const std::string wrong = wrong_error<Error>(action, words, message);
    report(what, 0., words.empty() ? "throws" : "\"" + words[0] + "\"", wrong.empty());
    std::printf("    %s\n", wrong.empty() ? message.c_str() : wrong.c_str());
  }

  inline void write_text(const std::string &file, const std::string &text)
  {
    std::ofstream(file, std::ios::binary) << text;
  }

  using Test = std::pair<std::string, std::function<void()>>;

  /** Runs the test. Prints its name and what failed; a test that checks nothing fails, too. A test of an
   * optional part that the library was built without is skipped. */
  inline void run_test(const Test &test)
  {
    const Count before = count();
    const auto  name = [&] { return test.first.empty() ? "" : test.first + ": "; };
    try
    {
      test.second();
      if (count().checks == before.checks)
        throw std::runtime_error("it checked nothing");
      if (!test.first.empty())
        std::printf("%s%s (%u checks)\n", name().c_str(),
                    count().failures == before.failures ? "OK" : "FAILED", count().checks - before.checks);
    }
    catch (const std::exception &error)
    {
      const bool is_missing = std::string(error.what()).find("was built without") != std::string::npos;
      std::printf("%s%s: %s\n", name().c_str(), is_missing ? "SKIPPED" : "FAILED", error.what());
      is_missing ? ++count().skipped : ++count().failures;
    }
    std::fflush(stdout);
  }

  /** Runs the tests, or those that @p names chooses; main's status: 0 all is well, 1 a check failed, 2 there
   * is no such test. */
  inline int run(const std::vector<Test> &tests, const std::vector<std::string> &names = {})
  {
    for (const std::string &name : names)
    {
      bool known = false;
      for (const Test &test : tests)
        known = known || test.first == name;
      if (!known)
      {
        std::fprintf(stderr, "There is no test \"%s\".\n", name.c_str());
        return 2;
      }
    }
    for (const Test &test : tests)
    {
      bool chosen = names.empty();
      for (const std::string &name : names)
        chosen = chosen || test.first == name;
      if (chosen)
        run_test(test);
    }
    std::printf("%u checks, %u failed\n", count().checks, count().failures);
    return count().failures > 0 ? 1 : count().skipped > 0 ? 77 : 0;
  }

  inline int run(const std::vector<Test> &tests, const int argc, char **argv)
  {
    return run(tests, std::vector<std::string>(argv + 1, argv + argc));
  }
} // namespace Testing

#endif
