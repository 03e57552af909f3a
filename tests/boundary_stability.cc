// Long runs of a quarter box of rock (12 x 12 x 12 cells, corner, edges, free surface) after a push on the
// ground: what is stable, and how the known mistakes fail. Without an argument 1e4 steps, or the number
// given.

#include "box.h"
#include "column.h"

namespace
{
  using namespace Boxes;
  using Columns::above;
  using Columns::below;

  constexpr unsigned int n = 12;
  unsigned int           n_long = 10000;

  struct Result
  {
    double       peak = 0., end = 0., energy_error = 0.; ///< max |u| of the first 1000 steps, at the end
    unsigned int steps = 0;                              ///< until it blew up
  };

  RockRegionParameters parameters(const std::string &boundary)
  {
    RockRegionParameters p;
    p.rock.materials[rock] = unit_rock();
    p.rock.nodal_everywhere = true;
    p.rock.centre = {{0., 0., double(n)}};
    p.boundary = boundary;
    p.dt = .3;
    return p;
  }

  RockModel quarter(const RockRegionParameters &p)
  {
    return make_rock_model(box({n, n, n}, {"x+", "y+", "z-"},
                               [](const double i, const double j, const double k) -> Vector3 {
                                 return {{i, j, k}};
                               }),
                           p.rock);
  }

  Result run(const RockRegionParameters &p, const RockModel &model, const unsigned int n_steps,
             const TransmittingFormula *formula = nullptr)
  {
    auto                      region = make_region(model, p, formula);
    std::vector<unsigned int> fixed;
    unsigned int              source = 0;
    for (unsigned int i = 0; i < model.points.size(); ++i)
    {
      const auto &x = model.points[i];
      for (unsigned int c = 0; c < 2; ++c)
        if (x[c] == 0.)
          fixed.push_back(3 * i + c);
      if (x[0] == 0. && x[1] == 0. && x[2] == n)
        source = i;
    }
    region->fix(fixed);
    region->keep_energy();
    region->force.assign(3 * model.points.size(), 0.);
    Result result;
    double largest = 0.;
    for (unsigned int i = 0; i < n_steps; ++i)
    {
      const double t = (region->time() - 25.) / 8.;
      region->force[3 * source + 2] = -.25 * std::exp(-t * t);
      region->advance();
      ++result.steps;
      if (i < 1000 || i % 100 == 0 || i + 1 == n_steps)
      {
        double most = 0.;
        for (const double u : region->displacement())
          most = std::abs(u) <= most ? most : std::abs(u); // NaN stays
        result.end = most;
        if (!(most < 1e6))
          break;
        if (i < 1000)
          result.peak = std::max(result.peak, most);
        const RegionEnergy &e = region->energy();
        largest = std::max(largest, e.kinetic + e.strain);
        result.energy_error = std::max(result.energy_error, std::abs(e.balance()));
      }
    }
    result.energy_error /= largest;
    return result;
  }

  void stable()
  {
    for (const std::string name : {"mtf2", "mtf3", "viscous-spring"})
    {
      const auto   p = parameters(name);
      const Result r = run(p, quarter(p), n_long);
      below(name + ", nodal quadrature: max |u| after " + std::to_string(r.steps) + " steps / peak",
            r.end / r.peak, 1e-6);
      below("  energy account / largest energy", r.energy_error, 1e-8);
    }
    auto p = parameters("mtf2");
    p.rock.nodal_everywhere = false;
    // Without damping rough waves stay in the core of Gauss points, whose frequencies the layers do not
    // carry.
    const Result early = run(p, quarter(p), n_long / 4), late = run(p, quarter(p), n_long);
    below("mtf2, 6 layers of nodal quadrature: max |u| / peak", late.end / late.peak, 1e-2);
    below("  late / early", late.end / early.end, 2.);
    p.damping.stiffness = .02 * p.dt;
    const Result damped = run(p, quarter(p), n_long);
    below("  with a stiffness damping of 0.02 dt: max |u| / peak", damped.end / damped.peak, 1e-6);
    Columns::report("  no warning", 0., "-", stability_warning(p).empty());
  }

  void gauss()
  {
    auto p = parameters("mtf2");
    p.rock.nodal_everywhere = false;
    p.rock.nodal_layers = 0;
    const Result r = run(p, quarter(p), 5000);
    above("Gauss points at the boundary: steps until it blows up", r.steps, 100.);
    below("  steps", r.steps, 1500.);
    Columns::report("  is warned of", 0., "-", !stability_warning(p).empty());
    above("  is seen in noise: growth of energy in 1000 steps", noise_growth(quarter(p), p, 1000), 10.);
    const auto q = parameters("mtf2");
    below("  growth with nodal quadrature", noise_growth(quarter(q), q, 1000), 1.);
  }

  void drift()
  {
    TransmittingFormula without = transmitting_formula("mtf2");
    for (auto &f : without.factors)
      f.gamma_p = f.gamma_s = 0.;
    const auto   p = parameters("mtf2");
    const Result first = run(p, quarter(p), 4000, &without), second = run(p, quarter(p), 8000, &without);
    above("gamma = 0 drifts: max |u| after 4000 steps / peak of the first 1000", first.end / first.peak, 2.);
    Columns::between("  linearly: after 8000 / after 4000", second.end / first.end, 1.8, 2.3);
    Columns::report("  is warned of", 0., "-", !stability_warning(p, &without).empty());
  }

  /** Lines of nodes on edges go inward at 45 degrees. */
  void diagonal()
  {
    const auto p = parameters("mtf3");
    RockModel  model = quarter(p);
    for (BoundaryLine &line : model.lines)
    {
      const auto &x = model.points[line.nodes[0]];
      const int   step[3] = {x[0] == n ? -1 : 0, x[1] == n ? -1 : 0, x[2] == 0. ? 1 : 0};
      const int   faces = std::abs(step[0]) + std::abs(step[1]) + step[2];
      if (faces < 2)
        continue;
      for (unsigned int k = 0; k < line.nodes.size(); ++k)
      {
        line.nodes[k] = line.nodes[0] + int(k) * (step[0] + int(n + 1) * (step[1] + int(n + 1) * step[2]));
        line.position[k] = k * std::sqrt(double(faces));
      }
    }
    const Result r = run(p, model, 5000);
    below("diagonal lines at edges, mtf3: steps until it blows up", r.steps, 4000.);
  }
} // namespace

int main(const int argc, char **argv)
{
  if (argc > 1)
    n_long = std::stoi(argv[1]);
  return Columns::run_all({gauss, drift, diagonal, stable});
}
