// SPDX-License-Identifier: GPL-3.0-or-later
// Kernel of StressRecovery and of the extremes over time; see base/for_lanes.h.

using AnyVector = Vector __attribute__((aligned(4)));

VOUSSOIR_INLINE Vector load(const float *p)
{
  return *reinterpret_cast<const AnyVector *>(p);
}

/** Loads an extreme of a node. */
VOUSSOIR_INLINE Vector extreme(const StressView &m, const float *extremes, const std::size_t node)
{
  return m.by_column ? load(extremes + lanes * node) : Vector{} + extremes[node];
}

/** Six components of a stress. */
struct Components
{
  Vector xx{}, yy{}, zz{}, xy{}, yz{}, zx{}; // the compiler would keep an array in memory

  VOUSSOIR_INLINE void add(const float *value, const float *at)
  {
    const Vector x = load(at), y = load(at + lanes), z = load(at + 2 * lanes);
    xx += value[0] * x + value[1] * y + value[2] * z;
    yy += value[3] * x + value[4] * y + value[5] * z;
    zz += value[6] * x + value[7] * y + value[8] * z;
    xy += value[9] * x + value[10] * y + value[11] * z;
    yz += value[12] * x + value[13] * y + value[14] * z;
    zx += value[15] * x + value[16] * y + value[17] * z;
  }
};

/** Columns whose principal stresses may be outside of an interval: the characteristic polynomial of the deviator increases
 * beyond its largest root. Round-off of single precision makes the interval smaller. */
VOUSSOIR_INLINE Mask may_exceed(const Components &s, const Vector high, const Vector low)
{
  constexpr float tolerance = 1e-5f;
  const Vector    zero = {}, mean = (s.xx + s.yy + s.zz) / 3.f, x = s.xx - mean, y = s.yy - mean,
               z = s.zz - mean;
  const Vector shear = s.xy * s.xy + s.yz * s.yz + s.zx * s.zx,
               square = (x * x + y * y + z * z + 2.f * shear) / 6.f;
  const Vector det =
      x * (y * z - s.yz * s.yz) - s.xy * (s.xy * z - s.yz * s.zx) + s.zx * (s.xy * s.yz - y * s.zx);
  const Vector root = VOUSSOIR_SQUARE_ROOT(square), margin = tolerance * (larger(mean, -mean) + root);
  const Vector a = high - mean - margin, b = mean - low - margin, least = square + margin * root;
  const Vector share = (1.f - tolerance) * a * a - 3.f * least,
               other = (1.f - tolerance) * b * b - 3.f * least;
  return ~((a > zero) & (a * a >= least) & (a * share >= det) & (b > zero) & (b * b >= least) &
           (b * other >= -det));
}

/** Stress @p k of NodeOnFace. */
VOUSSOIR_INLINE Vector stress_on_face(const NodeOnFace &at, const unsigned int k, const Components &s)
{
  if (k == 2)
    return s.zz;
  const Stress &of = k == 0 ? at.arch : at.cantilever;
  return of[0] * s.xx + of[1] * s.yy + of[2] * s.zz + of[3] * s.xy + of[4] * s.yz + of[5] * s.zx;
}

/** Columns that change an extreme of a face. */
VOUSSOIR_INLINE Mask exceed_on_face(const StressView &m, const std::size_t i, const Components &s)
{
  Mask changes = {};
  for (std::size_t f = m.first_on_face[i]; f < m.first_on_face[i + 1]; ++f)
    for (unsigned int k = 0; k < NodeOnFace::n_stresses; ++k)
    {
      const Vector      now = stress_on_face(m.on_face[f], k, s);
      const std::size_t e = 2 * (NodeOnFace::n_stresses * f + k);
      changes |= (now > Vector{} + m.of_faces[e]) | (now < Vector{} + m.of_faces[e + 1]);
    }
  return changes;
}

VOUSSOIR_INLINE void update_on_face(const StressView &m, const std::size_t i, const Components &s)
{
  const Vector time = Vector{} + m.time;
  for (std::size_t f = m.first_on_face[i]; f < m.first_on_face[i + 1]; ++f)
    for (unsigned int k = 0; k < NodeOnFace::n_stresses; ++k)
    {
      const Vector      now = stress_on_face(m.on_face[f], k, s);
      const std::size_t e = 2 * (NodeOnFace::n_stresses * f + k);
      AnyVector        *extremes = reinterpret_cast<AnyVector *>(m.new_of_faces + lanes * e);
      AnyVector        *times = reinterpret_cast<AnyVector *>(m.times_of_faces + lanes * e);
      times[0] = now > extremes[0] ? time : times[0];
      extremes[0] = larger(now, extremes[0]);
      times[1] = now < extremes[1] ? time : times[1];
      extremes[1] = smaller(now, extremes[1]);
    }
}

inline unsigned int stress_of_node(const StressView &m, const std::size_t i, float *stress)
{
  Components s;
  for (std::size_t k = m.start[i]; k < m.start[i + 1]; ++k)
    s.add(m.block[k].data(), m.u + 3 * lanes * std::size_t(m.column[k]));
  for (std::size_t f = m.face[i]; m.traction != nullptr && f < m.face[i + 1]; ++f)
    s.add(m.of_traction[f].data(), m.traction + 3 * lanes * f);
  if (m.added != nullptr)
  {
    const Stress &to = m.added[i];
    s.xx += to[0], s.yy += to[1], s.zz += to[2], s.xy += to[3], s.yz += to[4], s.zx += to[5];
  }
  const Vector all[6] = {s.xx, s.yy, s.zz, s.xy, s.yz, s.zx};
  __builtin_memcpy(stress, all, sizeof(all));
  if (m.maximum == nullptr)
    return ~0u;
  Mask changes =
      may_exceed(s, smaller(extreme(m, m.maximum, i), Vector{} + m.lowest), extreme(m, m.minimum, i));
  if (m.first_on_face != nullptr && m.by_column)
    update_on_face(m, i, s);
  else if (m.first_on_face != nullptr)
    changes |= exceed_on_face(m, i, s);
  unsigned int columns = 0;
  if (any(changes))
    for (int lane = 0; lane < lanes; ++lane)
      columns |= (changes[lane] & 1u) << lane;
  return columns;
}
