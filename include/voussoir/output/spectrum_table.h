// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_spectrum_table_h
#define voussoir_spectrum_table_h

#include <voussoir/motion/ground_motion.h>
#include <voussoir/motion/motion_parameters.h>
#include <voussoir/output/recorders.h>

namespace Voussoir
{
  /** spectrum.csv: pseudo-acceleration [m/s^2] of the motion's components over the period [s], at the damping
   * of Motion/Damping, and of an artificial motion what it was to match. */
  Table spectrum_table(const GroundMotion &motion, const MotionParameters &parameters);
} // namespace Voussoir

#endif
