// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/curve_file.h>
#include <voussoir/base/error.h>
#include <voussoir/base/number_text.h>
#include <voussoir/mesh/arc_table_file.h>

#include <boost/algorithm/string/join.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <sstream>

namespace Voussoir
{
  namespace
  {
    constexpr double largest = 1e5; ///< of a table [m, degrees]

    std::vector<std::string> cells_of(const std::string &line)
    {
      std::vector<std::string> cells;
      std::istringstream       in(line + ",");
      for (std::string cell; std::getline(in, cell, ',');)
      {
        const auto first = cell.find_first_not_of(" \t\r\""), last = cell.find_last_not_of(" \t\r\"");
        cells.push_back(first == std::string::npos ? "" : cell.substr(first, last - first + 1));
      }
      return cells;
    }

    double value_of(const std::string &text, const std::string &column, const std::string &place)
    {
      if (column == "face")
      {
        if (text != "upstream" && text != "downstream")
          throw InputError(place + ": \"" + text + "\" must be upstream or downstream.");
        return text == "upstream" ? 0. : 1.;
      }
      char        *end = nullptr;
      const double value = std::strtod(text.c_str(), &end);
      if (text.empty() || *end != '\0' || !(std::abs(value) <= largest))
        throw InputError(place + ": \"" + text +
                         "\" must be a number between -1e5 and 1e5, in metres or degrees.");
      return value;
    }

    bool ends_with(const std::string &name, const std::string &end)
    {
      return name.size() >= end.size() && name.compare(name.size() - end.size(), end.size(), end) == 0;
    }

    void check_values(const ArcTable &table, const bool of_points)
    {
      if (table.rows.size() < 2 || table.rows.front()[0] == table.rows.back()[0])
        throw InputError(table.file + ": at least two arcs, of different elevations, are needed.");
      for (std::size_t i = 1; i < table.rows.size() && !of_points; ++i)
        if (table.rows[i][0] == table.rows[i - 1][0])
          throw InputError(table.file + ": two arcs have the elevation " + number_text(table.rows[i][0]) +
                           " m. Remove one.");
      for (std::size_t c = 1; c < table.columns.size() && !of_points; ++c)
      {
        const std::string &name = table.columns[c];
        const auto         less = [c](const auto &a, const auto &b) { return a[c] < b[c]; };
        const auto [low, high] = std::minmax_element(table.rows.begin(), table.rows.end(), less);
        if (name != "upstream_x" && !((*low)[c] > 0))
          throw InputError(table.file + ": the column " + name + " must be positive, but it is " +
                           number_text((*low)[c]) + " at elevation " + number_text((*low)[0]) + " m.");
        if (!ends_with(name, "_angle"))
          continue;
        if ((*high)[c] < 2)
          throw InputError(table.file + ": the column " + name + " has no angle above " +
                           number_text((*high)[c]) +
                           " degrees, which is no arch. Are the angles in radians? Give degrees.");
        if ((*high)[c] >= 85)
          throw InputError(table.file + ": the column " + name + " must be below 85 degrees, but it is " +
                           number_text((*high)[c]) + " at elevation " + number_text((*high)[0]) + " m.");
      }
    }
  } // namespace

  ArcTable read_arc_table(const std::string &file, const std::vector<std::string> &columns)
  {
    std::ifstream            in = open_text(file, "The table of arcs " + file +
                                                      " cannot be read. Entry \"Mesh/Arcs/Table\" is relative to the "
                                                                 "directory of the input file.");
    ArcTable                 table{file, columns, {}};
    std::vector<std::string> names;
    std::string              line;
    for (unsigned int number = 1; std::getline(in, line); ++number)
    {
      const auto first = line.find_first_not_of(" \t\r,\"");
      if (first == std::string::npos || line[first] == '#')
        continue;
      const std::vector<std::string> cells = cells_of(line);
      if (names.empty())
      {
        names = cells;
        for (const std::string &column : columns)
          if (const auto n = std::count(names.begin(), names.end(), column); n != 1)
            throw InputError(
                file + ": the column " + column + " is " + (n == 0 ? "missing" : "there twice") +
                ". The first line must name " + boost::algorithm::join(columns, ", ") +
                ", separated by commas. Decimals have a point. Entry \"Mesh/Arcs/Kind\" sets the "
                "kind of arcs.");
        continue;
      }
      const std::string place = file + ", line " + std::to_string(number);
      if (cells.size() != names.size())
        throw InputError(place + ": " + std::to_string(cells.size()) + " values for " +
                         std::to_string(names.size()) + " columns. Each column needs one.");
      std::vector<double> row;
      for (const std::string &column : columns)
        row.push_back(value_of(cells[std::find(names.begin(), names.end(), column) - names.begin()], column,
                               place + ", " + column));
      table.rows.push_back(row);
    }
    if (names.empty())
      throw InputError(file + ": the table is empty. The first line must name " +
                       boost::algorithm::join(columns, ", ") + ".");
    std::stable_sort(table.rows.begin(), table.rows.end(),
                     [](const auto &a, const auto &b) { return a[0] < b[0]; });
    check_values(table, columns[1] == "face");
    return table;
  }
} // namespace Voussoir
