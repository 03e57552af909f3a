// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_spectrum_table_h
#define voussoir_spectrum_table_h

#include <voussoir/motion/ground_motion.h>
#include <voussoir/motion/motion_parameters.h>
#include <voussoir/output/recorders.h>

namespace Voussoir
{
  /** Returns the table of spectrum.csv: pseudo-acceleration of the three components of the motion, RotD50 and
   * RotD100 of x and y [m/s^2] over the period [s], for the damping ratio "Motion/Damping". With a target
   * spectrum, additional columns contain it.
   * @param motion ground motion
   * @param parameters section "Motion" of the input file */
  Table spectrum_table(const GroundMotion &motion, const MotionParameters &parameters);
} // namespace Voussoir

#endif
