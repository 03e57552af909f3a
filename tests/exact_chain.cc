// SPDX-License-Identifier: GPL-3.0-or-later
// A chain of three distorted blocks: the equations of the joint system, hard cases for its solver, and the
// chain in time.
// Usage: exact_chain [impact rule]

#include "blocks.h"

using namespace Columns;

namespace
{
  /** Three blocks, two joints, full nodal masses: the system's own equations hold. */
  void test_chain(const std::string &law)
  {
    const SolidModel model(blocks(3, false), 1);
    Structure        structure = with_joints(model, {Material()});
    for (Matrix3 &m : structure.mass)
    {
      const Vector3 d = {{random_number(), random_number(), random_number()}};
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = 0; j < 3; ++j)
          m[3 * i + j] += 1e3 * d[i] * d[j];
    }
    const JointLaws   laws = make_laws(structure, law, .4);
    const double      m_factor = 1e6, k_factor = .8;
    JointSystem       system(structure, laws, tight(), {m_factor, k_factor});
    const std::size_t n = structure.pairs.size();
    Unknowns          load(3 * structure.n_nodes()), offset(3 * n), force(3 * n, 0.), gap, u, Ku;
    for (double &f : load)
      f = 1e7 * random_number();
    for (double &d : offset)
      d = 2e-3 * random_number();
    const ContactResult result = system.solve(load, offset, Unknowns(offset.size(), 0.), force, gap, u);
    structure.multiply_stiffness(u, Ku);
    Unknowns residual = load;
    double   error_gap = 0., cone = 0., least_gap = 0.;
    int      states[3] = {0, 0, 0};
    for (std::size_t p = 0; p < n; ++p)
    {
      const Vector3 f = {{force[3 * p], force[3 * p + 1], force[3 * p + 2]}};
      structure.add_pair_force(structure.pairs[p], f, residual);
      const Vector3 jump = structure.jump(structure.pairs[p], u);
      for (unsigned int c = 0; c < 3; ++c)
        error_gap = std::max(error_gap, std::abs(jump[c] + offset[3 * p + c] - gap[3 * p + c]));
      cone = std::max(cone, std::hypot(f[1], f[2]) - .4 * f[0]);
      least_gap = std::min(least_gap, gap[3 * p]);
      ++states[static_cast<int>(system.states()[p])];
    }
    for (unsigned int i = 0; i < structure.n_nodes(); ++i)
    {
      const Vector3 Mu = structure.mass[i] * Vector3{{u[3 * i], u[3 * i + 1], u[3 * i + 2]}};
      for (unsigned int c = 0; c < 3; ++c)
        residual[3 * i + c] -= m_factor * Mu[c] + k_factor * Ku[3 * i + c];
    }
    const std::string what = "chain of blocks, " + law + ": ";
    report(what + "Newton steps", result.iterations, "converged", result.residual < 1e-12);
    below(what + "equilibrium", largest(residual) / largest(load), 1e-11);
    below(what + "gap of the nodes", error_gap / largest(u), 1e-11);
    if (law == "FJA")
    {
      above(what + "pairs in each state", *std::min_element(states, states + 3), 1);
      below(what + "penetration", least_gap / largest(gap), 1e-11);
      below(what + "excess over Coulomb's limit", cone / largest(force), 1e-11);
    }
  }

  /** The block in the middle is nearly free, as in a long time step: hard for inexact Newton. Random loads.
   */
  void test_soft_chain(const std::string &law)
  {
    const SolidModel model(blocks(3, false), 1);
    const Structure  structure = with_joints(model, {Material()});
    const JointLaws  laws = make_laws(structure, law, .6);
    JointSystem      system(structure, laws, ContactParameters(), {1e4});
    unsigned int     failures = 0, iterations = 0;
    for (unsigned int trial = 0; trial < 100; ++trial)
    {
      Unknowns load(3 * structure.n_nodes()), offset(3 * structure.pairs.size()), force(offset.size(), 0.),
          gap, u;
      for (double &f : load)
        f = 1e7 * random_number();
      for (double &d : offset)
        d = 2e-3 * random_number();
      const ContactResult result = system.solve(load, offset, Unknowns(offset.size(), 0.), force, gap, u);
      failures += !result.converged;
      iterations += result.iterations;
    }
    report("soft chain of blocks, " + law + ": loads without solution", failures, "0 of 100", failures == 0);
    below("soft chain of blocks, " + law + ": mean Newton steps", iterations / 100., 20.);
  }

  /** Three blocks shaken, with full nodal masses: energy, joint conditions, and going on from a saved state.
   */
  void chain_in_time(const std::string &law, const ImpactRule rule, const std::string &name,
                     const Damping &damping = {10., 1e-5})
  {
    const SolidModel model(blocks(3, false), 1);
    Structure        structure = with_joints(model, {Material()});
    for (unsigned int i = 0; i < structure.n_nodes(); ++i)
    {
      const Vector3 d = {{random_number(), random_number(), random_number()}};
      for (unsigned int j = 0; j < 9; ++j)
        structure.added_mass[i][j] = 100. * d[j / 3] * d[j % 3];
      for (unsigned int j = 0; j < 9; ++j)
        structure.mass[i][j] += structure.added_mass[i][j];
    }
    structure.damping = damping;
    Unknowns amplitude(3 * structure.n_nodes()), load(amplitude);
    for (double &a : amplitude)
      a = 5e4 * random_number();
    const double      mu = .4, dt = 2e-4;
    const JointLaws   laws = make_laws(structure, law, mu);
    const std::size_t n = structure.pairs.size();
    const Unknowns    none(3 * n, 0.), rest(3 * structure.n_nodes(), 0.);
    Newmark           newmark(structure, laws, tight(), dt, rule), second(structure, laws, tight(), dt, rule);
    newmark.start(rest, rest, none, rest, none);
    const auto advance = [&](Newmark &which)
    {
      for (std::size_t i = 0; i < load.size(); ++i)
        load[i] = amplitude[i] * std::sin(2. * pi * (150. + i % 7) * (which.state().time + dt));
      return which.advance(load);
    };
    double penetration = 0., cone = 0., impulse_cone = 0., approach = 0., tension = 0., most_impulse = 0.,
           most_gap = 0., most_force = 0., drift = 0.;
    unsigned int iterations = 0;
    JointAccount joints(newmark);
    DynamicState saved;
    for (unsigned int i = 0; i < 300; ++i)
    {
      if (i == 150)
        saved = newmark.state();
      iterations = std::max(iterations, advance(newmark).iterations);
      for (std::size_t p = 0; p < n; ++p)
      {
        const double *f = &newmark.state().force[3 * p];
        const Vector3 gap = newmark.opening_and_slip(p);
        penetration = std::max(penetration, -gap[0]);
        most_gap = std::max(most_gap, gap[0]);
        most_force = std::max(most_force, f[0]);
        cone = std::max({cone, std::hypot(f[1], f[2]) - mu * f[0], -f[0]});
        drift = std::max(drift, std::hypot(gap[1], gap[2]));
        tension = std::max(tension, -f[0]);
        const double *I = &newmark.impulses()[3 * p];
        impulse_cone = std::max({impulse_cone, std::hypot(I[1], I[2]) - mu * I[0], -I[0]});
        most_impulse = std::max(most_impulse, I[0]);
        if (newmark.pair_states()[p] != PairState::open)
          approach = std::max(approach, -structure.jump(structure.pairs[p], newmark.state().v)[0]);
      }
      joints.see(newmark);
    }
    see_energy(newmark, joints);
    const bool        normal_rule = rule == ImpactRule::mean_force; // not that of the paper
    const Energy     &end = newmark.state().energy;
    const std::string what = "chain in time, " + name + ": ";
    note(what + "most Newton steps", iterations);
    below(what + "energy account, error / largest energy", newmark.energy_error(), 1e-10);
    below(what + "penetration / largest gap", penetration / most_gap, 1e-9);
    below(what + "closed pairs, approach / largest velocity", approach / largest(newmark.state().v), 1e-12);
    if (normal_rule)
      below(what + "tension / largest force", tension / most_force, 1e-12);
    if (law == "FJA" && normal_rule)
    {
      below(what + "force over Coulomb's limit / largest", cone / most_force, 1e-9);
      // mean_force gives up this limit in the rare step in which it would create energy
      note(what + "impulse over Coulomb's limit / largest", impulse_cone / most_impulse);
    }
    else if (law == "FJA")
    {
      note(what + "force over Coulomb's limit / largest", cone / most_force);
      note(what + "impulse over Coulomb's limit / largest", impulse_cone / most_impulse);
    }
    else
      below(what + "slip / largest gap", drift / most_gap, 1e-9);
    note(what + "friction / input", end.friction / end.input);
    note(what + "impacts / input", end.impact / end.input);
    report_energy("chain in time, " + name, rule);
    second.resume(saved, newmark.initial_energy(), newmark.largest_energy(), none);
    for (unsigned int i = 150; i < 300; ++i)
      advance(second);
    double difference = 0.;
    for (std::size_t i = 0; i < rest.size(); ++i)
      difference = std::max(difference, std::abs(second.state().v[i] - newmark.state().v[i]));
    below(what + "velocity after going on from a saved state", difference / largest(newmark.state().v), 1e-9);
    below(what + "energy account after it", second.energy_error(), 1e-10);
  }

  void test_chains()
  {
    for (const std::string law : {"FJA", "FJB", "tied"})
      test_chain(law);
    for (const std::string law : {"FJA", "FJB"})
      test_soft_chain(law);
    chain_in_time("FJA", ImpactRule::mean_force, "FJA");
    chain_in_time("FJA", ImpactRule::paper, "FJA, rule of the paper");
    chain_in_time("FJB", ImpactRule::mean_force, "FJB");
    Relaxation law = Relaxation::of_ratio(.05, 50., 2000., 3);
    law.unrelaxed = 1. / law.modulus(2. * pi * 150.).real();
    chain_in_time("FJA", ImpactRule::mean_force, "FJA, uniform damping", Damping(law));
  }
} // namespace

int main()
{
  return run_all({test_chains});
}
