// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/contact/pair_surfaces.h>

#include <voussoir/contact/pair_conditions.h>

#include <limits>

namespace Voussoir
{
  namespace
  {
    const Matrix3 one = {{1., 0., 0., 0., 1., 0., 0., 0., 1.}};

    /** Changes the frame of equations. */
    void rotate(const Matrix3 &axes, PairEquations &e)
    {
      const Matrix3 back = transpose(axes);
      e.residual = back * e.residual;
      e.d_force = times(back, times(e.d_force, axes));
      e.d_gap = times(back, times(e.d_gap, axes));
    }

    void equations(const ContactSurface &s, const Vector3 &force, const Vector3 &moved, const double rho,
                   PairEquations &e)
    {
      alart_curnier(force, moved[0], {{moved[1], moved[2]}}, s.friction, rho, e);
    }

    Vector3 get(const double *x, const std::size_t k)
    {
      return {{x[3 * k], x[3 * k + 1], x[3 * k + 2]}};
    }
  } // namespace

  Vector3 ContactSurface::movement(const Vector3 &gap, const Vector3 &start, const Vector3 &force) const
  {
    const Vector3 place = axes * gap, from = axes * start;
    Vector3       moved = {{place[0] + clearance, place[1] - from[1], place[2] - from[2]}};
    for (unsigned int c = 0; c < 3; ++c)
      moved[c] += compliance * (force[c] - rest[c]);
    return moved;
  }

  Vector3 ContactSurface::seat_force(const Vector3 &gap, const Vector3 &start) const
  {
    const Vector3 moved = movement(gap, start, rest);
    Vector3       force = rest;
    for (unsigned int c = 0; c < 3; ++c)
      force[c] -= moved[c] / compliance;
    const double limit = friction * force[0], t = length(force[1], force[2]);
    if (!(force[0] > 0.))
      return {};
    for (unsigned int c = 1; c < 3 && t > limit; ++c)
      force[c] *= limit / t;
    return force;
  }

  namespace
  {
    /** Gives a surface the compliance @p more besides its own, around the force @p centre. */
    void soften(ContactSurface &s, const double more, const Vector3 &centre)
    {
      const double total = s.compliance + more;
      for (unsigned int c = 0; c < 3; ++c)
        s.rest[c] = (s.compliance * s.rest[c] + more * centre[c]) / total;
      s.compliance = total;
    }
  } // namespace

  void PairSurfaces::start(PresentSurfaces surfaces, const double new_rho, const double proximal)
  {
    present = std::move(surfaces);
    rho = new_rho;
    other.assign(n_beside(), {});
    const Forces none{};
    recentre(none.data(), proximal);
  }

  void PairSurfaces::recentre(const double *beside, const double proximal)
  {
    seats = present.surfaces;
    regularised = false;
    for (std::size_t k = 0; k < n_beside(); ++k)
      if (ContactSurface &s = seats[k + 1]; s.compliance < proximal)
      {
        soften(s, proximal - s.compliance, get(beside, k));
        regularised = true;
      }
    regularise(0., {}, beside);
  }

  void PairSurfaces::regularise(const double proximal, const Vector3 &force, const double *beside)
  {
    regular = seats;
    for (std::size_t k = 0; k < regular.size() && proximal > 0.; ++k)
      soften(regular[k], proximal, k == 0 ? seats[0].axes * face_force(force, beside) : get(beside, k - 1));
    for (std::size_t k = 0; k < n_beside(); ++k)
      other[k].rho = rho / (1. + rho * regular[k + 1].compliance);
  }

  Vector3 PairSurfaces::face_force(Vector3 force, const double *beside) const
  {
    for (std::size_t k = 0; k < n_beside(); ++k)
      force = force - transpose_times(present.surfaces[k + 1].axes, get(beside, k));
    return force;
  }

  double PairSurfaces::evaluate(const Vector3 &force, const Vector3 &gap, const double *beside,
                                PairEquations &e)
  {
    const ContactSurface &face = regular[0];
    const Vector3         on_face = face.axes * face_force(force, beside);
    equations(face, on_face, face.movement(gap, present.start, on_face), rho, e);
    e.d_force = sum(e.d_force, face.compliance, e.d_gap);
    if (face.axes != one)
      rotate(face.axes, e);
    bool sticks = e.state == PairState::stick;
    e.touching = e.state == PairState::open ? 0 : present.bits[0];
    double square = 0.;
    for (std::size_t k = 0; k < n_beside(); ++k)
    {
      const ContactSurface &s = regular[k + 1];
      const Vector3         r = get(beside, k);
      Beside               &mine = other[k];
      mine.is_idle = r == Vector3{} && s.distance(gap) > s.compliance * s.rest[0];
      if (mine.is_idle)
        continue;
      equations(s, r, s.movement(gap, present.start, r), mine.rho, mine.equations);
      square += dot(mine.equations.residual, mine.equations.residual);
      sticks = sticks || mine.equations.state == PairState::stick;
      if (mine.equations.state != PairState::open)
        e.touching |= present.bits[k + 1];
    }
    e.state = e.touching == 0 ? PairState::open : (sticks ? PairState::stick : PairState::slip);
    return square;
  }

  unsigned char PairSurfaces::touching(const Vector3 &force, const Vector3 &gap, unsigned char carrying) const
  {
    const double size = norm(gap) + norm(present.start);
    for (std::size_t k = 0; k < present.surfaces.size() && carrying != 0; ++k)
    {
      // The gap of a stiff seat is what the last proximal step was.
      const double left = 1e-6 * (seats[k].compliance - present.surfaces[k].compliance) * norm(force);
      if (present.surfaces[k].distance(gap) <= 1e-10 * size + left)
        carrying |= present.bits[k];
    }
    return carrying;
  }

  void PairSurfaces::condense(PairEquations &e, const bool scaled)
  {
    Matrix3 stiffness{};
    Vector3 constant{};
    bool    any = false;
    for (std::size_t k = 0; k < n_beside(); ++k)
    {
      const ContactSurface &s = regular[k + 1];
      Beside               &mine = other[k];
      const PairEquations  &own = mine.equations;
      if (mine.is_idle)
        continue;
      if (own.state == PairState::open)
      {
        mine.per_gap = {};
        mine.constant = {{-own.residual[0], -own.residual[1], -own.residual[2]}};
      }
      else
      {
        const Matrix3 inverted = Voussoir::inverse(sum(own.d_force, s.compliance, own.d_gap));
        mine.per_gap = times(inverted, times(own.d_gap, s.axes));
        mine.constant = inverted * own.residual;
        for (double &x : mine.per_gap)
          x = -x;
        for (double &x : mine.constant)
          x = -x;
        stiffness = sum(stiffness, -1., times(transpose(s.axes), mine.per_gap));
        any = true;
      }
      add(constant, transpose_times(s.axes, mine.constant));
    }
    e.residual = e.residual - e.d_force * constant;
    if (!any)
      return;
    e.d_gap = sum(e.d_gap, 1., times(e.d_force, stiffness));
    if (!scaled)
      return;
    Matrix3 scale = sum(one, 1. / rho, times(e.d_force, stiffness));
    if (std::abs(determinant(scale)) < 1e-6)
      for (unsigned int c = 0; c < 9; ++c)
        scale[c] = c % 4 == 0 ? 1. + std::abs(stiffness[0] + stiffness[4] + stiffness[8]) / rho : 0.;
    const Matrix3 inverted = Voussoir::inverse(scale);
    e.residual = inverted * e.residual;
    e.d_force = times(inverted, e.d_force);
    e.d_gap = times(inverted, e.d_gap);
  }

  void PairSurfaces::expand(const PairEquations &e, const Vector3 &d_force, const Vector3 &d_gap,
                            double *d_beside) const
  {
    Vector3 rest = e.residual; // what the change of force leaves of the equations at this change of the gap
    add(rest, e.d_force * d_force);
    add(rest, e.d_gap * d_gap);
    const Matrix3 adjoint = transpose(e.d_gap);
    Matrix3       normal = times(adjoint, e.d_gap);
    for (unsigned int c = 0; c < 3; ++c)
      normal[4 * c] += 1e-8 * rho * rho;
    const Vector3 moved = d_gap - Voussoir::inverse(normal) * (adjoint * rest);
    for (std::size_t k = 0; k < n_beside(); ++k)
    {
      if (other[k].is_idle)
      {
        std::fill(d_beside + 3 * k, d_beside + 3 * k + 3, 0.);
        continue;
      }
      const Vector3 change = other[k].per_gap * moved;
      for (unsigned int c = 0; c < 3; ++c)
        d_beside[3 * k + c] = other[k].constant[c] + change[c];
    }
  }

  double PairSurfaces::error_square(const Vector3 &force, const Vector3 &gap, const double *beside,
                                    const double mean_rho, const bool rigid) const
  {
    const std::vector<ContactSurface> &list = rigid ? present.surfaces : regular;
    const ContactSurface              &face = list[0];
    const Vector3                      on_face = face.axes * face_force(force, beside),
                  error = natural_map(on_face, face.movement(gap, present.start, on_face), face.friction,
                                      mean_rho);
    double square = dot(error, error);
    for (std::size_t k = 0; k < n_beside(); ++k)
    {
      const ContactSurface &s = list[k + 1];
      const Vector3         r = get(beside, k);
      if (r == Vector3{} && s.distance(gap) > s.compliance * s.rest[0])
        continue;
      const Vector3 e = natural_map(r, s.movement(gap, present.start, r), s.friction, mean_rho);
      square += dot(e, e);
    }
    return square;
  }

  namespace
  {
    /** Gauss-Seidel over the surfaces of a pair, each solved exactly. @p r: their forces. */
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

  /** Most pairs touch on their face only, or nowhere: the force then. */
  bool PairSurfaces::face_alone(const Matrix3 &H, const Vector3 &b, Vector3 &force) const
  {
    const ContactSurface &face = regular[0];
    if (face.compliance > 0.)
      return false;
    const Matrix3 on_face = face.axes == one ? H : times(face.axes, times(H, transpose(face.axes)));
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

  /** Newton's method, not held to decrease. Returns the norm of the equations at the best, which is left in
   * @p force and @p beside. */
  double PairSurfaces::newton(const Matrix3 &H, const Vector3 &b, const double scale, const double accuracy,
                              Vector3 &force, Forces &beside)
  {
    double  smallest = std::numeric_limits<double>::infinity();
    Vector3 now = force;
    Forces  now_beside = beside, change{};
    for (unsigned int i = 0; i < 20 && smallest > accuracy * scale; ++i)
    {
      PairEquations e;
      Vector3       gap = H * now;
      add(gap, b);
      const double square = evaluate(now, gap, now_beside.data(), e),
                   measure = std::sqrt(square + dot(e.residual, e.residual));
      if (!std::isfinite(measure) || (smallest <= 1e2 * accuracy * scale && !(measure < .5 * smallest)))
        break;
      if (measure < smallest)
      {
        smallest = measure;
        force = now;
        beside = now_beside;
      }
      if (smallest <= accuracy * scale)
        break;
      condense(e);
      const Vector3 step = Vector3{} - Voussoir::inverse(sum(e.d_force, 1., times(e.d_gap, H))) * e.residual;
      expand(e, step, H * step, change.data());
      add(now, step);
      for (std::size_t c = 0; c < 3 * n_beside(); ++c)
        now_beside[c] += change[c];
    }
    return smallest;
  }

  Vector3 PairSurfaces::solve(const Matrix3 &H, const Vector3 &b, const double accuracy, Vector3 force,
                              double *beside)
  {
    const bool idle = std::all_of(beside, beside + 3 * n_beside(), [](const double r) { return r == 0.; });
    if (idle && face_alone(H, b, force))
    {
      std::fill(beside, beside + 3 * n_beside(), 0.);
      return force;
    }
    double size = norm(b) + norm(present.start);
    for (const ContactSurface &s : regular)
      size = std::max({size, std::abs(s.clearance), s.compliance * norm(s.rest)});
    double softest = rho; // of the surfaces
    for (std::size_t k = 0; k < n_beside(); ++k)
      softest = std::min(softest, other[k].rho);
    const double scale = softest * size;
    Forces       now{};
    std::copy(beside, beside + 3 * n_beside(), now.begin());
    double smallest = newton(H, b, scale, accuracy, force, now);
    if (smallest <= 1e2 * accuracy * scale)
    {
      std::copy(now.begin(), now.begin() + 3 * n_beside(), beside);
      return force;
    }
    // Where that circles: from sweeps over the surfaces, at first from zero.
    std::vector<Vector3> r(1 + n_beside(), Vector3{});
    for (unsigned int round = 0; round < 30 && !(smallest <= 1e2 * accuracy * scale); ++round)
    {
      for (unsigned int i = 0; i < 5u << std::min(round, 5u); ++i)
        sweep(regular, present.start, H, b, r);
      Vector3 swept{};
      Forces  swept_beside{};
      for (std::size_t k = 0; k < r.size(); ++k)
      {
        add(swept, transpose_times(regular[k].axes, r[k]));
        if (k > 0)
          std::copy(r[k].begin(), r[k].end(), swept_beside.begin() + 3 * (k - 1));
      }
      const double found = newton(H, b, scale, accuracy, swept, swept_beside);
      if (found < smallest)
      {
        smallest = found;
        force = swept;
        now = swept_beside;
      }
    }
    std::copy(now.begin(), now.begin() + 3 * n_beside(), beside);
    return force;
  }
} // namespace Voussoir
