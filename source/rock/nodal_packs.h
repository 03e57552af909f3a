// SPDX-License-Identifier: GPL-3.0-or-later
// Kernel of nodal_kernel.h. nodal_kernel.cc includes this file several times, each time in a namespace for
// another instruction set. The namespace supplies Lanes (a vector of n_wide doubles), load() and add().
// Vectors are passed by reference to functions that are always inlined, so calling conventions
// have no effect.

VOUSSOIR_INLINE void cross(const Vectors &a, const Vectors &b, Vectors &c)
{
  c.c[0] = a.c[1] * b.c[2] - a.c[2] * b.c[1];
  c.c[1] = a.c[2] * b.c[0] - a.c[0] * b.c[2];
  c.c[2] = a.c[0] * b.c[1] - a.c[1] * b.c[0];
}

/** Returns the edge of a cell along direction d at a corner: 4 d plus the remaining two bits of the corner. */
constexpr unsigned int edge_of(const unsigned int corner, const unsigned int d)
{
  return 4 * d + (corner & ((1u << d) - 1u)) + ((corner >> (d + 1)) << d);
}

/** Adds the contribution of the quadrature point at one corner to the forces @p f of the edges. */
VOUSSOIR_INLINE void add_corner(const Vectors *const *x, const Vectors *const *u, const Lanes &lambda,
                                const Lanes &mu, Vectors *const *f)
{
  Vectors cofactor[3];
  for (unsigned int d = 0; d < 3; ++d)
    cross(*x[(d + 1) % 3], *x[(d + 2) % 3], cofactor[d]);
  const Lanes scale =
      .125 / (x[0]->c[0] * cofactor[0].c[0] + x[0]->c[1] * cofactor[0].c[1] + x[0]->c[2] * cofactor[0].c[2]);
  Lanes h[3][3]; // gradient times determinant
  for (unsigned int i = 0; i < 3; ++i)
    for (unsigned int j = 0; j < 3; ++j)
      h[i][j] = u[0]->c[i] * cofactor[0].c[j] + u[1]->c[i] * cofactor[1].c[j] + u[2]->c[i] * cofactor[2].c[j];
  const Lanes m = scale * mu, mean = scale * lambda * (h[0][0] + h[1][1] + h[2][2]);
  const Lanes xx = 2. * m * h[0][0] + mean, yy = 2. * m * h[1][1] + mean, zz = 2. * m * h[2][2] + mean,
              xy = m * (h[0][1] + h[1][0]), yz = m * (h[1][2] + h[2][1]), zx = m * (h[2][0] + h[0][2]);
  for (unsigned int d = 0; d < 3; ++d)
  {
    const Vectors &c = cofactor[d];
    f[d]->c[0] += xx * c.c[0] + xy * c.c[1] + zx * c.c[2];
    f[d]->c[1] += xy * c.c[0] + yy * c.c[1] + yz * c.c[2];
    f[d]->c[2] += zx * c.c[0] + yz * c.c[1] + zz * c.c[2];
  }
}

/** Adds the forces of n_wide cells of a pack. Nodes are loaded before the first quadrature point that needs
 * them and receive their force after the last one. The processor overlaps both with the arithmetic
 * of other points. */
VOUSSOIR_INLINE void add_cells(const NodalPacks &packs, const std::uint16_t *node, const double *lame)
{
  Vectors place[8], displacement[8], x[12], u[12], f[12];
  Lanes   lambda, mu;
  std::memcpy(&lambda, lame, sizeof(Lanes));
  std::memcpy(&mu, lame + NodalPacks::n_lanes, sizeof(Lanes));
#pragma GCC unroll 8
  for (unsigned int s = 0; s < 8; ++s)
  {
    const unsigned int v = corner_at(s);
#pragma GCC unroll 8
    for (unsigned int w = 0; w < 8; ++w)
      if (first_step(w) == s)
        load(packs.nodes, node + NodalPacks::n_lanes * w, place[w], displacement[w]);
#pragma GCC unroll 3
    for (unsigned int d = 0; d < 3; ++d)
      if (step_at(v) < step_at(v ^ 1u << d))
      {
        const unsigned int low = v & ~(1u << d), high = v | 1u << d, e = edge_of(v, d);
        for (unsigned int c = 0; c < 3; ++c)
        {
          x[e].c[c] = place[high].c[c] - place[low].c[c];
          u[e].c[c] = displacement[high].c[c] - displacement[low].c[c];
          f[e].c[c] = Lanes{};
        }
      }
    const unsigned int e[3] = {edge_of(v, 0), edge_of(v, 1), edge_of(v, 2)};
    const Vectors     *edges[3] = {x + e[0], x + e[1], x + e[2]}, *moved[3] = {u + e[0], u + e[1], u + e[2]};
    Vectors           *forces[3] = {f + e[0], f + e[1], f + e[2]};
    add_corner(edges, moved, lambda, mu, forces);
#pragma GCC unroll 8
    for (unsigned int w = 0; w < 8; ++w)
      if (last_step(w) == s)
      {
        Vectors sum;
        for (unsigned int c = 0; c < 3; ++c)
        {
          const Lanes p = f[edge_of(w, 0)].c[c], q = f[edge_of(w, 1)].c[c], r = f[edge_of(w, 2)].c[c];
          sum.c[c] = ((w & 1u) != 0 ? p : -p) + ((w & 2u) != 0 ? q : -q) + ((w & 4u) != 0 ? r : -r);
        }
        add(sum, node + NodalPacks::n_lanes * w, packs.force);
      }
  }
}

void multiply(const NodalPacks &packs)
{
  for (unsigned int p = 0; p < packs.n_packs; ++p)
    for (unsigned int lane = 0; lane < NodalPacks::n_lanes; lane += n_wide)
      add_cells(packs, packs.corner + 8 * NodalPacks::n_lanes * p + lane,
                packs.lame + packs.lame_of[p] + lane);
}
