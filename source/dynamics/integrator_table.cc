// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/internal_error.h>
#include <voussoir/base/names.h>
#include <voussoir/dynamics/integrator_table.h>
#include <voussoir/dynamics/leapfrog.h>
#include <voussoir/dynamics/newmark.h>

#include <algorithm>

namespace Voussoir
{
  namespace
  {
    std::unique_ptr<Integrator> make_newmark(const IntegratorInput &input)
    {
      return std::make_unique<Newmark>(input.structure, input.laws, input.contact, input.dt, input.rule,
                                       input.support, input.single_factors);
    }

    std::unique_ptr<Integrator> make_leapfrog(const IntegratorInput &input)
    {
      ensure(!input.support, "The leapfrog rule has no support.");
      return std::make_unique<Leapfrog>(input.structure, input.laws, input.dt, input.n_steps,
                                        input.neighbours);
    }
  } // namespace

  const std::vector<IntegratorRow> &integrator_table()
  {
    static const std::vector<IntegratorRow> table = {
        {"trapezoidal", "implicit trapezoidal rule, joints coupled in each step", make_newmark},
        {"explicit", "leapfrog rule with steps below the critical one, each pair of nodes solved alone",
         make_leapfrog}};
    return table;
  }

  std::string integrator_names()
  {
    return names_of(integrator_table());
  }

  std::string integrator_docs()
  {
    return docs_of(integrator_table());
  }

  std::unique_ptr<Integrator> make_integrator(const std::string &name, const IntegratorInput &input)
  {
    const auto &table = integrator_table();
    const auto  row =
        std::find_if(table.begin(), table.end(), [&](const IntegratorRow &r) { return name == r.name; });
    ensure(row != table.end(), "There is no such time scheme.");
    return row->make(input);
  }
} // namespace Voussoir
