// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/error.h>
#include <voussoir/base/parallel.h>
#include <voussoir/mesh/coincident.h>
#include <voussoir/rock/arrival.h>
#include <voussoir/rock/free_field.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace Voussoir
{
  struct FreeField::Section
  {
    RockModel                       model;
    std::unique_ptr<ExplicitRegion> region;
    unsigned int                    direction;
    double                          plane; ///< coordinate along the direction [m]
    std::unique_ptr<PointFinder>    nodes; ///< nodes projected along the direction

    std::array<double, 3> projected(std::array<double, 3> place) const
    {
      place[direction] = 0.;
      return place;
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
      throw InputError(
          "The artificial boundary of the rock has no bottom, through which the earthquake enters. "
          "Put the bottom faces of the rock into the surface \"artificial boundary\" (id 6).");
    double lowest = std::numeric_limits<double>::max();
    for (const RockColumn &column : model.columns)
      lowest = std::min(lowest, entrance(column));

    std::vector<unsigned int> different; // columns of the model
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
        Vector3 delay = wave_speeds(column.material.front());
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
    std::vector<std::array<double, 3>> places;
    for (const auto &p : points)
      places.push_back(section->projected(p));
    section->nodes = std::make_unique<PointFinder>(places, 1e-6 * size);
    sections.push_back(std::move(section));
  }

  FreeField::Point FreeField::in_column(const unsigned int column, const double z) const
  {
    const FreeFieldColumn     &c = *columns[column];
    const std::vector<double> &height = c.z();
    const unsigned int         n = std::min<std::size_t>(4, height.size());
    Point                      point{{}, {{1., 0., 0., 0.}}, column};
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
      const unsigned int found = section->nodes->find(section->projected(place));
      if (found != PointFinder::none)
      {
        nearest = section.get();
        node = found;
      }
    }
    if (nearest == nullptr)
      return false;
    for (unsigned int i = 0; i < 4; ++i)
      point.value[i] = nearest->region->displacement().data() + 3 * std::size_t(node);
    point.weight = {{1., 0., 0., 0.}};
    point.column = no_node;
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

  void FreeField::split_up(std::vector<unsigned int> given)
  {
    kept = std::move(given);
    is_split = true;
    std::vector<double> work;
    for (const auto &column : columns)
      work.push_back(column->motion().size());
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
                        if (!is_split || share.is_mine(c))
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
      section->region->begin_step({}, {}, messages);
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
        from += motion.size();
      }
    }
    for (const auto &section : sections)
      section->region->end_step({});
  }

  void FreeField::evaluate(Unknowns &u) const
  {
    u.resize(3 * points.size());
    const int n = is_split ? kept.size() : points.size();
#pragma omp parallel for schedule(static)
    for (int k = 0; k < n; ++k)
      for (unsigned int c = 0; c < 3; ++c)
      {
        const std::size_t i = is_split ? kept[k] : k;
        const Point      &p = points[i];
        u[3 * i + c] = p.weight[0] * p.value[0][c];
        for (unsigned int j = 1; j < 4; ++j)
          if (p.weight[j] != 0.)
            u[3 * i + c] += p.weight[j] * p.value[j][c];
      }
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
        const auto &points = section->model.points;
        upstream_nodes.push_back(std::min_element(points.begin(), points.end(),
                                                  [&](const auto &a, const auto &b)
                                                  { return distance(a) < distance(b); }) -
                                 points.begin());
      }
    Unknowns result;
    for (std::size_t i = 0; i < places.size(); ++i)
      for (unsigned int c = 0; c < 3; ++c)
        if (section != nullptr)
          result.push_back(section->region->displacement()[3 * std::size_t(upstream_nodes[i]) + c]);
        else
        {
          const Point point = in_column(highest, places[i][2]);
          result.push_back(0.);
          for (unsigned int j = 0; j < 4; ++j)
            result.back() += point.weight[j] * point.value[j][c];
        }
    return result;
  }

  void FreeField::gather_on_root()
  {
    for (unsigned int c = 0; is_split && c < columns.size(); ++c)
      for (auto *array : columns[c]->state())
        Ranks::broadcast(array->data(), array->size(), share.owner(c));
    for (const auto &section : sections)
      section->region->gather_on_root();
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
