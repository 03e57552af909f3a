// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_design_spectrum_h
#define voussoir_design_spectrum_h

#include <string>

namespace Voussoir
{
  /** The standard design response spectrum of Chinese hydraulic structures. */
  struct DesignSpectrum
  {
    std::string code = "DL5073-2000";        ///< or "NB35047-2015": they differ in the descent
    double      characteristic_period = 0.2; ///< T_g of the site [s], more than 0.1 s
    double      maximum_beta = 2.5;          ///< height of the plateau; 2.5 for arch dams
  };

  /** Spectral acceleration at 5 % damping, divided by the peak ground acceleration [-], at a natural
   *  period [s]. DL 5073-2000 (and SL 203-97) and NB 35047-2015 (and GB 51247-2018) share
   *
   *      beta = 1 + (beta_max - 1) T / 0.1 s    T < 0.1 s
   *           = beta_max                        0.1 s <= T <= T_g
   *           = beta_max (T_g / T)^gamma        T > T_g,
   *
   *  never below 0.2 beta_max beyond T_g; gamma is 0.9 in the former and 0.6 in the latter. The codes end
   *  at 3 s; the last branch is continued here. An unknown code is an InputError. */
  double design_beta(const DesignSpectrum &spectrum, double period);
} // namespace Voussoir

#endif
