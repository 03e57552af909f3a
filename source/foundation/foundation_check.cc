// What would make the rock unstable, refused before the run: see doc/boundary.md

#include <voussoir/base/error.h>
#include <voussoir/foundation/explicit_rock.h>
#include <voussoir/mesh/boundary_lines.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <sstream>

namespace Voussoir
{
  namespace
  {
    bool is_transmitting(const FoundationParameters &parameters)
    {
      return parameters.boundary.compare(0, 3, "mtf") == 0;
    }

    std::string number(const double x)
    {
      char text[20];
      std::snprintf(text, sizeof(text), "%.3g", x);
      return text;
    }

    /** A run with sub-steps of the rock grows slowly without damping; tests/rock_implicit.cc: 0.1 was not
     * always enough, two sub-steps needed none. */
    void check_substeps(const FoundationParameters &p, const double rock_dt)
    {
      const double damping = .15 * rock_dt;
      if (p.substeps > 2 && p.stiffness_damping < .99 * damping) // .99: the message rounds
        throw InputError(
            "More than two sub-steps (\"Foundation/Substeps\") grow slowly without damping of the rock: set "
            "\"Foundation/Stiffness damping\" to 0.15 of its time step, here " +
            number(damping) + " s, or take fewer.");
    }

    /** Gauss points at a transmitting boundary; tests/boundary_stability.cc shows how they explode. */
    void check_quadrature(const FoundationParameters &p, const double rock_dt)
    {
      const unsigned int layers = n_boundary_layers(p.boundary);
      const double       damping = .2 * rock_dt;
      if (!p.nodal_everywhere && p.nodal_layers < layers && p.stiffness_damping < .99 * damping)
        throw InputError("Gauss points within " + std::to_string(layers) +
                         " layers of the transmitting boundary " + p.boundary +
                         " make it explode: set \"Foundation/Nodal layers\" to " + std::to_string(layers) +
                         " (now " + std::to_string(p.nodal_layers) +
                         ") or more, \"Foundation/Nodal quadrature everywhere\" to true, or "
                         "\"Foundation/Stiffness damping\" to 0.2 of the rock's time step, here " +
                         number(damping) + " s.");
    }

    /** Orders from 2 on with a high Poisson's ratio near the critical time step, which without damping grow:
     * see doc/boundary.md for where, and tests/boundary_stability.cc. */
    void check_poisson(const FoundationParameters &p, const double rock_dt, const double critical)
    {
      constexpr double highest = .33, very_high = .4;
      const double     share = p.rock.poisson > very_high ? .01 : .005, damping = share * rock_dt;
      if (transmitting_formula(p.boundary).order() < 2 || p.rock.poisson < highest ||
          p.stiffness_damping >= .99 * damping)
        return;
      throw InputError("The transmitting boundary " + p.boundary +
                       " grows without bound in undamped rock whose Poisson's ratio is " + number(highest) +
                       " or more (\"Foundation/Poisson's ratio\" is " + number(p.rock.poisson) +
                       ", the time step of the rock " + number(rock_dt / critical) +
                       " of the critical one): set \"Foundation/Stiffness damping\" to " + number(share) +
                       " of the rock's time step or more, here " + number(damping) +
                       " s, or \"Foundation/Boundary\" to viscous-spring.");
    }
  } // namespace

  unsigned int n_boundary_layers(const std::string &boundary)
  {
    constexpr unsigned int least = 6; // of nodal quadrature, for any order
    return boundary.compare(0, 3, "mtf") == 0 ? std::max(least, transmitting_formula(boundary).n_nodes() - 1)
                                              : 0;
  }

  void check_boundary_layers(const FoundationParameters &parameters, const HexMesh &mesh,
                             const std::string &source)
  {
    if (!is_transmitting(parameters))
      return;
    const unsigned int n = n_boundary_layers(parameters.boundary);
    try
    {
      boundary_lines(mesh, n, source);
    }
    catch (const InputError &error)
    {
      const std::string needs = "The transmitting boundary " + parameters.boundary + " needs " +
                                std::to_string(n) + " layers of equal elements along the artificial boundary";
      const std::string or_other =
          n > 6 ? ", or \"Foundation/Boundary\" to mtf3, which needs 6." : std::string(".");
      if (source == "arch210")
        throw InputError(needs +
                         ", and the mesh arch210 has fewer: set \"Mesh/Arch210/Rock/Boundary "
                         "layers\" to " +
                         std::to_string(n) + or_other);
      throw InputError(
          error.what() + (" " + needs) +
          (n > 6 ? ": mesh as many, or set \"Foundation/Boundary\" to mtf3, which needs 6." : "."));
    }
  }

  void ExplicitRock::check(const double time_step, const unsigned int steps_per_sample) const
  {
    const double rock_dt = time_step / parameters.substeps;
    if (!(rock_dt <= dt_critical)) // or not a number
    {
      std::ostringstream message;
      message << "The time step " << rock_dt << " s is too large for the rock: its critical time step is "
              << dt_critical << " s. Raise \"Dynamics/Steps per sample\" to "
              << std::ceil(steps_per_sample * rock_dt / dt_critical) << " or \"Foundation/Substeps\" to "
              << std::ceil(time_step / dt_critical)
              << ", take larger rock elements, or less \"Foundation/Stiffness damping\".";
      throw InputError(message.str());
    }
    check_stability(time_step);
  }

  void ExplicitRock::check_stability(const double time_step) const
  {
    const double rock_dt = time_step / parameters.substeps;
    check_substeps(parameters, rock_dt);
    if (!is_transmitting(parameters))
      return;
    check_quadrature(parameters, rock_dt);
    check_poisson(parameters, rock_dt, dt_critical);
    std::vector<unsigned int> nodes;
    for (const Foot &f : foot)
      nodes.push_back(f.rock);
    check_distance(TransmittingBoundary(transmitting_formula(parameters.boundary), model.lines, rock_dt),
                   nodes, n_nodes());
  }
} // namespace Voussoir
