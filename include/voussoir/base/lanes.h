// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_lanes_h
#define voussoir_lanes_h

namespace Voussoir
{
  /** Returns the number of lanes of the vectors in kernels that for_lanes.h compiles: 16 with AVX-512, 8 with AVX2,
   * otherwise 4. The variable VOUSSOIR_LANES of the environment reduces it. */
  unsigned int n_lanes();

  constexpr unsigned int most_lanes = 16; ///< largest value of n_lanes()

  /** Returns the kernel for n_lanes(). */
  template <class Kernel> Kernel for_lanes(const Kernel of_16, const Kernel of_8, const Kernel of_4)
  {
    return n_lanes() == 16 ? of_16 : n_lanes() == 8 ? of_8 : of_4;
  }
} // namespace Voussoir

#endif
