// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/contact/key_law.h>

#include <voussoir/base/error.h>
#include <voussoir/contact/pair_conditions.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace Voussoir
{
  namespace
  {
    constexpr double pi = 3.141592653589793;

    Matrix3 identity(const double factor)
    {
      return {{factor, 0., 0., 0., factor, 0., 0., 0., factor}};
    }

    /** The joint displaced by -force/rho: what the equations solve for the compliance 1/rho. */
    Vector3 trial_gap(const Vector3 &force, const Vector3 &gap, const double rho)
    {
      Vector3 b = gap;
      for (unsigned int c = 0; c < 3; ++c)
        b[c] -= force[c] / rho;
      return b;
    }

    /** The equations of the face alone, the first of @p surfaces. False where the others have a say: where
     *  the face alone would lead into one of them, or, away from a solution, where one is touched now. */
    bool touches_on_face_only(const std::vector<ContactSurface> &surfaces, const Vector3 &force,
                              const Vector3 &gap, const Vector3 &start, const double rho, PairEquations &e)
    {
      alart_curnier(force, gap[0] + surfaces[0].clearance, {{gap[1] - start[1], gap[2] - start[2]}},
                    surfaces[0].friction, rho, e);
      const Vector3 b = trial_gap(force, gap, rho);
      const double  size = norm(b) + norm(start);
      Vector3       face_gap = b;
      for (unsigned int c = 0; c < 3; ++c)
        face_gap[c] += (force[c] - e.residual[c]) / rho;
      bool enters = false, touches = false;
      for (std::size_t k = 1; k < surfaces.size(); ++k)
      {
        enters = enters || surfaces[k].distance(face_gap) < 0.;
        touches = touches || surfaces[k].distance(gap) <= 1e-9 * size;
      }
      return !enters && (!touches || norm(e.residual) <= 1e-12 * rho * size);
    }
  } // namespace

  void SurfacesLaw::present(Vector3 &, std::vector<ContactSurface> &list,
                            std::vector<unsigned char> &bits) const
  {
    list = surfaces;
    for (std::size_t k = 0; k < surfaces.size(); ++k)
      bits.push_back(static_cast<unsigned char>(1u << k));
  }

  void SurfacesLaw::evaluate(const Vector3 &force, const Vector3 &gap, const PairPast &past, const double rho,
                             PairEquations &e) const
  {
    Vector3                     start = past.start;
    std::vector<ContactSurface> list;
    std::vector<unsigned char>  bits;
    present(start, list, bits);
    // Most pairs touch on their face only, or nowhere.
    if (list[0].axes == identity(1.) && touches_on_face_only(list, force, gap, start, rho, e))
      return;
    const Vector3   b = trial_gap(force, gap, rho);
    const double    size = norm(b) + norm(start);
    SurfaceSolution solution = find_surface_forces(list, identity(1. / rho), b, start);
    const Vector3   first = force - solution.system.force(solution.r);
    if (norm(first) > 1e-12 * rho * size) // one of two solutions: the nearer one
    {
      SurfaceSolution other = find_surface_forces(list, identity(1. / rho), b, start, true);
      if (norm(force - other.system.force(other.r)) < (1. - 1e-6) * norm(first))
        solution = std::move(other);
    }
    const SurfaceEquations     &system = solution.system;
    const std::vector<Vector3> &r = solution.r;
    e = {};
    e.residual = force;
    bool sticks = false;
    for (std::size_t k = 0; k < r.size(); ++k)
    {
      e.residual = e.residual - transpose_times(system.surfaces[k].axes, r[k]);
      if (system.equations[k].state != PairState::open)
      {
        e.touching |= bits[solution.which[k]];
        sticks = sticks || system.equations[k].state == PairState::stick;
      }
    }
    // Those that touch without force: the other flank of a tight key, too.
    const Vector3 solved_gap = system.gap(r);
    for (std::size_t k = 0; k < list.size() && e.touching != 0; ++k)
      if (list[k].distance(solved_gap) <= 1e-10 * size)
        e.touching |= bits[k];
    const Matrix3 D = system.derivative();
    for (unsigned int k = 0; k < 9; ++k)
    {
      e.d_force[k] = D[k] / rho + (k % 4 == 0 ? 1. : 0.);
      e.d_gap[k] = -D[k];
    }
    e.state = e.touching == 0 ? PairState::open : (sticks ? PairState::stick : PairState::slip);
  }

  Vector3 SurfacesLaw::solve(const Matrix3 &H, const Vector3 &b, const PairPast &past) const
  {
    Vector3                     start = past.start;
    std::vector<ContactSurface> list;
    std::vector<unsigned char>  bits;
    present(start, list, bits);
    return solve_surfaces(list, H, b, start);
  }

  std::vector<ContactSurface> SurfacesLaw::touching_surfaces(const unsigned char touching,
                                                             const bool          frictionless) const
  {
    std::vector<ContactSurface> list;
    for (std::size_t k = 0; k < surfaces.size(); ++k)
      if (touching & (1u << k))
        list.push_back({surfaces[k].axes, 0., frictionless ? 0. : surfaces[k].friction, surfaces[k].key});
    return list;
  }

  Vector3 SurfacesLaw::solve_impulse(const Matrix3 &H, const Vector3 &v, const unsigned char touching) const
  {
    return touching ? solve_surfaces(touching_surfaces(touching, false), H, v, {}) : Vector3{};
  }

  Vector3 SurfacesLaw::stop_normal(const Matrix3 &H, const Vector3 &v, const Vector3 &spent,
                                   const unsigned char touching) const
  {
    if (touching == 1)
      return face->stop_normal(H, v, spent, touching);
    Vector3 result = spent;
    if (touching)
      add(result, solve_surfaces(touching_surfaces(touching, true), H, v, {}));
    return result;
  }

  Vector3 SurfacesLaw::solve_acceleration(const Matrix3 &H, const Vector3 &b, const Vector3 &slip_velocity,
                                          const double still, const unsigned char touching) const
  {
    return touching == 1 ? face->solve_acceleration(H, b, slip_velocity, still, touching)
                         : solve_impulse(H, b, touching);
  }

  namespace
  {
    /** The flanks of a trapezoidal key that restrains slip in direction @p d (1 or 2): phi = g sin a -/+ d
     *  cos a + c >= 0 (reference: dams, 8.2). */
    void add_flanks(const unsigned int d, const KeyParameters &keys, const double friction,
                    std::vector<ContactSurface> &surfaces)
    {
      const int    number = surfaces.back().key + 1;
      const double a = keys.flank_angle * pi / 180.;
      // Exactly rectangular keys: cos(90 deg) and the like are not zero in round numbers.
      const double s = keys.flank_angle == 0. ? 0. : std::sin(a),
                   c = keys.flank_angle == 0. ? 1. : std::cos(a);
      for (const double sign : {1., -1.})
      {
        ContactSurface flank;
        flank.axes = {};
        flank.axes[0] = s, flank.axes[d] = -sign * c;
        flank.axes[3] = c, flank.axes[3 + d] = sign * s;
        flank.axes[6 + 3 - d] = 1.;
        flank.clearance = keys.clearance;
        flank.friction = friction;
        flank.key = number;
        surfaces.push_back(flank);
      }
    }

    class KSM : public SurfacesLaw
    {
    public:
      KSM(std::vector<ContactSurface> surfaces, const KeyParameters &keys)
          : SurfacesLaw(std::move(surfaces)), height(keys.height)
      {
      }

    protected:
      /** Keys out of their seats at the start of the step (opening >= height) hold nothing; when they are
       *  out of line, too, the joint cannot close but on their crests. A flank that was passed by while the
       *  key was out is taken as it lies. A start within round-off of a surface is moved onto it: otherwise
       *  the direction of friction would hang on a slip of 1e-14 m before the flank stops it. */
      void present(Vector3 &start, std::vector<ContactSurface> &list,
                   std::vector<unsigned char> &bits) const override
      {
        list.assign(1, surfaces[0]);
        bits.assign(1, 1);
        if (start[0] >= height * (1. - 1e-9))
        {
          for (std::size_t k = 1; k < surfaces.size(); ++k)
            if (surfaces[k].distance({{height, start[1], start[2]}}) < 0.)
              list[0].clearance = -height;
          return;
        }
        const double round_off = 1e-9 * height;
        if (std::abs(start[0]) <= round_off)
          start[0] = 0.;
        for (std::size_t k = 1; k < surfaces.size(); ++k)
        {
          const Vector3      normal = {{surfaces[k].axes[0], surfaces[k].axes[1], surfaces[k].axes[2]}};
          const unsigned int d = normal[1] != 0. ? 1 : 2; // of the slip that it restrains
          const double       phi = dot(normal, start) + surfaces[k].clearance;
          if (std::abs(phi) <= round_off)
            start[d] -= phi / normal[d];
        }
        for (std::size_t k = 1; k < surfaces.size(); ++k)
        {
          list.push_back(surfaces[k]);
          list.back().clearance = std::max(surfaces[k].clearance, -(surfaces[k].axes * start)[0]);
          bits.push_back(static_cast<unsigned char>(1u << k));
        }
      }

    private:
      const double height;
    };
  } // namespace

  std::unique_ptr<JointLaw> make_key_law(const LawParameters &parameters)
  {
    const KeyParameters &keys = parameters.keys;
    if (parameters.equations != Equations::alart_curnier)
      throw InputError(
          "Joints/Equations: the law KSM has the equations \"alart-curnier\" only, since a pair with "
          "keys touches on several surfaces at once.");
    if (!(keys.flank_angle >= 0. && keys.flank_angle < 90.))
      throw InputError("Joints/Keys/Flank angle must be at least 0 and less than 90 degrees.");
    if (!(keys.height >= 0. && std::isfinite(keys.height)) ||
        !(keys.clearance >= 0. && std::isfinite(keys.clearance)))
      throw InputError("Joints/Keys/Height and Joints/Keys/Clearance must be finite and at least 0 m.");
    if (!((keys.friction >= 0. && keys.friction <= 10.) || keys.friction == -1.)) // beyond, flanks only wedge
      throw InputError(
          "Joints/Keys/Friction must be at least 0 and at most 10, or -1: the friction of the faces.");
    const double                flank_friction = keys.friction < 0. ? parameters.friction : keys.friction;
    std::vector<ContactSurface> surfaces(1, {identity(1.), 0., parameters.friction, 0});
    if (keys.height > 0. && keys.direction != "vertical")
      add_flanks(1, keys, flank_friction, surfaces);
    if (keys.height > 0. && keys.direction != "radial")
      add_flanks(2, keys, flank_friction, surfaces);
    return std::make_unique<KSM>(std::move(surfaces), keys);
  }
} // namespace Voussoir
