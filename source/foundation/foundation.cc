// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/entries.h>
#include <voussoir/foundation/foundation.h>
#include <voussoir/foundation/foundation_names.h>
#include <voussoir/rock/boundary_table.h>

namespace Voussoir
{
  void FoundationParameters::add_parameters(Entries &prm)
  {
    using namespace dealii::Patterns;
    prm.enter_subsection("Foundation");
    prm.add_parameter("Model", model, "What the dam stands on. " + foundation_docs() + ".",
                      Selection(foundation_names()));
    prm.add_parameter("Young's modulus", rock.young, "Modulus of elasticity of the rock [Pa].", {5e8, 1.2e11},
                      Double(1.));
    prm.add_parameter("Poisson's ratio", rock.poisson, "Poisson's ratio of the rock [-].", {.1, .4, true},
                      Double(0., largest_poisson));
    prm.add_parameter("Density", rock.density, "Density of the rock [kg/m^3].", {1800., 3300.}, Double(1e-3));
    prm.add_parameter("Zones", zones,
                      "Materials of zones of the rock, as \"NAME: E nu rho, NAME: E nu rho\", modulus of "
                      "elasticity, Poisson's ratio and density, in Pa and kg/m^3 or with units; NAME is that "
                      "of the volumes \"rock NAME\" of the mesh.",
                      Map(Anything(), Anything()));
    prm.add_parameter("Mass damping", mass_damping, "Rayleigh damping of the rock: factor of the mass [1/s].",
                      {0., 10.}, Double(0., 1e3));
    prm.add_parameter(
        "Stiffness damping", stiffness_damping,
        "Rayleigh damping of the rock: factor of the stiffness [s]. It lowers the critical time step.",
        {0., .01}, Double(0., 1.));
    prm.add_parameter("Boundary", boundary, "Artificial boundary: " + boundary_help() + ".",
                      Selection(boundary_names("|")));
    prm.add_parameter(
        "Free field", free_field,
        "Motion without the dam at the artificial boundary: sections (slices of the mesh where it cuts "
        "the valley) or columns (layers, with the local height of the ground).",
        Selection("sections|columns"));
    prm.add_parameter(
        "Nodal quadrature everywhere", nodal_everywhere,
        "Integrate all rock elements but those at the dam at their nodes, which is fastest and what free "
        "field by sections needs to be exact; else only the layers at the boundary.");
    prm.add_parameter(
        "Nodal layers", nodal_layers,
        "Layers of nodal quadrature at the artificial boundary. With Nodal quadrature everywhere at least as "
        "many as the boundary needs; log and summary have the number.",
        Integer(0));
    prm.add_parameter("Layers at the dam", layers_at_dam,
                      "Layers of rock elements about the dam's base whose stiffness is that of the dam's "
                      "elements (Gauss points, and modes with Elements/Incompatible modes), except in the "
                      "layers at the artificial boundary: nodal quadrature makes the rock there too stiff.",
                      Integer(0, 1000));
    prm.add_parameter("Substeps", substeps, "Explicit steps of the rock in each step of the dam.",
                      Integer(1, 100));
    prm.add_parameter(
        "Coupling", coupling,
        "Of dam and rock. mean traction: forces that are constant in each step of the dam, such "
        "that dam and rock agree at its end; exact in energy for any number of sub-steps. "
        "partition: the rock feels the predicted motion of the dam's base; with sub-steps the "
        "base is made heavier: see doc/rock.md for the error. auto: partition for one sub-step, "
        "mean traction for more.",
        Selection("auto|mean traction|partition"));
    prm.leave_subsection();
  }

  std::string Foundation::about_steps() const
  {
    return "; the scheme is implicit: there is no critical time step";
  }

  ContactResult Foundation::settle(const DamSolve &solve, const Unknowns &, const Unknowns &, Unknowns &load,
                                   Log &)
  {
    return solve(load);
  }
} // namespace Voussoir
