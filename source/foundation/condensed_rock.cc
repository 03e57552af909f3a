// SPDX-License-Identifier: GPL-3.0-or-later
#include <deal.II/base/exceptions.h>
#include <deal.II/lac/lapack_full_matrix.h>

#include <voussoir/base/error.h>
#include <voussoir/base/ranks.h>
#include <voussoir/foundation/condensed_rock.h>
#include <voussoir/joints/body_factor.h>

#include <numeric>

namespace Voussoir
{
  namespace
  {
    /** Returns the mesh of the rock as one body, with its artificial boundary as fixed base. */
    HexMesh rock_only(const HexMesh &mesh)
    {
      HexMesh result = mesh;
      result.cells.clear();
      result.faces.clear();
      for (HexMesh::Cell cell : mesh.cells)
        if (!is_monolith(cell.volume))
        {
          cell.volume = 1;
          result.cells.push_back(cell);
        }
      for (HexMesh::Face face : mesh.faces)
        if (face.surface == PhysicalId::artificial)
        {
          face.surface = PhysicalId::base;
          result.faces.push_back(face);
        }
      normalize(result); // removes the nodes of the dam
      return result;
    }

    /** Returns the symmetric part of the dense matrix @p S in blocks. */
    BlockSparseMatrix in_blocks(const std::vector<double> &S, const unsigned int n)
    {
      std::vector<unsigned int> all(n);
      std::iota(all.begin(), all.end(), 0);
      BlockSparseMatrix result(std::vector<std::vector<unsigned int>>(n, all));
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = 0; j < n; ++j)
          for (unsigned int c = 0; c < 3; ++c)
            for (unsigned int d = 0; d < 3; ++d)
              result.value[std::size_t(i) * n + j][3 * c + d] =
                  .5 * (S[(3 * std::size_t(i) + c) * 3 * n + 3 * j + d] +
                        S[(3 * std::size_t(j) + d) * 3 * n + 3 * i + c]);
      return result;
    }

    /** Returns the stiffness matrix of the rock, condensed to the base nodes. */
    std::vector<double> condensed_stiffness(Structure &ground, const std::vector<BaseNode> &base_nodes,
                                            const std::string &source)
    {
      Body &body = ground.bodies[0];
      for (const BaseNode &base_node : base_nodes) // ascending
        body.interface.push_back(base_node.rock);
      try
      {
        BodyFactor factor(ground, body, StepOperator());
        factor.analyse(BodyFactor::Order::interface_last);
        factor.factorise();
        return factor.condensed_stiffness();
      }
      catch (const FactorTooLarge &)
      {
        throw ComputationError("mesh " + source + ": the rock has " + std::to_string(3 * ground.n_nodes()) +
                               " unknowns, too many for \"Foundation/Model\" = massless. Use fewer rock "
                               "elements, or \"Foundation/Model\" = rock.");
      }
      catch (const ComputationError &)
      {
        throw ComputationError(
            "mesh " + source +
            ": the stiffness matrix of the rock is not positive definite, or the rock is not in one piece. "
            "Connect all parts of the rock to each other and to the surface \"artificial boundary\", and "
            "improve distorted rock elements (`voussoir mesh` prints their quality; generated rock: \"Rock/Element size\").");
      }
    }
  } // namespace

  CondensedRock condense_rock(const FoundationParameters &parameters, const HexMesh &mesh,
                              const SolidModel &dam, const bool incompatible_modes, const std::string &source)
  {
    SolidModel                         rock(rock_only(mesh), dam.degree);
    std::vector<std::array<double, 3>> points(rock.first_equation.back());
    if (points.size() == rock.n_nodes())
      throw InputError("mesh " + source + ": no face of the rock lies on the artificial boundary (surface " +
                       std::to_string(PhysicalId::artificial) +
                       "). Massless rock is fixed there. Add the surface to the mesh.");
    rock.plane_strain = dam.plane_strain;
    for (unsigned int i = 0; i < rock.n_nodes(); ++i)
      if (rock.equation[i] != rigid_ground)
        points[rock.equation[i]] = {{rock.points[i][0], rock.points[i][1], rock.points[i][2]}};
    CondensedRock result;
    result.base_nodes = find_base_nodes(dam, points, source);
    result.stiffness.resize(std::size_t(result.n()) * result.n());
    Ranks::on_first(
        [&]
        {
          Structure ground =
              assemble_structure(rock, materials_of(mesh.zones, parameters.rock, parameters.zone_materials()),
                                 incompatible_modes);
          result.stiffness = condensed_stiffness(ground, result.base_nodes, source);
        });
    Ranks::broadcast(result.stiffness.data(), result.stiffness.size(), 0);
    return result;
  }

  BlockSparseMatrix CondensedRock::matrix() const
  {
    return in_blocks(stiffness, base_nodes.size());
  }

  BlockSparseMatrix CondensedRock::compliance(const std::vector<double> &springs) const
  {
    dealii::LAPACKFullMatrix<double> A(n());
    for (unsigned int i = 0; i < n(); ++i)
      for (unsigned int j = 0; j < n(); ++j)
        A(i, j) = stiffness[std::size_t(j) * n() + i] - (i == j ? springs[i / 3] : 0.);
    A.set_property(dealii::LAPACKSupport::symmetric);
    try
    {
      A.compute_cholesky_factorization();
      A.invert();
    }
    catch (const dealii::ExceptionBase &)
    {
      throw ComputationError(
          "The massless rock does not support the dam: its stiffness at the " +
          std::to_string(base_nodes.size()) +
          " base nodes is not positive definite. Improve distorted rock elements below the dam (`voussoir "
          "mesh` prints their quality; generated rock: \"Rock/Element size\").");
    }
    std::vector<double> C(std::size_t(n()) * n());
    for (unsigned int i = 0; i < n(); ++i)
      for (unsigned int j = 0; j < n(); ++j)
        C[std::size_t(j) * n() + i] = A(i, j);
    return in_blocks(C, base_nodes.size());
  }
} // namespace Voussoir
