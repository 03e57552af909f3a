// SPDX-License-Identifier: GPL-3.0-or-later
#include <deal.II/numerics/rtree.h>

#include <voussoir/base/error.h>
#include <voussoir/dam/face_distance.h>
#include <voussoir/solid/solid_grid.h>
#include <voussoir/solid/solid_model.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace Voussoir
{
  using namespace dealii;

  namespace
  {
    double distance_to_segment(const Point<3> &p, const Point<3> &a, const Point<3> &b)
    {
      const Tensor<1, 3> edge = b - a;
      const double       length = edge.norm_square();
      const double       t = length > 0. ? std::clamp((p - a) * edge / length, 0., 1.) : 0.;
      return p.distance(a + t * edge);
    }

    double distance_to_triangle(const Point<3> &p, const std::array<Point<3>, 3> &t)
    {
      const Tensor<1, 3> normal = cross_product_3d(t[1] - t[0], t[2] - t[0]);
      const double       area = normal.norm();
      bool               above = area > 0.; // true: the projection of p is in the triangle
      double             nearest = std::numeric_limits<double>::infinity();
      for (unsigned int k = 0; k < 3; ++k)
      {
        const Point<3> &a = t[k], &b = t[(k + 1) % 3];
        above = above && cross_product_3d(b - a, p - a) * normal >= 0.;
        nearest = std::min(nearest, distance_to_segment(p, a, b));
      }
      return above ? std::abs((p - t[0]) * normal) / area : nearest;
    }

    /** Distance of points to a surface of the model, or to its edge at the base. */
    class SurfaceDistance
    {
    public:
      SurfaceDistance(const SolidModel &model, const int surface, const bool at_base)
      {
        const auto is_at_base = [&](const auto &line, const unsigned int end)
        { return model.is_at_base(line->vertex_dof_index(end, 0)); };
        for (const auto &cell : model.grid->dof_handler.active_cell_iterators())
          for (const unsigned int f : cell->face_indices())
            if (cell->face(f)->at_boundary() && static_cast<int>(cell->face(f)->boundary_id()) == surface)
            {
              const auto face = cell->face(f);
              if (at_base)
              {
                for (unsigned int k = 0; k < 4; ++k)
                  if (const auto line = face->line(k); is_at_base(line, 0) && is_at_base(line, 1))
                    triangles.push_back({{line->vertex(0), line->vertex(1), line->vertex(1)}});
                continue;
              }
              const Point<3>                middle = face->center();
              const std::array<Point<3>, 4> corner = {
                  {face->vertex(0), face->vertex(1), face->vertex(3), face->vertex(2)}};
              for (unsigned int k = 0; k < 4; ++k)
                triangles.push_back({{corner[k], corner[(k + 1) % 4], middle}});
            }
        std::vector<Entry> entries;
        for (unsigned int i = 0; i < triangles.size(); ++i)
        {
          BoundingBox<3> box(std::make_pair(triangles[i][0], triangles[i][0]));
          for (const Point<3> &corner : triangles[i])
            box.merge_with(BoundingBox<3>(std::make_pair(corner, corner)));
          entries.emplace_back(box, i);
        }
        tree = pack_rtree(entries);
      }

      bool is_empty() const { return triangles.empty(); }

      double to(const Point<3> &p) const
      {
        double nearest = std::numeric_limits<double>::infinity();
        for (auto found = tree.qbegin(boost::geometry::index::nearest(p, triangles.size()));
             found != tree.qend(); ++found) // in the order of the distances of the boxes
        {
          if (boost::geometry::distance(p, found->first) >= nearest)
            break;
          nearest = std::min(nearest, distance_to_triangle(p, triangles[found->second]));
        }
        return nearest;
      }

    private:
      using Entry = std::pair<BoundingBox<3>, unsigned int>;
      std::vector<std::array<Point<3>, 3>> triangles;
      RTree<Entry>                         tree;
    };
  } // namespace

  std::vector<double> places_in_thickness(const SolidModel &model, const std::string &entry,
                                          const bool at_base)
  {
    const SurfaceDistance upstream(model, PhysicalId::upstream, at_base),
        downstream(model, PhysicalId::downstream, at_base);
    if (upstream.is_empty() || downstream.is_empty())
      throw InputError("Entry \"" + entry + "\" requires the thickness of the dam, but the surface \"" +
                       (upstream.is_empty() ? "upstream" : "downstream") + "\" of the mesh is missing" +
                       (at_base ? ", or does not reach the base" : "") + ". Mark it in the mesh.");
    std::vector<double> place(model.n_nodes());
    for (unsigned int i = 0; i < model.n_nodes(); ++i)
    {
      if (at_base && !model.is_at_base(i))
        continue;
      const double a = upstream.to(to_point(model.points[i])), b = downstream.to(to_point(model.points[i]));
      place[i] = a + b > 0. ? a / (a + b) : .5;
    }
    return place;
  }
} // namespace Voussoir
