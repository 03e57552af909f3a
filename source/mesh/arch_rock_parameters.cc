// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/entries.h>
#include <voussoir/base/error.h>
#include <voussoir/base/model_choices.h>
#include <voussoir/base/number_text.h>
#include <voussoir/mesh/arch_rock.h>

#include <algorithm>

namespace Voussoir
{
  void ArchRockParameters::add_parameters(Entries &prm, const bool or_from_height)
  {
    using namespace dealii::Patterns;
    prm.enter_subsection("Rock");
    prm.add_parameter(
        "Enabled", enabled,
        "true: the mesh of `voussoir mesh` includes the rock around the dam, also if Foundation/Model is rigid. "
        "With another foundation every mesh does.",
        Bool());
    const std::string from = std::string(" [m], from the outermost base nodes of the dam to the artificial "
                                         "boundary.") +
                             " Above the height of the dam it is rounded to whole elements." +
                             (or_from_height ? " 0: height of the dam." : "");
    const UsualRange usual{50., 2000., or_from_height};
    const double     least = or_from_height ? 0. : 50.;
    prm.add_parameter("Upstream", upstream, "Length of the rock upstream" + from, usual, Double(least, 1e5));
    prm.add_parameter("Downstream", downstream, "Length of the rock downstream" + from, usual,
                      Double(least, 1e5));
    prm.add_parameter("Sides", sides, "Length of the rock on either side" + from, usual, Double(least, 1e5));
    prm.add_parameter("Depth", depth, "Depth of the rock" + from, usual, Double(least, 1e5));
    prm.add_parameter("Element size", element_size,
                      "Size of the rock elements far from the dam [m]. They are smaller where the rock is "
                      "thin. Across the valley, \"Elements along\" determines their number." +
                          std::string(or_from_height ? " 0: 22/210 of the height of the dam." : ""),
                      {2., 100., or_from_height}, Double(or_from_height ? 0. : 1., 1e4));
    prm.add_parameter("Boundary layers", n_layers,
                      "Number of layers of equal elements along the artificial boundary [-]. A transmitting "
                      "boundary requires them.",
                      Integer(6, 100));
    prm.leave_subsection();
  }

  void ArchRockParameters::add_choices(const std::string &section, ModelChoices &choices) const
  {
    const ArchRockParameters now = complete(choices.top - choices.bottom);
    const std::string        rock = section + "/Rock/";
    for (const double share : {.7, 1.5})
      choices.add("foundation", share < 1. ? "smaller box of rock" : "larger box of rock",
                  {{rock + "Upstream", number_text(share * now.upstream)},
                   {rock + "Downstream", number_text(share * now.downstream)},
                   {rock + "Sides", number_text(share * now.sides)},
                   {rock + "Depth", number_text(share * now.depth)}},
                  share < 1.);
    choices.add("numerics", "larger rock elements", rock + "Element size", 1.4 * now.element_size, true);
    choices.add("numerics", "smaller rock elements", rock + "Element size", now.element_size / 1.4);
  }

  void ArchRockParameters::check(const std::string &section, const double height) const
  {
    const std::string entry = "Entry \"" + section + "/Rock/";
    // For arch210 the smallest length is 50 m.
    const double least = std::min(50., 0.5 * height), finest = std::min(1., height / 50);
    for (const auto &length : {std::make_pair("Upstream", upstream), std::make_pair("Downstream", downstream),
                               std::make_pair("Sides", sides), std::make_pair("Depth", depth)})
      if (!(length.second >= least))
        throw InputError(entry + length.first + "\" is " + number_text(length.second) +
                         " m. Choose at least " + number_text(least) + " m; one height of the dam is usual.");
    if (!(element_size >= finest))
      throw InputError(entry + "Element size\" is " + number_text(element_size) + " m. Choose at least " +
                       number_text(finest) + " m.");
    if (n_layers < 6)
      throw InputError(entry + "Boundary layers\" is " + std::to_string(n_layers) + ". Choose at least 6.");
  }

  ArchRockParameters ArchRockParameters::complete(const double height) const
  {
    ArchRockParameters result = *this;
    result.height = height;
    for (double *length : {&result.upstream, &result.downstream, &result.sides, &result.depth})
      if (*length == 0)
        *length = height;
    if (element_size == 0)
      result.element_size = height * 22 / 210;
    return result;
  }
} // namespace Voussoir
