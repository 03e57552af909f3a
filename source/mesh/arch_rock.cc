// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/tensor3.h>
#include <voussoir/mesh/arch_rock.h>
#include <voussoir/mesh/grading.h>

#include <algorithm>
#include <cmath>

namespace Voussoir
{
  namespace
  {
    constexpr double largest_size = 1.7;   ///< largest element on long grid lines, in element sizes
    constexpr double smallest_size = 0.35; ///< smallest mean on short grid lines, likewise

    class Builder
    {
    public:
      Builder(const ArchShape &shape, const ArchGrid &dam, const ArchRockParameters &rock, ArchMesh &arch)
          : rock(rock), base(arch.base), mesh(arch.mesh), bottom(shape.bottom()),
            valley(arch_valley(shape, dam)), n_columns(valley.size() - 1), n_dam_layers(dam.elements_through),
            n(rock.n_layers)
      {
      }

      void build()
      {
        measure();
        make_dam_columns();
        make_side(0);
        make_side(1);
        smooth();
        number_nodes();
        make_cells();
        release_end_walls();
      }

    private:
      unsigned int dam_node(const unsigned int column, const unsigned int layer) const
      {
        return base[column] + layer;
      }
      const Vector3 &base_node(const unsigned int column, const unsigned int layer) const
      {
        return mesh.nodes[dam_node(column, layer)];
      }

      /** Returns the thickness of the outermost layer of the dam at a column, along x [m]. */
      double base_size(const unsigned int column, const bool is_upstream) const
      {
        const Vector3 &a = base_node(column, is_upstream ? 0 : n_dam_layers - 1);
        const Vector3 &b = base_node(column, is_upstream ? 1 : n_dam_layers);
        const double   dx = b[0] - a[0], dy = b[1] - a[1];
        return (dx * dx + dy * dy) / dx;
      }

      /** Returns the distance of the layers at the side face from the end of the dam [m]. */
      double side_length(const unsigned int bank) const { return y_side[bank] - side.width() - y_end[bank]; }

      /** Layers of equal elements along a face of the block. */
      struct Layers
      {
        double       size = 0.; ///< of an element [m]
        unsigned int count = 0;
        double       extent = 0.;                           ///< from the base to the face of the block [m]
        double       width() const { return count * size; } ///< [m]
      };

      /** Returns the layers of a block of the given @p extent [m]. An extent above the height of the dam
       * only adds layers: the elements at the dam do not depend on the block. */
      Layers layers(const double extent) const
      {
        const double       inner = std::min(extent, rock.height);
        const double       size = std::min(rock.element_size, inner / (n + 6));
        const unsigned int more = std::lround((extent - inner) / size);
        return {size, n + more, inner + more * size};
      }

      /** Computes the faces of the block, the element sizes at the faces and the numbers of elements. */
      void measure()
      {
        double x_min = base_node(0, 0)[0], x_max = x_min;
        y_side = {0, 0};
        for (unsigned int c = 0; c <= n_columns; ++c)
          for (unsigned int l = 0; l <= n_dam_layers; ++l)
          {
            x_min = std::min(x_min, base_node(c, l)[0]);
            x_max = std::max(x_max, base_node(c, l)[0]);
            const double y = base_node(c, l)[1];
            y_side[0] = std::max(y_side[0], -y);
            y_side[1] = std::max(y_side[1], y);
          }
        upstream = layers(rock.upstream);
        downstream = layers(rock.downstream);
        side = layers(rock.sides);
        below = layers(rock.depth);
        x_upstream = x_min - upstream.extent;
        x_downstream = x_max + downstream.extent;
        z_bottom = bottom - below.extent;
        plateau = valley.back()[1];
        valley.front()[1] = plateau;
        y_end = {-valley.front()[0], valley.back()[0]};
        surface_size = 0.6 * rock.element_size;
        const double largest = largest_size * rock.element_size;

        const double smallest = smallest_size * rock.element_size;
        const auto   count_lines = [&](const bool is_upstream)
        {
          unsigned int wanted = 0, limit = 1000000;
          for (unsigned int c = 0; c <= n_columns; ++c)
          {
            const double length = is_upstream
                                      ? base_node(c, 0)[0] - x_upstream - upstream.width()
                                      : x_downstream - downstream.width() - base_node(c, n_dam_layers)[0];
            wanted = std::max(wanted, n_graded(length, base_size(c, is_upstream),
                                               is_upstream ? upstream.size : downstream.size, largest));
            limit = std::min<unsigned int>(limit, std::ceil(length / smallest));
          }
          return std::clamp(limit, 2u, wanted);
        };
        n_upstream = count_lines(true);
        n_downstream = count_lines(false);
        measure_sides();
        const double below_valley = bottom - z_bottom - below.width(), above = plateau - bottom;
        n_down = std::clamp<unsigned int>(
            std::ceil(below_valley / smallest), 2,
            n_graded(above + below_valley, surface_size, below.size, rock.element_size));

        first_column = side.count + n_side;
        first_layer = upstream.count + n_upstream;
        n_i = n_columns + 2 * first_column;
        n_j = first_layer + n_dam_layers + n_downstream + downstream.count;
        n_k = n_down + below.count;
        surface.assign((n_i + 1) * (n_j + 1), Vector3{});
      }

      /** Computes the sizes and the number of elements beside the dam. */
      void measure_sides()
      {
        column_size = {valley[1][0] + y_end[0], y_end[1] - valley[n_columns - 1][0]};
        n_side = 0;
        for (const unsigned int bank : {0, 1})
        {
          y_side[bank] += side.extent;
          n_side =
              std::max(n_side, n_graded(side_length(bank), column_size[bank], side.size, rock.element_size));
        }
      }

      Vector3 &ground(const unsigned int i, const unsigned int j) { return surface[i * (n_j + 1) + j]; }

      /** Computes the ground in the columns of the dam: lines along the valley, through the base nodes. */
      void make_dam_columns()
      {
        for (unsigned int c = 0; c <= n_columns; ++c)
        {
          const unsigned int i = first_column + c;
          for (unsigned int l = 0; l <= n_dam_layers; ++l)
            ground(i, first_layer + l) = base_node(c, l);
          for (const bool is_upstream : {true, false})
          {
            const int          direction = is_upstream ? -1 : 1;
            const unsigned int start = is_upstream ? first_layer : first_layer + n_dam_layers;
            const unsigned int m = is_upstream ? n_upstream : n_downstream;
            const double       face = is_upstream ? x_upstream : x_downstream;
            const Layers      &outer = is_upstream ? upstream : downstream;
            const Vector3      from = ground(i, start);
            const double       length = std::abs(face - direction * outer.width() - from[0]);
            const auto         d = graded(m, length, base_size(c, is_upstream), outer.size);
            for (unsigned int t = 1; t < m; ++t)
            {
              const double f = fade(d[t] / length);
              ground(i, start + direction * t) = {from[0] + direction * d[t],
                                                  valley[c][0] + f * (from[1] - valley[c][0]),
                                                  valley[c][1] + f * (from[2] - valley[c][1])};
            }
            for (unsigned int t = 0; t <= outer.count; ++t)
              ground(i, start + direction * (m + outer.count - t)) = {face - direction * (t * outer.size),
                                                                      valley[c][0], valley[c][1]};
          }
        }
      }

      /** Returns x of the layers on the side face [m]. @p end: column of the dam at this bank. */
      std::vector<double> straight_layers(const unsigned int end, const double bend)
      {
        const double upper = x_upstream + upstream.width(), lower = x_downstream - downstream.width();
        const double h =
            std::max(base_size(end, true), std::min(surface_size, 0.1 * (lower - upper) / n_dam_layers));
        const double        middle = 0.5 * (base_node(end, 0)[0] + base_node(end, n_dam_layers)[0]) + bend;
        const double        first = middle - 0.5 * n_dam_layers * h, last = middle + 0.5 * n_dam_layers * h;
        std::vector<double> x(n_j + 1);
        for (unsigned int t = 0; t <= upstream.count; ++t)
          x[t] = x_upstream + t * upstream.size;
        for (unsigned int t = 0; t <= downstream.count; ++t)
          x[n_j - t] = x_downstream - t * downstream.size;
        const auto before = graded(n_upstream, first - upper, h, upstream.size);
        const auto after = graded(n_downstream, lower - last, h, downstream.size);
        for (unsigned int t = 0; t < n_upstream; ++t)
          x[first_layer - t] = first - before[t];
        for (unsigned int t = 0; t < n_downstream; ++t)
          x[first_layer + n_dam_layers + t] = last + after[t];
        for (unsigned int l = 1; l < n_dam_layers; ++l)
          x[first_layer + l] = first + l * h;
        return x;
      }

      /** Computes the ground beyond the end of the dam on the right (@p side = 0) or the left bank (1). The
       * layers continue in the direction of the dam and bend to the direction of y. */
      void make_side(const unsigned int bank_number)
      {
        const int          bank = bank_number == 1 ? 1 : -1;
        const unsigned int end = bank_number == 1 ? first_column + n_columns : first_column;
        const double       length = side_length(bank_number);
        const auto         d = graded(n_side, length, column_size[bank_number], side.size);
        const auto         slope = [&](const unsigned int j)
        {
          const Vector3 &inside = ground(end - bank, j);
          return (ground(end, j)[0] - inside[0]) / std::abs(ground(end, j)[1] - inside[1]);
        };
        const double dam_slope = 0.5 * (slope(first_layer) + slope(first_layer + n_dam_layers));
        const auto   x = straight_layers(end - first_column, 0.2 * length * dam_slope);
        for (unsigned int j = 0; j <= n_j; ++j)
        {
          const bool    is_straight = j <= upstream.count || j + downstream.count >= n_j;
          const double  leaving = dam_slope * fade(distance(j));
          const Vector3 from = ground(end, j);
          for (unsigned int t = 1; t < n_side; ++t)
          {
            const double eta = d[t] / length, f = fade(eta);
            ground(end + bank * t, j) = {
                is_straight ? x[j]
                            : f * from[0] + (1 - f) * x[j] + leaving * length * eta * (1 - eta) * (1 - eta),
                bank * (y_end[bank_number] + d[t]) + f * (from[1] - bank * y_end[bank_number]),
                plateau + f * (from[2] - plateau)};
          }
          for (unsigned int t = 0; t <= side.count; ++t)
            ground(end + bank * (n_side + side.count - t),
                   j) = {x[j], bank * (y_side[bank_number] - t * side.size), plateau};
        }
      }

      /** Returns the relative distance of layer j: 0 at the dam, 1 at the layers along the boundary. */
      double distance(const unsigned int j) const
      {
        if (j < first_layer)
          return std::min(1., double(first_layer - j) / n_upstream);
        const unsigned int last_layer = first_layer + n_dam_layers;
        return j <= last_layer ? 0 : std::min(1., double(j - last_layer) / n_downstream);
      }

      /** Returns the relative distance of column i, like distance(). */
      double distance_of_column(const unsigned int i) const
      {
        const unsigned int last_column = first_column + n_columns;
        const unsigned int steps = i < first_column  ? first_column - i
                                   : i > last_column ? i - last_column
                                                     : 0;
        return std::min(1., double(steps) / n_side);
      }

      /** Smooths the lines across the valley over about 100 m. The smoothing increases with the distance from
       * the dam. An element loses at most a third of its length. */
      void smooth()
      {
        const std::vector<Vector3> unsmoothed = surface;
        const auto                 gap = [&](const unsigned int i, const unsigned int j)
        {
          const Vector3 *at = &unsmoothed[i * (n_j + 1) + j];
          return at[1][0] - at[0][0];
        };
        const double       column = (y_end[0] + y_end[1]) / n_columns;
        const unsigned int n_sweeps = std::min(1000., std::ceil(std::pow(100 / column, 2)));
        for (unsigned int sweep = 0; sweep < n_sweeps; ++sweep)
          for (unsigned int j = upstream.count + 1; j + downstream.count < n_j; ++j)
          {
            Vector3 before = ground(side.count, j);
            for (unsigned int i = side.count + 1; i + side.count < n_i; ++i)
            {
              const double  share = 1 - fade(std::max(distance(j), distance_of_column(i)));
              const Vector3 here = ground(i, j), &after = ground(i + 1, j);
              const double  middle =
                  before[0] + (after[0] - before[0]) * (here[1] - before[1]) / (after[1] - before[1]);
              const double lower = ground(i, j - 1)[0] + 2. / 3 * gap(i, j - 1),
                           upper = ground(i, j + 1)[0] - 2. / 3 * gap(i, j);
              if (lower < upper)
                ground(i, j)[0] = std::clamp(here[0] + 0.5 * share * (middle - here[0]),
                                             std::min(lower, here[0]), std::max(upper, here[0]));
              before = here;
            }
          }
      }

      void number_nodes()
      {
        number.resize(surface.size() * (n_k + 1));
        for (unsigned int i = 0; i <= n_i; ++i)
          for (unsigned int j = 0; j <= n_j; ++j)
          {
            const Vector3 top = ground(i, j);
            const auto    d = graded(n_down, top[2] - z_bottom - below.width(), surface_size, below.size);
            const bool    is_base = i >= first_column && i <= first_column + n_columns && j >= first_layer &&
                                 j <= first_layer + n_dam_layers;
            for (unsigned int k = 0; k <= n_k; ++k)
            {
              unsigned int &node = number[(i * (n_j + 1) + j) * (n_k + 1) + k];
              if (k == 0 && is_base)
              {
                node = dam_node(i - first_column, j - first_layer);
                continue;
              }
              node = mesh.nodes.size();
              mesh.nodes.push_back(
                  {top[0], top[1], k < n_down ? top[2] - d[k] : z_bottom + (n_k - k) * below.size});
            }
          }
      }

      void make_cells()
      {
        const auto node = [&](const unsigned int i, const unsigned int j, const unsigned int k)
        { return number[(i * (n_j + 1) + j) * (n_k + 1) + k]; };
        for (unsigned int i = 0; i < n_i; ++i)
          for (unsigned int j = 0; j < n_j; ++j)
            for (unsigned int k = 0; k < n_k; ++k)
            {
              const HexMesh::Cell cell{{node(i, j, k + 1), node(i, j + 1, k + 1), node(i + 1, j + 1, k + 1),
                                        node(i + 1, j, k + 1), node(i, j, k), node(i, j + 1, k),
                                        node(i + 1, j + 1, k), node(i + 1, j, k)},
                                       PhysicalId::first_rock};
              mesh.cells.push_back(cell);

              // In the order of hex_faces: bottom, ground, right bank, downstream, left bank, upstream.
              const bool is_base = i >= first_column && i < first_column + n_columns && j >= first_layer &&
                                   j < first_layer + n_dam_layers;
              const bool outside[6] = {k + 1 == n_k, k == 0 && !is_base, i == 0,
                                       j + 1 == n_j, i + 1 == n_i,       j == 0};
              for (unsigned int f = 0; f < 6; ++f)
                if (outside[f])
                {
                  HexMesh::Face face{{}, f == 1 ? PhysicalId::free_surface : PhysicalId::artificial};
                  for (unsigned int v = 0; v < 4; ++v)
                    face.nodes[v] = cell.nodes[hex_faces[f][v]];
                  mesh.faces.push_back(face);
                }
            }
        mesh.names[{3, PhysicalId::first_rock}] = physical_name(3, PhysicalId::first_rock);
        for (const int id : {PhysicalId::free_surface, PhysicalId::artificial})
          mesh.names[{2, id}] = physical_name(2, id);
      }

      void release_end_walls()
      {
        std::vector<bool> is_base_node(mesh.nodes.size(), false);
        for (const unsigned int first : base)
          std::fill_n(is_base_node.begin() + first, n_dam_layers + 1, true);
        const auto is_end_wall = [&](const HexMesh::Face &face)
        {
          return is_base(face.surface) &&
                 std::any_of(face.nodes.begin(), face.nodes.end(),
                             [&](const unsigned int node) { return !is_base_node[node]; });
        };
        mesh.faces.erase(std::remove_if(mesh.faces.begin(), mesh.faces.end(), is_end_wall), mesh.faces.end());
      }

      const ArchRockParameters          &rock;
      const std::vector<unsigned int>   &base; ///< node at the upstream face of each column of the dam
      HexMesh                           &mesh;
      const double                       bottom; ///< z of the lowest arc [m]
      std::vector<std::array<double, 2>> valley; // (y, z) of each column of the dam
      const unsigned int                 n_columns, n_dam_layers, n;
      Layers                             upstream, downstream, side, below;
      double                             x_upstream, x_downstream, z_bottom, plateau; // [m]
      std::array<double, 2> y_side, y_end; // |y| of the side faces and of the ends of the dam, by bank [m]
      double                surface_size;  // of the elements below the ground [m]
      std::array<double, 2> column_size;   // of the elements at the ends of the dam, by bank [m]
      unsigned int          n_upstream, n_downstream, n_side, n_down; // elements between dam and layers
      unsigned int          first_column, first_layer;                // first ones of the dam
      unsigned int          n_i, n_j, n_k; // elements across, along the stream, down
      std::vector<Vector3>  surface;       // ground and base, by i and j
      std::vector<unsigned int> number;    // number of the node i, j, k
    };
  } // namespace

  void add_arch_rock(const ArchShape &shape, const ArchGrid &grid, const ArchRockParameters &rock,
                     ArchMesh &arch)
  {
    Builder(shape, grid, rock, arch).build();
  }
} // namespace Voussoir
