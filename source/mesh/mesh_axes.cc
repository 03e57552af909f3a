// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/error.h>
#include <voussoir/base/tensor3.h>
#include <voussoir/mesh/mesh_axes.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace Voussoir
{
  namespace
  {
    constexpr double lowest_dam = 5., highest_dam = 400.; ///< [m]

    /** Sum of the outward area vectors of a surface of the dam, and its area [m^2]. */
    struct Normals
    {
      Vector3 sum{};
      double  area = 0.;
    };

    /** @p surface: its physical id; the base includes base joints. */
    Normals normals_of(const HexMesh &mesh, const FaceTable &table, const int surface)
    {
      Normals result;
      for (const auto &face : mesh.faces)
      {
        if (face.surface != surface && !(is_base(surface) && is_base(face.surface)))
          continue;
        const auto  owners = table.owners(face.nodes);
        const auto *owner = owners.first; // cell of the dam; a base on rock has two cells
        if (owner != nullptr && !is_monolith(mesh.cells[owner->cell].volume))
          owner = owners.second;
        if (owner == nullptr)
          continue;
        const auto &cell = mesh.cells[owner->cell].nodes;
        const auto &corner = hex_faces[owner->cell_face];
        Vector3     diagonal[2];
        for (unsigned int d = 0; d < 3; ++d)
          for (unsigned int k = 0; k < 2; ++k)
            diagonal[k][d] = mesh.nodes[cell[corner[2 + k]]][d] - mesh.nodes[cell[corner[k]]][d];
        Vector3 area = cross(diagonal[0], diagonal[1]);
        for (unsigned int d = 0; d < 3; ++d)
          result.sum[d] += area[d] *= .5;
        result.area += norm(area);
      }
      return result;
    }

    /** Returns true if the cosine of the angle between @p v and @p sign times the axis exceeds @p cosine. The
     * default corresponds to 63 degrees. */
    bool along(const Vector3 &v, const unsigned int axis, const double sign, const double cosine = .45)
    {
      return sign * v[axis] > cosine * norm(v);
    }

    /** Returns the unit vector of the axis nearest to @p v. */
    Vector3 nearest_axis(const Vector3 &v)
    {
      const auto largest =
          std::max_element(v.begin(), v.end(),
                           [](const double a, const double b) { return std::abs(a) < std::abs(b); }) -
          v.begin();
      Vector3 axis{};
      axis[largest] = v[largest] < 0. ? -1. : 1.;
      return axis;
    }

    class AxesCheck
    {
    public:
      AxesCheck(const HexMesh &mesh, const MeshParameters &parameters, const std::string &source)
          : mesh(mesh), parameters(parameters), source(source)
      {
        const FaceTable table(mesh);
        crest = normals_of(mesh, table, PhysicalId::crest);
        base = normals_of(mesh, table, PhysicalId::base);
        const Normals upstream = normals_of(mesh, table, PhysicalId::upstream),
                      downstream = normals_of(mesh, table, PhysicalId::downstream);
        stream.area = upstream.area + downstream.area;
        for (unsigned int d = 0; d < 3; ++d)
          stream.sum[d] = downstream.sum[d] - upstream.sum[d];
      }

      void axes() const
      {
        constexpr double level = .97;           // within 14 degrees
        constexpr double downstream_is_x = .77; // within 40 degrees, since valleys are not symmetric
        if (is_clear(crest) && !along(crest.sum, 2, 1., level))
          fail("the crest does not face up (z), but along " + direction(crest.sum) + ". " + how_to_turn());
        if (is_clear(stream))
        {
          Vector3 horizontal = stream.sum;
          horizontal[2] = 0.;
          if (norm(horizontal) < .45 * norm(stream.sum))
            fail("the normal of the downstream face points along " + direction(stream.sum) +
                 ", not downstream (x). " + how_to_turn());
          if (along(horizontal, 0, -1.))
            fail(
                "the surface 'downstream' faces upstream (-x), and 'upstream' faces downstream. Exchange the "
                "names of the two surfaces in the mesh. If the x axis points upstream, set \"Mesh/Axes\" = " +
                turned_axes() + " (now it is " + parameters.axes + ")." + hint_of_the_numbers());
          if (along(horizontal, 0, 1.) && !along(horizontal, 0, 1., downstream_is_x))
            fail("the normal of the downstream face has an angle of " + degrees_off_x(horizontal) +
                 " degrees to x. Turn the mesh about z until x points downstream: ground motion and results "
                 "have the directions along and across the valley.");
          if (!along(horizontal, 0, 1.))
            fail("the downstream face does not face downstream (x), but along " + direction(horizontal) +
                 ". " + how_to_turn());
        }
        if (is_clear(base) && base.sum[2] > .45 * norm(base.sum))
          fail("the base faces up: its faces are on top of the dam. Correct the names of the surfaces in the "
               "mesh. If z points down, correct \"Mesh/Axes\".");
      }

      /** Throws InputError for a height above the usual ones. Returns a warning for one below them, or an empty
       * string. */
      std::string height() const
      {
        double bottom = 1e300, top = -1e300;
        for (const auto &cell : mesh.cells)
          if (is_monolith(cell.volume))
            for (const unsigned int node : cell.nodes)
            {
              bottom = std::min(bottom, mesh.nodes[node][2]);
              top = std::max(top, mesh.nodes[node][2]);
            }
        const double height = top - bottom;
        if (height >= lowest_dam && height <= highest_dam)
          return "";
        std::ostringstream text;
        text << "the dam is " << height << " m high. Dams have heights of " << lowest_dam << " to "
             << highest_dam << " m. The entry \"Mesh/Length unit\" is " << parameters.length_unit;
        std::string units;
        for (const char *unit : {"m", "cm", "mm", "ft", "in", "km"})
        {
          const double h = height / metres(parameters.length_unit) * metres(unit);
          if (h >= lowest_dam && h <= highest_dam)
          {
            std::ostringstream in_metres;
            in_metres << h;
            units += (units.empty() ? "" : " or ") + std::string(unit) + " (then it is " + in_metres.str() +
                     " m high)";
          }
        }
        text << (units.empty() ? ", and no other unit gives such a height. "
                               : ". With the unit " + units + " it would be a dam. ")
             << (height < lowest_dam ? "For other blocks ignore this warning."
                                     : "Correct the entry, or scale the mesh.");
        if (height > highest_dam)
          fail(text.str());
        return "mesh " + source + ": " + text.str();
      }

    private:
      /** Returns false if the normals cancel, as those of a ring do. */
      static bool is_clear(const Normals &normals)
      {
        return normals.area > 0. && norm(normals.sum) > .1 * normals.area;
      }

      static std::string direction(const Vector3 &v)
      {
        const Vector3 axis = nearest_axis(v);
        for (unsigned int d = 0; d < 3; ++d)
          if (axis[d] != 0.)
            return std::string(axis[d] < 0. ? "-" : "") + "xyz"[d];
        return "";
      }

      static std::string degrees_off_x(const Vector3 &v)
      {
        return std::to_string(std::lround(std::abs(std::atan2(v[1], v[0])) * 180. / M_PI));
      }

      bool are_numbered_to_the_right() const
      {
        const int last = n_monoliths(mesh);
        double    first_y = 0., last_y = 0.;
        for (const auto &cell : mesh.cells)
        {
          if (cell.volume == 1)
            first_y = centre(mesh, cell.nodes)[1];
          if (cell.volume == last)
            last_y = centre(mesh, cell.nodes)[1];
        }
        return first_y > last_y;
      }

      /** Returns whether the names or the axes are wrong, from the numbering of the monoliths. The numbers
       * must increase to the left bank (y). */
      std::string hint_of_the_numbers() const
      {
        return n_monoliths(mesh) == 1 ? ""
               : !are_numbered_to_the_right()
                   ? " The monoliths are numbered from the right bank to the left, as required: the names "
                     "are wrong."
                   : " The monoliths are numbered from the left bank to the right: the axes are wrong.";
      }

      /** Returns the value of "Axes" for which the surfaces have the correct directions. */
      std::string turned_axes() const
      {
        const Vector3 up = is_clear(crest) ? nearest_axis(crest.sum) : Vector3{0., 0., 1.};
        Vector3       s = stream.sum;
        for (unsigned int d = 0; d < 3; ++d)
          if (up[d] != 0.)
            s[d] = 0.;
        const Vector3 downstream = norm(s) > 0. ? nearest_axis(s) : Vector3{up[2], up[0], up[1]};
        const auto    file = file_axes(parameters.axes);
        // Vectors in the axes of the file, which are right-handed.
        const auto in_file = [&](const Vector3 &v)
        {
          Vector3 result{};
          for (unsigned int d = 0; d < 3; ++d)
            result[file[d].coordinate] += v[d] * file[d].sign;
          return result;
        };
        const Vector3 x = in_file(downstream), z = in_file(up);
        return direction(x) + " " + direction(cross(z, x)) + " " + direction(z);
      }

      std::string how_to_turn() const
      {
        return "Set \"Mesh/Axes\" = " + turned_axes() + " (now it is " + parameters.axes +
               "), or correct the names of the surfaces in the mesh.";
      }

      [[noreturn]] void fail(const std::string &text) const
      {
        throw InputError("mesh " + source + ": " + text);
      }

      const HexMesh        &mesh;
      const MeshParameters &parameters;
      const std::string    &source;
      Normals               crest, base, stream; ///< stream: downstream minus upstream
    };
  } // namespace

  std::string check_axes_and_units(const HexMesh &mesh, const MeshParameters &parameters,
                                   const std::string &source)
  {
    if (parameters.source != "file")
      return "";
    const AxesCheck check(mesh, parameters, source);
    check.axes();
    return check.height();
  }
} // namespace Voussoir
