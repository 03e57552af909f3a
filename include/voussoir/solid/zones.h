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
  /** What a scene says of zones: their names, and "E nu rho". */
  using ZoneEntry = std::map<std::string, std::string>;

  /** Materials by zone_name(), from "24 GPa 0.2 2400 kg/m^3" or numbers in Pa, - and kg/m^3. Throws
   * InputError, naming @p entry ("Concrete/Zones") and the zone, for what is no material, and for zones that
   * are named twice. */
  std::map<std::string, Material> zone_materials(const ZoneEntry &zones, const std::string &entry,
                                                 double largest_poisson = .499);

  /** By index in @p zones (HexMesh::zones): those of @p listed, else @p own. */
  std::vector<Material> materials_of(const std::vector<std::string> &zones, const Material &own,
                                     const std::map<std::string, Material> &listed);

  /** A zone of a dam or of its rock. */
  struct Zone
  {
    std::string name; ///< empty: cells without zone
    Material    material;
    bool        listed; ///< has a material of its own
    double      volume; ///< [m^3]
  };

  /** The zones of the monoliths or of the rock, cells without zone first if there are any. Throws InputError,
   * naming @p entry and the nearest zone, where one of @p listed is not in the mesh. */
  std::vector<Zone> zones_of(const HexMesh &mesh, bool of_rock, const Material &own,
                             const std::map<std::string, Material> &listed, const std::string &entry);

  /** "21 GPa, Poisson's ratio 0.17, 2400 kg/m3" */
  std::string in_words(const Material &material);
} // namespace Voussoir

#endif
