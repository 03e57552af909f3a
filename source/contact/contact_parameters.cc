// SPDX-License-Identifier: GPL-3.0-or-later
#include <deal.II/base/parameter_handler.h>

#include <voussoir/base/model_choices.h>
#include <voussoir/contact/contact_parameters.h>

namespace Voussoir
{
  void ContactParameters::add_parameters(dealii::ParameterHandler &prm)
  {
    using dealii::Patterns::Double;
    using dealii::Patterns::Integer;
    prm.enter_subsection("Contact");
    prm.add_parameter("Tolerance", tolerance,
                      "Largest relative residual of the joint conditions in a converged step [-].",
                      Double(1e-15, 1e-3));
    prm.add_parameter("Maximum iterations", max_iterations,
                      "Largest number of Newton steps of a contact problem [-].", Integer(1));
    prm.add_parameter("Sweeps", sweeps, "Number of Gauss-Seidel iterations before the first Newton step [-].",
                      Integer(0));
    prm.add_parameter(
        "Write problems", write_problems,
        "true: write the contact problems to OUTPUT/contact, with the initial guess. Requires the "
        "law FJA or KSM. `voussoir-contact` solves the files.");
    prm.add_parameter("Write interval", write_interval,
                      "Every N-th contact problem is written, where N is this number [-].", Integer(1));
    prm.leave_subsection();
  }

  void ContactParameters::add_choices(ModelChoices &choices) const
  {
    if (const double other = 100. * tolerance; other <= 1e-6)
      choices.add("numerics", "tolerance of the joints " + number_text(other), "Contact/Tolerance", other,
                  true);
  }
} // namespace Voussoir
