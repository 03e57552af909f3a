// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_modes_h
#define voussoir_modes_h

#include <voussoir/solid/structure.h>

namespace Voussoir
{
  /** A natural mode of vibration. */
  struct NaturalMode
  {
    double   frequency; ///< [Hz]
    Unknowns shape;     ///< phi, with phi^T M phi = 1 [1/sqrt(kg)]

    /** Participation factors phi^T M r of motion of the base along x, y and z [sqrt(kg)]; their squares are
     * the effective masses, which over all modes add up to free_mass(). */
    Vector3 participation(const Structure &structure) const;
  };

  /** Mass of the free nodes, the water's with it, along x, y and z: r^T M r [kg]. */
  Vector3 free_mass(const Structure &structure);

  /** The lowest modes of a structure without pairs, by ascending frequency: K phi = omega^2 M phi by
   * ARPACK, inverse iteration; by several ranks: modes_of_ranks(). Throws ComputationError when it does not
   * converge. */
  std::vector<NaturalMode> natural_modes(const Structure &structure, unsigned int n_modes);

  /** The same by several ranks: Krylov and Schur's method of SLEPc, the factor of the stiffness by MUMPS,
   * shared out. In another order of operations, so with other bits than one rank has. To be called by all;
   * all get all modes. */
  std::vector<NaturalMode> modes_of_ranks(const Structure &structure, unsigned int n_modes);

  /** The lowest natural frequencies alone [Hz]. */
  std::vector<double> natural_frequencies(const Structure &structure, unsigned int n_modes);
} // namespace Voussoir

#endif
