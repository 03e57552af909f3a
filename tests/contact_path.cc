// SPDX-License-Identifier: GPL-3.0-or-later
// Costs and results of contact problems (ContactResult): of the solver alone, of a joint system, and of reduced
// time steps.

#include "blocks.h"
#include "sparse_contact.h"

#include <voussoir/base/error.h>
#include <voussoir/contact/law_table.h>

#include <cstring>

using namespace Columns;

namespace
{
  /** FJA that has no solution when a pair slips more than @p limit in one step [m]. */
  class Limited : public JointLaw
  {
  public:
    explicit Limited(const double limit) : limit(limit), law(make_joint_law("FJA", LawParameters(.5))) {}

    void evaluate(const Vector3 &force, const Vector3 &gap, const PairHistory &past, const double rho,
                  PairEquations &e) const override
    {
      law->evaluate(force, gap, past, rho, e);
      if (length(gap[1] - past.start[1], gap[2] - past.start[2]) > limit)
      {
        e.residual[0] += rho * limit;
        e.state = PairState::slip;
      }
    }
    Vector3 solve(const Matrix3 &H, const Vector3 &b, const PairHistory &past) const override
    {
      return law->solve(H, b, past);
    }
    Vector3 solve_impulse(const Matrix3 &H, const Vector3 &v, const PairHistory &past,
                          const unsigned char active) const override
    {
      return law->solve_impulse(H, v, past, active);
    }

  private:
    const double                    limit;
    const std::unique_ptr<JointLaw> law;
  };

  void is(const std::string &what, const ContactPath path, const ContactPath expected)
  {
    report(what + ": " + name(path), static_cast<int>(path), name(expected), path == expected);
  }

  void test_names()
  {
    const char *names[] = {"newton", "sweeps", "proximal", "smaller_step"};
    for (unsigned int i = 0; i < 4; ++i)
      report(std::string("name of a path: ") + names[i], i, "",
             std::strcmp(name(static_cast<ContactPath>(i)), names[i]) == 0);
  }

  void test_sum()
  {
    ContactResult a, b;
    a.converged = b.converged = true;
    a.residual = 1e-12, b.residual = 2e-12;
    a.iterations = 3, b.iterations = 4;
    a.path = ContactPath::proximal, b.path = ContactPath::sweeps;
    a += b;
    report("two solutions: converged, the worse residual, all steps", a.residual, "2e-12, 7",
           a.converged && a.residual == 2e-12 && a.iterations == 7);
    is("two solutions", a.path, ContactPath::proximal);
    b.converged = false;
    b.residual = 1e-13;
    a += b;
    report("one of them not converged: its residual", a.residual, "1e-13",
           !a.converged && a.residual == 1e-13);
  }

  /** Strongly coupled contacts: the number of Gauss-Seidel iterations shows which stages the solver used. */
  void test_solver()
  {
    const auto         law = make_joint_law("FJA", 3.);
    const unsigned int n = 4;
    ContactParameters  parameters;
    parameters.tolerance = 1e-12;
    unsigned int count[4] = {0, 0, 0, 0}, wrong = 0;
    for (unsigned int trial = 0; trial < 2000; ++trial)
    {
      Unknowns L(9 * n * n), b(3 * n), force(3 * n, 0.), gap;
      for (double &x : L)
        x = random_number();
      for (unsigned int i = 0; i < 3 * n; ++i)
        b[i] = random_number() - (i % 3 == 0 ? .5 : 0.);
      std::vector<std::vector<unsigned int>> columns(n, {0, 1, 2, 3});
      BlockSparseMatrix                      W(columns);
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = 0; j < n; ++j)
        {
          Matrix3 a{};
          for (unsigned int c = 0; c < 9; ++c)
          {
            for (unsigned int k = 0; k < 3 * n; ++k)
              a[c] += L[(3 * i + c / 3) * 3 * n + k] * L[(3 * j + c % 3) * 3 * n + k];
            a[c] += i == j && c % 4 == 0 ? .01 : 0.;
          }
          W.add(i, j, a);
        }
      const SparseContactOperator op(W);
      ContactSolver               solver(op, std::vector<const JointLaw *>(n, law.get()), parameters);
      const ContactResult         result = solver.solve(b, Unknowns(3 * n, 0.), force, gap);
      ++count[static_cast<int>(result.path)];
      const unsigned int at_least[] = {0, parameters.sweeps + 20, parameters.sweeps + 20};
      wrong +=
          !result.converged ||
          (result.path == ContactPath::newton ? result.sweeps > parameters.sweeps
                                              : result.sweeps < at_least[static_cast<int>(result.path)]) ||
          (result.path == ContactPath::sweeps && result.sweeps > parameters.sweeps + 20);
      // From the solution there is nothing to do.
      const ContactResult again = solver.solve(b, Unknowns(3 * n, 0.), force, gap);
      wrong += again.path != ContactPath::newton || again.iterations > 0;
    }
    report("strong coupling: another path than the sweeps say, of 2000", wrong, "0", wrong == 0);
    above("  by Newton's method alone", count[0], 0.);
    above("  with sweeps", count[1], 0.);
    note("  by the proximal point method", count[2]);
    report("  with a smaller step", count[3], "0", count[3] == 0);
  }

  /** The static solution, by each method. */
  void test_statics()
  {
    const SolidModel  model(blocks(2, false), 1);
    const Structure   structure = with_joints(model, {Material()});
    const std::size_t n = structure.pairs.size();
    const JointLaws   laws = make_laws(structure, "FJA", .5);
    for (const auto &method : {std::make_pair("newton", ContactPath::newton),
                               {"sweeps", ContactPath::sweeps},
                               {"proximal", ContactPath::proximal}})
    {
      ContactParameters parameters;
      parameters.method = method.first;
      JointSystem system(structure, laws, parameters, {});
      Unknowns    load(3 * structure.n_nodes()), none(3 * n, 0.), force(none), gap, u;
      for (double &f : load)
        f = 1e7 * random_number();
      const ContactResult result = system.solve(load, none, none, force, gap, u);
      report("statics, method " + std::string(method.first) + ": residual", result.residual, "converged",
             result.converged);
      is("  path", result.path, method.second);
    }
  }

  /** A block at a wall, whose slip in one step is limited. */
  struct BlockAtWall
  {
    static constexpr double dt = 1e-3, speed = 1.;

    /** @p part: of the slip of the first step, speed dt, that is allowed; @p push: against the wall [N]. */
    BlockAtWall(const double part, const double opening, const double push, Support *support = nullptr,
                const double mass_damping = 0.)
        : column(make_column({bar(0., 1., 2, 1e9, 2400.)}, nullptr, true)), law(part * speed * dt)
    {
      column.structure.pairs.push_back(wall(column.node[0][0]));
      column.structure.collect_interfaces();
      column.structure.damping.mass = mass_damping;
      laws.add(&law, 1.);
      ContactParameters parameters;
      parameters.max_iterations = 30;
      newmark =
          std::make_unique<Newmark>(column.structure, laws, parameters, dt, ImpactRule::mean_force, support);
      Unknowns u = column.zero(), v = column.zero();
      load = column.zero();
      column.set(u, 0, {{opening, 0., 0.}});
      column.set(v, 0, {{0., speed, 0.}});
      column.set(load, 0, {{-push, 0., 0.}});
      newmark->start(u, v, {push, -.5 * push, 0.}, load, {0., 0., 0.});
    }

    Column                   column;
    const Limited            law;
    JointLaws                laws;
    std::unique_ptr<Newmark> newmark;
    Unknowns                 load;
  };

  /** The block flies along the wall: a step in which it would slip too far is halved, and again. */
  void test_smaller_steps()
  {
    for (const auto &part : {std::make_pair(1.5, 0u), {.75, 1u}, {.3, 2u}, {.15, 3u}})
    {
      BlockAtWall         block(part.first, 1e-2, 0.);
      const ContactResult result = block.newmark->advance(block.load);
      const std::string   what = "at most " + text(part.first) + " of the slip of a step";
      report(what + ": residual", result.residual, "converged", result.converged);
      is("  path", result.path, part.second == 0 ? ContactPath::newton : ContactPath::smaller_step);
      report("  steps that failed are counted", result.iterations, "",
             (result.iterations > 0) == (part.second > 0));
      below("  slip - speed dt [m]", block.newmark->opening_and_slip(0)[1] - block.speed * block.dt, 1e-15);
      report("  state of the pair", static_cast<int>(block.newmark->pair_states()[0]), "open",
             block.newmark->pair_states()[0] == PairState::open);
      const double whole = block.newmark->joint_system().memory_consumption(), all = block.newmark->memory();
      report("  factors and operators, over those of whole steps", all / whole, "1 for each size of step",
             whole > 0. && all == (1. + part.second) * whole);
    }
    std::string message;
    try
    {
      BlockAtWall block(.1, 1e-2, 0.);
      block.newmark->advance(block.load);
    }
    catch (const ComputationError &error)
    {
      message = error.what();
    }
    report("at most 0.1 of the slip of a step: not with dt/8 either", 0., "refused",
           message.find("did not converge") != std::string::npos &&
               message.find(
                   "(step 1), with the time step 0.001 s reduced to 0.000125 s. The largest error is in "
                   "joint 1 at (0, 0, 0) m.") != std::string::npos);
  }

  /** A load that grows from 0 pulls the block along the wall. The load is linear between the ends of a reduced
   * time step. Its impulse is exact, A dt/2 per mass. The path is that of the trapezoidal rule for
   * a(t) = A t/dt. */
  void test_load()
  {
    constexpr double A = 100.;
    for (const auto &part : {std::make_pair(1.5, 1u), {.75, 2u}, {.3, 4u}, {.15, 8u}})
    {
      BlockAtWall      block(part.first, 1e-2, 0.);
      Unknowns         load = block.load;
      const Structure &structure = block.column.structure;
      for (unsigned int i = 0; i < structure.n_nodes(); ++i)
        load[3 * i + 1] = A * structure.mass[i][4];
      const ContactResult result = block.newmark->advance(load);
      const unsigned int  n = part.second;
      const std::string   what = "load over a step in " + text(n) + " parts";
      is(what, result.path, n == 1 ? ContactPath::newton : ContactPath::smaller_step);
      double u = 0., v = block.speed;
      for (unsigned int k = 0; k < n; ++k)
      {
        const double h = block.dt / n, v_new = v + h * A * (k + .5) / n;
        u += h * (v + v_new) / 2.;
        v = v_new;
      }
      below("  velocity - exact [m/s]", block.newmark->state().v[1] - (block.speed + .5 * A * block.dt),
            1e-12);
      below("  slip - exact [m]", block.newmark->opening_and_slip(0)[1] - u, 1e-15);
      below("  work of the load - change of energy, relative", block.newmark->energy_error(), 1e-12);
    }
  }

  /** A compliant support that makes five steps in each step of the block. */
  class Soft : public Support
  {
  public:
    std::vector<unsigned int> pushes; ///< its steps, push by push

    const std::vector<unsigned int> &base_nodes() const override { return node; }
    unsigned int                     n_substeps() const override { return 5; }
    BlockSparseMatrix                compliance(unsigned int) const override
    {
      BlockSparseMatrix R(std::vector<std::vector<unsigned int>>{{0}});
      R.add(0, 0, {1e9, 0., 0., 0., 1e9, 0., 0., 0., 1e9});
      return R;
    }
    Unknowns predict(unsigned int, double, const Unknowns &) override { return {0., 0., 0.}; }
    void     advance(const unsigned int n, const Unknowns &, const Unknowns &, double) override
    {
      pushes.push_back(n);
    }

  private:
    const std::vector<unsigned int> node = {0};
  };

  /** Five steps of a support cannot be halved: parts of two and of three, or smaller ones. Load and velocity
   * of the base are linear in time through all of them. */
  void test_uneven_halves()
  {
    constexpr double A = 100., B = .1,
                     c = 200.; // growth of a and of the base's velocity in the step; damping
    for (const auto &[part, expected] :
         {std::pair<double, std::vector<unsigned int>>{1.5, {5}}, {.75, {2, 3}}, {.5, {2, 1, 2}}})
    {
      Soft        soft;
      BlockAtWall block(part, 1e-2, 0., &soft, c);
      Unknowns    load = block.load;
      for (unsigned int i = 0; i < block.column.structure.n_nodes(); ++i)
        load[3 * i + 1] = A * block.column.structure.mass[i][4];
      block.newmark->advance(load, {{0., B, 0.}});
      const std::string what = text(expected.size()) + " parts of five steps";
      report(what, soft.pushes.size(), "", soft.pushes == expected);
      double u = 0., v = block.speed, t = 0.;
      for (const unsigned int n : expected)
      {
        const double h = n * block.dt / 5., middle = (t + .5 * h) / block.dt, // of the means
            v_new = (v * (1. - .5 * c * h) + h * (A * middle + c * B * middle)) / (1. + .5 * c * h);
        u += .5 * h * (v + v_new);
        v = v_new;
        t += h;
      }
      below("  velocity - exact [m/s]", block.newmark->state().v[1] - v, 1e-12);
      below("  slip - exact [m]", block.newmark->opening_and_slip(0)[1] - u, 1e-15);
      below("  work of the load - change of energy, relative", block.newmark->energy_error(), 1e-12);
    }
  }

  /** The block slides on the wall. States and impulses of a divided time step are those of both reduced steps. */
  void test_impulse()
  {
    const double push = 1e4;
    for (const bool halved : {false, true})
    {
      BlockAtWall block(halved ? .75 : 1.5, 0., push);
      is(halved ? "sliding, in halves" : "sliding", block.newmark->advance(block.load).path,
         halved ? ContactPath::smaller_step : ContactPath::newton);
      report("  state of the pair", static_cast<int>(block.newmark->pair_states()[0]), "slip",
             block.newmark->pair_states()[0] == PairState::slip);
      below("  impulse - push dt, relative", block.newmark->impulses()[0] / (push * block.dt) - 1., 1e-9);

      // The load rises in the step: what the wall gives is the integral of the load over time.
      BlockAtWall rising(halved ? .75 : 1.5, 0., push);
      Unknowns    load = rising.load;
      for (double &f : load)
        f *= 3.;
      is("  under a rising load", rising.newmark->advance(load).path,
         halved ? ContactPath::smaller_step : ContactPath::newton);
      below("  impulse - 2 push dt, relative", rising.newmark->impulses()[0] / (2. * push * rising.dt) - 1.,
            1e-9);
    }
  }
} // namespace

int main()
{
  return run_all({test_names, test_sum, test_solver, test_statics, test_smaller_steps, test_load,
                  test_uneven_halves, test_impulse});
}
