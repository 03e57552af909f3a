// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_face_pressure_h
#define voussoir_face_pressure_h

#include <voussoir/dam/scene.h>
#include <voussoir/dam/tractions.h>
#include <voussoir/solid/solid_model.h>

#include <functional>

namespace Voussoir
{
  /** Traction on a face from the depth under a surface [m] and the outward normal [Pa]. */
  using Traction = std::function<dealii::Tensor<1, 3>(double depth, const dealii::Tensor<1, 3> &normal)>;

  /** Forces of a traction on the faces of the surface @p surface below the level @p level, on all nodes of
   * the model, also those that are held: 3 per node [N]. With 8 x 8 points per face, since the level cuts
   * through faces. */
  Unknowns nodal_forces(const SolidModel &model, int surface, double level, const Traction &traction);

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
