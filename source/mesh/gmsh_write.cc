// SPDX-License-Identifier: GPL-3.0-or-later
// write_gmsh() of gmsh_io.h

#include <voussoir/base/output_file.h>
#include <voussoir/mesh/gmsh_io.h>
#include <voussoir/mesh/gmsh_session.h>

#include <cstdio>
#include <fstream>
#include <sstream>
#include <unistd.h>

namespace Voussoir
{
  namespace
  {
    namespace model = gmsh::model;
    using GmshType::hexahedron_8, GmshType::quadrangle_4;

    /** A physical group as it is written: its tag and name. */
    struct Group
    {
      int         tag;
      std::string name;
    };

    /** Groups of cells by volume and zone. The tag is the volume's id where a volume has one zone. */
    std::map<std::pair<int, unsigned int>, Group> volume_groups(const HexMesh &mesh)
    {
      std::map<std::pair<int, unsigned int>, Group> groups;
      for (const HexMesh::Cell &cell : mesh.cells)
        groups[{cell.volume, cell.zone}].tag = 0;
      int next = groups.empty() ? 0 : groups.rbegin()->first.first + 1, last = 0;
      for (auto &entry : groups)
      {
        const int          volume = entry.first.first;
        const std::string &zone = mesh.zones[entry.first.second];
        Group             &group = entry.second;
        group.tag = volume != last ? volume : next++;
        last = volume;
        const auto name = mesh.names.find({3, volume}); // of rock: others are written as we call them
        if (!is_monolith(volume) && name != mesh.names.end() && zone_of(name->second) == zone)
          group.name = name->second;
        else if (zone.empty())
          group.name = physical_name(3, volume);
        else
          group.name = (is_monolith(volume) ? physical_name(3, volume) : "rock") + " " + zone;
      }
      return groups;
    }

    /** Makes a discrete entity for each physical group of @p dimension and adds its elements, tagged in the
     *  mesh's order after @p last_tag. */
    template <typename Range, typename GroupOf>
    void add_groups(const HexMesh &mesh, const int dimension, const int type, const Range &range,
                    const GroupOf &group_of, std::size_t last_tag)
    {
      std::map<int, std::pair<std::vector<std::size_t>, std::vector<std::size_t>>> groups; // tags, nodes
      std::map<int, std::string>                                                   names;
      for (const auto &element : range)
      {
        const Group of_element = group_of(element);
        auto       &group = groups[of_element.tag];
        names[of_element.tag] = of_element.name;
        group.first.push_back(++last_tag);
        for (const unsigned int node : element.nodes)
          group.second.push_back(node + 1);
      }
      for (const auto &group : groups)
      {
        const int id = group.first;
        model::addDiscreteEntity(dimension, id);
        if (dimension == 3 && id == groups.begin()->first) // all nodes in one place keep their order
        {
          std::vector<std::size_t> tags;
          std::vector<double>      coordinates;
          for (const auto &node : mesh.nodes)
          {
            tags.push_back(tags.size() + 1);
            coordinates.insert(coordinates.end(), node.begin(), node.end());
          }
          model::mesh::addNodes(3, id, tags, coordinates);
        }
        model::mesh::addElementsByType(id, type, group.second.first, group.second.second);
        model::addPhysicalGroup(dimension, {id}, id);
        model::setPhysicalName(dimension, id, names.at(id));
      }
    }

    /** A file that does not stay. */
    struct Removed
    {
      const std::string &file;
      ~Removed() { std::remove(file.c_str()); }
    };
  } // namespace

  void write_gmsh(const HexMesh &mesh, const std::string &file, const double version)
  {
    if (file.size() < 5 || file.substr(file.size() - 4) != ".msh")
      throw InputError("mesh " + file + ": the name of a gmsh mesh file must end in '.msh'.");
    if (version != 4.1 && version != 2.2)
      throw InputError("mesh " + file + ": the MSH format is 4.1 or 2.2, not " + std::to_string(version) +
                       ".");
    // gmsh does not say when the disk is full: it writes beside, and what is whole is copied.
    const std::string part = file.substr(0, file.size() - 4) + "." + std::to_string(getpid()) + ".msh";
    const Removed     removed{part};
    OutputFile(file, std::ios::app); // may it be written to?
    OutputFile(part).check();
    with_gmsh(file, "gmsh cannot write this file",
              [&]
              {
                model::add("voussoir");
                const auto volumes = volume_groups(mesh);
                add_groups(
                    mesh, 3, hexahedron_8, mesh.cells,
                    [&](const HexMesh::Cell &cell) {
                      return volumes.at({cell.volume, cell.zone});
                    },
                    0);
                add_groups(
                    mesh, 2, quadrangle_4, mesh.faces,
                    [](const HexMesh::Face &face) {
                      return Group{face.surface, physical_name(2, face.surface)};
                    },
                    mesh.cells.size());
                gmsh::option::setNumber("Mesh.MshFileVersion", version);
                gmsh::option::setNumber("Mesh.SaveAll", 0);
                gmsh::option::setNumber("Mesh.Binary", 0);
                gmsh::write(part);
              });
    std::ifstream      in(part, std::ios::binary);
    std::ostringstream text;
    text << in.rdbuf();
    const std::string end = "$EndElements\n", whole = text.str();
    if (whole.size() < end.size() || whole.compare(whole.size() - end.size(), end.size(), end) != 0)
      throw WriteError("The file " + part + " cannot be written: is the disk full?");
    OutputFile out(file);
    out << whole;
    out.check();
  }
} // namespace Voussoir
