// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_design_spectrum_h
#define voussoir_design_spectrum_h

#include <string>

namespace Voussoir
{
  /** Standard design response spectrum of Chinese hydraulic structures. */
  struct DesignSpectrum
  {
    std::string code = "DL5073-2000";        ///< or "NB35047-2015"; the exponents of the descent differ
    double      characteristic_period = 0.2; ///< T_g of the site [s], at least 0.1 s
    double      maximum_beta = 2.5;          ///< ordinate of the plateau [-]; 2.5 for arch dams
  };

  /** Returns the spectral acceleration at 5 % damping, divided by the peak ground acceleration [-], at a
   * natural period [s]. DL 5073-2000 (and SL 203-97) and NB 35047-2015 (and GB 51247-2018) define
   *
   *      beta = 1 + (beta_max - 1) T / 0.1 s    T < 0.1 s
   *           = beta_max                        0.1 s <= T <= T_g
   *           = beta_max (T_g / T)^gamma        T > T_g,
   *
   * with a minimum of 0.2 beta_max beyond T_g. gamma is 0.9 in DL 5073-2000 and 0.6 in NB 35047-2015. The
   * codes end at 3 s; the last branch is continued here. Throws InputError for an unknown code. */
  double design_beta(const DesignSpectrum &spectrum, double period);
} // namespace Voussoir

#endif
