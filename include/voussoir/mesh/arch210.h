// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_arch210_h
#define voussoir_arch210_h

#include <voussoir/mesh/mesh.h>

namespace Voussoir
{
  /** Parameters of the built-in dam arch210, subsection "Mesh/Arch210".
   *
   * The dam is a parabolic double-curvature arch dam after the public data of Dagangshan. It is 210 m high.
   * The crest has a length of 622.4 m. The volume is 3.2 million m^3. */
  struct Arch210Parameters
  {
    unsigned int n_joints = 28;        ///< contraction joints, 0 to 60; the dam has n_joints + 1 monoliths
    unsigned int elements_along = 58;  ///< in total along the crest; rounded up to a multiple of n_joints + 1
    unsigned int elements_up = 20;     ///< from the base to the crest
    unsigned int elements_through = 2; ///< from the upstream to the downstream face
    double       end_wall_height = 0.5; ///< depth of the abutment below the two ends of the crest [m]
    double       smallest_height = 5; ///< [m]; where the abutment is higher, the dam is embedded in the bank

    void add_parameters(dealii::ParameterHandler &prm);

    /** Throws InputError if a number is out of range, or if a height is too large for the end monoliths. */
    void check() const;
  };

  /** Height of the dam [m]. The lowest point of the base is at z = 0. */
  constexpr double arch210_height = 210;

  /** Returns a conforming mesh of arch210.
   *
   * Axes: x downstream, y to the left bank, z up. The origin of x is the upstream edge of the crest at the
   * crown. The monoliths 1 to n_joints + 1 are numbered from the right bank to the left. The surface 'base'
   * includes the two end walls. The other surfaces are 'upstream', 'downstream' and 'crest'.
   *
   * The joints are vertical planes normal to the centre line of the crest, with equal spacing along it. The
   * other columns of nodes lie in such planes too. The rows of nodes have equal spacing from base to crest.
   * The node in column i along, row k up and layer l through the dam has the number
   *
   *     (i (elements_up + 1) + k) (elements_through + 1) + l. */
  HexMesh make_arch210(const Arch210Parameters &parameters);

  /** Returns the cross section of the valley: (y, z) of the lowest point of the dam's centre surface at each
   * column of nodes [m], from the right bank to the left. */
  std::vector<std::array<double, 2>> arch210_valley(const Arch210Parameters &parameters);

  /** Returns half the width of the valley at height @p z [m]. This is half the chord of the dam. */
  double arch210_half_width(double z);
} // namespace Voussoir

#endif
