// SPDX-License-Identifier: GPL-3.0-or-later
// Joint laws against their own equations, and friction on circular and cyclic paths against exact solutions.

#include "column.h"

using namespace Columns;

namespace
{
  void test_derivatives(const std::string &name, const std::string &equations)
  {
    const auto   law = make_joint_law(name, LawParameters(.7, equations_from_name(equations)));
    double       worst = 0.;
    int          states[3] = {0, 0, 0};
    const double h = 1e-6;
    for (unsigned int trial = 0; trial < 3000; ++trial)
    {
      Vector3       x[2]; // force, gap
      const double  rho = std::pow(10., random_number());
      PairEquations e, plus, minus;
      for (Vector3 &v : x)
        for (double &y : v)
          y = random_number();
      law->evaluate(x[0], x[1], Vector3{}, rho, e);
      const PairState state = e.state;
      if (equations == "paper" && std::hypot(x[0][1], x[0][2]) < .05)
        continue;
      double error = 0.;
      bool   smooth = true;
      for (unsigned int k = 0; k < 2; ++k)
        for (unsigned int j = 0; j < 3; ++j)
        {
          const double kept = x[k][j];
          x[k][j] = kept + h;
          law->evaluate(x[0], x[1], Vector3{}, rho, plus);
          smooth = smooth && plus.state == state;
          x[k][j] = kept - h;
          law->evaluate(x[0], x[1], Vector3{}, rho, minus);
          smooth = smooth && minus.state == state;
          x[k][j] = kept;
          for (unsigned int i = 0; i < 3; ++i)
            error = std::max(error, std::abs((plus.residual[i] - minus.residual[i]) / (2. * h) -
                                             (k == 0 ? e.d_force : e.d_gap)[3 * i + j]) /
                                        (1. + rho));
        }
      if (!smooth)
        continue;
      ++states[static_cast<int>(state)];
      worst = std::max(worst, error);
    }
    below("law " + name + ", " + equations + " equations: derivatives", worst, 1e-6);
    if (name == "FJA")
      above("law " + name + ", " + equations + " equations: states of each kind",
            *std::min_element(states, states + 3), 100);
  }

  void test_solve(const std::string &name)
  {
    double worst = 0.;
    for (const double mu : {0., .3, .7, 1.5})
    {
      const auto law = make_joint_law(name, mu);
      for (unsigned int trial = 0; trial < 5000; ++trial)
      {
        Matrix3 A, H{};
        Vector3 b;
        for (double &a : A)
          a = random_number();
        for (double &x : b)
          x = random_number();
        for (unsigned int i = 0; i < 3; ++i)
          for (unsigned int j = 0; j < 3; ++j)
            for (unsigned int k = 0; k < 3; ++k)
              H[3 * i + j] += A[3 * i + k] * A[3 * j + k] + (i == j && k == 0 ? .1 : 0.);
        const Vector3 f = law->solve(H, b, Vector3{});
        Vector3       gap = H * f;
        for (unsigned int c = 0; c < 3; ++c)
          gap[c] += b[c];
        PairEquations e;
        law->evaluate(f, gap, Vector3{}, 1., e);
        for (unsigned int c = 0; c < 3; ++c)
          worst = std::max(worst,
                           std::abs(e.residual[c]) / (1. + std::abs(f[0]) + std::abs(f[1]) + std::abs(f[2])));
      }
    }
    below("law " + name + ": exact solution of one pair, residual", worst, 1e-11);
  }

  /** e1, e4: compressed by @p compression, then driven along a circle of radius @p radius_of_drive / .6 times
   * the elastic slip: the radius of the slider is known for the discrete steps. */
  void circular_drive(const std::string &name, const std::vector<Bar> &bars, const unsigned int n)
  {
    const double end = bars.back().to;
    Column       column =
        make_column(bars, [&](const double x) { return x == end || (bars.size() > 1 && x == 0.); });
    if (bars.size() == 1)
      column.structure.pairs.push_back(wall(column.node[0][0]));
    column.structure.collect_interfaces();
    const double    mu = .6, compression = 4e-4;
    const JointLaws laws = make_laws(column.structure, "FJA", mu);
    JointSystem     system(column.structure, laws, tight(), {});
    double          normal = 0., tangential = 0.; // flexibilities
    for (const Bar &b : bars)
    {
      normal += (b.to - b.from) / (b.rho * b.cp * b.cp);
      tangential += (b.to - b.from) / (b.rho * b.cs * b.cs);
    }
    const double p = compression / normal, r = mu * p * tangential, U = r / .6, D = 2. * pi / n;
    const double exact = -r * std::sin(D / 2.) + std::sqrt(U * U - r * r * std::pow(std::cos(D / 2.), 2));
    Unknowns     force(3, 0.), gap, u, offset(3);
    double       slider[2] = {0., 0.}, cone = 0., step = 0.;
    unsigned int iterations = 0;
    bool         converged = true;
    for (unsigned int i = 0; i < 60 * n; ++i)
    {
      offset = {-compression, U * std::cos(i * D) - slider[0], U * std::sin(i * D) - slider[1]};
      const ContactResult result =
          system.solve(column.zero(), offset, Unknowns(offset.size(), 0.), force, gap, u);
      converged = converged && result.converged;
      iterations = std::max(iterations, result.iterations);
      slider[0] += gap[1];
      slider[1] += gap[2];
      step = std::hypot(gap[1], gap[2]);
      cone = std::max(cone, std::abs(std::hypot(force[1], force[2]) / (mu * force[0]) - 1.));
    }
    const std::string what = name + ", " + text(n) + " steps per turn: ";
    report(what + "converged, most iterations", iterations, "", converged);
    below(what + "pressure", force[0] / p - 1., 1e-12);
    below(what + "radius of the slider", std::hypot(slider[0], slider[1]) / exact - 1., 1e-12);
    below(what + "friction / limit", cone, 1e-12);
    below(what + "work per step", step / (2. * std::sin(D / 2.) * exact) - 1., 1e-11);
  }

  /** e2: bar on a frictional base under a cyclic force at its end; EA = L = f = 1. */
  void friction_bar(const unsigned int ne)
  {
    Column column = make_column({bar(0., 1., ne, 1., 1.)}, [](const double x) { return x == 1.; });
    for (const unsigned int node : column.node[0])
      column.structure.pairs.push_back(wall(node, 2)); // n = z, a = x
    column.structure.collect_interfaces();
    const JointLaws     laws = make_laws(column.structure, "FJA", 1.);
    JointSystem         system(column.structure, laws, ContactParameters(), {});
    const double        Fm = .8;
    std::vector<double> path, exact;
    const auto          U = [](const double F) { return F * F / 2.; };
    for (int i = 1; i <= 8; ++i)
      path.push_back(i * Fm / 8), exact.push_back(U(path.back()));
    for (int i = 1; i <= 16; ++i)
      path.push_back(Fm - i * Fm / 8), exact.push_back(U(Fm) - 2. * U((Fm - path.back()) / 2.));
    for (int i = 1; i <= 16; ++i)
      path.push_back(-Fm + i * Fm / 8), exact.push_back(-U(Fm) + 2. * U((path.back() + Fm) / 2.));
    const std::size_t n = column.node[0].size();
    Unknowns          force(3 * n, 0.), gap, u = column.zero(), offset(3 * n), load = column.zero();
    double            worst = 0., field = 0., area = 0.;
    unsigned int      iterations = 0, sweeps = 0, failures = 0;
    for (unsigned int step = 0; step < path.size(); ++step)
    {
      for (unsigned int k = 0; k < n; ++k)
      {
        const unsigned int i = column.node[0][k];
        offset[3 * k + 1] = -u[3 * i];
        offset[3 * k + 2] = -u[3 * i + 1];
        load[3 * i] = k == 0 ? path[step] : 0.;
        load[3 * i + 2] = -column.structure.mass[i][8]; // density 1: the tributary length
      }
      const double        before = u[3 * column.node[0][0]];
      const ContactResult result = system.solve(load, offset, Unknowns(offset.size(), 0.), force, gap, u);
      const double        end = u[3 * column.node[0][0]];
      failures += !result.converged;
      iterations = std::max(iterations, result.iterations);
      sweeps += result.sweeps;
      worst = std::max(worst, std::abs(end - exact[step]) / U(Fm));
      if (step == 7)
        for (unsigned int k = 0; k < n; ++k)
          field = std::max(field,
                           std::abs(u[3 * column.node[0][k]] - U(std::max(Fm - column.x[0][k], 0.))) / U(Fm));
      if (step >= 8)
        area += .5 * (path[step] + path[step - 1]) * (end - before);
    }
    const std::string what = "e2 bar on friction, " + text(ne) + " elements: ";
    report(what + "most Newton steps, all converged", iterations, "", failures == 0);
    note(what + "Gauss-Seidel sweeps", sweeps);
    below(what + "field at the first peak", field, 1e-9);
    below(what + "displacement of the end, cycle", worst, 1e-9);
    note(what + "area of the loop / exact - 1", area / (2. * Fm * Fm * Fm / 3.) - 1.);
  }

  void test_laws()
  {
    for (const std::string name : {"FJA", "FJB", "tied"})
    {
      test_derivatives(name, "alart-curnier");
      test_solve(name);
    }
    test_derivatives("FJA", "paper");
  }

  void test_circles()
  {
    const Bar one{0., 1.5, 3, 2400., 3000., 1800.}, two{1.5, 4., 2, 2000., 2500., 1300.};
    for (const unsigned int n : {8, 32, 128})
      circular_drive("e1 circle", {one}, n);
    circular_drive("e4 two blocks, circle", {one, two}, 32);
  }

  void test_friction_bars()
  {
    for (const unsigned int ne : {20, 40, 80})
      friction_bar(ne);
  }
} // namespace

int main()
{
  return run_all({test_laws, test_circles, test_friction_bars});
}
