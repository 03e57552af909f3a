#include <voussoir/error.h>
#include <voussoir/explicit_region.h>
#include <voussoir/free_field.h>
#include <voussoir/motion.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace Voussoir
{
  IncidentWave incident_wave(const GroundMotion &outcrop)
  {
    // Velocity and displacement at the samples; between them acceleration is linear.
    struct State
    {
      Vector3 a, v, u;
    };
    std::vector<State> states;
    const double       dt = outcrop.dt;
    State              now{};
    for (const auto &sample : outcrop.acceleration)
    {
      State next;
      for (unsigned int c = 0; c < 3; ++c)
      {
        next.a[c] = .5 * sample[c];
        const double mean = states.empty() ? 0. : .5 * dt * (now.a[c] + next.a[c]);
        const double path = states.empty() ? 0. : dt * now.v[c] + dt * dt * (now.a[c] / 3. + next.a[c] / 6.);
        next.v[c] = now.v[c] + mean;
        next.u[c] = now.u[c] + path;
      }
      states.push_back(now = next);
    }
    return [states, dt](const double t)
    {
      Vector3 u{};
      if (t <= 0. || states.empty())
        return u;
      const std::size_t k = std::min<std::size_t>(t / dt, states.size() - 1);
      const State      &s = states[k];
      const double      tau = t - k * dt;
      for (unsigned int c = 0; c < 3; ++c)
      {
        const bool   last = k + 1 == states.size(); // at rest but for its velocity from here on
        const double slope = last ? 0. : (states[k + 1].a[c] - s.a[c]) / dt;
        u[c] = s.u[c] + tau * (s.v[c] + (last ? 0. : tau * (s.a[c] / 2. + tau * slope / 6.)));
      }
      return u;
    };
  }

  namespace
  {
    /** Cells after which nothing comes back within so many steps; the front's forerunners decay like those
     * of an Airy function, over (number of cells)^(1/3). */
    unsigned int endless_length(const Vector3 &courant, const unsigned int n_steps)
    {
      const double path = .5 * n_steps * *std::max_element(courant.begin(), courant.end());
      return static_cast<unsigned int>(path + 10. * std::cbrt(path)) + 50;
    }
  } // namespace

  EndlessColumn::EndlessColumn(const Vector3 &courant, const RayleighDamping &damping, const double dt,
                               const unsigned int n_steps)
      : damping(damping), dt(dt), second{}
  {
    for (unsigned int c = 0; c < 3; ++c)
      ratio[c] = courant[c] * courant[c] / (dt * dt);
    u.assign(3 * std::size_t(endless_length(courant, n_steps)), 0.);
    w = x = u;
  }

  const Vector3 &EndlessColumn::advance(const Vector3 &first)
  {
    for (unsigned int c = 0; c < 3; ++c)
    {
      w[c] = (first[c] - u[c]) / dt;
      u[c] = first[c];
    }
    const std::size_t n = u.size();
    for (std::size_t i = 0; i < n; ++i)
      x[i] = u[i] + damping.stiffness * w[i];
    for (std::size_t i = 3; i + 3 < n; i += 3)
      for (unsigned int c = 0; c < 3; ++c)
      {
        const std::size_t k = i + c;
        w[k] += dt * (ratio[c] * (x[k - 3] - 2. * x[k] + x[k + 3]) - damping.mass * w[k]);
        u[k] += dt * w[k];
      }
    std::copy(u.begin() + 3, u.begin() + 6, second.begin());
    return second;
  }

  namespace
  {
    /** Wave speeds in x, y, z. */
    Vector3 speeds(const Material &material)
    {
      const double s = s_wave_speed(material);
      return {{s, s, p_wave_speed(material)}};
    }

    Vector3 foot_courant(const RockColumn &column, const double dt)
    {
      Vector3 courant = speeds(column.material.front());
      for (double &c : courant)
        c *= dt / (column.z[1] - column.z[0]);
      return courant;
    }
  } // namespace

  FreeFieldColumn::FreeFieldColumn(const RockColumn &column, const RayleighDamping &damping, const double dt,
                                   const unsigned int n_steps, const IncidentWave &wave, const Vector3 &delay)
      : height(column.z), damping(damping), dt(dt), wave(wave), delay(delay),
        rising(foot_courant(column, dt), damping, dt, n_steps),
        leaving(foot_courant(column, dt), damping, dt, n_steps), below(12, 0.), time(1, 0.)
  {
    const std::size_t n = height.size();
    mass.assign(n, 0.);
    for (std::size_t k = 0; k + 1 < n; ++k)
    {
      const Material &m = column.material[k];
      const double    h = height[k + 1] - height[k];
      mass[k] += .5 * m.density * h;
      mass[k + 1] += .5 * m.density * h;
      for (const double c : speeds(m))
        stiffness.push_back(m.density * c * c / h);
    }
    mass[0] += .5 * column.material[0].density * (height[1] - height[0]);
    std::copy(stiffness.begin(), stiffness.begin() + 3, foot_stiffness.begin());
    u.assign(3 * n, 0.);
    w = x = u;
  }

  Vector3 FreeFieldColumn::incident(const double t) const
  {
    Vector3 value;
    if (delay[0] == delay[2])
      return wave(t - delay[0]);
    const Vector3 s = wave(t - delay[0]), p = wave(t - delay[2]);
    value = {{s[0], s[1], p[2]}};
    return value;
  }

  void FreeFieldColumn::advance()
  {
    double *const entering = below.data(), *const at_foot = entering + 3, *const left = entering + 6,
                  *const before = entering + 9;
    Vector3              scattered, x_below;
    for (unsigned int c = 0; c < 3; ++c)
    {
      const double now = entering[c] + left[c];
      x_below[c] = now + damping.stiffness * (now - before[c]) / dt;
      before[c] = now;
      scattered[c] = u[c] - at_foot[c];
    }
    const std::size_t n = height.size();
    for (std::size_t i = 0; i < 3 * n; ++i)
      x[i] = u[i] + damping.stiffness * w[i];
    for (std::size_t k = 0; k < n; ++k)
      for (unsigned int c = 0; c < 3; ++c)
      {
        const std::size_t i = 3 * k + c;
        double f = k == 0 ? foot_stiffness[c] * (x_below[c] - x[i]) : stiffness[i - 3] * (x[i - 3] - x[i]);
        if (k + 1 < n)
          f += stiffness[i] * (x[i + 3] - x[i]);
        w[i] += dt * (f / mass[k] - damping.mass * w[i]);
        u[i] += dt * w[i];
      }
    const Vector3 &next_left = leaving.advance(scattered);
    const Vector3 &next_foot = rising.advance({{entering[0], entering[1], entering[2]}});
    time[0] += 1.;
    const Vector3 next_entering = incident(time[0] * dt);
    for (unsigned int c = 0; c < 3; ++c)
    {
      left[c] = next_left[c];
      at_foot[c] = next_foot[c];
      entering[c] = next_entering[c];
    }
  }

  std::vector<std::vector<double> *> FreeFieldColumn::state()
  {
    std::vector<std::vector<double> *> arrays = {&u, &w, &below, &time};
    for (EndlessColumn *column : {&rising, &leaving})
      for (auto *array : column->state())
        arrays.push_back(array);
    return arrays;
  }

  struct FreeField::Section
  {
    RockModel                       model;
    std::unique_ptr<ExplicitRegion> region;
    unsigned int                    direction;
    double                          plane, tolerance; ///< place along the direction [m]
    /// (horizontal, vertical) place in units of the tolerance -> node
    std::map<std::pair<long, long>, unsigned int> node_at;

    std::pair<long, long> key(const std::array<double, 3> &p) const
    {
      return {std::lround(p[1 - direction] / tolerance), std::lround(p[2] / tolerance)};
    }
  };

  namespace
  {
    bool same(const RockColumn &a, const RockColumn &b)
    {
      if (a.z.size() != b.z.size())
        return false;
      const double tolerance = 1e-9 * (a.z.back() - a.z.front());
      for (std::size_t k = 0; k < a.z.size(); ++k)
        if (std::abs(a.z[k] - b.z[k]) > tolerance)
          return false;
      for (std::size_t k = 0; k < a.material.size(); ++k)
        if (a.material[k].young != b.material[k].young || a.material[k].poisson != b.material[k].poisson ||
            a.material[k].density != b.material[k].density)
          return false;
      return true;
    }
  } // namespace

  FreeField::FreeField(const RockModel &model, const RayleighDamping &damping, const double dt,
                       const unsigned int n_steps, const IncidentWave &wave)
  {
    if (model.columns.empty())
      throw InputError("the artificial boundary has no bottom through which the earthquake could enter");
    const auto entrance = [](const RockColumn &column) { return 2. * column.z[0] - column.z[1]; };
    double     lowest = std::numeric_limits<double>::max();
    for (const RockColumn &column : model.columns)
      lowest = std::min(lowest, entrance(column));

    std::vector<unsigned int> different; // of the model's columns
    for (unsigned int c = 0; c < model.columns.size(); ++c)
    {
      const RockColumn &column = model.columns[c];
      unsigned int      k = 0;
      while (k < different.size() && !same(column, model.columns[different[k]]))
        ++k;
      number.push_back(k);
      if (k == different.size())
      {
        different.push_back(c);
        Vector3 delay = speeds(column.material.front());
        for (double &d : delay)
          d = (entrance(column) - lowest) / d;
        columns.push_back(std::make_unique<FreeFieldColumn>(column, damping, dt, n_steps, wave, delay));
        if (columns[k]->z().back() > columns[highest]->z().back())
          highest = k;
      }
    }
  }

  FreeField::~FreeField() = default;

  void FreeField::add_section(RockModel model, std::unique_ptr<ExplicitRegion> region,
                              const unsigned int direction)
  {
    auto section = std::make_unique<Section>();
    section->model = std::move(model);
    section->region = std::move(region);
    section->direction = direction;
    const auto &points = section->model.points;
    section->plane = points.front()[direction];
    double size = 0.;
    for (const auto &p : points)
      size = std::max(size, std::abs(p[2] - points.front()[2]));
    section->tolerance = 1e-6 * size;
    for (unsigned int i = 0; i < points.size(); ++i)
      section->node_at[section->key(points[i])] = i;
    sections.push_back(std::move(section));
  }

  FreeField::Point FreeField::in_column(const unsigned int column, const double z) const
  {
    const FreeFieldColumn     &c = *columns[column];
    const std::vector<double> &height = c.z();
    const unsigned int         n = std::min<std::size_t>(4, height.size());
    Point                      point{{}, {{1., 0., 0., 0.}}};
    const unsigned int         above = std::lower_bound(height.begin(), height.end(), z) - height.begin();
    for (unsigned int k = above == 0 ? 0 : above - 1; k <= above && k < height.size(); ++k)
      if (std::abs(height[k] - z) < 1e-9 * (height.back() - height.front()))
      {
        for (unsigned int i = 0; i < 4; ++i)
          point.value[i] = c.displacement(k);
        return point;
      }
    // Cubic interpolation.
    const unsigned int first = std::min<std::size_t>(above < 2 ? 0 : above - 2, height.size() - n);
    for (unsigned int i = 0; i < 4; ++i)
    {
      point.value[i] = c.displacement(first + std::min(i, n - 1));
      point.weight[i] = i < n ? 1. : 0.;
      for (unsigned int j = 0; j < n; ++j)
        if (i < n && j != i)
          point.weight[i] *= (z - height[first + j]) / (height[first + i] - height[first + j]);
    }
    return point;
  }

  bool FreeField::in_section(const std::array<double, 3> &place, Point &point) const
  {
    const Section *nearest = nullptr;
    unsigned int   node = no_node;
    for (const auto &section : sections)
    {
      const auto distance = [&](const Section &s) { return std::abs(place[s.direction] - s.plane); };
      if (nearest != nullptr && distance(*nearest) <= distance(*section))
        continue;
      const auto key = section->key(place);
      for (long a = -1; a <= 1; ++a)
        for (long b = -1; b <= 1; ++b)
        {
          const auto found = section->node_at.find({key.first + a, key.second + b});
          if (found != section->node_at.end())
          {
            nearest = section.get();
            node = found->second;
          }
        }
    }
    if (nearest == nullptr)
      return false;
    for (unsigned int i = 0; i < 4; ++i)
      point.value[i] = nearest->region->displacement().data() + 3 * std::size_t(node);
    point.weight = {{1., 0., 0., 0.}};
    return true;
  }

  FreeField::Point FreeField::of_line(const RockModel &model, const unsigned int line,
                                      const unsigned int k) const
  {
    const RockModel::Place place = model.place[line];
    if (place.column == no_node)
      return in_column(highest, model.points[model.lines[line].nodes[k]][2]);
    const unsigned int column = number[place.column];
    return in_column(column, columns[column]->z()[place.level]);
  }

  void FreeField::add_lines(const RockModel &model, const unsigned int n)
  {
    for (unsigned int line = 0; line < model.lines.size(); ++line)
    {
      std::vector<Point> found(n);
      bool               all = true;
      for (unsigned int k = 0; k < n && all; ++k)
        all = in_section(model.points[model.lines[line].nodes[k]], found[k]);
      for (unsigned int k = 0; k < n && !all; ++k)
        found[k] = of_line(model, line, k);
      points.insert(points.end(), found.begin(), found.end());
    }
  }

  void FreeField::add_nodes(const RockModel &model, const std::vector<unsigned int> &nodes)
  {
    std::map<unsigned int, std::pair<unsigned int, unsigned int>> line_of;
    for (unsigned int k = 0; k < 2; ++k)
      for (unsigned int line = 0; line < model.lines.size(); ++line)
        if (k < model.lines[line].nodes.size())
          line_of.insert({model.lines[line].nodes[k], {line, k}});
    for (const unsigned int node : nodes)
    {
      Point      point;
      const auto found = line_of.find(node);
      if (!in_section(model.points[node], point))
        point = found == line_of.end() ? in_column(highest, model.points[node][2])
                                       : of_line(model, found->second.first, found->second.second);
      points.push_back(point);
    }
  }

  void FreeField::advance()
  {
    const int n = columns.size();
#pragma omp parallel for schedule(dynamic) if (n > 1)
    for (int c = 0; c < n; ++c)
      columns[c]->advance();
    for (const auto &section : sections)
      section->region->advance();
  }

  void FreeField::evaluate(Unknowns &u) const
  {
    u.resize(3 * points.size());
    const int n = points.size();
#pragma omp parallel for schedule(static)
    for (int i = 0; i < n; ++i)
      for (unsigned int c = 0; c < 3; ++c)
      {
        const Point &p = points[i];
        u[3 * i + c] = p.weight[0] * p.value[0][c];
        for (unsigned int k = 1; k < 4; ++k)
          if (p.weight[k] != 0.)
            u[3 * i + c] += p.weight[k] * p.value[k][c];
      }
  }

  std::vector<std::vector<double> *> FreeField::state()
  {
    std::vector<std::vector<double> *> arrays;
    for (const auto &column : columns)
      for (auto *array : column->state())
        arrays.push_back(array);
    for (const auto &section : sections)
      for (auto *array : section->region->state())
        arrays.push_back(array);
    return arrays;
  }
} // namespace Voussoir
