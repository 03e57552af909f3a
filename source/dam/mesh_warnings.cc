// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/contact/law_table.h>
#include <voussoir/dam/mesh_warnings.h>
#include <voussoir/mesh/mesh_joints.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>

namespace Voussoir
{
  namespace
  {
    /** Returns a warning about elements of degree 1 that come from tetrahedra, or an empty string. */
    std::string split_tetrahedra(const HexMesh &opened, const Scene &scene)
    {
      constexpr double usual = .2; // split tetrahedra: 2/27
      if (scene.elements.degree != 1)
        return "";
      const double ratio = mesh_quality(opened, false).mean_jacobian_ratio;
      if (ratio >= usual)
        return "";
      std::ostringstream text;
      text.precision(2);
      text << "the hexahedra are as distorted as those of split tetrahedra (the smallest Jacobian of an "
              "element is "
           << ratio
           << " of its largest one, on average). With Elements/Degree = 1 they make the dam too stiff: "
              "frequencies are about 10 to 20 % too high where one tetrahedron reaches through the dam, and "
              "1 to 7 % where two do. Set Elements/Degree = 2.";
      return text.str();
    }

    /** Returns a warning about a block of concrete in parts without common nodes, or an empty string. */
    std::string separate_parts(const HexMesh &opened)
    {
      NumberPairs pairs;
      for (const HexMesh::Cell &cell : opened.cells)
        for (const unsigned int node : cell.nodes)
          pairs.emplace_back(cell.nodes[0], node);
      const std::vector<unsigned int>       part_of = smallest_of_sets(opened.nodes.size(), pairs);
      std::map<int, std::set<unsigned int>> parts; // of each block: their smallest nodes
      for (const HexMesh::Cell &cell : opened.cells)
        if (is_monolith(cell.volume))
          parts[cell.volume].insert(part_of[cell.nodes[0]]);
      for (const auto &[volume, first] : parts)
        if (first.size() > 1)
          return physical_name(3, volume) + " has " + std::to_string(first.size()) +
                 " parts without common nodes, such as those at " + place(opened.nodes[*first.begin()]) +
                 " and " + place(opened.nodes[*first.rbegin()]) +
                 ". No force acts between them. Merge their nodes in the mesh, or give them different numbers, so "
                 "that a joint connects them.";
      return "";
    }

    /** Returns the largest distance of neighbouring nodes on joints with a fracture energy [m]. */
    double distance_of_pairs(const HexMesh &opened, const Scene &scene)
    {
      std::set<int> softening; // numbers of joints
      for (const Joint &joint : joints_of(opened))
        if (joint_law_reads(scene.joints.model_of(joint), "Joints/Fracture energy"))
          softening.insert(joint.number);
      double longest = 0.;
      for (const HexMesh::Face &face : opened.faces)
        if (is_joint_side(face.surface) && softening.count(number_of_joint(face.surface)) > 0)
          for (unsigned int v = 0; v < 4; ++v)
          {
            const auto &a = opened.nodes[face.nodes[v]], &b = opened.nodes[face.nodes[(v + 1) % 4]];
            longest = std::max(longest, std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]));
          }
      return longest / scene.elements.degree;
    }

    /** Returns a warning about cohesive joints whose crack needs less energy than the adjacent elements
     * store, or an empty string. @p young: Young's modulus of the concrete [Pa]. */
    std::string long_elements_on_bonds(const HexMesh &opened, const Scene &scene, const double young)
    {
      const double strength = scene.joints.strength, energy = scene.joints.fracture_energy,
                   required = young * energy / (strength * strength),
                   distance = strength > 0. ? distance_of_pairs(opened, scene) : 0.;
      if (distance == 0. || distance <= required)
        return "";
      std::ostringstream text;
      text.precision(2);
      text << "nodes of cohesive joints are up to " << distance << " m apart. The limit is " << required
           << " m (Young's modulus times Joints/Fracture energy, divided by the square of Joints/Strength). "
              "Above it, the cracked pairs depend on increments, time step and numbers of the joints. ";
      if (required > 0.)
        text << "Refine the mesh along these joints to " << required << " m, or compare several "
             << "Statics/Water increments.";
      else
        text << "Set Joints/Fracture energy, such as 150 N/m.";
      return text.str();
    }
  } // namespace

  std::vector<std::string> mesh_warnings(const HexMesh &opened, const Scene &scene,
                                         const std::vector<Zone> &zones)
  {
    double young = zones.front().material.young; // of the softest zone
    for (const Zone &zone : zones)
      young = std::min(young, zone.material.young);
    std::vector<std::string> warnings;
    for (const std::string &warning : {separate_parts(opened), split_tetrahedra(opened, scene),
                                       long_elements_on_bonds(opened, scene, young)})
      if (!warning.empty())
        warnings.push_back(warning);
    return warnings;
  }
} // namespace Voussoir
