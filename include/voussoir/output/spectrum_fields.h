// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_spectrum_fields_h
#define voussoir_spectrum_fields_h

#include <voussoir/dam/dam.h>
#include <voussoir/dynamics/spectrum_response.h>

namespace Voussoir
{
  /** Maxima of a response spectrum analysis: SpectrumResponse::combine() of each component. They have no sign
   * and do not occur at the same time. Static values are not included. */
  struct SpectrumFields
  {
    Unknowns            displacement; ///< relative to the ground, three values per free node [m]
    std::vector<Stress> stress;       ///< xx yy zz xy yz zx of each node of the model [Pa]

    /** Stresses of directions_at() on the upstream and the downstream face (at a kink on one of its faces), per node
     * of the model [Pa]. Zero at other nodes. */
    std::vector<float> arch, cantilever;
  };

  /** Computes the fields. The recovered stress of a part has the hydrodynamic pressure of its acceleration on
   * the upstream face, and the other known tractions are zero ("Output/Stress recovery"). */
  SpectrumFields spectrum_fields(const Dam &dam, const SpectrumResponse &response);
} // namespace Voussoir

#endif
