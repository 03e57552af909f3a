// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/lanes.h>
#include <voussoir/output/recorders.h>

#include <algorithm>
#include <cstdio>
#include <limits>

namespace Voussoir
{
  namespace
  {
    void write_row(const std::vector<double> &row, std::ostream &out)
    {
      char number[40];
      for (std::size_t i = 0; i < row.size(); ++i)
      {
        std::snprintf(number, sizeof(number), i == 0 ? "%.8g" : ",%.8g", row[i]);
        out << number;
      }
      out << '\n';
    }
  } // namespace

  void Table::write(const std::string &file) const
  {
    TableFile().open(file, *this);
  }

  void TableFile::open(const std::string &name, const Table &table)
  {
    file = std::make_unique<OutputFile>(name);
    for (std::size_t i = 0; i < table.columns.size(); ++i)
      *file << (i == 0 ? "" : ",") << table.columns[i];
    *file << '\n';
    n_written = 0;
    append(table);
  }

  void TableFile::append(const Table &table)
  {
    for (; n_written < table.rows.size(); ++n_written)
      write_row(table.rows[n_written], *file);
    file->check();
  }

  JointRecorder::JointRecorder(const Structure &structure, const DamGeometry &geometry)
      : largest(geometry.joints.size()), structure(structure), geometry(geometry),
        pressure(structure.pairs.size(), 0.), time_of_pressure(structure.pairs.size(), 0.),
        sum_of_means(geometry.joints.size(), 0.)
  {
    history.columns = {"time"};
    for (std::size_t j = 0; j < geometry.joints.size(); ++j)
      for (const char *quantity :
           {"opening_upstream", "opening_downstream", "slip_upstream", "slip_downstream"})
        history.columns.push_back(quantity + ("_" + std::to_string(j + 1)));
  }

  /** Returns two openings and two slips of a joint at the crest, upstream and downstream [m]. */
  std::array<double, 4> JointRecorder::at_crest(const Integrator &integrator, const std::size_t joint) const
  {
    const auto &pairs = geometry.joints[joint];
    if (pairs.upstream >= structure.pairs.size()) // no pairs, or a tied dam
      return {};
    const Vector3 up = integrator.opening_and_slip(pairs.upstream),
                  down = integrator.opening_and_slip(pairs.downstream);
    return {{up[0], down[0], length(up[1], up[2]), length(down[1], down[2])}};
  }

  double joint_pressure(const Structure &structure, const DynamicState &state, const unsigned int pair)
  {
    return state.force[3 * pair] / structure.pairs[pair].area;
  }

  void JointRecorder::record(const Integrator &integrator)
  {
    const double time = integrator.state().time;
    for (unsigned int p = 0; p < structure.pairs.size(); ++p)
    {
      const Vector3 d = integrator.opening_and_slip(p);
      const double  s = length(d[1], d[2]);
      reach.record(p, structure.pairs[p], d);
      points.record(p, d);
      if (d[0] > opening.value)
        opening = {d[0], time, structure.pairs[p].place};
      if (s > slip.value)
        slip = {s, time, structure.pairs[p].place};
    }
    points.end_record(time);
    keys.record(time, integrator.state().force);
    record_pressures(integrator.state());
    std::vector<double> row = {time};
    for (std::size_t j = 0; j < largest.size(); ++j)
    {
      const auto now = at_crest(integrator, j);
      row.insert(row.end(), now.begin(), now.end());
      Largest &most = largest[j];
      if (std::max(now[0], now[1]) > most.opening())
        most.time = time;
      most = {std::max(most.opening_upstream, now[0]), std::max(most.opening_downstream, now[1]),
              std::max(most.slip_upstream, now[2]), std::max(most.slip_downstream, now[3]), most.time};
    }
    history.rows.push_back(row);
  }

  void JointRecorder::record_pressures(const DynamicState &state)
  {
    std::vector<double> force(sum_of_means.size(), 0.), area(force);
    for (unsigned int p = 0; p < structure.pairs.size(); ++p)
    {
      force[structure.pairs[p].joint] += state.force[3 * p];
      area[structure.pairs[p].joint] += structure.pairs[p].area;
      if (const double now = joint_pressure(structure, state, p); now > pressure[p])
        pressure[p] = now, time_of_pressure[p] = state.time;
    }
    for (std::size_t j = 0; j < force.size(); ++j)
      sum_of_means[j] += area[j] > 0. ? force[j] / area[j] : 0.;
  }

  Table JointRecorder::pressures() const
  {
    Table table;
    table.columns = {"joint", "s", "max_pressure", "x", "y", "z", "time_of_max_pressure", "mean_pressure"};
    for (std::size_t j = 0; j < geometry.joints.size(); ++j)
    {
      std::vector<double> row = {double(j + 1), geometry.joints[j].arc_length, 0., 0., 0., 0., 0., 0.};
      for (unsigned int p = 0; p < structure.pairs.size(); ++p)
        if (const Pair &pair = structure.pairs[p]; pair.joint == j && pressure[p] > row[2])
          row = {row[0],        row[1],        pressure[p],         pair.place[0],
                 pair.place[1], pair.place[2], time_of_pressure[p], 0.};
      row[7] = sum_of_means[j] / std::max<std::size_t>(1, history.rows.size());
      table.rows.push_back(row);
    }
    return table;
  }

  std::vector<float> JointRecorder::largest_pressure(const SolidModel &model) const
  {
    std::vector<float> of_node(structure.n_nodes(), 0.f), result(model.n_nodes(), 0.f);
    for (unsigned int p = 0; p < structure.pairs.size(); ++p)
      for (const unsigned int node : {structure.pairs[p].node_1, structure.pairs[p].node_2})
        if (node != rigid_ground)
          of_node[node] = static_cast<float>(pressure[p]);
    for (unsigned int i = 0; i < model.n_nodes(); ++i)
      if (model.equation[i] != rigid_ground)
        result[i] = of_node[model.equation[i]];
    return result;
  }

  Table JointRecorder::maxima() const
  {
    Table table;
    table.columns = {"joint",
                     "s",
                     "opening_upstream",
                     "opening_downstream",
                     "slip_upstream",
                     "slip_downstream",
                     "time_of_max_opening"};
    for (std::size_t j = 0; j < largest.size(); ++j)
    {
      const Largest &most = largest[j];
      table.rows.push_back({double(j + 1), geometry.joints[j].arc_length, most.opening_upstream,
                            most.opening_downstream, most.slip_upstream, most.slip_downstream, most.time});
    }
    return table;
  }

  EnvelopeRecorder::EnvelopeRecorder(const StressRecovery &recovery, std::vector<Stress> initial)
      : maximum(initial.size(), -1e30f), minimum(initial.size(), 1e30f), time_of_maximum(initial.size(), 0.f),
        time_of_minimum(initial.size(), 0.f), recovery(recovery), initial(std::move(initial))
  {
    for (unsigned int r = 0; r <= Ranks::size(); ++r)
      begin.push_back(maximum.size() * r / Ranks::size());
  }

  void EnvelopeRecorder::record(const double time, const Unknowns &u, const std::vector<Vector3> &tractions)
  {
    const unsigned int lanes = n_lanes(), t = times.size();
    displacements.resize(lanes * u.size());
    for (std::size_t k = 0; k < u.size(); ++k)
      displacements[lanes * k + t] = static_cast<float>(u[k]);
    face_tractions.resize(std::max(face_tractions.size(), 3 * lanes * tractions.size()));
    for (std::size_t k = 0; k < face_tractions.size() / lanes; ++k)
      face_tractions[lanes * k + t] = tractions.empty() ? 0.f : static_cast<float>(tractions[k / 3][k % 3]);
    times.push_back(time);
    if (times.size() == lanes)
      evaluate();
  }

  void EnvelopeRecorder::evaluate()
  {
    StressView view = recovery.view();
    view.u = displacements.data();
    view.traction = face_tractions.empty() ? nullptr : face_tractions.data();
    view.added = initial.data();
    view.maximum = maximum.data();
    view.minimum = minimum.data();
    view.lowest = overstress.lowest_level();
    faces.show(view);
    const unsigned int  lanes = n_lanes();
    const StressKernel  kernel = stress_kernel();
    std::vector<double> intervals;
    for (const double time : times)
      intervals.push_back(overstress.begin(time));
#pragma omp parallel for schedule(static)
    for (std::size_t i = begin[Ranks::rank()]; i < begin[Ranks::rank() + 1]; ++i)
    {
      float              all[6 * most_lanes];
      const unsigned int columns = times.empty() ? 0 : kernel(view, i, all);
      for (std::size_t t = 0; columns != 0 && t < times.size(); ++t)
        if ((columns >> t & 1u) != 0)
        {
          const Stress stress = column_of(all, lanes, t);
          faces.record(i, times[t], stress);
          update(i, times[t], intervals[t], stress);
        }
    }
    times.clear();
  }

  void EnvelopeRecorder::update(const std::size_t i, const double time, const double interval,
                                const Stress &stress)
  {
    const auto p = principal_stresses(stress);
    overstress.add(i, p[0], interval);
    if (p[0] > maximum[i])
      maximum[i] = p[0], time_of_maximum[i] = static_cast<float>(time);
    if (p[1] < minimum[i])
      minimum[i] = p[1], time_of_minimum[i] = static_cast<float>(time);
  }

  void EnvelopeRecorder::gather()
  {
    evaluate();
    for (auto *values : {&maximum, &minimum, &time_of_maximum, &time_of_minimum})
      Ranks::gather(values->data(), begin);
    overstress.gather(begin);
    faces.gather(begin);
  }

  Extreme EnvelopeRecorder::extreme(const SolidModel &model, const int surface, const bool largest) const
  {
    Extreme result{std::numeric_limits<double>::quiet_NaN()}; // no nodes on the surface
    bool    found = false;
    for (unsigned int i = 0; i < model.n_nodes(); ++i)
      if ((surface == 0 || model.on_surface(i, surface)) && !is_footing(model.body_numbers[model.body[i]]))
      {
        const double x = largest ? maximum[i] : minimum[i];
        if (!found || (largest ? x > result.value : x < result.value))
        {
          result = {x, largest ? time_of_maximum[i] : time_of_minimum[i], model.points[i]};
          found = true;
        }
      }
    return result;
  }
} // namespace Voussoir
