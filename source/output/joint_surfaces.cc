// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/error.h>
#include <voussoir/base/output_file.h>
#include <voussoir/joints/pairs.h>
#include <voussoir/output/joint_surfaces.h>
#include <voussoir/output/vtu_flags.h>
#include <voussoir/solid/face_quads.h>

namespace Voussoir
{
  using namespace dealii;

  namespace
  {
    const std::vector<std::string> names = {
        "joint", "displacement", "displacement", "displacement", "opening",      "slip",       "slip",
        "slip",  "pressure",     "shear_stress", "shear_stress", "shear_stress", "joint_state"};

    /** Returns the values of a pair, in the order of @p names. */
    std::vector<double> values_of(const unsigned int p, const Structure &structure,
                                  const Integrator &integrator, const PairState state)
    {
      const Pair         &pair = structure.pairs[p];
      const Vector3       moved = integrator.opening_and_slip(p);
      const Unknowns     &u = integrator.state().u, &force = integrator.state().force;
      std::vector<double> values = {double(pair.joint + 1)};
      for (unsigned int c = 0; c < 3; ++c)
        values.push_back(pair.node_1 == rigid_ground ? 0. : u[3 * pair.node_1 + c]);
      values.push_back(moved[0]);
      for (unsigned int c = 0; c < 3; ++c)
        values.push_back(moved[1] * pair.frame[1][c] + moved[2] * pair.frame[2][c]);
      values.push_back(force[3 * p] / pair.area);
      for (unsigned int c = 0; c < 3; ++c)
        values.push_back((force[3 * p + 1] * pair.frame[1][c] + force[3 * p + 2] * pair.frame[2][c]) /
                         pair.area);
      values.push_back(static_cast<double>(state));
      return values;
    }
  } // namespace

  void write_joint_surfaces(const std::string &file, const SolidModel &model, const Structure &structure,
                            const Integrator &integrator, const std::vector<PairState> &states)
  {
    const PairsByNode                     pair_of = pairs_by_node(structure.pairs);
    std::vector<DataOutBase::Patch<2, 3>> patches;
    for (unsigned int j = 0; j < structure.n_joints; ++j)
      for (const FaceQuad &quad : quads_of_joint(model, j))
      {
        DataOutBase::Patch<2, 3> patch;
        patch.reference_cell = ReferenceCells::Quadrilateral;
        patch.data.reinit(names.size(), 4);
        patch.patch_index = patches.size();
        for (unsigned int k = 0; k < 4; ++k)
        {
          const unsigned int node = quad.nodes[k < 2 ? k : 5 - k]; // lexicographic order
          const auto         found = pair_of.find({j, model.equation[node]});
          patch.vertices[k] =
              dealii::Point<3>(model.points[node][0], model.points[node][1], model.points[node][2]);
          if (found == pair_of.end()) // fixed base node
          {
            patch.data(0, k) = j + 1.;
            patch.data(names.size() - 1, k) = -1.;
            continue;
          }
          const auto values = values_of(found->second, structure, integrator, states[found->second]);
          for (std::size_t i = 0; i < values.size(); ++i)
            patch.data(i, k) = values[i];
        }
        patches.push_back(patch);
      }
    OutputFile out(file);
    using Range = std::tuple<unsigned int, unsigned int, std::string,
                             DataComponentInterpretation::DataComponentInterpretation>;
    constexpr auto           vector = DataComponentInterpretation::component_is_part_of_vector;
    const std::vector<Range> vectors = {
        {1, 3, "displacement", vector}, {5, 7, "slip", vector}, {9, 11, "shear_stress", vector}};
    try
    {
      DataOutBase::write_vtu(patches, names, vectors, vtu_flags(), out);
    }
    catch (const ExceptionBase &) // thrown by deal.II
    {
      throw WriteError::of(file);
    }
    out.check();
  }
} // namespace Voussoir
