// SPDX-License-Identifier: GPL-3.0-or-later
// What no earthquake does to the rock: see StabilityWatch.

#include <voussoir/base/excess.h>
#include <voussoir/base/tensor3.h>
#include <voussoir/foundation/explicit_rock.h>
#include <voussoir/motion/ground_motion.h>
#include <voussoir/rock/boundary_table.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace Voussoir
{
  namespace
  {
    constexpr double energy_factor = 3.;

    /** Energy of the rising wave through the bottom of the rock [J]: incident velocity is half the outcrop's.
     */
    double incident_energy(const RockModel &rock, const GroundMotion &motion)
    {
      double                energy = 0.;
      const MotionIntegrals integrals = motion.integrated();
      for (std::size_t k = 1; k < motion.acceleration.size(); ++k)
        for (unsigned int c = 0; c < 3; ++c)
        {
          const double v = integrals.velocity[k][c];
          double       impedance = 0.; // times area
          for (const BoundaryFace &face : rock.faces)
            if (face.normal[2] < -.5)
              impedance += face.material.density * face.area *
                           (c == 2 ? p_wave_speed(face.material) : s_wave_speed(face.material));
          energy += impedance * .25 * v * v * motion.dt;
        }
      return energy;
    }
  } // namespace

  void ExplicitRock::watch(const GroundMotion &motion, const WatchBounds &limits)
  {
    bounds = limits;
    energy_bound = energy_factor * (incident_energy(model, motion) + std::max(0., limits.strain));
  }

  std::string ExplicitRock::trouble_of_energy() const
  {
    const RegionEnergy rock = energy();
    const double       coupling = work_of_feet() + work_on_dam();
    std::ostringstream text;
    text.precision(3);
    if (region->artificial_boundary()->absorbs() && !(-rock.transmitted <= energy_bound))
      text << "the artificial boundary " << parameters.boundary << " has let " << -rock.transmitted
           << " J into the rock, more than " << energy_bound << " J, " << energy_factor
           << " times what the earthquake and the static state hold: the boundary pumps.";
    else if (!(std::abs(coupling) <= energy_bound))
      text << "the coupling of dam and rock has made " << coupling << " J, more than " << energy_bound
           << " J, " << energy_factor << " times what the earthquake and the static state hold.";
    return text.str();
  }

  std::string ExplicitRock::trouble_of_motion() const
  {
    const Unknowns    &u = region->displacement(), &w = region->half_step_velocity();
    std::ostringstream text;
    std::size_t        i = find_excess(w, bounds.velocity);
    if (i < w.size())
      text << "the rock moves at " << w[i] << " m/s, more than " << bounds.velocity << " m/s,";
    else if (i = find_excess(u, bounds.displacement); i < u.size())
      text << "the rock has moved by " << u[i] << " m, more than " << bounds.displacement << " m,";
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
         << "xyz"[i % 3] << " at its node " << place({{p[0], p[1], p[2]}}) << ", " << distance
         << " m from the artificial boundary " << parameters.boundary
         << ": more than an earthquake of this size can do.";
    return text.str();
  }

  std::string ExplicitRock::remedies() const
  {
    const FoundationParameters &p = parameters;
    std::ostringstream          text;
    text.precision(3);
    const double rock_dt = region->time_step();
    text << "Results after that, and some time before, are worthless. Try \"Foundation/Boundary\" = ";
    text << other_boundaries(p.boundary);
    if (p.stiffness_damping < .02 * rock_dt)
      text << ", a \"Foundation/Stiffness damping\" of " << .02 * rock_dt << " s (0.02 of the rock's step)";
    if (!p.nodal_everywhere)
      text << ", \"Foundation/Nodal quadrature everywhere\" = true";
    if (p.layers_at_dam > 0)
      text << ", \"Foundation/Layers at the dam\" = 0";
    if (p.substeps > 1 && !p.has_own_steps())
      text << ", fewer \"Foundation/Substeps\"";
    text << ", or a smaller time step (\"Dynamics/Steps per sample\"); see doc/boundary.md.";
    return text.str();
  }
} // namespace Voussoir
