// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/dam/tractions.h>
#include <voussoir/output/face_stresses.h>
#include <voussoir/output/spectrum_fields.h>

namespace Voussoir
{
  namespace
  {
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
      if (face.surface == PhysicalId::upstream || face.surface == PhysicalId::downstream)
        for (const unsigned int k : {0, 1})
          (k == 0 ? fields.arch : fields.cantilever)[face.node] =
              combine_at(response, stress, face.node,
                         [at = directions_at(face), k](const Stress &s) { return at.stresses(s)[k]; });
    return fields;
  }
} // namespace Voussoir
