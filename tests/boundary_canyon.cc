// SPDX-License-Identifier: GPL-3.0-or-later
// Semicircular canyon under SH waves at 0, 30, 60 and 85 degrees against the exact series (Trifunac 1973, Bull.
// Seismol. Soc. Am. 63, 1267-1281).

#include "../benchmarks/boundary_canyon.h"
#include "column.h"

#include <voussoir/rock/arrival.h>
#include <voussoir/solid/critical_step.h>

namespace
{
  using namespace Benchmarks;

  /** Derivative of a cylinder function f_n from f_(n-1) and f_(n+1). */
  template <class Function> double derivative(const Function &f, const unsigned int n, const double x)
  {
    return n == 0 ? -f(1, x) : .5 * (f(n - 1, x) - f(n + 1, x));
  }

  /** Amplitude of the antiplane displacement at a place over that of the incident wave. The wave travels in
   * the direction of x.
   * @p k: wave number times the radius 1; depth is positive downward. */
  double exact(const double k, const double angle, const double x, const double depth)
  {
    const auto   J = [](const unsigned int n, const double r) { return std::cyl_bessel_j(double(n), r); };
    const auto   Y = [](const unsigned int n, const double r) { return std::cyl_neumann(double(n), r); };
    const double r = std::hypot(x, depth), phi = std::atan2(depth, x), to_surface = pi / 2. - angle;
    Complex w = 2. * std::cos(k * depth * std::cos(angle)) * std::exp(Complex(0., k * x * std::sin(angle)));
    for (unsigned int n = 0; n <= k + 22.; ++n)
    {
      const Complex factor = (n == 0 ? 1. : 2.) * std::pow(Complex(0., 1.), int(n)) * derivative(J, n, k) /
                             Complex(derivative(J, n, k), derivative(Y, n, k));
      w -= factor * Complex(J(n, k * r), Y(n, k * r)) *
           (std::cos(n * (phi + to_surface)) + std::cos(n * (phi - to_surface)));
    }
    return std::abs(w);
  }

  /** The half canyon for x > 0 and its mirror image. */
  HexMesh whole_canyon(const double h, const double size)
  {
    HexMesh                   mesh = CanyonMesh(h, size, true).mesh;
    const HexMesh             half = mesh;
    std::vector<unsigned int> image;
    for (const auto &p : half.nodes)
    {
      image.push_back(std::abs(p[0]) < 1e-9 ? image.size() : mesh.nodes.size());
      if (image.back() == mesh.nodes.size())
        mesh.nodes.push_back({{-p[0], p[1], p[2]}});
    }
    for (HexMesh::Cell cell : half.cells)
    {
      for (unsigned int &node : cell.nodes)
        node = image[node];
      for (unsigned int v = 0; v < 4; ++v)
        std::swap(cell.nodes[v], cell.nodes[v + 4]);
      mesh.cells.push_back(cell);
    }
    for (HexMesh::Face face : half.faces)
    {
      for (unsigned int &node : face.nodes)
        node = image[node];
      mesh.faces.push_back(face);
    }
    return mesh;
  }

  constexpr double frequencies[] = {.25, .5, 1., 2.}; ///< eta = 2 a over the wavelength

  /** Root mean square error of the amplitudes at wall and ground, over that of level ground, for each
   * frequency. */
  std::vector<double> errors(const double angle)
  {
    const HexMesh mesh = whole_canyon(.05, 3.);
    auto          p = parameters("mtf3", 1.);
    p.rock.nodal_everywhere = false; // Gauss points where the cells are bent
    p.rock.nodal_layers = 28;
    const RockModel model = make_rock_model(mesh, p.rock, tie_layer(mesh, 1));
    p.dt = .9 * critical_time_step(largest_frequency(model.stiffness, model.mass), {});
    PlaneWave sh;
    sh.type = PlaneWave::SH;
    sh.angle = angle * pi / 180.;
    p.incidence = timed(model, {{sh}, {}}, {});
    const double f0 = .5, t0 = 3.;
    const auto   n_steps = static_cast<unsigned int>(40. / p.dt);
    const auto   wave = [=](const double t) { return ricker(t, f0, t0); };
    const auto   region = make_region(model, p);
    shake(
        *region, model, p,
        [=](const double t) -> Vector3 {
          return {{0., wave(t), 0.}};
        },
        n_steps);
    std::vector<unsigned int> nodes, fixed;
    for (unsigned int i = 0; i < model.points.size(); ++i)
    {
      const Vector3 &x = model.points[i];
      fixed.insert(fixed.end(), {3 * i, 3 * i + 2});
      if ((std::abs(x[2]) < 1e-9 || std::abs(std::hypot(x[0], x[2]) - 1.) < 1e-9) && std::abs(x[0]) < 2.5)
        nodes.push_back(i);
    }
    region->fix(fixed); // antiplane
    std::vector<std::vector<Complex>> sum(4, std::vector<Complex>(nodes.size()));
    Complex                           incident[4] = {};
    for (unsigned int step = 1; step <= n_steps; ++step)
    {
      region->advance();
      for (unsigned int e = 0; e < 4; ++e)
      {
        const Complex phase = std::exp(Complex(0., -pi * frequencies[e] * step * p.dt));
        incident[e] += phase * wave(step * p.dt);
        for (std::size_t i = 0; i < nodes.size(); ++i)
          sum[e][i] += phase * region->displacement()[3 * std::size_t(nodes[i]) + 1];
      }
    }
    std::vector<double> result;
    for (unsigned int e = 0; e < 4; ++e)
    {
      double square = 0.;
      for (std::size_t i = 0; i < nodes.size(); ++i)
      {
        const Vector3 &x = model.points[nodes[i]];
        square += std::pow(
            std::abs(sum[e][i] / incident[e]) - exact(pi * frequencies[e], sh.angle, x[0], -x[2]), 2);
      }
      result.push_back(std::sqrt(square / nodes.size()) / 2.);
    }
    return result;
  }

  void canyon()
  {
    using Columns::below;
    for (const double angle : {0., 30., 60., 85.})
    {
      const std::vector<double> found = errors(angle);
      for (unsigned int e = 0; e < 4; ++e)
        below("canyon, SH at " + std::to_string(int(angle)) + " degrees, eta " +
                  std::to_string(frequencies[e]).substr(0, 4) + ": amplitudes, rms error",
              found[e], .015);
    }
  }
} // namespace

int main()
{
  return Columns::run_all({canyon});
}
