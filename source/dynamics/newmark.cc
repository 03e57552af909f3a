// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/dynamics/newmark.h>

#include <voussoir/base/error.h>
#include <voussoir/base/number_text.h>
#include <voussoir/base/parallel.h>

#include <algorithm>
#include <cassert>
#include <cmath>

namespace Voussoir
{
  namespace
  {
    /** Returns the joint of the first pair whose law requires mean forces, counted from 1. */
    unsigned int joint_of_mean_force(const Structure &structure, const JointLaws &laws)
    {
      const auto law = std::find_if(laws.of_pair.begin(), laws.of_pair.end(),
                                    [](const JointLaw *l) { return l->needs_mean_force(); });
      return structure.pairs[law - laws.of_pair.begin()].joint + 1;
    }

    /** Throws ComputationError because a step has displacements or loads that are not finite. */
    [[noreturn]] void throw_not_finite(const Structure &structure, const DynamicState &state)
    {
      const auto value =
          std::find_if(state.u.begin(), state.u.end(), [](const double u) { return !std::isfinite(u); });
      std::string where;
      if (value != state.u.end())
        where = " in " + structure.bodies[structure.body_of((value - state.u.begin()) / 3)].name();
      throw ComputationError(
          "The displacements" + where + " or the loads are not finite at t = " + number_text(state.time) +
          " s. Check the units of materials, loads and ground motion (\"Motion/Unit\"), or increase "
          "\"Dynamics/Steps per sample\".");
    }
  } // namespace

  Newmark::Newmark(const Structure &structure, const JointLaws &laws, const ContactParameters &parameters,
                   const double dt, const ImpactRule rule, Support *support, const bool single_factors)
      : Integrator(structure, laws), parameters(parameters), rule(rule), support(support),
        single_factors(single_factors && !support), share(rule == ImpactRule::mean_force ? 2. : 1.),
        impact(structure, laws, rule), equation(step_equation(structure, share, this->single_factors))
  {
    if (laws.need_mean_force() && rule != ImpactRule::mean_force)
      throw InputError("The law of joint " + std::to_string(joint_of_mean_force(structure, laws)) +
                       " requires joint forces that are means over the step. Set \"Dynamics/Impact\" to "
                       "mean-force.");
    if (support && rule != ImpactRule::mean_force)
      throw InputError(
          "Massless rock and subcycled rock require joint forces that are means over the step. Set "
          "\"Dynamics/Impact\" to mean-force.");
    std::vector<bool> found(structure.n_nodes(), false);
    for (const Pair &pair : structure.pairs)
      for (const unsigned int node : {pair.node_1, pair.node_2})
        if (node != rigid_ground && !found[node])
        {
          found[node] = true;
          nodes_in_pairs.push_back(node);
        }
    add_level({dt, support ? support->n_substeps() : 1, 0});
  }

  double Newmark::memory() const
  {
    double bytes = 0.;
    for (const auto &level : levels)
      bytes += level->system.memory_consumption();
    return bytes;
  }

  void Newmark::start(const Unknowns &u, const Unknowns &v, const Unknowns &force, const Unknowns &load,
                      const Unknowns &reference_jump, const Unknowns &memory, const Unknowns &constant_force)
  {
    Integrator::start(u, v, force, load, reference_jump, memory, constant_force);
    equation->start(now);
  }

  ContactResult Newmark::advance(const Unknowns &load, const Vector3 &base_velocity)
  {
    assert(load.size() == 3 * std::size_t(structure.n_nodes()));
    return advance(StepSize{levels[0]->dt, levels[0]->n_substeps, 0}, load, base_velocity);
  }

  /** Tries one step. Returns false, with the state unchanged, if the joints do not converge. */
  bool Newmark::step(Level &level, const StepLoad &step, ContactResult &result)
  {
    const double dt = step.dt;
    Unknowns     force, u_new;
    BaseOfStep   base;
    result = solve(level, step, force, u_new, base);
    if (!result.converged)
      return false;
    for (std::size_t k = 0; k < force.size(); ++k)
      impulse[k] = rule == ImpactRule::mean_force ? dt * force[k] : .5 * dt * (now.force[k] + force[k]);

    Work     work;
    Unknowns change; // change of the jumps
    add_work_of_joints(dt, u_new, change, work);
    if (support)
      work.input += advance_support(level, base, u_new);
    move(step, u_new, work);
    if (!std::isfinite(work.input))
      throw_not_finite(structure, now);
    const double                   kinetic_before = kinetic_energy_of_pairs();
    const std::vector<PairHistory> histories =
        laws.histories(step_start, rule == ImpactRule::mean_force, step_memory);
    if (rule != ImpactRule::none)
      impact.correct_velocity(level.system, histories, dt, change, now.v, impulse);
    account(work, kinetic_before);

    if (rule == ImpactRule::mean_force || rule == ImpactRule::none || structure.pairs.empty())
      now.force = force;
    else
      now.force = impact.end_force(level.system, force, force_without_joints());
    return true;
  }

  /** Solves for displacements and joint forces of a step. Stores the history variables of the laws if the
   * joints converge. */
  ContactResult Newmark::solve(Level &level, const StepLoad &step, Unknowns &force, Unknowns &u_new,
                               BaseOfStep &base)
  {
    if (support)
      base.displacement = support->predict(level.n_substeps, now.time, at_base(now.u));
    Unknowns offset = reference, start(reference.size()), memory = now.memory;
    for (double &x : offset)
      x = -x;
    if (now.carried.gap.empty())
      for (std::size_t p = 0; p < structure.pairs.size(); ++p)
        set(start, p, opening_and_slip(p));
    else
      start = now.carried.gap;
    force = now.force;
    const ContactResult result =
        equation->solve(level.system, now, step, {offset, start, memory, force, gap, u_new, base});
    if (result.converged)
    {
      of_friction = laws.friction_correction(start, rule == ImpactRule::mean_force, force, gap, memory);
      step_memory = memory;
      level.system.commit(start, force, gap, memory);
      now.memory.swap(memory);
      if (single_factors)
        now.carried.gap = gap;
      step_start.swap(start);
    }
    return result;
  }

  /** Adds the work of the joint forces. @p change: receives the change of the jumps, three values per pair
   * [m]. All works of a step are exact, because forces enter by their means and u_new - u = dt/2
   * (v + v_new). */
  void Newmark::add_work_of_joints(const double dt, const Unknowns &u_new, Unknowns &change, Work &work) const
  {
    double &opening = work.opening, &friction = work.friction;
    change.resize(3 * structure.pairs.size());
    for (std::size_t p = 0; p < structure.pairs.size(); ++p)
    {
      const Vector3 before = structure.jump(structure.pairs[p], now.u),
                    after = structure.jump(structure.pairs[p], u_new);
      for (unsigned int c = 0; c < 3; ++c)
      {
        change[3 * p + c] = after[c] - before[c];
        (c == 0 ? opening : friction) -= impulse[3 * p + c] / dt * change[3 * p + c];
      }
    }
    friction += of_friction;
    opening -= of_friction;
  }

  /** Sets displacement, velocity, load and time at the end of the step, without joint forces and velocity
   * correction. Computes the work of loads and damping. */
  void Newmark::move(const StepLoad &step, const Unknowns &u_new, Work &work)
  {
    const double dt = step.dt;
    Unknowns     Ku, load = step.load;
    Unknowns     change = u_new;
    for (std::size_t k = 0; k < change.size(); ++k)
      change[k] -= now.u[k];
    structure.add_reaction(-1., change, load);
    structure.multiply_stiffness(u_new, Ku);
    equation->carry(now, dt, u_new, Ku);
    work.damping = structure.damping.advance(dt, now.u, now.Ku, u_new, Ku, now.relaxation,
                                             structure.damped_force(u_new));
    Vector3 base; // mean velocity of the base
    for (unsigned int c = 0; c < 3; ++c)
      base[c] = .5 * (now.base_velocity[c] + step.base_velocity[c]);
    const auto move_nodes = [&](const std::size_t begin, const std::size_t end)
    {
      double input = 0., damping = 0.;
      for (std::size_t i = begin; i < end; ++i)
      {
        Vector3 du;
        for (unsigned int c = 0; c < 3; ++c)
        {
          const std::size_t k = 3 * i + c;
          du[c] = u_new[k] - now.u[k];
          input += .5 * (load[k] + now.load[k]) * du[c];
          if (!elastic_force.empty())
            input -= elastic_force[k] * du[c];
          damping += structure.damping.stiffness / dt * (Ku[k] - now.Ku[k]) * du[c];
          now.v[k] = 2. / dt * du[c] - now.v[k];
          now.u[k] = u_new[k];
        }
        const Vector3 relative = {{du[0] - dt * base[0], du[1] - dt * base[1], du[2] - dt * base[2]}};
        const Vector3 momentum = structure.mass[i] * relative;
        damping += structure.damping.mass / dt * dot(relative, momentum);
        input -= structure.damping.mass * dot(base, momentum);
      }
      return std::array<double, 2>{{input, damping}};
    };
    const auto works = sum_of_ranges<std::array<double, 2>>(structure.n_nodes(), move_nodes);
    work.input += works[0];
    work.damping += works[1];
    now.Ku.swap(Ku);
    now.load.swap(load);
    now.base_velocity = step.base_velocity;
    now.time += dt;
  }

  /** Adds the work of a step to the energies. The velocity correction has changed the kinetic energy of the
   * pairs from @p kinetic_before to its current value [J]. */
  void Newmark::account(const Work &work, const double kinetic_before)
  {
    now.energy.input += work.input;
    now.energy.damping += work.damping;
    now.energy.friction += work.friction;
    const JointEnergy joints = joint_energy();
    const double held = joints.stored - now.energy.joint_stored + joints.fracture - now.energy.joint_fracture;
    now.energy.impact += work.opening - held + kinetic_before - kinetic_energy_of_pairs();
    now.energy.joint_stored = joints.stored;
    now.energy.joint_fracture = joints.fracture;
    account_states();
    update_largest();
  }

  double Newmark::kinetic_energy_of_pairs() const
  {
    double sum = 0.;
    for (const unsigned int node : nodes_in_pairs)
      sum += .5 * dot(get(now.v, node), structure.mass[node] * get(now.v, node));
    return sum;
  }

  /** Returns load - C v - K u at the end of the step: the nodal forces without joint forces [N]. */
  Unknowns Newmark::force_without_joints() const
  {
    Unknowns Kv, result(now.u.size());
    structure.multiply_stiffness(now.v, Kv);
    for (std::size_t i = 0; i < structure.n_nodes(); ++i)
    {
      const Vector3 momentum = structure.mass[i] * (get(now.v, i) - now.base_velocity);
      for (unsigned int c = 0; c < 3; ++c)
      {
        const std::size_t k = 3 * i + c;
        result[k] = now.load[k] - structure.damping.mass * momentum[c] - structure.damping.stiffness * Kv[k] -
                    now.Ku[k] - structure.damping.more_force(now.relaxation, now.Ku, k);
      }
    }
    return result;
  }
} // namespace Voussoir
