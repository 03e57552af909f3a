// SPDX-License-Identifier: GPL-3.0-or-later
// Checks of the stability of the rock before the run: see doc/boundary.md

#include <voussoir/base/error.h>
#include <voussoir/foundation/explicit_rock.h>
#include <voussoir/mesh/boundary_lines.h>
#include <voussoir/rock/boundary_table.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace Voussoir
{
  namespace
  {
    /** Returns the artificial boundary of the sections of the free field. */
    std::string boundary_of_sections(const FoundationParameters &parameters)
    {
      return of_sections(region_parameters(parameters, {{0., 0., 0.}}, 0.)).boundary;
    }

    /** Returns true if the sections of the free field have another boundary than the rock. */
    bool has_other_sections(const FoundationParameters &parameters)
    {
      return parameters.free_field == "sections" && boundary_of_sections(parameters) != parameters.boundary;
    }

    /** Returns the first sentence of a message about these sections. */
    std::string sections_beside(const FoundationParameters &parameters)
    {
      return "The sections of the free field beside the artificial boundary " + parameters.boundary +
             " have the boundary " + boundary_of_sections(parameters) + ". ";
    }

    const std::string without_sections = " Or set \"Foundation/Free field\" to columns.";

    void check_layers(const std::string &boundary, const HexMesh &mesh, const std::string &source)
    {
      const unsigned int n = make_boundary(boundary)->n_layers();
      if (n == 0)
        return;
      try
      {
        boundary_lines(mesh, n, source);
      }
      catch (const InputError &error)
      {
        const std::string needs = "The artificial boundary " + boundary + " requires " + std::to_string(n) +
                                  " layers of equal elements along the artificial boundary";
        const std::string  usual = FoundationParameters().boundary;
        const unsigned int n_usual = make_boundary(usual)->n_layers();
        const std::string  other =
            "set \"Foundation/Boundary\" to " + usual + ", which requires " + std::to_string(n_usual) + ".";
        if (source == "arch210")
          throw InputError(needs +
                           ", but the mesh arch210 has fewer. Set \"Mesh/Arch210/Rock/Boundary "
                           "layers\" to " +
                           std::to_string(n) + (n > n_usual ? ", or " + other : "."));
        throw InputError(error.what() + (" " + needs) +
                         (n > n_usual ? ". Add layers to the mesh, or " + other : "."));
      }
    }
  } // namespace

  void check_boundary_layers(const FoundationParameters &parameters, const HexMesh &mesh,
                             const std::string &source)
  {
    check_layers(parameters.boundary, mesh, source);
    if (has_other_sections(parameters))
      try
      {
        check_layers(boundary_of_sections(parameters), mesh, source);
      }
      catch (const InputError &error)
      {
        throw InputError(sections_beside(parameters) + error.what() + without_sections);
      }
  }

  void ExplicitRock::check(const TimeGrid &steps, const unsigned int steps_per_sample) const
  {
    const double rock_dt = steps.substep();
    if (!(rock_dt <= dt_critical)) // or not a number
    {
      std::ostringstream message;
      message << beyond_critical_step(rock_dt, dt_critical) << " Increase \"Dynamics/Steps per sample\" to "
              << std::ceil(steps_per_sample * rock_dt / dt_critical) << " or \"Foundation/Substeps\" to "
              << std::ceil(steps.dt / dt_critical)
              << " (with \"Foundation/Coupling\" = auto and "
                 "\"Dynamics/Impact\" = mean-force), enlarge the rock elements, or reduce "
                 "\"Foundation/Stiffness damping\".";
      throw InputError(message.str());
    }
    check_stability(steps);
  }

  void ExplicitRock::check_stability(const TimeGrid &steps) const
  {
    const RockRegionParameters p = region_parameters(parameters, centre, steps.substep());
    const auto                 boundary = make_boundary(p);
    boundary->check(p, dt_critical);
    if (has_other_sections(parameters))
      try
      {
        make_boundary(of_sections(p))->check(of_sections(p), dt_critical);
      }
      catch (const InputError &error)
      {
        throw InputError(sections_beside(parameters) + error.what() + without_sections);
      }
    boundary->attach(model, centre, steps.substep());
    std::vector<unsigned int> nodes;
    for (const BaseNode &f : at_base)
      nodes.push_back(f.rock);
    boundary->check_prescribed(nodes);
  }
} // namespace Voussoir
