// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_water_modes_h
#define voussoir_water_modes_h

#include <voussoir/dynamics/modes.h>
#include <voussoir/water/acoustic_water.h>

namespace Voussoir
{
  /** Replaces the frequencies of the first modes in incompressible water by those in compressible water.
   *
   * Solves (K + s^2 (M + Ma(i |s|))) u = 0 for the complex circular frequency s, with
   * Ma(s) = rho^2 A (K_w + s C_w + s^2 M_w)^-1 A^T. So the water vibrates with a constant amplitude: the waves of a
   * decaying vibration grow with the distance, and a channel of finite length reflects them. The displacements u are
   * combinations of the given modes; the structural damping is left out.
   *
   * @param water coupling of dam and water
   * @param model AcousticWater::model_for(0)
   * @param modes modes with incompressible water; receives the frequencies [Hz], ascending. The shapes remain.
   * @param count number of modes to replace; the others complete the basis, and are taken where a path ends in an
   * earlier mode
   *
   * Returns the damping ratio of each mode by radiation at the end of the channel, and by absorption at bed and banks
   * [-]. It is not a number for a mode that keeps its frequency, because the iteration did not converge. */
  std::vector<double> make_compressible(const AcousticWater &water, const WaterModel &model,
                                        std::vector<NaturalMode> &modes, unsigned int count);
} // namespace Voussoir

#endif
