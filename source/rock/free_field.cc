// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/error.h>
#include <voussoir/base/parallel.h>
#include <voussoir/rock/arrival.h>
#include <voussoir/rock/free_field.h>
#include <voussoir/rock/free_field_column.h>
#include <voussoir/rock/oblique_column.h>
#include <voussoir/rock/section_nodes.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace Voussoir
{
  struct FreeField::Section
  {
    std::vector<Vector3>                        points; ///< nodes [m]
    std::vector<std::unique_ptr<SectionMotion>> motions;
    unsigned int                                direction;
    double                                      plane; ///< coordinate along the direction [m]
    SectionNodes                                nodes;

    Vector3 displacement(const unsigned int node, const Vector3 &place) const
    {
      Vector3 result{};
      for (const auto &motion : motions)
      {
        const Vector3 u = motion->displacement(node, place[direction]);
        for (unsigned int c = 0; c < 3; ++c)
          result[c] += u[c];
      }
      return result;
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

  namespace
  {
    /** Returns corners of a box around the model and another place, with a margin for places one cell outside
     * [m]. */
    std::pair<Vector3, Vector3> surroundings(const RockModel &model, const Vector3 &other)
    {
      Vector3 first = other, last = other;
      for (const Vector3 &p : model.points)
        for (unsigned int d = 0; d < 3; ++d)
        {
          first[d] = std::min(first[d], p[d]);
          last[d] = std::max(last[d], p[d]);
        }
      for (unsigned int d = 0; d < 3; ++d)
      {
        const double margin = .5 * (last[d] - first[d]);
        first[d] -= margin;
        last[d] += margin;
      }
      return {first, last};
    }
  } // namespace

  FreeField::FreeField(const RockModel &model, const RockDamping &damping, const double dt,
                       const unsigned int n_steps, const IncidentWave &wave, const Incidence &incidence)
      : centre(incidence.centre)
  {
    if (model.columns.empty())
      throw InputError(
          "The artificial boundary of the rock has no bottom, through which the earthquake enters. "
          "Put the bottom faces of the rock into the surface \"artificial boundary\" (id 6).");
    double lowest = std::numeric_limits<double>::max();
    for (const RockColumn &column : model.columns)
    {
      lowest = std::min(lowest, entrance(column));
      unsigned int k = 0;
      while (k < grounds.size() && !same(column, grounds[k]))
        ++k;
      number.push_back(k);
      if (k < grounds.size())
        continue;
      grounds.push_back(column);
      if (column.z.back() > grounds[highest].z.back())
        highest = k;
    }
    columns.resize(grounds.size());
    const ColumnRun run{damping, dt, n_steps, wave, lowest};
    if (incidence.is_vertical())
      make_column = [run](const RockColumn &column) -> std::unique_ptr<GroundColumn>
      {
        Vector3 delay = wave_speeds(column.material.front());
        for (double &d : delay)
          d = (entrance(column) - run.lowest) / d;
        return std::make_unique<FreeFieldColumn>(column, run.damping, run.dt, run.n_steps, run.wave, delay);
      };
    else
      make_column = [run, incidence, box = surroundings(model, incidence.centre),
                     half_space = incidence.half_space.value_or(grounds[highest].material.front())](
                        const RockColumn &column) -> std::unique_ptr<GroundColumn>
      { return std::make_unique<ObliqueColumn>(column, run, incidence, half_space, box); };
    columns[highest] = make_column(grounds[highest]);
  }

  FreeField::~FreeField() = default;

  void FreeField::add_section(const RockModel &section, const RockModel &rock,
                              std::vector<std::unique_ptr<SectionMotion>> motions,
                              const unsigned int                          direction)
  {
    sections.push_back(std::unique_ptr<Section>(new Section{section.points,
                                                            std::move(motions),
                                                            direction,
                                                            section.points.front()[direction],
                                                            {section, direction, rock}}));
  }

  FreeField::Point FreeField::at_level(const unsigned int column, const int level, const Vector3 &place)
  {
    if (!columns[column])
      columns[column] = make_column(grounds[column]);
    return {nullptr, column, {{level}}, {{1., 0., 0., 0.}}, place};
  }

  FreeField::Point FreeField::in_column(const unsigned int column, const Vector3 &place)
  {
    const std::vector<double> &height = grounds[column].z;
    const double               z = place[2];
    const unsigned int         n = std::min<std::size_t>(4, height.size());
    const unsigned int         above = std::lower_bound(height.begin(), height.end(), z) - height.begin();
    for (unsigned int k = above == 0 ? 0 : above - 1; k <= above && k < height.size(); ++k)
      if (std::abs(height[k] - z) < 1e-9 * (height.back() - height.front()))
        return at_level(column, k, place);
    // Cubic interpolation.
    Point              point = at_level(column, 0, place);
    const unsigned int first = std::min<std::size_t>(above < 2 ? 0 : above - 2, height.size() - n);
    for (unsigned int i = 0; i < 4; ++i)
    {
      point.level[i] = first + std::min(i, n - 1);
      point.weight[i] = i < n ? 1. : 0.;
      for (unsigned int j = 0; j < n; ++j)
        if (i < n && j != i)
          point.weight[i] *= (z - height[first + j]) / (height[first + i] - height[first + j]);
    }
    return point;
  }

  bool FreeField::in_section(const Vector3 &place, Point &point) const
  {
    point = Point();
    for (const auto &section : sections)
    {
      const auto distance = [&](const Section &s) { return std::abs(place[s.direction] - s.plane); };
      if (point.section != nullptr && distance(*point.section) <= distance(*section))
        continue;
      if (const auto found = section->nodes.find(place))
        point = {section.get(), no_node, found->node, found->weight, place};
    }
    return point.section != nullptr;
  }

  FreeField::Point FreeField::of_line(const RockModel &model, const unsigned int line, const Vector3 &place)
  {
    const RockModel::Place at = model.place[line];
    return at.column == no_node ? in_column(highest, place) : at_level(number[at.column], at.level, place);
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
        found[k] = of_line(model, line, model.points[model.lines[line].nodes[k]]);
      points.insert(points.end(), found.begin(), found.end());
    }
  }

  void FreeField::add_end_of_line(const RockModel &model, const unsigned int line, const Vector3 &place,
                                  const bool is_below)
  {
    const unsigned int column = model.place[line].column;
    points.push_back(is_below ? at_level(column == no_node ? highest : number[column], -1, place)
                              : of_line(model, line, place));
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
        point = found == line_of.end() ? in_column(highest, model.points[node])
                                       : of_line(model, found->second.first, model.points[node]);
      points.push_back(point);
    }
  }

  void FreeField::split_up(std::vector<unsigned int> given)
  {
    kept = std::move(given);
    is_split = true;
    std::vector<double> work;
    for (const auto &column : columns)
      work.push_back(column ? column->motion().size() : 0.);
    share = Shares(work);
    find_partners();
  }

  void FreeField::find_partners()
  {
    const unsigned int       n = n_columns(), me = Ranks::rank();
    std::vector<double>      is_used(std::size_t(n) * Ranks::size(), 0.); // by each process
    std::vector<std::size_t> parts;
    for (unsigned int r = 0; r <= Ranks::size(); ++r)
      parts.push_back(std::size_t(n) * r);
    for (const unsigned int i : kept)
      if (points[i].column != no_node)
        is_used[parts[me] + points[i].column] = 1.;
    Ranks::gather(is_used.data(), parts);
    for (unsigned int r = 0; r < Ranks::size(); ++r)
    {
      Partner     partner{r, {}, {}, {}, {}};
      std::size_t n_out = 0, n_in = 0;
      for (unsigned int c = 0; c < n && r != me; ++c)
        if (share.owner(c) == me && is_used[parts[r] + c] != 0.)
        {
          partner.give.push_back(c);
          n_out += columns[c]->motion().size();
        }
        else if (share.owner(c) == r && is_used[parts[me] + c] != 0.)
        {
          partner.take.push_back(c);
          n_in += columns[c]->motion().size();
        }
      partner.out.resize(n_out);
      partner.in.resize(n_in);
      if (n_out + n_in > 0)
        partners.push_back(std::move(partner));
    }
  }

  void FreeField::begin_step(std::vector<Ranks::Message> &messages)
  {
    const int n = columns.size();
    for_each_parallel(n,
                      [&](const int c)
                      {
                        if (columns[c] && (!is_split || share.is_mine(c)))
                          columns[c]->advance();
                      });
    for (Partner &partner : partners)
    {
      auto to = partner.out.begin();
      for (const unsigned int c : partner.give)
        to = std::copy(columns[c]->motion().begin(), columns[c]->motion().end(), to);
      messages.push_back(
          {partner.rank, partner.out.data(), partner.out.size(), partner.in.data(), partner.in.size()});
    }
    for (const auto &section : sections)
      for (const auto &motion : section->motions)
        motion->begin_step(messages);
  }

  void FreeField::end_step()
  {
    for (const Partner &partner : partners)
    {
      auto from = partner.in.begin();
      for (const unsigned int c : partner.take)
      {
        Unknowns &motion = columns[c]->motion();
        std::copy_n(from, motion.size(), motion.begin());
        columns[c]->received();
        from += motion.size();
      }
    }
    for (const auto &section : sections)
      for (const auto &motion : section->motions)
        motion->end_step();
  }

  void FreeField::evaluate(Unknowns &u, const double later) const
  {
    u.resize(3 * points.size());
    const int n = is_split ? kept.size() : points.size();
#pragma omp parallel for schedule(static)
    for (int k = 0; k < n; ++k)
    {
      const std::size_t i = is_split ? kept[k] : k;
      const Vector3     value = displacement(points[i], later);
      std::copy(value.begin(), value.end(), u.begin() + 3 * i);
    }
  }

  Vector3 FreeField::displacement(const Point &point, const double later) const
  {
    Vector3 u{};
    for (unsigned int j = 0; j < 4; ++j)
      if (point.weight[j] != 0.)
      {
        const Vector3 at = point.section != nullptr
                               ? point.section->displacement(point.level[j], point.place)
                               : columns[point.column]->displacement(point.level[j], point.place, later);
        for (unsigned int c = 0; c < 3; ++c)
          u[c] += point.weight[j] * at[c];
      }
    return u;
  }

  Unknowns FreeField::upstream(const std::vector<Vector3> &places)
  {
    Section *section = nullptr;
    for (const auto &other : sections)
      if (other->direction == 0 && (section == nullptr || other->plane < section->plane))
        section = other.get();
    if (section != nullptr && upstream_nodes.empty())
      for (const Vector3 &place : places)
      {
        const auto distance = [&](const std::array<double, 3> &p)
        { return std::hypot(p[1] - place[1], p[2] - place[2]); };
        const auto &points = section->points;
        upstream_nodes.push_back(std::min_element(points.begin(), points.end(),
                                                  [&](const auto &a, const auto &b)
                                                  { return distance(a) < distance(b); }) -
                                 points.begin());
      }
    Unknowns result;
    for (std::size_t i = 0; i < places.size(); ++i)
    {
      Vector3 u;
      if (section != nullptr)
        u = section->displacement(upstream_nodes[i], {{centre[0], places[i][1], places[i][2]}});
      else
        u = displacement(in_column(highest, {{centre[0], places[i][1], places[i][2]}}));
      result.insert(result.end(), u.begin(), u.end());
    }
    return result;
  }

  void FreeField::gather_on_root()
  {
    for (unsigned int c = 0; is_split && c < columns.size(); ++c)
      for (auto *array : columns[c] ? columns[c]->state() : std::vector<std::vector<double> *>())
        Ranks::broadcast(array->data(), array->size(), share.owner(c));
    for (const auto &section : sections)
      for (const auto &motion : section->motions)
        motion->gather_on_root();
  }

  std::vector<std::vector<double> *> FreeField::state()
  {
    std::vector<std::vector<double> *> arrays;
    for (const auto &column : columns)
      if (column)
        for (auto *array : column->state())
          arrays.push_back(array);
    for (const auto &section : sections)
      for (const auto &motion : section->motions)
        for (auto *array : motion->state())
          arrays.push_back(array);
    return arrays;
  }
} // namespace Voussoir
