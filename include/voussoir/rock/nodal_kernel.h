// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_nodal_kernel_h
#define voussoir_nodal_kernel_h

#include <cstdint>
#include <vector>

namespace Voussoir
{
  /** Cells with the same list of nodes, eight to a pack: one cell in each lane of the processor's vectors. A
   * pack that has fewer is filled up with cells without stiffness. */
  struct NodalPacks
  {
    static constexpr unsigned int n_lanes = 8;

    unsigned int n_packs;
    const std::uint16_t
                 *corner; ///< 4 times the node, of corner 0 of the eight cells of a pack, of corner 1...
    const double *lame;   ///< sets of Lame's lambda of eight cells, and their mu [Pa]
    const unsigned int *lame_of; ///< of each pack: where its set begins

    const double *nodes; ///< 8 of each: place [m], 0, displacement [m], 0; aligned to 64 bytes
    double       *force; ///< 4 of each: += the cells' K x [N], and anything; aligned to 32 bytes
  };

  /** Forces of trilinear cells whose stiffness is integrated at their eight nodes (Gauss-Lobatto points). At
   * a node the gradient depends on the differences along the three edges there alone, of places x_d and
   * displacements u_d: with c_0 = x_1 cross x_2, ..., and det = x_0 c_0 it is the sum of u_d c_d^T / det. Its
   * stress puts the force stress c_d / 8 on the upper node of edge d, and the opposite one on the lower. */
  using NodalKernel = void (*)(const NodalPacks &);

  /** Names of the kernels that this processor can run, the fastest first. The last are "matrix", which is
   * none (nullptr): the rows of the matrix are faster than what comes after it, and "plain", for any
   * processor. Results differ by round-off. */
  std::vector<const char *> nodal_kernels();

  /** That with the @p name. With nullptr that which the environment variable VOUSSOIR_KERNEL names, else the
   * fastest. InputError for a name that is unknown or stands for another processor. */
  NodalKernel nodal_kernel(const char *name = nullptr);
} // namespace Voussoir

#endif
