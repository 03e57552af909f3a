#include <voussoir/base/error.h>
#include <voussoir/base/guarded.h>
#include <voussoir/base/output_file.h>
#include <voussoir/mesh/gmsh_io.h>
#include <voussoir/mesh/mesh_groups.h>
#include <voussoir/mesh/mesh_pipe.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <gmsh.h>
#include <new>
#include <set>
#include <sstream>
#include <stdexcept>
#include <unistd.h>
#include <unordered_map>

namespace Voussoir
{
  namespace
  {
    namespace model = gmsh::model;

    constexpr int quadrangle_4 = 3, hexahedron_8 = 5; // gmsh's element types

    /** Gmsh keeps one global state: initialized, silent and without the user's configuration in this scope.
     */
    class Session
    {
    public:
      Session()
      {
        gmsh::initialize(0, nullptr, false);
        gmsh::option::setNumber("General.Terminal", 0);
        gmsh::option::setNumber("General.AbortOnError", 3); // throw
      }
      ~Session() { gmsh::finalize(); }
      Session(const Session &) = delete;
      Session &operator=(const Session &) = delete;
    };

    /** Runs @p action, which calls gmsh; what gmsh throws (strings, numbers, exceptions) becomes an
     * InputError. */
    template <typename Action>
    void with_gmsh(const std::string &file, const std::string &problem, const Action &action)
    {
      const Session session;
      std::string   reason;
      try
      {
        action();
        return;
      }
      catch (const InputError &)
      {
        throw;
      }
      catch (const std::bad_alloc &)
      {
        throw;
      }
      catch (const std::length_error &) // more than any memory
      {
        throw std::bad_alloc();
      }
      catch (const std::exception &error)
      {
        reason = error.what();
      }
      catch (const std::string &error)
      {
        reason = error;
      }
      catch (...)
      {
        gmsh::logger::getLastError(reason);
      }
      throw InputError("mesh " + file + ": " + problem + (reason.empty() ? "" : " (gmsh: " + reason + ")") +
                       ".");
    }

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
          HexMesh::Cell cell{{}, element.group};
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
          std::string &names = mesh.names[{dimension, id}];
          names += (names.empty() ? "" : ", ") + name;
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

      /** The elements in physical groups of this dimension, by tag; all must be of one type. */
      std::vector<Element> elements(const int dimension, const int type, const std::string &expected)
      {
        gmsh::vectorpair groups;
        model::getPhysicalGroups(groups, dimension);
        std::vector<Element> result;
        for (const auto &group : groups)
        {
          const int        id = identify(dimension, group.second);
          std::vector<int> entities;
          model::getEntitiesForPhysicalGroup(dimension, group.second, entities);
          for (const int entity : entities)
          {
            check_types(dimension, entity, type, label(dimension, group.second), expected);
            std::vector<std::size_t> tags, nodes;
            model::mesh::getElementsByType(type, tags, nodes, entity);
            const std::size_t n = dimension == 3 ? 8 : 4;
            for (std::size_t e = 0; e < tags.size(); ++e)
              result.push_back({tags[e], {nodes.begin() + n * e, nodes.begin() + n * (e + 1)}, id});
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

    /** Makes a discrete entity for each physical group of @p dimension and adds its elements, tagged in the
     *  mesh's order after @p last_tag. */
    template <typename Range, typename GroupOf>
    void add_groups(const HexMesh &mesh, const int dimension, const int type, const Range &range,
                    const GroupOf &group_of, std::size_t last_tag)
    {
      std::map<int, std::pair<std::vector<std::size_t>, std::vector<std::size_t>>> groups; // tags, nodes
      for (const auto &element : range)
      {
        auto &group = groups[group_of(element)];
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
        const auto name = mesh.names.find({dimension, id}); // of rock: others are written as we call them
        model::setPhysicalName(dimension, id,
                               name != mesh.names.end() && dimension == 3 && !is_monolith(id)
                                   ? name->second
                                   : physical_name(dimension, id));
      }
    }
  } // namespace

  namespace
  {
    /** A file that does not stay. */
    struct Removed
    {
      const std::string &file;
      ~Removed() { std::remove(file.c_str()); }
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
                add_groups(
                    mesh, 3, hexahedron_8, mesh.cells, [](const auto &cell) { return cell.volume; }, 0);
                add_groups(
                    mesh, 2, quadrangle_4, mesh.faces, [](const auto &face) { return face.surface; },
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
