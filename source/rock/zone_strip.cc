// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/rock/zone_strip.h>

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

    RockModel model_of_strip(const HexMesh &mesh, RockParameters rock, const unsigned int direction)
    {
      rock.nodal_everywhere = true;
      return make_rock_model(mesh, rock, tie_layer(mesh, direction));
    }
  } // namespace

  ZoneStrip::ZoneStrip(const WideSection &wide, const RockModel &of_wide, const RockModel &section,
                       const unsigned int direction, const RockRegionParameters &parameters,
                       const IncidentWave &wave, const unsigned int n_steps)
      : field(section, parameters.damping, parameters.dt, n_steps, wave, parameters.incidence),
        mesh(strip_of(wide)), model(model_of_strip(mesh, parameters.rock, direction)),
        stiffness(make_operator(model)), node(model.points.size(), no_node), is_inside(node.size()),
        n_nodes(of_wide.points.size())
  {
    std::vector<unsigned int> line_of(section.points.size(), no_node), line(node.size());
    for (unsigned int k = 0; k < section.lines.size(); ++k)
      line_of[section.lines[k].nodes[0]] = k;
    std::vector<bool> is_below(node.size());
    for (unsigned int i = 0; i < mesh.nodes.size(); ++i)
      if (const unsigned int k = model.node[i]; k != no_node)
      {
        node[k] = of_wide.node[i];
        is_inside[k] = i < wide.n_nodes;
        line[k] = line_of[section.node[wide.root[i]]];
        is_below[k] = wide.is_below[i];
      }
    for (unsigned int k = 0; k < node.size(); ++k)
    {
      Vector3 place = model.points[k];
      place[direction] = parameters.incidence.centre[direction];
      field.add_end_of_line(section, line[k], place, is_below[k]);
    }
  }

  void ZoneStrip::separate(const Unknowns &values, Unknowns &inside, Unknowns &outside) const
  {
    inside.assign(values.size(), 0.);
    outside = inside;
    for (std::size_t k = 0; k < values.size(); ++k)
      (is_inside[k / 3] ? inside : outside)[k] = values[k];
  }

  void ZoneStrip::gather(const Unknowns &f_inside, const Unknowns &f_outside, Unknowns &force) const
  {
    force.resize(3 * n_nodes);
    for (std::size_t k = 0; k < f_inside.size(); ++k)
      force[3 * std::size_t(node[k / 3]) + k % 3] = is_inside[k / 3] ? -f_outside[k] : f_inside[k];
  }
} // namespace Voussoir
