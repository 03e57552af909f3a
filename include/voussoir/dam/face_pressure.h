// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_face_pressure_h
#define voussoir_face_pressure_h

#include <voussoir/dam/scene.h>
#include <voussoir/dam/tractions.h>
#include <voussoir/solid/solid_model.h>

namespace Voussoir
{
  /** Hydrostatic pressure on the surface "downstream" [N]. */
  void add_tail_water(const SolidModel &model, const TailWaterParameters &water, double gravity,
                      Unknowns &load);

  /** Sediment on the surface "upstream": at the depth h its vertical pressure is p = density gravity h, its
   *  horizontal one K p. It pushes with K p the horizontal part of a face, and rests with p on what looks up;
   * under what leans over it, it bears nothing [N]. K: SiltParameters::pressure_coefficient(). */
  void add_silt(const SolidModel &model, const SiltParameters &silt, double gravity, Unknowns &load);

  /** What reservoir, tail water and silt put on the faces, with the factors of the combination; the water
   * that moves along with the dam is not in it [Pa]. */
  KnownTraction known_traction(const Scene &scene);
} // namespace Voussoir

#endif
