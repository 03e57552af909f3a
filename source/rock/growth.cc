// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/error.h>
#include <voussoir/rock/growth.h>
#include <voussoir/solid/critical_step.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <sstream>
#include <tuple>

namespace Voussoir
{
  namespace
  {
    constexpr unsigned int n = 12;                               ///< cells of the box in each direction
    constexpr double       known_stable = .25;                   ///< Poisson's ratio
    constexpr int          rock_volume = PhysicalId::first_rock; ///< of the box

    double largest_poisson(const RockParameters &rock)
    {
      double result = 0.;
      for (const auto &material : rock.materials)
        result = std::max(result, material.second.poisson);
      return result;
    }

    /** Returns the box: artificial boundary at the largest x and y and at the bottom, the base of a dam on
     * 2 x 2 cells of the ground at the opposite corner. */
    HexMesh box()
    {
      const auto node = [](const unsigned int i, const unsigned int j, const unsigned int k)
      { return (k * (n + 1) + j) * (n + 1) + i; };
      HexMesh mesh;
      for (unsigned int k = 0; k <= n; ++k)
        for (unsigned int j = 0; j <= n; ++j)
          for (unsigned int i = 0; i <= n; ++i)
            mesh.nodes.push_back({{double(i), double(j), double(k)}});
      for (unsigned int k = 0; k < n; ++k)
        for (unsigned int j = 0; j < n; ++j)
          for (unsigned int i = 0; i < n; ++i)
          {
            const HexMesh::Cell cell{{node(i, j, k), node(i + 1, j, k), node(i + 1, j + 1, k),
                                      node(i, j + 1, k), node(i, j, k + 1), node(i + 1, j, k + 1),
                                      node(i + 1, j + 1, k + 1), node(i, j + 1, k + 1)},
                                     rock_volume};
            mesh.cells.push_back(cell);
            const auto add = [&](const unsigned int a, const unsigned int b, const unsigned int c,
                                 const unsigned int d, const int surface) {
              mesh.faces.push_back({{cell.nodes[a], cell.nodes[b], cell.nodes[c], cell.nodes[d]}, surface});
            };
            if (i + 1 == n)
              add(1, 2, 6, 5, PhysicalId::artificial);
            if (j + 1 == n)
              add(2, 3, 7, 6, PhysicalId::artificial);
            if (k == 0)
              add(0, 1, 2, 3, PhysicalId::artificial);
            if (k + 1 == n && i < 2 && j < 2)
              add(4, 5, 6, 7, PhysicalId::base);
          }
      return mesh;
    }

    /** Sets time step and damping in the ratios of the region. The damping reduces the critical time step. */
    void set_step(const RockModel &model, const RockRegionParameters &region, const double critical_time_step,
                  RockRegionParameters &p)
    {
      const double w = largest_frequency(model.stiffness, model.mass),
                   courant = std::min(1., region.dt / critical_time_step);
      p.dt = 0.;
      for (unsigned int i = 0; i < 30; ++i)
      {
        p.damping.stiffness = region.damping.stiffness / region.dt * p.dt;
        const double faster = p.dt > 0. ? region.dt / p.dt : 1.;
        p.damping.mass = region.damping.mass * faster;
        p.damping.lowest = region.damping.lowest * faster;
        p.damping.highest = region.damping.highest * faster;
        p.dt = courant * (1. - 1e-9) * Voussoir::critical_time_step(w, p.damping);
      }
    }
  } // namespace

  std::unique_ptr<ExplicitRegion> region_with_noise(const RockModel                 &model,
                                                    const RockRegionParameters      &parameters,
                                                    const std::vector<unsigned int> &fixed)
  {
    auto region = make_region(model, parameters);
    region->fix(fixed);
    std::mt19937 engine(7);
    Unknowns     u(3 * model.points.size(), 0.), v = u;
    for (double &x : v)
      x = engine() / 2147483647.5 - 1.;
    for (const BoundaryLine &line : model.lines)
      std::fill_n(v.begin() + 3 * std::size_t(line.nodes[0]), 3, 0.);
    region->keep_energy();
    region->start(u, v);
    return region;
  }

  double growth_per_step(const RockRegionParameters &parameters, const double critical_time_step,
                         const bool is_symmetric)
  {
    constexpr unsigned int n_steps = 24000, interval = 400;
    // Bounds of the energy relative to that of the noise. The noise contains each motion by more than the
    // smaller bound. Stable motions may first grow by 1e9.
    constexpr double     decayed = 1e-9, grown = 1e30;
    RockRegionParameters p = parameters;
    Material             material;
    material.poisson = largest_poisson(parameters.rock);
    material.young = 2. * (1. + material.poisson);
    material.density = 1.;
    p.rock.materials = {{rock_volume, material}};
    p.rock.centre = {{0., 0., double(n)}};
    if (!is_symmetric)
      p.rock.layers_at_dam = 0; // real rock has no dam at the edge of two free vertical faces
    const RockModel model = make_rock_model(box(), p.rock);
    set_step(model, parameters, critical_time_step, p);
    std::vector<unsigned int> fixed; // components across the planes of symmetry
    for (unsigned int i = 0; i < model.points.size(); ++i)
      for (unsigned int c = 0; c < 2; ++c)
        if (is_symmetric && model.points[i][c] == 0.)
          fixed.push_back(3 * i + c);
    const auto          region = region_with_noise(model, p, fixed);
    std::vector<double> energy;
    double              of_noise = 0.;
    for (unsigned int i = 1; i <= n_steps; ++i)
    {
      region->advance();
      if (i % interval != 0 && i > 1)
        continue;
      const RegionEnergy now = region->energy();
      const double       sum = now.kinetic + now.strain;
      if (i == 1)
        of_noise = sum;
      else
        energy.push_back(sum < 1e200 ? sum : 1e200); // also for NaN
      const double ratio = i == 1 ? 1. : energy.back() / of_noise;
      if (ratio < decayed || ratio > grown)
        return .5 * std::log(ratio) / i;
    }
    // Largest energies of the second and the last third: the energy of slow motions varies.
    const auto   third = energy.begin() + energy.size() / 3, last = energy.begin() + 2 * energy.size() / 3;
    const double before = *std::max_element(third, last), after = *std::max_element(last, energy.end());
    return .5 * std::log(after / before) / (n_steps / 3);
  }

  namespace
  {
    double largest_growth_of(const RockRegionParameters &p, const double critical_time_step)
    {
      using Settings = std::tuple<std::string, bool, unsigned int, unsigned int, bool, double, double, double,
                                  double, double, double>;
      static std::map<Settings, double> known;
      const Settings settings(p.boundary, p.rock.nodal_everywhere, p.rock.nodal_layers, p.rock.layers_at_dam,
                              p.rock.incompatible_modes, largest_poisson(p.rock), p.dt / critical_time_step,
                              p.damping.stiffness / p.dt, p.damping.mass * p.dt, p.damping.quality,
                              p.damping.lowest * p.dt);
      const auto     found = known.find(settings);
      if (found != known.end())
        return found->second;
      double growth = growth_per_step(p, critical_time_step, true);
      if (growth <= largest_growth)
        growth = std::max(growth, growth_per_step(p, critical_time_step, false));
      return known[settings] = growth;
    }

    /** Returns the circular frequency with the given critical time step: the inverse of critical_time_step() [1/s]. */
    double frequency_of(const double critical, const RockDamping &damping)
    {
      const double s = relaxation_of(damping).unrelaxed;
      return std::sqrt((1. - .5 * critical * damping.mass) /
                       (.25 * s * critical * critical + .5 * critical * damping.stiffness));
    }
  } // namespace

  void check_growth(const RockRegionParameters &p, const double critical_time_step)
  {
    if (largest_poisson(p.rock) <= known_stable || make_boundary(p)->nodes_per_line() == 0)
      return;
    const double growth = largest_growth_of(p, critical_time_step);
    if (growth <= largest_growth)
      return;
    std::ostringstream text;
    text << "The transmitting boundary " << p.boundary << " is unstable in rock whose Poisson's ratio is "
         << largest_poisson(p.rock)
         << " (the largest of \"Foundation/Poisson's ratio\" and \"Foundation/Zones\"): with a time step of "
         << p.dt / critical_time_step << " of the critical one and a stiffness damping of "
         << p.damping.stiffness / p.dt
         << " time steps, the motion in a box of 12 x 12 x 12 elements grows by " << 100. * std::expm1(growth)
         << " % per step. ";
    const std::string boundary = std::string(" \"Foundation/Boundary\" to viscous-spring") +
                                 (p.damping.has_quality() ? " and \"Foundation/Quality factor\" to 0." : ".");
    const double w = frequency_of(critical_time_step, p.damping);
    for (const double share : {.005, .01, .02, .05})
    {
      // More damping reduces the critical time step.
      RockRegionParameters other = p;
      other.damping.stiffness = share * p.dt;
      const double critical = Voussoir::critical_time_step(w, other.damping);
      other.dt = std::min(p.dt, .99 * critical);
      if (share * p.dt <= p.damping.stiffness || largest_growth_of(other, critical) > largest_growth)
        continue;
      text << "Set \"Foundation/Stiffness damping\" to at least " << other.damping.stiffness << " s ("
           << share << " times the rock time step)";
      if (other.dt < p.dt)
        text << " with a rock time step of at most " << other.dt << " s";
      text << ", or" << boundary;
      throw InputError(text.str());
    }
    text << "Set" << boundary;
    throw InputError(text.str());
  }
} // namespace Voussoir
