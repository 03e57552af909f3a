// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_arch210_h
#define voussoir_arch210_h

#include <voussoir/mesh/arch_grid.h>

namespace Voussoir
{
  /** Parameters of the built-in dam arch210, subsection "Mesh/Arch210".
   *
   * The dam is a parabolic double-curvature arch dam after the public data of Dagangshan. It is 210 m high.
   * The crest has a length of 622.4 m. The volume is 3.2 million m^3. */
  struct Arch210Parameters : ArchGrid
  {
    Arch210Parameters() { end_wall_height = 0.5; }

    void add_parameters(Entries &prm);

    /** Throws InputError if a number is out of range, or if a height is too large for the end monoliths. */
    void check() const;
  };

  /** Height of the dam [m]. The lowest point of the base is at z = 0. */
  constexpr double arch210_height = 210;

  /** Returns the faces and abutments of arch210. The origin of x is the upstream edge of the crest at the crown.
   */
  const ArchShape &arch210_shape();

  /** Returns the mesh of arch210, by make_arch(). */
  HexMesh make_arch210(const Arch210Parameters &parameters);

  /** Returns half the width of the valley at height @p z [m]. This is half the chord of the dam. */
  double arch210_half_width(double z);
} // namespace Voussoir

#endif
