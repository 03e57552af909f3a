// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/dam/base_part.h>
#include <voussoir/solid/for_faces.h>

namespace Voussoir
{
  using namespace dealii;

  BasePart base_part(const SolidModel &model, const std::function<bool(const Vector3 &)> &contains)
  {
    BasePart            part;
    std::vector<double> whole(model.n_nodes(), 0.);
    part.contains = contains;
    for_faces(model, PhysicalId::base, model.degree + 1,
              [&](const FEFaceValues<3> &values, const auto &dofs)
              {
                Vector3 moment{};
                double  area = 0.;
                for (const unsigned int q : values.quadrature_point_indices())
                {
                  area += values.JxW(q);
                  for (unsigned int c = 0; c < 3; ++c)
                    moment[c] += values.quadrature_point(q)[c] * values.JxW(q);
                }
                const bool inside = contains({{moment[0] / area, moment[1] / area, moment[2] / area}});
                if (inside)
                {
                  ++part.n_faces;
                  part.area += area;
                  add(part.centroid, moment);
                }
                for (unsigned int i = 0; i < dofs.size(); ++i)
                {
                  if (!model.on_surface(dofs[i], PhysicalId::base))
                    continue;
                  double at_node = 0.;
                  for (const unsigned int q : values.quadrature_point_indices())
                    at_node += values.shape_value(i, q) * values.JxW(q);
                  whole[dofs[i]] += at_node;
                  if (inside)
                    part.area_of_node[dofs[i]] += at_node;
                }
              });
    for (double &x : part.centroid)
      x /= part.area;
    for (unsigned int i = 0; i < model.n_nodes(); ++i)
    {
      const auto &p = model.points[i];
      if (whole[i] > 0.)
      {
        const auto found = part.area_of_node.find(i);
        part.share.push_back(found == part.area_of_node.end() ? 0. : found->second / whole[i]);
      }
      else
        part.share.push_back(contains({{p[0], p[1], p[2]}}) ? 1. : 0.);
    }
    return part;
  }
} // namespace Voussoir
