// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_zone_strip_h
#define voussoir_zone_strip_h

#include <voussoir/rock/free_field.h>
#include <voussoir/rock/sections.h>

namespace Voussoir
{
  /** Strip of cells of the zone that touch the section, and the free field at its nodes. */
  class ZoneStrip
  {
  public:
    /** Creates the strip.
     * @param wide section with a zone; @p model: its model
     * @param section model of the section alone, whose columns give the free field
     * @param direction of the section (0: x, 1: y) The other arguments are those of make_free_field(). */
    ZoneStrip(const WideSection &wide, const RockModel &model, const RockModel &section,
              unsigned int direction, const RockRegionParameters &parameters, const IncidentWave &wave,
              unsigned int n_steps);

    /** Separates values at the nodes of the strip into those of the section and those of the zone. The others
     * are zero. */
    void separate(const Unknowns &values, Unknowns &inside, Unknowns &outside) const;

    /** Stores the forces -f_outside at the nodes of the section and f_inside at those of the zone in @p
     * force, three values per node of the model [N]. @p f_inside, @p f_outside: forces on the cells of the
     * strip from the parts of separate(). */
    void gather(const Unknowns &f_inside, const Unknowns &f_outside, Unknowns &force) const;

    FreeField    field; ///< its points are the nodes of the strip
    HexMesh      mesh;
    RockModel    model; ///< of the strip
    RockOperator stiffness;

  private:
    std::vector<unsigned int> node;      ///< node of the model of the section per node of the strip
    std::vector<bool>         is_inside; ///< per node of the strip: whether it belongs to the section
    std::size_t               n_nodes;   ///< of the model of the section
  };
} // namespace Voussoir

#endif
