// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/excess.h>
#include <voussoir/base/tensor3.h>
#include <voussoir/foundation/rock_monitor.h>
#include <voussoir/motion/ground_motion.h>
#include <voussoir/rock/boundary_table.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace Voussoir
{
  namespace
  {
    constexpr double energy_factor = 3.; ///< margin of the energy bound [-]

    /** Returns the energy of the incident wave at the bottom of the rock [J]. Its velocity is half of that at
     * the outcrop. Oblique waves also enter through the sides, and as P waves in each direction: an upper bound. */
    double incident_energy(const RockModel &rock, const GroundMotion &motion, const bool is_vertical)
    {
      double                energy = 0.;
      const MotionIntegrals integrals = motion.integrated();
      for (std::size_t k = 1; k < motion.acceleration.size(); ++k)
        for (unsigned int c = 0; c < 3; ++c)
        {
          const double v = integrals.velocity[k][c];
          double       impedance = 0.; // integral over the bottom [N s/m]
          for (const BoundaryFace &face : rock.faces)
            if (face.normal[2] < -.5 || !is_vertical)
              impedance +=
                  face.material.density * face.area *
                  (c == 2 || !is_vertical ? p_wave_speed(face.material) : s_wave_speed(face.material));
          energy += impedance * .25 * v * v * motion.dt;
        }
      return energy;
    }
  } // namespace

  RockMonitor::RockMonitor(const FoundationParameters &parameters, const RockModel &model,
                           ExplicitRegion &region, const RockBalance &balance)
      : parameters(parameters), model(model), region(region), balance(balance)
  {
  }

  void RockMonitor::set_bounds(const GroundMotion &motion, const NeighbourBounds &limits)
  {
    bounds = limits;
    energy_bound =
        energy_factor * (incident_energy(model, motion, read_incidence(parameters.incidence).empty()) +
                         std::max(0., limits.strain));
  }

  void RockMonitor::gather_motion(const unsigned int step, const unsigned int n_steps)
  {
    if (region.is_split() && bounds.velocity > 0. && (step % interval == 0 || step == n_steps))
      if (Ranks::any(region.exceeds(bounds.velocity, bounds.displacement)))
        region.gather_motion(); // the first rank reports
  }

  std::string RockMonitor::energy_excess() const
  {
    const RegionEnergy rock = balance.of_rock();
    const double       coupling = balance.coupling_error();
    std::ostringstream text;
    text.precision(3);
    if (region.artificial_boundary()->absorbs() && !(-rock.transmitted <= energy_bound))
      text << "the artificial boundary " << parameters.boundary << " has supplied " << -rock.transmitted
           << " J to the rock. The limit is " << energy_bound << " J, " << energy_factor
           << " times the energy of the earthquake and the static state.";
    else if (!(std::abs(coupling) <= energy_bound))
      text << "the energy error of the coupling of dam and rock is " << coupling << " J. The limit is "
           << energy_bound << " J, " << energy_factor
           << " times the energy of the earthquake and the static state.";
    return text.str();
  }

  std::string RockMonitor::motion_excess() const
  {
    const Unknowns    &u = region.displacement(), &w = region.half_step_velocity();
    std::ostringstream text;
    std::size_t        i = find_excess(w, bounds.velocity);
    if (i < w.size())
      text << "the velocity of the rock exceeds the limit for this ground motion, " << bounds.velocity
           << " m/s: it is " << w[i] << " m/s";
    else if (i = find_excess(u, bounds.displacement); i < u.size())
      text << "the displacement of the rock exceeds the limit for this ground motion, " << bounds.displacement
           << " m: it is " << u[i] << " m";
    else
      return "";
    const auto &p = model.points[i / 3];
    double      distance = 1e300;
    for (const BoundaryFace &face : model.faces)
      for (const unsigned int node : face.nodes)
      {
        const auto &q = model.points[node];
        distance = std::min(distance, std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]));
      }
    text << " in "
         << "xyz"[i % 3] << " at the node " << place({{p[0], p[1], p[2]}}) << ", " << distance
         << " m from the artificial boundary " << parameters.boundary << ".";
    return text.str();
  }

  std::string RockMonitor::suggestions() const
  {
    const FoundationParameters &p = parameters;
    std::ostringstream          text;
    text.precision(3);
    const double rock_dt = region.time_step();
    text << "Do not use the results after this time, or shortly before it. Try \"Foundation/Boundary\" = ";
    text << other_boundaries(p.boundary);
    if (p.quality > 0.)
      text << " (viscous-spring without \"Foundation/Quality factor\")";
    if (p.stiffness_damping < .02 * rock_dt)
      text << ", a \"Foundation/Stiffness damping\" of " << .02 * rock_dt << " s (0.02 rock time steps)";
    if (!p.nodal_everywhere)
      text << ", \"Foundation/Nodal quadrature everywhere\" = true";
    if (p.layers_at_dam > 0)
      text << ", \"Foundation/Layers at the dam\" = 0";
    text << ", or a smaller time step (\"Dynamics/Steps per sample\"); see doc/boundary.md.";
    return text.str();
  }
} // namespace Voussoir
