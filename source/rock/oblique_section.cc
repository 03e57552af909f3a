// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/rock/cubic_in_time.h>
#include <voussoir/rock/explicit_region.h>
#include <voussoir/rock/oblique_section.h>

#include <algorithm>
#include <cmath>

namespace Voussoir
{
  namespace
  {
    constexpr double near_critical = .9; ///< largest share of the critical time step

    /** Sets the apparent speeds c / sqrt(1 - p^2 c^2) of waves in the section. */
    void set_apparent_speeds(RockModel &model, const double p)
    {
      for (BoundaryLine &line : model.lines)
        for (double *c : {&line.c_p, &line.c_s})
          *c /= std::sqrt(1. - p * p * *c * *c);
    }
  } // namespace

  double ObliqueSection::least_damping(const std::map<int, Material> &materials, const double p)
  {
    double result = 0.;
    for (const auto &[volume, m] : materials)
    {
      const double c_p = p_wave_speed(m), c_s = s_wave_speed(m);
      const double square = c_p * c_p * (1. - p * p * c_s * c_s) / (c_s * c_s * (1. - p * p * c_p * c_p));
      const double apparent = (square - 2.) / (2. * (square - 1.)); // Poisson's ratio
      result = std::max(result, apparent > .4 ? .01 : apparent > .3 ? .005 : 0.);
    }
    return result;
  }

  unsigned int ObliqueSection::steps_ahead(const double p, const double origin,
                                           const std::array<double, 2> &reach, const double dt)
  {
    return std::ceil(-std::min({0., p * (reach[0] - origin), p * (reach[1] - origin)}) / dt) + 3;
  }

  ObliqueSection::ObliqueSection(const WideSection &wide, RockModel model, std::unique_ptr<ZoneStrip> given,
                                 std::unique_ptr<ArtificialBoundary> given_boundary,
                                 const RockRegionParameters &parameters, const double p,
                                 const std::array<double, 2> &reach)
      : p(p), origin(parameters.incidence.centre[0]), dt(parameters.dt), damping(parameters.damping),
        lead(steps_ahead(p, origin, reach, dt)), strip(std::move(given)), stiffness(make_operator(model)),
        coupling(wide.mesh, model, parameters.rock.materials, p),
        coupling_of_strip(strip->mesh, strip->model, parameters.rock.materials, p), mass(model.mass),
        mass_along(model.mass), mass_across(model.mass), is_explicit(model.points.size(), true),
        boundary(std::move(given_boundary))
  {
    n_kept = lead + steps_ahead(-p, origin, reach, dt) + 6;
    for (std::size_t i = 0; i < mass.size(); ++i)
    {
      mass_along[i] -= coupling.mass_along[i];
      mass_across[i] -= coupling.mass_across[i];
    }
    u.assign(3 * mass.size(), 0.);
    w = x = K_x = u;
    constexpr double of_iteration = 1.02; // largest_frequency() is a lower bound
    n_substeps =
        std::ceil(dt / (near_critical * critical_time_step(of_iteration * largest_frequency(), damping)));
    set_apparent_speeds(model, p);
    boundary->attach(model, parameters.rock.centre, dt / n_substeps);
    for (const unsigned int i : boundary->nodes())
      is_explicit[i] = false;
    strip->field.evaluate(field_before);
    field_half = field_before;
    ring.assign(u.size() * n_kept, 0.);
    for (unsigned int k = 0; k < lead; ++k)
      end_step();
  }

  /** Largest circular frequency of the equations without damping [1/s], by power iterations. With the
   * unknowns (u_x, w_yz) the equations have the form y'' = -A y, and A is symmetric in the scalar product
   * (K_x, M_yz). */
  double ObliqueSection::largest_frequency() const
  {
    constexpr unsigned int n_iterations = 200;
    const std::size_t      n = mass.size();
    Unknowns               y(3 * n), Ky(3 * n), acceleration(3 * n);
    for (std::size_t i = 0; i < y.size(); ++i)
      y[i] = 1. + .5 * std::sin(12.9898 * i);
    double square = 0.;
    for (unsigned int k = 0; k < n_iterations; ++k)
    {
      stiffness.multiply(y.data(), Ky.data());
      acceleration = Ky;
      coupling.add_along(y, acceleration);
      Unknowns along(3 * n, 0.);
      for (std::size_t i = 0; i < n; ++i)
        along[3 * i] = acceleration[3 * i] = acceleration[3 * i] / mass_along[i];
      // K w - G' u_x'' with u_x'' = -acceleration: add_across() subtracts G' times its argument.
      for (std::size_t i = 0; i < n; ++i)
        along[3 * i] = -along[3 * i];
      coupling.add_across(along, acceleration);
      double product = 0., size = 0., largest = 0.;
      for (std::size_t i = 0; i < n; ++i)
      {
        for (const unsigned int c : {1u, 2u})
        {
          acceleration[3 * i + c] /= mass_across[i];
          product += mass_across[i] * y[3 * i + c] * acceleration[3 * i + c];
          size += mass_across[i] * y[3 * i + c] * y[3 * i + c];
        }
        product += Ky[3 * i] * acceleration[3 * i];
        size += Ky[3 * i] * y[3 * i];
      }
      square = product / size;
      // The two kinds of unknowns have different units, so each iterate is scaled by the largest value.
      for (const double value : acceleration)
        largest = std::max(largest, std::abs(value));
      for (std::size_t i = 0; i < y.size(); ++i)
        y[i] = acceleration[i] / largest;
    }
    return std::sqrt(square);
  }

  /** Sets force to the forces of the free field at the time @p later after the current step of the field,
   * with substeps
   * @p step [s]. */
  void ObliqueSection::set_forces_of_zone(const double later, const double step)
  {
    Unknowns at, half; // free field now, and half a substep later
    strip->field.evaluate(at, later);
    strip->field.evaluate(half, later + .5 * step);
    Unknowns stress(at.size()), rate(at.size()); // displacement with damping; velocity
    for (std::size_t k = 0; k < at.size(); ++k)
    {
      const bool is_along = k % 3 == 0;
      rate[k] = is_along ? (half[k] - field_half[k]) / step : (at[k] - field_before[k]) / step;
      stress[k] = (is_along ? field_half[k] : at[k]) + damping.stiffness * rate[k];
    }
    field_before.swap(at);
    field_half.swap(half);
    Unknowns inside[2], outside[2], f_inside(stress.size()), f_outside(stress.size());
    strip->separate(stress, inside[0], outside[0]);
    strip->separate(rate, inside[1], outside[1]);
    strip->stiffness.multiply(inside[0].data(), f_inside.data());
    strip->stiffness.multiply(outside[0].data(), f_outside.data());
    for (const bool is_inside : {true, false})
    {
      const Unknowns &velocity = is_inside ? inside[1] : outside[1];
      Unknowns       &f = is_inside ? f_inside : f_outside;
      coupling_of_strip.add_along(velocity, f);
      coupling_of_strip.add_across(velocity, f);
    }
    strip->gather(f_inside, f_outside, force);
  }

  void ObliqueSection::substep(const double later)
  {
    const double      step = dt / n_substeps;
    const std::size_t n = mass.size();
    set_forces_of_zone(later, step);
    for (std::size_t k = 0; k < x.size(); ++k)
      x[k] = u[k] + damping.stiffness * w[k];
    stiffness.multiply(x.data(), K_x.data());
    coupling.add_along(w, K_x);
    const std::vector<bool> none(u.size(), false);
    const Unknowns          empty;
    std::vector<double>     no_work;
    boundary->advance(
        {step, damping, mass, none, u, K_x, empty, empty, empty, empty, empty, empty, w, no_work});
    const auto move = [&](const std::size_t k, const double m)
    {
      if (is_explicit[k / 3])
        w[k] += step / m * (force[k] - K_x[k] - damping.mass * mass[k / 3] * w[k]);
    };
    for (std::size_t i = 0; i < n; ++i)
      move(3 * i, mass_along[i]);
    coupling.add_across(w, K_x);
    for (std::size_t i = 0; i < n; ++i)
      for (const unsigned int c : {1u, 2u})
        move(3 * i + c, mass_across[i]);
    for (std::size_t k = 0; k < u.size(); ++k)
      u[k] += step * w[k];
  }

  void ObliqueSection::end_step()
  {
    for (unsigned int k = 0; k < n_substeps; ++k)
      substep(k * dt / n_substeps);
    strip->field.advance();
    clock[0] += 1.;
    std::copy(u.begin(), u.end(), ring.begin() + u.size() * (std::size_t(clock[0]) % n_kept));
  }

  Vector3 ObliqueSection::displacement(const unsigned int node, const double at_x) const
  {
    const double step = clock[0] - lead - p * (at_x - origin) / dt;
    Vector3      result;
    for (unsigned int c = 0; c < 3; ++c)
      result[c] = cubic_in_time(step + (c == 0 ? .5 / n_substeps : 0.), [&](const std::size_t k)
                                { return ring[u.size() * (k % n_kept) + 3 * std::size_t(node) + c]; });
    return result;
  }

  std::vector<std::vector<double> *> ObliqueSection::state()
  {
    auto arrays = strip->field.state();
    for (std::vector<double> *array : {&u, &w, &field_before, &field_half, &clock, &ring})
      arrays.push_back(array);
    for (auto *array : boundary->state())
      arrays.push_back(array);
    return arrays;
  }
} // namespace Voussoir
