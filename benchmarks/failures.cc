// SPDX-License-Identifier: GPL-3.0-or-later
// The failures of doc/failures.md that the program's own classes can show, as CSV for benchmarks/failures.py:
//   benchmark_failures bar RULE                   elastic bar on a wall, Newmark with an impact rule
//   benchmark_failures rock SHAPE BOUNDARY N      N steps of a box or sheet of rock after a push on the
//   ground benchmark_failures reflection INTERPOLATION   what a transmitting formula of order 2 reflects in a
//   bar

#include "../tests/column.h"
#include "../tests/packet.h"
#include "../tests/quarter_box.h"

#include <voussoir/base/error.h>
#include <voussoir/dynamics/newmark.h>

namespace
{
  using namespace Voussoir;

  /** A bar of 10 m, E = 900 Pa, 1 kg/m^3, hits a wall with 10 m/s; 100 elements, Courant number 1.5. Five
   * phases between impact and step. The exact force is 300 N for 2/3 s. */
  void bar(const std::string &rule_name)
  {
    using namespace Columns;
    constexpr unsigned int n = 100;
    constexpr double       L = 10., c = 30., v0 = 10., dt = 1.5 * L / n / c;
    const ImpactRule       rule = impact_rule(rule_name);
    Column                 column = make_column({Columns::bar(0., L, n, 900., 1.)});
    column.structure.pairs.push_back(wall(column.node[0][0]));
    column.structure.collect_interfaces();
    const JointLaws laws = make_laws(column.structure, "FJA", 0.);
    std::printf("phase,time,force,gap,energy\n");
    for (const double phase : {.1, .3, .5, .7, .9})
    {
      const double h0 = 5. + phase * v0 * dt;
      Newmark      newmark(column.structure, laws, tight(), dt, rule);
      Unknowns     v = column.zero();
      column.set(v, 0, {{-v0, 0., 0.}});
      newmark.start(column.zero(), v, {0., 0., 0.}, column.zero(), {-h0, 0., 0.});
      const auto see = [&]
      {
        const DynamicState &s = newmark.state();
        std::printf("%g,%.9g,%.9g,%.9g,%.9g\n", phase, s.time, s.force[0], newmark.opening_and_slip(0)[0],
                    (s.energy.kinetic + s.energy.strain) / (.5 * L * v0 * v0));
      };
      run(newmark, dt, std::lround((1. + 2. * L / c) / dt), nullptr, column.zero(), see,
          rule == ImpactRule::mean_force);
    }
  }

  /** @p mistake: "" or what is wrong with the boundary. */
  RockRegionParameters rock_parameters(const std::string &boundary, const std::string &mistake)
  {
    auto p = QuarterBoxes::parameters(boundary);
    if (mistake == "gamma=0")
      p.boundary_maker = QuarterBoxes::mtf2_without_gamma;
    if (mistake == "gauss")
    {
      p.rock.nodal_everywhere = false;
      p.rock.nodal_layers = 0;
    }
    return p;
  }

  /** Largest displacement step by step, then those of the nodes with y = 0 when it first exceeds five times
   * the peak of the push. @p boundary: a name, ":" and a mistake (gamma=0, gauss, diagonal)
   * if there is one. */
  void rock(const std::string &shape, const std::string &boundary, const unsigned int n_steps)
  {
    using namespace QuarterBoxes;
    const std::size_t colon = boundary.find(':');
    const std::string mistake = colon == std::string::npos ? "" : boundary.substr(colon + 1);
    const auto        p = rock_parameters(boundary.substr(0, colon), mistake);
    const bool        plane = shape == "sheet";
    constexpr int     nx = 40, nz = 20;
    RockModel         model = plane ? half_plane(p, nx, nz) : quarter(p);
    if (mistake == "diagonal")
      model =
          with_diagonal_lines(model, {{plane ? nx : int(n), plane ? 1 : int(n), plane ? nz : int(n)}}, plane);
    double       peak = 0.;
    unsigned int step = 0, step_of_field = 0;
    Unknowns     field;
    std::printf("step,largest\n");
    const Result result = run(p, model, n_steps,
                              [&](const ExplicitRegion &region, const double largest)
                              {
                                std::printf("%u,%.6g\n", ++step, largest);
                                if (step <= 200)
                                  peak = std::max(peak, largest);
                                if (step > 200 && step_of_field == 0 && largest > 5. * peak)
                                {
                                  step_of_field = step;
                                  field = region.displacement();
                                }
                              });
    std::printf("\nstep,x,z,u_x,u_z\n");
    for (unsigned int i = 0; i < model.points.size() && step_of_field > 0; ++i)
      if (model.points[i][1] == 0.)
        std::printf("%u,%g,%g,%.6g,%.6g\n", step_of_field, model.points[i][0], model.points[i][2],
                    field[3 * i], field[3 * i + 2]);
    std::printf("\nsteps,peak,end\n%u,%.9g,%.9g\n", result.steps, result.peak, result.end);
  }

  void reflection(const std::string &interpolation)
  {
    using Rule = TransmittingFormula::Interpolation;
    const Rule rule = interpolation == "direct"   ? Rule::direct
                      : interpolation == "linear" ? Rule::linear
                                                  : Rule::quadratic;
    std::printf("points,reflected\n");
    for (const double points : {10., 14., 20., 28., 40.})
      std::printf("%g,%.6g\n", points, Packets::reflected({{1., 1.}, 0., rule}, points));
  }
} // namespace

int main(const int argc, char **argv)
{
  const std::vector<std::string> words(argv + 1, argv + argc);
  if (words.size() == 2 && words[0] == "bar")
    bar(words[1]);
  else if (words.size() == 4 && words[0] == "rock")
    rock(words[1], words[2], std::stoul(words[3]));
  else if (words.size() == 2 && words[0] == "reflection")
    reflection(words[1]);
  else
  {
    std::fprintf(stderr, "usage: benchmark_failures bar RULE | rock box|sheet BOUNDARY[:MISTAKE] STEPS | "
                         "reflection quadratic|linear|direct\n");
    return 2;
  }
  return 0;
}
