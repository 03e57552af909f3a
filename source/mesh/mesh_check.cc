// SPDX-License-Identifier: GPL-3.0-or-later
// check_mesh() of mesh.h

#include <voussoir/base/error.h>
#include <voussoir/mesh/mesh.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>

namespace Voussoir
{
  namespace
  {
    std::string group_name(const HexMesh &mesh, const int dimension, const int id)
    {
      const auto name = mesh.names.find({dimension, id});
      return "'" + (name != mesh.names.end() ? name->second : physical_name(dimension, id)) + "'";
    }

    class Check
    {
    public:
      Check(const HexMesh &mesh, const std::string &source)
          : mesh(mesh), source(source), table(mesh),
            has_rock(std::any_of(mesh.cells.begin(), mesh.cells.end(),
                                 [](const auto &cell) { return !is_monolith(cell.volume); }))
      {
      }

      void nodes() const
      {
        for (unsigned int n = 0; n < mesh.nodes.size(); ++n)
          for (const double coordinate : mesh.nodes[n])
            if (!std::isfinite(coordinate))
              fail("node " + std::to_string(n + 1) + " of " + std::to_string(mesh.nodes.size()) +
                   " has a coordinate that is not a finite number. Correct the file, or write it again.");
      }

      void volumes() const
      {
        std::set<int>                monoliths;
        std::map<int, std::set<int>> lifts;
        for (const auto &cell : mesh.cells)
          if (cell.volume < 1)
            fail("volume id " + std::to_string(cell.volume) +
                 " is out of range. Number the monoliths from 1 to 999 and rock from 1000.");
          else if (is_monolith(cell.volume))
          {
            monoliths.insert(monolith_of(cell.volume));
            lifts[monolith_of(cell.volume)].insert(lift_of(cell.volume));
          }
        if (monoliths.empty())
          fail("there is no monolith. Give the dam's volumes physical ids from 1 to 999, or the names "
               "'monolith 1', 'monolith 2', ...");
        int expected = 1;
        for (const int monolith : monoliths)
          if (monolith != expected++)
            fail("the numbers of the monoliths have gaps: the largest is " +
                 std::to_string(*monoliths.rbegin()) + ", but there is no monolith " +
                 std::to_string(expected - 1) + ". Number them 1, 2, ... from the right bank to the left.");
        for (const auto &[monolith, numbers] : lifts)
          if (*numbers.rbegin() != static_cast<int>(numbers.size()))
            fail("the numbers of the lifts of monolith " + std::to_string(monolith) +
                 " have gaps: the largest is " + std::to_string(*numbers.rbegin()) + ", but there are " +
                 std::to_string(numbers.size()) + ". Name its volumes 'monolith " + std::to_string(monolith) +
                 " lift 1', 'lift 2', ... from the base up.");
      }

      void cells() const
      {
        for (unsigned int c = 0; c < mesh.cells.size(); ++c)
        {
          const auto  &cell = mesh.cells[c];
          const double jacobian = min_jacobian(mesh, cell);
          if (jacobian > 0)
            continue;
          std::ostringstream text;
          text << "hexahedron " << c + 1 << " of " << mesh.cells.size() << ", in "
               << group_name(mesh, 3, cell.volume) << " at " << place(centre(mesh, cell.nodes))
               << ", is inverted or degenerate: its smallest Jacobian is " << jacobian
               << " m3. Order its corners as gmsh does, bottom and top each counter-clockwise seen from "
                  "above, and move nodes until it is convex with no two corners in one place.";
          fail(text.str());
        }
      }

      void faces() const
      {
        for (auto entry = table.entries().begin(); entry + 2 < table.entries().end(); ++entry)
          if (entry->key == (entry + 2)->key)
            fail("three hexahedra share the face at " + place(centre(mesh, entry->key)) +
                 ". Remove the one that overlaps the others.");

        std::map<std::array<unsigned int, 4>, int> surface_of;
        for (const auto &face : mesh.faces)
        {
          const auto owners = table.owners(face.nodes);
          const auto where = [&]
          {
            return "a face of surface " + group_name(mesh, 2, face.surface) + " at " +
                   place(centre(mesh, face.nodes));
          };
          if (owners.first == nullptr)
            fail(where() + " belongs to no hexahedron. Mesh volumes and surfaces together, and save both.");
          if (owners.second != nullptr &&
              !may_be_interior(face.surface, owners.first->cell, owners.second->cell))
            fail(where() + " lies inside the body, between " +
                 group_name(mesh, 3, mesh.cells[owners.first->cell].volume) + " and " +
                 group_name(mesh, 3, mesh.cells[owners.second->cell].volume) +
                 ". Take it out of the physical surface.");
          const auto other = surface_of.emplace(owners.first->key, face.surface);
          if (!other.second)
            fail(where() + " is also in surface " + group_name(mesh, 2, other.first->second) +
                 ". Leave it in one physical surface only.");
        }
        if (has_rock)
          rock_faces(surface_of);
      }

      /** Checks the surfaces of a mesh with rock. The surface 'base' has exactly the faces between dam and
       * rock. Ground and artificial boundary have faces of the rock only. */
      void rock_faces(const std::map<std::array<unsigned int, 4>, int> &surface_of) const
      {
        for (const auto &face : surface_of)
        {
          const auto owners = table.owners(face.first);
          const auto where = [&]
          {
            return "a face of surface " + group_name(mesh, 2, face.second) + " at " +
                   place(centre(mesh, face.first));
          };
          if (is_base(face.second) && owners.second == nullptr)
            fail(where() +
                 " does not lie between dam and rock: it belongs to one hexahedron only. Let dam and "
                 "rock share their nodes there (gmsh: Coherence, or remove duplicate nodes), or take "
                 "it out of the surface if there is no rock.");
          if ((face.second == PhysicalId::artificial || face.second == PhysicalId::free_surface) &&
              is_monolith(mesh.cells[owners.first->cell].volume))
            fail(where() + " belongs to the dam. Only rock has this surface: take the face out of it.");
        }
        for (auto entry = table.entries().begin(); entry + 1 < table.entries().end(); ++entry)
        {
          const auto &other = *(entry + 1);
          if (entry->key == other.key &&
              is_monolith(mesh.cells[entry->cell].volume) != is_monolith(mesh.cells[other.cell].volume) &&
              surface_of.count(entry->key) == 0)
            fail("the face between dam and rock at " + place(centre(mesh, entry->key)) +
                 " is in no surface. Put all faces where they meet into the surface 'base' (id 1).");
        }
      }

      void supports() const
      {
        const auto has = [&](const int surface)
        {
          return std::any_of(mesh.faces.begin(), mesh.faces.end(),
                             [&](const auto &face) { return face.surface == surface; });
        };
        const bool has_base = has(PhysicalId::base) || has(PhysicalId::base_joint);
        if (has_rock && !has_base)
          fail("dam and rock do not touch: no hexahedra of both share a face. Let them share their nodes "
               "(gmsh: Coherence, or remove duplicate nodes).");
        if (has_rock && !has(PhysicalId::artificial))
          fail("the rock has no supports: there is no surface 'artificial boundary' (id 6). Put the lateral "
               "faces and the bottom of the rock into it.");
      }

      /** Throws InputError for two monoliths that lie face to face without common nodes and
       * without a joint. */
      void contacts() const
      {
        std::set<std::array<unsigned int, 4>> named;
        for (const auto &face : mesh.faces)
          named.insert(table.owners(face.nodes).first->key);
        std::map<std::array<double, 3>, int> free_faces; // rounded centre -> monolith
        for (auto entry = table.entries().begin(); entry != table.entries().end(); ++entry)
        {
          const int volume = mesh.cells[entry->cell].volume;
          if (!is_monolith(volume) || table.owners(entry->key).second != nullptr ||
              named.count(entry->key) != 0)
            continue;
          auto key = centre(mesh, entry->key);
          for (double &coordinate : key)
            coordinate = std::round(coordinate * 1e4) + 0.; // no -0
          const auto other = free_faces.emplace(key, volume);
          if (!other.second)
            fail(group_name(mesh, 3, other.first->second) + " and " + group_name(mesh, 3, volume) +
                 " lie face to face at " + place(centre(mesh, entry->key)) +
                 " but share no nodes and are in no joint. Merge the coincident nodes, or put the two sides "
                 "into the surfaces 'joint 1 side 1' (id 101) and 'joint 1 side 2' (id 201), and so on.");
        }
      }

    private:
      bool may_be_interior(const int surface, const unsigned int cell_1, const unsigned int cell_2) const
      {
        const int volume_1 = mesh.cells[cell_1].volume, volume_2 = mesh.cells[cell_2].volume;
        if (is_joint_side(surface)) // joint surfaces of a conforming mesh
          return is_monolith(volume_1) && is_monolith(volume_2) && volume_1 != volume_2;
        return is_base(surface) && is_monolith(volume_1) != is_monolith(volume_2);
      }

      [[noreturn]] void fail(const std::string &text) const
      {
        throw InputError("mesh " + source + ": " + text);
      }

      const HexMesh     &mesh;
      const std::string &source;
      const FaceTable    table;
      const bool         has_rock;
    };
  } // namespace

  void check_mesh(const HexMesh &mesh, const std::string &source)
  {
    const Check check(mesh, source);
    check.nodes();
    check.volumes();
    check.cells();
    check.faces();
    check.supports();
    check.contacts();
    if (mesh.water == nullptr)
      return;
    const Check of_water(*mesh.water, source);
    of_water.nodes();
    of_water.cells();
    of_water.faces();
  }
} // namespace Voussoir
