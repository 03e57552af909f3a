// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_plane_wave_h
#define voussoir_plane_wave_h

#include <voussoir/base/tensor3.h>
#include <voussoir/solid/material.h>

#include <optional>
#include <string>
#include <vector>

namespace Voussoir
{
  /** Plane wave that rises at an angle through the half-space below the rock. */
  struct PlaneWave
  {
    enum Type
    {
      P,  ///< displacement along the direction of propagation; amplitude: vertical component of the motion
      SV, ///< displacement in the vertical plane of propagation; amplitude: horizontal component in this plane
      SH  ///< horizontal displacement normal to this plane; amplitude: component in this direction
    };
    Type   type = P;
    double angle = 0.;   ///< between the direction of propagation and the vertical [rad]
    double azimuth = 0.; ///< of the horizontal direction of propagation, from x to y [rad]
    double delay = 0.;   ///< of the arrival [s]

    /** Returns the horizontal slowness of the wave [s/m]. @p material: of the half-space. */
    double slowness(const Material &material) const;

    /** Returns the vertical slowness of the wave in a layer [s/m]. @p p: horizontal slowness, below 1/c of
     * the layer. */
    double vertical_slowness(const Material &layer, double p) const;

    /** Returns the coordinate of a place along the horizontal direction of propagation [m]. */
    double along(const Vector3 &place) const;
  };

  /** Waves that enter the rock. */
  struct Incidence
  {
    std::vector<PlaneWave> waves; ///< empty: vertical incidence, all components of the motion
    Vector3 centre{};             ///< place at which the waves arrive together, except for their delays [m]

    /** Rock below all layers, to which the angles refer. Without a value, the lowest rock of the highest
     * column. */
    std::optional<Material> half_space = {};

    bool is_vertical() const { return waves.empty(); }
  };

  /** Returns the waves of the entry Foundation/Incidence: "vertical", or a list as in "SV 30 90, P 20 90
   * 0.5": type, angle and azimuth in degrees, delay in s (optional). Throws InputError for another text and
   * for angles outside of 0 to 90 degrees. */
  std::vector<PlaneWave> read_incidence(const std::string &text);

  /** Throws InputError if the wave cannot propagate in all layers of the ground: its horizontal slowness
   * must be below 1/c_p (P and SV) or 1/c_s (SH) of each layer. @p half_space: rock that the slowness
   * refers to. */
  void check_incidence(const PlaneWave &wave, const std::vector<Material> &layers,
                       const Material &half_space);
  /** Throws InputError if the slowness of the wave along the valley (x) is not below 1/c_p of each layer, as
   * sections require. */
  void check_incidence_along(const PlaneWave &wave, const std::vector<Material> &layers,
                             const Material &half_space);
} // namespace Voussoir

#endif
