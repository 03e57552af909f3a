// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/mesh/centre_line.h>

#include <boost/math/special_functions/ellint_2.hpp>

#include <algorithm>
#include <cmath>

namespace Voussoir
{
  namespace
  {
    constexpr double right_angle = 1.57079632679489662, largest_angle = right_angle * 80 / 90; ///< [rad]

    /** Returns the length of an ellipse from the crown to the parametric angle @p theta, y = a sin(theta),
     * x = b (1 - cos(theta)) [m]. */
    double ellipse_length(const double a, const double b, const double theta)
    {
      using boost::math::ellint_2;
      if (b <= a)
        return a * ellint_2(std::sqrt(1 - b * b / (a * a)), theta);
      const double k = std::sqrt(1 - a * a / (b * b));
      return b * (ellint_2(k, right_angle) - ellint_2(k, right_angle - theta));
    }

    CentreLine::Place on_ellipse(const double a, const double b, const double y)
    {
      const double theta = std::asin(y / a);
      return {b * (1 - std::cos(theta)), b / a * std::tan(theta), ellipse_length(a, b, theta)};
    }

    CentreLine::Place on_circles(const CentreLine &line, const double y)
    {
      const double R = line.radius, r = line.side_radius, phi = line.angle;
      if (y <= R * std::sin(phi))
      {
        const double angle = std::asin(y / R);
        return {R * (1 - std::cos(angle)), std::tan(angle), R * angle};
      }
      const double angle = std::asin((y - (R - r) * std::sin(phi)) / r);
      return {(R - r) * (1 - std::cos(phi)) + r * (1 - std::cos(angle)), std::tan(angle),
              R * phi + r * (angle - phi)};
    }
  } // namespace

  CentreLine::Place CentreLine::at(const double y) const
  {
    if (kind == Kind::parabola)
    {
      const double t = y / radius;
      return {y * y / (2 * radius), t, radius / 2 * (t * std::hypot(1, t) + std::asinh(t))};
    }
    const double b = semi_axis * semi_axis / radius;
    const double tan_theta = std::tan(largest_angle) * semi_axis / b;
    const double limit = kind == Kind::ellipse ? semi_axis * tan_theta / std::hypot(1, tan_theta)
                                               : (radius - side_radius) * std::sin(angle) +
                                                     side_radius * std::sin(largest_angle);
    const double within = std::min(y, limit), beyond = y - within;
    const Place  place = kind == Kind::ellipse ? on_ellipse(semi_axis, b, within) : on_circles(*this, within);
    return {place.x + place.slope * beyond, place.slope, place.length + std::hypot(1, place.slope) * beyond};
  }

  std::array<double, 3> HalfArc::point(const double y, const double z, const double w) const
  {
    const CentreLine::Place place = line.at(y);
    const double            share = place.length / length;
    const double            T = crown_thickness + (abutment_thickness - crown_thickness) * share * share;
    const double            q = std::hypot(1, place.slope);
    return {crown + place.x + w * T / (2 * q), y - w * T * place.slope / (2 * q), z};
  }
} // namespace Voussoir
