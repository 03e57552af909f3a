// SPDX-License-Identifier: GPL-3.0-or-later
#include <boost/iterator/counting_iterator.hpp>
#include <boost/pending/disjoint_sets.hpp>

#include <voussoir/base/error.h>
#include <voussoir/base/tensor3.h>
#include <voussoir/mesh/coincident.h>
#include <voussoir/mesh/mesh_joints.h>

#include <algorithm>
#include <limits>
#include <sstream>

namespace Voussoir
{
  namespace
  {
    constexpr double coincidence = 1e-4; ///< relative to the shortest edge of the joint faces at the node

    [[noreturn]] void fail(const int joint, const std::string &text)
    {
      throw InputError("mesh: joint " + std::to_string(joint) + ": " + text);
    }

    /** Nodes of one side of a joint, each with the shortest edge of the adjacent faces of the side [m]. */
    using Side = std::map<unsigned int, double>;

    void add_face(const HexMesh &mesh, const HexMesh::Face &face, Side &side)
    {
      for (unsigned int v = 0; v < 4; ++v)
      {
        const unsigned int a = face.nodes[v], b = face.nodes[(v + 1) % 4];
        const double       length = distance_between(mesh.nodes[a], mesh.nodes[b]);
        for (const unsigned int node : {a, b})
        {
          double &shortest = side.emplace(node, length).first->second;
          shortest = std::min(shortest, length);
        }
      }
    }

    /** Appends every node of @p side with the coincident node of @p other to @p pairs. Throws InputError if
     * there is none. */
    void match(const HexMesh &mesh, const int joint, const int side_number, const Side &side,
               const Side &other, NumberPairs &pairs)
    {
      std::vector<unsigned int> numbers;
      std::vector<Vector3>      points;
      for (const auto &candidate : other)
      {
        numbers.push_back(candidate.first);
        points.push_back(mesh.nodes[candidate.first]);
      }
      const PointFinder finder(points);
      for (const auto &node : side)
      {
        const Vector3             &point = mesh.nodes[node.first];
        const double               tolerance = coincidence * node.second;
        const PointFinder::Nearest partner = finder.nearest(point);
        if (partner.distance <= tolerance)
        {
          pairs.emplace_back(node.first, numbers[partner.number]);
          continue;
        }
        std::ostringstream text;
        text << "the node of side " << side_number << " at " << place(point) << " has no partner on side "
             << 3 - side_number << ", whose nearest node is " << partner.distance << " m away (" << tolerance
             << " m are allowed). Use the same mesh on both sides, with nodes at the same positions.";
        fail(joint, text.str());
      }
    }

    /** Returns the faces in joint surfaces that belong to one cell only. */
    std::vector<HexMesh::Face> doubled_faces(const HexMesh &mesh)
    {
      const FaceTable            table(mesh);
      std::vector<HexMesh::Face> result;
      for (const auto &face : mesh.faces)
        if (is_joint_side(face.surface) && table.owners(face.nodes).second == nullptr)
          result.push_back(face);
      return result;
    }

    std::pair<int, int> joint_and_side(const int surface)
    {
      return surface > PhysicalId::joint_side_2 ? std::make_pair(surface - PhysicalId::joint_side_2, 2)
                                                : std::make_pair(surface - PhysicalId::joint_side_1, 1);
    }

    /** Returns the node that replaces each node. */
    std::vector<unsigned int> match_sides(const HexMesh &mesh, const std::vector<HexMesh::Face> &doubled)
    {
      std::map<int, std::array<Side, 2>> joints;
      for (const auto &face : doubled)
      {
        const auto joint = joint_and_side(face.surface);
        add_face(mesh, face, joints[joint.first][joint.second - 1]);
      }
      NumberPairs pairs;
      for (const auto &joint : joints)
      {
        const auto &sides = joint.second;
        for (const int s : {0, 1})
          if (sides[s].empty())
            fail(joint.first,
                 "it has a side " + std::to_string(2 - s) + " but no side " + std::to_string(s + 1) +
                     ". Put the opposite faces into the surface '" +
                     physical_name(2, (s == 0 ? PhysicalId::joint_side_1 : PhysicalId::joint_side_2) +
                                          joint.first) +
                     "'.");
        match(mesh, joint.first, 1, sides[0], sides[1], pairs);
        match(mesh, joint.first, 2, sides[1], sides[0], pairs);
      }
      return smallest_of_sets(mesh.nodes.size(), pairs);
    }

    /** Throws InputError unless all faces @p doubled, after merging, lie between two monoliths. */
    void check_closed(const HexMesh &mesh, const std::vector<HexMesh::Face> &doubled)
    {
      const FaceTable table(mesh);
      for (const auto &face : doubled)
      {
        const auto        joint = joint_and_side(face.surface);
        const auto        owners = table.owners(face.nodes);
        const std::string where =
            "the face of side " + std::to_string(joint.second) + " at " + place(centre(mesh, face.nodes));
        if (owners.first == nullptr || owners.second == nullptr)
          fail(joint.first,
               where + " has no opposite face on the other side. Use the same mesh on both sides.");
        if (mesh.cells[owners.first->cell].volume == mesh.cells[owners.second->cell].volume)
          fail(joint.first,
               where + " has the same volume, '" + physical_name(3, mesh.cells[owners.first->cell].volume) +
                   "', on its other side. A joint must lie between two monoliths. Divide this volume.");
      }
    }

    /** Order of blocks: by monolith, footings first, then by lift. */
    bool is_before(const int block_1, const int block_2)
    {
      const auto place = [](const int block)
      { return std::make_tuple(monolith_of(block), !is_footing(block), block); };
      return place(block_1) < place(block_2);
    }

    struct InOrder
    {
      bool operator()(const std::pair<int, int> &a, const std::pair<int, int> &b) const
      {
        return a.first != b.first ? is_before(a.first, b.first) : is_before(a.second, b.second);
      }
    };
    using JointNumbers = std::map<std::pair<int, int>, int, InOrder>; ///< by the two blocks

    /** Returns the joint number of each pair of adjacent blocks in a conforming mesh. */
    JointNumbers number_joints(const HexMesh &mesh, const FaceTable &table)
    {
      JointNumbers joints;
      for (std::size_t i = 1; i < table.entries().size(); ++i)
      {
        const auto &entry = table.entries()[i], &previous = table.entries()[i - 1];
        const auto  sides =
            std::minmax(mesh.cells[previous.cell].volume, mesh.cells[entry.cell].volume, is_before);
        if (entry.key == previous.key && sides.first != sides.second && is_monolith(sides.first) &&
            is_monolith(sides.second) && !(is_footing(sides.first) && is_footing(sides.second)))
          joints[sides] = 0;
      }
      std::vector<JointNumbers::value_type *> in_order; // base joints last
      for (const bool of_base : {false, true})
        for (auto &joint : joints)
          if (is_footing(joint.first.first) == of_base)
            in_order.push_back(&joint);
      int further = n_monoliths(mesh);
      for (JointNumbers::value_type *joint : in_order)
      {
        const auto &sides = joint->first;
        const bool  is_lowest = lift_of(sides.first) == 1 && sides.second == sides.first + 1;
        joint->second = is_lowest ? sides.first : further++;
        if (joint->second > PhysicalId::max_joints)
          throw InputError("mesh: the contact of " + physical_name(3, sides.first) + " and " +
                           physical_name(3, sides.second) + " would be joint " +
                           std::to_string(joint->second) + ", but joints are numbered up to " +
                           std::to_string(PhysicalId::max_joints) +
                           " only. Merge monoliths or lifts, or give adjacent monoliths successive numbers.");
      }
      return joints;
    }

    constexpr const char *of_base = "base joint"; ///< name of the sides of base joints

    /** Makes the faces of "base joint" the sides 2 of joints with the ground, one per block.
     * @param volume block of each face
     * @param next number of the first joint */
    void number_base_joints(const std::vector<int> &volume, const int next, HexMesh &opened)
    {
      std::map<int, int, bool (*)(int, int)> number(is_before); // by block
      for (std::size_t f = 0; f < volume.size(); ++f)
        if (opened.faces[f].surface == PhysicalId::base_joint)
          number[volume[f]] = 0;
      int after = next;
      for (auto &joint : number)
        joint.second = after++;
      for (std::size_t f = 0; f < volume.size(); ++f)
        if (int &surface = opened.faces[f].surface; surface == PhysicalId::base_joint)
        {
          surface = PhysicalId::joint_side_2 + number[volume[f]];
          opened.names[{2, surface}] = of_base;
        }
      opened.names.erase({2, PhysicalId::base_joint});
    }

    /** Reverses number_base_joints(). */
    void restore_base_joints(HexMesh &mesh)
    {
      for (auto &face : mesh.faces)
        if (const auto name = mesh.names.find({2, face.surface});
            is_joint_side(face.surface) && name != mesh.names.end() && name->second == of_base)
          face.surface = PhysicalId::base_joint;
    }

    /** Copies each shared node for every block except the first. Nodes of the rock stay shared. */
    class Splitter
    {
    public:
      explicit Splitter(HexMesh &mesh)
          : mesh(mesh), keeper(mesh.nodes.size(), std::numeric_limits<int>::max())
      {
        for (const auto &cell : mesh.cells)
          for (const unsigned int node : cell.nodes)
            keeper[node] = !is_monolith(cell.volume) ? rock : std::min(keeper[node], cell.volume);
      }

      unsigned int node_of(const int volume, const unsigned int node)
      {
        if (keeper[node] == rock || keeper[node] == volume)
          return node;
        const auto copy = copies.emplace(std::make_pair(node, volume), mesh.nodes.size());
        if (copy.second)
          mesh.nodes.push_back(Vector3(mesh.nodes[node]));
        return copy.first->second;
      }

    private:
      static constexpr int rock = 0; // less than the number of every monolith

      HexMesh                                             &mesh;
      std::vector<int>                                     keeper; // volume that keeps the original node
      std::map<std::pair<unsigned int, int>, unsigned int> copies;
    };
  } // namespace

  std::vector<std::string> Joint::keys() const
  {
    std::vector<std::string> result = {name(), kind()};
    if (!is_lift())
      result.insert(result.begin() + 1, std::to_string(contraction_number()));
    return result;
  }

  std::string Joint::name() const
  {
    const auto in_lift = [](const int block)
    {
      return std::to_string(monolith_of(block)) +
             (lift_of(block) > 1 ? "." + std::to_string(lift_of(block)) : "");
    };
    if (is_base())
      return "base " + in_lift(block_2);
    const int lift_1 = lift_of(block_1), lift_2 = lift_of(block_2);
    if (is_lift())
      return "lift " + std::to_string(monolith_1()) + "." + std::to_string(lift_1) +
             (lift_2 == lift_1 + 1 ? "" : "-" + std::to_string(lift_2));
    std::string result = "joint " + std::to_string(contraction_number());
    if (lift_1 > 1 || lift_2 > 1)
      result += "." + std::to_string(lift_1) + (lift_1 == lift_2 ? "" : "-" + std::to_string(lift_2));
    return result;
  }

  std::vector<unsigned int> smallest_of_sets(const unsigned int n, const NumberPairs &pairs)
  {
    boost::disjoint_sets_with_storage<> sets(n);
    for (const auto &[i, j] : pairs)
      sets.union_set(i, j);
    const boost::counting_iterator<unsigned int> first(0), last(n);
    sets.compress_sets(first, last);
    sets.normalize_sets(first, last);
    return std::vector<unsigned int>(sets.parents().begin(), sets.parents().end());
  }

  HexMesh close_joints(const HexMesh &mesh)
  {
    HexMesh closed = mesh;
    restore_base_joints(closed);
    auto       doubled = doubled_faces(closed);
    const auto merged = match_sides(closed, doubled);
    for (auto &cell : closed.cells)
      for (unsigned int &node : cell.nodes)
        node = merged[node];
    for (auto *faces : {&closed.faces, &doubled})
      for (auto &face : *faces)
        for (unsigned int &node : face.nodes)
          node = merged[node];
    check_closed(closed, doubled);

    closed.faces.erase(std::remove_if(closed.faces.begin(), closed.faces.end(),
                                      [](const auto &face) { return is_joint_side(face.surface); }),
                       closed.faces.end());
    closed.names.erase(closed.names.lower_bound({2, PhysicalId::joint_side_1}),
                       closed.names.lower_bound({3, 0}));
    normalize(closed);
    return closed;
  }

  HexMesh open_joints(const HexMesh &mesh)
  {
    HexMesh         opened = close_joints(mesh);
    const FaceTable table(opened);
    const auto      joints = number_joints(opened, table);

    Splitter         splitter(opened);
    std::vector<int> of_face; // block
    for (auto &face : opened.faces)
    {
      const int volume = opened.cells[table.owners(face.nodes).first->cell].volume;
      of_face.push_back(volume);
      for (unsigned int &node : face.nodes)
        node = splitter.node_of(volume, node);
    }
    int next = n_monoliths(opened);
    for (const auto &joint : joints)
      next = std::max(next, joint.second + 1);
    number_base_joints(of_face, next, opened);
    for (auto &cell : opened.cells)
      for (unsigned int &node : cell.nodes)
        node = splitter.node_of(cell.volume, node);

    for (std::size_t i = 1; i < table.entries().size(); ++i)
    {
      if (table.entries()[i].key != table.entries()[i - 1].key)
        continue;
      std::array<HexMesh::Face, 2> sides{};
      std::array<int, 2>           owner;
      for (const unsigned int s : {0, 1})
      {
        const auto &entry = table.entries()[i - s];
        const auto &cell = opened.cells[entry.cell];
        owner[s] = cell.volume;
        for (unsigned int v = 0; v < 4; ++v)
          sides[s].nodes[v] = cell.nodes[hex_faces[entry.cell_face][v]];
      }
      if (is_before(owner[1], owner[0]))
      {
        std::swap(owner[0], owner[1]);
        std::swap(sides[0], sides[1]);
      }
      const auto joint = joints.find({owner[0], owner[1]});
      if (joint == joints.end() ||
          std::is_permutation(sides[0].nodes.begin(), sides[0].nodes.end(), sides[1].nodes.begin()))
        continue; // inside a volume, at the rock, or all corners on the rock
      for (const unsigned int s : {0, 1})
      {
        sides[s].surface = (s == 0 ? PhysicalId::joint_side_1 : PhysicalId::joint_side_2) + joint->second;
        opened.names[{2, sides[s].surface}] = physical_name(2, sides[s].surface);
        opened.faces.push_back(sides[s]);
      }
    }
    return opened;
  }

  HexMesh monoliths_only(const HexMesh &mesh)
  {
    HexMesh result = mesh;
    result.cells.clear();
    result.faces.clear();
    for (const HexMesh::Cell &cell : mesh.cells)
      if (is_monolith(cell.volume))
        result.cells.push_back(cell);
    for (const HexMesh::Face &face : mesh.faces)
      if (face.surface != PhysicalId::free_surface && face.surface != PhysicalId::artificial)
        result.faces.push_back(face);
    normalize(result); // removes the nodes of the rock
    return result;
  }

  std::vector<Joint> joints_of(const HexMesh &mesh)
  {
    const FaceTable      table(mesh);
    std::map<int, Joint> joints;
    for (const auto &face : mesh.faces)
      if (is_joint_side(face.surface))
      {
        const auto joint = joint_and_side(face.surface);
        Joint     &result = joints.emplace(joint.first, Joint{joint.first, 0, 0}).first->second;
        (joint.second == 1 ? result.block_1 : result.block_2) =
            mesh.cells[table.owners(face.nodes).first->cell].volume;
      }
    std::vector<Joint> result;
    for (const auto &joint : joints)
      result.push_back(joint.second);
    return result;
  }
} // namespace Voussoir
