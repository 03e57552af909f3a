// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/curve_file.h>
#include <voussoir/base/error.h>
#include <voussoir/base/names.h>
#include <voussoir/base/nearest_name.h>
#include <voussoir/base/number_text.h>
#include <voussoir/dam/rock_wedge.h>
#include <voussoir/dam/scene.h>

#include <cctype>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <sstream>

namespace Voussoir
{
  namespace
  {
    constexpr double least_independence = 1e-3; ///< of the normals of a wedge, see independence() [-]

    /** Column of the file. The number of a cell is at least @p low and at most @p high. */
    struct WedgeColumn
    {
      const char *name, *unit;
      double      low, high;
    };
    constexpr double            unbounded = 1e300;
    constexpr const char *const of_text = "text"; ///< unit of a column with text

    const std::vector<WedgeColumn> &wedge_columns()
    {
      static const std::vector<WedgeColumn> all = {{"wedge", of_text, 0., 0.},
                                                   {"plane", of_text, 0., 0.},
                                                   {"x", "m", -unbounded, unbounded},
                                                   {"y", "m", -unbounded, unbounded},
                                                   {"z", "m", -unbounded, unbounded},
                                                   {"dip", "deg", 0., 180.},
                                                   {"dip direction", "deg", -360., 360.},
                                                   {"nx", "-", -unbounded, unbounded},
                                                   {"ny", "-", -unbounded, unbounded},
                                                   {"nz", "-", -unbounded, unbounded},
                                                   {"area", "m2", 0., unbounded},
                                                   {"friction", "-", 0., 5.},
                                                   {"cohesion", "Pa", 0., unbounded},
                                                   {"uplift", "Pa", 0., unbounded},
                                                   {"volume", "m3", 1e-6, unbounded},
                                                   {"density", "kg/m3", 1., 1e4}};
      return all;
    }

    std::string without_blanks(const std::string &text)
    {
      const auto first = text.find_first_not_of(" \t\r\""), last = text.find_last_not_of(" \t\r\"");
      return first == std::string::npos ? "" : text.substr(first, last - first + 1);
    }

    std::vector<std::string> cells_of(const std::string &line, const char separator)
    {
      std::vector<std::string> cells;
      std::istringstream       in(line + separator);
      for (std::string cell; std::getline(in, cell, separator);)
        cells.push_back(without_blanks(cell));
      return cells;
    }

    /** File with wedges during reading. */
    class WedgeFile
    {
    public:
      explicit WedgeFile(const std::string &file) : file(file) {}
      std::vector<RockWedge> read();

    private:
      [[noreturn]] void error(const std::string &text) const
      {
        throw InputError("Entry \"Limits/Wedges\": " + file + ", line " + std::to_string(number) + ": " +
                         text);
      }
      void        read_header(const std::string &line);
      void        check_header() const;
      void        read_row(const std::string &line);
      bool        has(const char *column) const { return place.count(column) > 0; }
      std::string text(const char *column) const;
      double      value(const char *column) const;
      Vector3     normal() const;
      void        read_rock(RockWedge &wedge) const;
      RockWedge  &wedge_of_row();
      void        check(const RockWedge &wedge) const;

      const std::string                  file;
      unsigned int                       number = 0; ///< of the line
      char                               separator = ',';
      std::map<std::string, std::size_t> place; ///< of each column
      std::vector<std::string>           cells; ///< of the present line
      std::vector<RockWedge>             wedges;
    };

    /** Reads the names of the columns. The unit [...] must be that of the column. */
    void WedgeFile::read_header(const std::string &line)
    {
      separator = line.find(';') != std::string::npos ? ';' : ',';
      for (const std::string &cell : cells_of(line, separator))
      {
        const auto        bracket = cell.find('[');
        std::string       name = without_blanks(cell.substr(0, bracket));
        const std::string unit =
            bracket == std::string::npos ? "" : cell.substr(bracket + 1, cell.find(']') - bracket - 1);
        for (char &c : name)
          c = c == '_' ? ' ' : std::tolower(static_cast<unsigned char>(c));
        std::vector<std::string> names;
        const WedgeColumn       *found = nullptr;
        for (const WedgeColumn &column : wedge_columns())
        {
          names.push_back(column.name);
          if (name == column.name)
            found = &column;
        }
        if (found == nullptr)
          error("there is no column \"" + name + "\". Did you mean \"" + nearest_name(names, name) +
                "\"? The first line has the names of the columns.");
        if (!unit.empty() && unit != found->unit)
          error("the column \"" + name + "\" has the unit [" + unit + "]. Write its numbers in [" +
                found->unit + "].");
        if (!place.emplace(name, place.size()).second)
          error("the column \"" + name + "\" occurs twice. Remove one.");
      }
      check_header();
    }

    void WedgeFile::check_header() const
    {
      for (const WedgeColumn &column : wedge_columns())
      {
        const std::string name = column.name;
        const bool        is_normal = name[0] == 'n', is_dip = name.compare(0, 3, "dip") == 0;
        if (is_normal || is_dip ? !has("nx") && !has("dip") : !has(column.name))
          error(
              "the column \"" + name +
              "\" is missing. Write the columns wedge, plane, x, y, z, dip, dip "
              "direction, area, friction, cohesion, uplift, volume and density, in any sequence. "
              "Instead of dip and dip direction the columns nx, ny and nz can have the normal into the wedge.");
      }
      const int n_dip = has("dip") + has("dip direction"), n_normal = has("nx") + has("ny") + has("nz");
      if ((n_dip != 0 && n_dip != 2) || (n_normal != 0 && n_normal != 3) || (n_dip > 0) == (n_normal > 0))
        error(
            "the orientation of the planes is incomplete or given twice. Write either the columns dip and dip "
            "direction, or nx, ny and nz.");
    }

    std::string WedgeFile::text(const char *column) const
    {
      const std::string result = cells[place.at(column)];
      if (result.empty())
        error(std::string("the column \"") + column + "\" is empty. Write a name.");
      return result;
    }

    /** Returns the number in a column of the present line. */
    double WedgeFile::value(const char *column) const
    {
      const std::string &cell = cells[place.at(column)];
      char              *end = nullptr;
      const double       result = std::strtod(cell.c_str(), &end);
      for (const WedgeColumn &one : wedge_columns())
      {
        if (std::string(one.name) != column)
          continue;
        const std::string name = std::string("the column \"") + column + "\" ";
        if (cell.empty() || *end != '\0' || !std::isfinite(result))
          error(name + (cell.empty() ? "is empty" : "has \"" + cell + "\"") + ". Write a number in [" +
                one.unit + "], with a decimal point.");
        if (std::string(column) == "friction" && result > one.high)
          error(name + "has " + number_text(result) +
                ". It is tan(phi), for example 0.7 for phi = 35 degrees.");
        if (result < one.low || result > one.high)
          error(name + "has " + number_text(result) + ", but its numbers are " +
                (one.high < unbounded ? "from " + number_text(one.low) + " to " + number_text(one.high)
                 : one.low > 0.       ? "positive"
                                      : "at least 0") +
                " [" + one.unit + "]. Correct the number.");
      }
      return result;
    }

    Vector3 WedgeFile::normal() const
    {
      if (has("dip"))
        return normal_of(value("dip"), value("dip direction"));
      const Vector3 result{{value("nx"), value("ny"), value("nz")}};
      const double  length = norm(result);
      if (!(length > 0.))
        error("the normal of plane \"" + text("plane") +
              "\" is zero. Write the components of a vector from the plane into the wedge.");
      return scaled(1. / length, result);
    }

    /** Reads volume and density of a wedge. They may be empty after its first line. */
    void WedgeFile::read_rock(RockWedge &wedge) const
    {
      const bool is_first = wedge.sides.empty();
      for (const auto &[column, number] :
           {std::make_pair("volume", &wedge.volume), {"density", &wedge.density}})
      {
        if (!is_first && cells[place.at(column)].empty())
          continue;
        const double now = value(column);
        if (!is_first && now != *number)
          error("wedge \"" + wedge.name + "\" has the " + column + " " + number_text(now) + " here, but " +
                number_text(*number) + " in its first line. Write it once, or the same number.");
        *number = now;
      }
    }

    RockWedge &WedgeFile::wedge_of_row()
    {
      const std::string name = text("wedge");
      if (name.find_first_of(",\"") != std::string::npos)
        error("wedge \"" + name +
              "\" has a comma or a quote in its name, which becomes a column of wedges.csv. "
              "Use another name.");
      for (RockWedge &wedge : wedges)
        if (wedge.name == name)
          return wedge;
        else if (edit_distance(wedge.name, name) == 0) // which ignores case
          error("wedge \"" + name + "\" has the name of wedge \"" + wedge.name +
                "\" but for capitals. Write the planes of one wedge with one name, or use another name.");
      wedges.push_back({name, {}});
      return wedges.back();
    }

    void WedgeFile::read_row(const std::string &line)
    {
      cells = cells_of(line, separator);
      if (cells.size() != place.size())
        error("it has " + std::to_string(cells.size()) + " columns, but the first line has " +
              std::to_string(place.size()) + ". Write one value for each column, with a decimal point.");
      RockWedge        &wedge = wedge_of_row();
      const std::string name = text("plane");
      for (const WedgePlane &other : wedge.sides)
        if (other.name == name)
          error("wedge \"" + wedge.name + "\" has two planes \"" + name + "\". Use another name.");
      if (wedge.planes.size() == 3 && value("area") > 0.)
        error("wedge \"" + wedge.name +
              "\" has a fourth plane with contact. Write three, and others with area 0.");
      read_rock(wedge);
      WedgePlane plane{name, {{value("x"), value("y"), value("z")}}, normal()};
      plane.area = value("area");
      plane.friction = value("friction");
      plane.cohesion = value("cohesion");
      plane.uplift = value("uplift");
      wedge.sides.push_back(plane);
      if (plane.area > 0.)
        wedge.planes.push_back(plane);
      else if (plane.friction + plane.cohesion + plane.uplift > 0.)
        error("plane \"" + name +
              "\" has the area 0, but friction, cohesion or uplift. Correct one of them.");
      check(wedge);
    }

    void WedgeFile::check(const RockWedge &wedge) const
    {
      if (independence(wedge.planes) < least_independence)
        error("the planes of wedge \"" + wedge.name + "\" are " +
              (independence({wedge.planes.end()[-1], wedge.planes.front()}) < least_independence ||
                       independence({wedge.planes.end()[-1], wedge.planes.end()[-2]}) < least_independence
                   ? "parallel. Two parallel planes do not bound a wedge"
                   : "parallel to one line, so that the third plane does not close the wedge") +
              ": correct the orientation of a plane, or remove one.");
    }

    std::vector<RockWedge> WedgeFile::read()
    {
      std::ifstream in =
          open_text(file, "Entry \"Limits/Wedges\": the file " + file +
                              " cannot be read. Its path is relative to the directory of the scene file.");
      for (std::string line; std::getline(in, line);)
      {
        ++number;
        line = line.substr(0, line.find('#'));
        if (line.find_first_not_of(" \t\r,;") == std::string::npos)
          continue;
        if (place.empty())
          read_header(line);
        else
          read_row(line);
      }
      if (wedges.empty())
        throw InputError("Entry \"Limits/Wedges\": " + file +
                         " has no wedge. Write a line with the names of the columns and one line per plane.");
      for (const RockWedge &wedge : wedges)
        if (wedge.planes.empty())
          throw InputError("Entry \"Limits/Wedges\": all planes of wedge \"" + wedge.name +
                           "\" have the area 0. Write at least one plane with contact.");
      return wedges;
    }
  } // namespace

  bool RockWedge::contains(const Vector3 &place) const
  {
    return std::all_of(sides.begin(), sides.end(),
                       [&](const WedgePlane &plane) { return dot(plane.normal, place - plane.point) > 0.; });
  }

  Vector3 normal_of(const double dip, const double direction)
  {
    const double a = dip * M_PI / 180., b = direction * M_PI / 180.;
    return {{std::sin(a) * std::cos(b), std::sin(a) * std::sin(b), std::cos(a)}};
  }

  std::vector<RockWedge> rock_wedges(const Scene &scene)
  {
    const std::string &file = scene.limits.wedges;
    return file.empty() ? std::vector<RockWedge>()
                        : WedgeFile((std::filesystem::path(scene.directory) / file).string()).read();
  }

  std::vector<LoadedWedge> loaded_wedges(const Scene &scene, const SolidModel &model)
  {
    const auto part_on = [&](const RockWedge &wedge)
    { return base_part(model, [wedge](const Vector3 &x) { return wedge.contains(x); }); };
    std::vector<LoadedWedge> result;
    for (const RockWedge &wedge : rock_wedges(scene))
    {
      result.push_back({wedge, part_on(wedge)});
      if (result.back().part.n_faces > 0)
        continue;
      const auto is_outside = [&](const WedgePlane &plane) {
        return part_on({"", {}, {plane}}).n_faces == 0;
      };
      const std::string outside = // planes with the whole base on their other side
          listed(wedge.sides, [&](const WedgePlane &plane) { return is_outside(plane) ? plane.name : ""; });
      throw InputError(
          "Entry \"Limits/Wedges\": no face of the surface \"base\" rests on wedge \"" + wedge.name +
          "\", so the dam would not load it. " +
          (outside.empty() ? "No face has its centre on the side of the wedge of all planes"
                           : "The whole base is on the other side of: " + outside) +
          ". Check the points of the planes, in the axes of the program [m], and that the normals point into "
          "the wedge (dip and dip direction in doc/base_joints.md).");
    }
    return result;
  }

  std::string in_words(const RockWedge &wedge, const unsigned int mode)
  {
    if (mode == 0)
      return "lifts off all planes";
    if (mode == 123)
      return "all planes in contact";
    const auto name = [&](const unsigned int plane) { return wedge.planes.at(plane - 1).name; };
    return mode < 10 ? "slides on " + name(mode)
                     : "slides along the line of " + name(mode / 10) + " and " + name(mode % 10);
  }
} // namespace Voussoir
