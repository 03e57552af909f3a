// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/error.h>
#include <voussoir/rock/explicit_region.h>
#include <voussoir/solid/critical_step.h>

#include <algorithm>
#include <sstream>

namespace Voussoir
{
  std::string beyond_critical_step(const double dt, const double critical)
  {
    std::ostringstream text;
    text << "The time step " << dt
         << " s is too large for the rock, which is integrated explicitly: its critical time step is "
         << critical << " s.";
    return text.str();
  }

  ExplicitRegion::ExplicitRegion(RockOperator matrix, std::vector<double> masses, const RockDamping &damping,
                                 const double dt)
      : stiffness(std::move(matrix)), mass(std::move(masses)), damping(damping), dt(dt)
  {
    dt_critical = Voussoir::critical_time_step(largest_frequency(stiffness, mass), damping);
    if (!(dt <= dt_critical)) // or not a number
      throw InputError(beyond_critical_step(dt, dt_critical) +
                       " Increase \"Dynamics/Steps per sample\", enlarge the rock elements, or reduce "
                       "\"Foundation/Stiffness damping\".");
    u.assign(3 * std::size_t(n_nodes()), 0.);
    w = K_x = u;
    x = u;
    damped = DampedMotion(damping, dt, u.size());
    pieces = split.pieces(n_nodes());
    work.assign(n_region_works * ((n_nodes() + per_chunk - 1) / per_chunk), 0.);
    account.assign((n_energies + n_region_works) * (work.size() / n_region_works), 0.);
    is_fixed.assign(u.size(), false);
    inverse_mass.resize(u.size());
    for (std::size_t i = 0; i < u.size(); ++i)
      inverse_mass[i] = 1. / mass[i / 3];
  }

  void ExplicitRegion::keep_energy()
  {
    K_u.assign(u.size(), 0.);
    damped.keep_energy();
  }

  void ExplicitRegion::fix(const std::vector<unsigned int> &components)
  {
    for (const unsigned int i : components)
    {
      inverse_mass[i] = 0.;
      is_fixed[i] = true;
    }
  }

  namespace
  {
    void exclude(std::vector<double> &inverse_mass, const unsigned int node)
    {
      std::fill_n(inverse_mass.begin() + 3 * std::size_t(node), 3, 0.);
    }
  } // namespace

  void ExplicitRegion::set_boundary(std::unique_ptr<ArtificialBoundary> given)
  {
    boundary = std::move(given);
    for (const unsigned int node : boundary->nodes())
      exclude(inverse_mass, node);
    boundary_w.resize(3 * boundary->nodes().size());
    boundary_kept = all_of(boundary->nodes().size());
    if (!prescribed.empty())
      boundary->check_prescribed(prescribed);
  }

  void ExplicitRegion::set_free_field(std::unique_ptr<IncidentField> motion)
  {
    free_field = std::move(motion);
    free_field->evaluate(field);
    field_before = field;
    free_field->advance();
    free_field->evaluate(field_next);
  }

  void ExplicitRegion::set_prescribed(const std::vector<unsigned int> &nodes)
  {
    prescribed = nodes;
    if (boundary)
      boundary->check_prescribed(prescribed);
    for (const unsigned int node : nodes)
    {
      exclude(inverse_mass, node);
      prescribed_mass.push_back(mass[node]);
      mass[node] = 0.;
    }
    prescribed_force.assign(3 * nodes.size(), 0.);
    prescribed_w = prescribed_force;
  }

  void ExplicitRegion::move_prescribed(const Unknowns &u_new, const Unknowns &v_new)
  {
    // The displacement y whose backward difference gives the predicted stress: y + b (y - y_old)/dt = u + b v.
    // b: stiffness damping relative to the unrelaxed modulus.
    const double b = damping.stiffness / damped.unrelaxed_modulus(), ratio = b / dt;
    for (std::size_t i = 0; i < prescribed.size(); ++i)
      for (unsigned int c = 0; c < 3; ++c)
      {
        const std::size_t k = 3 * std::size_t(prescribed[i]) + c;
        const double      y = (u_new[3 * i + c] + b * v_new[3 * i + c] + ratio * u[k]) / (1. + ratio);
        prescribed_w[3 * i + c] = w[k];
        w[k] = (y - u[k]) / dt;
      }
  }

  const Unknowns &ExplicitRegion::advance(const Unknowns &u_prescribed, const Unknowns &v_prescribed)
  {
    std::vector<Ranks::Message> messages;
    begin_step(u_prescribed, v_prescribed, messages);
    Ranks::exchange(messages);
    return end_step(v_prescribed);
  }

  void ExplicitRegion::begin_step(const Unknowns &u_prescribed, const Unknowns &v_prescribed,
                                  std::vector<Ranks::Message> &messages)
  {
    if (clock[0] == 0. && boundary)
      boundary->start(step_of_boundary());
    if (!prescribed.empty())
      move_prescribed(u_prescribed, v_prescribed);
    if (!K_u.empty())
      add_work_of_motion(step_of_region(), prescribed, all_of(prescribed.size()), prescribed_w,
                         done_by_prescribed, 1.);
    const int n = pieces.size();
#pragma omp parallel for schedule(static)
    for (int p = 0; p < n; ++p)
    {
      const int first = 3 * pieces[p].first, last = 3 * pieces[p].second;
#pragma omp simd
      for (int i = first; i < last; ++i)
        u[i] += dt * w[i];
      damped.advance(u.data(), w.data(), x.data(), first, last);
    }
    stiffness.begin_product(x.data(), K_x.data(), messages);
    if (free_field)
      free_field->begin_step(messages);
  }

  const Unknowns &ExplicitRegion::end_step(const Unknowns &v_prescribed)
  {
    stiffness.end_product(K_x.data());
    clock[0] += 1.;
    for (std::size_t i = 0; i < prescribed.size(); ++i)
      for (unsigned int c = 0; c < 3; ++c)
        prescribed_force[3 * i + c] = K_x[3 * std::size_t(prescribed[i]) + c] +
                                      damping.mass * prescribed_mass[i] * v_prescribed[3 * i + c];
    if (free_field)
    {
      field_before.swap(field);
      field.swap(field_next);
      free_field->end_step();
      free_field->evaluate(field_next);
    }
    if (!K_u.empty())
      step_explicit_nodes<true>();
    else
      step_explicit_nodes<false>();
    if (boundary)
      boundary->advance(step_of_boundary());
    return prescribed_force;
  }

  template <bool with_energy> ExplicitRegion::Sums ExplicitRegion::step_nodes(const int first, const int last)
  {
    const int n = 3 * (last - first), offset = 3 * first;
    double    zeros[3 * per_chunk], masses[3 * per_chunk], is_free[3 * per_chunk]; // of components
    std::fill_n(zeros, n, 0.);
    for (int i = 0; i < n; ++i)
      is_free[i] = inverse_mass[offset + i] != 0.;
    for (int i = 0; with_energy && i < n; ++i)
      masses[i] = mass[first + i / 3];
    const double *load = force.empty() ? zeros : force.data() + offset, *K = K_x.data() + offset,
                 *inverse = inverse_mass.data() + offset, *at = u.data() + offset;
    double      *velocity = w.data() + offset, *stress = with_energy ? K_u.data() + offset : zeros;
    const double stored = with_energy ? damped.elastic(K, at, velocity, stress, offset, n) : 0.;
    const double step = dt, drag = damping.mass;
    double       kinetic = 0., strain = 0., lost = 0., external = 0.;
#pragma omp simd reduction(+ : kinetic, strain, lost, external)
    for (int i = 0; i < n; ++i)
    {
      const double f = load[i], old = velocity[i], free = is_free[i];
      const double now = old + step * (inverse[i] * (f - K[i]) - free * drag * old);
      velocity[i] = now;
      if (with_energy)
      {
        const double m = masses[i], resisting = drag * m * old + K[i] - stress[i], twice = old + free * now;
        kinetic += m * old * old;
        strain += (at[i] - step * old) * stress[i];
        lost += resisting * twice;
        external += f * twice;
      }
    }
    return {{kinetic, strain, lost, external, stored}};
  }

  template <bool with_energy> void ExplicitRegion::step_explicit_nodes()
  {
    const int         n = pieces.size();
    std::vector<Sums> sums(n);
#pragma omp parallel for schedule(static)
    for (int p = 0; p < n; ++p)
      sums[p] = step_nodes<with_energy>(pieces[p].first, pieces[p].second);
    if (!with_energy)
      return;
    constexpr unsigned int n_kept = n_energies + n_region_works;
    account.assign(n_kept * (work.size() / n_region_works), 0.);
    for (std::size_t c = 0; c < work.size() / n_region_works;
         ++c) // works until now; later ones belong to the next step
      std::copy_n(work.begin() + n_region_works * c, +n_region_works,
                  account.begin() + n_kept * c + n_energies);
    for (int p = 0; p < n; ++p)
    {
      const std::size_t c =
          pieces[p].first / per_chunk; // a piece is a complete chunk if this process owns it
      account[n_kept * c] += sums[p][0];
      account[n_kept * c + 1] += sums[p][1];
      account[n_kept * c + 2] += sums[p][4];
      work[n_region_works * c + lost_in_damping] += .5 * dt * sums[p][2];
      work[n_region_works * c + done_by_forces] += .5 * dt * sums[p][3];
    }
  }

  RegionEnergy ExplicitRegion::energy() const
  {
    std::array<double, n_energies + n_region_works> sum{};
    for (std::size_t i = 0; i < account.size(); ++i)
      sum[i % sum.size()] += account[i];
    const double *const works = sum.data() + n_energies;
    RegionEnergy        result;
    result.kinetic = .5 * sum[0];
    result.strain = .5 * (sum[1] + sum[2]);
    result.damping = works[lost_in_damping] - .5 * sum[2];
    result.external = works[done_by_forces];
    result.transmitted = works[gone_through_boundary];
    result.prescribed = works[done_by_prescribed];
    return result;
  }

  RegionStep ExplicitRegion::step_of_region()
  {
    return {dt,    damping,    mass,         is_fixed, u,          K_x, K_u,
            force, boundary_w, field_before, field,    field_next, w,   work};
  }

  RegionStep ExplicitRegion::step_of_boundary()
  {
    const std::vector<unsigned int> &nodes = boundary->nodes();
    for (const unsigned int i : boundary_kept)
      std::copy_n(w.begin() + 3 * std::size_t(nodes[i]), 3, boundary_w.begin() + 3 * std::size_t(i));
    return step_of_region();
  }

  void ExplicitRegion::start(const Unknowns &displacement, const Unknowns &velocity)
  {
    u = displacement;
    w = velocity;
    for (std::size_t i = 0; i < u.size(); ++i)
      if (is_fixed[i])
        w[i] = u[i] = 0.;
    if (K_u.empty())
      return;
    const double s = damped.unrelaxed_modulus();
    for (std::size_t i = 0; i < u.size(); ++i)
      x[i] = s * (u[i] + dt * w[i]);
    stiffness.multiply(x.data(), K_x.data());
    for (std::size_t i = 0; i < u.size(); ++i)
      work[n_region_works * (i / 3 / per_chunk) + done_by_forces] +=
          .5 * (mass[i / 3] * w[i] * w[i] + u[i] * K_x[i]);
    for (std::size_t i = 0; i < u.size(); ++i)
      x[i] = s * u[i];
    stiffness.multiply(x.data(), K_u.data());
    std::fill(K_x.begin(), K_x.end(), 0.);
  }

  std::vector<std::vector<double> *> ExplicitRegion::state()
  {
    std::vector<std::vector<double> *> arrays = {
        &clock, &work,  &account,      &u,          &w,          &K_x,
        &K_u,   &field, &field_before, &field_next, &boundary_w, &prescribed_w};
    for (auto *array : damped.state())
      arrays.push_back(array);
    if (boundary)
      for (auto *array : boundary->state())
        arrays.push_back(array);
    if (free_field)
      for (auto *array : free_field->state())
        arrays.push_back(array);
    return arrays;
  }
} // namespace Voussoir
