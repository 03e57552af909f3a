// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/entries.h>
#include <voussoir/base/model_choices.h>
#include <voussoir/base/names.h>
#include <voussoir/dam/reservoir.h>

#include <algorithm>

namespace Voussoir
{
  using namespace dealii;

  void ReservoirParameters::add_parameters(Entries &prm)
  {
    prm.enter_subsection("Reservoir");
    prm.add_parameter("Water level", level,
                      "Height z of the water surface in the axes of the input file [m].", {-500., 9000.});
    prm.add_parameter("Density", density, "Density of the water [kg/m^3]. 0: empty reservoir.",
                      {900., 1300., true}, Patterns::Double(0.));
    prm.add_parameter("Model", model, "Water in the earthquake. " + water_model_docs() + ".",
                      Patterns::Selection(water_model_names()));
    prm.add_parameter("Added mass", added_mass,
                      "Entry of older scenes, for Model Westergaard only. Set Model instead.",
                      Patterns::Selection("Westergaard|Westergaard-nodal|none"));
    prm.add_parameter(
        "Table", table,
        "Model added mass table: CSV file with the columns depth [m], added mass per area "
        "[kg/m^2]. Between the depths the mass is linear. Its path is relative to the directory "
        "of the scene file.");
    prm.add_parameter(
        "Depth", depth,
        "Depth of the reservoir in Westergaard's formula. global: deepest point. local: vertical section "
        "through the node (generalised formula).",
        Patterns::Selection("global|local"));
    prm.add_parameter(
        "Factor", factor,
        "Factor of the added mass [-]. 0.5 is common in Chinese practice, and closer to an incompressible "
        "reservoir.",
        {.1, 1.5, true}, Patterns::Double(0.));
    prm.add_parameter("Sound speed", sound_speed, "Model acoustic: speed of sound in the water [m/s].",
                      {1300., 1550.}, Patterns::Double(1.));
    prm.add_parameter(
        "Reflection", reflection,
        "Model acoustic: reflection coefficient of bed and banks [-]. 1: rigid. 0: absorbs all waves.",
        Patterns::Double(0., 1.));
    prm.add_parameter(
        "Length", length,
        "Models acoustic and incompressible: length of the channel before its absorbing end [m], at least one depth. 0: two "
        "depths. In water volumes of a mesh file the damping layer begins there.",
        {50., 5000., true}, Patterns::Double(0.));
    prm.add_parameter(
        "Element size", element_size,
        "Models acoustic and incompressible: size of the water elements at the dam [m]. 0: a sixteenth of the depth. No effect if the mesh file has the volume 'water'.",
        {1., 50., true}, Patterns::Double(0.));
    prm.leave_subsection();
  }

  void ReservoirParameters::add_choices(ModelChoices &choices) const
  {
    if (density == 0. || level <= choices.bottom)
      return;
    choices.add("water", "empty reservoir", "Reservoir/Density", 0., true);
    choices.add("water", "water level 10 % lower", "Reservoir/Water level",
                level - .1 * (level - choices.bottom));
    if (kind() != "none")
      choices.add("water", "no added mass", {{"Reservoir/Model", "none"}}, true);
    for (const double share : {1., .5})
      if (kind() != "Westergaard" || factor != share)
      {
        std::map<std::string, std::string> entries = {{"Reservoir/Model", "Westergaard"},
                                                      {"Reservoir/Factor", number_text(share)}};
        if (added_mass != "Westergaard")
          entries["Reservoir/Added mass"] = "Westergaard";
        choices.add("water", share == 1. ? "Westergaard" : "half of Westergaard", entries, is_acoustic());
      }
    // Elements whose critical time step fits that of the dam: the mass increases little.
    const double size = std::max((level - choices.bottom) / 16., 1.1 * choices.time_step * sound_speed);
    for (const double alpha : {1., .75, .5})
      if (!is_acoustic() || alpha != reflection)
      {
        std::map<std::string, std::string> entries = {{"Reservoir/Model", "acoustic"},
                                                      {"Reservoir/Reflection", number_text(alpha)}};
        if (!is_acoustic())
          entries["Reservoir/Element size"] = number_text(size);
        choices.add("water", "compressible, reflection " + number_text(alpha), entries);
      }
  }
} // namespace Voussoir
