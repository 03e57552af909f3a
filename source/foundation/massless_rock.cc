// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/error.h>
#include <voussoir/foundation/feet.h>
#include <voussoir/foundation/massless_rock.h>
#include <voussoir/joints/body_factor.h>

#include <algorithm>

namespace Voussoir
{
  namespace
  {
    /** The rock alone, one body, its artificial boundary as the fixed base. */
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
      normalize(result); // drops the dam's nodes
      return result;
    }

    /** The matrix with a dense block for the @p nodes added, S by node and component. */
    BlockSparseMatrix with_dense_block(const BlockSparseMatrix &matrix, std::vector<unsigned int> nodes,
                                       const std::vector<double> &S)
    {
      std::vector<unsigned int> sorted = nodes;
      std::sort(sorted.begin(), sorted.end());
      std::vector<std::vector<unsigned int>> columns(matrix.n_rows());
      for (unsigned int row = 0; row < matrix.n_rows(); ++row)
        columns[row].assign(matrix.column.begin() + matrix.start[row],
                            matrix.column.begin() + matrix.start[row + 1]);
      for (const unsigned int row : nodes)
      {
        std::vector<unsigned int> both;
        std::set_union(columns[row].begin(), columns[row].end(), sorted.begin(), sorted.end(),
                       std::back_inserter(both));
        columns[row] = both;
      }
      BlockSparseMatrix result(columns);
      for (unsigned int row = 0; row < matrix.n_rows(); ++row)
        for (std::size_t k = matrix.start[row]; k < matrix.start[row + 1]; ++k)
          result.add(row, matrix.column[k], matrix.value[k]);
      const std::size_t m = 3 * nodes.size();
      for (unsigned int i = 0; i < nodes.size(); ++i)
        for (unsigned int j = 0; j < nodes.size(); ++j)
        {
          Matrix3 block;
          for (unsigned int c = 0; c < 3; ++c)
            for (unsigned int d = 0; d < 3; ++d)
              block[3 * c + d] = S[(3 * i + c) * m + 3 * j + d];
          result.add(nodes[i], nodes[j], block);
        }
      return result;
    }
  } // namespace

  void add_massless_rock(const FoundationParameters &parameters, const HexMesh &mesh, const SolidModel &dam,
                         const bool incompatible_modes, const std::string &source, Structure &structure)
  {
    const SolidModel rock(rock_only(mesh), dam.fe.degree);
    Structure        ground = assemble_structure(
               rock, materials_of(mesh.zones, parameters.rock, parameters.zone_materials()), incompatible_modes);
    if (ground.n_nodes() == rock.n_nodes())
      throw InputError(source + ": no face of the rock lies on the artificial boundary (surface " +
                       std::to_string(PhysicalId::artificial) + "), which holds massless rock.");
    std::vector<std::array<double, 3>> points(ground.n_nodes());
    for (unsigned int i = 0; i < rock.n_nodes(); ++i)
      if (rock.equation[i] != rigid_ground)
        points[rock.equation[i]] = {{rock.points[i][0], rock.points[i][1], rock.points[i][2]}};
    const std::vector<Foot> feet = find_feet(dam, points, source);

    Body &body = ground.bodies[0];
    for (const Foot &foot : feet) // ascending
      body.interface.push_back(foot.rock);
    const std::vector<double> S = [&]
    {
      try
      {
        BodyFactor factor(ground, body, 0., 1., 0.);
        factor.analyse(BodyFactor::Order::interface_last);
        factor.factorise();
        return factor.condensed_stiffness();
      }
      catch (const ComputationError &)
      {
        throw ComputationError(source +
                               ": the stiffness of the rock cannot be factorised: its artificial "
                               "boundary does not hold all of it, its elements are badly shaped, or it is "
                               "too large for this method.");
      }
    }();
    std::vector<unsigned int> nodes;
    for (unsigned int i = 0; i < feet.size(); ++i)
    {
      if (feet[i].nodes.size() != 1)
        throw InputError(source + ": two nodes of one monolith share a place at the dam's base.");
      nodes.push_back(feet[i].nodes[0]);
    }
    BlockSparseMatrix &K = structure.bodies[0].stiffness;
    K = with_dense_block(K, nodes, S);
    K.symmetrise();
  }

  namespace
  {
    class MasslessRock : public Foundation
    {
    public:
      explicit MasslessRock(const FoundationSite &site)
          : parameters(site.parameters), mesh(site.mesh), source(site.source),
            incompatible_modes(site.incompatible_modes)
      {
      }

      Base base() const override { return Base::shared; }
      bool uses_rock() const override { return true; }

      void add_stiffness(const SolidModel &dam, Structure &structure) override
      {
        add_massless_rock(parameters, mesh, dam, incompatible_modes, source, structure);
      }

      void report(Log &log, const TimeGrid &) const override
      {
        log.line("Rock      massless: %s", in_words(parameters.rock).c_str());
      }

    private:
      const FoundationParameters parameters;
      const HexMesh              mesh;
      const std::string          source;
      const bool                 incompatible_modes;
    };
  } // namespace

  std::unique_ptr<Foundation> make_massless_rock(const FoundationSite &site)
  {
    return std::make_unique<MasslessRock>(site);
  }
} // namespace Voussoir
