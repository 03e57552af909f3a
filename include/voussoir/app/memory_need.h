// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_memory_need_h
#define voussoir_memory_need_h

#include <voussoir/base/log.h>
#include <voussoir/dam/scene.h>

namespace Voussoir
{
  /** Estimated memory of a run [bytes], with an error of about 20 %. The estimate
   * requires only the mesh. */
  struct MemoryNeed
  {
    double run = 0.;         ///< peak of the first rank, without reduced time steps
    double halved_step = 0.; ///< additional memory for each size of reduced time steps
    double of_others = 0.;   ///< peak of the other ranks
  };

  /** Returns the estimated memory of a run. */
  MemoryNeed memory_need(const Scene &scene, const HexMesh &mesh);

  /** Prints the size of a large generated mesh of the water, before it is built. @p dt: time step of the earthquake [s]; 0:
   * none. Throws InputError if the mesh exceeds the memory, or if its critical time step is certainly too small. */
  void check_water_size(const Scene &scene, double dt, Log &log);

  /** Returns a text such as "about 1.2 GiB, and 0.4 GiB more ...", for each rank. */
  std::string in_words(const MemoryNeed &need);

  /** Returns the message for a run without enough memory. Creates the mesh again. */
  std::string not_enough_memory(const Scene &scene);
} // namespace Voussoir

#endif
