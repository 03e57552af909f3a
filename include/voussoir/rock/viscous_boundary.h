#ifndef voussoir_viscous_boundary_h
#define voussoir_viscous_boundary_h

#include <voussoir/rock/rock_model.h>

namespace Voussoir
{
  /** Dashpot and spring between a boundary node and the free field. */
  struct Dashpot
  {
    unsigned int node;
    Matrix3      damping;   ///< [N s/m]
    Matrix3      stiffness; ///< [N/m], zero for a viscous boundary
  };

  /** Lysmer's dashpots (rho c A) on the artificial boundary, with springs factor G/r A unless the factors
   * are zero (Liu, Du and Yan 2006: 4/3 normal, 2/3 tangential in three dimensions). */
  std::vector<Dashpot> viscous_dashpots(const RockModel &model, const std::array<double, 3> &centre,
                                        double normal_spring, double tangential_spring);
} // namespace Voussoir

#endif
