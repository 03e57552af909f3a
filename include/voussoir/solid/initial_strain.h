// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_initial_strain_h
#define voussoir_initial_strain_h

#include <voussoir/solid/stress.h>

namespace Voussoir
{
  /** Effect of a stress-free isotropic strain, such as thermal strain or swelling. */
  struct InitialStrain
  {
    Unknowns            load;   ///< equivalent nodal forces, three values per free node [N]
    std::vector<Stress> stress; ///< stress to add to the result of StressRecovery, per node of the model [Pa]
  };

  /** Computes loads and stresses of an isotropic initial strain: sigma = D (eps - strain).
   *
   * The strain is interpolated like the displacements. The incompatible modes follow it, so a free element
   * bends without stress. The stresses are averaged and extrapolated as in StressRecovery.
   *
   * @param model mesh of the bodies
   * @param materials as in assemble_structure()
   * @param incompatible_modes as in assemble_structure()
   * @param strain strain at each node of the model [-]
   * @param to_base whether to extrapolate the stresses to the base, see NodalMean */
  InitialStrain initial_strain(const SolidModel &model, const std::vector<Material> &materials,
                               bool incompatible_modes, const std::vector<double> &strain,
                               bool to_base = false);
} // namespace Voussoir

#endif
