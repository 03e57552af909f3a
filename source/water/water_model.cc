// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/error.h>
#include <voussoir/water/water_model.h>

#include <algorithm>
#include <cmath>

namespace Voussoir
{
  namespace
  {
    /** Matrices of an element. */
    struct Cell
    {
      std::array<std::array<double, 8>, 8> K{};
      std::array<double, 8>                M{};
      double                               volume = 0.;
    };

    /** Returns the matrices for density and sound speed 1. @p x: corners [m]. */
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

    /** Restricts the matrices of a cell to motions in the plane x, z, as make_plane() in the rock. */
    void make_plane(const std::array<Vector3, 8> &x, Cell &cell)
    {
      const Cell full = cell;
      for (unsigned int i = 0; i < 8; ++i)
      {
        const auto across = [&](const unsigned int j)
        {
          const auto distance = [&](const unsigned int k)
          { return k == j ? 1e300 : std::hypot(x[k][0] - x[j][0], x[k][2] - x[j][2]); };
          unsigned int nearest = 0;
          for (unsigned int k = 1; k < 8; ++k)
            nearest = distance(k) < distance(nearest) ? k : nearest;
          return nearest;
        };
        const unsigned int p = across(i);
        for (unsigned int j = 0; j < 8; ++j)
          cell.K[i][j] =
              .25 * ((full.K[i][j] + full.K[p][across(j)]) + (full.K[i][across(j)] + full.K[p][j]));
        const double spring = .5 * cell.K[i][i];
        cell.K[i][i] += spring;
        cell.K[i][p] -= spring;
      }
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
  } // namespace

  WaterModel::WaterModel(const WaterMesh &mesh, const WaterProperties &properties, const double dt)
      : density(properties.density), at_surface(mesh.at_surface)
  {
    make_pattern(mesh);
    assemble_cells(mesh, properties, dt);
    add_bed(mesh, properties);
    add_end(mesh, properties);
  }

  /** Creates the sparsity pattern of K. */
  void WaterModel::make_pattern(const WaterMesh &mesh)
  {
    std::vector<std::vector<unsigned int>> rows(mesh.points.size());
    for (const WaterMesh::Cell &nodes : mesh.cells)
      for (const unsigned int i : nodes)
        rows[i].insert(rows[i].end(), nodes.begin(), nodes.end());
    start = {0};
    for (auto &row : rows)
    {
      std::sort(row.begin(), row.end());
      column.insert(column.end(), row.begin(), std::unique(row.begin(), row.end()));
      start.push_back(column.size());
    }
    value.assign(column.size(), 0.);
  }

  void WaterModel::assemble_cells(const WaterMesh &mesh, const WaterProperties &properties, const double dt)
  {
    const double rho = properties.density, c = properties.sound_speed;
    mass.assign(mesh.points.size(), 0.);
    std::vector<double> unscaled(mass.size(), 0.);
    double              fastest = 0.;
    for (const WaterMesh::Cell &nodes : mesh.cells)
    {
      std::array<Vector3, 8> x;
      for (unsigned int i = 0; i < 8; ++i)
        x[i] = mesh.points[nodes[i]];
      Cell cell = cell_matrices(x);
      if (mesh.is_slice)
        make_plane(x, cell);
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
    for (std::size_t i = 0; i < mass.size(); ++i)
      end_damping.push_back(c / properties.depth * std::pow(mesh.layer[i], 2) * unscaled[i]);
  }

  void WaterModel::add_bed(const WaterMesh &mesh, const WaterProperties &properties)
  {
    const double rho = properties.density,
                 q = (1. - properties.reflection) / (1. + properties.reflection) / properties.sound_speed;
    bed_damping.assign(mass.size(), 0.);
    ground.assign(mass.size(), Vector3{});
    for (const WaterMesh::Face &nodes : mesh.bed)
      for_points(corners(mesh.points, nodes),
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

  void WaterModel::add_end(const WaterMesh &mesh, const WaterProperties &properties)
  {
    for (const WaterMesh::Face &nodes : mesh.end)
      for_points(corners(mesh.points, nodes),
                 [&](const Vector3 &area, const std::array<double, 4> &N)
                 {
                   for (unsigned int i = 0; i < 4; ++i)
                     end_damping[nodes[i]] += properties.density / properties.sound_speed * N[i] * norm(area);
                 });
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
                               " iterations. Increase the size of the water elements.");
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
