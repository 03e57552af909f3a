// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_water_mesh_h
#define voussoir_water_mesh_h

#include <voussoir/mesh/mesh.h>
#include <voussoir/water/water_section.h>

#include <cmath>

namespace Voussoir
{
  /** Properties of compressible water. */
  struct WaterProperties
  {
    double density;     ///< [kg/m^3]
    double sound_speed; ///< [m/s]
    double reflection;  ///< reflection coefficient of bed and banks [-]
    double depth;       ///< largest depth H [m]
    double length;      ///< of the part without damping upstream of the dam [m]
    double h;           ///< size of the elements at the dam [m]

    /** true: plane strain. The planes y = constant are planes of symmetry, without bed. */
    bool is_slice = false;
  };

  /** Hexahedra of the water, and their outer faces: dam, water surface, bed and banks, upstream end. */
  struct WaterMesh
  {
    /** Corners of a face in order, then those of the opposite face in the same order. */
    using Cell = std::array<unsigned int, 8>;
    using Face = std::array<unsigned int, 4>; ///< counter-clockwise as seen from outside

    bool                      of_file = false; ///< true: volumes of a mesh file, false: channel
    std::vector<Vector3>      points;          ///< nodes [m]; those at the dam come first
    std::vector<Cell>         cells;
    std::vector<Face>         wet, bed, end; ///< at the dam; at bed and banks; at the end
    Vector3                   wet_area{}; ///< of a mesh file: area at the dam, normal out of the water [m^2]
    std::vector<bool>         at_surface; ///< per node
    std::vector<int>          monolith;   ///< per node at the dam
    std::vector<double>       layer;      ///< per node: 0 to 1 in the damping layer, 0 elsewhere [-]
    double                    last_length = 0.; ///< of the elements at the end, normal to it [m]
    std::vector<Vector3>      places;           ///< a node of each column [m]
    std::vector<unsigned int> column;           ///< per node: nodes with the same y and z have one column
    std::vector<unsigned int> far; ///< per node: the nearest one of the end, as number in far_channel()

    bool is_slice = false; ///< WaterProperties::is_slice

    unsigned int n_wet() const { return static_cast<unsigned int>(monolith.size()); } ///< nodes at the dam

    /** Numbers #column and #far, and sets #places. */
    void link();

    /** Returns the mesh of the far channel: one straight layer upstream of the end, itself without an end. Its columns
     * are those of this mesh. */
    WaterMesh far_channel() const;

  private:
    std::vector<unsigned int> end_nodes() const; ///< ascending
    Vector3                   end_normal() const;
  };

  /** Calls f(area, N) at the four Gauss points of a quadrilateral, with its area vector there [m^2] and the shape
   * functions. The order of the corners gives the direction. */
  template <class Function> void for_points(const std::array<Vector3, 4> &x, const Function &f)
  {
    const double     g = 1. / std::sqrt(3.);
    constexpr double s[4] = {-1, 1, 1, -1}, t[4] = {-1, -1, 1, 1};
    for (unsigned int q = 0; q < 4; ++q)
    {
      Vector3               a{}, b{};
      std::array<double, 4> N;
      for (unsigned int i = 0; i < 4; ++i)
      {
        const double A = 1 + s[i] * s[q] * g, B = 1 + t[i] * t[q] * g;
        N[i] = A * B / 4;
        for (unsigned int d = 0; d < 3; ++d)
        {
          a[d] += s[i] * B / 4 * x[i][d];
          b[d] += A * t[i] / 4 * x[i][d];
        }
      }
      f(cross(a, b), N);
    }
  }

  /** Returns the corners of a face [m]. */
  inline std::array<Vector3, 4> corners(const std::vector<Vector3> &points, const WaterMesh::Face &face)
  {
    return {points[face[0]], points[face[1]], points[face[2]], points[face[3]]};
  }

  /** Returns the channel with the section of the wet face and a flat end: layers from h to 2 h in an arithmetic
   * progression, then a damping layer of five depths.
   * @param section mesh of the section
   * @param properties depth, length and h */
  WaterMesh make_channel(const WaterSection &section, const WaterProperties &properties);

  /** Returns the mesh of the volumes "water" of a mesh file.
   *
   * An outer face at the water level belongs to the surface. A face on the upstream face of the dam is wet if the
   * distance of its corners is at most a tenth of the element size. The end is the surface "water end", or else the
   * most upstream plane. The rest is bed and banks. The damping layer begins at the distance properties.length from the
   * dam and ends at the end of the mesh.
   *
   * @param volumes HexMesh::water
   * @param dam upstream face of the dam, above and below the water level
   * @param level water level [m]
   * @param properties depth and length; receives h
   *
   * Throws InputError if the surface of the volumes is not at the water level, or if the volumes do not touch the dam,
   * have no end, or are shorter than the depth. */
  WaterMesh read_volumes(const HexMesh &volumes, const std::vector<WetQuad> &dam, double level,
                         WaterProperties &properties);
} // namespace Voussoir

#endif
