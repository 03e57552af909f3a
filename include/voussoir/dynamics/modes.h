// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_modes_h
#define voussoir_modes_h

#include <voussoir/solid/structure.h>

#include <functional>

namespace Voussoir
{
  /** Natural mode of vibration. */
  struct NaturalMode
  {
    double   frequency; ///< [Hz]
    Unknowns shape;     ///< mode shape phi with phi^T M phi = 1, three values per node [1/sqrt(kg)]

    /** Returns the participation factors phi^T M r for base motion r along x, y and z [sqrt(kg)]. Their
     * squares are the effective masses. The effective masses of all modes add up to free_mass(). */
    Vector3 participation(const Structure &structure) const;

    /** Returns the mean scale of Damping::zones, weighted by the strain energy [-]. */
    double scale(const Structure &structure) const;

    /** Returns the effective masses relative to free_mass() [-]; 0 along y in plane strain. */
    Vector3 mass_share(const Structure &structure) const;
  };

  /** Returns the mass of the free nodes along x, y and z, including the added mass: r^T M r [kg]. It is 0 along y in
   * plane strain. */
  Vector3 free_mass(const Structure &structure);

  /** Adds the product of a further mass matrix, such as that of incompressible water, and a vector with three values
   * per node: add_mass(x, y) computes y += M_w x. */
  using AddMass = std::function<void(const Unknowns &x, Unknowns &y)>;

  /** Returns the @p n_modes lowest modes of a structure without pairs, by ascending frequency. Solves
   * K phi = omega^2 M phi by inverse iteration with ARPACK, on one MPI process. Of frequencies that are exactly
   * equal, some may be missing. Throws InputError if the structure has too few unknowns, and ComputationError
   * if the iteration does not converge within @p max_iterations restarts. @p add_mass: symmetric further mass; empty:
   * none. */
  std::vector<NaturalMode> natural_modes(const Structure &structure, unsigned int n_modes,
                                         unsigned int max_iterations = 1000, const AddMass &add_mass = {});
} // namespace Voussoir

#endif
