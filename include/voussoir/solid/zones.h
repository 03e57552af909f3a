// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_zones_h
#define voussoir_zones_h

#include <voussoir/mesh/mesh.h>
#include <voussoir/solid/material.h>

#include <map>
#include <string>
#include <vector>

namespace Voussoir
{
  /** Entry of the input file with materials of zones: name and "E nu rho" of each zone. */
  using ZoneEntry = std::map<std::string, std::string>;

  /** Returns the materials by zone_name().
   * @param zones values such as "24 GPa 0.2 2400 kg/m^3", or numbers in Pa, - and kg/m^3
   * @param entry name of the entry in messages, such as "Concrete/Zones"
   * @param largest_poisson upper limit of Poisson's ratio
   *
   * Throws InputError with the entry and the zone for an invalid material or name, and for a zone that
   * is listed twice. */
  std::map<std::string, Material> zone_materials(const ZoneEntry &zones, const std::string &entry,
                                                 double largest_poisson = .499);

  /** Returns the material of each zone: that in @p listed, or @p own if the zone is not listed.
   * @param zones names of the zones (HexMesh::zones)
   * @param own default material
   * @param listed materials of zone_materials() */
  std::vector<Material> materials_of(const std::vector<std::string> &zones, const Material &own,
                                     const std::map<std::string, Material> &listed);

  /** Zone of the dam or of the rock. */
  struct Zone
  {
    std::string name; ///< empty: cells without zone
    Material    material;
    bool        listed; ///< whether the input file lists a material
    double      volume; ///< [m^3]
  };

  /** Returns the zones of the monoliths, or of the rock if @p of_rock. Cells without zone come first. Throws
   * InputError with @p entry and the most similar name if a zone in @p listed is not in the mesh. */
  std::vector<Zone> zones_of(const HexMesh &mesh, bool of_rock, const Material &own,
                             const std::map<std::string, Material> &listed, const std::string &entry);

  /** Returns a text such as "21 GPa, Poisson's ratio 0.17, 2400 kg/m3". */
  std::string in_words(const Material &material);
} // namespace Voussoir

#endif
