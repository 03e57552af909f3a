// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_nodal_kernel_h
#define voussoir_nodal_kernel_h

#include <cstdint>
#include <vector>

namespace Voussoir
{
  /** Packs of eight cells with a common list of nodes. Each cell uses one lane of the SIMD vectors of the
   * processor. An incomplete pack is filled with cells without stiffness. */
  struct NodalPacks
  {
    static constexpr unsigned int n_lanes = 8;

    unsigned int n_packs;
    const std::uint16_t
                 *corner; ///< 4 times the node number; per pack: corner 0 of its eight cells, corner 1, ...
    const double *lame;   ///< sets of Lame's constants: lambda of eight cells, then mu of eight cells [Pa]
    const unsigned int *lame_of; ///< per pack: begin of its set in lame

    const double *nodes; ///< 8 values per node: position [m], 0, displacement [m], 0; aligned to 64 bytes
    double *force; ///< 4 values per node: the kernel adds K x of the cells [N]; the fourth is arbitrary;
                   ///< aligned to 32 bytes
  };

  /** Computes the forces of trilinear cells with nodal (Gauss-Lobatto) quadrature at their eight nodes.
   *
   * The displacement gradient at a node depends only on the three edges d = 0, 1, 2 at this node. The
   * differences of position along the edges are x_d, those of displacement u_d. With c_0 = x_1 cross x_2,
   * ..., and det = x_0 c_0, the gradient is the sum of u_d c_d^T / det. Its stress adds the force stress c_d
   * / 8 to the upper node of edge d, and the opposite force to the lower node. */
  using NodalKernel = void (*)(const NodalPacks &);

  /** Returns the names of the kernels that this processor supports, the fastest first. The last two are
   * "matrix" and "plain". "matrix" (nullptr) uses the rows of the matrix, which is faster than "plain".
   * "plain" runs on any processor. Results of different kernels differ by round-off. */
  std::vector<const char *> nodal_kernels();

  /** Returns the kernel @p name. With nullptr it returns the kernel of the environment variable
   * VOUSSOIR_KERNEL, or the fastest one if the variable is not set. Throws InputError for a name that is
   * unknown or not supported by this processor. */
  NodalKernel nodal_kernel(const char *name = nullptr);
} // namespace Voussoir

#endif
