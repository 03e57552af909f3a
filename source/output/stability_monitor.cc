// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/error.h>
#include <voussoir/base/names.h>
#include <voussoir/base/tensor3.h>
#include <voussoir/dam/static_state.h>
#include <voussoir/output/stability_monitor.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace Voussoir
{
  namespace
  {
    constexpr double growth_limit = 10.; ///< of the motion at a node, see StabilityMonitor
    constexpr double long_period = 1.;   ///< natural period above that of any arch dam [s]

    double mass_of(const Structure &structure)
    {
      double mass = 0.;
      for (const Matrix3 &m : structure.mass)
        mass += m[0];
      return mass;
    }

    /** Returns the velocity with which the dam has the kinetic energy @p energy [J] [m/s]. */
    double speed(const Structure &structure, const double energy)
    {
      return std::sqrt(2. * std::max(0., energy) / mass_of(structure));
    }

    /** Returns a bound of speed() for the energy that the forces with a history can supply [m/s]. */
    double speed_by_forces(const Dam &dam, const GroundMotion &motion)
    {
      double sum = 0.;
      for (const ForceInTime &force : dam.forces)
      {
        double impulse = 0., square = 0.; // [N s]; of the pattern, over the nodal masses [1/kg]
        for (std::size_t k = 1; k < motion.acceleration.size(); ++k)
          impulse += motion.dt * std::abs(force.at(k * motion.dt) - force.value.front());
        for (std::size_t k = 0; k < force.pattern.size(); ++k)
          square += force.pattern[k] * force.pattern[k] / dam.structure.mass[k / 3][4 * (k % 3)];
        sum += impulse * std::sqrt(square / mass_of(dam.structure));
      }
      return sum;
    }
  } // namespace

  MotionBounds bounds_of(const GroundMotion &motion, const double mass_damping)
  {
    MotionBounds          result;
    const MotionIntegrals integrals = motion.integrated();
    double                sum = 0.;
    const double          dt = motion.dt, decay = std::exp(-.5 * mass_damping * dt);
    for (std::size_t k = 1; k < motion.acceleration.size(); ++k)
    {
      sum = decay * sum + .5 * dt * (norm(motion.acceleration[k - 1]) + norm(motion.acceleration[k]));
      result.velocity = std::max(result.velocity, norm(integrals.velocity[k]));
      result.displacement = std::max(result.displacement, norm(integrals.displacement[k]));
      result.oscillator = std::max(result.oscillator, sum);
    }
    return result;
  }

  StabilityMonitor::StabilityMonitor(const Dam &dam, const GroundMotion &motion, const Integrator &integrator)
      : dam(dam), u_static(integrator.state().u)
  {
    const MotionBounds bounds = bounds_of(motion, dam.structure.damping.mass);
    const double       strain = integrator.state().energy.strain + dam.foundation->strain_at_start(),
                 v_0 = speed(dam.structure, strain + integrator.state().energy.kinetic) +
                       speed_by_forces(dam, motion);
    velocity_dam = growth_limit * (bounds.oscillator + v_0);
    const double velocity_rock = growth_limit * (bounds.velocity + v_0);
    const double time = .5 * long_period / M_PI + (dam.has_free_bodies ? motion.duration() : 0.);
    displacement_dam = growth_limit * bounds.displacement + time * velocity_dam;
    const double displacement_rock = growth_limit * bounds.displacement + time * velocity_rock;
    for (Neighbour *neighbour : dam.neighbours)
      if (NeighbourMonitor *monitor = neighbour->monitor())
      {
        monitor->set_bounds(motion, {velocity_rock, displacement_rock, strain});
        of_neighbours.push_back(monitor);
      }
  }

  std::string StabilityMonitor::instability(const Integrator &integrator, const unsigned int step,
                                            const bool last) const
  {
    if (step == 0)
      return "";
    std::string what;
    for (const NeighbourMonitor *monitor : of_neighbours)
      if (what.empty())
        what = monitor->energy_excess();
    if (what.empty() && (step % NeighbourMonitor::interval == 0 || last))
    {
      for (const NeighbourMonitor *monitor : of_neighbours)
        if (what.empty())
          what = monitor->motion_excess(); // an instability of its boundary begins there
      if (what.empty())
        what = of_dam(integrator.state());
    }
    if (what.empty())
      what = of_joints(integrator);
    if (what.empty())
      return "";
    std::ostringstream text;
    text << "The run has become unstable: at step " << step << ", t = " << integrator.state().time << " s, "
         << what << " " << suggestions();
    return text.str();
  }

  std::string StabilityMonitor::of_joints(const Integrator &integrator) const
  {
    Extreme moved;
    for (unsigned int p = 0; p < dam.structure.pairs.size(); ++p)
    {
      const Vector3 d = integrator.opening_and_slip(p);
      moved.raise(std::max(d[0], length(d[1], d[2])), integrator.state().time, dam.structure.pairs[p].place);
    }
    if (moved.value <= largest_joint_share * dam.size)
      return "";
    std::ostringstream text;
    text << "the opening or slip of a joint is " << moved.value << " m at " << place(moved.place)
         << " (limit " << largest_joint_share * dam.size
         << " m). If the joints really slide, check \"Joints/Friction\".";
    return text.str();
  }

  std::string StabilityMonitor::of_dam(const DynamicState &state) const
  {
    std::ostringstream text;
    std::size_t        i = find_excess(state.v, velocity_dam);
    if (i < state.v.size())
      text << "the velocity of the dam exceeds the limit for this ground motion, " << velocity_dam
           << " m/s: it is " << state.v[i] << " m/s";
    else
    {
      Unknowns u = state.u;
      for (std::size_t k = 0; k < u.size(); ++k)
        u[k] -= u_static[k];
      i = find_excess(u, displacement_dam);
      if (i == u.size())
        return "";
      text << "the displacement of the dam exceeds the limit for this ground motion, " << displacement_dam
           << " m: it is " << u[i] << " m";
    }
    text << " in "
         << "xyz"[i % 3] << " at the node " << dam.model->place_of(i / 3) << ".";
    return text.str();
  }

  std::string StabilityMonitor::suggestions() const
  {
    const auto of = [](const NeighbourMonitor *monitor) { return monitor->suggestions(); };
    if (const std::string own = listed(of_neighbours, of, " "); !own.empty())
      return own;
    std::ostringstream text;
    text.precision(3);
    text << "The later results are invalid. Use ";
    if (!dam.layout.tied && dam.scene.impact_rule != "mean-force")
      text << "\"Dynamics/Impact\" = mean-force, or ";
    text << "a smaller time step (\"Dynamics/Steps per sample\"), and check \"Motion/Unit\" and the "
            "peak values of the motion (voussoir motion).";
    return text.str();
  }

  void StabilityObserver::record()
  {
    const std::string instability = monitor.instability(*run.integrator, run.step, run.is_last());
    if (!instability.empty())
      throw ComputationError(instability);
  }
} // namespace Voussoir
