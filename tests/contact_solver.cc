// SPDX-License-Identifier: GPL-3.0-or-later
// The contact solver on problems made to be hard: size, rank, coupling, friction, units, noise, what is not a
// number, no time; and the dense joint problem against the equations of all nodes.

#include "blocks.h"
#include "natural_map.h"
#include "problem_file.h"
#include "solve_problem.h"
#include "sparse_contact.h"

#include <voussoir/contact/law_table.h>

#include <ctime>
#include <filesystem>

extern "C" void dgesv_(const int *, const int *, double *, const int *, int *, double *, const int *, int *);

using namespace Columns;

namespace
{
  double seconds()
  {
    return double(std::clock()) / CLOCKS_PER_SEC; // as the solver's limit
  }

  /** A problem by its dense matrix, contact after contact. */
  struct Problem
  {
    unsigned int              n = 0; ///< contacts
    std::vector<double>       W;     ///< 3n x 3n
    Unknowns                  b;
    std::vector<double>       mu;
    std::vector<unsigned int> groups; ///< contacts in each joint; empty: no structure

    double &operator()(const unsigned int i, const unsigned int j) { return W[std::size_t(i) * 3 * n + j]; }
    double  operator()(const unsigned int i, const unsigned int j) const
    {
      return W[std::size_t(i) * 3 * n + j];
    }
  };

  Problem make_problem(const unsigned int n, const double mu)
  {
    Problem p;
    p.n = n;
    p.W.assign(9 * std::size_t(n) * n, 0.);
    p.b.assign(3 * n, 0.);
    p.mu.assign(n, mu);
    return p;
  }

  /** p.W += L S L^T, where row k of L is that of unknown first + k. */
  void add_body(Problem &p, const unsigned int first, const std::vector<std::array<double, 6>> &L,
                const double factor)
  {
    for (std::size_t i = 0; i < L.size(); ++i)
      for (std::size_t j = 0; j < L.size(); ++j)
        for (unsigned int k = 0; k < 6; ++k)
          p(first + i, first + j) += factor * L[i][k] * L[j][k];
  }

  /** Rigid motions of a point in the frame n = x, a = y, b = z. */
  std::array<std::array<double, 6>, 3> rigid_motion(const Vector3 &x)
  {
    return {
        {{{1., 0., 0., 0., x[2], -x[1]}}, {{0., 1., 0., -x[2], 0., x[0]}}, {{0., 0., 1., x[1], -x[0], 0.}}}};
  }

  /** Blocks in a row with joints of m contacts between them and at both ends: rigid motions of the blocks and
   *  a compliance at each contact that reaches its neighbours; compressed, twisted and sheared by b. */
  Problem chain(const unsigned int joints, const unsigned int m, const double mu, const double compliance,
                const double load)
  {
    Problem p = make_problem(joints * m, mu);
    p.groups.assign(joints, m);
    const unsigned int   across = std::max(1u, static_cast<unsigned int>(std::sqrt(m + .5)));
    std::vector<Vector3> place(m);
    for (unsigned int i = 0; i < m; ++i)
      place[i] = {{0., i % across - .5 * across, i / across - .5 * m / across}};
    const double r = std::max(1., 1. * m / across);
    for (unsigned int body = 0; body + 1 < joints; ++body) // between joint body and body + 1
    {
      std::vector<std::array<double, 6>> L;
      for (unsigned int side = 0; side < 2; ++side)
        for (const Vector3 &x : place)
          for (auto row : rigid_motion({{(side == 0 ? -.5 : .5) * r, x[1], x[2]}}))
          {
            for (unsigned int k = 0; k < 6; ++k)
              row[k] *= (side == 0 ? 1. : -1.) / (k < 3 ? 1. : r);
            L.push_back(row);
          }
      add_body(p, 3 * body * m, L, 1.);
    }
    for (unsigned int j = 0; j < joints && compliance > 0.; ++j)
      for (unsigned int i = 0; i < m; ++i)
        for (unsigned int k = 0; k < m; ++k)
        {
          const double d = std::hypot(place[i][1] - place[k][1], place[i][2] - place[k][2]),
                       c = compliance * std::exp(-2. * d);
          for (unsigned int l = 0; l < 3; ++l)
            p(3 * (j * m + i) + l, 3 * (j * m + k) + l) += c * (l == 0 ? 1. : 1.3);
        }
    for (unsigned int j = 0; j < joints; ++j)
      for (unsigned int i = 0; i < m; ++i)
      {
        p.b[3 * (j * m + i)] = load * (-.3 + .5 * random_number() + .3 * place[i][1] / r);
        p.b[3 * (j * m + i) + 1] = load * .4 * random_number();
        p.b[3 * (j * m + i) + 2] = load * (.2 + .3 * random_number());
      }
    return p;
  }

  BlockSparseMatrix sparse(const Problem &p)
  {
    std::vector<std::vector<unsigned int>> columns(p.n);
    const auto                             block = [&](const unsigned int i, const unsigned int j)
    {
      Matrix3 a;
      for (unsigned int r = 0; r < 9; ++r)
        a[r] = p(3 * i + r / 3, 3 * j + r % 3);
      return a;
    };
    for (unsigned int i = 0; i < p.n; ++i)
      for (unsigned int j = 0; j < p.n; ++j)
        if (i == j || block(i, j) != Matrix3{})
          columns[i].push_back(j);
    BlockSparseMatrix W(columns);
    for (unsigned int i = 0; i < p.n; ++i)
      for (const unsigned int j : columns[i])
        W.add(i, j, block(i, j));
    return W;
  }

  InterfaceOperator dense(const Problem &p)
  {
    InterfaceOperator W(p.groups);
    for (unsigned int j = 0; j < W.n_groups(); ++j)
      for (unsigned int k = j; k < W.n_groups(); ++k)
      {
        bool any = j == k;
        for (unsigned int r = 0; r < W.size(j) && !any; ++r)
          for (unsigned int c = 0; c < W.size(k) && !any; ++c)
            any = p(W.begin(j) + r, W.begin(k) + c) != 0.;
        if (any)
          for (unsigned int r = 0; r < W.size(j); ++r)
            for (unsigned int c = 0; c < W.size(k); ++c)
              W.block(j, k)[std::size_t(c) * W.size(j) + r] = p(W.begin(j) + r, W.begin(k) + c);
      }
    W.finish();
    return W;
  }

  struct Solution
  {
    ContactResult          result;
    Unknowns               force, gap;
    std::vector<PairState> states;
    double                 seconds = 0.;
  };

  ContactParameters with(const std::string &method, const double tolerance = 1e-12)
  {
    ContactParameters parameters;
    parameters.method = method;
    parameters.tolerance = tolerance;
    parameters.max_seconds = 20.;
    return parameters;
  }

  /** @p kind: "sparse" or "dense" (joint by joint). */
  Solution solve(const Problem &p, const std::string &kind = "sparse",
                 const ContactParameters &parameters = with("newton"), const Unknowns &guess = {},
                 const std::string &equations = "alart-curnier")
  {
    std::map<double, std::unique_ptr<JointLaw>> laws;
    std::vector<const JointLaw *>               law;
    for (const double mu : p.mu)
    {
      if (laws.count(mu) == 0)
        laws[mu] = make_joint_law("FJA", LawParameters(mu, equations_from_name(equations)));
      law.push_back(laws[mu].get());
    }
    std::unique_ptr<ContactOperator> W;
    if (kind == "dense")
      W = std::make_unique<InterfaceOperator>(dense(p));
    else
      W = std::make_unique<SparseContactOperator>(sparse(p));
    ContactSolver solver(*W, law, parameters);
    Solution      s;
    s.force = guess.empty() ? Unknowns(3 * p.n, 0.) : guess;
    const double before = seconds();
    s.result = solver.solve(p.b, Unknowns(3 * p.n, 0.), s.force, s.gap);
    s.seconds = seconds() - before;
    s.states = solver.states();
    return s;
  }

  /** Siconos' full relative error on the problem scaled to mean diagonal 1, anew from W, b and the forces. */
  double natural_map(const Problem &p, const Unknowns &force)
  {
    const unsigned int m = 3 * p.n;
    double             omega = 0., sum = 0., q = 0., f = 0., v = 0.;
    for (unsigned int i = 0; i < m; ++i)
      omega += p(i, i) / m;
    for (unsigned int i = 0; i < p.n; ++i)
    {
      Vector3 u, r;
      for (unsigned int c = 0; c < 3; ++c)
      {
        u[c] = p.b[3 * i + c];
        for (unsigned int j = 0; j < m; ++j)
          u[c] += p(3 * i + c, j) * force[j];
        r[c] = omega * force[3 * i + c];
        q += p.b[3 * i + c] * p.b[3 * i + c];
      }
      f += dot(r, r);
      v += dot(u, u);
      const Vector3 e = natural_map_of_contact(r, u, p.mu[i]);
      sum += dot(e, e);
    }
    return std::sqrt(sum / std::max({q, f, v, 1e-300}));
  }

  double difference(const Unknowns &a, const Unknowns &b)
  {
    double worst = a.size() == b.size() ? 0. : 1.;
    for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
      worst = std::max(worst, std::abs(a[i] - b[i]));
    return worst / std::max({largest(a), largest(b), 1e-300});
  }

  void check(const std::string &what, const Problem &p, const Solution &s, const double tolerance = 1e-12)
  {
    char limit[64];
    std::snprintf(limit, sizeof(limit), "%u steps, %.2f s", s.result.iterations, s.seconds);
    report(what, s.result.residual, limit, s.result.converged && s.result.residual <= tolerance);
    // the round-off of the products differs
    below("  recomputed", natural_map(p, s.force), tolerance + 1e-14);
  }

  void test_sizes()
  {
    for (const auto &size : {std::array<unsigned int, 2>{1, 1}, {1, 2}, {2, 1}, {3, 4}, {5, 12}, {8, 49}})
      for (const double load : {1., 1e-9, 1e12})
      {
        const Problem     p = chain(size[0], size[1], .6, .2, load);
        const std::string what =
            text(size[0]) + " joints of " + text(size[1]) + " contacts, load " + text(load);
        const Solution a = solve(p), b = solve(p, "dense");
        check(what + ", sparse", p, a);
        check(what + ", joint by joint", p, b);
        below("  difference of the forces", difference(a.force, b.force), 1e-9);
      }
    const Problem  p = chain(10, 196, .8, .2, 1.);
    const Solution s = solve(p, "dense");
    check("1960 contacts, joint by joint", p, s);
    below("  seconds", s.seconds, 20.);
  }

  /** W_nt beyond critical friction: mu W_nt > W_nn. */
  void test_coupling()
  {
    for (const double mu : {.5, 1., 3.})
    {
      unsigned int failures = 0, wrong = 0, dishonest = 0;
      for (unsigned int trial = 0; trial < 200; ++trial)
      {
        const unsigned int n = 1 + trial % 4;
        Problem            p = make_problem(n, mu);
        for (unsigned int body = 0; body < 3; ++body)
        {
          std::vector<std::array<double, 6>> L(3 * n);
          for (auto &row : L)
            for (double &x : row)
              x = random_number();
          add_body(p, 0, L, 1.);
        }
        for (unsigned int i = 0; i < 3 * n; ++i)
        {
          p(i, i) += .01;
          p.b[i] = random_number() - (i % 3 == 0 ? .5 : 0.);
        }
        for (const std::string kind : {"newton", "proximal", "sweeps"})
        {
          const Solution s = solve(p, "sparse", with(kind));
          failures += !s.result.converged && kind != "sweeps";
          wrong += s.result.converged && natural_map(p, s.force) > 1.1e-12;
          dishonest +=
              std::abs(natural_map(p, s.force) - s.result.residual) > 1e-13 + .01 * s.result.residual;
        }
      }
      const std::string what = "strong coupling, mu " + text(mu) + ": ";
      report(what + "not solved of 400", failures, "0", failures == 0);
      report(what + "converged, but wrong", wrong, "0", wrong == 0);
      report(what + "another residual than reported", dishonest, "0", dishonest == 0);
    }
  }

  void test_friction()
  {
    Problem p = chain(4, 16, 0., .3, 1.);
    for (const double mu : {0., 1e-6, .2, 1., 3., 10., 100.})
    {
      p.mu.assign(p.n, mu);
      for (const std::string kind : {"sparse", "dense"})
        check("chain, friction " + text(mu) + ", " + kind, p, solve(p, kind));
    }
    for (unsigned int i = 0; i < p.n; ++i)
      p.mu[i] = i % 3 == 0 ? 0. : .4 * (i % 5);
    check("chain, mixed friction, sparse", p, solve(p));
    check("chain, mixed friction, joint by joint", p, solve(p, "dense"));
    // No tangential force at the start, and none at the solution
    for (unsigned int i = 0; i < p.n; ++i)
      p.b[3 * i] = -1., p.b[3 * i + 1] = p.b[3 * i + 2] = 0.;
    p = chain(1, 16, .5, 1., 1.);
    p.W.assign(p.W.size(), 0.);
    for (unsigned int i = 0; i < 3 * p.n; ++i)
      p(i, i) = 1. + i % 3, p.b[i] = i % 3 == 0 ? -1. : 0.;
    check("pressure without shear", p, solve(p));
  }

  /** Rigid bodies on more contacts than they have freedoms. */
  void test_hyperstatic()
  {
    for (const unsigned int n : {4, 9, 30})
    {
      Problem                            p = make_problem(n, .5);
      std::vector<std::array<double, 6>> L;
      for (unsigned int i = 0; i < n; ++i)
        for (const auto &row : rigid_motion({{0., std::cos(2. * pi * i / n), std::sin(2. * pi * i / n)}}))
          L.push_back(row);
      add_body(p, 0, L, 1.);
      const std::array<double, 6> motion = {{-1., .2, .1, .3, .1, -.2}}; // of the free body
      for (unsigned int i = 0; i < 3 * n; ++i)
        for (unsigned int k = 0; k < 6; ++k)
          p.b[i] += L[i][k] * motion[k];
      Unknowns gap;
      for (const std::string method : {"newton", "proximal", "sweeps"})
      {
        const Solution s = solve(p, "sparse", with(method));
        check("rigid body on " + text(n) + " contacts, " + method, p, s);
        if (gap.empty())
          gap = s.gap;
        double apart = 0.; // slip depends on how the normal forces are shared, which is not unique
        for (std::size_t i = 0; i < gap.size(); i += 3)
          apart = std::max(apart, std::abs(s.gap[i] - gap[i]) / largest(p.b));
        below("  openings against Newton's", apart, 1e-8);
      }
    }
    for (const unsigned int m : {4, 9})
    {
      Problem  p = chain(6, m, .6, 0., 1.); // no compliance
      Unknowns motion(3 * p.n), b;
      for (double &x : motion)
        x = random_number();
      SparseContactOperator(sparse(p)).multiply(motion, b); // of the free blocks, and a little room to move
      for (unsigned int i = 0; i < 3 * p.n; ++i)
        p.b[i] = b[i] + (i % 3 == 0 ? .02 : 0.);
      check("rigid blocks, joints of " + text(m) + ", sparse", p, solve(p));
      check("rigid blocks, joints of " + text(m) + ", joint by joint", p, solve(p, "dense"));
    }
  }

  /** Two dams in one problem: neighbours in the list of joints that are not coupled. */
  void test_separate_chains()
  {
    const Problem a = chain(12, 16, .8, .01, 1.), b = chain(3, 16, .8, .01, 1.);
    Problem       p = make_problem(a.n + b.n, .8);
    p.groups = a.groups;
    p.groups.insert(p.groups.end(), b.groups.begin(), b.groups.end());
    unsigned int first = 0;
    for (const Problem *part : {&a, &b})
    {
      for (unsigned int i = 0; i < 3 * part->n; ++i)
      {
        p.b[first + i] = part->b[i];
        for (unsigned int j = 0; j < 3 * part->n; ++j)
          p(first + i, first + j) = (*part)(i, j);
      }
      first += 3 * part->n;
    }
    const Solution s = solve(p, "dense");
    check("two separate chains, joint by joint", p, s);
    note("  iterations of GMRES per Newton step", double(s.result.krylov) / s.result.iterations);
  }

  /** All open, all closed, and back; no load; each from the last solution. */
  void test_reversals()
  {
    for (const std::string kind : {"sparse", "dense"})
    {
      Problem        p = chain(5, 20, .7, .2, 1.);
      const Unknowns b = p.b;
      Unknowns       force;
      for (const double shift : {-2., 3., -2., 0., 3., -2., 0.})
      {
        for (unsigned int i = 0; i < 3 * p.n; ++i)
          p.b[i] = shift == 0. ? 0. : b[i] + (i % 3 == 0 ? shift : 0.);
        const Solution s = solve(p, kind, with("newton"), force);
        force = s.force;
        int closed = 0;
        for (const PairState state : s.states)
          closed += state != PairState::open;
        check("reversal, " + kind + ", shift " + text(shift) + ": " + text(closed) + " closed", p, s);
        if (shift == 0.)
          below("  no load: force", largest(force), 1e-300);
        if (shift == 3.)
          report("  all open: force", largest(force), "= 0", largest(force) == 0.);
      }
    }
  }

  Problem scaled(Problem p, const double length, const double force)
  {
    for (double &w : p.W)
      w *= length / force;
    for (double &x : p.b)
      x *= length;
    return p;
  }

  void test_units()
  {
    for (const std::string kind : {"sparse", "dense"})
      for (const std::string method : {"newton", "proximal"})
      {
        const Problem  p = chain(5, 16, .7, .2, 1.);
        const Solution s = solve(p, kind, with(method, 1e-10));
        for (const auto &unit : {std::array<double, 2>{1e3, 1e-6}, {1e-3, 1e9}, {1024., 1. / 1048576.}})
        {
          const Solution    t = solve(scaled(p, unit[0], unit[1]), kind, with(method, 1e-10));
          const std::string what =
              "units, " + kind + ", " + method + ", " + text(unit[0]) + " x " + text(unit[1]);
          report(what + ": iterations", t.result.iterations, "= " + text(s.result.iterations),
                 t.result.iterations == s.result.iterations && t.result.sweeps == s.result.sweeps &&
                     t.result.converged);
          Unknowns force = t.force;
          for (double &f : force)
            f /= unit[1];
          // joint by joint, Newton's systems are in single precision: other units, other round-off
          below("  forces", difference(force, s.force), kind == "dense" ? 1e-9 : 1e-12);
        }
      }
  }

  void test_noise()
  {
    for (const double noise : {1e-6, 1e-3, 3e-2})
    {
      Problem p = chain(3, 30, .5, .3, 1.);
      for (double &w : p.W)
        if (w != 0.)
          w *= 1. + noise * random_number();
      check("unsymmetric W, noise " + text(noise), p, solve(p));
    }
  }

  void test_methods()
  {
    const Problem  p = chain(4, 12, .6, .3, 1.);
    const Solution newton = solve(p);
    for (const std::string kind : {"sparse", "dense"})
      for (const std::string method : {"proximal", "sweeps"})
      {
        const Solution s = solve(p, kind, with(method));
        check(method + ", " + kind, p, s);
        below("  forces against Newton's", difference(s.force, newton.force), 1e-9);
      }
  }

  /** What has no solution: no crash, no hang, no claim. */
  void test_bad_problems()
  {
    for (const std::string kind : {"sparse", "dense"})
      for (const std::string method : {"newton", "proximal", "sweeps"})
        for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity()})
          for (const unsigned int component : {0u, 1u})
          {
            Problem p = chain(3, 9, .6, .3, 1.);
            p.b[3 * 7 + component] = bad;
            ContactParameters parameters = with(method);
            parameters.max_seconds = 2.;
            const Solution s = solve(p, kind, parameters);
            report("b " + text(bad) + ", " + kind + ", " + method + ": seconds", s.seconds, "not converged",
                   !s.result.converged && s.seconds < 3. && s.force.size() == 3 * p.n);
            below("  seconds, of such a small problem", s.seconds, 1.);
          }
    // Two contacts that press one body from both sides, with less room than it needs: no forces can do.
    Problem p = make_problem(2, .5);
    for (unsigned int i = 0; i < 6; ++i)
      for (unsigned int j = 0; j < 6; ++j)
        p(i, j) = i % 3 == j % 3 ? ((i < 3) == (j < 3) ? 1. : -1.) : 0.;
    p.b = {-1., 0., 0., -1., 0., 0.};
    for (const std::string method : {"newton", "proximal", "sweeps"})
    {
      ContactParameters parameters = with(method);
      parameters.max_seconds = .3;
      parameters.max_iterations = 1000000000;
      const Solution s = solve(p, "sparse", parameters);
      report("no solution, " + method + ": residual", s.result.residual, "not converged",
             !s.result.converged);
      between("  seconds", s.seconds, 0., .8);
      report("  the force", largest(s.force), "finite", std::isfinite(largest(s.force)));
    }
    // The error is relative to forces that grow without bound: at loose tolerances that passes for a
    // solution.
    missed("no solution, tolerance 1e-8: converged",
           solve(p, "sparse", with("newton", 1e-8)).result.converged, .5);
  }

  /** Boxes between two walls that approach: no forces hold them apart. Whatever the tolerance, no solution is
   *  claimed. */
  void test_infeasible()
  {
    for (const unsigned int n : {1, 3, 8})
      for (const double mu : {0., .3, .8})
        for (const double tolerance : {1e-4, 1e-8, 1e-12})
        {
          Problem p = make_problem(2 * n, mu);
          for (unsigned int c = 0; c < n; ++c) // contacts 2 c and 2 c + 1: the two sides of a rigid point
            for (unsigned int i = 0; i < 6; ++i)
              for (unsigned int j = 0; j < 6; ++j)
                if (i % 3 == j % 3)
                  p(6 * c + i, 6 * c + j) = (i == j || i % 3 == 0) ? (i == j ? 1. : -1.) : 1.;
          for (unsigned int c = 0; c < 2 * n; ++c)
          {
            p.b[3 * c] = -1.;
            p.b[3 * c + 1] = .1 * random_number();
          }
          const BlockSparseMatrix     W = sparse(p);
          const SparseContactOperator A(W);
          const auto                  law = make_joint_law("FJA", mu);
          ContactParameters           parameters = with("newton", tolerance);
          parameters.max_iterations = 2000;
          ContactSolver       solver(A, std::vector<const JointLaw *>(2 * n, law.get()), parameters);
          Unknowns            force(6 * n, 0.), gap;
          const ContactResult result = solver.solve(p.b, Unknowns(6 * n, 0.), force, gap);
          report("squeezed, " + text(2 * n) + " contacts, friction " + text(mu) + ", tolerance " +
                     text(tolerance),
                 result.force_over_load, "no solution", !result.converged);
        }
  }

  /** A squeezed problem: a force direction d >= 0, normal to all faces, with W d = 0. A solution has
   *  d u = d (W r + b) = d b and d u >= 0. So d b = -@p eps |d| |b| below 0 excludes a solution, by the
   * duality of linear programming; and d b above 0 ensures one if d alone spans the kernel of W (Acary,
   * Cadoux, Lemarechal and Malick 2011). */
  Problem squeezed(const double eps)
  {
    const auto uniform = [](const double low, const double high)
    { return low + .5 * (high - low) * (1. + random_number()); };
    const unsigned int n = 2 + static_cast<unsigned int>(uniform(0., 4.99)), size = 3 * n,
                       rank = eps < 0. ? 2 + static_cast<unsigned int>(uniform(0., size - 2.01)) : size;
    Problem             p = make_problem(n, uniform(0., 1.2));
    std::vector<double> d(size, 0.), H(size * rank);
    for (unsigned int i = 0; i < n; ++i)
      d[3 * i] = i < 2 || uniform(0., 1.) < .5 ? uniform(.2, 1.) : 0.;
    const auto product = [&](const double *x, const std::size_t stride)
    {
      double sum = 0.;
      for (unsigned int i = 0; i < size; ++i)
        sum += d[i] * x[i * stride];
      return sum;
    };
    const double dd = product(d.data(), 1);
    for (double &x : H)
      x = uniform(-1., 1.);
    for (unsigned int k = 0; k < rank; ++k)
    {
      const double along = product(&H[k], rank) / dd;
      for (unsigned int i = 0; i < size; ++i)
        H[i * rank + k] -= d[i] * along;
    }
    for (unsigned int i = 0; i < size; ++i)
      for (unsigned int j = 0; j < size; ++j)
        for (unsigned int k = 0; k < rank; ++k)
          p(i, j) += H[i * rank + k] * H[j * rank + k];
    for (double &x : p.b)
      x = uniform(-1., 1.);
    const double along = product(p.b.data(), 1) / dd;
    double       bb = 0.;
    for (unsigned int i = 0; i < size; ++i)
    {
      p.b[i] -= d[i] * along;
      bb += p.b[i] * p.b[i];
    }
    for (unsigned int i = 0; i < size; ++i)
      p.b[i] += eps * std::sqrt(bb / dd) * d[i];
    return p;
  }

  /** 500 problems that a squeeze of 1 to 1e-10 of the load makes infeasible, 500 that as much room makes
   *  feasible. */
  void test_squeezed()
  {
    for (const double tolerance : {1e-4, 1e-8, 1e-12})
    {
      unsigned int false_claims = 0, missed = 0, dishonest = 0;
      for (unsigned int trial = 0; trial < 1000; ++trial)
      {
        const double   eps = std::pow(10., -static_cast<double>(trial / 2 % 11));
        const bool     feasible = trial % 2 == 0;
        const Problem  p = squeezed(feasible ? eps : -eps);
        const Solution s = solve(p, "sparse", with("newton", tolerance));
        false_claims += !feasible && s.result.converged && eps > 10. * tolerance;
        missed += feasible && !s.result.converged;
        dishonest += s.result.converged && natural_map(p, s.force) > 1.01 * tolerance + 1e-14;
      }
      const std::string what = "tolerance " + text(tolerance) + ": ";
      report(what + "infeasible by more than ten times it, but converged, of 500", false_claims, "0",
             false_claims == 0);
      // Known: one at 1e-12, whose forces are far above the load.
      report(what + "feasible, but not converged, of 500", missed, "0, 1 at 1e-12",
             missed <= (tolerance < 1e-10 ? 1u : 0u));
      report(what + "converged, but wrong", dishonest, "0", dishonest == 0);
    }
  }

  /** Squeezes of 30 and 100 times the tolerance, within the round-off of forces of 1e4 loads. */
  void test_slightly_squeezed()
  {
    for (const double eps : {3e-11, 1e-10})
    {
      unsigned int false_claims = 0;
      for (unsigned int trial = 0; trial < 200; ++trial)
        false_claims += solve(squeezed(-eps)).result.converged;
      report("infeasible by " + text(eps) + ", but converged, of 200", false_claims, "0", false_claims == 0);
    }
  }

  /** Every contact twice: the forces are not unique, the gaps are. And numbers whose squares are none. */
  void test_twice_and_extreme()
  {
    const Problem once = chain(3, 6, .6, 1e-3, 1.);
    Problem       twice = make_problem(2 * once.n, .6);
    for (unsigned int i = 0; i < 3 * twice.n; ++i)
    {
      const unsigned int from_i = i % (3 * once.n);
      twice.b[i] = once.b[from_i];
      for (unsigned int j = 0; j < 3 * twice.n; ++j)
        twice(i, j) = once(from_i, j % (3 * once.n));
    }
    const Solution s = solve(twice);
    check("every contact twice", twice, s);
    below("  Newton steps (goal: 60)", s.result.iterations, 70.);
    FrictionProblem f;
    f.W = sparse(once);
    f.q = once.b;
    f.mu = once.mu;
    const FrictionSolution plain = solve_friction_problem(f, with("newton"), Equations::alart_curnier);
    for (const int exponent : {-990, -600, 600, 990})
    {
      FrictionProblem extreme = f;
      for (Matrix3 &block : extreme.W.value)
        for (double &x : block)
          x = std::ldexp(x, exponent);
      const FrictionSolution solution =
          solve_friction_problem(extreme, with("newton"), Equations::alart_curnier);
      double apart = solution.result.converged ? 0. : 1.;
      for (std::size_t i = 0; i < f.q.size(); ++i)
        apart = std::max(apart, std::abs(solution.gap[i] - plain.gap[i]));
      below("W times 2^" + text(exponent) + ": gaps", apart / largest(plain.gap), 1e-15);
    }
  }

  /** Out of time or steps: flagged, and the best that was seen, the guess included. */
  void test_unconverged()
  {
    const Problem p = chain(6, 25, .6, .3, 1.);
    for (const std::string kind : {"sparse", "dense"})
      for (const std::string method : {"newton", "proximal", "sweeps"})
      {
        Unknowns guess = solve(p, kind, with(method, 1e-10)).force;
        for (double &f : guess)
          f *= 1. + 1e-7 * random_number();
        const double at_guess = natural_map(p, guess);
        for (const unsigned int steps : {1u, 2u, 30u})
          for (const double time : {1e-9, 20.})
          {
            ContactParameters parameters = with(method, 1e-18); // nobody can
            parameters.max_iterations = method == "sweeps" ? 1 : steps;
            parameters.max_seconds = time;
            const Solution s = solve(p, kind, parameters, guess);
            report("unconverged, " + kind + ", " + method + ", " + text(steps) + " steps, " + text(time) +
                       " s: residual",
                   s.result.residual, "<= " + text(at_guess),
                   !s.result.converged && s.result.residual <= at_guess * (1. + 1e-6));
            below("  recomputed / reported - 1", natural_map(p, s.force) / s.result.residual - 1.,
                  s.result.residual > 1e-13 ? 1e-2 : 100.);
          }
      }
    ContactParameters parameters = with("sweeps", 1e-18);
    parameters.max_iterations = 1000000;
    parameters.max_seconds = .3;
    for (const std::string method : {"newton", "proximal", "sweeps"})
    {
      parameters.method = method;
      between("at most 0.3 s, " + method + ": seconds", solve(p, "sparse", parameters).seconds, 0., .8);
    }
  }

  /** Newton's method on the equations of all nodes and pairs, by a dense direct solver: no condensation. */
  Unknowns mixed_newton(const Structure &structure, const JointLaws &laws, const double rho,
                        const double m_factor, const double k_factor, const Unknowns &load,
                        const Unknowns &offset, Unknowns &u)
  {
    const int n_u = 3 * structure.n_nodes(), n_r = 3 * structure.pairs.size(), n = n_u + n_r, one = 1;
    std::vector<double> A(std::size_t(n_u) * n_u, 0.); // symmetric
    for (const Body &body : structure.bodies)
      for (unsigned int i = 0; i < body.stiffness.n_rows(); ++i)
        for (std::size_t k = body.stiffness.start[i]; k < body.stiffness.start[i + 1]; ++k)
          for (unsigned int c = 0; c < 9; ++c)
            A[std::size_t(3 * (body.first_node + i) + c / 3) * n_u +
              3 * (body.first_node + body.stiffness.column[k]) + c % 3] +=
                k_factor * body.stiffness.value[k][c];
    for (unsigned int i = 0; i < structure.n_nodes(); ++i)
      for (unsigned int c = 0; c < 9; ++c)
        A[std::size_t(3 * i + c / 3) * n_u + 3 * i + c % 3] += m_factor * structure.mass[i][c];
    std::vector<double> G(std::size_t(n_r) * n_u, 0.); // jump = G u
    for (unsigned int p = 0; p < structure.pairs.size(); ++p)
      for (unsigned int side = 0; side < 2; ++side)
      {
        const Pair        &pair = structure.pairs[p];
        const unsigned int node = side == 0 ? pair.node_1 : pair.node_2;
        for (unsigned int i = 0; i < 3 && node != rigid_ground; ++i)
          for (unsigned int c = 0; c < 3; ++c)
            G[std::size_t(3 * p + i) * n_u + 3 * node + c] = (side == 0 ? -1. : 1.) * pair.frame[i][c];
      }
    Unknowns force(n_r, 0.);
    u.assign(n_u, 0.);
    for (unsigned int iteration = 0; iteration < 60; ++iteration)
    {
      std::vector<double> J(std::size_t(n) * n, 0.), x(n, 0.); // column by column
      for (int i = 0; i < n_u; ++i)
      {
        x[i] = load[i];
        for (int j = 0; j < n_u; ++j)
        {
          x[i] -= A[std::size_t(i) * n_u + j] * u[j];
          J[std::size_t(j) * n + i] = A[std::size_t(i) * n_u + j];
        }
        for (int k = 0; k < n_r; ++k)
        {
          x[i] += G[std::size_t(k) * n_u + i] * force[k];
          J[std::size_t(n_u + k) * n + i] = -G[std::size_t(k) * n_u + i];
        }
      }
      double size = 0.;
      for (unsigned int p = 0; p < structure.pairs.size(); ++p)
      {
        Vector3 gap = structure.jump(structure.pairs[p], u);
        for (unsigned int c = 0; c < 3; ++c)
          gap[c] += offset[3 * p + c];
        PairEquations e;
        laws.of_pair[p]->evaluate(get(force, p), gap, {}, rho, e);
        for (unsigned int c = 0; c < 3; ++c)
        {
          const int row = n_u + 3 * p + c;
          x[row] = -e.residual[c];
          size = std::max(size, std::abs(e.residual[c]));
          for (unsigned int d = 0; d < 3; ++d)
          {
            J[std::size_t(n_u + 3 * p + d) * n + row] = e.d_force[3 * c + d];
            for (int j = 0; j < n_u; ++j)
              J[std::size_t(j) * n + row] += e.d_gap[3 * c + d] * G[std::size_t(3 * p + d) * n_u + j];
          }
        }
      }
      std::vector<int> pivots(n);
      int              info = 0;
      const bool       last = iteration > 0 && size < 1e-11 * largest(force);
      dgesv_(&n, &one, J.data(), &n, pivots.data(), x.data(), &n, &info);
      for (int i = 0; i < n_u; ++i)
        u[i] += x[i];
      for (int k = 0; k < n_r; ++k)
        force[k] += x[n_u + k];
      if (last || info != 0)
      {
        report("  all nodes: Newton steps, singular", iteration, "no", info == 0);
        return force;
      }
    }
    report("  all nodes: Newton's method converged", 0., "yes", false);
    return force;
  }

  /** G9: the joint system, the same dumped to a file and read again, and the equations of all nodes. */
  void test_condensation()
  {
    const SolidModel  model(blocks(3, false), 1);
    const Structure   structure = with_joints(model, {Material()});
    const std::size_t n = structure.pairs.size();
    const double      mu = .4, m_factor = 1e6, k_factor = .8;
    const JointLaws   laws = make_laws(structure, "FJA", mu);
    JointSystem       system(structure, laws, tight(), {m_factor, k_factor});
    for (unsigned int trial = 0; trial < 4; ++trial)
    {
      Unknowns load(3 * structure.n_nodes()), offset(3 * n), start(3 * n, 0.), force(3 * n, 0.), gap, u,
          u_free;
      for (double &f : load)
        f = 1e7 * random_number();
      for (std::size_t i = 0; i < offset.size(); ++i)
      {
        offset[i] = 2e-3 * random_number();
        start[i] = trial < 2 ? 0. : 1e-3 * random_number();
      }
      const ContactResult result = system.solve(load, offset, start, force, gap, u);
      report("dam of three blocks, load " + text(trial) + ": residual", result.residual, "converged",
             result.converged);

      // W column by column, b from the bodies without joint forces
      FrictionProblem                        problem;
      std::vector<std::vector<unsigned int>> columns(n);
      for (auto &row : columns)
        for (unsigned int j = 0; j < n; ++j)
          row.push_back(j);
      problem.W = BlockSparseMatrix(columns);
      for (unsigned int j = 0; j < 3 * n; ++j)
      {
        Unknowns unit(3 * n, 0.), column;
        unit[j] = 1.;
        system.joint_operator().multiply(unit, column);
        for (unsigned int i = 0; i < n; ++i)
        {
          Matrix3 a{};
          for (unsigned int c = 0; c < 3; ++c)
            a[3 * c + j % 3] = column[3 * i + c];
          problem.W.add(i, j / 3, a);
        }
      }
      system.solve_free(load, u_free);
      problem.mu.assign(n, mu);
      problem.q.resize(3 * n);
      for (std::size_t p = 0; p < n; ++p)
      {
        const Vector3 jump = structure.jump(structure.pairs[p], u_free);
        for (unsigned int c = 0; c < 3; ++c)
          problem.q[3 * p + c] = jump[c] + offset[3 * p + c] - (c == 0 ? 0. : start[3 * p + c]);
      }
      problem.title = "step";
      problem.guess = force;
      const std::string file = "contact_solver_step.txt";
      write_friction_problem(file, problem);
      const FrictionSolution s =
          solve_friction_problem(read_problem(file), tight(), Equations::alart_curnier);
      report("  written, read and solved again: residual", s.result.residual, "converged",
             s.result.converged);
      below("  difference of the forces", difference(s.force, force), 1e-10);
      for (std::size_t i = 0; i < gap.size(); ++i)
        gap[i] -= i % 3 == 0 ? 0. : start[i];
      below("  difference of the gaps", difference(s.gap, gap), 1e-10);

      if (trial > 1)
        continue;
      Unknowns       v;
      const Matrix3  H = system.joint_operator().diagonal(0);
      const Unknowns mixed =
          mixed_newton(structure, laws, 1. / (H[0] + H[4] + H[8]), m_factor, k_factor, load, offset, v);
      below("  all nodes: difference of the forces", difference(mixed, force), 1e-10);
      below("  all nodes: difference of the displacements", difference(v, u), 1e-10);
    }
    std::filesystem::remove("contact_solver_step.txt");
  }
} // namespace

int main()
{
  return run_all({test_sizes, test_coupling, test_friction, test_hyperstatic, test_separate_chains,
                  test_reversals, test_units, test_noise, test_methods, test_bad_problems, test_unconverged,
                  test_infeasible, test_squeezed, test_twice_and_extreme, test_condensation,
                  test_slightly_squeezed});
}
