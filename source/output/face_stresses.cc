// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/ranks.h>
#include <voussoir/output/face_stresses.h>
#include <voussoir/solid/for_faces.h>

#include <algorithm>
#include <map>
#include <numeric>

namespace Voussoir
{
  namespace
  {
    Vector3 unit(const Vector3 &x)
    {
      return scaled(1. / norm(x), x);
    }

    /** Returns the factors of xx yy zz xy yz zx in t . sigma t. @p t: unit vector. */
    Stress factors(const Vector3 &t)
    {
      const double all[6] = {t[0] * t[0],      t[1] * t[1],      t[2] * t[2],
                             2. * t[0] * t[1], 2. * t[1] * t[2], 2. * t[2] * t[0]};
      Stress       result;
      std::copy(std::begin(all), std::end(all), result.begin());
      return result;
    }
  } // namespace

  NodeOnFace directions_at(const NodeFace &face)
  {
    const Vector3 &n = face.normal;
    // z x n; a face is horizontal if its slope is below 1e-6.
    const Vector3 arch = length(n[0], n[1]) > 1e-6 ? unit({{-n[1], n[0], 0.}}) : Vector3{{0., 1., 0.}};
    return {face.node, face.surface, factors(arch), factors(cross(n, arch))};
  }

  const char *FaceDirections::name(const unsigned int k)
  {
    constexpr const char *names[n_stresses] = {"arch", "cantilever", "vertical"};
    return names[k];
  }

  FaceDirections::FaceDirections(const SolidModel &model)
  {
    for (const int surface : {PhysicalId::upstream, PhysicalId::downstream})
    {
      std::map<unsigned int, Vector3> area;
      for_faces(model, surface, model.degree + 1,
                [&](const auto &values, const auto &dofs)
                {
                  for (const unsigned int q : values.quadrature_point_indices())
                    for (unsigned int i = 0; i < dofs.size(); ++i)
                      if (const double part = values.shape_value(i, q) * values.JxW(q); part != 0.)
                        for (unsigned int c = 0; c < 3; ++c)
                          area[dofs[i]][c] += part * values.normal_vector(q)[c];
                });
      for (const auto &[node, sum] : area)
        if (model.on_surface(node, surface))
          nodes.push_back(directions_at({node, surface, unit(sum)}));
    }
    std::stable_sort(nodes.begin(), nodes.end(),
                     [](const NodeOnFace &a, const NodeOnFace &b) { return a.node < b.node; });
    first.assign(model.n_nodes() + 1, 0);
    for (const NodeOnFace &at : nodes)
      ++first[at.node + 1];
    std::partial_sum(first.begin(), first.end(), first.begin());
  }

  FaceEnvelope::FaceEnvelope(const SolidModel &model)
      : directions(model), extremes(n_extremes * directions.nodes.size()), times(extremes.size(), 0.f)
  {
    for (std::size_t e = 0; e < extremes.size(); ++e)
      extremes[e] = e % 2 == 0 ? -1e30f : 1e30f;
  }

  void FaceEnvelope::record(const std::size_t node, const double time, const Stress &stress)
  {
    if (directions.nodes.empty())
      return;
    for (std::size_t i = directions.first[node]; i < directions.first[node + 1]; ++i)
    {
      const auto now = directions.nodes[i].stresses(stress);
      for (unsigned int k = 0; k < FaceDirections::n_stresses; ++k)
      {
        if (const std::size_t e = index(i, k, true); now[k] > extremes[e])
          extremes[e] = now[k], times[e] = static_cast<float>(time);
        if (const std::size_t e = index(i, k, false); now[k] < extremes[e])
          extremes[e] = now[k], times[e] = static_cast<float>(time);
      }
    }
  }

  void FaceEnvelope::show(StressView &view) const
  {
    view.on_face = directions.nodes.data();
    view.first_on_face = directions.nodes.empty() ? nullptr : directions.first.data();
    view.of_faces = extremes.data();
  }

  void FaceEnvelope::take(const std::vector<float> &all_extremes, const std::vector<float> &all_times,
                          const std::size_t n_columns, const std::size_t column)
  {
    for (std::size_t e = 0; e < extremes.size(); ++e)
    {
      extremes[e] = all_extremes[n_columns * e + column];
      times[e] = all_times[n_columns * e + column];
    }
  }

  void FaceEnvelope::gather(std::vector<std::size_t> begin)
  {
    for (std::size_t &i : begin)
      i = directions.nodes.empty() ? 0 : n_extremes * directions.first[i];
    Ranks::gather(extremes.data(), begin);
    Ranks::gather(times.data(), begin);
  }

  std::vector<float> FaceEnvelope::field(const std::size_t n_nodes, const unsigned int k,
                                         const bool largest) const
  {
    std::vector<float> result(n_nodes, 0.f);
    for (std::size_t i = 0; i < directions.nodes.size(); ++i)
      result[directions.nodes[i].node] = extremes[index(i, k, largest)];
    return result;
  }

  std::string FaceEnvelope::name(const unsigned int k, const bool largest)
  {
    return std::string(FaceDirections::name(k)) + "_stress_" + (largest ? "max" : "min");
  }
} // namespace Voussoir
