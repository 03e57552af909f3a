// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/error.h>
#include <voussoir/motion/motion.h>
#include <voussoir/motion/motion_artificial.h>
#include <voussoir/motion/motion_files.h>

#include <cmath>
#include <sstream>

namespace Voussoir
{
  namespace
  {
    /** Throws InputError if a sample is not finite or exceeds 1000 g. */
    void check_samples(const GroundMotion &motion)
    {
      constexpr double limit = 1000. * standard_gravity;
      for (std::size_t k = 0; k < motion.acceleration.size(); ++k)
        for (const double a : motion.acceleration[k])
          if (!(std::abs(a) <= limit))
          {
            std::ostringstream message;
            message << "The acceleration of the ground motion at " << k * motion.dt << " s is " << a
                    << " m/s^2, " << a / standard_gravity
                    << " g. The limit is 1000 g. Check the entries Motion/Unit, Factor, Scale x, y, z and "
                       "Peak acceleration.";
            throw InputError(message.str());
          }
    }
  } // namespace

  GroundMotion make_motion(const MotionParameters &parameters, const std::string &scene_directory)
  {
    parameters.check();

    GroundMotion motion;
    if (parameters.source == "artificial")
      motion = make_artificial_motion(parameters);
    else if (parameters.source == "file")
      motion = read_motion(parameters, scene_directory);
    else
    {
      motion.dt = parameters.time_step;
      motion.acceleration.resize(parameters.n_steps() + 1, {{0., 0., 0.}});
    }
    const double factor =
        parameters.source == "artificial" ? parameters.factor : 1.; // read_motion() includes it for records
    for (auto &sample : motion.acceleration)
      for (unsigned int d = 0; d < 3; ++d)
        sample[d] *= factor * parameters.scale[d];
    check_samples(motion);
    return motion;
  }
} // namespace Voussoir
