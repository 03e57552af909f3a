// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/error.h>
#include <voussoir/base/number_text.h>
#include <voussoir/foundation/base_motion.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace Voussoir
{
  namespace
  {
    /** Returns the lowest and the highest z [m]. */
    std::pair<double, double> heights(const std::vector<Vector3> &places)
    {
      std::pair<double, double> range(INFINITY, -INFINITY);
      for (const Vector3 &place : places)
        range = {std::min(range.first, place[2]), std::max(range.second, place[2])};
      return range;
    }
  } // namespace

  void BaseMotion::check(const GroundMotion &motion, const std::vector<Vector3> &places)
  {
    const auto [low, high] = heights(places);
    std::map<std::pair<bool, double>, unsigned int> count;
    for (const MotionStation &station : motion.stations)
    {
      const std::string name = "Motion/Abutments: the station \"" +
                               std::string(station.is_left ? "left " : "right ") +
                               number_text(station.height) + "\" ";
      if (++count[{station.is_left, station.height}] > 1)
        throw InputError(name + "is given twice. Remove one, or correct its height.");
      if (station.height < low - 1e-6 * (high - low) || station.height > 2. * high - low)
        throw InputError(name +
                         "is not at the base of the dam, whose nodes are from z = " + number_text(low) +
                         " to " + number_text(high) + " m. Give the height in the axes of the mesh.");
    }
  }

  BaseMotion::BaseMotion(const GroundMotion &motion, const std::vector<Vector3> &places) : dt(motion.dt)
  {
    std::map<std::pair<bool, double>, unsigned int> stations; // by bank and height
    for (const MotionStation &station : motion.stations)
    {
      stations[{station.is_left, station.height}] = relative.size();
      relative.push_back(motion.relative(station).integrated());
    }
    const double bottom = heights(places).first;
    double       sum = 0., n = 0.;
    for (const Vector3 &place : places)
      if (place[2] < bottom + 1e-3)
        sum += place[1], n += 1.;
    for (const Vector3 &place : places)
    {
      const bool is_left = place[1] > sum / n;
      Shares     of_place;
      double     below = bottom;
      for (const auto &[where, number] : stations)
      {
        if (where.first != is_left)
          continue;
        const double share =
            place[2] >= where.second ? 1. : std::max(0., (place[2] - below) / (where.second - below));
        if (share > 0.)
          of_place = {{of_place.station[1], number}, {of_place.share[1] * (1. - share), share}};
        below = where.second;
      }
      shares.push_back(of_place);
    }
  }

  Unknowns BaseMotion::at(const double                       time,
                          std::vector<std::array<double, 3>> MotionIntegrals::*quantity) const
  {
    std::vector<Vector3> of_station;
    for (const MotionIntegrals &station : relative)
    {
      const auto       &values = station.*quantity;
      const double      samples = std::clamp(time / dt, 0., values.size() - 1.);
      const std::size_t k = std::min<std::size_t>(samples, values.size() - 2);
      Vector3           value;
      for (unsigned int c = 0; c < 3; ++c)
        value[c] = values[k][c] + (samples - k) * (values[k + 1][c] - values[k][c]);
      of_station.push_back(value);
    }
    Unknowns result(3 * shares.size(), 0.);
    for (std::size_t i = 0; i < shares.size(); ++i)
      for (unsigned int n = 0; n < 2; ++n)
        for (unsigned int c = 0; c < 3 && shares[i].share[n] != 0.; ++c)
          result[3 * i + c] += shares[i].share[n] * of_station[shares[i].station[n]][c];
    return result;
  }
} // namespace Voussoir
