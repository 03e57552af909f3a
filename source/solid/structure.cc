// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/mesh/mesh.h>
#include <voussoir/solid/structure.h>

#include <algorithm>
#include <cassert>
#include <cmath>

namespace Voussoir
{
  std::string Body::name() const
  {
    return physical_name(3, number);
  }

  void Structure::collect_interfaces()
  {
    std::vector<bool> in_pair(n_nodes(), false);
    for (const Pair &pair : pairs)
      for (const unsigned int node : {pair.node_1, pair.node_2})
        if (node != rigid_ground)
          in_pair[node] = true;
    for (Body &body : bodies)
    {
      body.interface.clear();
      for (unsigned int i = 0; i < body.n_nodes(); ++i)
        if (in_pair[body.first_node + i])
          body.interface.push_back(i);
    }
    std::vector<double> work; // estimate: substitution with the factor, dense blocks of its joints
    for (const Body &body : bodies)
      work.push_back(60. * std::pow(body.n_nodes(), 4. / 3.) + std::pow(body.interface.size(), 2.));
    share = Shares(work);
  }

  unsigned int Structure::n_groups() const
  {
    return group_of_joint.empty() ? n_joints
                                  : 1 + *std::max_element(group_of_joint.begin(), group_of_joint.end());
  }

  void Structure::decouple_y()
  {
    const auto decouple = [](Matrix3 &block, const bool is_diagonal)
    {
      const double yy = block[4];
      for (unsigned int c = 0; c < 3; ++c)
        block[3 + c] = block[3 * c + 1] = 0.;
      block[4] = is_diagonal ? yy : 0.;
    };
    for (Body &body : bodies)
      for (unsigned int row = 0; row < body.n_nodes(); ++row)
        for (std::size_t k = body.stiffness.start[row]; k < body.stiffness.start[row + 1]; ++k)
          decouple(body.stiffness.value[k], body.stiffness.column[k] == row);
    for (Matrix3 &block : mass)
      decouple(block, true);
    for (Matrix3 &block : added_mass)
      decouple(block, true);
    plane_strain = true;
  }

  void Structure::remove_held_forces(Unknowns &load) const
  {
    for (std::size_t k = 1; plane_strain && k < load.size(); k += 3)
      load[k] = 0.;
  }

  unsigned int Structure::body_of(const unsigned int node) const
  {
    const auto after = std::upper_bound(bodies.begin(), bodies.end(), node,
                                        [](const unsigned int n, const Body &b) { return n < b.first_node; });
    return static_cast<unsigned int>(after - 1 - bodies.begin());
  }

  void Structure::multiply_stiffness(const Unknowns &u, Unknowns &Ku,
                                     BlockSparseMatrix Body::*const matrix) const
  {
    assert(u.size() == 3 * std::size_t(n_nodes()));
    Ku.resize(u.size());
    for (unsigned int b = 0; b < bodies.size(); ++b)
      if (share.is_mine(b))
        (bodies[b].*matrix)
            .multiply(u.data() + 3 * std::size_t(bodies[b].first_node),
                      Ku.data() + 3 * std::size_t(bodies[b].first_node));
    gather(Ku);
  }

  Unknowns Structure::damped_force(const Unknowns &u) const
  {
    Unknowns force;
    if (has_zones())
      multiply_stiffness(u, force, &Body::damped);
    return force;
  }

  void Structure::add_reaction(const double factor, const Unknowns &u, Unknowns &y) const
  {
    for (const Body &body : bodies)
      for (const unsigned int row : body.reacting)
        for (std::size_t e = body.stiffness.start[row]; e < body.stiffness.start[row + 1]; ++e)
        {
          const Vector3 force = body.reaction[e] * get(u, body.first_node + body.stiffness.column[e]);
          for (unsigned int c = 0; c < 3; ++c)
            y[3 * std::size_t(body.first_node + row) + c] += factor * force[c];
        }
  }

  void Structure::gather(Unknowns &u) const
  {
    if (share.are_trivial())
      return;
    std::vector<std::size_t> first;
    for (const Body &body : bodies)
      first.push_back(3 * std::size_t(body.first_node));
    first.push_back(u.size());
    Ranks::gather(u.data(), share.parts(first));
  }

  Vector3 Structure::jump(const Pair &pair, const Unknowns &u) const
  {
    Vector3 d = {{0., 0., 0.}};
    for (unsigned int c = 0; c < 3; ++c)
      d[c] = (pair.node_2 == rigid_ground ? 0. : u[3 * pair.node_2 + c]) -
             (pair.node_1 == rigid_ground ? 0. : u[3 * pair.node_1 + c]);
    Vector3 result;
    for (unsigned int i = 0; i < 3; ++i)
      result[i] = pair.frame[i][0] * d[0] + pair.frame[i][1] * d[1] + pair.frame[i][2] * d[2];
    return result;
  }

  void Structure::add_pair_force(const Pair &pair, const Vector3 &f, Unknowns &u) const
  {
    for (unsigned int c = 0; c < 3; ++c)
    {
      const double x = pair.frame[0][c] * f[0] + pair.frame[1][c] * f[1] + pair.frame[2][c] * f[2];
      if (pair.node_2 != rigid_ground)
        u[3 * pair.node_2 + c] += x;
      if (pair.node_1 != rigid_ground)
        u[3 * pair.node_1 + c] -= x;
    }
  }
} // namespace Voussoir
