// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/tensor3.h>
#include <voussoir/mesh/mesh.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <set>
#include <sstream>
#include <tuple>

namespace Voussoir
{
  namespace
  {
    /** Corners of the unit cube in the order of a cell's nodes. */
    constexpr double cube[8][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                   {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};

    /** Returns the determinant of the Jacobian of the trilinear map from the unit cube at @p xi [m^3]. */
    double jacobian(const HexMesh &mesh, const HexMesh::Cell &cell, const Vector3 &xi)
    {
      Matrix3 jacobian{};
      for (unsigned int v = 0; v < 8; ++v)
        for (unsigned int a = 0; a < 3; ++a)
        {
          double derivative = 1;
          for (unsigned int b = 0; b < 3; ++b)
            derivative *= a == b ? 2 * cube[v][b] - 1 : (cube[v][b] == 1 ? xi[b] : 1 - xi[b]);
          for (unsigned int c = 0; c < 3; ++c)
            jacobian[3 * c + a] += derivative * mesh.nodes[cell.nodes[v]][c];
        }
      return determinant(jacobian);
    }

    /** Returns the smallest and the largest determinant at the corners and at the centre [m^3]. */
    std::pair<double, double> jacobian_range(const HexMesh &mesh, const HexMesh::Cell &cell)
    {
      std::array<double, 9> values;
      for (unsigned int v = 0; v < 8; ++v)
        values[v] = jacobian(mesh, cell, {cube[v][0], cube[v][1], cube[v][2]});
      values[8] = jacobian(mesh, cell, {0.5, 0.5, 0.5});
      const auto extrema = std::minmax_element(values.begin(), values.end());
      return {*extrema.first, *extrema.second};
    }

    bool is_mirrored(const HexMesh &mesh, const HexMesh::Cell &cell)
    {
      return jacobian_range(mesh, cell).second < 0;
    }

    void drop_unused_nodes(HexMesh &mesh)
    {
      const unsigned int        unused = -1;
      std::vector<unsigned int> number(mesh.nodes.size(), unused);
      for (const auto &cell : mesh.cells)
        for (const unsigned int node : cell.nodes)
          number[node] = 0;
      // check_mesh() reports faces with a node of no cell. Such nodes remain until then.
      for (const auto &face : mesh.faces)
        for (const unsigned int node : face.nodes)
          number[node] = 0;

      unsigned int n_used = 0;
      for (unsigned int node = 0; node < number.size(); ++node)
        if (number[node] != unused)
        {
          mesh.nodes[n_used] = mesh.nodes[node];
          number[node] = n_used++;
        }
      mesh.nodes.resize(n_used);
      for (auto &cell : mesh.cells)
        for (unsigned int &node : cell.nodes)
          node = number[node];
      for (auto &face : mesh.faces)
        for (unsigned int &node : face.nodes)
          node = number[node];
    }

    /** Splits a name into words and numbers in lower case: "Joint3_minus" into "joint", "3", "minus". */
    std::vector<std::string> words(const std::string &name)
    {
      std::vector<std::string> result;
      char                     last = ' ';
      for (const char raw : name)
      {
        const unsigned char c = std::tolower(static_cast<unsigned char>(raw));
        if (std::isalnum(c))
        {
          if (!std::isalnum(static_cast<unsigned char>(last)) ||
              !std::isdigit(c) != !std::isdigit(static_cast<unsigned char>(last)))
            result.emplace_back();
          result.back() += c;
        }
        last = c;
      }
      return result;
    }

    /** Returns the number in @p word if it is from 1 to @p largest, otherwise -1. */
    int to_number(const std::string &word, const int largest)
    {
      if (word.empty() || word.size() > 4 || !std::isdigit(static_cast<unsigned char>(word[0])))
        return -1;
      const int number = std::stoi(word);
      return number >= 1 && number <= largest ? number : -1;
    }

    /** Returns true for the words of "monolith 3 lift 2" with or without a zone. */
    bool is_lift(const std::vector<std::string> &word)
    {
      return word.size() >= 4 && word[2] == "lift" && std::isdigit(word[3][0]);
    }

    const std::map<int, std::string> surface_names = {{PhysicalId::base, "base"},
                                                      {PhysicalId::base_joint, "base joint"},
                                                      {PhysicalId::upstream, "upstream"},
                                                      {PhysicalId::downstream, "downstream"},
                                                      {PhysicalId::crest, "crest"},
                                                      {PhysicalId::free_surface, "free surface"},
                                                      {PhysicalId::artificial, "artificial boundary"},
                                                      {PhysicalId::water_end, "water end"}};
  } // namespace

  FaceTable::FaceTable(const HexMesh &mesh)
  {
    table.reserve(6 * mesh.cells.size());
    for (unsigned int c = 0; c < mesh.cells.size(); ++c)
      for (unsigned int f = 0; f < 6; ++f)
      {
        Entry entry{{}, c, f};
        for (unsigned int v = 0; v < 4; ++v)
          entry.key[v] = mesh.cells[c].nodes[hex_faces[f][v]];
        std::sort(entry.key.begin(), entry.key.end());
        table.push_back(entry);
      }
    std::sort(table.begin(), table.end(),
              [](const Entry &a, const Entry &b)
              { return std::tie(a.key, a.cell) < std::tie(b.key, b.cell); });
  }

  std::pair<const FaceTable::Entry *, const FaceTable::Entry *>
  FaceTable::owners(std::array<unsigned int, 4> nodes) const
  {
    std::sort(nodes.begin(), nodes.end());
    const auto first = std::lower_bound(table.begin(), table.end(), nodes,
                                        [](const Entry &entry, const auto &key) { return entry.key < key; });
    if (first == table.end() || first->key != nodes)
      return {nullptr, nullptr};
    const auto second = first + 1;
    return {&*first, second != table.end() && second->key == nodes ? &*second : nullptr};
  }

  std::string physical_name(const int dimension, const int id)
  {
    if (dimension == 3 && id == PhysicalId::water)
      return "water";
    if (dimension == 3 && !is_monolith(id))
      return "rock " + std::to_string(id);
    if (dimension == 3 && is_footing(id))
      return "footing of " + physical_name(3, id - footing_of(0));
    if (dimension == 3)
      return "monolith " + std::to_string(monolith_of(id)) +
             (lift_of(id) > 1 ? " lift " + std::to_string(lift_of(id)) : "");
    const auto name = surface_names.find(id);
    if (name != surface_names.end())
      return name->second;
    for (const int side : {1, 2})
    {
      const int joint = id - (side == 1 ? PhysicalId::joint_side_1 : PhysicalId::joint_side_2);
      if (joint >= 1 && joint <= PhysicalId::max_joints)
        return "joint " + std::to_string(joint) + " side " + std::to_string(side);
    }
    return "surface " + std::to_string(id);
  }

  int physical_id(const int dimension, const std::string &name)
  {
    const std::vector<std::string> word = words(name);
    if (dimension == 3)
    {
      // A zone may follow the number of the monolith or of its lift, but no further number.
      const unsigned int end = is_lift(word) ? 4 : 2;
      if (word.size() >= end && word[0] == "monolith" && (word.size() == end || std::isalpha(word[end][0])))
      {
        const int monolith = to_number(word[1], PhysicalId::first_rock - 1),
                  lift = end == 4 ? to_number(word[3], PhysicalId::max_lifts) : 1;
        return monolith == -1 || lift == -1 ? -1 : monolith + (lift - 1) * PhysicalId::per_lift;
      }
      if (word == words(physical_name(3, PhysicalId::water)))
        return PhysicalId::water;
      return !word.empty() && word[0] == "rock" ? PhysicalId::first_rock : -1;
    }
    for (const auto &surface : surface_names)
      if (word == words(surface.second))
        return surface.first;
    if (word.size() < 3 || word.size() > 4 || word[0] != "joint" || (word.size() == 4 && word[2] != "side"))
      return -1;
    const int joint = to_number(word[1], PhysicalId::max_joints);
    if (joint == -1)
      return -1;
    if (word.back() == "1" || word.back() == "minus")
      return PhysicalId::joint_side_1 + joint;
    if (word.back() == "2" || word.back() == "plus")
      return PhysicalId::joint_side_2 + joint;
    return -1;
  }

  namespace
  {
    std::string joined(const std::vector<std::string> &words, const std::size_t first)
    {
      std::string result;
      for (std::size_t i = first; i < words.size(); ++i)
        result += (i == first ? "" : " ") + words[i];
      return result;
    }
  } // namespace

  std::string zone_of(const std::string &volume_name)
  {
    const std::vector<std::string> word = words(volume_name);
    const int                      id = physical_id(3, volume_name);
    const bool is_id = word.size() == 2 && word[1].size() >= 4 && std::isdigit(word[1][0]);
    if (id == -1 || (!is_monolith(id) && is_id))
      return "";
    return joined(word, !is_monolith(id) ? 1 : is_lift(word) ? 4 : 2);
  }

  std::string zone_name(const std::string &text)
  {
    return joined(words(text), 0);
  }

  bool is_plain(const std::string &name)
  {
    return std::all_of(name.begin(), name.end(), [](const unsigned char c) { return c < 128; });
  }

  unsigned int zone_index(HexMesh &mesh, const std::string &zone)
  {
    const auto found = std::find(mesh.zones.begin(), mesh.zones.end(), zone);
    if (found != mesh.zones.end())
      return found - mesh.zones.begin();
    mesh.zones.push_back(zone);
    return mesh.zones.size() - 1;
  }

  std::string place(const std::array<double, 3> &point)
  {
    std::ostringstream text;
    text << "(" << point[0] << ", " << point[1] << ", " << point[2] << ") m";
    return text.str();
  }

  void normalize(HexMesh &mesh)
  {
    drop_unused_nodes(mesh);
    if (std::all_of(mesh.cells.begin(), mesh.cells.end(),
                    [&](const HexMesh::Cell &cell) { return is_mirrored(mesh, cell); }))
      for (auto &cell : mesh.cells)
        std::swap_ranges(cell.nodes.begin(), cell.nodes.begin() + 4, cell.nodes.begin() + 4);
  }

  void split_water(HexMesh &mesh)
  {
    HexMesh water;
    water.names = mesh.names;
    const auto split = [](auto &from, auto &to, const auto &is_water)
    {
      const auto first =
          std::stable_partition(from.begin(), from.end(), [&](const auto &x) { return !is_water(x); });
      to.assign(first, from.end());
      from.erase(first, from.end());
    };
    split(mesh.cells, water.cells,
          [](const HexMesh::Cell &cell) { return cell.volume == PhysicalId::water; });
    split(mesh.faces, water.faces,
          [](const HexMesh::Face &face) { return face.surface == PhysicalId::water_end; });
    if (water.cells.empty() && water.faces.empty())
      return;
    water.nodes = mesh.nodes;
    normalize(water);
    normalize(mesh);
    mesh.water = std::make_shared<HexMesh>(std::move(water));
  }

  unsigned int n_monoliths(const HexMesh &mesh)
  {
    int largest = 0;
    for (const auto &cell : mesh.cells)
      if (is_monolith(cell.volume))
        largest = std::max(largest, monolith_of(cell.volume));
    return largest;
  }

  double min_jacobian(const HexMesh &mesh, const HexMesh::Cell &cell)
  {
    return jacobian_range(mesh, cell).first;
  }

  std::map<int, double> volumes(const HexMesh &mesh)
  {
    // The determinant is quadratic in each coordinate: 2x2x2 Gauss points are exact.
    const double          gauss[2] = {0.5 - std::sqrt(1. / 12.), 0.5 + std::sqrt(1. / 12.)};
    std::map<int, double> result;
    for (const auto &cell : mesh.cells)
      for (const double x : gauss)
        for (const double y : gauss)
          for (const double z : gauss)
            result[cell.volume] += jacobian(mesh, cell, {x, y, z}) / 8;
    return result;
  }

  double volume(const HexMesh &mesh)
  {
    double sum = 0;
    for (const auto &part : volumes(mesh))
      sum += part.second;
    return sum;
  }

  std::pair<std::array<double, 3>, std::array<double, 3>> bounding_box(const HexMesh &mesh)
  {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    Vector3          lower = {infinity, infinity, infinity}, upper = {-infinity, -infinity, -infinity};
    for (const auto &node : mesh.nodes)
      for (unsigned int d = 0; d < 3; ++d)
      {
        lower[d] = std::min(lower[d], node[d]);
        upper[d] = std::max(upper[d], node[d]);
      }
    return {lower, upper};
  }

  double crest_length(const HexMesh &mesh)
  {
    // Edges by position: the result is the same for doubled nodes at the joints.
    std::map<int, std::set<std::pair<Vector3, Vector3>>> edges;
    for (const auto &face : mesh.faces)
      if (face.surface == PhysicalId::crest || face.surface == PhysicalId::upstream ||
          face.surface == PhysicalId::downstream)
        for (unsigned int v = 0; v < 4; ++v)
          edges[face.surface].insert(
              std::minmax(mesh.nodes[face.nodes[v]], mesh.nodes[face.nodes[(v + 1) % 4]]));

    double sum = 0;
    for (const int surface : {PhysicalId::upstream, PhysicalId::downstream})
      for (const auto &edge : edges[surface])
        if (edges[PhysicalId::crest].count(edge) != 0)
          sum += std::hypot(edge.first[0] - edge.second[0], edge.first[1] - edge.second[1],
                            edge.first[2] - edge.second[2]);
    return sum / 2;
  }
} // namespace Voussoir
