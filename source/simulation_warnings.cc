#include <voussoir/simulation.h>

#include <algorithm>

namespace Voussoir
{
  /** What the input means that may not be meant. */
  void Simulation::report_motion_and_warnings()
  {
    constexpr double highest_peak = 2.; // [g]
    if (n_steps == 0)
      log.line("Motion    none: the static state alone");
    else
    {
      MotionParameters measures_only = scene.motion;
      measures_only.source = "file"; // without the errors of an artificial motion's spectrum
      const auto   c = Voussoir::report_motion(motion, measures_only).components;
      const double g = standard_gravity;
      log.line("Motion    x, y, z: PGA %.3f %.3f %.3f g, PGV %.3f %.3f %.3f m/s, PGD %.3f %.3f %.3f m",
               c[0].peak_acceleration / g, c[1].peak_acceleration / g, c[2].peak_acceleration / g,
               c[0].peak_velocity, c[1].peak_velocity, c[2].peak_velocity, c[0].peak_displacement,
               c[1].peak_displacement, c[2].peak_displacement);
      double peak = 0.;
      for (const auto &component : c)
        peak = std::max(peak, component.peak_acceleration / g);
      if (peak > highest_peak || peak < 1e-4)
        log.line("warning: the peak acceleration of the motion is %.3g g; usual is 0.005 to 2 g. Check "
                 "Motion/Unit, Motion/Factor and Motion/Scale x, y, z.",
                 peak);
    }
    if (scene.mesh.source == "arch210" && scene.mesh.arch210_rock.enabled &&
        scene.foundation.model == "rigid")
      log.line("warning: the rock of Mesh/Arch210/Rock is left out: Foundation/Model is rigid.");
    if (scene.reservoir.density > 0. && !dam->has_water)
      log.line("warning: the water does not reach the dam: Reservoir/Water level is %g m, below the upstream "
               "face. Raise it, in the axes of the scene, or set Reservoir/Density to 0.",
               scene.reservoir.level);
    for (const std::string &warning : scene.warnings)
      log.line("warning: %s", warning.c_str());
  }
} // namespace Voussoir
