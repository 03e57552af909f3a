// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/error.h>
#include <voussoir/foundation/foundation_check.h>
#include <voussoir/foundation/region_parameters.h>
#include <voussoir/mesh/boundary_lines.h>
#include <voussoir/rock/boundary_table.h>
#include <voussoir/rock/growth.h>
#include <voussoir/rock/rock_region.h>

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

    void check_layers(const std::string &boundary, const HexMesh &mesh, const std::string &source,
                      const std::string &generated_in)
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
        if (!generated_in.empty())
          throw InputError(needs + ", but the mesh has fewer. Set \"" + generated_in +
                           "/Rock/Boundary layers\" to " + std::to_string(n) +
                           (n > n_usual ? ", or " + other : "."));
        throw InputError(needs + ". Error in " + error.what() + (n > n_usual ? " Or " + other : ""));
      }
    }
  } // namespace

  void check_boundary_layers(const FoundationParameters &parameters, const HexMesh &mesh,
                             const std::string &source, const std::string &generated_in)
  {
    check_layers(parameters.boundary, mesh, source, generated_in);
    if (has_other_sections(parameters))
      try
      {
        check_layers(boundary_of_sections(parameters), mesh, source, generated_in);
      }
      catch (const InputError &error)
      {
        throw InputError(sections_beside(parameters) + error.what() + without_sections);
      }
  }

  void check_damping(const RockRegionParameters &region)
  {
    if (!region.damping.has_quality())
      return;
    constexpr double   least = RockDamping::least_quality;
    std::ostringstream message;
    message << "\"Foundation/Quality factor\" = " << region.damping.quality;
    if (region.damping.quality < least)
      message << " is too small. Set it to " << least
              << " or more, or to 0 for rock without a quality factor.";
    else if (!region.incidence.is_vertical())
      message
          << " requires waves that rise vertically. Set \"Foundation/Incidence\" to vertical, or \"Foundation/Quality "
             "factor\" to 0.";
    else if (const auto boundary = make_boundary(region);
             boundary->absorbs() && boundary->nodes_per_line() == 0)
      message << " requires a boundary without dashpots, because their free-field forces have no memory. Set "
                 "\"Foundation/Boundary\" to mtf3, or \"Foundation/Quality factor\" to 0.";
    else
      return;
    throw InputError(message.str());
  }

  double largest_boundary_step(const FoundationParameters &parameters, const RockModel &model)
  {
    double step = make_boundary(parameters.boundary)->largest_step(model);
    if (has_other_sections(parameters))
      step = std::min(step, make_boundary(boundary_of_sections(parameters))->largest_step(model));
    return step;
  }

  void check_rock_step(const FoundationParameters &parameters, const TimeGrid &grid,
                       const unsigned int steps_per_sample, const double dt_critical,
                       const double dt_boundary)
  {
    const double rock_dt = grid.substep(), largest = std::min(dt_critical, dt_boundary);
    if (rock_dt <= largest) // false for NaN
      return;
    std::ostringstream message;
    if (rock_dt <= dt_critical)
      message << "The time step " << rock_dt
              << " s is too large for the artificial boundary of the rock: in a "
              << "step, its fastest wave travels more than the node spacing. The limit is " << dt_boundary
              << " s.";
    else
      message << beyond_critical_step(rock_dt, dt_critical);
    message << " Increase \"Dynamics/Steps per sample\" to "
            << std::ceil(steps_per_sample * rock_dt / largest);
    if (parameters.coupling != "partition")
      message << " or \"Foundation/Substeps\" to " << std::ceil(grid.dt / largest);
    message << ", enlarge the rock elements, "
            << (parameters.quality > 0. ? "increase \"Foundation/Quality factor\", " : "")
            << "or reduce \"Foundation/Stiffness damping\".";
    throw InputError(message.str());
  }

  void check_boundary(const FoundationParameters &parameters, const RockRegionParameters &region,
                      const RockModel &model, const std::vector<unsigned int> &base_nodes,
                      const double dt_critical)
  {
    const auto boundary = make_boundary(region);
    boundary->check(region);
    check_growth(region, dt_critical);
    if (has_other_sections(parameters))
      try
      {
        make_boundary(of_sections(region))->check(of_sections(region));
        check_growth(of_sections(region), dt_critical);
      }
      catch (const InputError &error)
      {
        throw InputError(sections_beside(parameters) + error.what() + without_sections);
      }
    boundary->attach(model, region.rock.centre, region.dt);
    boundary->check_prescribed(base_nodes);
  }
} // namespace Voussoir
