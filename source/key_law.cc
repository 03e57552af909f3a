#include <voussoir/error.h>
#include <voussoir/key_law.h>

#include <algorithm>
#include <cmath>

extern "C" void dgesv_(const int *, const int *, double *, const int *, int *, double *, const int *, int *);

namespace Voussoir
{
  namespace
  {
    constexpr double pi = 3.141592653589793;

    Vector3 transpose_times(const Matrix3 &a, const Vector3 &x)
    {
      return {{a[0] * x[0] + a[3] * x[1] + a[6] * x[2], a[1] * x[0] + a[4] * x[1] + a[7] * x[2],
               a[2] * x[0] + a[5] * x[1] + a[8] * x[2]}};
    }

    /** a B c^T. */
    Matrix3 triple(const Matrix3 &a, const Matrix3 &B, const Matrix3 &c)
    {
      Matrix3 result;
      for (unsigned int j = 0; j < 3; ++j)
      {
        const Vector3 column = a * (B * Vector3{{c[3 * j], c[3 * j + 1], c[3 * j + 2]}});
        for (unsigned int i = 0; i < 3; ++i)
          result[3 * i + j] = column[i];
      }
      return result;
    }

    void add(Vector3 &y, const Vector3 &x)
    {
      for (unsigned int c = 0; c < 3; ++c)
        y[c] += x[c];
    }

    double norm(const Vector3 &x)
    {
      return std::sqrt(dot(x, x));
    }

    /** Alart and Curnier's equations of all surfaces of one pair, and their solution by Newton's method. */
    class SurfaceEquations
    {
    public:
      SurfaceEquations(const std::vector<ContactSurface> &surfaces, const Matrix3 &H, const Vector3 &b,
                       const Vector3 &start)
          : surfaces(surfaces), H(H), b(b), start(start), rho(3. / (H[0] + H[4] + H[8])),
            equations(surfaces.size())
      {
      }

      Vector3 gap(const std::vector<Vector3> &r) const
      {
        Vector3 force{};
        for (std::size_t k = 0; k < r.size(); ++k)
          add(force, transpose_times(surfaces[k].axes, r[k]));
        Vector3 result = H * force;
        add(result, b);
        return result;
      }

      /** The norm of the equations [N]. */
      double evaluate(const std::vector<Vector3> &r)
      {
        const Vector3 g = gap(r);
        double        sum = 0.;
        for (std::size_t k = 0; k < r.size(); ++k)
        {
          const Vector3 local = surfaces[k].axes * g, slip = surfaces[k].axes * (g - start);
          alart_curnier(r[k], local[0] + surfaces[k].clearance, {{slip[1], slip[2]}}, surfaces[k].friction,
                        rho, equations[k]);
          sum += dot(equations[k].residual, equations[k].residual);
        }
        return std::sqrt(sum);
      }

      /** Solves J x = right-hand sides (@p columns of them, in @p x); where the surfaces hold more than three
       *  displacements J is singular, so each gets a very small compliance. */
      bool solve(std::vector<double> &x, const int columns) const
      {
        const int           m = 3 * static_cast<int>(surfaces.size());
        std::vector<double> J(m * m);
        for (std::size_t k = 0; k < surfaces.size(); ++k)
          for (std::size_t l = 0; l < surfaces.size(); ++l)
          {
            Matrix3 w = triple(surfaces[k].axes, H, surfaces[l].axes);
            if (k == l)
              for (unsigned int c = 0; c < 3; ++c)
                w[4 * c] += 1e-9 / rho;
            for (unsigned int i = 0; i < 3; ++i)
              for (unsigned int j = 0; j < 3; ++j)
              {
                double value = k == l ? equations[k].d_force[3 * i + j] : 0.;
                for (unsigned int c = 0; c < 3; ++c)
                  value += equations[k].d_gap[3 * i + c] * w[3 * c + j];
                J[(3 * l + j) * m + 3 * k + i] = value;
              }
          }
        std::vector<int> pivots(m);
        int              info = 0;
        dgesv_(&m, &columns, J.data(), &m, pivots.data(), x.data(), &m, &info);
        return info == 0;
      }

      /** d (sum of forces) / d b at the present equations. */
      Matrix3 derivative() const
      {
        const std::size_t   m = 3 * surfaces.size();
        std::vector<double> x(3 * m);
        for (std::size_t k = 0; k < surfaces.size(); ++k)
          for (unsigned int j = 0; j < 3; ++j)
          {
            const Matrix3 &q = surfaces[k].axes;
            const Vector3  column = equations[k].d_gap * Vector3{{q[j], q[3 + j], q[6 + j]}};
            for (unsigned int i = 0; i < 3; ++i)
              x[j * m + 3 * k + i] = -column[i];
          }
        Matrix3 result{};
        if (!solve(x, 3))
          return result;
        for (unsigned int j = 0; j < 3; ++j)
          for (std::size_t k = 0; k < surfaces.size(); ++k)
          {
            const double *r = x.data() + j * m + 3 * k;
            const Vector3 force = transpose_times(surfaces[k].axes, {{r[0], r[1], r[2]}});
            for (unsigned int i = 0; i < 3; ++i)
              result[3 * i + j] += force[i];
          }
        return result;
      }

      const std::vector<ContactSurface> &surfaces;
      const Matrix3                      H;
      const Vector3                      b, start;
      const double                       rho; ///< [N/m]
      std::vector<PairEquations>         equations;
    };

    /** The forces of the surfaces from r = 0; where there are several solutions, the order in which they are
     *  swept decides. Returns whether they were found. */
    bool find_forces(SurfaceEquations &system, std::vector<Vector3> &r, const bool last_first = false)
    {
      r.assign(system.surfaces.size(), Vector3{});
      Vector3 offsets{};
      for (const ContactSurface &s : system.surfaces)
        offsets[0] = std::max(offsets[0], std::abs(s.clearance));
      const double         scale = system.rho * (norm(system.b) + norm(system.start) + offsets[0]);
      Vector3              g = system.gap(r);
      std::vector<Matrix3> own_H;
      std::vector<Vector3> slip_start;
      for (const ContactSurface &s : system.surfaces)
      {
        own_H.push_back(triple(s.axes, system.H, s.axes));
        slip_start.push_back(s.axes * system.start);
      }
      for (unsigned int round = 0; round < 100; ++round) // nearly always one
      {
        double change = scale;
        for (unsigned int i = 0; i < 5 && change > 1e-15 * scale; ++i) // Gauss-Seidel
        {
          change = 0.;
          for (std::size_t l = 0; l < r.size(); ++l)
          {
            const std::size_t     k = last_first ? r.size() - 1 - l : l;
            const ContactSurface &s = system.surfaces[k];
            Vector3               local = s.axes * g;
            const Vector3         own = own_H[k] * r[k];
            local[0] += s.clearance - own[0];
            for (unsigned int c = 1; c < 3; ++c)
              local[c] -= slip_start[k][c] + own[c];
            const Vector3 force = solve_coulomb(own_H[k], local, s.friction), difference = force - r[k];
            if (difference == Vector3{})
              continue;
            change = std::max(change, norm(difference));
            add(g, system.H * transpose_times(s.axes, difference));
            r[k] = force;
          }
        }
        // Newton's method, not held to decrease: a small slip turns its friction by a full step, which the
        // next one mends. What does not converge goes back to Gauss-Seidel.
        double                     smallest = system.evaluate(r), residual = smallest;
        const std::vector<Vector3> swept = r;
        std::vector<Vector3>       best = r;
        for (unsigned int i = 0; i < 20 && smallest > 1e-15 * scale; ++i)
        {
          std::vector<double> x(3 * r.size());
          for (std::size_t k = 0; k < r.size(); ++k)
            for (unsigned int c = 0; c < 3; ++c)
              x[3 * k + c] = -system.equations[k].residual[c];
          if (!system.solve(x, 1))
            break;
          for (std::size_t k = 0; k < r.size(); ++k)
            for (unsigned int c = 0; c < 3; ++c)
              r[k][c] += x[3 * k + c];
          residual = system.evaluate(r);
          if (!std::isfinite(residual) || (smallest <= 1e-13 * scale && !(residual < .5 * smallest)))
            break;
          if (residual < smallest)
          {
            smallest = residual;
            best = r;
          }
        }
        residual = smallest;
        r = residual <= 1e-13 * scale ? best : swept;
        g = system.gap(r);
        if (residual <= 1e-13 * scale)
          break;
      }
      return system.evaluate(r) <= 1e-12 * scale;
    }

    /** The equations of those surfaces that may carry force together, and the forces that satisfy them. */
    struct Solution
    {
      std::vector<ContactSurface> surfaces; ///< those of @p which
      std::vector<std::size_t>    which;
      SurfaceEquations            system;
      std::vector<Vector3>        r;

      Solution(std::vector<ContactSurface> list, std::vector<std::size_t> which, const Matrix3 &H,
               const Vector3 &b, const Vector3 &start)
          : surfaces(std::move(list)), which(std::move(which)), system(surfaces, H, b, start)
      {
      }
      Solution(const Solution &) = delete;

      Vector3 force() const
      {
        Vector3 sum{};
        for (std::size_t k = 0; k < r.size(); ++k)
          add(sum, transpose_times(surfaces[k].axes, r[k]));
        return sum;
      }
    };

    /** One flank of each key at a time: the limit of a clearance that vanishes. Without this rule the flanks
     * of a tight key could press against each other, and against friction, by any amount. */
    std::unique_ptr<Solution> find_solution(const std::vector<ContactSurface> &surfaces, const Matrix3 &H,
                                            const Vector3 &b, const Vector3 &start,
                                            const bool last_first = false)
    {
      int n_keys = 0;
      for (const ContactSurface &s : surfaces)
        n_keys = std::max(n_keys, s.key);
      // How far the displacement without any flank goes into each of them.
      std::vector<double> distance(surfaces.size());
      Vector3             g = b;
      if (n_keys > 0)
      {
        Solution alone({surfaces[0]}, {0}, H, b, start);
        find_forces(alone.system, alone.r);
        g = alone.system.gap(alone.r);
      }
      for (std::size_t k = 0; k < surfaces.size(); ++k)
        distance[k] = (surfaces[k].axes * g)[0] + surfaces[k].clearance;
      std::unique_ptr<Solution> best;
      double                    smallest = 0.;
      for (unsigned int choice = 0; choice < 1u << n_keys; ++choice) // bit i: the other flank of key i + 1
      {
        std::vector<ContactSurface> list;
        std::vector<std::size_t>    which, left_out;
        for (std::size_t k = 0; k < surfaces.size(); ++k)
        {
          bool takes_part = true;
          for (std::size_t l = 0; l < surfaces.size() && surfaces[k].key > 0; ++l)
            if (l != k && surfaces[l].key == surfaces[k].key)
            {
              const bool nearer = distance[k] < distance[l] || (distance[k] == distance[l] && k < l);
              takes_part = nearer != bool(choice >> (surfaces[k].key - 1) & 1);
            }
          if (takes_part)
            which.push_back(k), list.push_back(surfaces[k]);
          else
            left_out.push_back(k);
        }
        auto         trial = std::make_unique<Solution>(list, which, H, b, start);
        const bool   solved = find_forces(trial->system, trial->r, last_first);
        const double size = norm(b) + norm(start);
        double       worst = solved ? 0. : 1e-3 * size;
        g = trial->system.gap(trial->r);
        for (const std::size_t k : left_out)
          worst = std::max(worst, -((surfaces[k].axes * g)[0] + surfaces[k].clearance));
        if (!best || worst < smallest)
        {
          best = std::move(trial);
          smallest = worst;
        }
        if (smallest <= 1e-12 * size)
          break;
      }
      return best;
    }

    Matrix3 identity(const double factor)
    {
      return {{factor, 0., 0., 0., factor, 0., 0., 0., factor}};
    }
  } // namespace

  Vector3 solve_surfaces(const std::vector<ContactSurface> &surfaces, const Matrix3 &H, const Vector3 &b,
                         const Vector3 &start, std::vector<Vector3> &r)
  {
    const auto solution = find_solution(surfaces, H, b, start);
    r.assign(surfaces.size(), Vector3{});
    for (std::size_t k = 0; k < solution->r.size(); ++k)
      r[solution->which[k]] = solution->r[k];
    return solution->force();
  }

  void SurfacesLaw::present(Vector3 &, std::vector<ContactSurface> &list,
                            std::vector<unsigned char> &bits) const
  {
    list = surfaces;
    for (std::size_t k = 0; k < surfaces.size(); ++k)
      bits.push_back(static_cast<unsigned char>(1u << k));
  }

  void SurfacesLaw::evaluate(const Vector3 &force, const Vector3 &gap, const Vector3 &step_start,
                             const double rho, PairEquations &e) const
  {
    Vector3                     start = step_start;
    std::vector<ContactSurface> list;
    std::vector<unsigned char>  bits;
    present(start, list, bits);
    Vector3 b = gap;
    for (unsigned int c = 0; c < 3; ++c)
      b[c] -= force[c] / rho;

    // Most pairs touch on their face only, or nowhere.
    const Matrix3 &axes = list[0].axes;
    if (axes == identity(1.))
    {
      alart_curnier(force, gap[0] + list[0].clearance, {{gap[1] - start[1], gap[2] - start[2]}},
                    list[0].friction, rho, e);
      Vector3 local_gap = b;
      for (unsigned int c = 0; c < 3; ++c)
        local_gap[c] += (force[c] - e.residual[c]) / rho;
      const double size = norm(b) + norm(start);
      bool         alone = true, clear = true; // of the flanks, where the face alone leads; of them, here
      for (std::size_t k = 1; k < list.size(); ++k)
      {
        alone = alone && (list[k].axes * local_gap)[0] + list[k].clearance >= 0.;
        clear = clear && (list[k].axes * gap)[0] + list[k].clearance > 1e-9 * size;
      }
      alone = alone && (clear || norm(e.residual) <= 1e-12 * rho * size);
      if (alone)
        return;
    }
    auto          solution = find_solution(list, identity(1. / rho), b, start);
    const Vector3 first = force - solution->force();
    if (norm(first) > 1e-12 * rho * (norm(b) + norm(start))) // one of two solutions: the nearer one
    {
      auto other = find_solution(list, identity(1. / rho), b, start, true);
      if (norm(force - other->force()) < (1. - 1e-6) * norm(first))
        solution = std::move(other);
    }
    const SurfaceEquations     &system = solution->system;
    const std::vector<Vector3> &r = solution->r;
    e = {};
    e.residual = force;
    bool sticks = false;
    for (std::size_t k = 0; k < r.size(); ++k)
    {
      e.residual = e.residual - transpose_times(solution->surfaces[k].axes, r[k]);
      if (system.equations[k].state != PairState::open)
      {
        e.touching |= bits[solution->which[k]];
        sticks = sticks || system.equations[k].state == PairState::stick;
      }
    }
    // Those that touch without force: the other flank of a tight key, too.
    const Vector3 solved_gap = system.gap(r);
    for (std::size_t k = 0; k < list.size() && e.touching != 0; ++k)
      if ((list[k].axes * solved_gap)[0] + list[k].clearance <= 1e-10 * (norm(b) + norm(start)))
        e.touching |= bits[k];
    const Matrix3 D = system.derivative();
    for (unsigned int k = 0; k < 9; ++k)
    {
      e.d_force[k] = D[k] / rho + (k % 4 == 0 ? 1. : 0.);
      e.d_gap[k] = -D[k];
    }
    e.state = e.touching == 0 ? PairState::open : (sticks ? PairState::stick : PairState::slip);
  }

  Vector3 SurfacesLaw::solve(const Matrix3 &H, const Vector3 &b, const Vector3 &step_start) const
  {
    Vector3                     start = step_start;
    std::vector<ContactSurface> list;
    std::vector<unsigned char>  bits;
    present(start, list, bits);
    std::vector<Vector3> r;
    return solve_surfaces(list, H, b, start, r);
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
    std::vector<Vector3> r;
    return touching ? solve_surfaces(touching_surfaces(touching, false), H, v, {}, r) : Vector3{};
  }

  Vector3 SurfacesLaw::stop_normal(const Matrix3 &H, const Vector3 &v, const Vector3 &spent,
                                   const unsigned char touching) const
  {
    if (touching == 1)
      return face->stop_normal(H, v, spent, touching);
    std::vector<Vector3> r;
    Vector3              result = spent;
    if (touching)
      add(result, solve_surfaces(touching_surfaces(touching, true), H, v, {}, r));
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
    void add_flanks(const unsigned int d, const KeyParameters &keys, std::vector<ContactSurface> &surfaces)
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
        flank.friction = keys.friction;
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
            if ((surfaces[k].axes * Vector3{{height, start[1], start[2]}})[0] + surfaces[k].clearance < 0.)
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

  std::unique_ptr<JointLaw> make_key_law(const double friction, const Equations equations,
                                         const KeyParameters &keys)
  {
    if (equations != Equations::alart_curnier)
      throw InputError(
          "Joints/Equations: the law KSM has the equations \"alart-curnier\" only, since a pair with "
          "keys touches on several surfaces at once.");
    if (!(keys.flank_angle >= 0. && keys.flank_angle < 90.))
      throw InputError("Joints/Keys/Flank angle must be at least 0 and less than 90 degrees.");
    std::vector<ContactSurface> surfaces(1, {identity(1.), 0., friction, 0});
    if (keys.height > 0. && keys.direction != "vertical")
      add_flanks(1, keys, surfaces);
    if (keys.height > 0. && keys.direction != "radial")
      add_flanks(2, keys, surfaces);
    return std::make_unique<KSM>(std::move(surfaces), keys);
  }
} // namespace Voussoir
