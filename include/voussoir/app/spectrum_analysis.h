// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_spectrum_analysis_h
#define voussoir_spectrum_analysis_h

#include <voussoir/dam/dam.h>
#include <voussoir/dynamics/modes.h>

#include <functional>

namespace Voussoir
{
  /** Spectrum of `voussoir modes --spectrum`. */
  struct ChosenSpectrum
  {
    std::string name;    ///< for the terminal
    double      damping; ///< damping ratio of the spectrum [-]

    /** Returns the pseudo-acceleration along x, y, z at a period [s]; at period 0 the peak ground acceleration
     * [m/s^2]. Throws InputError if a table ends at a shorter period. */
    std::function<Vector3(double period)> at;

    double last_period; ///< end of the range for Gupta's method [s]
  };

  /** Returns the spectrum that --spectrum names. The factors of the ground motion multiply it: "Motion/Factor",
   * "Motion/Scale x, y, z" and that of the load combination.
   *  - design: the design spectrum of section "Motion", MotionParameters::target().
   *  - otherwise: a file, read_spectrum(), with "Motion/Vertical ratio". It is valid for "Damping/Ratio".
   *
   * Throws InputError if the scene has no design spectrum, if the file is wrong, and if the spectrum is zero. */
  ChosenSpectrum choose_spectrum(const Scene &scene, const std::string &choice);

  /** Prints the response to a spectrum: displacements of the crest, support forces, stresses of the faces,
   * and warnings.
   * @param dam dam with tied joints
   * @param modes its modes. Those above SpectrumTable::rigid_period are not combined: they are part of the
   * residual response.
   * @param spectrum choose_spectrum()
   * @param directory for response_spectrum.csv and response_spectrum.vtu; empty: none */
  void print_spectrum_analysis(const Dam &dam, const std::vector<NaturalMode> &modes,
                               const ChosenSpectrum &spectrum, const std::string &directory);
} // namespace Voussoir

#endif
