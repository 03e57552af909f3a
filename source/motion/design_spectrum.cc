// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/error.h>
#include <voussoir/motion/design_spectrum.h>

#include <algorithm>
#include <cmath>

namespace Voussoir
{
  namespace
  {
    double descent_exponent(const std::string &code)
    {
      if (code == "DL5073-2000")
        return 0.9;
      if (code == "NB35047-2015")
        return 0.6;
      throw InputError("Motion/Spectrum: there is no design spectrum '" + code +
                       "'. Choose DL5073-2000 or NB35047-2015.");
    }
  } // namespace

  double design_beta(const DesignSpectrum &spectrum, double period)
  {
    constexpr double plateau_begin = 0.1; // [s]
    constexpr double floor = 0.2;         // relative to the plateau

    const double gamma = descent_exponent(spectrum.code);
    const double beta = spectrum.maximum_beta;
    if (period < plateau_begin)
      return 1. + (beta - 1.) * period / plateau_begin;
    if (period <= spectrum.characteristic_period)
      return beta;
    return beta * std::max(std::pow(spectrum.characteristic_period / period, gamma), floor);
  }
} // namespace Voussoir
