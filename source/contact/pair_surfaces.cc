// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/contact/pair_surfaces.h>

#include <voussoir/contact/pair_conditions.h>

namespace Voussoir
{
  namespace
  {
    const Matrix3 one = {{1., 0., 0., 0., 1., 0., 0., 0., 1.}};

    /** Transforms equations from the frame @p axes to that of the pair. */
    void rotate(const Matrix3 &axes, PairEquations &e)
    {
      const Matrix3 back = transpose(axes);
      e.residual = back * e.residual;
      e.d_force = times(back, times(e.d_force, axes));
      e.d_gap = times(back, times(e.d_gap, axes));
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
    /** Adds the compliance @p more to a surface, with the reference force @p centre. */
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
    other.assign(n_secondary(), {});
    const Forces none{};
    recentre(none.data(), proximal);
  }

  void PairSurfaces::recentre(const double *secondary, const double proximal)
  {
    seats = present.surfaces;
    regularised = false;
    for (std::size_t k = 0; k < n_secondary(); ++k)
      if (ContactSurface &s = seats[k + 1]; s.compliance < proximal)
      {
        soften(s, proximal - s.compliance, get(secondary, k));
        regularised = true;
      }
    regularise(0., {}, secondary);
  }

  void PairSurfaces::regularise(const double proximal, const Vector3 &force, const double *secondary)
  {
    regular = seats;
    for (std::size_t k = 0; k < regular.size() && proximal > 0.; ++k)
      soften(regular[k], proximal,
             k == 0 ? seats[0].axes * face_force(force, secondary) : get(secondary, k - 1));
    has_plain_face = regular[0].axes == one;
    own_size = 0.;
    for (const ContactSurface &s : regular)
      own_size = std::max({own_size, std::abs(s.clearance), s.compliance * norm(s.rest)});
    softest = rho;
    for (std::size_t k = 0; k < n_secondary(); ++k)
    {
      other[k].rho = rho / (1. + rho * regular[k + 1].compliance);
      other[k].from = regular[k + 1].axes * present.start;
      softest = std::min(softest, other[k].rho);
    }
  }

  Vector3 PairSurfaces::face_force(Vector3 force, const double *secondary) const
  {
    for (std::size_t k = 0; k < n_secondary(); ++k)
      if (const Vector3 r = get(secondary, k); r != Vector3{}) // most flanks are open
        force = force - transpose_times(present.surfaces[k + 1].axes, r);
    return force;
  }

  /** Computes the equations of alart_curnier() without their derivatives. resolve() has these
   * in closed form. */
  void PairSurfaces::equations_of(const ContactSurface &s, const Vector3 &force, const Vector3 &gap,
                                  Secondary &mine)
  {
    Vector3 moved = s.axes * gap;
    moved[0] += s.clearance;
    for (unsigned int c = 0; c < 3; ++c)
      moved[c] += s.compliance * (force[c] - s.rest[c]) - (c == 0 ? 0. : mine.from[c]);
    const Vector3 x = {
        {force[0] - mine.rho * moved[0], force[1] - mine.rho * moved[1], force[2] - mine.rho * moved[2]}};
    if (!(x[0] > 0.))
    {
      mine.state = PairState::open;
      mine.residual = force;
      return;
    }
    const double t = length(x[1], x[2]), radius = s.friction * x[0];
    mine.state = t <= radius ? PairState::stick : PairState::slip;
    for (unsigned int c = 0; c < 3; ++c)
      mine.residual[c] = mine.rho * moved[c];
    if (mine.state == PairState::stick)
      return;
    mine.direction = {{x[1] / t, x[2] / t}};
    mine.shrink = radius / t;
    for (unsigned int c = 1; c < 3; ++c)
      mine.residual[c] = force[c] - radius * mine.direction[c - 1];
  }

  double PairSurfaces::evaluate(const Vector3 &force, const Vector3 &gap, const double *secondary,
                                PairEquations &e)
  {
    const ContactSurface &face = regular[0];
    const Vector3         on_pair = face_force(force, secondary),
                  on_face = has_plain_face ? on_pair : face.axes * on_pair,
                  moved = face.movement(gap, present.start, on_face);
    alart_curnier(on_face, moved[0], {{moved[1], moved[2]}}, face.friction, rho, e);
    if (face.compliance > 0.)
      e.d_force = sum(e.d_force, face.compliance, e.d_gap);
    if (!has_plain_face)
      rotate(face.axes, e);
    bool sticks = e.state == PairState::stick;
    e.active = e.state == PairState::open ? 0 : present.bits[0];
    double square = 0.;
    for (std::size_t k = 0; k < n_secondary(); ++k)
    {
      const ContactSurface &s = regular[k + 1];
      const Vector3         r = get(secondary, k);
      Secondary            &mine = other[k];
      mine.is_idle = r == Vector3{} && s.distance(gap) > s.compliance * s.rest[0];
      if (mine.is_idle)
        continue;
      equations_of(s, r, gap, mine);
      square += dot(mine.residual, mine.residual);
      sticks = sticks || mine.state == PairState::stick;
      if (mine.state != PairState::open)
        e.active |= present.bits[k + 1];
    }
    e.state = e.active == 0 ? PairState::open : (sticks ? PairState::stick : PairState::slip);
    return square;
  }

  unsigned char PairSurfaces::closed_surfaces(const Vector3 &force, const Vector3 &gap,
                                              unsigned char carrying) const
  {
    const double size = norm(gap) + norm(present.start);
    for (std::size_t k = 0; k < present.surfaces.size() && carrying != 0; ++k)
    {
      // With an artificial compliance, the gap of a closed flank is the last change of its force
      // times that compliance.
      const double left = 1e-6 * (seats[k].compliance - present.surfaces[k].compliance) * norm(force);
      if (present.surfaces[k].distance(gap) <= 1e-10 * size + left)
        carrying |= present.bits[k];
    }
    return carrying;
  }

  /** Linearises the force of a surface. mine.constant receives its change for a constant gap; its stiffness
   * against the gap is added to @p stiffness. */
  void PairSurfaces::resolve(const ContactSurface &s, Secondary &mine, Matrix3 &stiffness)
  {
    const Vector3 &res = mine.residual;
    const double   c = s.compliance;
    if (mine.state == PairState::open)
      mine.constant = {{-res[0], -res[1], -res[2]}};
    else if (mine.state == PairState::stick)
    {
      for (unsigned int i = 0; i < 3; ++i)
      {
        mine.constant[i] = -res[i] / (c * mine.rho);
        stiffness[4 * i] += 1. / c;
      }
    }
    else
    {
      const double e1 = mine.direction[0], e2 = mine.direction[1], left = 1. - c * mine.rho,
                   tau = 1. - left * mine.shrink;
      const double normal = res[0] / (c * mine.rho),
                   along = e1 * res[1] + e2 * res[2] + s.friction * left * normal,
                   across = (e1 * res[2] - e2 * res[1]) / tau;
      mine.across = mine.rho * mine.shrink / tau;
      mine.constant = {{-normal, -(along * e1 - across * e2), -(along * e2 + across * e1)}};
      const Matrix3 &Q = s.axes;
      for (unsigned int i = 0; i < 3; ++i)
      {
        const double rides = (Q[i] + s.friction * (e1 * Q[3 + i] + e2 * Q[6 + i])) / c,
                     p = mine.across * (e1 * Q[6 + i] - e2 * Q[3 + i]);
        for (unsigned int j = 0; j < 3; ++j)
          stiffness[3 * i + j] += rides * Q[j] + p * (e1 * Q[6 + j] - e2 * Q[3 + j]);
      }
    }
  }

  /** Computes the change of the force of a surface for a change of the gap. */
  void PairSurfaces::find_change(const ContactSurface &s, const Secondary &mine, const Vector3 &d_gap,
                                 double *change)
  {
    std::copy(mine.constant.begin(), mine.constant.end(), change);
    if (mine.state == PairState::open)
      return;
    const Vector3 v = s.axes * d_gap;
    const double  normal = v[0] / s.compliance;
    change[0] -= normal;
    if (mine.state == PairState::stick)
    {
      change[1] -= v[1] / s.compliance;
      change[2] -= v[2] / s.compliance;
      return;
    }
    const double e1 = mine.direction[0], e2 = mine.direction[1], along = s.friction * normal,
                 across = mine.across * (e1 * v[2] - e2 * v[1]);
    change[1] -= along * e1 - across * e2;
    change[2] -= along * e2 + across * e1;
  }

  /** Sums up the secondary surfaces of the last evaluate(): their stiffness against the gap, and the change
   * of their force for a constant gap. Returns whether a secondary surface is closed. */
  bool PairSurfaces::eliminate(Matrix3 &stiffness, Vector3 &constant)
  {
    bool any = false;
    stiffness = {};
    constant = {};
    for (std::size_t k = 0; k < n_secondary(); ++k)
      if (!other[k].is_idle)
      {
        resolve(regular[k + 1], other[k], stiffness);
        any = any || other[k].state != PairState::open;
        add(constant, transpose_times(regular[k + 1].axes, other[k].constant));
      }
    return any;
  }

  void PairSurfaces::condense(PairEquations &e, const bool scaled)
  {
    Matrix3    stiffness;
    Vector3    constant;
    const bool any = eliminate(stiffness, constant);
    e.residual = e.residual - e.d_force * constant;
    if (!any)
      return;
    const Matrix3 by_force = times(e.d_force, stiffness);
    e.d_gap = sum(e.d_gap, 1., by_force);
    if (!scaled)
      return;
    Matrix3 scale = sum(one, 1. / rho, by_force);
    if (std::abs(determinant(scale)) < 1e-6)
      for (unsigned int c = 0; c < 9; ++c)
        scale[c] = c % 4 == 0 ? 1. + std::abs(stiffness[0] + stiffness[4] + stiffness[8]) / rho : 0.;
    const Matrix3 inverted = Voussoir::inverse(scale);
    e.residual = inverted * e.residual;
    e.d_force = times(inverted, e.d_force);
    e.d_gap = times(inverted, e.d_gap);
  }

  void PairSurfaces::expand(const PairEquations &e, const Vector3 &d_force, const Vector3 &d_gap,
                            double *d_secondary) const
  {
    std::fill(d_secondary, d_secondary + 3 * n_secondary(), 0.);
    if (std::all_of(other.begin(), other.end(), [](const Secondary &mine) { return mine.is_idle; }))
      return;
    Vector3 rest = e.residual; // residual of the equations for these changes of force and gap
    add(rest, e.d_force * d_force);
    add(rest, e.d_gap * d_gap);
    const Matrix3 adjoint = transpose(e.d_gap);
    Matrix3       normal = times(adjoint, e.d_gap);
    for (unsigned int c = 0; c < 3; ++c)
      normal[4 * c] += 1e-8 * rho * rho;
    const Vector3 moved = d_gap - Voussoir::inverse(normal) * (adjoint * rest);
    for (std::size_t k = 0; k < n_secondary(); ++k)
      if (!other[k].is_idle)
        find_change(regular[k + 1], other[k], moved, d_secondary + 3 * k);
  }

  double PairSurfaces::error_square(const Vector3 &force, const Vector3 &gap, const double *secondary,
                                    const double mean_rho, const bool rigid) const
  {
    const std::vector<ContactSurface> &list = rigid ? present.surfaces : regular;
    const ContactSurface              &face = list[0];
    const Vector3                      on_face = face.axes * face_force(force, secondary),
                  error = natural_map(on_face, face.movement(gap, present.start, on_face), face.friction,
                                      mean_rho);
    double square = dot(error, error);
    for (std::size_t k = 0; k < n_secondary(); ++k)
    {
      const ContactSurface &s = list[k + 1];
      const Vector3         r = get(secondary, k);
      if (r == Vector3{} && s.distance(gap) > s.compliance * s.rest[0])
        continue;
      const Vector3 e = natural_map(r, s.movement(gap, present.start, r), s.friction, mean_rho);
      square += dot(e, e);
    }
    return square;
  }
} // namespace Voussoir
