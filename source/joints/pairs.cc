// SPDX-License-Identifier: GPL-3.0-or-later
#include <deal.II/base/exceptions.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_values.h>

#include <voussoir/base/error.h>
#include <voussoir/joints/pairs.h>
#include <voussoir/mesh/mesh_joints.h>
#include <voussoir/solid/solid_grid.h>
#include <voussoir/solid/solid_model.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>
#include <tuple>

namespace Voussoir
{
  using namespace dealii;

  namespace
  {
    /** Two coincident nodes of a joint, and the tributary area vector from side 1 to side 2. */
    struct NodePair
    {
      unsigned int              joint, node_1, node_2; ///< node_1: rigid_ground in a base joint
      Tensor<1, 3>              area;
      std::vector<Tensor<1, 3>> planes; ///< parts of the area at an edge; otherwise empty
    };

    /** Adds the area vector of a face to the plane with the same normal within 20 degrees. */
    void add_to_planes(std::vector<Tensor<1, 3>> &planes, const Tensor<1, 3> &area)
    {
      for (Tensor<1, 3> &plane : planes)
        if (plane * area > std::cos(20. * M_PI / 180.) * plane.norm() * area.norm())
        {
          plane += area;
          return;
        }
      planes.push_back(area);
    }

    std::array<Vector3, 3> frame_of(const Tensor<1, 3> &area)
    {
      const Tensor<1, 3> n = area / area.norm();
      Tensor<1, 3>       up;
      up[std::abs(n[2]) < .9 ? 2 : 1] = 1.;
      Tensor<1, 3> b = up - (up * n) * n;
      b /= b.norm();
      const Tensor<1, 3>     a = cross_product_3d(b, n);
      std::array<Vector3, 3> frame;
      for (unsigned int d = 0; d < 3; ++d)
        frame[0][d] = n[d], frame[1][d] = a[d], frame[2][d] = b[d];
      return frame;
    }

    /** Nodes of a joint. Nodes of side 1 have their area vectors, from side 1 to side 2, and the planes of
     * which these consist; in a base joint those of side 2 have them. */
    struct JointNodes
    {
      bool                                              is_base = false;
      std::map<unsigned int, Tensor<1, 3>>              area;
      std::map<unsigned int, std::vector<Tensor<1, 3>>> planes;
      std::set<unsigned int>                            side_2;
    };

    void add_face(const FEFaceValues<3> &values, const std::vector<types::global_dof_index> &dofs,
                  const unsigned int face, const bool is_side_2, JointNodes &nodes)
    {
      for (unsigned int i = 0; i < dofs.size(); ++i)
      {
        if (!values.get_fe().has_support_on_face(i, face))
          continue;
        if (is_side_2 && !nodes.is_base)
        {
          nodes.side_2.insert(dofs[i]);
          continue;
        }
        const double sign = is_side_2 ? -1. : 1.;
        Tensor<1, 3> of_face;
        for (const unsigned int q : values.quadrature_point_indices())
        {
          const Tensor<1, 3> part = sign * values.shape_value(i, q) * values.JxW(q) * values.normal_vector(q);
          nodes.area[dofs[i]] += part;
          of_face += part;
        }
        add_to_planes(nodes.planes[dofs[i]], of_face);
      }
    }

    std::vector<JointNodes> nodes_of_joints(const SolidModel &model, const unsigned int n_joints)
    {
      std::vector<JointNodes>              joints(n_joints);
      FEFaceValues<3>                      values(model.grid->fe, QGauss<2>(model.degree + 1),
                                                  update_values | update_normal_vectors | update_JxW_values);
      std::vector<types::global_dof_index> dofs(model.grid->fe.n_dofs_per_cell());
      for (const auto &cell : model.grid->dof_handler.active_cell_iterators())
        for (const unsigned int f : cell->face_indices())
          if (cell->face(f)->at_boundary() && is_joint_side(cell->face(f)->boundary_id()))
          {
            const bool         is_side_2 = cell->face(f)->boundary_id() > PhysicalId::joint_side_2;
            const unsigned int joint = cell->face(f)->boundary_id() -
                                       (is_side_2 ? PhysicalId::joint_side_2 : PhysicalId::joint_side_1) - 1;
            AssertThrow(joint < n_joints, ExcInternalError());
            const int side = cell->face(f)->boundary_id();
            if (model.base_joints.count(side) > model.open_base.count(side))
              continue; // bonded
            cell->get_dof_indices(dofs);
            values.reinit(cell, f);
            joints[joint].is_base = model.base_joints.count(cell->face(f)->boundary_id()) > 0;
            add_face(values, dofs, f, is_side_2, joints[joint]);
          }
      return joints;
    }

    /** Returns the candidate that coincides with @p node, which has the tributary area @p area. */
    unsigned int partner_of(const unsigned int node, const double area, const SolidModel &model,
                            const std::set<unsigned int> &candidates, const unsigned int joint)
    {
      const Vector3 &p = model.points[node];
      double         distance = 1e300;
      unsigned int   nearest = rigid_ground;
      for (const unsigned int k : candidates)
        if (const double d = distance_between(p, model.points[k]); d < distance)
        {
          distance = d;
          nearest = k;
        }
      if (distance <= 1e-3 * std::sqrt(area))
        return nearest;
      std::ostringstream message;
      message << "Joint " << joint + 1 << " of the mesh: the node at (" << p[0] << " " << p[1] << " " << p[2]
              << ") m on side 1 has no partner on side 2";
      if (nearest != rigid_ground)
        message << "; the nearest is " << distance << " m away";
      message << ". The nodes on the two sides of a joint must coincide: mesh both monoliths with the "
                 "same divisions.";
      throw InputError(message.str());
    }

    std::vector<NodePair> match_joint_nodes(const SolidModel &model, const unsigned int n_joints)
    {
      std::vector<JointNodes> joints = nodes_of_joints(model, n_joints);
      std::vector<NodePair>   matched;
      for (unsigned int j = 0; j < n_joints; ++j)
      {
        std::set<unsigned int> &free = joints[j].side_2;
        Tensor<1, 3>            mean;
        for (const auto &node : joints[j].area)
          mean += node.second;
        for (const auto &node : joints[j].area)
        {
          const bool is_base = joints[j].is_base;
          const bool is_flat = is_base || model.on_footings.count(PhysicalId::joint_side_2 + j + 1) > 0;
          const unsigned int partner =
              is_base ? node.first : partner_of(node.first, node.second.norm(), model, free, j);
          free.erase(partner);
          std::vector<Tensor<1, 3>> &parts = joints[j].planes[node.first];
          std::stable_sort(parts.begin(), parts.end(),
                           [&](const Tensor<1, 3> &x, const Tensor<1, 3> &y)
                           { return x * mean / x.norm() > y * mean / y.norm() + 1e-9 * mean.norm(); });
          matched.push_back({j, is_base ? rigid_ground : node.first, partner, node.second,
                             parts.size() > 1 && !is_flat ? parts : std::vector<Tensor<1, 3>>()});
        }
      }
      return matched;
    }
  } // namespace

  PairsByNode pairs_by_node(const std::vector<Pair> &pairs)
  {
    PairsByNode result;
    for (unsigned int p = 0; p < pairs.size(); ++p)
      result[{pairs[p].joint, pairs[p].is_base ? pairs[p].node_2 : pairs[p].node_1}] = p;
    return result;
  }

  std::vector<Pair> find_pairs(const SolidModel &model, const unsigned int n_joints)
  {
    std::vector<Pair> pairs;
    // by its nodes, and by its joint if one of them is fixed
    std::map<std::tuple<unsigned int, unsigned int, unsigned int>, std::size_t> pair_of;
    for (const NodePair &match : match_joint_nodes(model, n_joints))
    {
      Pair pair;
      pair.node_1 = match.node_1 == rigid_ground ? rigid_ground : model.equation[match.node_1];
      pair.node_2 = model.equation[match.node_2];
      if (pair.node_1 == pair.node_2) // both nodes fixed, or tied
        continue;
      pair.joint = match.joint;
      pair.is_base = match.node_1 == rigid_ground;
      const auto same = pair_of.emplace(
          std::make_tuple(pair.node_1 == rigid_ground || pair.node_2 == rigid_ground ? pair.joint + 1 : 0,
                          pair.node_1, pair.node_2),
          pairs.size());
      if (!same.second) // nodes that move together, also in joints between lifts that are tied
      {
        pairs[same.first->second].area += match.area.norm();
        continue;
      }
      pair.area = match.area.norm();
      for (unsigned int d = 0; d < 3; ++d)
        pair.place[d] = model.points[match.node_1 == rigid_ground ? match.node_2 : match.node_1][d];
      pair.frame = frame_of(match.planes.empty() ? match.area : match.planes[0]);
      if (!match.planes.empty())
        pair.area = 0.;
      for (const Tensor<1, 3> &plane : match.planes)
      {
        const std::array<Vector3, 3> axes = frame_of(plane);
        Matrix3                      in_frame;
        for (unsigned int i = 0; i < 3; ++i)
          for (unsigned int k = 0; k < 3; ++k)
            in_frame[3 * i + k] =
                axes[i][0] * pair.frame[k][0] + axes[i][1] * pair.frame[k][1] + axes[i][2] * pair.frame[k][2];
        pair.planes.push_back(pair.planes.empty() ? Matrix3{{1., 0., 0., 0., 1., 0., 0., 0., 1.}} : in_frame);
        pair.area += plane.norm();
      }
      pairs.push_back(pair);
    }
    return pairs;
  }

  void tie_joints(SolidModel &model, const unsigned int n_joints,
                  const std::function<bool(unsigned int)> &is_tied)
  {
    std::vector<std::pair<unsigned int, unsigned int>> together;
    for (const NodePair &match : match_joint_nodes(model, n_joints))
      if (match.node_1 != rigid_ground && (!is_tied || is_tied(match.joint)))
        together.emplace_back(match.node_1, match.node_2);
    model.merge(together, !is_tied);
  }

  void tie_base_nodes(SolidModel &model, const unsigned int n_joints)
  {
    std::vector<std::pair<unsigned int, unsigned int>> together;
    for (const NodePair &match : match_joint_nodes(model, n_joints))
      if (match.node_1 != rigid_ground && model.on_surface(match.node_1, PhysicalId::base) &&
          model.on_surface(match.node_2, PhysicalId::base))
        together.emplace_back(match.node_1, match.node_2);
    model.merge(together, true);
  }

  std::vector<std::vector<unsigned int>> clusters_of(const std::vector<Pair> &pairs)
  {
    std::map<unsigned int, unsigned int> first; // pair of each free node
    NumberPairs                          together;
    for (unsigned int p = 0; p < pairs.size(); ++p)
      for (const unsigned int node : {pairs[p].node_1, pairs[p].node_2})
        if (node != rigid_ground)
          if (const auto found = first.emplace(node, p); !found.second)
            together.emplace_back(found.first->second, p);
    const std::vector<unsigned int>                   smallest = smallest_of_sets(pairs.size(), together);
    std::map<unsigned int, std::vector<unsigned int>> members;
    for (unsigned int p = 0; p < pairs.size(); ++p)
      members[smallest[p]].push_back(p);
    std::vector<std::vector<unsigned int>> result;
    for (const auto &[p, list] : members)
      if (list.size() > 1)
        result.push_back(list);
    return result;
  }

  std::vector<std::vector<unsigned int>> clusters_with_feet(const Structure &structure)
  {
    std::vector<std::vector<unsigned int>> clusters = structure.clusters;
    const std::vector<Pair>               &pairs = structure.pairs;
    std::vector<bool>                      taken(pairs.size(), clusters.empty());
    for (const auto &cluster : clusters)
      for (const unsigned int p : cluster)
        taken[p] = true;
    using Blocks = std::pair<unsigned int, unsigned int>;
    std::vector<unsigned int>                   on_base;
    std::map<Blocks, std::vector<unsigned int>> between;
    for (unsigned int p = 0; p < pairs.size(); ++p)
      if (!taken[p] && pairs[p].is_base)
        on_base.push_back(p);
      else if (!taken[p])
        between[std::minmax(structure.body_of(pairs[p].node_1), structure.body_of(pairs[p].node_2))]
            .push_back(p);
    for (const unsigned int p : on_base)
      for (const unsigned int q : on_base)
      {
        const Blocks blocks(structure.body_of(pairs[p].node_2), structure.body_of(pairs[q].node_2));
        if (taken[p] || taken[q] || blocks.first >= blocks.second || between.count(blocks) == 0 ||
            norm(pairs[p].place - pairs[q].place) > 1e-6)
          continue;
        const auto distance = [&](const unsigned int r)
        { return taken[r] ? 1e300 : norm(pairs[r].place - pairs[p].place); };
        const std::vector<unsigned int> &list = between.at(blocks);
        const unsigned int               nearest = *std::min_element(list.begin(), list.end(),
                                                                     [&](const unsigned int r, const unsigned int s)
                                                                     { return distance(r) < distance(s); });
        std::vector<unsigned int>        foot = {p, q};
        if (!taken[nearest])
          foot.push_back(nearest);
        for (const unsigned int r : foot)
          taken[r] = true;
        std::sort(foot.begin(), foot.end());
        clusters.push_back(foot);
      }
    return clusters;
  }
} // namespace Voussoir
