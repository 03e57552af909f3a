// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/error.h>
#include <voussoir/base/nearest_name.h>
#include <voussoir/mesh/mesh_groups.h>
#include <voussoir/mesh/plane_section.h>

#include <algorithm>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>
#include <tuple>

namespace Voussoir
{
  namespace
  {
    /** Returns all names to suggest. */
    std::vector<std::string> known_names(const int dimension)
    {
      std::vector<std::string> names;
      if (dimension == 3)
      {
        for (int monolith = 1; monolith < PhysicalId::first_rock; ++monolith)
          names.push_back(physical_name(3, monolith));
        names.insert(names.end(), {"rock", "water"});
        return names;
      }
      for (int surface = PhysicalId::base; surface <= PhysicalId::water_end; ++surface)
        names.push_back(physical_name(2, surface));
      for (int joint = 1; joint <= PhysicalId::max_in_files; ++joint)
        for (const int side : {PhysicalId::joint_side_1, PhysicalId::joint_side_2})
          names.push_back(physical_name(2, side + joint));
      return names;
    }

    /** Line of the table: successive groups of the same kind. */
    struct Row
    {
      int         dimension, first_id, last_id;
      std::string zone;
      bool        named;
      std::string first_name, last_name;
      std::size_t n = 0; ///< hexahedra or faces
    };

    /** Returns true if the group belongs to the line @p row. */
    bool continues(const Row &row, const int dimension, const int id, const std::string &zone,
                   const bool named)
    {
      if (row.dimension != dimension || row.named != named || id != row.last_id + 1 || row.zone != zone)
        return false;
      return dimension == 3 ? is_monolith(id) && row.last_id != PhysicalId::water
                            : is_joint_side(row.last_id);
    }

    /** Returns the meaning of the groups of a line. */
    std::string role(const Row &row)
    {
      const std::string first = physical_name(row.dimension, row.first_id),
                        zone = row.zone.empty() ? "" : ", zone " + row.zone;
      if (row.dimension == 3 && !is_monolith(row.first_id))
        return "rock" + zone;
      return (row.first_id == row.last_id ? first
                                          : first + " to " + physical_name(row.dimension, row.last_id)) +
             zone;
    }

    /** Returns the lines of the table: volumes without zone, volumes of each zone, surfaces. */
    std::vector<Row> rows_of(const HexMesh &mesh)
    {
      using Key = std::tuple<int, bool, unsigned int, int>; // surface?, rock?, zone, id
      std::map<Key, std::size_t> count;
      for (const auto &cell : mesh.cells)
        ++count[{0, !is_monolith(cell.volume), cell.zone, cell.volume}];
      for (const auto &face : mesh.faces)
        ++count[{1, false, 0, face.surface}];
      if (mesh.water != nullptr && !mesh.water->cells.empty())
        count[{0, true, 0, PhysicalId::water}] = mesh.water->cells.size();
      if (mesh.water != nullptr && !mesh.water->faces.empty())
        count[{1, false, 0, PhysicalId::water_end}] = mesh.water->faces.size();
      std::vector<Row> rows;
      for (const auto &group : count)
      {
        const auto [is_surface, is_rock, zone_index, id] = group.first;
        const int         dimension = is_surface ? 2 : 3;
        const auto        found = mesh.names.find({dimension, id});
        const bool        named = found != mesh.names.end();
        const std::string zone = mesh.zones[zone_index];
        const std::string name =
            !named ? (is_surface ? "surface " : "volume ") + std::to_string(id) + " (no name)"
                   : found->second + (is_surface || is_rock || zone.empty() ? "" : " " + zone);
        if (rows.empty() || !continues(rows.back(), dimension, id, zone, named))
          rows.push_back({dimension, id, id, zone, named, name, name});
        rows.back().last_id = id;
        rows.back().last_name = name;
        rows.back().n += group.second;
      }
      return rows;
    }
  } // namespace

  std::string unknown_group(const int dimension, const int tag, const std::string &name)
  {
    const std::string kind = dimension == 3 ? "volume" : "surface";
    return "the physical " + kind + " '" + name + "' (id " + std::to_string(tag) +
           ") has an unknown name. Did you mean '" + nearest_name(known_names(dimension), name) + "'? " +
           (dimension == 3
                ? "Volumes are 'monolith 1', 'monolith 2', ..., 'rock' and 'water'. With several materials "
                  "the name of a zone follows ('monolith 1 heel', 'rock weak layer')"
                : "Surfaces are 'base', 'base joint', 'upstream', 'downstream', 'crest', 'free surface', "
                  "'artificial boundary', 'water end', 'joint 1 side 1', 'joint 1 side 2' and so on") +
           ". Rename or remove the group. Ids are used only for groups without names.";
  }

  std::string group_table(const HexMesh &mesh)
  {
    const std::vector<Row>   rows = rows_of(mesh);
    std::vector<std::string> groups;
    std::size_t              width_1 = 5, width_2 = 4;
    for (const Row &row : rows)
    {
      groups.push_back(row.first_name == row.last_name ? row.first_name
                                                       : row.first_name + " ... " + row.last_name);
      width_1 = std::max(width_1, groups.back().size());
      width_2 = std::max(width_2, role(row).size());
    }
    std::ostringstream text;
    for (std::size_t i = 0; i < rows.size(); ++i)
      text << (i == 0 ? "" : "\n") << groups[i] << std::string(width_1 - groups[i].size(), ' ') << "  ->  "
           << role(rows[i]) << std::string(width_2 - role(rows[i]).size(), ' ') << "  " << rows[i].n
           << (rows[i].dimension == 3 ? " hexahedra" : " faces");
    return text.str();
  }

  std::string faces_without_group(const HexMesh &mesh, const bool plane_strain)
  {
    std::set<std::array<unsigned int, 4>> grouped;
    for (const HexMesh::Face &face : mesh.faces)
    {
      std::array<unsigned int, 4> key = face.nodes;
      std::sort(key.begin(), key.end());
      grouped.insert(key);
    }
    const FaceTable    table(mesh);
    const auto        &entries = table.entries();
    std::size_t        n = 0;
    std::ostringstream text;
    for (std::size_t i = 0; i < entries.size(); ++i)
    {
      const bool inside = (i > 0 && entries[i - 1].key == entries[i].key) ||
                          (i + 1 < entries.size() && entries[i + 1].key == entries[i].key);
      if (!inside && is_monolith(mesh.cells[entries[i].cell].volume) && grouped.count(entries[i].key) == 0 &&
          !(plane_strain && cosine_to_y(mesh, entries[i].cell, entries[i].cell_face) > .5) && n++ == 0)
        text << " outer faces of the dam, the first at " << place(centre(mesh, entries[i].key))
             << ", are in no physical surface. They are free and have no water pressure. This is correct for "
                "the walls of a gallery and other free faces. Put all others into \"upstream\", "
                "\"downstream\", \"crest\" or \"base\".";
    }
    return n == 0 ? "" : std::to_string(n) + text.str();
  }

  void check_physical_names(const std::string &file)
  {
    std::ifstream in(file, std::ios::binary);
    std::string   line;
    const auto    next = [&]
    {
      std::getline(in, line);
      while (!line.empty() && (line.back() == '\r' || line.back() == ' '))
        line.pop_back();
      return bool(in);
    };
    while (next() && line != "$PhysicalNames")
      if (line == "$Nodes" || line == "$Entities" || line == "$Elements")
        return; // the names come first; the rest may be binary
    std::set<std::pair<int, std::string>> names;
    std::size_t                           n = 0;
    if (!in || !next())
      return;
    const std::string count = line;
    for (; next() && line != "$EndPhysicalNames"; ++n)
    {
      static const std::regex form("\\s*([0-3])\\s+([0-9]+)\\s+\"([^\"]+)\"");
      std::smatch             parts;
      if (!std::regex_match(line, parts, form))
        throw InputError("mesh " + file + ": the line '" + line.substr(0, 80) +
                         "' of $PhysicalNames is not DIMENSION ID \"NAME\", with a name in quotes. Correct "
                         "or remove the line. For a group without a name the id is used.");
      if (parts[3].str().compare(0, 4, "rock") != 0 && !names.emplace(std::stoi(parts[1]), parts[3]).second)
        throw InputError("mesh " + file + ": two physical groups have the name '" + parts[3].str() +
                         "'. Give each a name of its own.");
    }
    if (count != std::to_string(n))
      throw InputError("mesh " + file + ": $PhysicalNames announces " + count.substr(0, 20) +
                       " names, but has " + std::to_string(n) + ". Write the file again.");
  }
} // namespace Voussoir
