// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/contact/contact_surfaces.h>

#include <voussoir/contact/pair_conditions.h>

#include <optional>

extern "C" void dgesv_(const int *, const int *, double *, const int *, int *, double *, const int *, int *);

namespace Voussoir
{
  namespace
  {
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
  } // namespace

  SurfaceEquations::SurfaceEquations(std::vector<ContactSurface> list, const Matrix3 &H, const Vector3 &b,
                                     const Vector3 &start)
      : surfaces(std::move(list)), H(H), b(b), start(start), rho(3. / (H[0] + H[4] + H[8])),
        equations(surfaces.size())
  {
  }

  Vector3 SurfaceEquations::force(const std::vector<Vector3> &r) const
  {
    Vector3 sum{};
    for (std::size_t k = 0; k < r.size(); ++k)
      add(sum, transpose_times(surfaces[k].axes, r[k]));
    return sum;
  }

  Vector3 SurfaceEquations::gap(const std::vector<Vector3> &r) const
  {
    Vector3 result = H * force(r);
    add(result, b);
    return result;
  }

  double SurfaceEquations::evaluate(const std::vector<Vector3> &r)
  {
    const Vector3 g = gap(r);
    double        sum = 0.;
    for (std::size_t k = 0; k < r.size(); ++k)
    {
      const Vector3 local = surfaces[k].axes * g, slip = surfaces[k].axes * (g - start);
      alart_curnier(r[k], local[0] + surfaces[k].clearance, {{slip[1], slip[2]}}, surfaces[k].friction, rho,
                    equations[k]);
      sum += dot(equations[k].residual, equations[k].residual);
    }
    return std::sqrt(sum);
  }

  bool SurfaceEquations::solve(std::vector<double> &x, const int columns) const
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

  Matrix3 SurfaceEquations::derivative() const
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

  namespace
  {
    /** Gauss-Seidel over the surfaces, each solved exactly. */
    class SurfaceSweeps
    {
    public:
      SurfaceSweeps(const SurfaceEquations &system, const bool last_first)
          : system(system), last_first(last_first)
      {
        for (const ContactSurface &s : system.surfaces)
        {
          own_H.push_back(triple(s.axes, system.H, s.axes));
          slip_start.push_back(s.axes * system.start);
        }
      }

      /** One sweep; @p g = gap(r) before and after. Returns the largest change of a force. */
      double sweep(std::vector<Vector3> &r, Vector3 &g) const
      {
        double change = 0.;
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
        return change;
      }

    private:
      const SurfaceEquations &system;
      const bool              last_first;
      std::vector<Matrix3>    own_H;      ///< of each surface, in its axes
      std::vector<Vector3>    slip_start; ///< start in its axes
    };

    /** Newton's method, not held to decrease: a small slip turns its friction by a full step, which the next
     *  one mends. Where it does not converge, @p r is left as it was. */
    bool newton(SurfaceEquations &system, const double scale, std::vector<Vector3> &r)
    {
      double               smallest = system.evaluate(r);
      std::vector<Vector3> now = r, best = r;
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
            now[k][c] += x[3 * k + c];
        const double residual = system.evaluate(now);
        if (!std::isfinite(residual) || (smallest <= 1e-13 * scale && !(residual < .5 * smallest)))
          break;
        if (residual < smallest)
        {
          smallest = residual;
          best = now;
        }
      }
      if (!(smallest <= 1e-13 * scale))
        return false;
      r = best;
      return true;
    }

    /** The forces of the surfaces from r = 0. Returns whether they were found. */
    bool find_forces(SurfaceEquations &system, std::vector<Vector3> &r, const bool last_first = false)
    {
      r.assign(system.surfaces.size(), Vector3{});
      double offset = 0.;
      for (const ContactSurface &s : system.surfaces)
        offset = std::max(offset, std::abs(s.clearance));
      const double        scale = system.rho * (norm(system.b) + norm(system.start) + offset);
      const SurfaceSweeps sweeps(system, last_first);
      for (unsigned int round = 0; round < 100; ++round) // nearly always one
      {
        Vector3 g = system.gap(r);
        double  change = scale;
        for (unsigned int i = 0; i < 5 && change > 1e-15 * scale; ++i)
          change = sweeps.sweep(r, g);
        if (newton(system, scale, r))
          break;
      }
      return system.evaluate(r) <= 1e-12 * scale;
    }

    /** Those that take part when of each key the flank that is @p distance nearer does, or, where the key's
     *  bit of @p choice is set, the other one. */
    std::vector<bool> taking_part(const std::vector<ContactSurface> &surfaces,
                                  const std::vector<double> &distance, const unsigned int choice)
    {
      std::vector<bool> result(surfaces.size(), true);
      for (std::size_t k = 0; k < surfaces.size(); ++k)
        for (std::size_t l = 0; l < surfaces.size() && surfaces[k].key > 0; ++l)
          if (l != k && surfaces[l].key == surfaces[k].key)
          {
            const bool nearer = distance[k] < distance[l] || (distance[k] == distance[l] && k < l);
            result[k] = nearer != bool(choice >> (surfaces[k].key - 1) & 1);
          }
      return result;
    }
  } // namespace

  SurfaceSolution find_surface_forces(const std::vector<ContactSurface> &surfaces, const Matrix3 &H,
                                      const Vector3 &b, const Vector3 &start, const bool last_first)
  {
    int n_keys = 0;
    for (const ContactSurface &s : surfaces)
      n_keys = std::max(n_keys, s.key);
    // How far the displacement without any flank goes into each of them.
    Vector3 g = b;
    if (n_keys > 0)
    {
      SurfaceEquations     alone({surfaces[0]}, H, b, start);
      std::vector<Vector3> r;
      find_forces(alone, r);
      g = alone.gap(r);
    }
    std::vector<double> distance;
    for (const ContactSurface &s : surfaces)
      distance.push_back(s.distance(g));

    const double                   size = norm(b) + norm(start);
    std::optional<SurfaceSolution> best;
    double                         smallest = 0.;
    for (unsigned int choice = 0; choice < 1u << n_keys; ++choice)
    {
      const std::vector<bool>     part = taking_part(surfaces, distance, choice);
      std::vector<ContactSurface> list;
      std::vector<std::size_t>    which;
      for (std::size_t k = 0; k < surfaces.size(); ++k)
        if (part[k])
        {
          which.push_back(k);
          list.push_back(surfaces[k]);
        }
      SurfaceSolution trial = {std::move(which), SurfaceEquations(std::move(list), H, b, start), {}};
      const bool      solved = find_forces(trial.system, trial.r, last_first);
      double          worst = solved ? 0. : 1e-3 * size; // penetration of a flank that was left out
      g = trial.system.gap(trial.r);
      for (std::size_t k = 0; k < surfaces.size(); ++k)
        if (!part[k])
          worst = std::max(worst, -surfaces[k].distance(g));
      if (!best || worst < smallest)
      {
        best = std::move(trial);
        smallest = worst;
      }
      if (smallest <= 1e-12 * size)
        break;
    }
    return std::move(*best);
  }

  Vector3 solve_surfaces(const std::vector<ContactSurface> &surfaces, const Matrix3 &H, const Vector3 &b,
                         const Vector3 &start)
  {
    const SurfaceSolution solution = find_surface_forces(surfaces, H, b, start);
    return solution.system.force(solution.r);
  }
} // namespace Voussoir
