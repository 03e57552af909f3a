// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/error.h>
#include <voussoir/dam/scene.h>
#include <voussoir/output/energy_check.h>

#include <sstream>

namespace Voussoir
{
  void check_energies(const Scene &scene, const double dam, const double rock, const std::string &directory)
  {
    const bool of_rock = !(rock <= largest_balance_error);
    if (!of_rock && dam <= largest_balance_error)
      return;
    std::ostringstream message;
    message.precision(2);
    message << "The energies of the " << (of_rock ? "rock" : "dam") << " do not balance: their error is "
            << (of_rock ? rock : dam) << " of the largest energy, the limit is " << largest_balance_error
            << ". Do not use the results in " << directory << ". Column \""
            << (of_rock ? "rock_balance" : "balance")
            << "\" of energy.csv shows when the error begins. Use a "
            << "smaller time step (\"Dynamics/Steps per sample\") or a smaller \"Contact/Tolerance\" (now "
            << scene.contact.tolerance << ")";
    if (of_rock)
      message << ", or another \"Foundation/Boundary\"";
    else if (scene.impact_rule != "mean-force")
      message << ", or \"Dynamics/Impact\" = mean-force";
    throw ComputationError(message.str() + ".");
  }
} // namespace Voussoir
