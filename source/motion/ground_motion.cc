// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/output_file.h>
#include <voussoir/base/units.h>
#include <voussoir/motion/ground_motion.h>

#include <iomanip>

namespace Voussoir
{
  double GroundMotion::duration() const
  {
    return acceleration.empty() ? 0. : dt * (acceleration.size() - 1);
  }

  std::array<double, 3> GroundMotion::sample(const std::size_t k) const
  {
    return k < acceleration.size() ? acceleration[k] : std::array<double, 3>{};
  }

  double GroundMotion::end_of_rest(const std::size_t part) const
  {
    return part + 1 < parts.size() ? parts[part + 1].begin : duration();
  }

  std::vector<double> GroundMotion::component(unsigned int direction) const
  {
    std::vector<double> a;
    for (const auto &sample : acceleration)
      a.push_back(sample[direction]);
    return a;
  }

  GroundMotion GroundMotion::scaled(const double factor) const
  {
    GroundMotion result = *this;
    const auto   scale = [factor](std::vector<std::array<double, 3>> &acceleration)
    {
      for (auto &a : acceleration)
        for (double &component : a)
          component *= factor;
    };
    scale(result.acceleration);
    for (MotionStation &station : result.stations)
      scale(station.acceleration);
    return result;
  }

  namespace
  {
    /** Returns samples at intervals that are @p n times smaller, by linear interpolation. */
    std::vector<std::array<double, 3>> refined_samples(const std::vector<std::array<double, 3>> &samples,
                                                       const unsigned int                        n)
    {
      std::vector<std::array<double, 3>> result;
      for (std::size_t k = 0; k + 1 < samples.size(); ++k)
        for (unsigned int i = 0; i < n; ++i)
        {
          std::array<double, 3> a;
          for (unsigned int c = 0; c < 3; ++c)
            a[c] = samples[k][c] + double(i) / n * (samples[k + 1][c] - samples[k][c]);
          result.push_back(a);
        }
      result.push_back(samples.back());
      return result;
    }
  } // namespace

  GroundMotion GroundMotion::refined(const unsigned int n) const
  {
    if (n == 1 || acceleration.empty())
      return *this;
    GroundMotion result = *this;
    result.dt = dt / n;
    result.acceleration = refined_samples(acceleration, n);
    for (MotionStation &station : result.stations)
      station.acceleration = refined_samples(station.acceleration, n);
    return result;
  }

  GroundMotion GroundMotion::relative(const MotionStation &station) const
  {
    GroundMotion result;
    result.dt = dt;
    result.acceleration = station.acceleration;
    for (std::size_t k = 0; k < acceleration.size(); ++k)
      for (unsigned int c = 0; c < 3; ++c)
        result.acceleration[k][c] -= acceleration[k][c];
    return result;
  }

  MotionIntegrals GroundMotion::integrated() const
  {
    MotionIntegrals       result;
    std::array<double, 3> v{}, u{};
    for (std::size_t k = 0; k < acceleration.size(); ++k)
    {
      for (unsigned int c = 0; k > 0 && c < 3; ++c)
      {
        const double a = acceleration[k - 1][c], b = acceleration[k][c];
        u[c] += dt * v[c] + dt * dt * (a / 3. + b / 6.);
        v[c] += .5 * dt * (a + b);
      }
      result.velocity.push_back(v);
      result.displacement.push_back(u);
    }
    return result;
  }

  double unit_of_acceleration(const std::string &unit)
  {
    return number_in_unit("1 " + unit, "m/s^2", "Motion/Unit");
  }

  void write_motion(const GroundMotion &motion, const std::string &file)
  {
    OutputFile out(file);
    out << "t,a_x,a_y,a_z\n" << std::setprecision(12);
    for (std::size_t k = 0; k < motion.acceleration.size(); ++k)
    {
      out << k * motion.dt;
      for (const double a : motion.acceleration[k])
        out << ',' << a;
      out << '\n';
    }
    out.check();
  }
} // namespace Voussoir
