// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_memory_need_h
#define voussoir_memory_need_h

#include <voussoir/dam/scene.h>

namespace Voussoir
{
  /** What a run needs [bytes], to a fifth. From counts of the mesh: neither matrices nor factors are made.
   * With several ranks: what the first one needs, which finds the static state of rock for all. */
  struct MemoryNeed
  {
    double run = 0.;         ///< at its peak, if no step is halved
    double halved_step = 0.; ///< more for each size of halved steps: factors and joint operator
    double of_others = 0.;   ///< run, for the other ranks
  };
  MemoryNeed memory_need(const Scene &scene, const HexMesh &mesh);

  /** "about 1.2 GiB, and 0.4 GiB more ..."; of each rank. */
  std::string in_words(const MemoryNeed &need);

  /** What to tell when there was not enough memory for the run of a scene; makes its mesh again. */
  std::string not_enough_memory(const Scene &scene);
} // namespace Voussoir

#endif
