// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/rock/zone_forces.h>

#include <algorithm>

namespace Voussoir
{
  namespace
  {
    /** Returns the cells of the zone that touch the section. */
    HexMesh strip_of(const WideSection &wide)
    {
      HexMesh strip;
      strip.nodes = wide.mesh.nodes;
      for (std::size_t k = wide.n_cells; k < wide.mesh.cells.size(); ++k)
      {
        const auto &nodes = wide.mesh.cells[k].nodes;
        if (std::any_of(nodes.begin(), nodes.end(), [&](const unsigned int i) { return i < wide.n_nodes; }))
          strip.cells.push_back(wide.mesh.cells[k]);
      }
      return strip;
    }
  } // namespace

  ZoneForces::ZoneForces(const WideSection &wide, const RockModel &model, const RockModel &section,
                         const unsigned int direction, const RockRegionParameters &parameters,
                         const IncidentWave &wave, const unsigned int n_steps)
      : field(section, parameters.damping, parameters.dt, n_steps, wave, parameters.incidence),
        dt(parameters.dt), stiffness_damping(parameters.damping.stiffness), n_nodes(model.points.size())
  {
    std::vector<unsigned int> line_of(section.points.size(), no_node);
    for (unsigned int k = 0; k < section.lines.size(); ++k)
      line_of[section.lines[k].nodes[0]] = k;
    const HexMesh  mesh = strip_of(wide);
    RockParameters rock = parameters.rock;
    rock.nodal_everywhere = true;
    const RockModel model_of_strip = make_rock_model(mesh, rock, tie_layer(mesh, direction));
    strip = std::make_unique<RockOperator>(make_operator(model_of_strip));
    node.assign(model_of_strip.points.size(), no_node);
    is_inside.resize(node.size());
    std::vector<unsigned int> line(node.size());
    std::vector<bool>         is_below(node.size());
    for (unsigned int i = 0; i < mesh.nodes.size(); ++i)
      if (const unsigned int k = model_of_strip.node[i]; k != no_node)
      {
        node[k] = model.node[i];
        is_inside[k] = i < wide.n_nodes;
        line[k] = line_of[section.node[wide.root[i]]];
        is_below[k] = wide.is_below[i];
      }
    for (unsigned int k = 0; k < node.size(); ++k)
      field.add_end_of_line(section, line[k], model_of_strip.points[k], is_below[k]);
    field.evaluate(before);
  }

  void ZoneForces::end_step(Unknowns &force)
  {
    field.end_step();
    Unknowns now;
    field.evaluate(now);
    const std::size_t n = now.size();
    Unknowns          inside(n), outside(n), from_inside(n), from_outside(n);
    for (std::size_t k = 0; k < n; ++k)
      (is_inside[k / 3] ? inside : outside)[k] = now[k] + stiffness_damping * (now[k] - before[k]) / dt;
    before.swap(now);
    strip->multiply(inside.data(), from_inside.data());
    strip->multiply(outside.data(), from_outside.data());
    force.resize(3 * n_nodes);
    for (std::size_t k = 0; k < n; ++k)
      force[3 * std::size_t(node[k / 3]) + k % 3] = is_inside[k / 3] ? -from_outside[k] : from_inside[k];
  }

  std::vector<std::vector<double> *> ZoneForces::state()
  {
    auto arrays = field.state();
    arrays.push_back(&before);
    return arrays;
  }

  StraightSection::StraightSection(std::unique_ptr<ExplicitRegion> given, std::unique_ptr<ZoneForces> acting)
      : region(std::move(given)), forces(std::move(acting))
  {
  }

  void StraightSection::begin_step(std::vector<Ranks::Message> &messages)
  {
    forces->begin_step(messages);
    region->begin_step({}, {}, messages);
  }

  void StraightSection::end_step()
  {
    forces->end_step(region->force);
    region->end_step({});
  }

  Vector3 StraightSection::displacement(const unsigned int node, double) const
  {
    const double *u = region->displacement().data() + 3 * std::size_t(node);
    return {{u[0], u[1], u[2]}};
  }

  std::vector<std::vector<double> *> StraightSection::state()
  {
    auto arrays = forces->state();
    for (auto *array : region->state())
      arrays.push_back(array);
    return arrays;
  }
} // namespace Voussoir
