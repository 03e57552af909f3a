// SPDX-License-Identifier: GPL-3.0-or-later
#include "rock_assembly.h"

#include <deal.II/base/quadrature_lib.h>

#include <voussoir/base/parallel.h>
#include <voussoir/mesh/plane_section.h>
#include <voussoir/solid/cell_elasticity.h>

#include <algorithm>
#include <numeric>

#ifdef _OPENMP
#include <omp.h>
#endif

namespace Voussoir
{
  using dealii::QGaussLobatto;

  namespace
  {
    /** Returns whether two corners are coupled: nodal quadrature does not couple the ends of a diagonal
     * of a cell. */
    bool are_coupled(const unsigned int v, const unsigned int w, const Integration kind)
    {
      return kind != Integration::nodal || w != (v ^ 7u);
    }

    std::array<unsigned int, 8> nodes_of(const RockGrid &grid, const RockGrid::Cell &cell)
    {
      std::array<unsigned int, 8> nodes;
      for (unsigned int v = 0; v < 8; ++v)
        nodes[v] = grid.node(cell, v);
      return nodes;
    }
  } // namespace

  Corners corners_of(const RockGrid &grid)
  {
    Corners result(grid.triangulation.n_active_cells());
    for (const RockGrid::Cell &cell : grid.dof_handler.active_cell_iterators())
      result[cell->active_cell_index()] = nodes_of(grid, cell);
    return result;
  }

  void add_layers(const Corners &cells, const unsigned int n_layers, std::vector<bool> &nodes)
  {
    for (unsigned int layer = 0; layer < n_layers; ++layer)
    {
      const std::vector<bool> before = nodes;
      for (const auto &cell : cells)
        if (std::any_of(cell.begin(), cell.end(), [&](const unsigned int i) { return before[i]; }))
          for (const unsigned int i : cell)
            nodes[i] = true;
    }
  }

  namespace
  {
    /** Returns the sparsity pattern of the given @p rows; other rows are empty. */
    BlockSparseMatrix pattern(const Corners &cells, const std::vector<Integration> &kind,
                              const std::vector<bool> &rows)
    {
      const long                n = static_cast<long>(rows.size());
      std::vector<unsigned int> first(n + 1, 0), corner; // per node: its corners among those of all cells
      for (const auto &cell : cells)
        for (const unsigned int i : cell)
          first[i + 1] += rows[i];
      std::partial_sum(first.begin(), first.end(), first.begin());
      corner.resize(first.back());
      std::vector<unsigned int> next(first.begin(), first.end() - 1);
      for (unsigned int k = 0; k < cells.size(); ++k)
        for (unsigned int v = 0; v < 8; ++v)
          if (const unsigned int i = cells[k][v]; rows[i])
            corner[next[i]++] = 8 * k + v;
      const auto columns_of = [&](const long i)
      {
        std::vector<unsigned int> row;
        for (unsigned int c = first[i]; c < first[i + 1]; ++c)
          for (unsigned int w = 0; w < 8; ++w)
            if (are_coupled(corner[c] % 8, w, kind[corner[c] / 8]))
              row.push_back(cells[corner[c] / 8][w]);
        std::sort(row.begin(), row.end());
        row.erase(std::unique(row.begin(), row.end()), row.end());
        return row;
      };
      BlockSparseMatrix matrix;
      matrix.start.assign(n + 1, 0);
#pragma omp parallel for schedule(static)
      for (long i = 0; i < n; ++i)
        matrix.start[i + 1] = columns_of(i).size();
      std::partial_sum(matrix.start.begin(), matrix.start.end(), matrix.start.begin());
      matrix.column.resize(matrix.start.back());
#pragma omp parallel for schedule(static)
      for (long i = 0; i < n; ++i)
      {
        const std::vector<unsigned int> row = columns_of(i);
        std::copy(row.begin(), row.end(), matrix.column.begin() + matrix.start[i]);
      }
      matrix.value.assign(matrix.column.size(), Matrix3{});
      return matrix;
    }

    void keep_rows(const std::vector<bool> &kept, BlockSparseMatrix &matrix)
    {
      std::size_t from = 0, to = 0;
      for (unsigned int i = 0; i < matrix.n_rows(); ++i)
      {
        const std::size_t end = matrix.start[i + 1];
        matrix.start[i] = to;
        for (; from < end; ++from)
          if (kept[i])
          {
            matrix.column[to] = matrix.column[from];
            matrix.value[to++] = matrix.value[from];
          }
      }
      matrix.start.back() = to;
      matrix.column.resize(to);
      matrix.value.resize(to);
    }

    /** Restricts the stiffness @p K of a cell, 64 blocks, to plane strain. Nodes at the same x and z get the mean of
     * their forces and see the mean of their displacements. Springs hold the displacements along y and the
     * differences of such nodes at zero; they are not stiffer than the plane, so that the critical time step does not
     * depend on the thickness. */
    void make_plane(const RockGrid::Cell &cell, Matrix3 *K)
    {
      std::array<Vector3, 8> x;
      for (unsigned int v = 0; v < 8; ++v)
        x[v] = {{cell->vertex(v)[0], cell->vertex(v)[1], cell->vertex(v)[2]}};
      const std::array<unsigned int, 8> across = across_y(x);
      const std::vector<Matrix3>        full(K, K + 64);
      for (unsigned int v = 0; v < 8; ++v)
        for (unsigned int w = 0; w < 8; ++w)
          for (const unsigned int i : {0, 2, 6, 8})
            K[8 * v + w][i] = .25 * ((full[8 * v + w][i] + full[8 * across[v] + across[w]][i]) +
                                     (full[8 * v + across[w]][i] + full[8 * across[v] + w][i]));
      for (unsigned int v = 0; v < 8; ++v)
      {
        const Matrix3 own = K[9 * v];
        for (unsigned int w = 0; w < 8; ++w)
          for (const unsigned int i : {1, 3, 4, 5, 7})
            K[8 * v + w][i] = v == w && i == 4 ? own[0] : 0.;
        for (const unsigned int i : {0, 8})
        {
          K[9 * v][i] += .5 * own[i];
          K[8 * v + across[v]][i] -= .5 * own[i];
        }
      }
    }

    /** Element matrices of consecutive cells. */
    struct Chunk
    {
      static constexpr unsigned int most = 256; // cells

      std::vector<RockGrid::Cell> cells;
      std::vector<Matrix3>        stiffness; ///< 64 per cell
      std::vector<double>         mass;      ///< 8 per cell

      void integrate(const RockGrid &grid, const RockParameters &parameters,
                     const std::vector<Integration> &kind)
      {
        if (cells.empty())
          return;
        CellElasticity gauss(grid.fe, false), with_modes(grid.fe, true),
            at_nodes(grid.fe, false, QGaussLobatto<3>(2));
        stiffness.clear();
        mass.clear();
        for (const RockGrid::Cell &cell : cells)
        {
          const Integration of_cell = kind[cell->active_cell_index()];
          CellElasticity   &element = of_cell == Integration::gauss        ? gauss
                                      : of_cell == Integration::with_modes ? with_modes
                                                                           : at_nodes;
          element.reinit(cell, parameters.materials.at(cell->material_id()));
          stiffness.insert(stiffness.end(), element.stiffness.begin(), element.stiffness.end());
          if (parameters.plane_strain)
            make_plane(cell, stiffness.data() + stiffness.size() - 64);
          mass.insert(mass.end(), element.mass.begin(), element.mass.end());
        }
      }

      void add_to(RockModel &model, const RockGrid &grid, const std::vector<Integration> &kind) const
      {
        const Matrix3 *block = stiffness.data();
        const double  *m = mass.data();
        for (const RockGrid::Cell &cell : cells)
        {
          const auto nodes = nodes_of(grid, cell);
          for (unsigned int v = 0; v < 8; ++v)
          {
            model.mass[nodes[v]] += *m++;
            const bool has_row = model.stiffness.start[nodes[v]] < model.stiffness.start[nodes[v] + 1];
            for (unsigned int w = 0; w < 8; ++w, ++block)
              if (has_row && are_coupled(v, w, kind[cell->active_cell_index()]))
                model.stiffness.add(nodes[v], nodes[w], *block);
          }
        }
      }
    };
  } // namespace

  /** Threads integrate several chunks of cells at a time. The chunks are added in the order of the cells, so
   * that sums do not depend on the number of threads. */
  void assemble_rock(const RockGrid &grid, const Corners &cells, const std::vector<Integration> &kind,
                     const RockParameters &parameters, const std::vector<bool> &rows, RockModel &model)
  {
    std::vector<bool> with_neighbours = rows; // for the transposed entries
    add_layers(cells, 1, with_neighbours);
    model.stiffness = pattern(cells, kind, with_neighbours);
    model.mass.assign(grid.n_nodes(), 0.);
    int n_threads = 1;
#ifdef _OPENMP
    n_threads = omp_get_max_threads();
#endif
    std::vector<Chunk> chunks(n_threads);
    auto               cell = grid.dof_handler.begin_active();
    const auto         end = grid.dof_handler.end();
    while (cell != end)
    {
      for (Chunk &chunk : chunks)
        for (chunk.cells.clear(); chunk.cells.size() < Chunk::most && cell != end; ++cell)
          chunk.cells.push_back(cell);
      for_each_parallel(chunks.size(), [&](const int c) { chunks[c].integrate(grid, parameters, kind); });
      for (const Chunk &chunk : chunks)
        chunk.add_to(model, grid, kind);
    }
    model.stiffness.symmetrise();
    if (std::find(rows.begin(), rows.end(), false) != rows.end())
      keep_rows(rows, model.stiffness);
  }
} // namespace Voussoir
