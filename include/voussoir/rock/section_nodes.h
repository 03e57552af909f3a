// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_section_nodes_h
#define voussoir_section_nodes_h

#include <voussoir/mesh/coincident.h>
#include <voussoir/rock/rock_model.h>

#include <optional>

namespace Voussoir
{
  /** Nodes of a section of the free field from which places of the rock take their motion. A place takes the
   * motion of the node with its coordinates in the plane of the section. Below the lowest ground, a place
   * between nodes of its height takes a cubic interpolation across the valley: the grid of the rock
   * follows the dam there. */
  class SectionNodes
  {
  public:
    /** Nodes of a section and their weights [-]; unused ones have the weight 0. */
    struct Place
    {
      std::array<int, 4>    node{};
      std::array<double, 4> weight{{1., 0., 0., 0.}};
    };

    /** @param section model of the section, with its zone
     * @param direction normal of the section (0: x, 1: y)
     * @param rock model of the rock; nodes beside it belong to the zone and are not used for interpolation */
    SectionNodes(const RockModel &section, unsigned int direction, const RockModel &rock);

    /** Returns the nodes for a place, if there are any. @p place: of the rock [m]. */
    std::optional<Place> find(Vector3 place) const;

  private:
    /** Node of a row. */
    struct Node
    {
      double z, across; ///< [m]
      int    number;
    };

    unsigned int                 direction;
    double                       tolerance; ///< of coordinates [m]
    std::unique_ptr<PointFinder> finder;    ///< of the nodes projected along the direction
    std::vector<Node>            rows;      ///< below the lowest ground, from below, then across
  };
} // namespace Voussoir

#endif
