// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/error.h>
#include <voussoir/base/names.h>
#include <voussoir/base/number_text.h>
#include <voussoir/mesh/arc_table_file.h>
#include <voussoir/mesh/arch_table.h>
#include <voussoir/mesh/centre_line.h>
#include <voussoir/mesh/monotone_cubic.h>

#include <boost/algorithm/string/join.hpp>
#include <boost/math/interpolators/cubic_hermite.hpp>

#include <algorithm>
#include <cmath>
#include <map>

namespace Voussoir
{
  namespace
  {
    constexpr double degree = 0.0174532925199432958;     ///< [rad]
    const double     steepest = std::tan(79.9 * degree); ///< slope dx/dy of a centre line

    std::string bank_name(const Bank bank)
    {
      return bank == Bank::right ? "right" : "left";
    }

    /** Dam whose columns of the table are functions of the elevation. */
    class ArcColumns
    {
    public:
      explicit ArcColumns(const ArcTable &table)
      {
        for (std::size_t c = 0; c < table.columns.size(); ++c)
        {
          std::vector<double> z, value;
          for (const auto &row : table.rows)
          {
            z.push_back(row[0]);
            value.push_back(row[c]);
          }
          of.emplace(table.columns[c], MonotoneCubic(z, value));
        }
        bottom = table.rows.front()[0];
        top = table.rows.back()[0];
      }

      double operator()(const std::string &column, const double z) const { return of.at(column)(z); }
      double operator()(const Bank bank, const std::string &column, const double z) const
      {
        return of.at(bank_name(bank) + column)(z);
      }

      double bottom, top; ///< [m]

    private:
      std::map<std::string, MonotoneCubic> of;
    };

    /** Circular arcs of both faces, with centres on the x axis. The parameter u is the angle at the centre of the
     * upstream arc [rad]. Lines of constant u lie on the radii of the upstream arc. */
    class CircularArcs : public ArchShape
    {
    public:
      explicit CircularArcs(const ArcTable &table) : table(table)
      {
        for (const auto &row : table.rows)
          if (row[3] >= row[2])
            throw InputError(table.file + ": the arc at elevation " + number_text(row[0]) +
                             " m is thicker than its upstream radius. Correct thickness or radius.");
      }

      double bottom() const override { return table.bottom; }
      double top() const override { return table.top; }
      double end(const Bank bank, const double z) const override { return table(bank, "_angle", z) * degree; }
      double reach(const Bank bank, const double z) const override
      {
        return std::min(1.2 * end(bank, z) + 0.1, 1.5);
      }

      std::array<double, 3> point(Bank, const double u, const double z, const double w) const override
      {
        const double R = table("upstream_radius", z), r = table("downstream_radius", z);
        const double x = table("upstream_x", z), sine = std::sin(u), cosine = std::cos(u);
        const double up[2] = {x + R * (1 - cosine), R * sine}, inward[2] = {cosine, -sine};
        const double to_centre[2] = {x + table("thickness", z) + r - up[0], -up[1]};
        const double along = to_centre[0] * inward[0] + to_centre[1] * inward[1];
        const double across = to_centre[0] * inward[1] - to_centre[1] * inward[0];
        const double length = r > std::abs(across) ? along - std::sqrt(r * r - across * across) : -1.;
        if (!(length > 0))
          throw InputError(
              "The table of arcs: the upstream and the downstream arc of z = " + number_text(z) +
              " m meet at " + number_text(u / degree) +
              " degrees from the crown, before the abutment. Correct the radii and angles there.");
        const double share = (1 + w) / 2;
        return {up[0] + share * length * inward[0], up[1] + share * length * inward[1], z};
      }

    private:
      const ArcColumns table;
    };

    /** Arcs by their centre line and thickness: parabolic, elliptical or three-centred. */
    class LineArcs : public CentreLineShape
    {
    public:
      LineArcs(const ArcTable &table, const CentreLine::Kind kind) : table(table), kind(kind)
      {
        for (const auto &row : table.rows)
          for (const Bank bank : {Bank::right, Bank::left})
            if (const HalfArc half = arc(bank, row[0]); !(half.line.at(half.width).slope < steepest))
              throw InputError(table.file + ": at elevation " + number_text(row[0]) + " m, the " +
                               bank_name(bank) + "_width of " + number_text(half.width) +
                               " m is beyond the point of the centre line that is 80 degrees from the crown. "
                               "Reduce the width, or increase the radius or the semi-axis.");
      }

      double  bottom() const override { return table.bottom; }
      double  top() const override { return table.top; }
      HalfArc arc(const Bank bank, const double z) const override
      {
        CentreLine line{kind, kind == CentreLine::Kind::three_centred ? table("radius", z)
                                                                      : table(bank, "_radius", z)};
        if (kind == CentreLine::Kind::ellipse)
          line.semi_axis = table(bank, "_semi_axis", z);
        if (kind == CentreLine::Kind::three_centred)
        {
          line.angle = table(bank, "_central_angle", z) * degree;
          line.side_radius = table(bank, "_radius", z);
        }
        const double thickness = table("thickness", z);
        return {line, table("upstream_x", z) + thickness / 2, thickness, table(bank, "_thickness", z),
                table(bank, "_width", z)};
      }

    private:
      const ArcColumns       table;
      const CentreLine::Kind kind;
    };

    /** Returns the slopes dx/dy at the points, each of the parabola through the point and its two neighbours. */
    std::vector<double> slopes(const std::vector<double> &y, const std::vector<double> &x)
    {
      std::vector<double> result;
      for (std::size_t k = 0; k < y.size(); ++k)
      {
        const std::size_t middle = std::clamp<std::size_t>(k, 1, y.size() - 2);
        const double      h = y[middle] - y[middle - 1], next = y[middle + 1] - y[middle];
        const double before = (x[middle] - x[middle - 1]) / h, after = (x[middle + 1] - x[middle]) / next;
        const double curvature = (after - before) / (h + next); // half of the second derivative
        result.push_back(before + curvature * (2 * y[k] - y[middle] - y[middle - 1]));
      }
      return result;
    }

    /** Points of one face at one elevation: x as a function of y, by cubic Hermite interpolation. */
    class FaceLine
    {
    public:
      FaceLine(std::vector<double> y, std::vector<double> x, std::vector<double> slope)
          : right(y.front()), left(y.back()), line(std::move(y), std::move(x), std::move(slope))
      {
      }

      /** Returns y at the abutment, positive towards the bank [m]. */
      double end(const Bank bank) const { return bank == Bank::left ? left : -right; }

      /** Returns x at @p y, beyond the abutment on the tangent [m]. */
      double operator()(const double y) const
      {
        const double within = std::clamp(y, right, left);
        return line(within) + line.prime(within) * (y - within);
      }

    private:
      double                                                         right, left;
      boost::math::interpolators::cubic_hermite<std::vector<double>> line;
    };

    /** Arcs by points of both faces. The parameter u is y relative to the abutment of the same face. */
    class PointArcs : public ArchShape
    {
    public:
      explicit PointArcs(const ArcTable &table)
      {
        for (std::size_t first = 0, last = 0; first < table.rows.size(); first = last)
        {
          std::array<std::map<double, double>, 2> points; // x by y, of both faces
          for (; last < table.rows.size() && table.rows[last][0] == table.rows[first][0]; ++last)
            if (const auto &row = table.rows[last];
                !points[row[1] == 0 ? 0 : 1].emplace(row[3], row[2]).second)
              throw InputError(table.file + ": a face at elevation " + number_text(row[0]) +
                               " m has two points with y = " + number_text(row[3]) + " m. Remove one.");
          z.push_back(table.rows[first][0]);
          for (unsigned int f = 0; f < 2; ++f)
          {
            std::vector<double> y, x;
            for (const auto &[a, b] : points[f])
            {
              y.push_back(a);
              x.push_back(b);
            }
            if (y.size() >= 4 && (y.front() >= 0 || y.back() <= 0))
              throw InputError(table.file + ": the points at elevation " + number_text(z.back()) +
                               " m are all on one side of y = 0. Put y = 0 at the crown.");
            if (y.size() < 4)
              throw InputError(
                  table.file + ": the " + (f == 0 ? "upstream" : "downstream") + " face at elevation " +
                  number_text(z.back()) + " m has " + std::to_string(y.size()) +
                  " points. Give at least four, from the right abutment (y < 0) to the left (y > 0).");
            lines[f].emplace_back(y, x, slopes(y, x));
          }
        }
      }

      double bottom() const override { return z.front(); }
      double top() const override { return z.back(); }
      double end(Bank, double) const override { return 1; }
      double reach(Bank, double) const override { return 1.2; }

      std::array<double, 3> point(const Bank bank, const double u, const double height,
                                  const double w) const override
      {
        std::array<double, 2> x, y;
        for (unsigned int f = 0; f < 2; ++f)
        {
          std::vector<double> at_level, end;
          for (const FaceLine &line : lines[f])
          {
            end.push_back(line.end(bank));
            at_level.push_back(line((bank == Bank::left ? u : -u) * end.back()));
          }
          x[f] = MonotoneCubic(z, at_level)(height);
          y[f] = u * MonotoneCubic(z, end)(height);
        }
        if (!(x[1] > x[0]))
          throw InputError("The table of arcs: the faces meet at z = " + number_text(height) + " m, " +
                           number_text(y[0]) + " m from the crown on the " + bank_name(bank) +
                           " bank. Correct the points there.");
        const double share = (1 + w) / 2;
        return {x[0] + share * (x[1] - x[0]), y[0] + share * (y[1] - y[0]), height};
      }

    private:
      std::vector<double>                  z;     ///< elevations [m]
      std::array<std::vector<FaceLine>, 2> lines; ///< of both faces, by elevation
    };

    using Make = std::unique_ptr<ArchShape> (*)(const ArcTable &);

    template <CentreLine::Kind kind> std::unique_ptr<ArchShape> make_line_arcs(const ArcTable &table)
    {
      return std::make_unique<LineArcs>(table, kind);
    }
    template <class Shape> std::unique_ptr<ArchShape> make(const ArcTable &table)
    {
      return std::make_unique<Shape>(table);
    }

    /** Kind of arcs. */
    struct ArcKind
    {
      const char              *name, *doc;
      std::vector<std::string> columns;
      Make                     make;
    };

    const std::vector<ArcKind> rows_of_arcs = {
        {"circular",
         "a circle for each face. thickness: at the crown; angles: from the crown to the abutment at the centre of "
         "the upstream arc [degrees]",
         {"elevation", "upstream_x", "upstream_radius", "thickness", "downstream_radius", "right_angle",
          "left_angle"},
         make<CircularArcs>},
        {"parabolic",
         "parabolas as centre lines. radius: at the crown; right_thickness, left_thickness: at the abutments; "
         "width: y of the centre line at the abutment",
         {"elevation", "upstream_x", "thickness", "right_radius", "left_radius", "right_thickness",
          "left_thickness", "right_width", "left_width"},
         make_line_arcs<CentreLine::Kind::parabola>},
        {"elliptical",
         "ellipses as centre lines, with the radius at the crown and the semi-axis across the valley",
         {"elevation", "upstream_x", "thickness", "right_radius", "left_radius", "right_semi_axis",
          "left_semi_axis", "right_thickness", "left_thickness", "right_width", "left_width"},
         make_line_arcs<CentreLine::Kind::ellipse>},
        {"three-centred",
         "circles as centre lines: radius up to the central angles, beyond them right_radius and left_radius",
         {"elevation", "upstream_x", "thickness", "radius", "right_central_angle", "left_central_angle",
          "right_radius", "left_radius", "right_thickness", "left_thickness", "right_width", "left_width"},
         make_line_arcs<CentreLine::Kind::three_centred>},
        {"points",
         "points of both faces, at least four for each face and elevation, including both abutments",
         {"elevation", "face", "x", "y"},
         make<PointArcs>}};
  } // namespace

  std::string arc_kinds()
  {
    return names_of(rows_of_arcs);
  }

  std::string arc_kind_docs()
  {
    const auto doc = [](const ArcKind &kind)
    {
      return std::string(kind.name) + ": " + kind.doc + " (columns " +
             boost::algorithm::join(kind.columns, ", ") + ")";
    };
    return listed(rows_of_arcs, doc, "; ");
  }

  std::unique_ptr<ArchShape> read_arch_table(const std::string &file, const std::string &name)
  {
    const auto kind = std::find_if(rows_of_arcs.begin(), rows_of_arcs.end(),
                                   [&](const ArcKind &k) { return name == k.name; });
    return kind->make(read_arc_table(file, kind->columns));
  }
} // namespace Voussoir
