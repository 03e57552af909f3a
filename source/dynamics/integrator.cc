// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/error.h>
#include <voussoir/base/parallel.h>
#include <voussoir/dynamics/integrator.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

namespace Voussoir
{
  double Energy::balance(const Energy &start) const
  {
    return (kinetic - start.kinetic) + (added_mass - start.added_mass) + (strain - start.strain) + damping +
           friction + impact + (joint_stored - start.joint_stored) + (joint_fracture - start.joint_fracture) -
           input;
  }

  void Integrator::start(const Unknowns &u, const Unknowns &v, const Unknowns &force, const Unknowns &load,
                         const Unknowns &reference_jump, const Unknowns &memory,
                         const Unknowns &constant_force)
  {
    assert(u.size() == 3 * std::size_t(structure.n_nodes()));
    assert(v.size() == 3 * std::size_t(structure.n_nodes()));
    assert(load.size() == 3 * std::size_t(structure.n_nodes()));
    assert(force.size() == 3 * structure.pairs.size());
    assert(reference_jump.size() == 3 * structure.pairs.size());
    reference = reference_jump;
    elastic_force = constant_force;
    elastic_energy = 0.;
    for (std::size_t k = 0; k < elastic_force.size(); ++k)
      elastic_energy += .5 * elastic_force[k] * u[k];
    impulse.assign(force.size(), 0.);
    now = DynamicState();
    now.memory = memory.empty() ? laws.initial_memory() : memory;
    now.u = u;
    now.v = v;
    now.load = load;
    now.force = force;
    structure.multiply_stiffness(now.u, now.Ku);
    now.relaxation = structure.damping.memory_of(now.u, now.Ku, structure.damped_force(now.u));
    account_states();
    const JointEnergy joints = joint_energy();
    now.energy.joint_stored = joints.stored;
    now.energy.joint_fracture = joints.fracture;
    first = now.energy;
    largest = 0.;
  }

  JointEnergy Integrator::joint_energy() const
  {
    if (!laws.have_memory())
      return {};
    Unknowns jumps(reference.size());
    for (std::size_t p = 0; p < structure.pairs.size(); ++p)
      set(jumps, p, opening_and_slip(p));
    return laws.joint_energy(jumps, now.memory);
  }

  void Integrator::resume(const DynamicState &state, const Energy &first_energy, const double largest_so_far,
                          const Unknowns &reference_jump)
  {
    const std::size_t n_saved = state.memory.size(), n_memory = laws.initial_memory().size();
    if (n_saved != n_memory)
      throw InputError("The checkpoint has " + std::to_string(n_saved) +
                       " history variables in all pairs, but the joint laws of this program have " +
                       std::to_string(n_memory) +
                       " (JointLaw::n_memory()). Use the laws of the program that wrote the checkpoint, or "
                       "start again with --overwrite instead of --resume.");
    first = first_energy;
    largest = largest_so_far;
    reference = reference_jump;
    impulse.assign(state.force.size(), 0.);
    now = state;
  }

  void Integrator::account_states()
  {
    const auto energies =
        sum_of_ranges<std::array<double, 3>>(structure.n_nodes(),
                                             [&](const std::size_t begin, const std::size_t end)
                                             {
                                               double kinetic = 0., water = 0., strain = 0.;
                                               for (std::size_t i = begin; i < end; ++i)
                                               {
                                                 const Vector3 v = get(now.v, i), u = get(now.u, i);
                                                 kinetic += .5 * dot(v, structure.mass[i] * v);
                                                 if (!structure.added_mass.empty())
                                                   water += .5 * dot(v, structure.added_mass[i] * v);
                                                 strain += .5 * dot(u, get(now.Ku, i));
                                                 if (!elastic_force.empty())
                                                   strain -= dot(get(elastic_force, i), u);
                                               }
                                               return std::array<double, 3>{{kinetic, water, strain}};
                                             });
    now.energy.kinetic = energies[0] - energies[1];
    now.energy.added_mass = energies[1];
    now.energy.strain =
        energies[2] + elastic_energy + structure.damping.more_energy(now.relaxation, now.u, now.Ku);
  }

  Vector3 Integrator::opening_and_slip(const unsigned int pair) const
  {
    return structure.jump(structure.pairs[pair], now.u) - get(reference, pair);
  }

  double Integrator::energy_error() const
  {
    // Before the motion begins, the balance has only the round-off of the static state.
    const double scale = std::max(largest, 1e-6 * std::abs(first.strain));
    return scale > 0. ? std::abs(now.energy.balance(first)) / scale : 0.;
  }

  void Integrator::update_largest()
  {
    largest = std::max({largest, std::abs(now.energy.input), now.energy.kinetic + now.energy.added_mass,
                        first.kinetic, std::abs(now.energy.strain - first.strain), now.energy.damping});
  }
} // namespace Voussoir
