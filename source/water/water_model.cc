// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/error.h>
#include <voussoir/water/water_model.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace Voussoir
{
  namespace
  {
    constexpr double damped_depths = 5.; ///< length of the damped layers, in depths
    constexpr double growth = 1.05;      ///< of the damped layers

    /** Matrices of an element. */
    struct Cell
    {
      std::array<std::array<double, 8>, 8> K{};
      std::array<double, 8>                M{};
      double                               volume = 0.;
    };

    /** Returns the matrices for density and sound speed 1. Nodes: four of a section counter-clockwise, then the same
     * four of the next layer. */
    Cell cell_matrices(const std::array<Vector3, 8> &x)
    {
      constexpr double s[8] = {-1, 1, 1, -1, -1, 1, 1, -1}, t[8] = {-1, -1, 1, 1, -1, -1, 1, 1},
                       r[8] = {-1, -1, -1, -1, 1, 1, 1, 1};
      Cell         cell;
      const double g = 1. / std::sqrt(3.);
      for (unsigned int q = 0; q < 8; ++q)
      {
        const double           a = s[q] * g, b = t[q] * g, c = r[q] * g;
        std::array<Vector3, 8> reference; // derivatives of the shape functions
        std::array<double, 8>  N;
        Matrix3                J{};
        for (unsigned int i = 0; i < 8; ++i)
        {
          const double A = 1 + s[i] * a, B = 1 + t[i] * b, C = 1 + r[i] * c;
          N[i] = A * B * C / 8;
          reference[i] = {{s[i] * B * C / 8, A * t[i] * C / 8, A * B * r[i] / 8}};
          for (unsigned int d = 0; d < 3; ++d)
            for (unsigned int e = 0; e < 3; ++e)
              J[3 * d + e] += reference[i][d] * x[i][e];
        }
        const double det = J[0] * (J[4] * J[8] - J[5] * J[7]) - J[1] * (J[3] * J[8] - J[5] * J[6]) +
                           J[2] * (J[3] * J[7] - J[4] * J[6]);
        const double dV = std::abs(det);
        // Gradient in space: the inverse of J times the derivatives.
        const Matrix3 inverse = {{(J[4] * J[8] - J[5] * J[7]) / det, (J[2] * J[7] - J[1] * J[8]) / det,
                                  (J[1] * J[5] - J[2] * J[4]) / det, (J[5] * J[6] - J[3] * J[8]) / det,
                                  (J[0] * J[8] - J[2] * J[6]) / det, (J[2] * J[3] - J[0] * J[5]) / det,
                                  (J[3] * J[7] - J[4] * J[6]) / det, (J[1] * J[6] - J[0] * J[7]) / det,
                                  (J[0] * J[4] - J[1] * J[3]) / det}};
        std::array<Vector3, 8> gradient;
        for (unsigned int i = 0; i < 8; ++i)
          gradient[i] = inverse * reference[i];
        for (unsigned int i = 0; i < 8; ++i)
        {
          for (unsigned int j = 0; j < 8; ++j)
            cell.K[i][j] += dot(gradient[i], gradient[j]) * dV;
          cell.M[i] += N[i] * dV;
        }
        cell.volume += dV;
      }
      return cell;
    }

    /** Returns the largest eigenvalue of M^-1 K, for the sound speed 1 [1/m^2]. The power iteration can
     * be too small by about 0.2 %; the limit for the increase of the mass, 1.02 times the time step, covers it. */
    double largest_eigenvalue(const Cell &cell)
    {
      std::array<double, 8> v = {1., -1.1, 1.2, -.9, -1., 1.3, -1.2, .8};
      double                value = 0.;
      for (unsigned int pass = 0; pass < 200; ++pass)
      {
        std::array<double, 8> w{};
        double                largest = 0.;
        for (unsigned int i = 0; i < 8; ++i)
        {
          for (unsigned int j = 0; j < 8; ++j)
            w[i] += cell.K[i][j] * v[j];
          w[i] /= cell.M[i];
          largest = std::max(largest, std::abs(w[i]));
        }
        value = largest;
        for (unsigned int i = 0; i < 8; ++i)
          v[i] = w[i] / largest;
      }
      return 1.001 * value;
    }

    /** Calls f(area, shares) at the four Gauss points of a quadrilateral: its area vector there [m^2], and the shape
     * functions. The order of the corners gives the direction. */
    template <class Function> void for_points(const std::array<Vector3, 4> &x, const Function &f)
    {
      const double     g = 1. / std::sqrt(3.);
      constexpr double s[4] = {-1, 1, 1, -1}, t[4] = {-1, -1, 1, 1};
      for (unsigned int q = 0; q < 4; ++q)
      {
        Vector3               a{}, b{};
        std::array<double, 4> N;
        for (unsigned int i = 0; i < 4; ++i)
        {
          const double A = 1 + s[i] * s[q] * g, B = 1 + t[i] * t[q] * g;
          N[i] = A * B / 4;
          for (unsigned int d = 0; d < 3; ++d)
          {
            a[d] += s[i] * B / 4 * x[i][d];
            b[d] += A * t[i] / 4 * x[i][d];
          }
        }
        f(Vector3{{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]}}, N);
      }
    }
  } // namespace

  WaterModel::WaterModel(const WaterSection &section, const WaterProperties &properties, const double dt)
      : n_section(section.points.size())
  {
    add_layers(section, properties);
    make_pattern(section);
    assemble_cells(section, properties, dt);
    add_bed(section, properties);
    add_end(section, properties);
  }

  WaterModel WaterModel::far_channel(WaterSection section, const WaterProperties &properties,
                                     const double dt) const
  {
    section.face_x.assign(n_section, 0.);
    WaterModel far(n_section);
    far.layers = {0., 1.};
    far.first_damped = 1;
    far.place_nodes(section, last_length);
    far.make_pattern(section);
    far.assemble_cells(section, properties, dt);
    far.end_damping.assign(far.n_nodes(), 0.);
    far.add_bed(section, properties);
    return far;
  }

  /** Places the layers: lengths of the elements from h to 2 h in an arithmetic progression, then the damped layers. */
  void WaterModel::add_layers(const WaterSection &section, const WaterProperties &properties)
  {
    const auto          n = std::max<unsigned int>(2, std::lround(properties.length / (1.5 * properties.h)));
    std::vector<double> lengths;
    for (unsigned int k = 0; k < n; ++k)
      lengths.push_back(properties.length / n * (2. / 3. + 2. / 3. * k / (n - 1.)));
    first_damped = n;
    for (double damped = 0.; damped < damped_depths * properties.depth; damped += lengths.back())
      lengths.push_back(lengths.back() * growth);
    layers = {0.};
    for (const double length : lengths)
      layers.push_back(layers.back() + length);
    const double whole = layers.back();
    for (double &place : layers)
      place /= whole;
    last_length = lengths.back();
    place_nodes(section, whole);
  }

  /** Places the nodes of the layers between the dam and the flat end. @p length: smallest one of the channel [m]. */
  void WaterModel::place_nodes(const WaterSection &section, const double length)
  {
    const double end = *std::min_element(section.face_x.begin(), section.face_x.end()) - length;
    for (const double t : layers)
      for (unsigned int j = 0; j < n_section; ++j)
      {
        points.push_back({{section.face_x[j] + t * (end - section.face_x[j]), section.points[j][0],
                           section.points[j][1]}});
        at_surface.push_back(section.at_surface[j]);
      }
  }

  std::array<unsigned int, 8> WaterModel::nodes_of(const std::size_t                  layer,
                                                   const std::array<unsigned int, 4> &cell) const
  {
    std::array<unsigned int, 8> nodes;
    for (unsigned int i = 0; i < 4; ++i)
      nodes[i] = layer * n_section + cell[i], nodes[4 + i] = (layer + 1) * n_section + cell[i];
    return nodes;
  }

  /** Creates the sparsity pattern of K. */
  void WaterModel::make_pattern(const WaterSection &section)
  {
    std::vector<std::set<unsigned int>> rows(points.size());
    for (std::size_t k = 0; k + 1 < layers.size(); ++k)
      for (const auto &cell : section.cells)
      {
        const auto nodes = nodes_of(k, cell);
        for (const unsigned int i : nodes)
          rows[i].insert(nodes.begin(), nodes.end());
      }
    start = {0};
    for (const auto &row : rows)
    {
      column.insert(column.end(), row.begin(), row.end());
      start.push_back(column.size());
    }
    value.assign(column.size(), 0.);
  }

  void WaterModel::assemble_cells(const WaterSection &section, const WaterProperties &properties,
                                  const double dt)
  {
    const double rho = properties.density, c = properties.sound_speed;
    mass.assign(points.size(), 0.);
    std::vector<double> unscaled(points.size(), 0.);
    double              fastest = 0.;
    for (std::size_t k = 0; k + 1 < layers.size(); ++k)
      for (const auto &in_section : section.cells)
      {
        const auto             nodes = nodes_of(k, in_section);
        std::array<Vector3, 8> x;
        for (unsigned int i = 0; i < 8; ++i)
          x[i] = points[nodes[i]];
        const Cell   cell = cell_matrices(x);
        const double omega = c * std::sqrt(largest_eigenvalue(cell));
        const double scale = std::max(1., std::pow(1.02 * dt * omega / 2., 2));
        fastest = std::max(fastest, omega);
        volume += cell.volume;
        for (unsigned int i = 0; i < 8; ++i)
        {
          mass[nodes[i]] += scale * rho / (c * c) * cell.M[i];
          unscaled[nodes[i]] += rho / (c * c) * cell.M[i];
          for (unsigned int j = 0; j < 8; ++j)
          {
            const auto row = column.begin() + start[nodes[i]];
            const auto at = std::lower_bound(row, column.begin() + start[nodes[i] + 1], nodes[j]);
            value[at - column.begin()] += rho * cell.K[i][j];
          }
        }
      }
    double sum = 0., sum_unscaled = 0.;
    for (std::size_t i = 0; i < mass.size(); ++i)
      sum += mass[i], sum_unscaled += unscaled[i];
    mass_factor = sum / sum_unscaled;
    critical_step = 2. / fastest;
    end_damping.assign(points.size(), 0.);
    const double from = layers[first_damped];
    for (std::size_t i = first_damped * n_section; i < points.size() && from < 1.; ++i)
      end_damping[i] =
          c / properties.depth * std::pow((layers[i / n_section] - from) / (1. - from), 2) * unscaled[i];
  }

  void WaterModel::add_bed(const WaterSection &section, const WaterProperties &properties)
  {
    const double rho = properties.density,
                 q = (1. - properties.reflection) / (1. + properties.reflection) / properties.sound_speed;
    bed_damping.assign(points.size(), 0.);
    ground.assign(points.size(), Vector3{});
    for (std::size_t k = 0; k + 1 < layers.size(); ++k)
      for (std::size_t b = 0; b + 1 < section.bank.size(); ++b)
      {
        // The chain goes from small to large y below the water, and the layers upstream.
        const std::array<unsigned int, 4> nodes = {
            static_cast<unsigned int>(k * n_section + section.bank[b]),
            static_cast<unsigned int>((k + 1) * n_section + section.bank[b]),
            static_cast<unsigned int>((k + 1) * n_section + section.bank[b + 1]),
            static_cast<unsigned int>(k * n_section + section.bank[b + 1])};
        std::array<Vector3, 4> x;
        for (unsigned int i = 0; i < 4; ++i)
          x[i] = points[nodes[i]];
        for_points(x,
                   [&](const Vector3 &area, const std::array<double, 4> &N)
                   {
                     for (unsigned int i = 0; i < 4; ++i)
                     {
                       bed_damping[nodes[i]] += rho * q * N[i] * norm(area);
                       for (unsigned int d = 0; d < 3; ++d)
                         ground[nodes[i]][d] += N[i] * area[d];
                     }
                   });
      }
  }

  void WaterModel::add_end(const WaterSection &section, const WaterProperties &properties)
  {
    const std::size_t last = (layers.size() - 1) * n_section;
    for (const auto &cell : section.cells)
    {
      std::array<Vector3, 4> x;
      for (unsigned int i = 0; i < 4; ++i)
        x[i] = points[last + cell[i]];
      for_points(x,
                 [&](const Vector3 &area, const std::array<double, 4> &N)
                 {
                   for (unsigned int i = 0; i < 4; ++i)
                     end_damping[last + cell[i]] +=
                         properties.density / properties.sound_speed * N[i] * norm(area);
                 });
    }
  }

  template <class Number>
  void WaterModel::multiply(const std::vector<Number> &phi, std::vector<Number> &K_phi) const
  {
    K_phi.resize(phi.size());
#pragma omp parallel for schedule(static)
    for (int i = 0; i < static_cast<int>(phi.size()); ++i)
    {
      Number sum = 0.;
      for (std::size_t k = start[i]; k < start[i + 1]; ++k)
        sum += value[k] * phi[column[k]];
      K_phi[i] = sum;
    }
  }

  template void WaterModel::multiply(const std::vector<double> &, std::vector<double> &) const;

  template <class Number>
  std::vector<Number> WaterModel::solve_diagonal_plus(const std::vector<Number> &diagonal,
                                                      std::vector<Number>        r) const
  {
    const unsigned int  n = n_nodes();
    std::vector<Number> phi(n, 0.), z(n, 0.), p, Ap, inverse(n, 0.);
    for (unsigned int i = 0; i < n; ++i)
      for (std::size_t k = start[i]; k < start[i + 1] && !at_surface[i]; ++k)
        if (column[k] == i)
          inverse[i] = 1. / (value[k] + diagonal[i]);
    double     size = 0.;
    const auto precondition = [&]
    {
      Number product = 0.;
      size = 0.;
      for (unsigned int i = 0; i < n; ++i)
      {
        r[i] = at_surface[i] ? Number(0.) : r[i];
        z[i] = inverse[i] * r[i];
        product += r[i] * z[i];
        size += std::abs(r[i]) * std::abs(z[i]);
      }
      return product;
    };
    Number       rz = precondition();
    const double first = size;
    p = z;
    constexpr unsigned int most = 5000;
    for (unsigned int iteration = 0; size > 1e-24 * first; ++iteration)
    {
      if (iteration == most)
        throw ComputationError("The potential of the water did not converge in " + std::to_string(most) +
                               " iterations. Increase Reservoir/Element size.");
      multiply(p, Ap);
      Number pAp = 0.;
      for (unsigned int i = 0; i < n; ++i)
      {
        Ap[i] += diagonal[i] * p[i];
        pAp += p[i] * Ap[i];
      }
      const Number step = rz / pAp;
      for (unsigned int i = 0; i < n; ++i)
      {
        phi[i] += step * p[i];
        r[i] -= step * Ap[i];
      }
      const Number before = rz;
      rz = precondition();
      for (unsigned int i = 0; i < n; ++i)
        p[i] = z[i] + rz / before * p[i];
    }
    return phi;
  }

  std::vector<double> WaterModel::solve(const std::vector<double> &source) const
  {
    return solve_diagonal_plus(std::vector<double>(n_nodes(), 0.), source);
  }

  std::vector<std::complex<double>> WaterModel::solve(const std::complex<double>               s,
                                                      const std::vector<std::complex<double>> &source) const
  {
    std::vector<std::complex<double>> diagonal;
    for (unsigned int i = 0; i < n_nodes(); ++i)
      diagonal.push_back(s * (bed_damping[i] + end_damping[i]) + s * s * mass[i]);
    return solve_diagonal_plus(diagonal, source);
  }
} // namespace Voussoir
