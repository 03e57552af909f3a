// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_arch210_h
#define voussoir_arch210_h

#include <voussoir/mesh/mesh.h>

namespace Voussoir
{
  /** The built-in dam arch210: a parabolic double-curvature arch dam 210 m high, with a crest of 622.4 m and
   *  3.2 million cubic metres of concrete, after the public data of Dagangshan. Subsection "Mesh/Arch210". */
  struct Arch210Parameters
  {
    unsigned int n_joints = 28;
    unsigned int elements_along = 58; ///< in all, along the crest; rounded up to a multiple of n_joints+1
    unsigned int elements_up = 20;
    unsigned int elements_through = 2;
    double end_wall_height = 0.5; ///< [m] from the crest's two ends down to the abutment, at the centre line
    double smallest_height = 5;   ///< [m] of the dam, which is let into the banks where it would be less high

    void add_parameters(dealii::ParameterHandler &prm);

    /** Throws InputError if a number is out of range or a height too large for the end monoliths. */
    void check() const;
  };

  /** Height of the dam [m]; its base is z = 0. */
  constexpr double arch210_height = 210;

  /** Conforming mesh of arch210: x downstream (x = 0 at the upstream edge of the crown's crest), y to the
   * left bank, z up. Monoliths 1 to n_joints + 1 from the right bank to the left, surfaces base (the foot and
   * the two end walls), upstream, downstream and crest, all with names.
   *
   *  Joints are vertical planes normal to the centre line of the crest, equally spaced along it; so are all
   *  columns of nodes. Rows are equally spaced from the foot to the crest.
   *  The node of column i along, row k up and layer l through the dam has the number
   *  (i (elements_up + 1) + k) (elements_through + 1) + l. */
  HexMesh make_arch210(const Arch210Parameters &parameters);

  /** The section of the valley: (y, z) of the foot of the centre line at each column of nodes [m], from the
   *  right bank to the left. The last ones are as high as the foot of the dam's ends. */
  std::vector<std::array<double, 2>> arch210_valley(const Arch210Parameters &parameters);

  /** Half the width of the valley at height z, which is the dam's half chord [m]. */
  double arch210_half_width(double z);
} // namespace Voussoir

#endif
