// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_spectrum_table_h
#define voussoir_spectrum_table_h

#include <voussoir/motion/ground_motion.h>
#include <voussoir/motion/motion_parameters.h>
#include <voussoir/output/recorders.h>

namespace Voussoir
{
  /** Returns the table of spectrum.csv: pseudo-acceleration [m/s^2] of the components of the motion over the
   * period [s], with the damping ratio "Motion/Damping". For an artificial motion it includes the targets. */
  Table spectrum_table(const GroundMotion &motion, const MotionParameters &parameters);
} // namespace Voussoir

#endif
