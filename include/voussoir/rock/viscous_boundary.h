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
    Matrix3      stiffness; ///< [N/m], zero for a viscous boundary
  };

  /** Lysmer's dashpots (rho c A) on the artificial boundary, with springs factor G/r A unless the factors
   * are zero (Liu, Du and Yan 2006: 4/3 normal, 2/3 tangential in three dimensions). */
  std::vector<Dashpot> viscous_dashpots(const RockModel &model, const std::array<double, 3> &centre,
                                        double normal_spring, double tangential_spring);

  /** Lysmer's dashpots, with springs unless the factors are zero: explicit, with the dashpot's force taken at
   * the time itself, and with the force that keeps the free field moving as if there were no boundary. */
  class ViscousBoundary : public ArtificialBoundary
  {
  public:
    /** Factors of the springs: see viscous_dashpots(). */
    ViscousBoundary(double normal_spring, double tangential_spring);

    void attach(const RockModel &model, const Vector3 &centre, double dt) override;

    const std::vector<unsigned int> &nodes() const override { return node; }

    /** Its own nodes and their neighbours. */
    const std::vector<unsigned int> &free_field_nodes() const override { return neighbours; }

    void advance(const RegionStep &step) override;

    void                      keep(const std::vector<bool> &stepped) override;
    std::vector<unsigned int> kept_points() const override { return points; }

  private:
    Vector3 free_field_force(const RegionStep &step, unsigned int dashpot) const;

    double                    normal_spring, tangential_spring;
    std::vector<Dashpot>      dashpots;
    std::vector<unsigned int> node;             ///< of each dashpot
    std::vector<unsigned int> kept;             ///< dashpots
    std::vector<unsigned int> points;           ///< neighbours that are needed; after keep()
    std::vector<Matrix3>      effective;        ///< inverse of M + dt/2 C
    std::vector<unsigned int> neighbours;       ///< own nodes included, ascending
    std::vector<unsigned int> own_number;       ///< of the dashpots' nodes among them
    std::vector<unsigned int> neighbour_number; ///< of the entries of the dashpots' rows among them,
    std::vector<std::size_t>  first_neighbour;  ///< beginning here
    std::vector<Matrix3>      row;              ///< these entries
  };
} // namespace Voussoir

#endif
