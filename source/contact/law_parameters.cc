// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/names.h>
#include <voussoir/contact/law_parameters.h>

namespace Voussoir
{
  namespace
  {
    const Names<Equations> names_of_equations = {{"alart-curnier", Equations::alart_curnier},
                                                 {"paper", Equations::paper}};
  } // namespace

  Equations equations_from_name(const std::string &name)
  {
    return value_of(names_of_equations, name, "are no equations", "equations");
  }

  std::string equations_names()
  {
    return selection(names_of_equations);
  }
} // namespace Voussoir
