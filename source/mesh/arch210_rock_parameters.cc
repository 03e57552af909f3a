// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/entries.h>
#include <voussoir/base/error.h>
#include <voussoir/base/number_text.h>
#include <voussoir/mesh/arch210_rock.h>

namespace Voussoir
{
  void Arch210RockParameters::add_parameters(Entries &prm)
  {
    using namespace dealii::Patterns;
    prm.enter_subsection("Mesh");
    prm.enter_subsection("Arch210");
    prm.enter_subsection("Rock");
    prm.add_parameter("Enabled", enabled,
                      "true: the mesh includes the rock around the dam. false: the base is rigid.", Bool());
    const std::string from = " [m], from the outermost base nodes of the dam to the artificial boundary.";
    prm.add_parameter("Upstream", upstream, "Length of the rock upstream" + from, {50., 2000.},
                      Double(50, 1e5));
    prm.add_parameter("Downstream", downstream, "Length of the rock downstream" + from, {50., 2000.},
                      Double(50, 1e5));
    prm.add_parameter("Sides", sides, "Length of the rock on either side" + from, {50., 2000.},
                      Double(50, 1e5));
    prm.add_parameter("Depth", depth, "Depth of the rock" + from, {50., 2000.}, Double(50, 1e5));
    prm.add_parameter("Element size", element_size,
                      "Size of the rock elements far from the dam [m]. They are smaller where the rock is "
                      "thinnest, and up to 1.7 times as large where it is thickest. Across the valley, "
                      "\"Elements along\" determines their number.",
                      {2., 100.}, Double(1, 1e4));
    prm.add_parameter("Boundary layers", n_layers,
                      "Number of layers of equal elements along the artificial boundary [-]. A transmitting "
                      "boundary requires them.",
                      Integer(6, 100));
    prm.leave_subsection();
    prm.leave_subsection();
    prm.leave_subsection();
  }

  void Arch210RockParameters::check() const
  {
    const std::string entry = "Entry \"Mesh/Arch210/Rock/";
    for (const auto &length : {std::make_pair("Upstream", upstream), std::make_pair("Downstream", downstream),
                               std::make_pair("Sides", sides), std::make_pair("Depth", depth)})
      if (!(length.second >= 50))
        throw InputError(entry + length.first + "\" is " + number_text(length.second) +
                         " m. Choose at least 50 m; one height of the dam is usual.");
    if (!(element_size >= 1))
      throw InputError(entry + "Element size\" is " + number_text(element_size) + " m. Choose at least 1 m.");
    if (n_layers < 6)
      throw InputError(entry + "Boundary layers\" is " + std::to_string(n_layers) + ". Choose at least 6.");
  }
} // namespace Voussoir
