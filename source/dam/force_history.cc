// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/error.h>
#include <voussoir/base/number_text.h>
#include <voussoir/dam/force_history.h>
#include <voussoir/dam/nodal_forces.h>
#include <voussoir/dam/scene.h>
#include <voussoir/motion/motion_record.h>

#include <algorithm>
#include <filesystem>
#include <regex>

namespace Voussoir
{
  namespace
  {
    void read(const ForceHistory &history, const std::string &directory, ForceInTime &force)
    {
      const std::string entry = "Entry \"Loads/Force history\": ",
                        file = (std::filesystem::path(directory) / history.file).string();
      std::error_code error;
      if (!std::filesystem::is_regular_file(file, error))
        throw InputError(entry + "the file " + file +
                         " cannot be read. Its path is relative to the directory of the scene file.");
      const NumberTable table = read_number_table(read_record_text(file));
      const std::regex  others("(^|[^a-z])(kN|MN|GN|t|tf|kgf|lbf?|kips?)[)\\]]?\\s*$", std::regex::icase);
      for (std::size_t k = 0; k < table.headings.size(); ++k)
        if (const Heading &heading = table.headings[k];
            k == 0 ? !heading.unit.empty() && heading.unit != "s"
                   : heading.quantity == 't' || std::regex_search(heading.text, others))
          throw InputError(entry + file + ": the column \"" + heading.text +
                           "\" must be the time in s or the force in N, in this sequence. Convert the file.");
      for (std::size_t i = 0; i < table.rows.size(); ++i)
      {
        const std::vector<double> &row = table.rows[i];
        const std::string          where = entry + file + ", line " + std::to_string(table.lines[i]);
        if (row.size() != 2)
          throw InputError(where + " has " + std::to_string(row.size()) +
                           " numbers. Write two: the time [s] and the force [N].");
        if (row[0] < (i == 0 ? 0. : force.time.back()))
          throw InputError(where + " has the time " + number_text(row[0]) +
                           " s. The times must not be negative, and must not decrease from line to line.");
        force.time.push_back(row[0]);
        force.value.push_back(row[1]);
      }
      if (table.rows.empty())
        throw InputError(entry + file + " has no numbers. Write lines with the time [s] and the force [N].");
    }
  } // namespace

  double ForceInTime::at(const double t) const
  {
    const std::size_t k = std::upper_bound(time.begin(), time.end(), t) - time.begin(); // first row after t
    if (k == 0 || k == time.size())
      return k == 0 ? value.front() : value.back();
    return value[k - 1] + (t - time[k - 1]) / (time[k] - time[k - 1]) * (value[k] - value[k - 1]);
  }

  std::vector<ForceInTime> forces_in_time(const Scene &scene, const SolidModel &model,
                                          const Structure &structure, const double factor)
  {
    std::vector<ForceInTime> forces;
    for (const ForceHistory &history : scene.loads.force_histories())
    {
      ForceInTime force;
      read(history, scene.directory, force);
      force.pattern.assign(3 * std::size_t(structure.n_nodes()), 0.);
      add_point_force(model, "Entry \"Loads/Force history\": force \"" + history.name + "\"",
                      {history.place, history.direction}, force.pattern);
      for (double &f : force.value)
        f *= factor;
      structure.remove_held_forces(force.pattern);
      forces.push_back(force);
    }
    return forces;
  }
} // namespace Voussoir
