// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/joints/joint_reach.h>
#include <voussoir/solid/solid_grid.h>
#include <voussoir/solid/solid_model.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

namespace Voussoir
{
  namespace
  {
    constexpr double large = std::numeric_limits<double>::max();

    /** Returns for each free node the shortest edge of its joint faces, divided by the element degree [m]. */
    std::vector<double> shortest_edges(const SolidModel &model)
    {
      std::vector<double>                          width(model.first_equation.back(), large);
      std::vector<dealii::types::global_dof_index> nodes(model.grid->fe.n_dofs_per_face());
      for (const auto &cell : model.grid->dof_handler.active_cell_iterators())
        for (const unsigned int f : cell->face_indices())
          if (const auto face = cell->face(f); face->at_boundary() && is_joint_side(face->boundary_id()))
          {
            double shortest = large;
            for (unsigned int l = 0; l < face->n_lines(); ++l)
              shortest = std::min(shortest, face->line(l)->diameter());
            face->get_dof_indices(nodes);
            for (const auto node : nodes)
              if (const unsigned int e = model.equation[node]; e != rigid_ground)
                width[e] = std::min(width[e], shortest / model.degree);
          }
      return width;
    }
  } // namespace

  JointReach::JointReach(const SolidModel &model, const std::vector<Pair> &pairs) : width(pairs.size(), large)
  {
    const std::vector<double> of_node = shortest_edges(model);
    unsigned int              n_joints = 0;
    for (std::size_t p = 0; p < pairs.size(); ++p)
    {
      for (const unsigned int node : {pairs[p].node_1, pairs[p].node_2})
        if (node != rigid_ground)
          width[p] = std::min(width[p], of_node[node]);
      n_joints = std::max(n_joints, pairs[p].joint + 1);
    }
    farthest.assign(n_values * std::size_t(n_joints), 0.);
  }

  void JointReach::record(const unsigned int p, const Pair &pair, const Vector3 &moved)
  {
    if (p >= width.size())
      return;
    const double slip = std::hypot(moved[1], moved[2]), most = std::max(moved[0], slip);
    double      *known = &farthest[n_values * std::size_t(pair.joint)];
    if (most <= known[share] * width[p])
      return;
    known[share] = most / width[p];
    known[value] = most;
    known[local] = width[p];
    known[is_slip] = slip > moved[0];
    std::copy(pair.place.begin(), pair.place.end(), known + x);
  }

  std::vector<std::string> JointReach::warnings() const
  {
    constexpr double         allowed = .5;
    std::vector<std::string> texts;
    for (std::size_t j = 0; j < farthest.size() / n_values; ++j)
    {
      const double *known = &farthest[n_values * j];
      if (known[share] <= allowed)
        continue;
      char text[400];
      std::snprintf(
          text, sizeof(text),
          "joint %zu has %s by %.4g m at (%.4g, %.4g, %.4g), %.2g times the width of the elements "
          "there, %.4g m: its nodes no longer face their partners, so its contact forces are inaccurate. Use "
          "elements at least twice as wide as this movement, or check friction, keys and ground motion.",
          j + 1, known[is_slip] > 0. ? "slipped" : "opened", known[value], known[x], known[y], known[z],
          known[share], known[local]);
      texts.emplace_back(text);
    }
    return texts;
  }
} // namespace Voussoir
