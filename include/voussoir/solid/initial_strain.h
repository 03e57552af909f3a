// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_initial_strain_h
#define voussoir_initial_strain_h

#include <voussoir/solid/stress.h>

namespace Voussoir
{
  /** What an isotropic strain that needs no stress (of temperature, of swelling) does to a model. */
  struct InitialStrain
  {
    Unknowns load; ///< the force of the concrete on its nodes while they are held, 3 per free node [N]
    std::vector<Stress> stress; ///< to be added to that of StressRecovery, per node of the model [Pa]
  };

  /** sigma = D (eps - strain), with @p strain at the nodes [-], between them as the displacements. The
   * incompatible modes follow the strain, too, so that it bends a free element without stress. Stresses are
   * taken, averaged and, with @p to_base, extrapolated to the base as in StressRecovery. */
  InitialStrain initial_strain(const SolidModel &model, const std::vector<Material> &materials,
                               bool incompatible_modes, const std::vector<double> &strain,
                               bool to_base = false);
} // namespace Voussoir

#endif
