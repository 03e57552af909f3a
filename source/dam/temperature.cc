// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/curve_file.h>
#include <voussoir/base/entries.h>
#include <voussoir/base/error.h>
#include <voussoir/base/number_text.h>
#include <voussoir/dam/face_distance.h>
#include <voussoir/dam/temperature.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <iterator>
#include <sstream>

namespace Voussoir
{
  namespace
  {
    constexpr const char *entry = "Entry \"Loads/Temperature/Table\": ";

    /** Temperatures of the faces on the days of a table. */
    struct DayTable
    {
      std::vector<double>           days; ///< ascending
      std::vector<FaceTemperatures> of_day;
    };

    /** Returns the numbers of a line, without comment; empty for an empty line or column names. @p place: text
     * for messages. */
    std::vector<double> numbers_in(std::string line, const bool is_first, const std::string &place)
    {
      line = line.substr(0, line.find('#'));
      std::replace_if(
          line.begin(), line.end(), [](const char c) { return c == ',' || c == ';' || c == '\r'; }, ' ');
      std::istringstream  words(line);
      std::vector<double> numbers;
      std::string         more;
      if (!(std::istringstream(line) >> more) ||
          (is_first && std::isalpha(static_cast<unsigned char>(more[0]))))
        return numbers;
      bool are_numbers = true;
      for (std::string word; words >> word;)
      {
        char *end = nullptr;
        numbers.push_back(std::strtod(word.c_str(), &end));
        are_numbers = are_numbers && *end == '\0' && std::isfinite(numbers.back());
      }
      if (!are_numbers || (numbers.size() != 3 && numbers.size() != 4))
        throw InputError(place + " is \"" + line +
                         "\". Write three numbers: the day, and the temperatures of the upstream and the "
                         "downstream face in degC; or four: day, elevation in m, and both temperatures.");
      return numbers;
    }

    /** Adds a line to the table. @p row: day, elevation, and the temperatures of both faces. */
    void add_row(const std::array<double, 4> &row, const bool has_elevations, const std::string &place,
                 DayTable &table)
    {
      const double day = row[0], z = row[1];
      const bool   is_same = has_elevations && !table.days.empty() && day == table.days.back();
      if (!is_same && !table.days.empty() && !(day > table.days.back()))
        throw InputError(place + ": the days must ascend, but day " + number_text(day) + " follows day " +
                         number_text(table.days.back()) + ". Sort the lines by day.");
      if (!is_same)
      {
        table.days.push_back(day);
        table.of_day.emplace_back();
      }
      FaceTemperatures &now = table.of_day.back();
      if (is_same && !(z > now.elevation.back()))
        throw InputError(place + ": the elevations of a day must ascend, but " + number_text(z) +
                         " m follows " + number_text(now.elevation.back()) +
                         " m. Sort the lines by day, then by elevation.");
      now.elevation.push_back(z);
      now.faces.push_back({{row[2], row[3]}});
    }

    /** Throws InputError if the days of a table have different elevations. */
    void check_elevations(const DayTable &table, const std::string &file)
    {
      for (std::size_t i = 1; i < table.days.size(); ++i)
      {
        const std::vector<double> &first = table.of_day[0].elevation, &now = table.of_day[i].elevation;
        std::vector<double>        missing; // from one of both days
        std::set_symmetric_difference(first.begin(), first.end(), now.begin(), now.end(),
                                      std::back_inserter(missing));
        if (missing.empty())
          continue;
        const bool of_first = std::binary_search(now.begin(), now.end(), missing[0]);
        throw InputError(
            entry + file + " has no temperatures of day " + number_text(table.days[of_first ? 0 : i]) +
            " at the elevation " + number_text(missing[0]) + " m, but those of day " +
            number_text(table.days[of_first ? i : 0]) + ". Write a line for each elevation on each day.");
      }
    }

    DayTable read_table(const std::string &file)
    {
      std::ifstream in =
          open_text(file, entry + ("the file " + file) +
                              " cannot be read. Its path is relative to the directory of the scene file.");
      DayTable    table;
      std::size_t n_columns = 0;
      std::string line;
      for (unsigned int number = 1; std::getline(in, line); ++number)
      {
        const std::string         place = entry + file + ", line " + std::to_string(number);
        const std::vector<double> x = numbers_in(line, n_columns == 0, place);
        if (x.empty())
          continue;
        if (n_columns == 0)
          n_columns = x.size();
        if (x.size() != n_columns)
          throw InputError(place + " has " + std::to_string(x.size()) +
                           " numbers, but the lines before have " + std::to_string(n_columns) +
                           ". Write an elevation in all lines or in none.");
        const bool has_elevations = n_columns == 4;
        add_row({{x[0], has_elevations ? x[1] : 0., x[n_columns - 2], x[n_columns - 1]}}, has_elevations,
                place, table);
      }
      check_elevations(table, file);
      return table;
    }
  } // namespace

  std::array<double, 2> FaceTemperatures::at(const double z) const
  {
    const std::size_t k = std::upper_bound(elevation.begin(), elevation.end(), z) - elevation.begin();
    if (k == 0 || k == elevation.size())
      return faces[k == 0 ? 0 : k - 1];
    const double t = (z - elevation[k - 1]) / (elevation[k] - elevation[k - 1]);
    return {{faces[k - 1][0] + t * (faces[k][0] - faces[k - 1][0]),
             faces[k - 1][1] + t * (faces[k][1] - faces[k - 1][1])}};
  }

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
        "\"Downstream face\". Each line has the day, optionally an elevation [m], and the temperatures "
        "of the upstream and the downstream face [degC]. They are linear between days and elevations, and "
        "constant below the lowest and above the highest elevation. Each day must have the same "
        "elevations. The path is relative to the input file.",
        Anything());
    prm.add_parameter("Day", day, "Day in \"Table\" for the temperatures of the final stage.");
    prm.leave_subsection();
  }

  FaceTemperatures face_temperatures(const TemperatureParameters &temperature, const std::string &directory)
  {
    if (temperature.table.empty())
      return {{0.}, {{{temperature.upstream, temperature.downstream}}}};
    const std::string          file = (std::filesystem::path(directory) / temperature.table).string();
    const DayTable             table = read_table(file);
    const std::vector<double> &days = table.days;
    const double               day = temperature.day;
    if (days.empty() || day < days.front() || day > days.back())
    {
      std::ostringstream message;
      message << entry << file << " has no temperature of day " << day;
      if (!days.empty())
        message << ", only those of " << days.front() << " to " << days.back();
      throw InputError(message.str() +
                       ". Extend the table, or change \"Loads/Temperature/Day\" (or the day in "
                       "\"Statics/Stages\").");
    }
    std::size_t k = 1;
    while (k + 1 < days.size() && days[k] < day)
      ++k;
    if (days.size() == 1)
      return table.of_day[0];
    const double            t = (day - days[k - 1]) / (days[k] - days[k - 1]);
    const FaceTemperatures &before = table.of_day[k - 1], &after = table.of_day[k];
    FaceTemperatures        result = before;
    for (std::size_t i = 0; i < result.faces.size(); ++i)
      for (unsigned int c = 0; c < 2; ++c)
        result.faces[i][c] = before.faces[i][c] + t * (after.faces[i][c] - before.faces[i][c]);
    return result;
  }

  InitialStrain temperature_load(const SolidModel &model, const std::vector<Material> &materials,
                                 const bool incompatible_modes, const TemperatureParameters &temperature,
                                 const std::string &directory, const bool to_base)
  {
    const FaceTemperatures profile = face_temperatures(temperature, directory);
    std::vector<double>    strain(model.n_nodes(), 0.);
    if (std::any_of(profile.faces.begin(), profile.faces.end(), [](const auto &f) { return f[0] != f[1]; }))
      strain = places_in_thickness(model, "Loads/Temperature", false);
    for (unsigned int i = 0; i < model.n_nodes(); ++i)
    {
      const auto   faces = profile.at(model.points[i][2]);
      const double s = strain[i];
      strain[i] = temperature.expansion * (faces[0] + s * (faces[1] - faces[0]) - temperature.grouting);
    }
    return initial_strain(model, materials, incompatible_modes, strain, to_base);
  }
} // namespace Voussoir
