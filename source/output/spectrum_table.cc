// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/motion/response_spectrum.h>
#include <voussoir/output/spectrum_table.h>

#include <cmath>

namespace Voussoir
{
  Table spectrum_table(const GroundMotion &motion, const MotionParameters &parameters)
  {
    const std::vector<double> periods = logarithmic_periods(.03, 5., 40);
    Table                     table;
    table.rows.resize(periods.size());
    const auto add = [&table](const std::string &name, const std::vector<double> &values)
    {
      table.columns.push_back(name);
      for (std::size_t i = 0; i < values.size(); ++i)
        table.rows[i].push_back(values[i]);
    };
    add("period", periods);
    add("damping", std::vector<double>(periods.size(), parameters.damping));
    for (unsigned int d = 0; d < 3; ++d)
      add(std::string("spectrum_") + "xyz"[d],
          pseudo_acceleration_spectrum(motion.component(d), motion.dt, periods, parameters.damping));
    table.columns.insert(table.columns.end(), {"rotd50", "rotd100"});
    for (std::size_t i = 0; i < periods.size(); ++i)
      for (const double value : rotated_response(motion.component(0), motion.component(1), motion.dt,
                                                 periods[i], parameters.damping))
        table.rows[i].push_back(value);
    for (unsigned int d = 0; d < 3 && parameters.has_target(); ++d)
    {
      std::vector<double> target;
      for (const double period : periods)
        target.push_back(std::abs(parameters.factor * parameters.scale[d]) * parameters.target(d, period));
      add(std::string("target_") + "xyz"[d], target);
    }
    return table;
  }
} // namespace Voussoir
