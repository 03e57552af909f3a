// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/error.h>
#include <voussoir/dam/dam_geometry.h>
#include <voussoir/dam/nodal_forces.h>
#include <voussoir/solid/solid_grid.h>
#include <voussoir/solid/solid_model.h>

#include <map>
#include <set>

namespace Voussoir
{
  using namespace dealii;

  void add_point_force(const SolidModel &model, const std::string &what, const PointLoad &point,
                       Unknowns &load)
  {
    std::set<std::map<unsigned int, double>> sharing; // parts of the equations, once if blocks are tied there
    bool                                     is_held = true;
    for (const PlaceInDam &place : places_at(model, what, point.place))
    {
      std::map<unsigned int, double> of_block;
      for (const auto &[node, part] : place.parts)
        of_block[model.equation[node]] += part;
      is_held = is_held && of_block.size() == 1 && of_block.count(rigid_ground) > 0;
      sharing.insert(of_block);
    }
    if (is_held)
      throw InputError(what + " is on the fixed base and has no effect. Move it, or remove it.");
    for (const auto &of_block : sharing)
      for (const auto &[e, part] : of_block)
        for (unsigned int c = 0; e != rigid_ground && c < 3; ++c)
          load[3 * std::size_t(e) + c] += part * point.force[c] / sharing.size();
  }

  void add_concentrated(const SolidModel &model, const LoadParameters &loads, Unknowns &load)
  {
    for (const auto &entry : loads.point_loads())
      add_point_force(model, "Entry \"Loads/Concentrated\": load \"" + entry.first + "\"", entry.second,
                      load);
  }

  namespace
  {
    bool on_surface(const DoFHandler<3>::active_cell_iterator &cell, const unsigned int face,
                    const int surface)
    {
      return cell->face(face)->at_boundary() && static_cast<int>(cell->face(face)->boundary_id()) == surface;
    }
  } // namespace

  void add_crest_line(const SolidModel &model, const LoadParameters &loads, Unknowns &load)
  {
    const Vector3 q = loads.line_load();
    const int     side = loads.crest_edge == "upstream" ? PhysicalId::upstream : PhysicalId::downstream;
    unsigned int  n_lines = 0;
    for (const auto &cell : model.grid->dof_handler.active_cell_iterators())
      for (unsigned int line = 0; line < GeometryInfo<3>::lines_per_cell; ++line)
      {
        bool crest = false, edge = false; // is the line an edge of such a face of the cell?
        for (const unsigned int face : cell->face_indices())
          for (unsigned int l = 0; l < GeometryInfo<3>::lines_per_face; ++l)
            if (cell->face(face)->line(l) == cell->line(line))
            {
              crest = crest || on_surface(cell, face, PhysicalId::crest);
              edge = edge || on_surface(cell, face, side);
            }
        if (!crest || !edge)
          continue;
        ++n_lines;
        const double length = cell->line(line)->diameter();
        // Simpson's rule with the midside node, exact for the shape functions of both degrees
        const double ends = model.degree == 1 ? .5 : 1. / 6.;
        const auto   add = [&](const unsigned int node, const double part)
        {
          for (unsigned int c = 0; model.equation[node] != rigid_ground && c < 3; ++c)
            load[3 * std::size_t(model.equation[node]) + c] += part * length * q[c];
        };
        for (unsigned int v = 0; v < 2; ++v)
          add(cell->line(line)->vertex_dof_index(v, 0), ends);
        if (model.degree == 2)
          add(cell->line(line)->dof_index(0), 2. / 3.);
      }
    if (n_lines == 0)
      throw InputError("Entry \"Loads/Crest line\": the surfaces \"crest\" and \"" + loads.crest_edge +
                       "\" of the mesh have no common edge, or are missing. Correct them in the mesh.");
  }
} // namespace Voussoir
