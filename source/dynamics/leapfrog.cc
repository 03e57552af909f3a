// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/error.h>
#include <voussoir/base/internal_error.h>
#include <voussoir/base/log.h>
#include <voussoir/base/number_text.h>
#include <voussoir/base/parallel.h>
#include <voussoir/base/ranks.h>
#include <voussoir/dynamics/leapfrog.h>
#include <voussoir/solid/critical_step.h>

#include <algorithm>
#include <cmath>

namespace Voussoir
{
  namespace
  {
    constexpr unsigned int most_sweeps = 2000, most_events = 8;
    constexpr double       enough = 1e-9; ///< relative change of the forces of a cluster

    template <class Array> Array scaled(const Array &a, const double factor)
    {
      Array result = a;
      for (double &x : result)
        x *= factor;
      return result;
    }

    Vector3 sum_of(Vector3 a, const Vector3 &b)
    {
      add(a, b);
      return a;
    }

    [[noreturn]] void throw_not_converged(const double time)
    {
      throw ComputationError(
          "The joint forces where joints cross did not converge at t = " + number_text(time) +
          " s. Reduce \"Dynamics/Explicit step\", or set \"Dynamics/Scheme\" to trapezoidal.");
    }

    void check(const Structure &structure)
    {
      ensure(Ranks::size() == 1 && !(structure.damping.stiffness > 0.),
             "The leapfrog rule has one process and no damping by the stiffness.");
      for (const Body &body : structure.bodies)
        ensure(body.reacting.empty(), "The leapfrog rule has no reactions of water.");
    }
  } // namespace

  double mass_of(const Structure &structure, const std::vector<Matrix3> &without, const std::size_t node)
  {
    const auto trace = [&](const std::vector<Matrix3> &mass)
    { return mass.empty() ? 0. : mass[node][0] + mass[node][4] + mass[node][8]; };
    return (trace(structure.mass) - trace(without) - trace(structure.added_mass)) / 3.;
  }

  CriticalStep critical_step(const Structure &structure, const std::vector<Matrix3> &without)
  {
    std::vector<double> mass; // without the added mass: the frequency is an upper bound
    for (std::size_t i = 0; i < structure.n_nodes(); ++i)
      mass.push_back(mass_of(structure, without, i));
    double stiffest = structure.damping.modulus;
    for (const double c : structure.damping.c)
      stiffest += structure.damping.modulus * c;
    const auto multiply = [&](const double *x, double *y)
    {
      Unknowns       Ku;
      const Unknowns u(x, x + 3 * mass.size()), damped = structure.damped_force(u);
      structure.multiply_stiffness(u, Ku);
      for (std::size_t k = 0; k < Ku.size(); ++k)
        y[k] = damped.empty() ? Ku[k] : (Ku[k] + (stiffest - 1.) * damped[k]) / stiffest;
    };
    CriticalStep                                        result;
    const std::function<void(const double *, double *)> product = multiply;
    result.length = 2. / (largest_frequency(product, mass, &result.node) * std::sqrt(stiffest));
    return result;
  }

  Leapfrog::Leapfrog(const Structure &structure, const JointLaws &laws, const double dt,
                     const unsigned int n_steps, std::vector<StepNeighbour *> neighbours)
      : Integrator(structure, laws), dt(dt), n_steps(n_steps), h(dt / n_steps),
        gain(h / (1. + .5 * h * structure.damping.mass)), neighbours(std::move(neighbours)),
        stiffness(structure), clusters(structure), states(structure.pairs.size(), PairState::open)
  {
    check(structure);
  }

  /** The velocity begins in the middle of a step before the start, v(-1/2) = v - h a / 2 with the acceleration a of the
   * start. So its strain energy is u(-1) K u(0) / 2. */
  void Leapfrog::start(const Unknowns &u, const Unknowns &v, const Unknowns &force, const Unknowns &load,
                       const Unknowns &reference, const Unknowns &memory, const Unknowns &elastic_force)
  {
    Unknowns before = v, sum = load, Ku_start;
    for (const StepNeighbour *neighbour : neighbours)
      neighbour->add_forces(sum);
    structure.multiply_stiffness(u, Ku_start);
    for (std::size_t i = 0; i < structure.n_nodes(); ++i)
      for (unsigned int c = 0; c < 3; ++c)
      {
        const Vector3 a = clusters.inverse_masses()[i] * (get(sum, i) - get(Ku_start, i));
        before[3 * i + c] -= .5 * h * (a[c] - structure.damping.mass * v[3 * i + c]);
      }
    for (std::size_t p = 0; p < structure.pairs.size(); ++p)
      clusters.add_impulse(structure.pairs[p], scaled(get(force, p), -.5 * h), before);
    Integrator::start(u, before, force, load, reference, memory, elastic_force);
    double change = 0.;
    for (std::size_t k = 0; k < v.size(); ++k)
      change -= .5 * h * before[k] * (now.Ku[k] - (elastic_force.empty() ? 0. : elastic_force[k]));
    now.energy.strain += change;
    first.strain += change;
  }

  double Leapfrog::memory() const
  {
    double bytes = 14. * sizeof(double) * now.u.size() + stiffness.memory(); // vectors of the state
    for (const Body &body : structure.bodies)
      bytes += 10. * sizeof(double) * body.stiffness.value.size();
    return bytes;
  }

  ContactResult Leapfrog::advance(const Unknowns &load, const Vector3 &)
  {
    ContactResult result;
    result.converged = true;
    pair_force = gap_after = gap_before = gap =
        now.force; // anew in each step, so that resumed runs are bitwise identical
    Unknowns before = now.u;
    for (std::size_t k = 0; k < before.size(); ++k)
      before[k] -= h * now.v[k];
    for (std::size_t p = 0; p < structure.pairs.size(); ++p)
    {
      set(gap, p, opening_and_slip(p));
      set(gap_before, p, structure.jump(structure.pairs[p], before) - get(reference, p));
    }
    impulse.assign(3 * structure.pairs.size(), 0.);
    const Unknowns u_start = now.u;
    now.relaxation.mean.assign(now.u.size(), 0.);
    now.relaxation.lag.assign(now.relaxation.Ku.size(), 0.);
    outer.assign(now.u.size(), 0.);
    const double end = now.time + dt;
    for (unsigned int k = 0; k < n_steps; ++k)
    {
      Work work;
      if (!neighbours.empty())
        outer.assign(now.u.size(), 0.);
      for (const StepNeighbour *neighbour : neighbours)
        neighbour->add_forces(outer);
      predict(double(k) / n_steps, load);
      Stopwatch joints;
      solve_joints(k + 1 == n_steps, result, work);
      spent.joints += joints.seconds();
      move(double(k) / n_steps, load, k + 1 == n_steps, work);
      if (!std::isfinite(work.input))
        throw ComputationError(
            "The displacements or the loads are not finite at t = " + number_text(now.time) +
            " s. Check the units of materials, loads and ground motion (\"Motion/Unit\").");
      now.energy.input += work.input;
      now.energy.damping += work.damping;
      now.energy.friction += work.friction;
      now.energy.impact += work.opening;
    }
    for (std::size_t k = 0; k < u_start.size(); ++k)
      now.relaxation.mean[k] -= .5 * (u_start[k] + now.u[k]);
    now.load = load;
    now.time = end;
    for (std::size_t k = 0; k < impulse.size(); ++k)
      now.force[k] = impulse[k] / dt;
    const JointEnergy joints = joint_energy();
    now.energy.impact -=
        joints.stored - now.energy.joint_stored + joints.fracture - now.energy.joint_fracture;
    now.energy.joint_stored = joints.stored;
    now.energy.joint_fracture = joints.fracture;
    update_largest();
    return result;
  }

  /** Computes the velocity at the end of a step without joint forces, at a @p share of the way between both loads. */
  void Leapfrog::predict(const double share, const Unknowns &load)
  {
    const double a = .5 * h * structure.damping.mass, keep = (1. - a) / (1. + a);
    next.resize(now.u.size());
    constexpr std::size_t per_chunk = 256; // nodes
    const std::size_t     n = structure.n_nodes();
#pragma omp parallel for schedule(static)
    for (int chunk = 0; chunk < static_cast<int>((n + per_chunk - 1) / per_chunk); ++chunk)
    {
      const std::size_t begin = 3 * per_chunk * chunk, end = std::min(begin + 3 * per_chunk, 3 * n);
      double            w[3 * per_chunk], f[3 * per_chunk];
      structure.damping.relaxed(now.relaxation, now.u, now.Ku, begin, end, w, f);
      double *mean = now.relaxation.mean.data() + begin, *v = next.data() + begin,
             *lag = now.relaxation.lag.empty() ? nullptr : now.relaxation.lag.data() + begin;
      const double *u_now = now.u.data() + begin;
      const double *before = now.load.data() + begin, *after = load.data() + begin,
                   *other = outer.data() + begin, *old = now.v.data() + begin, part = 1. / n_steps;
#pragma omp simd
      for (std::size_t k = 0; k < end - begin; ++k)
      {
        mean[k] += part * w[k];
        if (lag != nullptr)
          lag[k] += part * (w[k] - u_now[k]);
        f[k] = (1. - share) * before[k] + share * after[k] + other[k] - f[k];
        v[k] = keep * old[k];
      }
      for (std::size_t i = 0; 3 * i < end - begin; ++i)
      {
        const Vector3 a_i =
            clusters.inverse_masses()[begin / 3 + i] * Vector3{{f[3 * i], f[3 * i + 1], f[3 * i + 2]}};
        for (unsigned int c = 0; c < 3; ++c)
          v[3 * i + c] += gain * a_i[c];
      }
    }
  }

  /** Applies an event to the pair if its utilisation exceeds 1. Returns whether it did. */
  bool Leapfrog::apply_event(const std::size_t p, const Vector3 &force, const Vector3 &at, const double limit)
  {
    const JointLaw &law = *laws.of_pair[p];
    if (law.n_memory() == 0 || law.utilisation(force, at, history_of(p)) <= limit)
      return false;
    law.apply_event(now.memory.data() + laws.memory_begin(p), JointEvent::limit);
    return true;
  }

  /** Returns the gap of a pair at the end of the step with the velocity #next [m]. */
  Vector3 Leapfrog::predicted(const std::size_t p) const
  {
    const Vector3 rate = structure.jump(structure.pairs[p], next);
    Vector3       b = get(gap, p);
    for (unsigned int c = 0; c < 3; ++c)
      b[c] += h * rate[c];
    return b;
  }

  PairHistory Leapfrog::history_of(const std::size_t p) const
  {
    PairHistory history(get(gap, p));
    history.area = structure.pairs[p].area;
    history.is_mean = true;
    history.memory = now.memory.data() + laws.memory_begin(p);
    return history;
  }

  /** Returns the force @p f of a pair with its gap b + H f, without a gain of energy: where the slip of two steps has the
   * direction of the friction, because the slip reverses, the friction is reduced until its work is zero. The normal
   * gap is kept. */
  Vector3 Leapfrog::without_gain(const std::size_t p, const Matrix3 &H, const Vector3 &b,
                                 const Vector3 &f) const
  {
    const Vector3 t{{0., f[1], f[2]}}, Ht = H * t;
    const double  work = dot(t, sum_of(H * f, b) - get(gap_before, p));
    if (!(work > 0.) || !(laws.of_pair[p]->flat_friction() > 0.))
      return f;
    const double less = std::min(1., work / (dot(t, Ht) - Ht[0] * Ht[0] / H[0]));
    return {{std::max(0., f[0] + less * Ht[0] / H[0]), (1. - less) * f[1], (1. - less) * f[2]}};
  }

  /** Adds the impulse of a joint force to #next. */
  void Leapfrog::apply(const std::size_t p, const Vector3 &f)
  {
    set(pair_force, p, f);
    clusters.add_impulse(structure.pairs[p], {{gain * f[0], gain * f[1], gain * f[2]}}, next);
    for (unsigned int c = 0; c < 3; ++c)
      impulse[3 * p + c] += h * f[c];
  }

  /** Solves the joint laws of a cluster for fixed history variables by Gauss-Seidel iterations. @p f: first guess of the
   * forces, receives the result. @p at: receives the gaps. Returns the number of iterations. */
  unsigned int Leapfrog::solve_cluster(const PairClusters::Cluster &cluster, const std::vector<Vector3> &b,
                                       std::vector<Vector3> &f, std::vector<Vector3> &at) const
  {
    const auto gap_without = [&](const std::size_t i, const bool own)
    {
      Vector3 y = b[i];
      for (std::size_t j = 0; j < f.size(); ++j)
        if (own || j != i)
          add(y, scaled(cluster.between(i, j), gain * h) * f[j]);
      return y;
    };
    unsigned int sweep = 0;
    for (double change = 1., size = 0.; sweep < most_sweeps && change > enough * size; ++sweep)
    {
      change = size = 0.;
      for (std::size_t i = 0; i < f.size(); ++i)
      {
        const unsigned int p = cluster.pairs[i];
        const Vector3      fresh = laws.of_pair[p]->solve(scaled(cluster.between(i, i), gain * h),
                                                          gap_without(i, false), history_of(p));
        change = std::max(change, norm(fresh - f[i]));
        size = std::max(size, norm(fresh));
        f[i] = fresh;
      }
    }
    if (sweep == most_sweeps)
      throw_not_converged(now.time);
    for (std::size_t i = 0; i < f.size(); ++i)
      at[i] = gap_without(i, true);
    return sweep;
  }

  /** Solves a cluster. While a pair exceeds its limit, the pairs with the largest utilisations get an event. Returns
   * the number of iterations. */
  unsigned int Leapfrog::solve_with_events(const PairClusters::Cluster &cluster)
  {
    std::vector<Vector3> b, f, at;
    for (const unsigned int p : cluster.pairs)
    {
      b.push_back(predicted(p));
      f.push_back(get(pair_force, p));
    }
    at = b;
    unsigned int sweeps = 0;
    for (std::size_t event = 0, changed = 1; changed > 0; ++event)
    {
      if (event > most_events * f.size())
        throw_not_converged(now.time);
      sweeps += solve_cluster(cluster, b, f, at);
      double largest = 1.;
      for (std::size_t i = 0; i < f.size(); ++i)
        if (const unsigned int p = cluster.pairs[i]; laws.of_pair[p]->n_memory() > 0)
          largest = std::max(largest, laws.of_pair[p]->utilisation(f[i], at[i], history_of(p)));
      changed = 0;
      for (std::size_t i = 0; largest > 1. && i < f.size(); ++i)
        changed += apply_event(cluster.pairs[i], f[i], at[i], std::max(1., .9 * largest));
    }
    for (std::size_t i = 0; i < f.size(); ++i)
      apply(cluster.pairs[i], f[i]);
    return sweeps;
  }

  /** Solves the joint laws of all pairs, adds their impulses to #next, and commits the history variables. */
  void Leapfrog::solve_joints(const bool is_last, ContactResult &result, Work &work)
  {
    for_each_in_chunks(clusters.single.size(),
                       [&](const std::size_t i)
                       {
                         const unsigned int p = clusters.single[i];
                         const Matrix3      H = scaled(clusters.of_pair(p), gain * h);
                         const Vector3      b = predicted(p);
                         Vector3            f = laws.of_pair[p]->solve(H, b, history_of(p));
                         for (unsigned int event = 0;
                              event < most_events && apply_event(p, f, sum_of(H * f, b), 1.); ++event)
                           f = laws.of_pair[p]->solve(H, b, history_of(p));
                         apply(p, without_gain(p, H, b, f));
                       });
    for (const auto &cluster : clusters.clusters)
      result.sweeps = std::max(result.sweeps, solve_with_events(cluster));
    const auto commit = [&](const std::size_t p)
    {
      const JointLaw   &law = *laws.of_pair[p];
      const Vector3     at = get(gap_after, p), f = get(pair_force, p);
      const PairHistory history = history_of(p);
      if (is_last)
      {
        PairEquations equations;
        law.evaluate(f, at, history, 1. / (gain * h * clusters.of_pair(p)[0]), equations);
        states[p] = equations.state;
      }
      if (law.n_memory() > 0)
        law.commit(f, at, history, now.memory.data() + laws.memory_begin(p));
    };
    for (std::size_t p = 0; p < structure.pairs.size(); ++p)
      set(gap_after, p, predicted(p));
    add_work_of_joints(work);
    for_each_in_chunks(structure.pairs.size(), commit);
  }

  void Leapfrog::add_work_of_joints(Work &work) const
  {
    for (std::size_t p = 0; p < structure.pairs.size(); ++p)
      for (unsigned int c = 0; c < 3; ++c)
        (c == 0 ? work.opening : work.friction) -=
            pair_force[3 * p + c] * .5 * (gap_after[3 * p + c] - gap_before[3 * p + c]);
    if (!laws.have_seats())
      return;
    const double elastic =
        laws.friction_correction(gap, true, pair_force, gap_after, now.memory); // see PairLaws
    work.friction += elastic;
    work.opening -= elastic;
  }

  /** Sets the kinetic and the strain energies of the middle of a step to #u. @p more: strain energy of damping and
   * neighbour [J]. */
  void Leapfrog::account(const double more)
  {
    const auto energy = [&](const std::size_t begin, const std::size_t end)
    {
      double kinetic = 0., water = 0., strain = 0.;
      for (std::size_t i = begin; i < end; ++i)
      {
        const Vector3 v = get(next, i), before = get(now.u, i);
        kinetic += .5 * dot(v, structure.mass[i] * v);
        if (!structure.added_mass.empty())
          water += .5 * dot(v, structure.added_mass[i] * v);
        strain += .5 * dot(before, get(Ku, i));
        for (unsigned int c = 0; c < 3 && !elastic_force.empty(); ++c)
          strain -= .5 * elastic_force[3 * i + c] * (before[c] + u[3 * i + c]);
      }
      return std::array<double, 3>{{kinetic, water, strain}};
    };
    const auto energies = sum_of_ranges<std::array<double, 3>>(structure.n_nodes(), energy);
    now.energy.kinetic = energies[0] - energies[1];
    now.energy.added_mass = energies[1];
    now.energy.strain = energies[2] + elastic_energy + more;
  }

  /** Advances the state by one step. The works are those of the forces at u(k) along (u(k + 1) - u(k - 1)) / 2. */
  void Leapfrog::move(const double share, const Unknowns &load, const bool is_last, Work &work)
  {
    const double alpha = structure.damping.mass;
    const auto   move_nodes = [&](const std::size_t begin, const std::size_t end)
    {
      double input = 0., damping = 0.;
      for (std::size_t i = begin; i < end; ++i)
      {
        Vector3 mean; // velocity
        for (unsigned int c = 0; c < 3; ++c)
        {
          const std::size_t k = 3 * i + c;
          mean[c] = .5 * (now.v[k] + next[k]);
          const double force = (1. - share) * now.load[k] + share * load[k] + outer[k] -
                               (elastic_force.empty() ? 0. : elastic_force[k]);
          input += h * force * mean[c];
        }
        if (alpha > 0.)
          damping += alpha * h * dot(mean, structure.mass[i] * mean);
      }
      return std::array<double, 2>{{input, damping}};
    };
    const auto works = sum_of_ranges<std::array<double, 2>>(structure.n_nodes(), move_nodes);
    u.resize(now.u.size());
#pragma omp parallel for simd schedule(static)
    for (int k = 0; k < static_cast<int>(u.size()); ++k)
      u[k] = now.u[k] + h * next[k];
    Stopwatch clock;
    stiffness.multiply(u, Ku);
    const Unknowns damped = structure.damped_force(u);
    spent.substitutions += clock.seconds();
    const Damping::Energies relaxed =
        structure.damping.advance_leapfrog(h, now.u, now.Ku, u, Ku, now.relaxation, damped);
    work.input += works[0];
    work.damping += works[1] + relaxed.dissipated;
    double outside = relaxed.stored;
    for (StepNeighbour *neighbour : neighbours)
    {
      const double before = neighbour->strain();
      neighbour->advance(u, next);
      outside += neighbour->strain();
      work.input += neighbour->strain() - before;
    }
    if (is_last)
      account(outside);
    now.u.swap(u);
    now.Ku.swap(Ku);
    now.v.swap(next);
    gap_before.swap(gap);
    gap.swap(gap_after);
    now.time += h;
  }
} // namespace Voussoir
