// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/foundation/region_parameters.h>
#include <voussoir/foundation/rock_report.h>
#include <voussoir/rock/artificial_boundary.h>
#include <voussoir/rock/boundary_table.h>
#include <voussoir/rock/plane_wave.h>

#include <algorithm>

namespace Voussoir
{
  namespace
  {
    /** Writes the layers of nodal quadrature and the layers at the dam to the log, with warnings. */
    void report_layers(const FoundationParameters &parameters, const RockModel &model, Log &log)
    {
      const unsigned int nodal_layers = region_parameters(parameters, {}, 0.).rock.nodal_layers;
      if (nodal_layers != parameters.nodal_layers)
        log.line("          %u layers of nodal quadrature at the artificial boundary, not the %u of "
                 "\"Foundation/Nodal layers\", because the boundary %s requires them",
                 nodal_layers, parameters.nodal_layers, parameters.boundary.c_str());
      if (parameters.layers_at_dam == 0)
        return;
      const unsigned int n = model.n_cells_at_dam, n_nodal = model.n_nodal_at_dam;
      log.line(
          "          %u rock elements at the base have the dam's element type (Foundation/Layers at the dam)",
          n - n_nodal);
      if (n == 0)
        log.line(
            "warning: \"Foundation/Layers at the dam\" has no effect, because no rock element has a face "
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

    /** Writes directions of the waves to the log, with a warning if a component of the motion has no wave. */
    void report_waves(const FoundationParameters &parameters, Log &log)
    {
      const std::vector<PlaneWave> waves = read_incidence(parameters.incidence);
      if (waves.empty())
        return;
      log.line("          incident waves: %s", parameters.incidence.c_str());
      const auto is_missing = [&](const PlaneWave::Type type) {
        return std::none_of(waves.begin(), waves.end(),
                            [type](const PlaneWave &w) { return w.type == type; });
      };
      for (const auto &[type, component] : std::vector<std::pair<PlaneWave::Type, const char *>>{
               {PlaneWave::P, "the vertical component"},
               {PlaneWave::SV, "the horizontal component along the azimuth"},
               {PlaneWave::SH, "the horizontal component normal to the azimuth"}})
        if (is_missing(type))
          log.line(
              "warning: %s of the ground motion does not enter, because \"Foundation/Incidence\" has no %s wave",
              component,
              type == PlaneWave::P    ? "P"
              : type == PlaneWave::SV ? "SV"
                                      : "SH");
    }
  } // namespace

  void report_rock(const FoundationParameters &parameters, const RockModel &model, const TimeGrid &grid,
                   const double delay, Log &log)
  {
    log.line("Rock      explicit: %s", in_words(parameters.rock).c_str());
    log.line("          %u nodes; boundary %s, free field by %s",
             static_cast<unsigned int>(model.points.size()), parameters.boundary.c_str(),
             parameters.free_field.c_str());
    log.line("          10 elements or more per shear wave up to %.2g Hz (95 %% of the elements)",
             .1 / model.largest_crossing);
    if (parameters.quality > 0.)
      log.line("          quality factor %g from %g to %g Hz, within %g %%", parameters.quality,
               RockDamping().lowest, RockDamping().highest, 100. * RockDamping::error_of_quality);
    report_waves(parameters, log);
    if (grid.n > 0)
      log.line("          the earthquake arrives at the lowest base node after %.3f s", delay);
    if (grid.n > 0 && delay >= grid.n * grid.dt)
      log.line(
          "warning: the run ends at %.3f s, before the earthquake has arrived at the dam. Increase \"Motion/Duration\", set it "
          "to -1, or reduce the delays of \"Foundation/Incidence\"",
          grid.n * grid.dt);
    const std::string warning =
        make_boundary(parameters.boundary)->warning(region_parameters(parameters, {}, grid.substep()));
    if (!warning.empty())
      log.line("warning: %s", warning.c_str());
    report_layers(parameters, model, log);
  }
} // namespace Voussoir
