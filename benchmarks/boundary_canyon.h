// SPDX-License-Identifier: GPL-3.0-or-later
// Semicircular and hemispherical canyons under vertical waves, for benchmarks/boundary.cc.

#ifndef voussoir_benchmarks_boundary_canyon_h
#define voussoir_benchmarks_boundary_canyon_h

#include "../tests/box.h"

#include <voussoir/rock/sections.h>
#include <voussoir/rock/transmitting_boundary.h>
#include <voussoir/rock/viscous_boundary.h>
#include <voussoir/solid/critical_step.h>

#include <complex>
#include <map>

namespace Benchmarks
{
  using namespace Boxes;
  using Complex = std::complex<double>;

  inline const double c_p = std::sqrt(3.), c_s = 1.; // Poisson's ratio 0.25

  inline RockRegionParameters parameters(const std::string &boundary, const double dt)
  {
    RockRegionParameters p;
    p.rock.materials[rock] = unit_rock();
    p.rock.nodal_everywhere = true;
    p.boundary = boundary;
    p.free_field = "columns";
    p.dt = dt;
    return p;
  }

  inline TransmittingFormula formula(const std::vector<double> &speeds, const double gamma_speed)
  {
    TransmittingFormula f;
    f.uniform_distance = true;
    for (const double c : speeds)
      f.factors.push_back({0., c, 0., gamma_speed});
    return f;
  }

  /** Makes a transmitting boundary instead of one with a name. */
  inline auto maker(const TransmittingFormula &formula)
  {
    return [formula] { return std::make_unique<TransmittingBoundary>(formula); };
  }

  /** Springs and dashpots with the factors of two dimensions, 1 and 1/2. */
  inline std::unique_ptr<ArtificialBoundary> plane_viscous_spring()
  {
    return std::make_unique<ViscousBoundary>(1., .5);
  }

  /** A regular grid with the cells about a circular or spherical canyon bent to it. Built cell by cell. */
  class CanyonMesh
  {
  public:
    HexMesh                 mesh;
    static constexpr double bent = 1.6; ///< half-width and depth of the bent part

    /** Half-space z < 0, cells of size @p h, the canyon of radius 1 about the origin; x from 0 to @p size,
     * and
     * @p plane: one layer in y, else y like x. */
    CanyonMesh(const double h, const double size, const bool plane) : h(h), plane(plane)
    {
      block = h * std::round(bent / h);
      const int n = std::lround(size / h), b = std::lround(block / h);
      const int layers = std::lround(.7 / h + 1e-6); // nodes of h/2 include those of h
      for (int k = -n; k < 0; ++k)
        for (int j = 0; j < (plane ? 1 : n); ++j)
          for (int i = 0; i < n; ++i)
          {
            if (k < -b || (!plane && j >= b) || i >= b)
            {
              add(
                  [&](const int di, const int dj, const int dk) {
                    return Vector3{{(i + di) * h, (j + dj) * h, (k + dk) * h}};
                  });
              artificial(i, j, k, n);
              continue;
            }
            if (i == b - 1)
              shell(layers, i + 1, j, k, 0);
            if (!plane && j == b - 1)
              shell(layers, i, j + 1, k, 1);
            if (k == -b)
              shell(layers, i, j, k, 2);
          }
    }

  private:
    const double                                h;
    const bool                                  plane;
    double                                      block;
    std::map<std::array<long, 3>, unsigned int> number;

    unsigned int node(const Vector3 &p)
    {
      const std::array<long, 3> key = {std::lround(p[0] * 1e6), std::lround(p[1] * 1e6),
                                       std::lround(p[2] * 1e6)};
      const auto                found = number.try_emplace(key, mesh.nodes.size());
      if (found.second)
        mesh.nodes.push_back(p);
      return found.first->second;
    }

    void add(const std::function<Vector3(int, int, int)> &place)
    {
      HexMesh::Cell cell{{}, rock};
      for (unsigned int v = 0; v < 8; ++v)
        cell.nodes[v] = node(place(v % 4 == 1 || v % 4 == 2, v % 4 > 1, v > 3));
      if (min_jacobian(mesh, cell) < 0.)
        for (unsigned int v = 0; v < 4; ++v)
          std::swap(cell.nodes[v], cell.nodes[v + 4]);
      mesh.cells.push_back(cell);
    }

    void artificial(const int i, const int j, const int k, const int n)
    {
      const auto face = [&](const unsigned int row)
      {
        HexMesh::Face f{{}, PhysicalId::artificial};
        for (unsigned int v = 0; v < 4; ++v)
          f.nodes[v] = mesh.cells.back().nodes[hex_faces[row][v]];
        mesh.faces.push_back(f);
      };
      if (i == n - 1)
        face(3);
      if (!plane && j == n - 1)
        face(4);
      if (k == -n)
        face(0);
    }

    /** Between the point @p p on the block and the canyon, @p t = 0 at the canyon. Equal angles. */
    Vector3 between(const Vector3 &p, const double t) const
    {
      Vector3 q;
      double  norm = 0.;
      for (unsigned int d = 0; d < 3; ++d)
      {
        q[d] = plane && d == 1 ? 0. : std::tan(pi / 4. * p[d] / block);
        norm += q[d] * q[d];
      }
      for (unsigned int d = 0; d < 3; ++d)
        q[d] = plane && d == 1 ? p[d] : q[d] / std::sqrt(norm) * (1. - t) + p[d] * t;
      return q;
    }

    /** Cells between the canyon and one face of the block's surface, normal to @p axis. */
    void shell(const int layers, const int i, const int j, const int k, const unsigned int axis)
    {
      for (int layer = 0; layer < layers; ++layer)
        add(
            [&](const int di, const int dj, const int dk)
            {
              const int     across = axis == 0 ? di : axis == 1 ? dj : dk;
              const Vector3 p = {{(i + (axis == 0 ? 0 : di)) * h, (j + (axis == 1 ? 0 : dj)) * h,
                                  (k + (axis == 2 ? 0 : dk)) * h}};
              return between(p, double(layer + across) / layers);
            });
    }
  };

  /** A canyon of radius 1 and the wave that rises under it. */
  struct Canyon
  {
    double       h, size;   ///< of the cells; half-width and depth of the box
    bool         plane;     ///< semicircular in x and z, or hemispherical
    unsigned int component; ///< 2: P; else S
    std::string  boundary;
    std::function<std::unique_ptr<ArtificialBoundary>()> maker = {}; ///< instead of the boundary's name
  };

  /** Amplitudes of the displacement of wall and ground over that of the incident wave. */
  struct Amplitudes
  {
    std::vector<Vector3>              place;
    std::vector<std::vector<Vector3>> value; ///< by frequency and place

    const Vector3 &at(const unsigned int frequency, const Vector3 &p) const
    {
      for (std::size_t i = 0; i < place.size(); ++i)
        if (std::abs(place[i][0] - p[0]) + std::abs(place[i][1] - p[1]) + std::abs(place[i][2] - p[2]) < 1e-6)
          return value[frequency][i];
      throw std::runtime_error("there is no such place");
    }
  };

  constexpr double etas[2] = {.5, 1.}; ///< 2 a / wavelength of S

  /** From the wave's arrival at the ground's level [a / c_s]; by then the motion has died away. */
  constexpr double canyon_window = 20.;

  /** Out of a box of that size nothing returns within the window: 2 size - 3 = c_p (window + 4). */
  constexpr double extended = 22.5;

  /** At both etas, in the nodes of wall and ground that are @p wanted. */
  inline Amplitudes amplitudes(const Canyon &canyon, const std::function<bool(const Vector3 &)> &wanted)
  {
    const CanyonMesh grid(canyon.h, canyon.size, canyon.plane);
    auto             p = parameters(canyon.boundary, 1.);
    p.rock.nodal_everywhere = false; // Gauss points where the cells are bent
    p.rock.nodal_layers = std::lround((canyon.size - CanyonMesh::bent) / canyon.h);
    const auto      master = canyon.plane ? tie_layer(grid.mesh, 1) : std::vector<unsigned int>();
    const RockModel model = make_rock_model(grid.mesh, p.rock, master);
    p.dt = .9 * critical_time_step(largest_frequency(model.stiffness, model.mass), {});
    const unsigned int axis = canyon.component;
    const double       f0 = .4, t0 = 3.5, arrival = (canyon.size + canyon.h) / (axis == 2 ? c_p : c_s);
    const auto         n_steps = static_cast<unsigned int>((arrival + t0 + canyon_window) / p.dt);
    const auto         wave = [=](const double t) { return ricker(t, f0, t0); };

    p.boundary_maker = canyon.maker;
    if (canyon.plane && canyon.boundary == "viscous-spring")
      p.boundary_maker = plane_viscous_spring;
    const auto region = make_region(model, p);
    shake(
        *region, model, p,
        [=](const double t)
        {
          Vector3 u{};
          u[axis] = wave(t);
          return u;
        },
        n_steps);

    std::vector<unsigned int> fixed, nodes;
    Amplitudes                result;
    for (unsigned int i = 0; i < model.points.size(); ++i)
    {
      const Vector3 &x = model.points[i];
      if (std::abs(x[0]) < 1e-9 && axis == 0) // antisymmetric about x = 0, else symmetric
        fixed.insert(fixed.end(), {3 * i + 1, 3 * i + 2});
      if (std::abs(x[0]) < 1e-9 && axis != 0)
        fixed.push_back(3 * i);
      if (!canyon.plane && std::abs(x[1]) < 1e-9) // symmetric
        fixed.push_back(3 * i + 1);
      const double r = std::sqrt(x[0] * x[0] + (canyon.plane ? 0. : x[1] * x[1]) + x[2] * x[2]);
      if ((std::abs(x[2]) < 1e-9 || std::abs(r - 1.) < 1e-9) && wanted(x))
      {
        nodes.push_back(i);
        result.place.push_back(x);
      }
    }
    region->fix(fixed);

    std::vector<std::vector<Complex>> sum(2, std::vector<Complex>(3 * nodes.size()));
    Complex                           incident[2] = {0., 0.};
    for (unsigned int step = 1; step <= n_steps; ++step)
    {
      region->advance();
      const double t = step * p.dt;
      for (unsigned int e = 0; e < 2; ++e)
      {
        const Complex phase = std::exp(Complex(0., -pi * etas[e] * c_s * t));
        for (std::size_t i = 0; i < nodes.size(); ++i)
          for (unsigned int c = 0; c < 3; ++c)
            sum[e][3 * i + c] += phase * region->displacement()[3 * std::size_t(nodes[i]) + c];
        incident[e] += phase * wave(t);
      }
    }
    for (unsigned int e = 0; e < 2; ++e)
    {
      result.value.emplace_back();
      for (std::size_t i = 0; i < nodes.size(); ++i)
      {
        Vector3 value;
        for (unsigned int c = 0; c < 3; ++c)
          value[c] = std::abs(sum[e][3 * i + c] / incident[e]);
        result.value.back().push_back(value);
      }
    }
    return result;
  }

  /** One component at the distance @p r from the middle on the x axis (@p axis = 0) or the y axis of a
   * hemispherical canyon: the polynomial through the four nearest nodes on the same side of the canyon's
   * edge, of the angle on the wall (whose nodes have about equal angles), of the distance on the ground. */
  inline double at_radius(const Amplitudes &run, const unsigned int frequency, const unsigned int component,
                          const unsigned int axis, const double r)
  {
    const bool wall = r < 1. - 1e-9;
    const auto coordinate = [wall](const double distance)
    { return wall ? std::asin(std::min(1., distance)) : distance; };
    std::vector<std::pair<double, double>> nodes; // coordinate less that of r, value
    for (std::size_t i = 0; i < run.place.size(); ++i)
    {
      const double distance = run.place[i][axis];
      if (std::abs(run.place[i][1 - axis]) < 1e-9 && (wall ? distance < 1. + 1e-9 : distance > 1. - 1e-9))
        nodes.emplace_back(coordinate(distance) - coordinate(r), run.value[frequency][i][component]);
    }
    if (nodes.size() < 4)
      throw std::runtime_error("there are not enough nodes on the axis");
    std::partial_sort(nodes.begin(), nodes.begin() + 4, nodes.end(),
                      [](const auto &a, const auto &b) { return std::abs(a.first) < std::abs(b.first); });
    double value = 0.;
    for (unsigned int i = 0; i < 4; ++i)
    {
      double weight = 1.;
      for (unsigned int j = 0; j < 4; ++j)
        if (j != i)
          weight *= nodes[j].first / (nodes[j].first - nodes[i].first);
      value += weight * nodes[i].second;
    }
    return value;
  }

  /** Rms over the places of the difference of all components, in per cent of the flat ground's 2. */
  inline double rms_difference(const unsigned int frequency, const Amplitudes &a, const Amplitudes &reference)
  {
    double sum = 0.;
    for (std::size_t i = 0; i < a.place.size(); ++i)
    {
      const Vector3 &expected = reference.at(frequency, a.place[i]);
      for (unsigned int c = 0; c < 3; ++c)
        sum += std::pow(a.value[frequency][i][c] - expected[c], 2);
    }
    return 100. * std::sqrt(sum / a.place.size()) / 2.;
  }
} // namespace Benchmarks

#endif
