#include <voussoir/newmark.h>

#include <voussoir/error.h>

#include <algorithm>
#include <cmath>

namespace Voussoir
{
  namespace
  {
    Vector3 get(const Unknowns &x, const std::size_t i)
    {
      return {{x[3 * i], x[3 * i + 1], x[3 * i + 2]}};
    }

    void set(Unknowns &x, const std::size_t i, const Vector3 &value)
    {
      std::copy(value.begin(), value.end(), x.begin() + 3 * i);
    }

    double dot(const Vector3 &a, const Vector3 &b)
    {
      return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    }

    /** Forces that make the marked rows of H f + b zero; the other rows carry none. */
    Vector3 tie_rows(Matrix3 H, Vector3 b, const std::array<bool, 3> &tied)
    {
      for (unsigned int i = 0; i < 3; ++i)
        if (!tied[i])
        {
          for (unsigned int j = 0; j < 3; ++j)
            H[3 * i + j] = H[3 * j + i] = 0.;
          H[4 * i] = 1.;
          b[i] = 0.;
        }
      const Vector3 f = inverse(H) * b;
      return {{-f[0], -f[1], -f[2]}};
    }
  } // namespace

  ImpactRule impact_rule(const std::string &name)
  {
    if (name == "impulse-consistent")
      return ImpactRule::impulse_consistent;
    if (name == "paper")
      return ImpactRule::paper;
    if (name == "none")
      return ImpactRule::none;
    throw InputError("There is no impact rule \"" + name + "\". The rules are: " + impact_rule_names() + ".");
  }

  std::string impact_rule_names()
  {
    return "impulse-consistent|paper|none";
  }

  double Energy::balance(const Energy &start) const
  {
    return (kinetic - start.kinetic) + (added_mass - start.added_mass) + (strain - start.strain) + damping +
           friction + impact - input;
  }

  Newmark::Newmark(const Structure &structure, const JointLaws &laws, const ContactParameters &parameters,
                   const double dt, const ImpactRule rule)
      : structure(structure), laws(laws), dt(dt), rule(rule),
        system(structure, laws, parameters, 4. / (dt * dt) + 2. / dt * structure.mass_damping,
               1. + 2. / dt * structure.stiffness_damping, 2. / dt)
  {
    for (const Matrix3 &m : structure.mass)
      inverse_mass.push_back(inverse(m));
    std::vector<bool> in_pair(structure.n_nodes(), false);
    for (const Pair &pair : structure.pairs)
    {
      Matrix3 H{};
      for (const unsigned int node : {pair.node_1, pair.node_2})
        if (node != rigid_ground)
        {
          if (in_pair[node])
            throw InputError(
                "A node of the mesh near (" + std::to_string(pair.place[0]) + ", " +
                std::to_string(pair.place[1]) + ", " + std::to_string(pair.place[2]) +
                ") belongs to two joints. Joints must not cross or share nodes of one monolith.");
          in_pair[node] = true;
          for (unsigned int j = 0; j < 3; ++j)
          {
            const Vector3 Mq = inverse_mass[node] * pair.frame[j];
            for (unsigned int i = 0; i < 3; ++i)
              H[3 * i + j] += dot(pair.frame[i], Mq);
          }
        }
      pair_inverse.push_back(H);
    }
  }

  void Newmark::add_kick(const Pair &pair, const Vector3 &f, Unknowns &v) const
  {
    Vector3 x;
    for (unsigned int c = 0; c < 3; ++c)
      x[c] = pair.frame[0][c] * f[0] + pair.frame[1][c] * f[1] + pair.frame[2][c] * f[2];
    for (const unsigned int node : {pair.node_1, pair.node_2})
      if (node != rigid_ground)
      {
        const Vector3 kick = inverse_mass[node] * x;
        for (unsigned int c = 0; c < 3; ++c)
          v[3 * node + c] += (node == pair.node_2 ? 1. : -1.) * kick[c];
      }
  }

  void Newmark::start(const Unknowns &u, const Unknowns &v, const Unknowns &force, const Unknowns &load,
                      const Unknowns &reference_jump)
  {
    reference = reference_jump;
    impulse.assign(force.size(), 0.);
    now = DynamicState();
    now.u = u;
    now.v = v;
    now.load = load;
    now.force = force;
    structure.multiply_stiffness(now.u, now.Ku, now.v, now.Kv);
    now.a.assign(u.size(), 0.);
    Unknowns f = load; // M a = load + G^T force - C v - K u
    for (std::size_t p = 0; p < structure.pairs.size(); ++p)
      structure.add_pair_force(structure.pairs[p], get(force, p), f);
    for (unsigned int i = 0; i < structure.n_nodes(); ++i)
    {
      const Vector3 Mv = structure.mass[i] * get(now.v, i);
      for (unsigned int c = 0; c < 3; ++c)
        f[3 * i + c] -= structure.mass_damping * Mv[c] + structure.stiffness_damping * now.Kv[3 * i + c] +
                        (structure.dashpots.empty() ? 0. : structure.dashpots[3 * i + c] * v[3 * i + c]) +
                        now.Ku[3 * i + c];
      set(now.a, i, inverse_mass[i] * get(f, i));
    }
    account_states();
    first = now.energy;
    largest = 0.;
  }

  void Newmark::resume(const DynamicState &state, const Energy &first_energy, const double largest_so_far,
                       const Unknowns &reference_jump)
  {
    first = first_energy;
    largest = largest_so_far;
    reference = reference_jump;
    impulse.assign(state.force.size(), 0.);
    now = state;
  }

  void Newmark::account_states()
  {
    double kinetic = 0., water = 0., strain = 0.;
    for (unsigned int i = 0; i < structure.n_nodes(); ++i)
    {
      const Vector3 v = get(now.v, i);
      kinetic += .5 * dot(v, structure.mass[i] * v);
      if (!structure.added_mass.empty())
        water += .5 * dot(v, structure.added_mass[i] * v);
      strain += .5 * dot(get(now.u, i), get(now.Ku, i));
    }
    now.energy.kinetic = kinetic - water;
    now.energy.added_mass = water;
    now.energy.strain = strain;
  }

  Vector3 Newmark::opening_and_slip(const unsigned int pair) const
  {
    const Vector3 jump = structure.jump(structure.pairs[pair], now.u), r = get(reference, pair);
    return {{jump[0] - r[0], jump[1] - r[1], jump[2] - r[2]}};
  }

  double Newmark::energy_error() const
  {
    return largest > 0. ? std::abs(now.energy.balance(first)) / largest : 0.;
  }

  ContactResult Newmark::advance(const Unknowns &load)
  {
    const std::size_t n = structure.n_nodes(), n_pairs = structure.pairs.size();
    const double      c_m = 2. / dt * structure.mass_damping, c_k = structure.stiffness_damping;

    // Predictor: rhs = load + M (4/dt^2 u + 4/dt v + a) + C (2/dt u + v); for the trapezoidal rule alone, K a
    // is not needed.
    Unknowns rhs(3 * n);
#pragma omp parallel for schedule(static)
    for (int i = 0; i < static_cast<int>(n); ++i)
    {
      Vector3 x;
      for (unsigned int c = 0; c < 3; ++c)
      {
        const std::size_t k = 3 * i + c;
        x[c] = (4. / (dt * dt) + c_m) * now.u[k] + (4. / dt + structure.mass_damping) * now.v[k] + now.a[k];
      }
      const Vector3 Mx = structure.mass[i] * x;
      for (unsigned int c = 0; c < 3; ++c)
      {
        const std::size_t k = 3 * i + c;
        rhs[k] = load[k] + Mx[c] + c_k * (2. / dt * now.Ku[k] + now.Kv[k]);
        if (!structure.dashpots.empty())
          rhs[k] += structure.dashpots[k] * (2. / dt * now.u[k] + now.v[k]);
      }
    }

    Unknowns offset(3 * n_pairs), force = now.force, u_new;
    for (std::size_t p = 0; p < n_pairs; ++p)
    {
      const Vector3 before = structure.jump(structure.pairs[p], now.u);
      offset[3 * p] = -reference[3 * p];
      for (unsigned int c = 1; c < 3; ++c)
        offset[3 * p + c] = laws.of_pair[p]->is_tangentially_tied() ? -reference[3 * p + c] : -before[c];
    }
    const ContactResult result = system.solve(rhs, offset, force, gap, u_new);
    if (!result.converged)
      throw ComputationError("The joint conditions did not converge at t = " + std::to_string(now.time + dt) +
                             " s: relative residual " + std::to_string(result.residual) + " after " +
                             std::to_string(result.iterations) +
                             " Newton steps. A smaller time step usually helps (entry \"Time step\").");

    // Newmark's velocity and acceleration, and the work of this step (exact for the trapezoidal rule).
    Energy  &energy = now.energy;
    Unknowns v_old = now.v, Ku_old = now.Ku, Kv_old = now.Kv;
    double   input = 0., damping = 0.;
    now.time += dt;
    for (std::size_t k = 0; k < 3 * n; ++k)
    {
      const double du = u_new[k] - now.u[k];
      if (!(std::abs(du) < 1e30))
        throw ComputationError("The displacements are not finite at t = " + std::to_string(now.time) + " s.");
      now.v[k] = 2. / dt * du - v_old[k];
      now.a[k] = 4. / (dt * dt) * du - 4. / dt * v_old[k] - now.a[k];
      input += .5 * (load[k] + now.load[k]) * du;
    }
    double friction = 0., opening = 0.;
    for (std::size_t p = 0; p < n_pairs; ++p)
    {
      const Vector3 before = structure.jump(structure.pairs[p], now.u),
                    after = structure.jump(structure.pairs[p], u_new);
      for (unsigned int c = 0; c < 3; ++c)
        (c == 0 ? opening : friction) -=
            .5 * (now.force[3 * p + c] + force[3 * p + c]) * (after[c] - before[c]);
    }
    Unknowns u_old(u_new);
    u_old.swap(now.u); // now.u is the new one
    now.load = load;

    impulse.assign(3 * n_pairs, 0.);
    for (std::size_t k = 0; k < 3 * n_pairs; ++k)
      impulse[k] = .5 * dt * (now.force[k] + force[k]);
    double     kinetic_before = 0., kinetic_after = 0.;
    const auto kinetic_of_pairs = [&]
    {
      double sum = 0.;
      for (const Pair &pair : structure.pairs)
        for (const unsigned int node : {pair.node_1, pair.node_2})
          if (node != rigid_ground)
            sum += .5 * dot(get(now.v, node), structure.mass[node] * get(now.v, node));
      return sum;
    };
    const Unknowns v_newmark = now.v;
    kinetic_before = kinetic_of_pairs();
    if (rule != ImpactRule::none && n_pairs > 0)
      correct_velocity();
    kinetic_after = kinetic_of_pairs();

    structure.multiply_stiffness(now.u, now.Ku, now.v, now.Kv);
    for (std::size_t k = 0; k < 3 * n; ++k)
    {
      // K times Newmark's velocity, without another product
      const double Kv = 2. / dt * (now.Ku[k] - Ku_old[k]) - Kv_old[k], du = now.u[k] - u_old[k];
      damping += .5 * structure.stiffness_damping * (Kv + Kv_old[k]) * du;
      if (!structure.dashpots.empty())
        damping += .5 * structure.dashpots[k] * (v_newmark[k] + v_old[k]) * du;
    }
    if (structure.mass_damping > 0.)
      for (std::size_t i = 0; i < n; ++i)
      {
        Vector3 v;
        for (unsigned int c = 0; c < 3; ++c)
          v[c] = v_newmark[3 * i + c] + v_old[3 * i + c];
        const Vector3 Mv = structure.mass[i] * v; // du = dt/2 (v_old + v_newmark)
        damping += .5 * structure.mass_damping * .5 * dt * dot(v, Mv);
      }
    energy.input += input;
    energy.damping += damping;
    energy.friction += friction;
    energy.impact += opening + kinetic_before - kinetic_after;

    if (rule == ImpactRule::none)
      now.force = force;
    else if (n_pairs > 0)
      find_acceleration(force);
    account_states();
    largest = std::max({largest, std::abs(energy.input), energy.kinetic + energy.added_mass,
                               first.kinetic, std::abs(energy.strain - first.strain), energy.damping});
    return result;
  }

  void Newmark::correct_velocity()
  {
    for (std::size_t p = 0; p < structure.pairs.size(); ++p)
    {
      const Pair     &pair = structure.pairs[p];
      const JointLaw &law = *laws.of_pair[p];
      const bool      closed = system.states()[p] != PairState::open;
      if (!closed && !law.is_tangentially_tied())
        continue;
      const Vector3 jump = structure.jump(pair, now.v);
      if (rule == ImpactRule::paper)
      {
        const bool tied = law.is_tangentially_tied() || system.states()[p] == PairState::stick;
        const Vector3 f = tie_rows(pair_inverse[p], jump, {{closed, tied, tied}});
        add_kick(pair, f, now.v);
        for (unsigned int c = 0; c < 3; ++c)
          impulse[3 * p + c] += f[c];
        continue;
      }
      // The velocity without any joint force of this step, then the impulse that the law allows.
      Vector3 change, before = pair_inverse[p] * get(impulse, p);
      for (unsigned int c = 0; c < 3; ++c)
        before[c] = jump[c] - before[c];
      const Vector3 allowed = law.solve(pair_inverse[p], before, closed);
      for (unsigned int c = 0; c < 3; ++c)
        change[c] = allowed[c] - impulse[3 * p + c];
      add_kick(pair, change, now.v);
      set(impulse, p, allowed);
    }
  }

  void Newmark::find_acceleration(const Unknowns &force)
  {
    // Without joint forces: M a = load - C v - K u at all nodes.
    const std::size_t n = structure.n_nodes();
    double            fastest = 0.;
    for (std::size_t i = 0; i < n; ++i)
    {
      Vector3 f = structure.mass[i] * get(now.v, i);
      for (unsigned int c = 0; c < 3; ++c)
      {
        const std::size_t k = 3 * i + c;
        f[c] = now.load[k] - structure.mass_damping * f[c] - structure.stiffness_damping * now.Kv[k] -
               now.Ku[k] - (structure.dashpots.empty() ? 0. : structure.dashpots[k] * now.v[k]);
        fastest = std::max(fastest, std::abs(now.v[k]));
      }
      set(now.a, i, inverse_mass[i] * f);
    }
    if (rule == ImpactRule::paper)
      for (std::size_t p = 0; p < structure.pairs.size(); ++p)
        add_kick(structure.pairs[p], get(force, p), now.a);

    const double still = std::max(1e-9 * fastest, 1e-12);
    for (std::size_t p = 0; p < structure.pairs.size(); ++p)
    {
      const Pair     &pair = structure.pairs[p];
      const JointLaw &law = *laws.of_pair[p];
      const bool      closed = system.states()[p] != PairState::open;
      const Vector3   jump = structure.jump(pair, now.a);
      Vector3         f = {{0., 0., 0.}}, result = {{0., 0., 0.}};
      if (rule == ImpactRule::paper)
      {
        const bool tied = law.is_tangentially_tied() || (closed && system.states()[p] == PairState::stick);
        f = tie_rows(pair_inverse[p], jump, {{closed, tied, tied}});
        for (unsigned int c = 0; c < 3; ++c)
          result[c] = force[3 * p + c] + f[c];
      }
      else if (closed || law.is_tangentially_tied())
        result = f =
            law.solve_acceleration(pair_inverse[p], jump, structure.jump(pair, now.v), still, closed);
      add_kick(pair, f, now.a);
      set(now.force, p, result);
    }
  }
} // namespace Voussoir
