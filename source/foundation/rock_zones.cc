// SPDX-License-Identifier: GPL-3.0-or-later
// Materials of FoundationParameters.

#include <voussoir/foundation/foundation_parameters.h>

namespace Voussoir
{
  namespace
  {
    bool same(const Material &a, const Material &b)
    {
      return a.young == b.young && a.poisson == b.poisson && a.density == b.density;
    }
  } // namespace

  std::map<std::string, Material> FoundationParameters::zone_materials() const
  {
    return Voussoir::zone_materials(zones, "Foundation/Zones", largest_poisson);
  }

  std::map<int, Material> FoundationParameters::materials_by_volume() const
  {
    std::map<int, Material> materials = {{PhysicalId::first_rock, rock}};
    for (const auto &zone : zone_materials())
      materials[volume_of(zone.first)] = zone.second;
    return materials;
  }

  int FoundationParameters::volume_of(const std::string &zone) const
  {
    const auto materials = zone_materials();
    const auto found = materials.find(zone);
    if (found == materials.end() || same(found->second, rock))
      return PhysicalId::first_rock;
    int id = PhysicalId::first_rock + 1; // id of the first zone with this material
    for (const auto &other : materials)
    {
      if (same(other.second, found->second))
        break;
      ++id;
    }
    return id;
  }

  HexMesh FoundationParameters::volumes_by_material(const HexMesh &mesh) const
  {
    std::vector<int> volume;
    for (const std::string &zone : mesh.zones)
      volume.push_back(volume_of(zone));
    HexMesh result = mesh;
    result.names.erase(result.names.lower_bound({3, PhysicalId::first_rock}), result.names.end());
    for (HexMesh::Cell &cell : result.cells)
      if (!is_monolith(cell.volume))
      {
        cell.volume = volume[cell.zone];
        std::string &name = result.names[{3, cell.volume}];
        if (name.empty())
          name = mesh.zones[cell.zone].empty() ? "rock" : "rock " + mesh.zones[cell.zone];
      }
    return result;
  }
} // namespace Voussoir
