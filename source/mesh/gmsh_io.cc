// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/error.h>
#include <voussoir/base/guarded.h>
#include <voussoir/mesh/gmsh_io.h>
#include <voussoir/mesh/gmsh_session.h>
#include <voussoir/mesh/mesh_groups.h>
#include <voussoir/mesh/mesh_pipe.h>
#include <voussoir/mesh/subdivide.h>

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

    /** Element types of gmsh that are read. Elements of higher order begin with their corners. */
    struct ElementKind
    {
      int         dimension, type;
      std::size_t n_corners;
    };
    constexpr ElementKind kinds[] = {{3, GmshType::hexahedron_8, 8},
                                     {3, 12, 8},
                                     {3, 17, 8}, // 8, 27, 20 nodes
                                     {3, 6, 6},
                                     {3, 13, 6},
                                     {3, 18, 6}, // wedges
                                     {2, GmshType::quadrangle_4, 4},
                                     {2, 10, 4},
                                     {2, 16, 4}, // 4, 9, 8 nodes
                                     {2, 2, 3},
                                     {2, 9, 3}}; // triangles

    const ElementKind *kind_of(const int dimension, const int type)
    {
      const auto found = std::find_if(std::begin(kinds), std::end(kinds),
                                      [&](const ElementKind &kind)
                                      { return kind.dimension == dimension && kind.type == type; });
      return found == std::end(kinds) ? nullptr : found;
    }

    /** Throws InputError if the file is not a gmsh mesh. Gmsh would execute other files as scripts. */
    void expect_gmsh_file(const std::string &file)
    {
      std::error_code error;
      std::ifstream   stream;
      std::string     line;
      if (std::filesystem::is_regular_file(file, error)) // the opening of a pipe would wait for a writer
        stream.open(file);
      if (!stream.is_open() || !std::getline(stream, line))
        throw InputError("mesh " + file +
                         ": the file does not exist or cannot be read. Check the entry "
                         "\"Mesh/File\". The path is relative to the directory of the input file.");
      for (bool in_comments = false; line.rfind("$MeshFormat", 0) != 0;)
      {
        in_comments = (in_comments || line.rfind("$Comments", 0) == 0) && line.rfind("$EndComments", 0) != 0;
        const bool skip =
            in_comments || line.empty() || line[0] == '\r' || line.rfind("$EndComments", 0) == 0;
        if (!skip || !std::getline(stream, line))
          throw InputError("mesh " + file +
                           ": this is not a gmsh mesh, because it does not begin with $MeshFormat. " +
                           "Save the mesh as MSH 4.1 or 2.2 (gmsh -save -format msh41).");
      }
    }

    struct Element
    {
      std::size_t              tag;
      std::vector<std::size_t> nodes; // tags of the corners
      int                      group; // physical id
      unsigned int             zone;
    };

    class Reader
    {
    public:
      Reader(const std::string &file, const bool subdivided) : file(file), subdivided(subdivided) {}

      HexMesh read()
      {
        gmsh::open(file);
        const auto cells = elements(3, "hexahedra"), faces = elements(2, "quadrilaterals");
        if (cells.empty())
          fail("there are no hexahedra in physical volumes. Mesh the dam with hexahedra, give every monolith "
               "a physical volume ('monolith 1', ...), and save the volume mesh.");
        read_nodes();
        MixedMesh mixed;
        for (const Element &element : cells)
        {
          mixed.cells.push_back({without_double_corners(numbers(element)), element.group, element.zone});
          if (mixed.cells.back().nodes.size() == 6 && !subdivided)
            fail("element " + std::to_string(element.tag) + " of " + physical_name(3, element.group) +
                 " is a wedge. A hexahedron with two collapsed edges would lose its bending modes and give "
                 "wrong stresses. Set \"Mesh/Subdivide\" = true: every wedge then becomes six hexahedra and "
                 "every hexahedron eight (start from a mesh twice as coarse). Or mesh without wedges: end "
                 "the dam at the banks with a short vertical edge instead of a point.");
        }
        for (const Element &element : faces)
        {
          mixed.faces.push_back({numbers(element), element.group});
          if (mixed.faces.back().nodes.size() == 3 && !subdivided)
            fail(physical_name(2, element.group) +
                 " has triangles, the faces of wedges or tetrahedra. Mesh with hexahedra (gmsh: Transfinite, "
                 "Recombine), or with wedges and \"Mesh/Subdivide\" = true.");
        }
        if (subdivided)
        {
          mixed.nodes = mesh.nodes;
          subdivide(mixed, mesh);
        }
        else
          take_over(mixed);
        normalize(mesh);
        return mesh;
      }

    private:
      std::vector<unsigned int> numbers(const Element &element) const
      {
        std::vector<unsigned int> result;
        for (const std::size_t tag : element.nodes)
          result.push_back(number(tag));
        return result;
      }

      /** Copies a mesh that has hexahedra and quadrilaterals only. */
      void take_over(const MixedMesh &mixed)
      {
        for (const MixedMesh::Cell &from : mixed.cells)
        {
          mesh.cells.push_back({{}, from.volume, from.zone});
          std::copy(from.nodes.begin(), from.nodes.end(), mesh.cells.back().nodes.begin());
        }
        for (const MixedMesh::Face &from : mixed.faces)
        {
          mesh.faces.push_back({{}, from.surface});
          std::copy(from.nodes.begin(), from.nodes.end(), mesh.faces.back().nodes.begin());
        }
      }

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

      /** Returns the physical id of a group without a name. */
      static int id_of_tag(const int dimension, const int tag)
      {
        using namespace PhysicalId;
        if (dimension == 2 && tag > side_1_in_files && tag <= side_1_in_files + max_in_files)
          return tag - side_1_in_files + joint_side_1;
        if (dimension == 2 && tag > side_2_in_files && tag <= side_2_in_files + max_in_files)
          return tag - side_2_in_files + joint_side_2;
        return tag;
      }

      /** Returns the physical id of a group of gmsh: by its name, or by its tag if it has none.
       * Stores the name. */
      int identify(const int dimension, const int tag)
      {
        std::string name;
        model::getPhysicalName(dimension, tag, name);
        int id = name.empty() ? id_of_tag(dimension, tag) : physical_id(dimension, name);
        if (id == -1 && !name.empty())
          fail(unknown_group(dimension, tag, name));
        if (dimension == 3 && !name.empty() && id == PhysicalId::first_rock) // ids of rock are free
          for (id = std::max(tag, id); mesh.names.count({3, id}) != 0;)
            ++id;
        if (!name.empty())
        {
          // Name of a monolith with zones: its number only.
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
               ". Name the group without a name, or remove it.");

        const bool has_lift_id = dimension == 3 && name.empty() && id >= PhysicalId::per_lift;
        if (has_lift_id || (dimension == 3 && id < 1 && (id != PhysicalId::water || name.empty())))
          fail(label(3, tag) +
               " has an id out of range. Number the monoliths from 1 to 999 and rock from 1000.");
        if (dimension == 2 && physical_id(2, physical_name(2, id)) == -1)
          fail(
              label(2, tag) +
              " is unknown. Name it 'base', 'base joint', 'upstream', 'downstream', 'crest', 'free surface', 'artificial "
              "boundary', 'water end' or 'joint 1 side 1' and so on, use their ids (1 to 8, 101, 201), or remove it.");
        return id;
      }

      /** Returns the zone of the cells in a physical volume of gmsh. */
      unsigned int zone_of_group(const int tag)
      {
        std::string name;
        model::getPhysicalName(3, tag, name);
        if (!is_plain(name))
          fail("the physical volume '" + name +
               "' has letters that are not allowed in the name of a zone. Use a to z, digits, blanks, '_' "
               "and '-' in the mesh and in the input file.");
        return zone_index(mesh, zone_of(name));
      }

      /** Returns the elements in physical groups of this dimension, by tag. Throws InputError for elements of
       * other kinds. */
      std::vector<Element> elements(const int dimension, const std::string &expected)
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
            std::vector<int>                      types;
            std::vector<std::vector<std::size_t>> tags, nodes;
            model::mesh::getElements(types, tags, nodes, dimension, entity);
            for (std::size_t t = 0; t < types.size(); ++t)
            {
              const ElementKind *kind = kind_of(dimension, types[t]);
              if (kind == nullptr)
                refuse(types[t], id, label(dimension, group.second), expected);
              for (std::size_t e = 0, n = nodes[t].size() / std::max<std::size_t>(1, tags[t].size());
                   e < tags[t].size(); ++e)
                result.push_back({tags[t][e],
                                  {nodes[t].begin() + n * e, nodes[t].begin() + n * e + kind->n_corners},
                                  id,
                                  zone});
            }
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

      [[noreturn]] void refuse(const int type, const int id, const std::string &group,
                               const std::string &expected) const
      {
        std::string         name;
        int                 dimension, order, n_nodes, n_corners;
        std::vector<double> local;
        model::mesh::getElementProperties(type, name, dimension, order, n_nodes, local, n_corners);
        const bool        tetrahedra = dimension == 3 && n_corners == 4;
        const std::string found = group + " has elements of type '" + name + "', not " + expected + ". ";
        if (dimension == 3 && id == PhysicalId::water)
          fail(
              found +
              "Mesh the water with hexahedra, for example by extrusion of the upstream face, or remove the volume: "
              "the program then generates a channel.");
        fail(found +
             (tetrahedra ? "Linear tetrahedra lock: the dam would be far too stiff and its stresses wrong. "
                         : "") +
             "Use a transfinite mesh and recombine it (gmsh: Transfinite, Recombine), or extrude a "
             "recombined surface. Mesh.SubdivisionAlgorithm = 2 of gmsh divides any mesh into hexahedra, but "
             "of poor quality.");
      }

      void check_all_grouped(const std::size_t n_grouped) const
      {
        std::size_t n_all = 0;
        for (const ElementKind &kind : kinds)
        {
          std::vector<std::size_t> tags, nodes;
          if (kind.dimension == 3)
            model::mesh::getElementsByType(kind.type, tags, nodes);
          n_all += tags.size();
        }
        if (n_all > n_grouped && n_grouped > 0)
          fail(
              std::to_string(n_all - n_grouped) + " of " + std::to_string(n_all) +
              " hexahedra are in no physical volume. Put every volume into 'monolith 1', ..., 'rock' or 'water'.");
        if (n_grouped == 0 && n_all > 0)
          fail("no hexahedron is in a physical volume. Give every monolith a physical volume, named "
               "'monolith 1', 'monolith 2', ... from the right bank to the left.");
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
      const bool                                    subdivided;
      HexMesh                                       mesh;
      std::set<std::pair<int, int>>                 unnamed;     // groups: dimension and id
      std::unordered_map<std::size_t, unsigned int> node_number; // by gmsh's tag
    };
  } // namespace

  HexMesh read_gmsh(const std::string &file, const bool subdivided)
  {
    expect_gmsh_file(file);
    check_physical_names(file);
    HexMesh mesh;
    run_guarded(
        "The mesh file " + file + " cannot be read",
        limits_for_file(double(std::filesystem::file_size(file))),
        [&]
        { with_gmsh(file, "gmsh cannot read this file", [&] { mesh = Reader(file, subdivided).read(); }); },
        [&](PipeWriter &pipe) { send(mesh, pipe); }, [&](PipeReader &pipe) { receive(pipe, mesh); });
    return mesh;
  }
} // namespace Voussoir
