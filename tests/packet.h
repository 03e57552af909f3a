// SPDX-License-Identifier: GPL-3.0-or-later
// A packet of S waves in a bar that ends at a transmitting formula: what comes back.

#ifndef voussoir_tests_packet_h
#define voussoir_tests_packet_h

#include "box.h"

#include <voussoir/rock/transmitting_boundary.h>

namespace Packets
{
  using namespace Boxes;

  struct Case
  {
    std::vector<double>                speed; ///< over that of the wave
    double                             gamma = 0.;
    TransmittingFormula::Interpolation rule = TransmittingFormula::Interpolation::quadratic;
  };

  inline TransmittingFormula formula(const Case &c, const double dt)
  {
    TransmittingFormula f;
    f.interpolation = c.rule;
    for (const double speed : c.speed)
      f.factors.push_back({0., speed, 0., c.gamma / dt}); // distance 1 m, c_s = 1 m/s
    return f;
  }

  constexpr double dt = .5;

  /** Measured |R| of a packet of S waves in a bar along x, @p ppw points per wavelength, c_s dt/h = 0.5. */
  inline double reflected(const Case &c, const double ppw)
  {
    const double         width = 2. * ppw, k = 2. * pi / ppw, w = 2. / dt * std::asin(dt * std::sin(k / 2.));
    const double         group = std::cos(k / 2.) / std::cos(w * dt / 2.), x0 = 8. * width + 10.;
    const unsigned int   n = 2 * x0 + 20;
    const HexMesh        mesh = box({n, 1, 1}, {"x-"},
                                    [](const double i, const double j, const double l) -> Vector3 {
                               return {{i, j, l}};
                             });
    RockRegionParameters p;
    p.rock.materials[rock] = unit_rock(0.);
    p.dt = dt;
    std::vector<unsigned int> master(mesh.nodes.size());
    for (unsigned int i = 0; i < master.size(); ++i)
      master[i] = i % (n + 1);
    RockModel model = make_rock_model(mesh, p.rock, master);
    for (BoundaryLine &line : model.lines)
      line.distance = 1.;
    p.boundary_maker = [f = formula(c, dt)] { return std::make_unique<TransmittingBoundary>(f); };
    auto       region = make_region(model, p);
    const auto wave = [&](const double x, const double t)
    {
      const double place = (x - x0 + group * t) / width;
      return std::exp(-place * place / 2.) * std::cos(k * (x - x0) + w * t);
    };
    Unknowns u(3 * std::size_t(n + 1), 0.), v = u;
    double   incident = 0., left = 0.;
    for (unsigned int i = 0; i <= n; ++i)
    {
      u[3 * i + 1] = wave(i, 0.);
      v[3 * i + 1] = (wave(i, dt) - wave(i, 0.)) / dt;
      incident += u[3 * i + 1] * u[3 * i + 1];
    }
    region->start(u, v);
    for (unsigned int i = 0; i < static_cast<unsigned int>(2. * x0 / group / dt); ++i)
      region->advance();
    for (unsigned int i = 0; i <= n; ++i)
      left += std::pow(region->displacement()[3 * i + 1], 2);
    return std::sqrt(left / incident);
  }

} // namespace Packets

#endif
