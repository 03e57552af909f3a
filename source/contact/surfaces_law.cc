// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/contact/surfaces_law.h>

#include <voussoir/contact/fja_law.h>

#include <algorithm>
#include <cmath>

namespace Voussoir
{
  SurfacesLaw::SurfacesLaw(std::vector<ContactSurface> list)
      : surfaces(std::move(list)), face(make_fja_law(surfaces[0].friction))
  {
  }

  PresentSurfaces SurfacesLaw::present(const PairHistory &history) const
  {
    PresentSurfaces result{surfaces, {}, history.start};
    for (std::size_t k = 0; k < surfaces.size(); ++k)
      result.bits.push_back(static_cast<unsigned char>(1u << k));
    return result;
  }

  void SurfacesLaw::evaluate(const Vector3 &force, const Vector3 &gap, const PairHistory &history,
                             const double rho, PairEquations &e) const
  {
    PairSurfaces pair;
    pair.start(present(history), rho, 1e-3 / rho);
    std::vector<double> secondary(3 * pair.n_secondary());
    for (std::size_t k = 0; k < pair.n_secondary(); ++k)
    {
      const Vector3 r = pair.surfaces().surfaces[k + 1].seat_force(gap, pair.surfaces().start);
      std::copy(r.begin(), r.end(), secondary.begin() + 3 * k);
    }
    pair.evaluate(force, gap, secondary.data(), e);
    pair.condense(e, false);
  }

  Vector3 solve_surfaces(PresentSurfaces present, const Matrix3 &H, const Vector3 &b,
                         std::vector<double> *secondary)
  {
    double size = norm(b) + norm(present.start);
    for (const ContactSurface &s : present.surfaces)
      size = std::max(size, std::abs(s.clearance));
    const double rho = 3. / (H[0] + H[4] + H[8]), good = 1e-14 * rho * size, first = 1e-3 / rho;
    PairSurfaces pair;
    pair.start(std::move(present), rho, first);
    std::vector<double> r(3 * pair.n_secondary(), 0.);
    Vector3             force{};
    double              last = std::numeric_limits<double>::infinity();
    for (unsigned int i = 0; i < 60; ++i)
    {
      force = pair.solve(H, b, 1e-14, force, r.data());
      Vector3 gap = H * force;
      add(gap, b);
      const double error = std::sqrt(pair.error_square(force, gap, r.data(), rho, true));
      if (!pair.is_regularised() || error <= good || (error <= 1e2 * good && error > .5 * last))
        break;
      last = error;
      pair.recentre(r.data(), first);
    }
    if (secondary)
      *secondary = r;
    return force;
  }

  Vector3 SurfacesLaw::solve(const Matrix3 &H, const Vector3 &b, const PairHistory &history) const
  {
    return solve_surfaces(present(history), H, b);
  }

  std::vector<double> SurfacesLaw::secondary_forces(const PresentSurfaces &now, const Vector3 &force,
                                                    const Vector3 &gap)
  {
    std::vector<double> secondary(3 * (now.surfaces.size() - 1), 0.);
    double              size = norm(gap) + norm(now.start);
    bool                is_rigid = false, is_near = false;
    for (std::size_t k = 1; k < now.surfaces.size(); ++k)
    {
      const ContactSurface &s = now.surfaces[k];
      size = std::max(size, std::abs(s.clearance));
      is_rigid = is_rigid || s.compliance == 0.;
    }
    for (std::size_t k = 1; k < now.surfaces.size(); ++k)
    {
      const ContactSurface &s = now.surfaces[k];
      is_near = is_near || s.distance(gap) <= 1e-6 * size;
      if (s.compliance > 0.)
      {
        const Vector3 r = s.seat_force(gap, now.start);
        std::copy(r.begin(), r.end(), secondary.begin() + 3 * (k - 1));
      }
    }
    if (is_rigid && is_near && norm(force) > 0.)
    {
      // The pair alone, with a flexibility for which this force and gap are a solution.
      const double  h = size / norm(force);
      const Matrix3 H = {{h, 0., 0., 0., h, 0., 0., 0., h}};
      solve_surfaces(now, H, gap - H * force, &secondary);
    }
    return secondary;
  }

  double SurfacesLaw::friction_correction(const Vector3 &force, const Vector3 &gap,
                                          const PairHistory &history) const
  {
    if (force == Vector3{} && history.memory &&
        std::all_of(history.memory, history.memory + n_memory(), [](const double x) { return x == 0.; }) &&
        std::all_of(surfaces.begin(), surfaces.end(),
                    [&](const ContactSurface &s) { return s.distance(gap) > 0.; }))
      return 0.;
    const PresentSurfaces     now = present(history);
    const std::vector<double> secondary = secondary_forces(now, force, gap);
    const Vector3             change = gap - history.start;
    const auto along = [](const Vector3 &f, const Vector3 &d) { return f[1] * d[1] + f[2] * d[2]; };
    Vector3    on_face = force;
    double     taken = 0.;
    bool       is_flat = true; // only the face carries force or stores energy
    for (std::size_t k = 1; k < now.surfaces.size(); ++k)
    {
      const ContactSurface &s = now.surfaces[k];
      const Vector3         r = {{secondary[3 * k - 3], secondary[3 * k - 2], secondary[3 * k - 1]}};
      is_flat = is_flat && r == Vector3{} && s.rest == Vector3{};
      taken -= along(r, s.axes * change) + .5 * s.compliance * (along(r, r) - along(s.rest, s.rest));
      on_face = on_face - transpose_times(s.axes, r);
    }
    const Matrix3 &axes = now.surfaces[0].axes;
    if (is_flat && axes == Matrix3{{1., 0., 0., 0., 1., 0., 0., 0., 1.}})
      return 0.;
    return taken - along(axes * on_face, axes * change) + along(force, change);
  }

  PresentSurfaces SurfacesLaw::active_surfaces(const unsigned char active, const bool frictionless) const
  {
    PresentSurfaces result;
    for (std::size_t k = 0; k < surfaces.size(); ++k)
      if (active & (1u << k))
      {
        result.surfaces.push_back({surfaces[k].axes, 0., frictionless ? 0. : surfaces[k].friction});
        result.bits.push_back(static_cast<unsigned char>(1u << k));
      }
    result.start = {};
    return result;
  }

  Vector3 SurfacesLaw::solve_impulse(const Matrix3 &H, const Vector3 &v, const PairHistory &,
                                     const unsigned char active) const
  {
    return active ? solve_surfaces(active_surfaces(active, false), H, v) : Vector3{};
  }

  Vector3 SurfacesLaw::stop_normal(const Matrix3 &H, const Vector3 &v, const Vector3 &applied,
                                   const unsigned char active) const
  {
    if (active == 1)
      return face->stop_normal(H, v, applied, active);
    Vector3 result = applied;
    if (active)
      add(result, solve_surfaces(active_surfaces(active, true), H, v));
    return result;
  }
} // namespace Voussoir
