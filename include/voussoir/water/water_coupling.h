// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_water_coupling_h
#define voussoir_water_coupling_h

#include <voussoir/solid/solid_model.h>
#include <voussoir/water/water_model.h>

namespace Voussoir
{
  /** Wet quadrilaterals of the dam: the faces of the surface "upstream". */
  std::vector<WetQuad> wet_quads(const SolidModel &dam);

  /** Coupling of the water nodes at the wet face with the nodes of the dam.
   *
   * Each face of the dam is divided into parts of at most a quarter of the water's element size. The area vector of a
   * part belongs to the nearest water node of the same monolith. So each monolith has its
   * exact area, and no water node acts on two monoliths. */
  struct WaterCoupling
  {
    /** Area vector that a water node shares with a node of the dam. */
    struct Share
    {
      unsigned int water; ///< node of the water
      unsigned int node;  ///< node of the model of the dam
      unsigned int wet;   ///< its index in #dam_nodes; rigid_ground: the node is fixed
      Vector3      area;  ///< normal out of the water [m^2]
    };

    /** @param dam model of the dam
     * @param mesh water
     * @param level water level [m]
     * @param h size of the water elements [m]
     *
     * Throws InputError if a monolith below the water level has no water node. */
    WaterCoupling(const SolidModel &dam, const WaterMesh &mesh, double level, double h);

    /** Adds the mass of incompressible water times the accelerations @p x, three values per node, to y [N]:
     * rho^2 A K^-1 A^T. Bed and banks are at rest. */
    void add_incompressible_mass(const WaterModel &water, const Unknowns &x, Unknowns &y) const;

    /** Returns the source of the water for a displacement @p x of the dam, three values per node: rho A^T x, one value
     * per node of @p water. */
    std::vector<double> source(const WaterModel &water, const Unknowns &x) const;

    /** Returns a lower bound of the critical step of an explicit dam with its water [s]. With the highest frequencies
     * w_d, w_w of both and s^2 that of rho^2 M_w^-1 A^T M_d^-1 A (bounded by sums of rows), the square of the common
     * one is at most the larger eigenvalue of (w_d^2, w_d s; w_d s, s^2 + w_w^2).
     * @param of_dam critical step of the dam [s]
     * @param mass of each node of the dam, at most the real one [kg] */
    double critical_step(const WaterModel &water, double of_dam, const std::vector<double> &mass) const;

    std::vector<unsigned int> dam_nodes; ///< free nodes of the dam at the water, ascending
    std::vector<Share>        shares;    ///< sorted by water node
    std::vector<Vector3>      area;      ///< per water node [m^2]
    std::vector<unsigned int> nearest;   ///< water node at each node of the model; rigid_ground: it is dry
  };
} // namespace Voussoir

#endif
