// SPDX-License-Identifier: GPL-3.0-or-later
// write_gmsh() of gmsh_io.h

#include <voussoir/base/error.h>
#include <voussoir/base/number_text.h>
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

    /** Tag and name of a physical group in the file. */
    struct Group
    {
      int         tag;
      std::string name;
    };

    /** Returns the groups of cells by volume and zone. The tag of the first zone is the id of the volume. */
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
        const auto name = mesh.names.find({3, volume}); // the names of rock are kept, others are standard
        if (!is_monolith(volume) && name != mesh.names.end() && zone_of(name->second) == zone)
          group.name = name->second;
        else if (zone.empty())
          group.name = physical_name(3, volume);
        else
          group.name = (is_monolith(volume) ? physical_name(3, volume) : "rock") + " " + zone;
      }
      return groups;
    }

    /** Returns the tag of a surface in the file. */
    int tag_of(const int surface)
    {
      using namespace PhysicalId;
      for (const auto &[inside, outside] :
           {std::make_pair(joint_side_2, side_2_in_files), std::make_pair(joint_side_1, side_1_in_files)})
        if (surface > inside && surface <= inside + max_in_files)
          return surface - inside + outside;
      return surface;
    }

    /** Adds a discrete entity of gmsh with its elements for each physical group of @p dimension. The tags of
     * the elements follow @p last_tag, in the order of the mesh. */
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
        if (dimension == 3 && id == groups.begin()->first) // one entity with all nodes keeps their order
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

    /** Temporary file. The destructor removes it. */
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
      throw InputError("mesh " + file + ": the MSH format is 4.1 or 2.2, not " + number_text(version) + ".");
    // Gmsh does not report a full disk. It writes a temporary file, which is copied if it is complete.
    const std::string part = file.substr(0, file.size() - 4) + "." + std::to_string(getpid()) + ".msh";
    const Removed     removed{part};
    OutputFile(file, std::ios::app); // throws if the file cannot be written
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
                      return Group{tag_of(face.surface), physical_name(2, face.surface)};
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
      throw WriteError("The file " + part + " cannot be written completely. Free some disk space.");
    OutputFile out(file);
    out << whole;
    out.check();
  }
} // namespace Voussoir
