// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/error.h>
#include <voussoir/base/nearest_name.h>
#include <voussoir/base/units.h>
#include <voussoir/solid/zones.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <sstream>

namespace Voussoir
{
  namespace
  {
    /** Splits "24 GPa 0.2 2400" into "24 GPa", "0.2", "2400". Each value begins with a number. */
    std::vector<std::string> values_in(const std::string &text)
    {
      std::vector<std::string> values;
      std::istringstream       in(text);
      for (std::string word; in >> word;)
      {
        char *end = nullptr;
        std::strtod(word.c_str(), &end);
        if (values.empty() || end != word.c_str())
          values.push_back(word);
        else
          values.back() += " " + word;
      }
      return values;
    }

    Material material_from(const std::string &text, const double largest_poisson, const std::string &what)
    {
      const std::vector<std::string> values = values_in(text);
      if (values.size() != 3)
        throw InputError(what + " has \"" + text +
                         "\": give three values, modulus of elasticity, Poisson's ratio and density, as in "
                         "\"24 GPa 0.2 2400 kg/m^3\" or \"24e9 0.2 2400\".");
      Material   m;
      const auto refuse = [&](const std::string &value, const std::string &quantity, const std::string &must)
      {
        throw InputError(what + ": " + quantity + " cannot be \"" + value + "\". It must be " + must + ".");
      };
      m.young = number_in_unit(values[0], "Pa", what + ": the modulus of elasticity");
      if (!std::isfinite(m.young) || !(m.young > 0.))
        refuse(values[0], "the modulus of elasticity", "a positive number, in Pa");
      m.poisson = number_in_unit(values[1], "-", what + ": Poisson's ratio");
      if (!(m.poisson >= 0. && m.poisson <= largest_poisson))
      {
        std::ostringstream range;
        range << "from 0 to " << largest_poisson;
        refuse(values[1], "Poisson's ratio", range.str());
      }
      m.density = number_in_unit(values[2], "kg/m^3", what + ": the density");
      if (!std::isfinite(m.density) || !(m.density > 0.))
        refuse(values[2], "the density", "a positive number, in kg/m^3");
      return m;
    }
  } // namespace

  std::map<std::string, Material> zone_materials(const ZoneEntry &zones, const std::string &entry,
                                                 const double largest_poisson)
  {
    std::map<std::string, Material> materials;
    for (const auto &zone : zones)
    {
      const std::string name = zone_name(zone.first),
                        what = "Entry \"" + entry + "\": zone \"" + zone.first + "\"";
      if (!is_plain(zone.first))
        throw InputError(what + " contains letters that are not allowed in the name of a zone. Use a to z, "
                                "digits, blanks, '_' and '-', in the mesh and in the input file.");
      if (name.empty())
        throw InputError(what +
                         " has no name. Write it as in \"heel: 24e9 0.2 2400\". The volumes of the zone have "
                         "this name in the mesh, as in \"monolith 3 heel\" or \"rock heel\".");
      if (!materials.emplace(name, material_from(zone.second, largest_poisson, what)).second)
        throw InputError(what +
                         " is listed twice (case, blanks, '_' and '-' are ignored). Remove one of the two.");
    }
    return materials;
  }

  std::vector<Material> materials_of(const std::vector<std::string> &zones, const Material &own,
                                     const std::map<std::string, Material> &listed)
  {
    std::vector<Material> materials;
    for (const std::string &zone : zones)
    {
      const auto found = listed.find(zone);
      materials.push_back(found == listed.end() ? own : found->second);
    }
    return materials;
  }

  std::vector<Zone> zones_of(const HexMesh &mesh, const bool of_rock, const Material &own,
                             const std::map<std::string, Material> &listed, const std::string &entry)
  {
    const std::vector<Material> materials = materials_of(mesh.zones, own, listed);
    std::vector<double>         volume(mesh.zones.size(), 0.);
    HexMesh                     part = mesh; // the volumes of part are the zones
    part.cells.clear();
    for (HexMesh::Cell cell : mesh.cells)
      if (is_monolith(cell.volume) != of_rock)
      {
        cell.volume = cell.zone;
        part.cells.push_back(cell);
      }
    for (const auto &zone : volumes(part))
      volume[zone.first] = zone.second;
    std::vector<Zone>        zones;
    std::vector<std::string> names;
    for (std::size_t i = 0; i < volume.size(); ++i)
      if (volume[i] > 0.)
      {
        zones.push_back({mesh.zones[i], materials[i], listed.count(mesh.zones[i]) > 0, volume[i]});
        if (!mesh.zones[i].empty())
          names.push_back(mesh.zones[i]);
      }
    for (const auto &zone : listed)
      if (std::find(names.begin(), names.end(), zone.first) == names.end())
        throw InputError("Entry \"" + entry + "\" has the zone \"" + zone.first +
                         "\", but no volume of the " + (of_rock ? "rock" : "dam") + " has that name, as \"" +
                         (of_rock ? "rock " : "monolith 1 ") + zone.first + "\" would. " +
                         (names.empty()
                              ? "The mesh has no zones there. Name its volumes, or leave the zone out."
                              : "Did you mean \"" + nearest_name(names, zone.first) +
                                    "\"? `--validate` shows the mesh's groups."));
    return zones;
  }

  std::string in_words(const Material &material)
  {
    char text[100];
    std::snprintf(text, sizeof(text), "%.4g GPa, Poisson's ratio %g, %g kg/m3", 1e-9 * material.young,
                  material.poisson, material.density);
    return text;
  }
} // namespace Voussoir
