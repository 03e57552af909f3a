// SPDX-License-Identifier: GPL-3.0-or-later
// Full and reduced time steps of Newmark, and its subcycled or massless support.

#include <voussoir/base/error.h>
#include <voussoir/dynamics/newmark.h>

#include <sstream>

namespace Voussoir
{
  void Newmark::add_level(const StepSize &size)
  {
    ContactParameters of_level = parameters;
    of_level.write_problems = parameters.write_problems && levels.empty();
    BaseElimination::Nodes base;
    if (support)
      base = {support->base_nodes(), support->compliance(size.n_substeps)};
    levels.emplace_back(
        new Level{size.dt, size.n_substeps,
                  JointSystem(structure, laws, of_level, trapezoidal_rule(structure, size.dt, share),
                              Unknowns(), support ? &base : nullptr, single_factors)});
  }

  /** Returns the index in levels for the step size of @p size. Adds the level if it is missing. */
  unsigned int Newmark::level_of(const StepSize &size)
  {
    for (unsigned int i = 0; support && i < levels.size(); ++i)
      if (levels[i]->n_substeps == size.n_substeps)
        return i;
    if (support || size.halvings == levels.size())
      add_level(size);
    return support ? levels.size() - 1 : size.halvings;
  }

  ContactResult Newmark::advance(const StepSize &size, const Unknowns &load, const Vector3 &base_velocity)
  {
    const unsigned int level = level_of(size);
    ContactResult      result;
    if (!step(*levels[level], {levels[level]->dt, load, base_velocity}, result))
      return advance_in_halves(size, load, base_velocity, result);
    last_level = level;
    return result;
  }

  ContactResult Newmark::advance_in_halves(const StepSize &size, const Unknowns &load,
                                           const Vector3 &base_velocity, const ContactResult &failed)
  {
    constexpr unsigned int most = 3;
    const double           dt = size.dt;
    if (size.halvings == most || (support && size.n_substeps == 1))
    {
      std::ostringstream message;
      const double       full = levels[0]->dt;
      message << "The contact solver did not converge at t = " << now.time + dt << " s (step "
              << static_cast<unsigned int>(now.time / full + 1e-6) + 1 << "), with the time step " << full
              << " s";
      if (size.halvings > 0)
        message << " reduced to " << dt << " s";
      message << "." << largest_error(structure, failed) << " The residual is " << failed.residual
              << " of the joint forces and " << failed.residual_over_load
              << " of the load (limit \"Contact/Tolerance\" = " << parameters.tolerance << "), after "
              << failed.iterations << " Newton steps and " << failed.sweeps
              << " Gauss-Seidel iterations. Increase \"Dynamics/Steps per sample\" or \"Contact/Maximum "
                 "iterations\".";
      throw ComputationError(message.str());
    }
    const unsigned int n = size.n_substeps, n_first = n / 2;
    const double       fraction = support ? double(n_first) / n : .5;
    Unknowns           middle = load;
    for (std::size_t k = 0; k < load.size(); ++k)
      middle[k] = fraction * load[k] + (1. - fraction) * now.load[k];
    Vector3 middle_base;
    for (unsigned int c = 0; c < 3; ++c)
      middle_base[c] = fraction * base_velocity[c] + (1. - fraction) * now.base_velocity[c];
    const double   end = now.time + dt; // without the round-off of the reduced steps
    const Unknowns start = now.u;
    ContactResult  result = advance({fraction * dt, n_first, size.halvings + 1}, middle, middle_base);
    const Unknowns first_half = impulse;
    Unknowns       change = now.u, rest = load; // the water reacts to the whole step
    for (std::size_t k = 0; k < change.size(); ++k)
      change[k] -= start[k];
    structure.add_reaction(-1., change, rest);
    result += advance({(1. - fraction) * dt, n - n_first, size.halvings + 1}, rest, base_velocity);
    result.add_work(failed);
    result.path = ContactPath::smaller_step;
    now.time = end;
    for (std::size_t k = 0; k < impulse.size(); ++k)
      impulse[k] += first_half[k];
    return result;
  }

  Unknowns Newmark::at_base(const Unknowns &u) const
  {
    Unknowns result;
    result.reserve(3 * support->base_nodes().size());
    for (const unsigned int node : support->base_nodes())
      result.insert(result.end(), u.begin() + 3 * std::size_t(node), u.begin() + 3 * std::size_t(node) + 3);
    return result;
  }

  /** Advances the support under the mean base force of the step. Returns the work of this force on
   * the dam [J]. */
  double Newmark::advance_support(const Level &level, const BaseOfStep &base, const Unknowns &u_new)
  {
    const Unknowns before = at_base(now.u), after = at_base(u_new);
    double         work = 0.;
    for (std::size_t k = 0; k < before.size(); ++k)
      work += base.force[k] * (after[k] - before[k]);
    support->advance(level.n_substeps, base.force, after, work);
    return work;
  }
} // namespace Voussoir
