// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/motion/response_spectrum.h>
#include <voussoir/output/spectrum_table.h>

#include <cmath>

namespace Voussoir
{
  Table spectrum_table(const GroundMotion &motion, const MotionParameters &parameters)
  {
    const std::vector<double>        periods = logarithmic_periods(.03, 5., 40);
    std::vector<std::vector<double>> columns = {periods,
                                                std::vector<double>(periods.size(), parameters.damping)};
    Table                            table;
    table.columns = {"period", "damping"};
    for (unsigned int d = 0; d < 3; ++d)
    {
      table.columns.push_back(std::string("spectrum_") + "xyz"[d]);
      columns.push_back(
          pseudo_acceleration_spectrum(motion.component(d), motion.dt, periods, parameters.damping));
    }
    for (unsigned int d = 0; d < 3 && parameters.has_target(); ++d)
    {
      const double factor = std::abs(parameters.factor * parameters.scale[d]);
      table.columns.push_back(std::string("target_") + "xyz"[d]);
      columns.emplace_back();
      for (const double period : periods)
        columns.back().push_back(factor * parameters.target(d, period));
    }
    for (std::size_t i = 0; i < periods.size(); ++i)
    {
      table.rows.emplace_back();
      for (const std::vector<double> &column : columns)
        table.rows.back().push_back(column[i]);
    }
    return table;
  }
} // namespace Voussoir
