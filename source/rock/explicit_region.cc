#include <voussoir/base/error.h>
#include <voussoir/rock/explicit_region.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace Voussoir
{
  double largest_frequency(const BlockSparseMatrix &stiffness, const std::vector<double> &mass)
  {
    const int n = 3 * static_cast<int>(stiffness.n_rows());
    Unknowns  scaled(n), x(n), y(n); // of D K D with D = M^(-1/2), which is symmetric
    double    norm = 0.;
    for (int i = 0; i < n; ++i)
    {
      scaled[i] = mass[i / 3] > 0. ? 1. / std::sqrt(mass[i / 3]) : 0.;
      x[i] = 1. + .5 * std::sin(12.9898 * i); // smooth and rough parts
      norm += x[i] * x[i];
    }
    for (double &value : x)
      value /= std::sqrt(norm);
    double           value = 0., residual = 0.;
    constexpr double enough = 1e-2;
    for (unsigned int iteration = 0; iteration < 1000; ++iteration)
    {
      Unknowns z(n);
      for (int i = 0; i < n; ++i)
        z[i] = scaled[i] * x[i];
      stiffness.multiply(z.data(), y.data());
      double product = 0., square = 0.;
      for (int i = 0; i < n; ++i)
      {
        y[i] *= scaled[i];
        product += x[i] * y[i];
        square += y[i] * y[i];
      }
      value = product;
      residual = std::sqrt(std::max(0., square - value * value));
      if (square == 0.)
        return 0.;
      for (int i = 0; i < n; ++i)
        x[i] = y[i] / std::sqrt(square);
      if (residual < enough * value)
        break;
    }
    return std::sqrt(value + residual);
  }

  double critical_time_step(const double w, const RayleighDamping &damping)
  {
    const double xi = .5 * (damping.mass / w + damping.stiffness * w);
    return 2. * (std::sqrt(1. + xi * xi) - xi) / w;
  }

  ExplicitRegion::ExplicitRegion(BlockSparseMatrix matrix, std::vector<double> masses,
                                 const RayleighDamping &damping, const double dt)
      : stiffness(std::move(matrix)), mass(std::move(masses)), damping(damping), dt(dt)
  {
    dt_critical = Voussoir::critical_time_step(largest_frequency(stiffness, mass), damping);
    if (dt > dt_critical)
    {
      char text[300];
      std::snprintf(text, sizeof(text),
                    "the time step %g s is too large for the rock, which is integrated explicitly: its "
                    "critical time step is %g s; use a smaller time step, larger cells of rock, or less "
                    "stiffness-proportional damping",
                    dt, dt_critical);
      throw InputError(text);
    }
    u.assign(3 * std::size_t(n_nodes()), 0.);
    w = K_x = u;
    x = u;
    is_fixed.assign(u.size(), false);
    inverse_mass.resize(u.size());
    for (std::size_t i = 0; i < u.size(); ++i)
      inverse_mass[i] = 1. / mass[i / 3];
  }

  void ExplicitRegion::fix(const std::vector<unsigned int> &components)
  {
    for (const unsigned int i : components)
    {
      inverse_mass[i] = 0.;
      is_fixed[i] = true;
    }
  }

  void ExplicitRegion::fix_nodes(const std::vector<unsigned int> &nodes)
  {
    for (const unsigned int node : nodes)
      fix({3 * node, 3 * node + 1, 3 * node + 2});
  }

  namespace
  {
    void exclude(std::vector<double> &inverse_mass, const unsigned int node)
    {
      std::fill_n(inverse_mass.begin() + 3 * std::size_t(node), 3, 0.);
    }
  } // namespace

  void ExplicitRegion::set_boundary(TransmittingBoundary boundary)
  {
    transmitting = std::make_unique<TransmittingBoundary>(std::move(boundary));
    for (unsigned int line = 0; line < transmitting->n_lines(); ++line)
    {
      boundary_nodes.push_back(transmitting->boundary_node(line));
      exclude(inverse_mass, boundary_nodes.back());
    }
    boundary_w.resize(3 * boundary_nodes.size());
    check_prescribed();
  }

  void ExplicitRegion::check_prescribed() const
  {
    if (transmitting && !prescribed.empty())
      check_distance(*transmitting, prescribed, n_nodes());
  }

  void ExplicitRegion::set_boundary(std::vector<Dashpot> list)
  {
    dashpots = std::move(list);
    for (const Dashpot &dashpot : dashpots)
    {
      exclude(inverse_mass, dashpot.node);
      Matrix3 effective;
      for (unsigned int i = 0; i < 9; ++i)
        effective[i] = .5 * dt * dashpot.damping[i] + (i % 4 == 0 ? mass[dashpot.node] : 0.);
      dashpot_inverse.push_back(inverse(effective));
      dashpot_neighbours.push_back(dashpot.node);
      for (std::size_t k = stiffness.start[dashpot.node]; k < stiffness.start[dashpot.node + 1]; ++k)
        dashpot_neighbours.push_back(stiffness.column[k]);
    }
    std::sort(dashpot_neighbours.begin(), dashpot_neighbours.end());
    dashpot_neighbours.erase(std::unique(dashpot_neighbours.begin(), dashpot_neighbours.end()),
                             dashpot_neighbours.end());
    const auto number = [&](const unsigned int node) -> unsigned int
    {
      return std::lower_bound(dashpot_neighbours.begin(), dashpot_neighbours.end(), node) -
             dashpot_neighbours.begin();
    };
    for (const Dashpot &dashpot : dashpots)
    {
      own_number.push_back(number(dashpot.node));
      first_neighbour.push_back(neighbour_number.size());
      for (std::size_t k = stiffness.start[dashpot.node]; k < stiffness.start[dashpot.node + 1]; ++k)
        neighbour_number.push_back(number(stiffness.column[k]));
    }
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
    check_prescribed();
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
    // The displacement y whose backward difference gives the predicted stress: y + b0 (y - y_old)/dt = u + b0
    // v.
    const double ratio = damping.stiffness / dt;
    for (std::size_t i = 0; i < prescribed.size(); ++i)
      for (unsigned int c = 0; c < 3; ++c)
      {
        const std::size_t k = 3 * std::size_t(prescribed[i]) + c;
        const double      y =
            (u_new[3 * i + c] + damping.stiffness * v_new[3 * i + c] + ratio * u[k]) / (1. + ratio);
        prescribed_w[3 * i + c] = w[k];
        w[k] = (y - u[k]) / dt;
      }
  }

  const Unknowns &ExplicitRegion::advance(const Unknowns &u_prescribed, const Unknowns &v_prescribed)
  {
    if (clock[0] == 0.)
      advance_boundary();
    if (!prescribed.empty())
      move_prescribed(u_prescribed, v_prescribed);
    const bool with_energy = !K_u.empty();
    if (with_energy)
    {
      work[gone_through_boundary] -= work_at(boundary_nodes, boundary_w);
      work[done_by_prescribed] += work_at(prescribed, prescribed_w);
    }
    const int n = u.size();
#pragma omp parallel for simd schedule(static)
    for (int i = 0; i < n; ++i)
    {
      u[i] += dt * w[i];
      x[i] = u[i] + damping.stiffness * w[i];
    }
    stiffness.multiply(x.data(), K_x.data());
    clock[0] += 1.;
    for (std::size_t i = 0; i < prescribed.size(); ++i)
      for (unsigned int c = 0; c < 3; ++c)
        prescribed_force[3 * i + c] = K_x[3 * std::size_t(prescribed[i]) + c] +
                                      damping.mass * prescribed_mass[i] * v_prescribed[3 * i + c];
    if (free_field)
    {
      field_before.swap(field);
      field.swap(field_next);
      free_field->advance();
      free_field->evaluate(field_next);
    }
    if (with_energy)
      step_explicit_nodes<true>();
    else
      step_explicit_nodes<false>();
    step_dashpots();
    advance_boundary();
    return prescribed_force;
  }

  template <bool with_energy> void ExplicitRegion::step_explicit_nodes()
  {
    const int    n = u.size();
    const bool   loaded = !force.empty();
    const double ratio = damping.stiffness / dt;
    double       kinetic = 0., strain = 0., lost = 0., external = 0.;
#pragma omp parallel for simd schedule(static) reduction(+ : kinetic, strain, lost, external)
    for (int i = 0; i < n; ++i)
    {
      const double f = loaded ? force[i] : 0., old = w[i];
      const double free = inverse_mass[i] != 0. ? 1. : 0.;
      w[i] += dt * (inverse_mass[i] * (f - K_x[i]) - free * damping.mass * old);
      if (with_energy)
      {
        const double m = mass[i / 3];
        K_u[i] = (K_x[i] + ratio * K_u[i]) / (1. + ratio);
        const double damped = damping.mass * m * old + K_x[i] - K_u[i], twice = old + free * w[i];
        kinetic += m * old * old;
        strain += (u[i] - dt * old) * K_u[i];
        lost += damped * twice;
        external += f * twice;
      }
    }
    if (with_energy)
    {
      // Until now; what follows belongs to the next half step.
      account.damping = work[lost_in_damping];
      account.external = work[done_by_forces];
      account.transmitted = work[gone_through_boundary];
      account.prescribed = work[done_by_prescribed];
      account.kinetic = .5 * kinetic;
      account.strain = .5 * strain;
      work[lost_in_damping] += .5 * dt * lost;
      work[done_by_forces] += .5 * dt * external;
    }
  }

  double ExplicitRegion::work_at(const std::vector<unsigned int> &nodes, const Unknowns &w_before)
  {
    double sum = 0.;
    for (std::size_t i = 0; i < nodes.size(); ++i)
      for (unsigned int c = 0; c < 3; ++c)
      {
        const std::size_t k = 3 * std::size_t(nodes[i]) + c;
        const double      m = mass[nodes[i]], old = w_before[3 * i + c], f = force.empty() ? 0. : force[k];
        const double      reaction = m * ((w[k] - old) / dt + damping.mass * old) + K_x[k] - f;
        sum += .5 * dt * reaction * (old + w[k]);
        work[lost_in_damping] += .5 * dt * (damping.mass * m * old + K_x[k] - K_u[k]) * w[k];
        work[done_by_forces] += .5 * dt * f * w[k];
      }
    return sum;
  }

  void ExplicitRegion::advance_boundary()
  {
    if (!transmitting)
      return;
    const Unknowns &next = transmitting->advance(u, field, field_next);
    for (std::size_t i = 0; i < boundary_nodes.size(); ++i)
      for (unsigned int c = 0; c < 3; ++c)
      {
        const std::size_t k = 3 * std::size_t(boundary_nodes[i]) + c;
        boundary_w[3 * i + c] = w[k];
        w[k] = (next[3 * i + c] - u[k]) / dt;
      }
  }

  /** Force of the free field on a dashpot's node: what keeps it moving as if there were no boundary. */
  Vector3 ExplicitRegion::free_field_force(const unsigned int d) const
  {
    const Dashpot &dashpot = dashpots[d];
    const auto     at = [&](const Unknowns &values, const std::size_t i) {
      return Vector3{{values[3 * i], values[3 * i + 1], values[3 * i + 2]}};
    };
    Vector3    f{};
    const auto add = [&](const Matrix3 &a, const Vector3 &b)
    {
      const Vector3 ab = a * b;
      for (unsigned int c = 0; c < 3; ++c)
        f[c] += ab[c];
    };
    std::size_t neighbour = first_neighbour[d];
    for (std::size_t k = stiffness.start[dashpot.node]; k < stiffness.start[dashpot.node + 1]; ++k)
    {
      const unsigned int i = neighbour_number[neighbour++];
      Vector3            stress = at(field, i), before = at(field_before, i);
      for (unsigned int c = 0; c < 3; ++c)
        stress[c] += damping.stiffness / dt * (stress[c] - before[c]);
      add(stiffness.value[k], stress);
    }
    const std::size_t own = own_number[d];
    const Vector3     before = at(field_before, own), now = at(field, own), next = at(field_next, own);
    const double      m = mass[dashpot.node];
    Vector3           v;
    for (unsigned int c = 0; c < 3; ++c)
    {
      v[c] = (next[c] - before[c]) / (2. * dt);
      f[c] +=
          m * ((next[c] - 2. * now[c] + before[c]) / (dt * dt) + damping.mass * (now[c] - before[c]) / dt);
    }
    add(dashpot.damping, v);
    add(dashpot.stiffness, now);
    return f;
  }

  void ExplicitRegion::step_dashpots()
  {
    if (dashpots.empty())
      return;
    const int  n = dashpots.size();
    const bool with_energy = !K_u.empty(), loaded = !force.empty();
    double     transmitted = 0., lost = 0., external = 0.;
#pragma omp parallel for schedule(static) reduction(+ : transmitted, lost, external)
    for (int d = 0; d < n; ++d)
    {
      const Dashpot    &dashpot = dashpots[d];
      const std::size_t first = 3 * std::size_t(dashpot.node);
      const double      m = mass[dashpot.node];
      const Vector3     old = {{w[first], w[first + 1], w[first + 2]}},
                    now = {{u[first], u[first + 1], u[first + 2]}};
      Vector3       boundary = free_field ? free_field_force(d) : Vector3{};
      const Vector3 spring = dashpot.stiffness * now, drag = dashpot.damping * old;
      Vector3       f;
      for (unsigned int c = 0; c < 3; ++c)
      {
        boundary[c] -= spring[c];
        f[c] = boundary[c] - drag[c] - K_x[first + c] - damping.mass * m * old[c] +
               (loaded ? force[first + c] : 0.);
      }
      const Vector3 a = dashpot_inverse[d] * f;
      Vector3       v;
      for (unsigned int c = 0; c < 3; ++c)
      {
        if (!is_fixed[first + c])
          w[first + c] += dt * a[c];
        v[c] = .5 * (old[c] + w[first + c]);
      }
      const Vector3 dragged = dashpot.damping * v;
      for (unsigned int c = 0; with_energy && c < 3; ++c)
      {
        const std::size_t k = first + c;
        transmitted += dt * v[c] * (dragged[c] - boundary[c]);
        lost += .5 * dt * (damping.mass * m * old[c] + K_x[k] - K_u[k]) * w[k];
        external += loaded ? .5 * dt * force[k] * w[k] : 0.;
      }
    }
    work[gone_through_boundary] += transmitted;
    work[lost_in_damping] += lost;
    work[done_by_forces] += external;
  }

  Unknowns ExplicitRegion::velocity() const
  {
    Unknowns  v = w;
    const int n = v.size();
#pragma omp parallel for schedule(static)
    for (int i = 0; i < n; ++i)
      if (inverse_mass[i] != 0.) // half a step back, by the acceleration a: w = w_before + dt a
      {
        const double f = (force.empty() ? 0. : force[i]) - K_x[i];
        const double before = (w[i] - dt * inverse_mass[i] * f) / (1. - dt * damping.mass);
        v[i] = .5 * (before + w[i]);
      }
    for (std::size_t i = 0; i < boundary_w.size(); ++i)
    {
      const std::size_t k = 3 * std::size_t(boundary_nodes[i / 3]) + i % 3;
      v[k] = .5 * (boundary_w[i] + w[k]);
    }
    return v;
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
    for (std::size_t i = 0; i < u.size(); ++i)
      x[i] = u[i] + dt * w[i];
    stiffness.multiply(x.data(), K_x.data());
    for (std::size_t i = 0; i < u.size(); ++i)
      work[done_by_forces] += .5 * (mass[i / 3] * w[i] * w[i] + u[i] * K_x[i]);
    stiffness.multiply(u.data(), K_u.data());
    std::fill(K_x.begin(), K_x.end(), 0.);
  }

  std::vector<std::vector<double> *> ExplicitRegion::state()
  {
    std::vector<std::vector<double> *> arrays = {
        &clock, &work, &u, &w, &K_x, &K_u, &field, &field_before, &field_next, &boundary_w, &prescribed_w};
    if (transmitting)
      for (auto *array : transmitting->state())
        arrays.push_back(array);
    if (free_field)
      for (auto *array : free_field->state())
        arrays.push_back(array);
    return arrays;
  }
} // namespace Voussoir
