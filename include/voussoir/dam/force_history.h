// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_force_history_h
#define voussoir_force_history_h

#include <voussoir/dam/load_parameters.h>
#include <voussoir/solid/solid_model.h>

namespace Voussoir
{
  struct Scene;

  /** Force at a point with a history: linear between the rows of its file, and constant before and after them. */
  struct ForceInTime
  {
    Unknowns            pattern;     ///< nodal forces at the value 1, three values per free node [-]
    std::vector<double> time, value; ///< rows of the file [s], [N]

    /** Returns the force at a time [N]. Of two rows with the same time the second holds from then on. */
    double at(double t) const;
  };

  /** Returns the forces of "Loads/Force history" times a factor. Throws InputError for a point outside of the model or
   * on fixed nodes, and for an invalid file. */
  std::vector<ForceInTime> forces_in_time(const Scene &scene, const SolidModel &model,
                                          const Structure &structure, double factor);
} // namespace Voussoir

#endif
