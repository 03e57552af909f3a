// SPDX-License-Identifier: GPL-3.0-or-later
// Kernel of MotionBatch; see base/for_lanes.h.

VOUSSOIR_INLINE Vector square_root(const Vector a)
{
  return VOUSSOIR_SQUARE_ROOT(a);
}

VOUSSOIR_INLINE void add_to(double *sums, const Vector x, const double factor)
{
  for (int lane = 0; lane < lanes; ++lane)
    sums[lane] += factor * static_cast<double>(x[lane]);
}

/** Arrays of the state as vectors. */
struct Lanes
{
  Vector *u, *v, *w, *f, *d, *gap, *moved, *impulse;
  Vector  ground[3];

  explicit Lanes(const BatchState &s)
      : u(reinterpret_cast<Vector *>(s.u)), v(reinterpret_cast<Vector *>(s.v)),
        w(reinterpret_cast<Vector *>(s.w)), f(reinterpret_cast<Vector *>(s.f)),
        d(reinterpret_cast<Vector *>(s.d)), gap(reinterpret_cast<Vector *>(s.gap)),
        moved(reinterpret_cast<Vector *>(s.moved)), impulse(reinterpret_cast<Vector *>(s.impulse))
  {
    for (int c = 0; c < 3; ++c)
      for (int lane = 0; lane < lanes; ++lane)
        ground[c][lane] = s.ground[c * lanes + lane];
  }
};

/** Load on a component of a node. */
VOUSSOIR_INLINE Vector load_of(const BatchView &m, const Lanes &s, const std::size_t i, const int c)
{
  const float *by_ground = m.of_ground + 9 * i + 3 * c;
  return m.residual[3 * i + c] + by_ground[0] * s.ground[0] + by_ground[1] * s.ground[1] +
         by_ground[2] * s.ground[2];
}

/** Adds the products with the blocks of a node to later nodes, above and below the diagonal. */
VOUSSOIR_INLINE void multiply_row(const BatchView &m, const Lanes &s, const std::size_t i, Vector sum[3])
{
  const Vector x0 = s.w[3 * i], x1 = s.w[3 * i + 1], x2 = s.w[3 * i + 2];
  const float *D = m.diagonal + 9 * i;
  Vector       s0 = s.f[3 * i] + D[0] * x0 + D[1] * x1 + D[2] * x2,
         s1 = s.f[3 * i + 1] + D[3] * x0 + D[4] * x1 + D[5] * x2,
         s2 = s.f[3 * i + 2] + D[6] * x0 + D[7] * x1 + D[8] * x2;
  for (std::size_t k = m.row[i]; k < m.row[i + 1]; ++k)
  {
    const float  *A = m.block + 9 * k;
    const Vector *y = s.w + 3 * std::size_t(m.column[k]);
    Vector       *g = s.f + 3 * std::size_t(m.column[k]);
    const Vector  y0 = y[0], y1 = y[1], y2 = y[2];
    s0 += A[0] * y0 + A[1] * y1 + A[2] * y2;
    s1 += A[3] * y0 + A[4] * y1 + A[5] * y2;
    s2 += A[6] * y0 + A[7] * y1 + A[8] * y2;
    g[0] += A[0] * x0 + A[3] * x1 + A[6] * x2;
    g[1] += A[1] * x0 + A[4] * x1 + A[7] * x2;
    g[2] += A[2] * x0 + A[5] * x1 + A[8] * x2;
  }
  sum[0] = s0, sum[1] = s1, sum[2] = s2;
}

/** Computes elastic forces and velocities of the nodes of a body without joint forces, and adds the works. */
VOUSSOIR_INLINE void predict_body(const BatchView &m, const Lanes &s, double (*works)[16],
                                  const std::size_t begin, const std::size_t end)
{
  Vector input = {}, internal = {};
  for (std::size_t k = 3 * begin; k < 3 * end; ++k)
    s.f[k] = Vector{};
  for (std::size_t i = begin; i < end; ++i)
  {
    Vector elastic[3], load[3], force[3];
    multiply_row(m, s, i, elastic);
    for (int c = 0; c < 3; ++c)
    {
      load[c] = load_of(m, s, i, c);
      force[c] = m.h * (load[c] - elastic[c]);
    }
    const float *by_force = m.inverse_mass + 9 * i;
    for (int c = 0; c < 3; ++c)
    {
      const Vector change = m.is_full[i] ? by_force[3 * c] * force[0] + by_force[3 * c + 1] * force[1] +
                                               by_force[3 * c + 2] * force[2]
                                         : by_force[4 * c] * force[c];
      const Vector before = s.v[3 * i + c], after = before + change;
      s.v[3 * i + c] = after;
      input += load[c] * (before + after);
      internal += elastic[c] * (before + after);
      s.f[3 * i + c] = elastic[c];
    }
  }
  add_to(works[0], input, .5 * m.h);
  add_to(works[1], internal, .5 * m.h);
}

/** Updates the displacements of a body and the memory of the damping. */
template <int n_terms>
VOUSSOIR_INLINE void move_body(const BatchView &m, const Lanes &s, const std::size_t begin,
                               const std::size_t end)
{
  for (std::size_t k = 3 * begin; k < 3 * end; ++k)
  {
    const Vector v = s.v[k], u = s.u[k] + m.h * v;
    Vector       w = u;
    s.u[k] = u;
    for (int z = 0; z < n_terms; ++z)
    {
      const Vector d = m.decay[z] * s.d[n_terms * k + z] + m.growth[z] * v;
      s.d[n_terms * k + z] = d;
      w += m.weight[z] * d;
    }
    s.w[k] = w;
  }
}

/** Solves the conditions of a joint with friction. @p b: gap without force; its tangential part is the slip of the step.
 * Forces of open lanes are zero. In slipping lanes (H_t + lambda) f_t = -slip and |f_t| = mu f_n; Newton's method for
 * 1/|f_t| finds lambda, exactly in one pass if H is a multiple of the unit matrix. */
VOUSSOIR_INLINE void solve_friction(const BatchPair &pair, const Vector b[3], Vector f[3])
{
  const Vector zero = {}, e2 = zero + pair.H_11 / pair.H_22, most = zero + 1e6f, tiny = zero + 1e-30f;
  Vector       lambda = {};
  f[1] = f[2] = zero;
  for (int pass = 0; pass < (pair.is_coupled ? 10 : 2); ++pass)
  {
    f[0] = larger(zero, -(b[0] + pair.H_1n * f[1] + pair.H_2n * f[2]) / pair.H_nn);
    const Vector limit = pair.friction_of * f[0], s1 = (b[1] + pair.H_1n * f[0]) / pair.H_11,
                 s2 = (b[2] + pair.H_2n * f[0]) / pair.H_22;
    Vector       a1 = 1.f + lambda, a2 = 1.f + lambda * e2, p1 = s1 / a1, p2 = s2 / a2;
    const Vector square = p1 * p1 + p2 * p2 + tiny, p = square_root(square);
    lambda += (p - limit) / (limit + tiny) * (square / (p1 * p1 / a1 + p2 * p2 * e2 / a2 + tiny));
    lambda = smaller(larger(lambda, zero), most);
    a1 = 1.f + lambda, a2 = 1.f + lambda * e2;
    f[1] = -s1 / a1, f[2] = -s2 / a2;
  }
  const Mask closed = b[0] < zero && f[0] > zero;
  for (int c = 0; c < 3; ++c)
    f[c] = closed ? f[c] : zero;
}

/** Reduces the friction of a slip that reverses until its work is zero, as Leapfrog::without_gain(). @p moved1, @p moved2:
 * slip of the last step. */
VOUSSOIR_INLINE void avoid_gain(const BatchPair &pair, const Vector b[3], const Vector moved1,
                                const Vector moved2, Vector f[3])
{
  const Vector zero = {}, one = zero + 1.f, n = pair.H_1n * f[1] + pair.H_2n * f[2];
  const Vector work = f[1] * (b[1] + pair.H_1n * f[0] + pair.H_11 * f[1] + moved1) +
                      f[2] * (b[2] + pair.H_2n * f[0] + pair.H_22 * f[2] + moved2);
  const Vector most = pair.H_11 * f[1] * f[1] + pair.H_22 * f[2] * f[2] - n * n / pair.H_nn + 1e-30f;
  const Vector less = smaller(larger(work, zero) / most, one);
  f[0] = larger(f[0] + less * n / pair.H_nn, zero), f[1] -= less * f[1], f[2] -= less * f[2];
}

/** Solves the conditions of a joint without slip. @p b: gap without force. */
VOUSSOIR_INLINE void solve_no_slip(const BatchPair &pair, const Vector b[3], Vector f[3])
{
  const float *I = pair.inverse;
  f[0] = -(I[0] * b[0] + I[1] * b[1] + I[2] * b[2]);
  f[1] = -(I[1] * b[0] + I[3] * b[1] + I[4] * b[2]);
  f[2] = -(I[2] * b[0] + I[4] * b[1] + I[5] * b[2]);
  if (pair.kind == BatchPair::tied)
    return;
  const Mask closed = f[0] > Vector{};
  f[0] = closed ? f[0] : Vector{};
  f[1] = closed ? f[1] : -b[1] / pair.H_11;
  f[2] = closed ? f[2] : -b[2] / pair.H_22;
}

/** Adds the joint force of a pair to its nodes, and the change of the works of predict_body(). */
template <int n_terms>
VOUSSOIR_INLINE void kick(const BatchView &m, const Lanes &s, const BatchPair &pair, const Vector f[3],
                          Vector &input, Vector &internal)
{
  for (int side = 0; side < 2; ++side)
  {
    if (pair.node[side] < 0)
      continue;
    const std::size_t i = pair.node[side];
    const float      *B = pair.impulse[side];
    for (int c = 0; c < 3; ++c)
    {
      const Vector      change = B[3 * c] * f[0] + B[3 * c + 1] * f[1] + B[3 * c + 2] * f[2];
      const std::size_t k = 3 * i + c;
      input += load_of(m, s, i, c) * change;
      internal += s.f[k] * change;
      s.v[k] += change;
      s.u[k] += m.h * change;
      s.w[k] += m.jolt * change;
      for (int z = 0; z < n_terms; ++z)
        s.d[n_terms * k + z] += m.growth[z] * change;
    }
  }
}

/** Works of the joints in a step. */
struct JointWorks
{
  Vector input = {}, internal = {}, opening = {}, friction = {};
};

template <int n_terms>
VOUSSOIR_INLINE void solve_pair(const BatchView &m, const Lanes &s, const std::size_t q, JointWorks &works)
{
  const BatchPair &pair = m.pairs[q];
  const Vector     zero = {};
  Vector           rate[3], b[3], f[3] = {zero, zero, zero}, after[3];
  for (int c = 0; c < 3; ++c)
    rate[c] = (pair.node[1] < 0 ? zero : s.v[3 * std::size_t(pair.node[1]) + c]) -
              (pair.node[0] < 0 ? zero : s.v[3 * std::size_t(pair.node[0]) + c]);
  for (int c = 0; c < 3; ++c)
  {
    const float *axis = pair.frame + 3 * c;
    b[c] = m.h * (axis[0] * rate[0] + axis[1] * rate[1] + axis[2] * rate[2]);
    if (c == 0 || pair.kind != BatchPair::friction)
      b[c] += s.gap[3 * q + c];
  }
  const bool is_active = pair.kind != BatchPair::friction || any(b[0] < zero);
  if (is_active && pair.kind == BatchPair::friction)
  {
    solve_friction(pair, b, f);
    avoid_gain(pair, b, s.moved[3 * q + 1], s.moved[3 * q + 2], f);
  }
  else if (is_active)
    solve_no_slip(pair, b, f);
  after[0] = b[0] + pair.H_nn * f[0] + pair.H_1n * f[1] + pair.H_2n * f[2];
  after[1] = b[1] + pair.H_1n * f[0] + pair.H_11 * f[1];
  after[2] = b[2] + pair.H_2n * f[0] + pair.H_22 * f[2];
  if (pair.kind == BatchPair::friction)
    after[0] = f[0] > zero ? larger(after[0], zero) : b[0];
  if (is_active)
    kick<n_terms>(m, s, pair, f, works.input, works.internal);
  for (int c = 0; c < 3; ++c)
  {
    const std::size_t k = 3 * q + c;
    const bool        is_slip = c > 0 && pair.kind == BatchPair::friction; // without the rounding of the gap
    const Vector      now = is_slip ? after[c] : after[c] - s.gap[k];
    (c == 0 ? works.opening : works.friction) -= f[c] * (now + s.moved[k]);
    s.moved[k] = now;
    s.gap[k] = is_slip ? s.gap[k] + now : after[c];
    s.impulse[k] += f[c];
  }
}

template <int n_terms> void advance(const BatchView &m, const BatchState &state)
{
  const Lanes s(state);
  for (unsigned int b = 0; b < m.n_bodies; ++b)
  {
    predict_body(m, s, state.works, m.body[b], m.body[b + 1]);
    move_body<n_terms>(m, s, m.body[b], m.body[b + 1]);
  }
  JointWorks works;
  for (std::size_t q = 0; q < m.n_pairs; ++q)
    solve_pair<n_terms>(m, s, q, works);
  add_to(state.works[0], works.input, .5 * m.h);
  add_to(state.works[1], works.internal, .5 * m.h);
  add_to(state.works[2], works.opening, .5);
  add_to(state.works[3], works.friction, .5);
}

inline void advance_any(const BatchView &m, const BatchState &state)
{
  switch (m.n_terms)
  {
  case 0:
    return advance<0>(m, state);
  case 1:
    return advance<1>(m, state);
  case 2:
    return advance<2>(m, state);
  case 3:
    return advance<3>(m, state);
  default:
    return advance<4>(m, state);
  }
}
