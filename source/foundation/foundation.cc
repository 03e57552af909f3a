// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/entries.h>
#include <voussoir/foundation/foundation.h>
#include <voussoir/rock/boundary_table.h>

namespace Voussoir
{
  void FoundationParameters::add_parameters(Entries &prm)
  {
    using namespace dealii::Patterns;
    prm.enter_subsection("Foundation");
    prm.add_parameter("Model", model, "Foundation of the dam. " + foundation_docs() + ".",
                      Selection(foundation_names()));
    add_materials(prm);
    prm.add_parameter("Boundary", boundary,
                      "Artificial boundary at the edge of the rock mesh. " + boundary_help() + ".",
                      Selection(boundary_names("|")));
    prm.add_parameter(
        "Free field", free_field,
        "Free-field motion at the artificial boundary. sections: two-dimensional sections of the mesh where "
        "it cuts the valley, columns elsewhere. columns: columns of layered ground with the local height of "
        "the ground surface.",
        Selection("sections|columns"));
    prm.add_parameter(
        "Incidence", incidence,
        "Directions of the incident waves. vertical: all components of the motion rise vertically. Otherwise a list of plane "
        "waves, such as \"SV 30 90, P 20 90 0.5\": type, angle from the vertical [deg], azimuth of the horizontal direction of "
        "propagation from x to y [deg] and, if the wave arrives later than the others, the delay [s]. P carries the "
        "vertical component of the motion, SV the horizontal component along the azimuth, SH the horizontal component normal to it. "
        "Azimuth 90: from the right to the left bank.");
    prm.add_parameter(
        "Nodal quadrature everywhere", nodal_everywhere,
        "true: nodal (Gauss-Lobatto) quadrature in all rock elements except those of \"Layers at the dam\". "
        "This is the fastest option, and it makes the free field by sections exact. false: nodal quadrature "
        "in \"Nodal layers\" only.");
    prm.add_parameter("Nodal layers", nodal_layers,
                      "Number of element layers with nodal quadrature at the artificial boundary [-]. With "
                      "\"Nodal quadrature everywhere\" it is raised to the number that the boundary "
                      "requires. The log and summary.json contain the number in use.",
                      Integer(0));
    prm.add_parameter(
        "Layers at the dam", layers_at_dam,
        "Number of rock element layers at the dam base with the quadrature of the dam: Gauss "
        "points, and incompatible modes with \"Elements/Incompatible modes\" [-]. Elements in \"Nodal "
        "layers\" are excluded. Default 3, because nodal quadrature is too stiff there.",
        Integer(0, 1000));
    prm.add_parameter(
        "Substeps", substeps,
        "Number of explicit rock time steps per time step of the dam [-]. 0: as many as the critical "
        "time step of the rock and the boundary require, if \"Coupling\" is auto and \"Dynamics/Impact\" is "
        "mean-force; otherwise 1.",
        Integer(0, 100));
    prm.add_parameter(
        "Coupling", coupling,
        "Time coupling of dam and rock. mean traction: the forces are constant during a time step of the "
        "dam, and the displacements agree at its end. This conserves energy for any number of substeps. "
        "partition: the rock receives the predicted motion of the base, with one substep only. auto: "
        "partition for one substep, otherwise mean traction.",
        Selection("auto|mean traction|partition"));
    prm.leave_subsection();
  }

  void FoundationParameters::add_materials(Entries &prm)
  {
    using namespace dealii::Patterns;
    prm.add_parameter("Young's modulus", rock.young,
                      "Young's modulus of rock volumes without an entry in \"Zones\" [Pa].", {5e8, 1.2e11},
                      Double(1.));
    prm.add_parameter("Sustained modulus", sustained,
                      "Modulus of elasticity of the same volumes in the static state [Pa]. The moduli of "
                      "\"Zones\" have the same ratio to their sustained moduli. 0: Young's modulus.",
                      {3e8, 1.2e11, true}, Double(0.));
    prm.add_parameter("Poisson's ratio", rock.poisson,
                      "Poisson's ratio of the same volumes [-]. With a transmitting boundary of order 2 or "
                      "higher, values of 0.3 or more may require \"Stiffness damping\".",
                      {.1, .4, true}, Double(0., largest_poisson));
    prm.add_parameter("Density", rock.density, "Density of the same volumes [kg/m^3].", {1800., 3300.},
                      Double(1e-3));
    prm.add_parameter(
        "Zones", zones,
        "Materials of rock zones, as \"NAME: E nu rho, NAME: E nu rho\". E is Young's modulus, nu "
        "Poisson's ratio and rho the density, with units or in Pa and kg/m^3. NAME is the zone of "
        "the mesh volumes \"rock NAME\".",
        Map(Anything(), Anything()));
    prm.add_parameter("Mass damping", mass_damping,
                      "Factor of the mass matrix in the Rayleigh damping of the rock [1/s].", {0., 10.},
                      Double(0., 1e3));
    prm.add_parameter("Stiffness damping", stiffness_damping,
                      "Factor of the stiffness matrix in the Rayleigh damping of the rock [s]. It reduces "
                      "the critical time step.",
                      {0., .01}, Double(0., 1.));
    prm.add_parameter(
        "Quality factor", quality,
        "Quality factor of P and S waves in all explicit rock from 0.5 to 10 Hz [-], in addition to the Rayleigh "
        "damping. The damping ratio is 1/(2 Q). 0: none. It requires vertical incidence, a boundary without "
        "dashpots and a level bottom of the rock, and reduces the critical time step.",
        {10., 500., true}, Double(0., 1e6));
  }

  std::string FoundationSetup::about_steps() const
  {
    return "; the scheme of the dam is implicit, without a critical time step";
  }

  ContactResult BaseSupport::solve_static(const DamSolve &solve, const Unknowns &, const Unknowns &,
                                          Unknowns       &load, std::string &, Log &)
  {
    return solve(load);
  }
} // namespace Voussoir
