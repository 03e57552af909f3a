// SPDX-License-Identifier: GPL-3.0-or-later
// The checks of testing.h: that what is wrong fails. This program prints FAILED where a check is made to
// fail.

#include "testing.h"

#include <limits>

using namespace Testing;

namespace
{
  const double not_a_number = std::numeric_limits<double>::quiet_NaN();

  /** Does a test with this in it fail? Leaves the counts as they were, but for one check. */
  bool fails(const std::function<void()> &action)
  {
    const Count before = count();
    run_test({"made to fail or not", action});
    const bool failed = count().failures > before.failures;
    count() = before;
    return failed;
  }

  void values()
  {
    expect(!fails([] { below("below", -1., 1.1); }) && fails([] { below("below", -1., 1.); }) &&
               fails([] { below("below", not_a_number, 1.); }),
           "below");
    expect(!fails([] { above("above", 2., 1.); }) && fails([] { above("above", 1., 1.); }) &&
               fails([] { above("above", not_a_number, 1.); }),
           "above");
    expect(!fails([] { between("between", 1., 1., 2.); }) && fails([] { between("between", 2.1, 1., 2.); }) &&
               fails([] { between("between", not_a_number, 1., 2.); }),
           "between");
    expect(!fails([] { missed("missed", 2., 1.); }), "missed");
  }

  void conditions()
  {
    expect(!fails([] { expect(true, "true"); }) && fails([] { expect(false, "false"); }), "expect");
    expect(!fails([] { expect_close(-102., -100., .021, "close"); }) &&
               fails([] { expect_close(-102., -100., .019, "close"); }) &&
               fails([] { expect_close(not_a_number, 1., 1., "close"); }),
           "expect_close");
    expect(!fails([] { expect_within(1.5, 1., .5, "within"); }) &&
               fails([] { expect_within(1.5, 1., .49, "within"); }) &&
               fails([] { expect_within(not_a_number, 1., 1., "within"); }),
           "expect_within");
  }

  void errors()
  {
    const auto input_error = [] { throw Voussoir::InputError("the entry A is wrong"); };
    const auto other = [] { throw std::logic_error("the entry A is wrong"); };
    expect(!fails(
               [&] {
                 expect_error(input_error, {"entry A", "wrong"});
               }) &&
               !fails(
                   [&] {
                     throws("words", input_error, {"entry A", "wrong"});
                   }),
           "the right error");
    expect(fails(
               [&] {
                 expect_error(input_error, {"entry A", "right"});
               }) &&
               fails(
                   [&] {
                     throws("words", input_error, {"entry A", "right"});
                   }),
           "a word that is missing");
    expect(fails([&] { expect_error(other, {"entry A"}); }) && fails([&] { throws("words", other, {}); }),
           "another exception");
    expect(fails([] { expect_error([] {}, {"entry A"}); }) && fails([] { throws("words", [] {}, {}); }),
           "no exception");
  }

  void runs()
  {
    expect(fails([] {}), "a test without a check");
    const Count  before = count();
    unsigned int first = 0, second = 0;
    const auto   bad = [&] { ++first, expect(false, "made to fail"); };
    const auto   good = [&] { ++second, expect(true, ""); };
    const int    all = run({{"first", bad}, {"second", good}});
    count() = before;
    expect(all == 1 && first == 1 && second == 1, "a failure does not end the others");
    expect(run({{"first", bad}, {"second", good}}, {"second"}) == 0 && first == 1 && second == 2, "by name");
    expect(run({{"first", bad}}, {"third"}) == 2 && first == 1, "an unknown name");
  }
} // namespace

int main(int argc, char **argv)
{
  return run({{"values", values}, {"conditions", conditions}, {"errors", errors}, {"runs", runs}}, argc,
             argv);
}
