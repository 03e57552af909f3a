// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/contact/contact_result.h>

#include <algorithm>

namespace Voussoir
{
  const char *name(const ContactPath path)
  {
    switch (path)
    {
    case ContactPath::newton:
      return "newton";
    case ContactPath::sweeps:
      return "sweeps";
    case ContactPath::proximal:
      return "proximal";
    case ContactPath::smaller_step:
      return "smaller_step";
    }
    return "";
  }

  void ContactResult::add_work(const ContactResult &other)
  {
    iterations += other.iterations;
    krylov += other.krylov;
    factorisations += other.factorisations;
    sweeps += other.sweeps;
  }

  ContactResult &ContactResult::operator+=(const ContactResult &other)
  {
    add_work(other);
    converged = converged && other.converged;
    residual = std::max(other.converged ? residual : 0., other.residual);
    residual_over_load = std::max(other.converged ? residual_over_load : 0., other.residual_over_load);
    path = std::max(path, other.path);
    worst_pair = other.worst_pair;
    return *this;
  }
} // namespace Voussoir
