// SPDX-License-Identifier: GPL-3.0-or-later
// read_volumes() of water_mesh.h
#include <voussoir/base/error.h>
#include <voussoir/base/number_text.h>
#include <voussoir/mesh/coincident.h>
#include <voussoir/water/water_mesh.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <set>

namespace Voussoir
{
  namespace
  {
    [[noreturn]] void fail(const std::string &text)
    {
      throw InputError("Mesh of the water, volume \"water\" of the mesh file: " + text);
    }

    double longest_edge(const std::array<Vector3, 4> &x)
    {
      double size = 0.;
      for (unsigned int k = 0; k < 4; ++k)
        size = std::max(size, norm(x[(k + 1) % 4] - x[k]));
      return size;
    }

    /** Returns the unit normal of a quadrilateral; the order of the corners gives the direction. */
    Vector3 normal_of(const std::array<Vector3, 4> &x)
    {
      const Vector3 area = Voussoir::cross(x[2] - x[0], x[3] - x[1]);
      const double  size = norm(area);
      return {{area[0] / size, area[1] / size, area[2] / size}};
    }

    /** Points of the upstream face of the dam, five by five on each quadrilateral. */
    class DamFace
    {
    public:
      explicit DamFace(const std::vector<WetQuad> &faces) : faces(faces)
      {
        constexpr unsigned int              n = 4;
        std::map<int, std::vector<Vector3>> of_monolith;
        for (std::size_t f = 0; f < faces.size(); ++f)
          for (unsigned int a = 0; a <= n; ++a)
            for (unsigned int b = 0; b <= n; ++b)
            {
              const double                s = double(a) / n, t = double(b) / n;
              const std::array<double, 4> N = {(1 - s) * (1 - t), s * (1 - t), s * t, (1 - s) * t};
              Vector3                     p{};
              for (unsigned int k = 0; k < 4; ++k)
                for (unsigned int d = 0; d < 3; ++d)
                  p[d] += N[k] * faces[f].corners[k][d];
              points.push_back(p);
              face_of.push_back(f);
              of_monolith[faces[f].monolith].push_back(p);
            }
        finder = std::make_unique<PointFinder>(points);
        for (const auto &[monolith, its_points] : of_monolith)
          finders.emplace(monolith, its_points);
      }

      /** Returns true if the quadrilateral lies on the face: its corners are within a tenth of the element size of it,
       * and its normal is within 45 degrees. */
      bool holds(const std::array<Vector3, 4> &x) const
      {
        const Vector3 normal = normal_of(x);
        return std::all_of(x.begin(), x.end(),
                           [&](const Vector3 &p)
                           {
                             const unsigned int nearest = finder->nearest(p).number;
                             const auto        &quad = faces[face_of[nearest]].corners;
                             const Vector3      of_dam = normal_of(quad);
                             const double       size = std::max(longest_edge(quad), longest_edge(x));
                             return std::abs(dot(p - points[nearest], of_dam)) < .1 * size &&
                                    distance(p) < .5 * size && std::abs(dot(normal, of_dam)) > .7;
                           });
      }

      double distance(const Vector3 &p) const { return finder->nearest(p).distance; }

      /** Returns the nearest monolith; at a joint the one with the smaller number. */
      int monolith_at(const Vector3 &p) const
      {
        int    best = 0;
        double least = 1e300;
        for (const auto &[monolith, its_finder] : finders)
          if (const double far = its_finder.nearest(p).distance; far < least - 1e-6)
          {
            least = far;
            best = monolith;
          }
        return best;
      }

    private:
      const std::vector<WetQuad>  &faces;
      std::vector<Vector3>         points;
      std::vector<std::size_t>     face_of; ///< per point
      std::unique_ptr<PointFinder> finder;
      std::map<int, PointFinder>   finders; ///< by monolith
    };

    using Face = WaterMesh::Face;

    /** Sorts the outer faces of the volumes by what they lie on. */
    class Volumes
    {
    public:
      Volumes(const HexMesh &volumes, const std::vector<WetQuad> &dam, const double level, const double depth)
          : dam(dam), volumes(volumes), level(level), depth(depth)
      {
        check_level();
        const FaceTable table(volumes);
        const auto     &entries = table.entries();
        for (std::size_t i = 0; i < entries.size(); ++i)
          if (const auto [one, two] = table.owners(entries[i].key); two == nullptr)
          {
            Face face;
            for (unsigned int k = 0; k < 4; ++k)
              face[k] = volumes.cells[one->cell].nodes[hex_faces[one->cell_face][k]];
            put(face, one->cell);
          }
        check_contact();
        check_connection();
        check_bed();
        find_end();
      }

      /** Returns the distance from the dam to @p x, along the normal of the end [m]. */
      double upstream(const Vector3 &x) const { return dot(x, normal) - dam_at; }

      const DamFace     dam;
      std::vector<Face> wet, bed, end;
      std::vector<bool> at_surface;       ///< per node
      double            length = 0.;      ///< from the dam to the end [m]
      double            last_length = 0.; ///< mean length of the elements at the end [m]
      double            h = 0.;           ///< mean edge at the dam [m]

    private:
      std::array<Vector3, 4> corners_of(const Face &face) const { return corners(volumes.nodes, face); }

      void check_level()
      {
        double top = -1e300;
        for (const Vector3 &x : volumes.nodes)
          top = std::max(top, x[2]);
        if (std::abs(top - level) > tolerance())
          fail("its surface is at z = " + number_text(top) + " m, but Reservoir/Water level is " +
               number_text(level) + " m. Set the level to " + number_text(top) +
               " m, or mesh the water up to " + number_text(level) + " m.");
        at_surface.assign(volumes.nodes.size(), false);
      }

      void put(const Face &face, const unsigned int cell)
      {
        const auto x = corners_of(face);
        if (std::all_of(x.begin(), x.end(),
                        [&](const Vector3 &p) { return std::abs(p[2] - level) < tolerance(); }))
          for (const unsigned int node : face)
            at_surface[node] = true;
        else if (dam.holds(x))
        {
          wet.push_back(face);
          for (unsigned int k = 0; k < 4; ++k)
            h += norm(x[(k + 1) % 4] - x[k]) / 4.;
        }
        else
        {
          bed.push_back(face);
          cell_of.push_back(cell);
        }
      }

      void check_contact()
      {
        if (wet.empty())
        {
          const Vector3 *nearest = &volumes.nodes[0];
          for (const Vector3 &x : volumes.nodes)
            if (dam.distance(x) < dam.distance(*nearest))
              nearest = &x;
          fail("no face lies on the surface \"upstream\" of the dam. The nearest node, at " +
               place(*nearest) + ", is " + number_text(dam.distance(*nearest)) +
               " m away. Extrude the water from the upstream face, or remove the volume: the program then "
               "generates a channel.");
        }
        h /= wet.size();
        if (std::none_of(at_surface.begin(), at_surface.end(), [](const bool is) { return is; }))
          fail("only single nodes reach the water level of " + number_text(level) +
               " m, and no face. Make the surface of the water plane.");
      }

      /** Throws InputError for a cell that no chain of common nodes connects with a wet face. */
      void check_connection() const
      {
        std::vector<bool> reached(volumes.nodes.size(), false), done(volumes.cells.size(), false);
        std::vector<std::vector<unsigned int>> cells(volumes.nodes.size()); // of each node
        for (unsigned int c = 0; c < volumes.cells.size(); ++c)
          for (const unsigned int node : volumes.cells[c].nodes)
            cells[node].push_back(c);
        std::vector<unsigned int> next;
        const auto                reach = [&](const auto &nodes)
        {
          for (const unsigned int node : nodes)
            if (!reached[node])
            {
              reached[node] = true;
              next.push_back(node);
            }
        };
        for (const Face &face : wet)
          reach(face);
        while (!next.empty())
        {
          const unsigned int node = next.back();
          next.pop_back();
          for (const unsigned int c : cells[node])
            if (!done[c])
            {
              done[c] = true;
              reach(volumes.cells[c].nodes);
            }
        }
        const std::size_t c = std::find(done.begin(), done.end(), false) - done.begin();
        if (c < done.size())
          fail(
              "the hexahedron at " + place(centre(volumes, volumes.cells[c].nodes)) +
              " has no connection with the water at the dam by common nodes. Fill the gap, or merge the nodes of both "
              "parts (gmsh: Coherence Mesh).");
      }

      /** Throws InputError for a rigid wall that is probably an error of the file: a cover of the water near its level, and a
       * face with water on both sides. */
      void check_bed() const
      {
        std::vector<Vector3> centres;
        for (const HexMesh::Cell &cell : volumes.cells)
          centres.push_back(centre(volumes, cell.nodes));
        const PointFinder cells(centres);
        for (const Face &face : bed)
        {
          const auto    x = corners_of(face);
          const double  size = longest_edge(x);
          const Vector3 n = normal_of(x), at = centre(volumes, face);
          if (n[2] > .7 && at[2] > level - std::max(.1 * depth, size))
            fail(
                "the outer face at " + place(at) + " faces upward, " + number_text(level - at[2]) +
                " m below Reservoir/Water level. It would be a rigid cover. Move all nodes of the water surface to z = " +
                number_text(level) + " m.");
          Vector3 outside = at;
          for (unsigned int d = 0; d < 3; ++d)
            outside[d] += 1e-3 * size * n[d];
          const std::vector<unsigned int> near = cells.all_nearest(outside, 2. * size);
          if (std::any_of(near.begin(), near.end(), [&](const unsigned int c) { return holds(c, outside); }))
            fail(
                "the outer face at " + place(at) +
                " has water on both sides: its nodes coincide with others, but are not shared. It would be a rigid "
                "wall. Merge the nodes (gmsh: Coherence Mesh), with equal elements on both sides.");
        }
      }

      /** Returns true if a point is in a cell with nearly plane faces. */
      bool holds(const unsigned int cell, const Vector3 &p) const
      {
        return std::all_of(std::begin(hex_faces), std::end(hex_faces),
                           [&](const unsigned int(&corner)[4])
                           {
                             Face face;
                             for (unsigned int k = 0; k < 4; ++k)
                               face[k] = volumes.cells[cell].nodes[corner[k]];
                             return dot(p - Vector3(centre(volumes, face)), normal_of(corners_of(face))) < 0.;
                           });
      }

      /** Moves the faces of the end from #bed to #end. */
      void find_end()
      {
        std::set<std::array<unsigned int, 4>> named;
        for (const HexMesh::Face &face : volumes.faces)
        {
          auto key = face.nodes;
          std::sort(key.begin(), key.end());
          named.insert(key);
        }
        const Face *first = nullptr;
        for (const Face &face : bed)
          if (normal_of(corners_of(face))[0] < -.7 &&
              (first == nullptr || centre(volumes, face)[0] < centre(volumes, *first)[0]))
            first = &face;
        if (named.empty() && first == nullptr)
          fail(
              "no outer face faces upstream (-x), so that the water has no end. Give the end the physical surface "
              "\"water end\".");
        const Vector3 at = first ? centre(volumes, *first) : Vector3{},
                      along = first ? normal_of(corners_of(*first)) : Vector3{};
        const auto is_end = [&](Face face)
        {
          const auto x = corners_of(face);
          std::sort(face.begin(), face.end());
          return named.empty() ? std::all_of(x.begin(), x.end(),
                                             [&](const Vector3 &p)
                                             { return std::abs(dot(p - at, along)) < tolerance(); })
                               : named.count(face) > 0;
        };
        std::vector<Face>         rest;
        std::vector<unsigned int> cells;
        for (std::size_t f = 0; f < bed.size(); ++f)
          if (is_end(bed[f]))
          {
            end.push_back(bed[f]);
            cells.push_back(cell_of[f]);
          }
          else
            rest.push_back(bed[f]);
        bed = rest;
        if (end.empty())
          fail(
              "the surface \"water end\" has only faces of the dam or of the water surface. Put the upstream end of the "
              "water into it.");
        measure(cells);
      }

      /** Computes normal and distance of the end. @p cells: those at the faces of the end. */
      void measure(const std::vector<unsigned int> &cells)
      {
        for (const Face &face : end)
          for_points(corners_of(face), [&](const Vector3 &area, const auto &) { add(normal, area); });
        const double size = norm(normal);
        for (double &x : normal)
          x /= size;
        dam_at = -1e300;
        for (const Face &face : wet)
          for (const unsigned int node : face)
            dam_at = std::max(dam_at, dot(volumes.nodes[node], normal));
        for (std::size_t f = 0; f < end.size(); ++f)
        {
          const double at = dot(centre(volumes, end[f]), normal);
          length += (at - dam_at) / end.size();
          last_length += 2. * (at - dot(centre(volumes, volumes.cells[cells[f]].nodes), normal)) / end.size();
        }
        if (length < depth)
          fail("its end is " + number_text(length) + " m upstream of the dam, nearer than the depth of " +
               number_text(depth) + " m. Mesh at least one depth, better two.");
      }

      double tolerance() const { return 1e-4 * depth; }

      const HexMesh            &volumes;
      const double              level, depth;
      std::vector<unsigned int> cell_of; ///< per face of #bed
      Vector3                   normal{};
      double                    dam_at = 0.; ///< largest coordinate of the wet face along the normal [m]
    };
  } // namespace

  WaterMesh read_volumes(const HexMesh &volumes, const std::vector<WetQuad> &dam, const double level,
                         WaterProperties &properties)
  {
    const Volumes             sorted(volumes, dam, level, properties.depth);
    const unsigned int        none = -1;
    std::vector<unsigned int> number(volumes.nodes.size(), none);
    WaterMesh                 mesh;
    const auto                add_node = [&](const unsigned int node)
    {
      if (number[node] != none)
        return false;
      number[node] = mesh.points.size();
      const Vector3 &x = volumes.nodes[node];
      mesh.points.push_back(x);
      mesh.at_surface.push_back(sorted.at_surface[node]);
      const double beyond = sorted.length - properties.length;
      mesh.layer.push_back(beyond > 1e-6 * sorted.length
                               ? std::clamp((sorted.upstream(x) - properties.length) / beyond, 0., 1.)
                               : 0.);
      return true;
    };
    for (const Face &face : sorted.wet)
      for (const unsigned int node : face)
        if (add_node(node))
          mesh.monolith.push_back(sorted.dam.monolith_at(volumes.nodes[node]));
    for (unsigned int node = 0; node < number.size(); ++node)
      add_node(node);
    const auto renumbered = [&](auto nodes)
    {
      for (unsigned int &node : nodes)
        node = number[node];
      return nodes;
    };
    for (const HexMesh::Cell &cell : volumes.cells)
      mesh.cells.push_back(renumbered(cell.nodes));
    for (const Face &face : sorted.wet)
      mesh.wet.push_back(renumbered(face));
    mesh.is_slice = properties.is_slice;
    for (const Face &face : sorted.bed)
      if (const Vector3 n = normal_of(corners(volumes.nodes, face)); !mesh.is_slice || std::abs(n[1]) < .5)
        mesh.bed.push_back(renumbered(face));
    for (const Face &face : sorted.end)
      mesh.end.push_back(renumbered(face));
    for (const Face &face : sorted.wet)
      for_points(corners(volumes.nodes, face),
                 [&](const Vector3 &area, const auto &) { add(mesh.wet_area, area); });
    mesh.of_file = true;
    mesh.last_length = sorted.last_length;
    properties.h = sorted.h;
    mesh.link();
    return mesh;
  }
} // namespace Voussoir
