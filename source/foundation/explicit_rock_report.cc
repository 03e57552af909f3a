// SPDX-License-Identifier: GPL-3.0-or-later
// Rock in the log, in summary.json and in energy.csv.

#include <voussoir/foundation/explicit_rock.h>
#include <voussoir/rock/boundary_table.h>

#include <algorithm>
#include <sstream>

namespace Voussoir
{
  void ExplicitRock::report(Log &log, const TimeGrid &steps) const
  {
    log.line("Rock      explicit: %s", in_words(parameters.rock).c_str());
    log.line("          %u nodes; boundary %s, free field by %s", n_nodes(), parameters.boundary.c_str(),
             parameters.free_field.c_str());
    if (steps.n > 0)
      log.line("          the earthquake arrives at the lowest base node after %.3f s", arrival()[0]);
    const std::string warning =
        make_boundary(parameters.boundary)->warning(region_parameters(parameters, {}, steps.substep()));
    if (!warning.empty())
      log.line("warning: %s", warning.c_str());
    report_layers(log, region_parameters(parameters, {}, 0.).rock.nodal_layers);
  }

  void ExplicitRock::report_layers(Log &log, const unsigned int nodal_layers) const
  {
    if (nodal_layers != parameters.nodal_layers)
      log.line("          %u layers of nodal quadrature at the artificial boundary, not the %u of "
               "\"Foundation/Nodal layers\", because the boundary %s requires them",
               nodal_layers, parameters.nodal_layers, parameters.boundary.c_str());
    if (parameters.layers_at_dam == 0)
      return;
    const unsigned int n = model.n_cells_at_dam, n_nodal = model.n_nodal_at_dam;
    log.line("          %u elements at the dam's base are as the dam's", n - n_nodal);
    if (n == 0)
      log.line("warning: \"Foundation/Layers at the dam\" has no effect, because no rock element has a face "
               "on the surface \"base\". The rock at the dam is too stiff (doc/accuracy.md). Add these faces "
               "to the surface.");
    else if (n_nodal > 0)
      log.line(
          "warning: %u of %u elements of rock in \"Foundation/Layers at the dam\" have the nodal quadrature "
          "of the artificial boundary, so the rock there is too stiff (doc/accuracy.md)%s. Make the rock "
          "larger or its elements smaller, or reduce the layers at the dam",
          n_nodal, n,
          make_boundary(parameters.boundary)->n_layers() > 0
              ? ", and in large rock a transmitting boundary of order 3 or 4 may be unstable"
              : "");
  }

  std::string ExplicitRock::about_steps() const
  {
    std::ostringstream text;
    text.precision(4);
    text << ", in each " << parameters.substeps << " of the rock; critical time step of the rock "
         << dt_critical << " s";
    return text.str();
  }

  void ExplicitRock::add_to_summary(Json &summary, const TimeGrid &steps) const
  {
    Json json;
    json.add("nodes", n_nodes())
        .add("dofs", 3. * n_nodes())
        .add("boundary", parameters.boundary)
        .add("nodal_layers", region_parameters(parameters, {}, 0.).rock.nodal_layers)
        .add("elements_at_dam", model.n_cells_at_dam - model.n_nodal_at_dam)
        .add("arrival", arrival()[0])
        .add("time_step", steps.substep())
        .add("critical_time_step", dt_critical);
    if (balance)
      json.add("transmitted_energy", balance->of_rock().transmitted)
          .add("energy_balance_error", balance->error());
    summary.add("rock", json);
  }

  std::vector<std::pair<std::string, double>> ExplicitRock::energies() const
  {
    return balance ? balance->columns() : std::vector<std::pair<std::string, double>>();
  }

  double ExplicitRock::balance_error() const
  {
    return balance ? balance->error() : 0.;
  }

  void ExplicitRock::report_balance(Log &log) const
  {
    if (balance)
      log.line("          that of the rock to %.1e", balance->error());
  }
} // namespace Voussoir
