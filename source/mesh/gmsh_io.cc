// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/error.h>
#include <voussoir/base/guarded.h>
#include <voussoir/mesh/gmsh_io.h>
#include <voussoir/mesh/gmsh_session.h>
#include <voussoir/mesh/mesh_groups.h>
#include <voussoir/mesh/mesh_pipe.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>
#include <unordered_map>

namespace Voussoir
{
  namespace
  {
    namespace model = gmsh::model;
    using GmshType::hexahedron_8, GmshType::quadrangle_4;

    /** Gmsh would run anything that does not look like a mesh as a script: look first. */
    void expect_gmsh_file(const std::string &file)
    {
      std::error_code error;
      std::ifstream   stream;
      std::string     line;
      if (std::filesystem::is_regular_file(file, error)) // opening a pipe would wait for its other end
        stream.open(file);
      if (!stream.is_open() || !std::getline(stream, line))
        throw InputError("mesh " + file +
                         ": the file does not exist or cannot be read. Check the entry 'File' " +
                         "of subsection 'Mesh'; it is relative to the directory of the scene file.");
      for (bool in_comments = false; line.rfind("$MeshFormat", 0) != 0;)
      {
        in_comments = (in_comments || line.rfind("$Comments", 0) == 0) && line.rfind("$EndComments", 0) != 0;
        const bool skip =
            in_comments || line.empty() || line[0] == '\r' || line.rfind("$EndComments", 0) == 0;
        if (!skip || !std::getline(stream, line))
          throw InputError("mesh " + file +
                           ": this is not a gmsh mesh, it does not begin with $MeshFormat. " +
                           "Save the mesh as MSH 4.1 or 2.2 (gmsh -save -format msh41).");
      }
    }

    struct Element
    {
      std::size_t              tag;
      std::vector<std::size_t> nodes; // tags
      int                      group; // physical id
      unsigned int             zone;
    };

    class Reader
    {
    public:
      explicit Reader(const std::string &file) : file(file) {}

      HexMesh read()
      {
        gmsh::open(file);
        const auto hexahedra = elements(3, hexahedron_8, "8-node hexahedra");
        const auto quadrilaterals = elements(2, quadrangle_4, "4-node quadrilaterals");
        if (hexahedra.empty())
          fail("there are no hexahedra in physical volumes. Mesh the dam with 8-node hexahedra, give every "
               "monolith a physical volume ('monolith 1', ...), and save the volume mesh.");
        read_nodes();
        for (const Element &element : hexahedra)
        {
          HexMesh::Cell cell{{}, element.group, element.zone};
          for (unsigned int v = 0; v < 8; ++v)
            cell.nodes[v] = number(element.nodes[v]);
          mesh.cells.push_back(cell);
        }
        for (const Element &element : quadrilaterals)
        {
          HexMesh::Face face{{}, element.group};
          for (unsigned int v = 0; v < 4; ++v)
            face.nodes[v] = number(element.nodes[v]);
          mesh.faces.push_back(face);
        }
        normalize(mesh);
        return mesh;
      }

    private:
      [[noreturn]] void fail(const std::string &text) const
      {
        throw InputError("mesh " + file + ": " + text);
      }

      static std::string label(const int dimension, const int tag)
      {
        std::string name;
        model::getPhysicalName(dimension, tag, name);
        const std::string kind = dimension == 3 ? "volume " : "surface ";
        return "physical " + kind + std::to_string(tag) + (name.empty() ? "" : " ('" + name + "')");
      }

      /** Our id of gmsh's group: by its name, or without one by its tag; and takes the name down. */
      int identify(const int dimension, const int tag)
      {
        std::string name;
        model::getPhysicalName(dimension, tag, name);
        int id = name.empty() ? tag : physical_id(dimension, name);
        if (id == -1 && !name.empty())
          fail(unknown_group(dimension, tag, name));
        if (dimension == 3 && !name.empty() && id == PhysicalId::first_rock) // which rock is not said
          for (id = std::max(tag, id); mesh.names.count({3, id}) != 0;)
            ++id;
        if (!name.empty())
        {
          // A monolith of zones is called by its number.
          const bool         in_zones = dimension == 3 && is_monolith(id) && !zone_of(name).empty();
          const std::string &called = in_zones ? physical_name(3, id) : name;
          std::string       &names = mesh.names[{dimension, id}];
          if (names != called)
            names += (names.empty() ? "" : ", ") + called;
        }
        else
          unnamed.insert({dimension, id});
        if (mesh.names.count({dimension, id}) != 0 && unnamed.count({dimension, id}) != 0)
          fail("the physical group '" + mesh.names.at({dimension, id}) + "' and " + label(dimension, id) +
               ", which has no name, would both be " + physical_name(dimension, id) +
               ". Give the latter a name, or remove it.");

        if (dimension == 3 && id < 1)
          fail(label(3, tag) +
               " has an id out of range. Number the monoliths from 1 to 999 and rock from 1000.");
        if (dimension == 2 && physical_id(2, physical_name(2, id)) == -1)
          fail(label(2, tag) +
               " is unknown. Name it 'base', 'upstream', 'downstream', 'crest', 'free surface', "
               "'artificial boundary' or 'joint 1 side 1' and so on, use their ids (1 to 6, "
               "101, 201), or remove it.");
        return id;
      }

      /** Of the cells of gmsh's group of volumes. */
      unsigned int zone_of_group(const int tag)
      {
        std::string name;
        model::getPhysicalName(3, tag, name);
        if (!is_plain(name))
          fail("the physical volume '" + name +
               "' has letters that no zone can have. Use a to z, digits, blanks, '_' and '-', in the mesh "
               "and in "
               "the scene.");
        return zone_index(mesh, zone_of(name));
      }

      /** The elements in physical groups of this dimension, by tag; all must be of one type. */
      std::vector<Element> elements(const int dimension, const int type, const std::string &expected)
      {
        gmsh::vectorpair groups;
        model::getPhysicalGroups(groups, dimension);
        std::vector<Element> result;
        for (const auto &group : groups)
        {
          const int          id = identify(dimension, group.second);
          const unsigned int zone = dimension == 3 ? zone_of_group(group.second) : 0;
          std::vector<int>   entities;
          model::getEntitiesForPhysicalGroup(dimension, group.second, entities);
          for (const int entity : entities)
          {
            check_types(dimension, entity, type, label(dimension, group.second), expected);
            std::vector<std::size_t> tags, nodes;
            model::mesh::getElementsByType(type, tags, nodes, entity);
            const std::size_t n = dimension == 3 ? 8 : 4;
            for (std::size_t e = 0; e < tags.size(); ++e)
              result.push_back({tags[e], {nodes.begin() + n * e, nodes.begin() + n * (e + 1)}, id, zone});
          }
        }
        std::sort(result.begin(), result.end(),
                  [](const Element &a, const Element &b) { return a.tag < b.tag; });
        for (std::size_t e = 1; e < result.size(); ++e)
          if (result[e].tag == result[e - 1].tag)
            fail("element " + std::to_string(result[e].tag) + " is in two physical groups, " +
                 physical_name(dimension, result[e - 1].group) + " and " +
                 physical_name(dimension, result[e].group) +
                 ". Give each group geometrical entities (elementary tags) of its own.");
        if (dimension == 3)
          check_all_grouped(result.size());
        return result;
      }

      void check_types(const int dimension, const int entity, const int type, const std::string &group,
                       const std::string &expected) const
      {
        std::vector<int>                      types;
        std::vector<std::vector<std::size_t>> tags, nodes;
        model::mesh::getElements(types, tags, nodes, dimension, entity);
        for (const int found : types)
        {
          if (found == type)
            continue;
          std::string         name;
          int                 dim, order, n_nodes, n_primary;
          std::vector<double> local;
          model::mesh::getElementProperties(found, name, dim, order, n_nodes, local, n_primary);
          fail(group + " has elements of type '" + name + "', not " + expected + ". " +
               (order > 1
                    ? "Save the mesh with linear elements (gmsh: Mesh.ElementOrder = 1): the program raises "
                      "the degree itself."
                    : "Use a transfinite mesh and recombine it (gmsh: Transfinite, Recombine)."));
        }
      }

      void check_all_grouped(const std::size_t n_grouped) const
      {
        std::vector<std::size_t> tags, nodes;
        model::mesh::getElementsByType(hexahedron_8, tags, nodes);
        if (tags.size() > n_grouped && n_grouped > 0)
          fail(std::to_string(tags.size() - n_grouped) + " of " + std::to_string(tags.size()) +
               " hexahedra are in no physical volume. Put every volume into 'monolith 1', ... or 'rock'.");
        if (n_grouped == 0 && !tags.empty())
          fail("no hexahedron is in a physical volume. Give every monolith one, named 'monolith 1', "
               "'monolith 2', "
               "... from the right bank to the left.");
      }

      void read_nodes()
      {
        std::vector<std::size_t> tags;
        std::vector<double>      coordinates, parameters;
        model::mesh::getNodes(tags, coordinates, parameters, -1, -1, false, false);
        std::vector<std::size_t> order(tags.size());
        for (std::size_t i = 0; i < order.size(); ++i)
          order[i] = i;
        std::sort(order.begin(), order.end(), [&](const auto a, const auto b) { return tags[a] < tags[b]; });
        for (const std::size_t i : order)
          if (node_number.emplace(tags[i], mesh.nodes.size()).second)
            mesh.nodes.push_back({coordinates[3 * i], coordinates[3 * i + 1], coordinates[3 * i + 2]});
      }

      unsigned int number(const std::size_t tag) const
      {
        const auto node = node_number.find(tag);
        if (node == node_number.end())
          fail("node " + std::to_string(tag) + " of an element is missing. Write the file again.");
        return node->second;
      }

      const std::string                            &file;
      HexMesh                                       mesh;
      std::set<std::pair<int, int>>                 unnamed;     // groups: dimension and id
      std::unordered_map<std::size_t, unsigned int> node_number; // by gmsh's tag
    };
  } // namespace

  HexMesh read_gmsh(const std::string &file)
  {
    expect_gmsh_file(file);
    check_physical_names(file);
    HexMesh mesh;
    run_guarded(
        "The mesh file " + file + " cannot be read",
        limits_for_file(double(std::filesystem::file_size(file))),
        [&] { with_gmsh(file, "gmsh cannot read this file", [&] { mesh = Reader(file).read(); }); },
        [&](PipeWriter &pipe) { send(mesh, pipe); }, [&](PipeReader &pipe) { receive(pipe, mesh); });
    return mesh;
  }
} // namespace Voussoir
