// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_batch_view_h
#define voussoir_batch_view_h

#include <cstddef>

namespace Voussoir
{
  /** Pair of a batch. Its frame is (n, t1, t2): the tangents are principal axes of the effect of forces on slips. */
  struct BatchPair
  {
    enum Kind : int
    {
      friction, ///< opens and slides (FJA)
      no_slip,  ///< opens without slip (FJB)
      tied
    };
    Kind  kind;
    int   node[2];       ///< free nodes of the sides, or -1: rigid ground
    float friction_of;   ///< coefficient of friction [-]
    float frame[9];      ///< n, t1, t2 as rows
    float cosine, sine;  ///< of the angle from the tangent a of the pair to t1
    float impulse[2][9]; ///< velocity of each node by the force of the pair [m/s/N]

    /** Gap of a step h by the force [m/N]: n by n, t1 by n, t2 by n, t1 by t1, t2 by t2. */
    float H_nn, H_1n, H_2n, H_11, H_22;
    float inverse[6]; ///< inverse of this matrix: nn, n1, n2, 11, 12, 22 [N/m]
    bool  is_coupled; ///< the friction problem has no closed form
    float gap[3];     ///< in the static state [m]
  };

  /** Arrays of a BatchModel for the kernels. */
  struct BatchView
  {
    static constexpr unsigned int most_terms = 4;

    unsigned int         n_nodes, n_bodies, n_pairs, n_terms;
    const unsigned int  *body;         ///< first node of each body, and n_nodes
    const std::size_t   *row;          ///< blocks of each node to later nodes of its body
    const unsigned int  *column;       ///< node of each block
    const float         *block;        ///< 9 per block, by rows [N/m], with the static modulus of the damping
    const float         *diagonal;     ///< 9 per node [N/m]
    const float         *inverse_mass; ///< 9 per node [1/kg]
    const unsigned char *is_full;      ///< per node: the inverse mass is not diagonal
    const float         *residual;     ///< loads of the static state without joint forces, 3 per node [N]
    const float         *of_ground;    ///< load by acceleration of the base, 9 per node [kg]
    const BatchPair     *pairs;

    float h; ///< [s]
    float weight[most_terms], decay[most_terms],
        growth[most_terms]; ///< of Damping: c [-]; of d in a step: [-], [s]
    float jolt;             ///< displacement w by a change of velocity [s]
  };

  /** State of a batch: arrays with one value per lane for each component. */
  struct BatchState
  {
    float *u, *v;         ///< increment of the displacement [m], velocity [m/s]
    float *w;             ///< displacement with memory of the damping [m]
    float *f;             ///< elastic forces [N]
    float *d;             ///< memory of the damping: n_terms for each component [m]
    float *gap, *moved;   ///< opening and slips of each pair [m]; their changes in the last step
    float *impulse;       ///< sum of the joint forces since the start of the time step [N]
    double (*works)[16];  ///< input, internal, opening, friction [J], each with one value per lane
    float ground[3 * 16]; ///< acceleration of the base, by lane [m/s^2]
  };
} // namespace Voussoir

#endif
