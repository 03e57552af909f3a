// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/entries.h>
#include <voussoir/base/error.h>
#include <voussoir/base/number_text.h>
#include <voussoir/dam/face_distance.h>
#include <voussoir/dam/temperature.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace Voussoir
{
  namespace
  {
    using Row = std::array<double, 3>; ///< day, upstream, downstream

    std::vector<Row> read_table(const std::string &file)
    {
      std::error_code error;
      std::ifstream   in;
      if (std::filesystem::is_regular_file(file, error))
        in.open(file);
      if (!in.is_open())
        throw InputError("Entry \"Loads/Temperature/Table\": the file " + file +
                         " cannot be read. Its path is relative to the directory of the scene file.");
      std::vector<Row> rows;
      std::string      line;
      for (unsigned int number = 1; std::getline(in, line); ++number)
      {
        line = line.substr(0, line.find('#'));
        std::replace_if(
            line.begin(), line.end(), [](const char c) { return c == ',' || c == ';' || c == '\r'; }, ' ');
        std::istringstream words(line);
        std::string        more;
        Row                row;
        if (!(std::istringstream(line) >> more) ||
            (number == 1 && std::isalpha(static_cast<unsigned char>(more[0]))))
          continue; // empty line or column names
        const std::string place =
            "Entry \"Loads/Temperature/Table\": " + file + ", line " + std::to_string(number);
        if (!(words >> row[0] >> row[1] >> row[2]) || words >> more)
          throw InputError(place + " is \"" + line +
                           "\". Write three numbers: the day, and the temperatures of the upstream and the "
                           "downstream face in degC.");
        if (!rows.empty() && !(row[0] > rows.back()[0]))
          throw InputError(place + ": the days must ascend, but day " + number_text(row[0]) +
                           " follows day " + number_text(rows.back()[0]) + ". Sort the lines by day.");
        rows.push_back(row);
      }
      return rows;
    }
  } // namespace

  void TemperatureParameters::add_parameters(Entries &prm)
  {
    using namespace dealii::Patterns;
    prm.enter_subsection("Temperature");
    prm.add_parameter("Upstream face", upstream,
                      "Temperature of the upstream face [degC]. It is linear through the thickness.",
                      {-40., 50.});
    prm.add_parameter("Downstream face", downstream, "Temperature of the downstream face [degC].",
                      {-40., 60.});
    prm.add_parameter("Grouting", grouting,
                      "Temperature at joint grouting, at which the dam is free of thermal stress [degC].",
                      {-10., 40.});
    prm.add_parameter("Expansion", expansion, "Coefficient of thermal expansion of the concrete [1/K].",
                      {5e-6, 1.5e-5}, Double(0., 1e-3));
    prm.add_parameter(
        "Table", table,
        "File with the temperatures of the faces over time, instead of \"Upstream face\" and "
        "\"Downstream face\". Each line has the day, and the temperatures of the upstream and "
        "the downstream face [degC]. They are linear between the lines. The path is relative to "
        "the input file.",
        Anything());
    prm.add_parameter("Day", day, "Day in \"Table\" for the temperatures of the final stage.");
    prm.leave_subsection();
  }

  std::array<double, 2> face_temperatures(const TemperatureParameters &temperature,
                                          const std::string           &directory)
  {
    if (temperature.table.empty())
      return {{temperature.upstream, temperature.downstream}};
    const std::string      file = (std::filesystem::path(directory) / temperature.table).string();
    const std::vector<Row> rows = read_table(file);
    const double           day = temperature.day;
    if (rows.empty() || day < rows.front()[0] || day > rows.back()[0])
    {
      std::ostringstream message;
      message << "Entry \"Loads/Temperature/Table\": " << file << " has no temperature of day " << day;
      if (!rows.empty())
        message << ", only those of " << rows.front()[0] << " to " << rows.back()[0];
      throw InputError(message.str() +
                       ". Extend the table, or change \"Loads/Temperature/Day\" (or the day in "
                       "\"Statics/Stages\").");
    }
    std::size_t k = 1;
    while (k + 1 < rows.size() && rows[k][0] < day)
      ++k;
    if (rows.size() == 1)
      return {{rows[0][1], rows[0][2]}};
    const double t = (day - rows[k - 1][0]) / (rows[k][0] - rows[k - 1][0]);
    return {{rows[k - 1][1] + t * (rows[k][1] - rows[k - 1][1]),
             rows[k - 1][2] + t * (rows[k][2] - rows[k - 1][2])}};
  }

  InitialStrain temperature_load(const SolidModel &model, const std::vector<Material> &materials,
                                 const bool incompatible_modes, const TemperatureParameters &temperature,
                                 const std::string &directory, const bool to_base)
  {
    const auto          faces = face_temperatures(temperature, directory);
    std::vector<double> strain(model.n_nodes(), 0.);
    if (faces[0] != faces[1])
      strain = places_in_thickness(model, "Loads/Temperature");
    for (double &s : strain)
      s = temperature.expansion * (faces[0] + s * (faces[1] - faces[0]) - temperature.grouting);
    return initial_strain(model, materials, incompatible_modes, strain, to_base);
  }
} // namespace Voussoir
