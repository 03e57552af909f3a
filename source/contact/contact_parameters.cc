// SPDX-License-Identifier: GPL-3.0-or-later
#include <deal.II/base/parameter_handler.h>

#include <voussoir/contact/contact_parameters.h>

namespace Voussoir
{
  void ContactParameters::add_parameters(dealii::ParameterHandler &prm)
  {
    using dealii::Patterns::Double;
    using dealii::Patterns::Integer;
    using dealii::Patterns::Selection;
    prm.enter_subsection("Contact");
    prm.add_parameter(
        "Tolerance", tolerance,
        "Relative residual of the joint conditions at which a step is accepted; independent of units [-].",
        Double(1e-15, 1e-3));
    prm.add_parameter("Maximum iterations", max_iterations, "Newton steps before the solver gives up [-].",
                      Integer(1));
    prm.add_parameter("Sweeps", sweeps, "Gauss-Seidel sweeps before the first Newton step [-].", Integer(0));
    prm.add_parameter("Method", method,
                      "newton (falls back on sweeps, then on the proximal point method), proximal, or sweeps "
                      "(Gauss-Seidel alone).",
                      Selection(method_names()));
    prm.add_parameter(
        "Write problems", write_problems,
        "Write the contact problems of the joints to OUTPUT/contact in FCLib's format, with the initial "
        "guess; for FJA, whose problems are Coulomb's. `voussoir contact` solves them.");
    prm.add_parameter("Write interval", write_interval, "Problems between two that are written [-].",
                      Integer(1));
    prm.leave_subsection();
  }

  std::string ContactParameters::method_names()
  {
    return "newton|proximal|sweeps";
  }
} // namespace Voussoir
