// SPDX-License-Identifier: GPL-3.0-or-later
#include <deal.II/fe/mapping_q1.h>

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

  namespace
  {
    /** Returns the nodes on the common edge of the crest and the upstream face, or without such an edge the highest
     * nodes, those with the least x if they are on an edge. */
    std::vector<unsigned int> upper_edge(const SolidModel &model, bool &is_crest)
    {
      std::vector<unsigned int> nodes, highest, first;
      double                    top = -1e300, bottom = 1e300, least = 1e300;
      for (unsigned int i = 0; i < model.n_nodes(); ++i)
      {
        if (model.on_surface(i, PhysicalId::crest) && model.on_surface(i, PhysicalId::upstream))
          nodes.push_back(i);
        top = std::max(top, model.points[i][2]);
        bottom = std::min(bottom, model.points[i][2]);
      }
      is_crest = !nodes.empty();
      if (is_crest)
        return nodes;
      const double same = 1e-6 * (top - bottom);
      for (unsigned int i = 0; i < model.n_nodes(); ++i)
        if (model.points[i][2] > top - same)
        {
          highest.push_back(i);
          least = std::min(least, model.points[i][0]);
        }
      for (const unsigned int i : highest)
        if (model.points[i][0] < least + same)
          first.push_back(i);
      return first.size() > 1 ? first : highest;
    }
  } // namespace

  DamGeometry::DamGeometry(const SolidModel &model, const std::vector<Pair> &pairs,
                           const unsigned int n_joints, const std::string &source)
      : joints(n_joints)
  {
    std::vector<unsigned int> nodes = upper_edge(model, has_crest);
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
        const Vector3 d = best == rigid_ground ? Vector3{} : pairs[p].place - pairs[best].place;
        if (best == rigid_ground || d[2] > tall ||
            (d[2] > -tall && (std::abs(d[0]) > tall ? (d[0] < 0.) == upstream : d[1] < 0.)))
          best = p; // of pairs at equal places in height and along the river, the one at the right bank
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

  Vector3 PlaceInDam::interpolated(const std::function<Vector3(unsigned int)> &at_node) const
  {
    if (parts.size() == 1)
      return at_node(parts[0].first);
    Vector3 sum{};
    for (const auto &[node, part] : parts)
    {
      const Vector3 value = at_node(node);
      for (unsigned int c = 0; c < 3; ++c)
        sum[c] += part * value[c];
    }
    return sum;
  }

  namespace
  {
    constexpr double same_place = 1e-6; ///< tolerance for equal positions [m]

    /** Returns the point of a cell next to @p p. A node there has the whole part. */
    PlaceInDam place_in(const SolidModel &model, const DoFHandler<3>::active_cell_iterator &cell,
                        const Vector3 &p)
    {
      const auto                          &mapping = StaticMappingQ1<3>::mapping;
      std::vector<types::global_dof_index> dofs(model.grid->fe.n_dofs_per_cell());
      cell->get_dof_indices(dofs);
      PlaceInDam result{p, static_cast<int>(cell->material_id()), {}};
      for (const unsigned int node : dofs)
        if (distance_between(model.points[node], p) < same_place)
        {
          result.parts = {{node, 1.}};
          return result;
        }
      Point<3> unit;
      try
      {
        unit = mapping.transform_real_to_unit_cell(cell, to_point(p));
      }
      catch (const Mapping<3>::ExcTransformationFailed &) // far outside
      {
        unit = cell->real_to_unit_cell_affine_approximation(to_point(p));
      }
      unit = GeometryInfo<3>::project_to_unit_cell(unit);
      result.point = to_vector(mapping.transform_unit_to_real_cell(cell, unit));
      for (unsigned int i = 0; i < dofs.size(); ++i)
        if (const double part = model.grid->fe.shape_value(i, unit); std::abs(part) > 1e-12)
          result.parts.emplace_back(dofs[i], part);
      return result;
    }
  } // namespace

  std::vector<PlaceInDam> places_at(const SolidModel &model, const std::string &what, const Vector3 &p)
  {
    std::map<int, PlaceInDam> of_block; // the nearest of each block
    PlaceInDam                nearest;
    double                    far = std::numeric_limits<double>::infinity(), element = 0.;
    for (const auto &cell : model.grid->dof_handler.active_cell_iterators())
    {
      if (distance_between(to_vector(cell->center()), p) - cell->diameter() > far + same_place)
        continue;
      const PlaceInDam now = place_in(model, cell, p);
      const double     distance = distance_between(now.point, p);
      if (distance < far)
      {
        nearest = now;
        far = distance;
        element = cell->diameter();
      }
      if (const auto [found, is_new] = of_block.emplace(now.block, now);
          !is_new && distance < distance_between(found->second.point, p))
        found->second = now;
    }
    if (far > element)
    {
      std::ostringstream message;
      message << what << " at " << place(p) << " is " << far << " m from the dam, more than an element ("
              << element << " m). The nearest point of the dam is " << place(nearest.point)
              << ". Use a point of the dam, in the axes of the input file.";
      throw InputError(message.str());
    }
    std::vector<PlaceInDam> result;
    for (const auto &one : of_block)
      if (distance_between(one.second.point, p) <= far + same_place)
        result.push_back(one.second);
    return result;
  }

  PlaceInDam probe_place(const SolidModel &model, const std::string &name, const Vector3 &p)
  {
    return places_at(model, "Entry \"Output/Probes\": probe \"" + name + "\"", p).front();
  }
} // namespace Voussoir
