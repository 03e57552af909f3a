// SPDX-License-Identifier: GPL-3.0-or-later
// Solution of one pair alone: on its face, by Newton's method, or by Gauss-Seidel iterations
// over its surfaces.
#include <voussoir/contact/pair_conditions.h>
#include <voussoir/contact/pair_surfaces.h>

#include <limits>

namespace Voussoir
{
  namespace
  {
    /** Performs a Gauss-Seidel iteration over the surfaces of a pair, with the exact solution of each.
     * @p r: their forces. */
    void sweep(const std::vector<ContactSurface> &surfaces, const Vector3 &start, const Matrix3 &H,
               const Vector3 &b, std::vector<Vector3> &r)
    {
      Vector3 force{};
      for (std::size_t k = 0; k < r.size(); ++k)
        add(force, transpose_times(surfaces[k].axes, r[k]));
      for (std::size_t k = 0; k < r.size(); ++k)
      {
        const ContactSurface &s = surfaces[k];
        Matrix3               own = times(s.axes, times(H, transpose(s.axes)));
        for (unsigned int c = 0; c < 3; ++c)
          own[4 * c] += s.compliance;
        Vector3 gap = H * force;
        add(gap, b);
        const Vector3 next = solve_coulomb(own, s.movement(gap, start, r[k]) - own * r[k], s.friction);
        add(force, transpose_times(s.axes, next - r[k]));
        r[k] = next;
      }
    }
  } // namespace

  /** Returns whether the pair touches on its face only or is open, as most pairs do. @p force is
   * then the solution. */
  bool PairSurfaces::face_alone(const Matrix3 &H, const Vector3 &b, Vector3 &force) const
  {
    const ContactSurface &face = regular[0];
    if (face.compliance > 0.)
      return false;
    const Matrix3 on_face = has_plain_face ? H : times(face.axes, times(H, transpose(face.axes)));
    const Vector3 alone = transpose_times(
        face.axes, solve_coulomb(on_face, face.movement(b, present.start, {}), face.friction));
    Vector3 gap = H * alone;
    add(gap, b);
    for (std::size_t k = 1; k < regular.size(); ++k)
      if (!(regular[k].distance(gap) >= regular[k].compliance * regular[k].rest[0]))
        return false;
    force = alone;
    return true;
  }

  /** Performs Newton's method without a line search. Returns the smallest norm of the equations; @p force and
   * @p secondary are the iterate that has it. */
  double PairSurfaces::newton(const Matrix3 &H, const Vector3 &b, const double scale, const double accuracy,
                              Vector3 &force, Forces &secondary)
  {
    double  smallest = std::numeric_limits<double>::infinity();
    Vector3 now = force;
    Forces  now_secondary;
    std::copy_n(secondary.begin(), 3 * n_secondary(), now_secondary.begin());
    for (unsigned int i = 0; i < 20 && smallest > accuracy * scale; ++i)
    {
      PairEquations e;
      Vector3       gap = H * now;
      add(gap, b);
      const double square = evaluate(now, gap, now_secondary.data(), e),
                   measure = std::sqrt(square + dot(e.residual, e.residual));
      if (!std::isfinite(measure) || (smallest <= 1e2 * accuracy * scale && !(measure < .5 * smallest)))
        break;
      if (measure < smallest)
      {
        smallest = measure;
        force = now;
        std::copy_n(now_secondary.begin(), 3 * n_secondary(), secondary.begin());
      }
      if (smallest <= accuracy * scale)
        break;
      Matrix3    stiffness;
      Vector3    constant;
      const bool any = eliminate(stiffness, constant);
      if (any)
        e.d_gap = sum(e.d_gap, 1., times(e.d_force, stiffness));
      const Vector3 step = Voussoir::inverse(sum(e.d_force, 1., times(e.d_gap, H))) *
                           (e.d_force * constant - e.residual),
                    d_gap = H * step;
      add(now, step);
      for (std::size_t k = 0; k < n_secondary(); ++k)
        if (!other[k].is_idle)
        {
          double change[3];
          find_change(regular[k + 1], other[k], d_gap, change);
          for (unsigned int c = 0; c < 3; ++c)
            now_secondary[3 * k + c] += change[c];
        }
    }
    return smallest;
  }

  Vector3 PairSurfaces::solve(const Matrix3 &H, const Vector3 &b, const double accuracy, Vector3 force,
                              double *secondary)
  {
    const bool idle =
        std::all_of(secondary, secondary + 3 * n_secondary(), [](const double r) { return r == 0.; });
    if (idle && face_alone(H, b, force))
    {
      std::fill(secondary, secondary + 3 * n_secondary(), 0.);
      return force;
    }
    const double scale = softest * std::max(norm(b) + norm(present.start), own_size);
    Forces       now{};
    std::copy(secondary, secondary + 3 * n_secondary(), now.begin());
    double smallest = newton(H, b, scale, accuracy, force, now);
    if (smallest <= 1e2 * accuracy * scale)
    {
      std::copy(now.begin(), now.begin() + 3 * n_secondary(), secondary);
      return force;
    }
    // If Newton cycles: Gauss-Seidel iterations over the surfaces, first from zero forces.
    std::vector<Vector3> r(1 + n_secondary(), Vector3{});
    for (unsigned int round = 0; round < 30 && !(smallest <= 1e2 * accuracy * scale); ++round)
    {
      for (unsigned int i = 0; i < 5u << std::min(round, 5u); ++i)
        sweep(regular, present.start, H, b, r);
      Vector3 swept{};
      Forces  swept_secondary{};
      for (std::size_t k = 0; k < r.size(); ++k)
      {
        add(swept, transpose_times(regular[k].axes, r[k]));
        if (k > 0)
          std::copy(r[k].begin(), r[k].end(), swept_secondary.begin() + 3 * (k - 1));
      }
      const double found = newton(H, b, scale, accuracy, swept, swept_secondary);
      if (found < smallest)
      {
        smallest = found;
        force = swept;
        now = swept_secondary;
      }
    }
    std::copy(now.begin(), now.begin() + 3 * n_secondary(), secondary);
    return force;
  }
} // namespace Voussoir
