// SPDX-License-Identifier: GPL-3.0-or-later
// The design spectra of both codes, on the plateau, in the descent and beyond where the codes end.

#include <voussoir/motion/design_spectrum.h>

#include <cstdio>

int main()
{
  for (const char *code : {"DL5073-2000", "NB35047-2015"})
    for (const double characteristic : {.2, .35})
    {
      std::printf("%s, T_g %.2f s, beta_max 2.5\n", code, characteristic);
      for (const double period : {0., .02, .05, .1, .15, .2, .25, .35, .5, .8, 1.5, 3., 5.})
        std::printf("  T %.2f s: %.12f\n", period,
                    Voussoir::design_beta({code, characteristic, 2.5}, period));
    }
}
