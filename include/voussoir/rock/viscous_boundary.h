// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_viscous_boundary_h
#define voussoir_viscous_boundary_h

#include <voussoir/rock/artificial_boundary.h>

namespace Voussoir
{
  /** Dashpot and spring between a boundary node and the free field. */
  struct Dashpot
  {
    unsigned int node;
    Matrix3      damping;   ///< [N s/m]
    Matrix3      stiffness; ///< [N/m]; zero for a viscous boundary
  };

  /** Returns the dashpots of Lysmer (rho c A) and the springs of all boundary nodes. The spring stiffness is
   * factor G/r A (Liu, Du and Yan 2006: factors 4/3 normal and 2/3 tangential in three dimensions).
   * @p centre: source point, from which r is measured [m]. */
  std::vector<Dashpot> viscous_dashpots(const RockModel &model, const std::array<double, 3> &centre,
                                        double normal_spring, double tangential_spring);

  /** Viscous boundary with the dashpots of Lysmer, and viscous-spring boundary if the spring factors are not
   * zero. The integration is explicit, with the dashpot force at the time itself. An additional force makes
   * the boundary follow the free field as if the rock continued. */
  class ViscousBoundary : public ArtificialBoundary
  {
  public:
    /** Creates a boundary with the given factors of the springs [-]; see viscous_dashpots(). */
    ViscousBoundary(double normal_spring, double tangential_spring);

    void attach(const RockModel &model, const Vector3 &centre, double dt) override;

    const std::vector<unsigned int> &nodes() const override { return node; }

    /** Returns the boundary nodes and their neighbours. */
    const std::vector<unsigned int> &free_field_nodes() const override { return neighbours; }

    void advance(const RegionStep &step) override;

    void                      keep(const std::vector<bool> &stepped) override;
    std::vector<unsigned int> kept_points() const override { return points; }

  private:
    Vector3 free_field_force(const RegionStep &step, unsigned int dashpot) const;

    double                    normal_spring, tangential_spring;
    std::vector<Dashpot>      dashpots;
    std::vector<unsigned int> node;             ///< node of each dashpot
    std::vector<unsigned int> kept;             ///< dashpots that this process integrates
    std::vector<unsigned int> points;           ///< neighbours that this process requires; set by keep()
    std::vector<Matrix3>      effective;        ///< inverse of M + dt/2 C [1/kg]
    std::vector<unsigned int> neighbours;       ///< neighbours and boundary nodes, ascending
    std::vector<unsigned int> own_number;       ///< index in neighbours of each dashpot
    std::vector<unsigned int> neighbour_number; ///< index in neighbours of each matrix entry in row
    std::vector<std::size_t>  first_neighbour;  ///< begin of each dashpot in neighbour_number and row
    std::vector<Matrix3>      row;              ///< matrix entries of the boundary nodes [N/m]
  };
} // namespace Voussoir

#endif
