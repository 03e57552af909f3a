// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/rock/arrival.h>
#include <voussoir/rock/free_field_column.h>

#include <algorithm>

namespace Voussoir
{
  double entrance(const RockColumn &column)
  {
    return 2. * column.z[0] - column.z[1];
  }

  namespace
  {
    const RockColumn &highest_column(const RockModel &model)
    {
      return *std::max_element(model.columns.begin(), model.columns.end(),
                               [](const RockColumn &a, const RockColumn &b)
                               { return a.z.back() < b.z.back(); });
    }

    double lowest_entrance(const RockModel &model)
    {
      double result = entrance(model.columns.front());
      for (const RockColumn &c : model.columns)
        result = std::min(result, entrance(c));
      return result;
    }

    /** Adds up the time through the layers of a column from the height @p at to @p z. @p slowness: of a layer
     * [s/m]. */
    template <class Slowness>
    double time_through(const RockColumn &column, double at, const double z, const Slowness &slowness)
    {
      double time = 0.;
      for (std::size_t k = 0; k < column.material.size() && at < z; ++k)
      {
        const double next = std::max(at, std::min(z, column.z[k + 1]));
        time += (next - at) * slowness(column.material[k]);
        at = next;
      }
      return time;
    }
  } // namespace

  Material half_space_of(const RockModel &model)
  {
    return highest_column(model).material.front();
  }

  Vector3 travel_times(const RockModel &model, const double z)
  {
    Vector3 times{};
    if (model.columns.empty())
      return times;
    for (unsigned int c = 0; c < 3; ++c)
      times[c] = time_through(highest_column(model), lowest_entrance(model), z,
                              [c](const Material &m) { return 1. / wave_speeds(m)[c]; });
    return times;
  }

  namespace
  {
    /** Returns the time that a wave needs from the first side of the rock to a place at the same height [s].
     * */
    double time_along(const RockModel &model, const PlaneWave &wave, const Vector3 &to)
    {
      double first = wave.along(to);
      for (const Vector3 &point : model.points)
        first = std::min(first, wave.along(point));
      return wave.slowness(half_space_of(model)) * (wave.along(to) - first);
    }
  } // namespace

  double travel_time(const RockModel &model, const PlaneWave &wave, const Vector3 &to)
  {
    const RockColumn &column = highest_column(model);
    const double      p = wave.slowness(half_space_of(model));
    return time_along(model, wave, to) + time_through(column, lowest_entrance(model), to[2],
                                                      [&](const Material &m)
                                                      { return wave.vertical_slowness(m, p); });
  }

  double arrival_time(const RockModel &model, const Incidence &incidence, const Vector3 &to)
  {
    double result = 0.;
    for (const PlaneWave &wave : incidence.waves)
      result = std::max(result, travel_time(model, wave, to));
    return result;
  }

  Incidence timed(const RockModel &model, const Incidence &incidence, const Vector3 &to)
  {
    if (incidence.is_vertical())
      return incidence;
    const double last = arrival_time(model, incidence, to);
    Incidence    result = incidence;
    for (PlaneWave &wave : result.waves)
      wave.delay += last - travel_time(model, wave, to) + time_along(model, wave, incidence.centre);
    return result;
  }
} // namespace Voussoir
