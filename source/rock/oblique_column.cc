// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/rock/arrival.h>
#include <voussoir/rock/cubic_in_time.h>
#include <voussoir/rock/explicit_region.h>
#include <voussoir/rock/free_field_column.h>
#include <voussoir/rock/oblique_column.h>

#include <algorithm>
#include <cmath>

namespace Voussoir
{
  namespace
  {
    /** Lame's constants and masses per volume in the equations of a column. */
    struct Moduli
    {
      double lambda, mu, mass_s, mass_z;
      Moduli(const Material &m, const double p) : mu(m.young / (2. * (1. + m.poisson)))
      {
        lambda = 2. * mu * m.poisson / (1. - 2. * m.poisson);
        mass_s = m.density - p * p * (lambda + 2. * mu);
        mass_z = m.density - p * p * mu;
      }
    };
  } // namespace

  ObliqueLine::ObliqueLine(const std::vector<Cell> &cells, const double p, const bool is_sh,
                           const RockDamping &damping, const double dt)
      : dt(dt), damping(damping)
  {
    const std::size_t n = cells.size() + 1;
    mass.assign(n, 0.);
    next = mass;
    for (Component *component : {&along_, &rest_})
      component->u = component->w = component->mass = mass;
    for (std::size_t k = 0; k + 1 < n; ++k)
    {
      const Moduli m(cells[k].material, p);
      const double h = cells[k].size;
      for (const std::size_t i : {k, k + 1})
      {
        along_.mass[i] += .5 * h * (is_sh ? cells[k].material.density : m.mass_s);
        rest_.mass[i] += .5 * h * m.mass_z;
        mass[i] += .5 * h * cells[k].material.density;
      }
      along_.stiffness.push_back(is_sh ? 0. : m.mu / h);
      rest_.stiffness.push_back((is_sh ? m.mu : m.lambda + 2. * m.mu) / h);
      G_own.push_back(is_sh ? 0. : .5 * p * (m.lambda - m.mu));
      G_other.push_back(is_sh ? 0. : .5 * p * (m.lambda + m.mu));
    }
  }

  double ObliqueLine::largest_frequency(const std::vector<Cell> &cells, const double p, const bool is_sh)
  {
    // The frequencies of the column are bounded by those of its cells. Those of a cell follow from two
    // pairs: sum of u_s with difference of u_z, and the reverse.
    double square = 0.;
    for (const Cell &cell : cells)
    {
      const Moduli m(cell.material, p);
      const double factor = 4. / (cell.size * cell.size), L = m.lambda + 2. * m.mu;
      if (is_sh)
        square = std::max(square, factor * m.mu / m.mass_z);
      else
        square = std::max({square, factor / m.mass_z * (L + p * p * m.lambda * m.lambda / m.mass_s),
                           factor / m.mass_s * (m.mu + p * p * m.mu * m.mu / m.mass_z)});
    }
    return std::sqrt(square);
  }

  void ObliqueLine::step(Component &moved, const Component &other, const double sense)
  {
    const std::vector<double> &u = moved.u, &w = moved.w, &w_other = other.w;
    const double               b = damping.stiffness;
    const std::size_t          n = u.size();
    double                     from_below = 0.; // force of the cell below on the node
    for (std::size_t k = 0; k < n; ++k)
    {
      double f = from_below;
      if (k + 1 < n)
      {
        const double stress = moved.stiffness[k] * (u[k + 1] - u[k] + b * (w[k + 1] - w[k])),
                     own = sense * G_own[k];
        f += stress + own * w_other[k] - G_other[k] * w_other[k + 1];
        from_below = -stress + G_other[k] * w_other[k] - own * w_other[k + 1];
      }
      if (k > 0)
        next[k] = w[k] + dt * (f - damping.mass * mass[k] * w[k]) / moved.mass[k];
    }
    for (std::size_t k = 1; k < n; ++k)
    {
      moved.w[k] = next[k];
      moved.u[k] += dt * next[k];
    }
  }

  void ObliqueLine::step_along()
  {
    step(along_, rest_, 1.);
  }

  void ObliqueLine::step_rest()
  {
    step(rest_, along_, -1.);
  }

  void ObliqueLine::set(Component &component, const double value) const
  {
    component.w[0] = (value - component.u[0]) / dt;
    component.u[0] = value;
  }

  /** One wave in a column. */
  struct ObliqueColumn::Part
  {
    PlaneWave wave;
    double    p, origin, dt; ///< slowness [s/m]; coordinate along the wave where the delay is zero [m]; [s]
    unsigned int                 n_substeps = 1, n_levels = 0; ///< n_levels: nodes of the column
    unsigned int                 lead = 0, n_kept = 0;         ///< steps ahead of the region; steps in ring
    std::unique_ptr<ObliqueLine> ground, rising, leaving;
    IncidentWave                 motion;
    double                       x, y;         ///< components of the horizontal direction of propagation
    double                       delay;        ///< of the wave at the entrance of this column [s]
    std::vector<double>          clock = {0.}; ///< number of steps of the column
    std::vector<double>          ring; ///< per step and node: u_s half a substep earlier, u_z or u of SH [m]

    Part(const PlaneWave &wave, const Incidence &incidence, const IncidentWave &motion,
         const Material &half_space, double dt);

    void        set_lines(const std::vector<ObliqueLine::Cell> &cells, const RockDamping &damping,
                          unsigned int n_steps);
    void        set_times(const Vector3 &first, const Vector3 &last);
    bool        is_sh() const { return wave.type == PlaneWave::SH; }
    double      amplitude(double t) const;
    void        advance(double *motion);
    void        keep(const double *motion);
    void        substep(double t);
    std::size_t n_values() const { return 2 * (n_levels + 1); }
    void        add(unsigned int node, const Vector3 &place, double later, Vector3 &u) const;
    double      sample(unsigned int node, unsigned int component, double step) const;
  };

  double ObliqueColumn::Part::amplitude(const double t) const
  {
    const Vector3 u = motion(t - delay);
    return wave.type == PlaneWave::P    ? u[2]
           : wave.type == PlaneWave::SV ? x * u[0] + y * u[1]
                                        : x * u[1] - y * u[0];
  }

  /** Advances by a substep to the time @p t. */
  void ObliqueColumn::Part::substep(const double t)
  {
    const double step = dt / n_substeps, sine = std::sin(wave.angle), cosine = std::cos(wave.angle);
    const double d_s = wave.type == PlaneWave::P    ? sine
                       : wave.type == PlaneWave::SV ? cosine
                                                    : 0.,
                 d_z = wave.type == PlaneWave::P    ? cosine
                       : wave.type == PlaneWave::SV ? -sine
                                                    : 1.,
                 sense = is_sh() ? 1. : -1.; // z of the leaving half-space points downward
    for (ObliqueLine *line : {ground.get(), rising.get(), leaving.get()})
      line->step_along();
    rising->set_along(d_s * amplitude(t - .5 * step));
    leaving->set_along(ground->along(1) - rising->along(1));
    ground->set_along(rising->along(0) + leaving->along(1));
    for (ObliqueLine *line : {ground.get(), rising.get(), leaving.get()})
      line->step_rest();
    rising->set_rest(d_z * amplitude(t));
    leaving->set_rest(sense * (ground->rest(1) - rising->rest(1)));
    ground->set_rest(rising->rest(0) + sense * leaving->rest(1));
  }

  void ObliqueColumn::Part::advance(double *const values)
  {
    for (unsigned int k = 1; k <= n_substeps; ++k)
      substep((clock[0] + double(k) / n_substeps) * dt);
    for (unsigned int i = 0; i <= n_levels; ++i)
    {
      values[2 * i] = ground->along(i);
      values[2 * i + 1] = ground->rest(i);
    }
    keep(values);
  }

  /** Completes a step with the given motion of the nodes. */
  void ObliqueColumn::Part::keep(const double *const values)
  {
    clock[0] += 1.;
    std::copy_n(values, n_values(), &ring[n_values() * (std::size_t(clock[0]) % n_kept)]);
  }

  /** Returns a component at a time in steps. */
  double ObliqueColumn::Part::sample(const unsigned int node, const unsigned int component,
                                     const double step) const
  {
    return cubic_in_time(step, [&](const std::size_t k)
                         { return ring[n_values() * (k % n_kept) + 2 * node + component]; });
  }

  void ObliqueColumn::Part::add(const unsigned int node, const Vector3 &place, const double later,
                                Vector3 &u) const
  {
    const double step = clock[0] - lead + (later - p * (x * place[0] + y * place[1] - origin)) / dt;
    const double rest = sample(node, 1, step);
    const double along = is_sh() ? 0. : sample(node, 0, step + .5 / n_substeps);
    u[0] += is_sh() ? -y * rest : x * along;
    u[1] += is_sh() ? x * rest : y * along;
    u[2] += is_sh() ? 0. : rest;
  }

  ObliqueColumn::Part::Part(const PlaneWave &wave, const Incidence &incidence, const IncidentWave &motion,
                            const Material &half_space, const double dt)
      : wave(wave), p(wave.slowness(half_space)), origin(wave.along(incidence.centre)), dt(dt),
        motion(motion), x(std::cos(wave.azimuth)), y(std::sin(wave.azimuth)), delay(wave.delay)
  {
  }

  /** Sets the number of steps that the column is ahead of the region and the number of steps that it keeps,
   * for places in a box. */
  void ObliqueColumn::Part::set_times(const Vector3 &first, const Vector3 &last)
  {
    double least = 0., most = 0.; // delay in the box [s]
    for (const double x : {first[0], last[0]})
      for (const double y : {first[1], last[1]})
      {
        const double tau = p * (wave.along({{x, y, 0.}}) - origin);
        least = std::min(least, tau);
        most = std::max(most, tau);
      }
    lead = std::ceil(-least / dt) + 3;
    n_kept = lead + std::ceil(most / dt) + 6;
  }

  /** Creates the lines. @p cells: one cell below the column, whose properties the half-spaces have, and those
   * of the column. */
  void ObliqueColumn::Part::set_lines(const std::vector<ObliqueLine::Cell> &cells, const RockDamping &damping,
                                      const unsigned int n_steps)
  {
    const double frequency = ObliqueLine::largest_frequency(cells, p, is_sh());
    n_substeps = std::ceil(dt / critical_time_step(frequency, damping) * (1. + 1e-6));
    const double step = dt / n_substeps;
    PlaneWave    fastest;
    fastest.type = is_sh() ? PlaneWave::SH : PlaneWave::P;
    const double       courant = step / (fastest.vertical_slowness(cells[0].material, p) * cells[0].size);
    const unsigned int length = endless_length({{courant, 0., 0.}}, n_substeps * (n_steps + lead));
    const std::vector<ObliqueLine::Cell> endless(length, cells[0]);
    ground = std::make_unique<ObliqueLine>(cells, p, is_sh(), damping, step);
    rising = std::make_unique<ObliqueLine>(endless, p, is_sh(), damping, step);
    leaving = std::make_unique<ObliqueLine>(endless, p, is_sh(), damping, step);
    n_levels = cells.size();
    ring.assign(n_kept * n_values(), 0.);
  }

  ObliqueColumn::ObliqueColumn(const RockColumn &column, const ColumnRun &run, const Incidence &incidence,
                               const Material &half_space, const std::pair<Vector3, Vector3> &box)
  {
    std::vector<ObliqueLine::Cell> cells = {{column.z[1] - column.z[0], column.material[0]}};
    for (std::size_t k = 0; k < column.material.size(); ++k)
      cells.push_back({column.z[k + 1] - column.z[k], column.material[k]});
    for (const PlaneWave &given : incidence.waves)
    {
      check_incidence(given, column.material, half_space);
      auto part = std::make_unique<Part>(given, incidence, run.wave, half_space, run.dt);
      part->delay += (entrance(column) - run.lowest) * given.vertical_slowness(cells[0].material, part->p);
      part->set_times(box.first, box.second);
      part->set_lines(cells, run.damping, run.n_steps);
      latest.resize(latest.size() + part->n_values(), 0.);
      for (unsigned int k = 0; k < part->lead; ++k)
        part->advance(&latest[latest.size() - part->n_values()]);
      parts.push_back(std::move(part));
    }
  }

  ObliqueColumn::~ObliqueColumn() = default;

  void ObliqueColumn::advance()
  {
    double *motion = latest.data();
    for (const auto &part : parts)
    {
      part->advance(motion);
      motion += part->n_values();
    }
  }

  void ObliqueColumn::received()
  {
    const double *motion = latest.data();
    for (const auto &part : parts)
    {
      part->keep(motion);
      motion += part->n_values();
    }
  }

  Vector3 ObliqueColumn::displacement(const int level, const Vector3 &place, const double later) const
  {
    Vector3 u{};
    for (const auto &part : parts)
      part->add(level + 1, place, later, u);
    return u;
  }

  std::vector<std::vector<double> *> ObliqueColumn::state()
  {
    std::vector<std::vector<double> *> arrays;
    for (const auto &part : parts)
    {
      arrays.push_back(&part->clock);
      arrays.push_back(&part->ring);
      for (ObliqueLine *line : {part->ground.get(), part->rising.get(), part->leaving.get()})
        for (auto *array : line->state())
          arrays.push_back(array);
    }
    return arrays;
  }
} // namespace Voussoir
