// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/error.h>
#include <voussoir/dam/dam_geometry.h>
#include <voussoir/solid/solid_grid.h>
#include <voussoir/solid/solid_model.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <sstream>

namespace Voussoir
{
  using namespace dealii;

  DamGeometry::DamGeometry(const SolidModel &model, const std::vector<Pair> &pairs,
                           const unsigned int n_joints, const std::string &source)
      : joints(n_joints)
  {
    std::vector<unsigned int> nodes;
    for (unsigned int i = 0; i < model.n_nodes(); ++i)
      if (model.on_surface(i, PhysicalId::crest) && model.on_surface(i, PhysicalId::upstream))
        nodes.push_back(i);
    if (nodes.size() < 2)
      throw InputError("mesh " + source +
                       ": the surfaces \"crest\" and \"upstream\" do not meet, or are missing. Results are "
                       "reported along their common edge. Add both surfaces to the mesh.");
    std::sort(nodes.begin(), nodes.end(),
              [&](const unsigned int i, const unsigned int j)
              { return model.points[i][1] < model.points[j][1]; });
    for (const unsigned int i : nodes)
      if (edge.empty() || distance_between(edge.back(), model.points[i]) >
                              1e-6 * distance_between(model.points[nodes.back()], edge[0]))
        edge.push_back(model.points[i]);
    at.push_back(0.);
    for (std::size_t i = 1; i < edge.size(); ++i)
      at.push_back(at.back() + std::hypot(edge[i][0] - edge[i - 1][0], edge[i][1] - edge[i - 1][1]));
    const double middle = .5 * at.back();
    for (double &s : at)
      s -= middle;
    find_crown(model, nodes);

    for (unsigned int p = 0; p < pairs.size(); ++p)
    {
      CrestPairs  &crest = joints[pairs[p].joint];
      const double tall = 1e-3; // tolerance for the heights of crest nodes [m]
      for (const bool upstream : {true, false})
      {
        unsigned int &best = upstream ? crest.upstream : crest.downstream;
        if (best == rigid_ground || pairs[p].place[2] > pairs[best].place[2] + tall ||
            (pairs[p].place[2] > pairs[best].place[2] - tall &&
             (pairs[p].place[0] < pairs[best].place[0]) == upstream))
          best = p;
      }
    }
    for (CrestPairs &crest : joints)
      if (crest.upstream != rigid_ground)
      {
        const Vector3 &x = pairs[crest.upstream].place;
        crest.arc_length = arc_length(x);
      }
  }

  void DamGeometry::find_crown(const SolidModel &model, const std::vector<unsigned int> &nodes)
  {
    const double same = 1e-6 * (at.back() - at.front()); // tolerance for equal positions [m]
    double       nearest = std::numeric_limits<double>::infinity(), place = nearest;
    for (const unsigned int i : nodes)
      nearest = std::min(nearest, std::abs(arc_length(model.points[i])));
    for (const unsigned int i : nodes)
      if (const double s = arc_length(model.points[i]); std::abs(s) <= nearest + same)
        place = std::min(place, s);
    std::map<unsigned int, double> side; // of each node there: smallest arc length of its elements
    for (const unsigned int i : nodes)
      if (std::abs(arc_length(model.points[i]) - place) <= same)
        side[i] = std::numeric_limits<double>::infinity();
    std::vector<types::global_dof_index> dofs(model.grid->fe.n_dofs_per_cell());
    for (const auto &cell : model.grid->dof_handler.active_cell_iterators())
    {
      cell->get_dof_indices(dofs);
      for (const auto i : dofs)
        if (const auto found = side.find(i); found != side.end())
          found->second = std::min(found->second, arc_length(to_vector(cell->center())));
    }
    const auto [right, left] = std::minmax_element(
        side.begin(), side.end(), [](const auto &a, const auto &b) { return a.second < b.second; });
    crown = right->first;
    crown_left = left->first;
  }

  double DamGeometry::arc_length(const Vector3 &p) const
  {
    double nearest = 1e300, result = 0.;
    for (std::size_t i = 0; i + 1 < edge.size(); ++i)
    {
      const double dx = edge[i + 1][0] - edge[i][0], dy = edge[i + 1][1] - edge[i][1],
                   length = at[i + 1] - at[i];
      const double     t = ((p[0] - edge[i][0]) * dx + (p[1] - edge[i][1]) * dy) / (length * length);
      constexpr double endless =
          std::numeric_limits<double>::infinity(); // the edge is extended beyond its ends
      const double s = std::clamp(t, i == 0 ? -endless : 0., i + 2 == edge.size() ? endless : 1.);
      const double d = std::hypot(p[0] - edge[i][0] - s * dx, p[1] - edge[i][1] - s * dy);
      if (d < nearest)
        nearest = d, result = at[i] + s * length;
    }
    return result;
  }

  unsigned int nearest_node(const SolidModel &model, const Vector3 &p)
  {
    return std::min_element(model.points.begin(), model.points.end(),
                            [&](const Vector3 &a, const Vector3 &b)
                            { return distance_between(a, p) < distance_between(b, p); }) -
           model.points.begin();
  }

  unsigned int probe_node(const SolidModel &model, const std::string &name, const Vector3 &p)
  {
    return node_at(model, "Entry \"Output/Probes\": probe \"" + name + "\"", p);
  }

  namespace
  {
    /** Returns the node at the position of @p node whose monolith has the element centre nearest to @p p. If
     * @p p equals this position, the result is @p node. */
    unsigned int on_side_of(const SolidModel &model, const unsigned int node, const Vector3 &p)
    {
      const double                         same = 1e-6; // tolerance for equal positions [m]
      std::vector<types::global_dof_index> dofs(model.grid->fe.n_dofs_per_cell());
      unsigned int                         result = node;
      double                               nearest = std::numeric_limits<double>::infinity();
      for (const auto &cell : model.grid->dof_handler.active_cell_iterators())
      {
        cell->get_dof_indices(dofs);
        for (const auto other : dofs)
          if (distance_between(model.points[other], model.points[node]) < same &&
              distance_between(to_vector(cell->center()), p) < nearest)
          {
            nearest = distance_between(to_vector(cell->center()), p);
            result = other;
          }
      }
      return distance_between(model.points[node], p) < same ? node : result;
    }
  } // namespace

  unsigned int node_at(const SolidModel &model, const std::string &what, const Vector3 &p)
  {
    const unsigned int                   node = nearest_node(model, p);
    std::vector<types::global_dof_index> dofs(model.grid->fe.n_dofs_per_cell());
    double                               element = 0.; // largest extent of its elements [m]
    for (const auto &cell : model.grid->dof_handler.active_cell_iterators())
    {
      cell->get_dof_indices(dofs);
      if (std::find(dofs.begin(), dofs.end(), node) != dofs.end())
        for (const auto other : dofs)
          element = std::max(element, distance_between(model.points[node], model.points[other]));
    }
    if (const double far = distance_between(model.points[node], p); far > element)
    {
      std::ostringstream message;
      message << what << " at " << place(p) << " is " << far << " m from the dam, more than an element ("
              << element << " m). Its nearest node is at " << place(model.points[node])
              << ". Use a point of the dam, in the axes of the input file.";
      throw InputError(message.str());
    }
    return on_side_of(model, node, p);
  }
} // namespace Voussoir
