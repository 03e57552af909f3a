// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/internal_error.h>
#include <voussoir/base/log.h>
#include <voussoir/motion/ground_motion.h>
#include <voussoir/motion/response_spectrum.h>
#include <voussoir/output/floor_accelerations.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

namespace Voussoir
{
  namespace
  {
    std::vector<double> column(const Table &table, const std::string &name)
    {
      const auto found = std::find(table.columns.begin(), table.columns.end(), name);
      ensure(found != table.columns.end(), "A column of the floor accelerations is missing.");
      const std::size_t   k = found - table.columns.begin();
      std::vector<double> values;
      for (const auto &row : table.rows)
        values.push_back(row[k]);
      return values;
    }

    std::array<std::vector<double>, 3> components(const Table &table, const std::string &name)
    {
      return {{column(table, name + "_x"), column(table, name + "_y"), column(table, name + "_z")}};
    }

    /** Returns the index of the largest absolute value. @p a is not empty. */
    std::size_t peak(const std::vector<double> &a)
    {
      const auto is_smaller = [](const double p, const double q) { return std::abs(p) < std::abs(q); };
      return std::max_element(a.begin(), a.end(), is_smaller) - a.begin();
    }

    /** Returns the ratio of the largest absolute values of @p a and @p ground; NaN if the ground is at rest. */
    double amplification(const std::vector<double> &a, const std::vector<double> &ground)
    {
      const double largest = std::abs(ground[peak(ground)]);
      return largest > 0. ? std::abs(a[peak(a)]) / largest : std::numeric_limits<double>::quiet_NaN();
    }
  } // namespace

  FloorAccelerations::FloorAccelerations(const Table &history, const std::vector<std::string> &names)
      : time(column(history, "time")), ground(components(history, "base_acceleration"))
  {
    for (const std::string &name : names)
      points.push_back({name, components(history, name + "_acceleration")});
    for (std::vector<double> &a : ground)
    {
      for (std::size_t k = a.size(); k-- > 1;)
        a[k] = .5 * (a[k - 1] + a[k]);
      a[0] = 0.; // as for the points: no step ends at time 0
    }
  }

  Table FloorAccelerations::spectra(const double dt, const double damping) const
  {
    const std::vector<double>        periods = logarithmic_periods(.03, 5., 40);
    std::vector<std::vector<double>> columns = {periods, std::vector<double>(periods.size(), damping)};
    Table                            table;
    table.columns = {"period", "damping"};
    const auto add = [&](const std::string &name, const Components &acceleration)
    {
      for (unsigned int d = 0; d < 3; ++d)
      {
        table.columns.push_back(name + "_" + "xyz"[d]);
        columns.push_back(pseudo_acceleration_spectrum(acceleration[d], dt, periods, damping));
      }
    };
    for (const Point &point : points)
      add(point.name, point.acceleration);
    add("ground", ground);
    for (std::size_t i = 0; i < periods.size(); ++i)
    {
      table.rows.emplace_back();
      for (const std::vector<double> &values : columns)
        table.rows.back().push_back(values[i]);
    }
    return table;
  }

  Json FloorAccelerations::json() const
  {
    Json       result;
    const auto add = [&](const std::string &name, const Components &acceleration, const bool is_ground)
    {
      Json of_point;
      for (unsigned int d = 0; d < 3; ++d)
      {
        const std::vector<double> &a = acceleration[d];
        const std::size_t          k = peak(a);
        Json                       largest;
        largest.add("value", std::abs(a[k])).add("time", time[k]);
        if (!is_ground)
          largest.add("amplification", amplification(a, ground[d]));
        of_point.add(std::string(1, "xyz"[d]), largest);
      }
      result.add(name, of_point);
    };
    for (const Point &point : points)
      add(point.name, point.acceleration, false);
    add("ground", ground, true);
    return result;
  }

  std::string FloorAccelerations::in_words() const
  {
    std::string values, ratios;
    for (unsigned int d = 0; d < 3; ++d)
    {
      const std::vector<double> &a = points[0].acceleration[d];
      const double               ratio = amplification(a, ground[d]);
      char                       text[40];
      std::snprintf(text, sizeof(text), " %.3f", std::abs(a[peak(a)]) / standard_gravity);
      values += text;
      std::snprintf(text, sizeof(text), " %.2f", ratio);
      ratios += std::isnan(ratio) ? " -" : text;
    }
    return "largest absolute acceleration x, y, z:" + values + " g, amplification" + ratios;
  }
} // namespace Voussoir
