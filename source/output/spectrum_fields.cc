// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/dam/tractions.h>
#include <voussoir/output/spectrum_fields.h>

#include <cmath>

namespace Voussoir
{
  namespace
  {
    /** Returns n . sigma . n for a unit vector n. */
    double normal_stress(const Stress &s, const Vector3 &n)
    {
      return s[0] * n[0] * n[0] + s[1] * n[1] * n[1] + s[2] * n[2] * n[2] +
             2. * (s[3] * n[0] * n[1] + s[4] * n[1] * n[2] + s[5] * n[2] * n[0]);
    }

    /** Returns the stresses of all parts, per node of the model. */
    std::vector<std::vector<Stress>> stresses_of(const Dam &dam, const SpectrumResponse &response)
    {
      const Scene &scene = dam.scene;
      const bool   known = scene.output.knows_tractions();
      Tractions    tractions(
             *dam.model, dam.structure, [](int, double, const Vector3 &) { return Vector3{}; }, {}, {},
          dam.facts.added_mass > 0. ? added_mass_per_area(*dam.model, scene.reservoir)
                                       : std::vector<double>());
      const StressRecovery             recovery(*dam.model, dam.materials, scene.elements.incompatible_modes,
                                    known ? tractions.faces : std::vector<NodeFace>(), known);
      std::vector<std::vector<Stress>> result;
      for (const SpectrumResponse::Part &part : response.parts())
      {
        result.emplace_back();
        recovery.apply(part.displacement,
                       known ? tractions.at({}, part.acceleration) : std::vector<Vector3>(), result.back());
      }
      return result;
    }

    /** Returns the combined maximum of a function of the stress at a node. */
    template <class Function>
    double combine_at(const SpectrumResponse &response, const std::vector<std::vector<Stress>> &stress,
                      const unsigned int node, const Function &function)
    {
      std::vector<double> of_parts;
      for (const std::vector<Stress> &of_part : stress)
        of_parts.push_back(function(of_part[node]));
      return response.combine(of_parts);
    }
  } // namespace

  SpectrumFields spectrum_fields(const Dam &dam, const SpectrumResponse &response)
  {
    const std::size_t   n = dam.model->n_nodes();
    SpectrumFields      fields;
    std::vector<double> of_parts(response.parts().size());
    for (std::size_t i = 0; i < 3 * dam.structure.n_nodes(); ++i)
    {
      for (std::size_t k = 0; k < of_parts.size(); ++k)
        of_parts[k] = response.parts()[k].displacement[i];
      fields.displacement.push_back(response.combine(of_parts));
    }
    const auto stress = stresses_of(dam, response);
    fields.stress.resize(n);
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int c = 0; c < 6; ++c)
        fields.stress[i][c] = combine_at(response, stress, i, [c](const Stress &s) { return double(s[c]); });
    fields.arch.assign(n, 0.f);
    fields.cantilever.assign(n, 0.f);
    for (const NodeFace &face : faces_at_nodes(*dam.model))
    {
      const Vector3 &m = face.normal;
      const double   horizontal = std::hypot(m[0], m[1]);
      if ((face.surface != PhysicalId::upstream && face.surface != PhysicalId::downstream) ||
          horizontal < 1e-6)
        continue;
      const Vector3 arch{{-m[1] / horizontal, m[0] / horizontal, 0.}};
      const Vector3 up{{-m[2] * arch[1], m[2] * arch[0], m[0] * arch[1] - m[1] * arch[0]}}; // normal x arch
      fields.arch[face.node] =
          combine_at(response, stress, face.node, [&](const Stress &s) { return normal_stress(s, arch); });
      fields.cantilever[face.node] =
          combine_at(response, stress, face.node, [&](const Stress &s) { return normal_stress(s, up); });
    }
    return fields;
  }
} // namespace Voussoir
