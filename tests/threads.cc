// SPDX-License-Identifier: GPL-3.0-or-later
// Exceptions inside of parallel regions reach the caller as they are.

#include "column.h"

#include <voussoir/base/error.h>
#include <voussoir/base/parallel.h>

#include <atomic>

using namespace Columns;

namespace
{
  /** What @p action throws. */
  template <class Error> std::string thrown(const std::function<void()> &action)
  {
    try
    {
      action();
    }
    catch (const Error &error)
    {
      return error.what();
    }
    return "nothing";
  }

  void loops()
  {
    std::atomic<int> done{0};
    const auto       message = thrown<InputError>(
        [&]
        {
          for_each_parallel(100,
                                  [&](const int i)
                                  {
                              if (i == 37)
                                throw InputError("no. 37");
                              ++done;
                            });
        });
    report("one of 100 throws: " + message, done, "99 done", message == "no. 37" && done == 99);
    done = 0;
    for_each_parallel(0, [&](int) { ++done; });
    report("none", done, "0", done == 0);
  }

  /** A law without solution, as a stranger's may be. */
  class Refusing : public JointLaw
  {
  public:
    void evaluate(const Vector3 &force, const Vector3 &, const PairHistory &, double,
                  PairEquations &e) const override
    {
      e = {};
      e.residual = force;
      e.residual[0] -= 1.;
      e.d_force = {{1., 0., 0., 0., 1., 0., 0., 0., 1.}};
    }
    Vector3 solve(const Matrix3 &, const Vector3 &, const PairHistory &) const override
    {
      throw ComputationError("this pair has no solution");
    }
    Vector3 solve_impulse(const Matrix3 &, const Vector3 &, const PairHistory &, unsigned char) const override
    {
      return {};
    }
  };

  void in_the_joint_solver()
  {
    const Column   column = make_column({bar(0., 1., 2, 1e9, 1e3), bar(1., 2., 2, 1e9, 1e3)},
                                        [](const double x) { return x == 0. || x == 2.; });
    const Refusing law;
    JointLaws      laws;
    for (const Pair &pair : column.structure.pairs)
      laws.add(&law, pair.area);
    const std::string message = thrown<ComputationError>(
        [&]
        {
          JointSystem    system(column.structure, laws, ContactParameters(), {});
          const Unknowns zero(3 * column.structure.pairs.size(), 0.), apart(zero.size(), 1e-3);
          Unknowns       force = zero, gap, u;
          system.solve(column.zero(), apart, zero, force, gap, u);
        });
    report("a law throws in a sweep: " + message, 0., "-", message == "this pair has no solution");
  }
} // namespace

int main()
{
  return run_all({[]
                  {
#ifdef _OPENMP
                    omp_set_num_threads(2);
#endif
                    loops();
                    in_the_joint_solver();
                  }});
}
