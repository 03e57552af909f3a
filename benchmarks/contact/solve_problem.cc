// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve_problem.h"
#include "pair_groups.h"
#include "sparse_contact.h"

#include <voussoir/contact/law_table.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace Voussoir
{
  namespace
  {
    /** Returns true if the problem is solved joint by joint: several groups of many pairs, symmetric W. */
    bool has_joints(const BlockSparseMatrix &W, const PairGroups &groups)
    {
      return groups.size.size() > 1 && W.n_rows() >= 8 * groups.size.size() && is_symmetric(W);
    }

    std::string path_name(const ContactParameters &parameters, const Equations equations,
                          const ContactPath path)
    {
      std::string name = equations == Equations::paper ? "paper" : parameters.method;
      if (parameters.method == "newton" && path >= ContactPath::sweeps)
        name += "+sweeps";
      if (parameters.method == "newton" && path >= ContactPath::proximal)
        name += "+proximal";
      return name;
    }

    double largest(const double x)
    {
      return std::abs(x);
    }
    double largest(const Matrix3 &block)
    {
      double result = 0.;
      for (const double x : block)
        result = std::max(result, std::abs(x));
      return result;
    }
    void scale(double &x, const int exponent)
    {
      x = std::ldexp(x, exponent);
    }
    void scale(Matrix3 &block, const int exponent)
    {
      for (double &x : block)
        scale(x, exponent);
    }

    /** Divides the values by a power of two. The largest value is then about 1, so that squares do not
     * overflow. Returns the exponent. */
    template <typename T> int normalise(std::vector<T> &values)
    {
      double size = 0.;
      for (const T &x : values)
        size = std::max(size, largest(x));
      int exponent = 0;
      if (size > 0. && std::isfinite(size))
        std::frexp(size, &exponent);
      for (T &x : values)
        scale(x, -exponent);
      return exponent;
    }
  } // namespace

  FrictionSolution solve_friction_problem(const FrictionProblem &problem, const ContactParameters &parameters,
                                          const Equations equations)
  {
    const unsigned int                          n = problem.W.n_rows();
    std::map<double, std::unique_ptr<JointLaw>> laws;
    std::vector<const JointLaw *>               law(n);
    for (const double mu : problem.mu)
      if (laws.find(mu) == laws.end())
        laws[mu] = make_joint_law("FJA", LawParameters(mu, equations));
    FrictionProblem  scaled = problem;
    const int        exponent_W = normalise(scaled.W.value), exponent_q = normalise(scaled.q);
    const PairGroups groups = find_groups(scaled.W);
    const bool       joints = has_joints(scaled.W, groups);
    const auto       old = [&](const unsigned int i) { return joints ? groups.order[i] : i; };
    for (unsigned int i = 0; i < n; ++i)
      law[i] = laws[problem.mu[old(i)]].get();

    std::unique_ptr<ContactOperator> W;
    if (joints)
      W = std::make_unique<InterfaceOperator>(make_interface_operator(scaled.W, groups));
    else
      W = std::make_unique<SparseContactOperator>(scaled.W);
    ContactSolver solver(*W, law, parameters);

    FrictionSolution solution;
    Unknowns         q(3 * n), force(3 * n, 0.), gap, start(3 * n, 0.);
    for (unsigned int k = 0; k < 3 * n; ++k)
      q[k] = scaled.q[3 * old(k / 3) + k % 3];
    solution.result = solver.solve(q, start, force, gap);
    solution.force.resize(3 * n);
    solution.gap.resize(3 * n);
    for (unsigned int k = 0; k < 3 * n; ++k)
    {
      solution.force[3 * old(k / 3) + k % 3] = std::ldexp(force[k], exponent_q - exponent_W);
      solution.gap[3 * old(k / 3) + k % 3] = std::ldexp(gap[k], exponent_q);
    }
    solution.result.converged =
        solution.result.converged && std::all_of(solution.force.begin(), solution.force.end(),
                                                 [](const double f) { return std::isfinite(f); });
    solution.solver = path_name(parameters, equations, solution.result.path);
    return solution;
  }
} // namespace Voussoir
