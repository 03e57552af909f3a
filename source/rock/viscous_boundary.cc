// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/rock/viscous_boundary.h>

#include <algorithm>
#include <map>

namespace Voussoir
{
  std::vector<Dashpot> viscous_dashpots(const RockModel &model, const std::array<double, 3> &centre,
                                        const double normal_spring, const double tangential_spring)
  {
    std::map<unsigned int, Dashpot> dashpots;
    for (const BoundaryFace &face : model.faces)
    {
      const Material &m = face.material;
      const double    c_p = p_wave_speed(m), c_s = s_wave_speed(m), shear = m.density * c_s * c_s;
      for (const unsigned int node : face.nodes)
      {
        Dashpot     &dashpot = dashpots.try_emplace(node, Dashpot{node, Matrix3{}, Matrix3{}}).first->second;
        const double r = norm(model.points[node] - centre);
        for (unsigned int a = 0; a < 3; ++a)
          for (unsigned int b = 0; b < 3; ++b)
          {
            const double normal = face.normal[a] * face.normal[b], tangential = (a == b ? 1. : 0.) - normal;
            dashpot.damping[3 * a + b] += m.density * (c_p * normal + c_s * tangential) * face.area / 4.;
            dashpot.stiffness[3 * a + b] +=
                shear / r * (normal_spring * normal + tangential_spring * tangential) * face.area / 4.;
          }
      }
    }
    std::vector<Dashpot> result;
    for (const auto &entry : dashpots)
      result.push_back(entry.second);
    return result;
  }

  ViscousBoundary::ViscousBoundary(const double normal, const double tangential)
      : normal_spring(normal), tangential_spring(tangential)
  {
  }

  void ViscousBoundary::attach(const RockModel &model, const Vector3 &centre, const double dt)
  {
    const BlockSparseMatrix &stiffness = model.stiffness;
    dashpots = viscous_dashpots(model, centre, normal_spring, tangential_spring);
    for (const Dashpot &dashpot : dashpots)
    {
      node.push_back(dashpot.node);
      Matrix3 matrix;
      for (unsigned int i = 0; i < 9; ++i)
        matrix[i] = .5 * dt * dashpot.damping[i] + (i % 4 == 0 ? model.mass[dashpot.node] : 0.);
      effective.push_back(inverse(matrix));
      neighbours.push_back(dashpot.node);
      for (std::size_t k = stiffness.start[dashpot.node]; k < stiffness.start[dashpot.node + 1]; ++k)
        neighbours.push_back(stiffness.column[k]);
    }
    std::sort(neighbours.begin(), neighbours.end());
    neighbours.erase(std::unique(neighbours.begin(), neighbours.end()), neighbours.end());
    const auto number = [&](const unsigned int wanted) -> unsigned int
    { return std::lower_bound(neighbours.begin(), neighbours.end(), wanted) - neighbours.begin(); };
    for (const Dashpot &dashpot : dashpots)
    {
      own_number.push_back(number(dashpot.node));
      first_neighbour.push_back(neighbour_number.size());
      for (std::size_t k = stiffness.start[dashpot.node]; k < stiffness.start[dashpot.node + 1]; ++k)
      {
        neighbour_number.push_back(number(stiffness.column[k]));
        row.push_back(stiffness.value[k]);
      }
    }
    first_neighbour.push_back(neighbour_number.size());
    kept = all_of(dashpots.size());
  }

  void ViscousBoundary::keep(const std::vector<bool> &stepped)
  {
    kept = stepped_of(node, stepped);
    points = stepped_of(neighbours, stepped);
    for (const unsigned int d : kept)
      points.insert(points.end(), neighbour_number.begin() + first_neighbour[d],
                    neighbour_number.begin() + first_neighbour[d + 1]);
    std::sort(points.begin(), points.end());
    points.erase(std::unique(points.begin(), points.end()), points.end());
  }

  Vector3 ViscousBoundary::free_field_force(const RegionStep &step, const unsigned int d) const
  {
    const RockDamping &damping = step.damping;
    const double       dt = step.dt;
    const Unknowns    &field_before = step.field_before, &field = step.field, &field_next = step.field_next;
    const Dashpot     &dashpot = dashpots[d];
    const auto         at = [&](const Unknowns &values, const std::size_t i) {
      return Vector3{{values[3 * i], values[3 * i + 1], values[3 * i + 2]}};
    };
    Vector3    f{};
    const auto add = [&](const Matrix3 &a, const Vector3 &b)
    {
      const Vector3 ab = a * b;
      for (unsigned int c = 0; c < 3; ++c)
        f[c] += ab[c];
    };
    for (std::size_t k = first_neighbour[d]; k < first_neighbour[d + 1]; ++k)
    {
      const unsigned int i = neighbour_number[k];
      Vector3            stress = at(field, i), before = at(field_before, i);
      for (unsigned int c = 0; c < 3; ++c)
        stress[c] += damping.stiffness / dt * (stress[c] - before[c]);
      add(row[k], stress);
    }
    const std::size_t own = own_number[d];
    const Vector3     before = at(field_before, own), now = at(field, own), next = at(field_next, own);
    const double      m = step.mass[dashpot.node];
    Vector3           v;
    for (unsigned int c = 0; c < 3; ++c)
    {
      v[c] = (next[c] - before[c]) / (2. * dt);
      f[c] +=
          m * ((next[c] - 2. * now[c] + before[c]) / (dt * dt) + damping.mass * (now[c] - before[c]) / dt);
    }
    add(dashpot.damping, v);
    add(dashpot.stiffness, now);
    return f;
  }

  void ViscousBoundary::advance(const RegionStep &step)
  {
    const RockDamping &damping = step.damping;
    const double       dt = step.dt;
    const Unknowns    &u = step.u, &K_x = step.K_x, &K_u = step.K_u, &force = step.force;
    Unknowns          &w = step.w;
    const int          n = kept.size();
    const bool         with_energy = !K_u.empty(), loaded = !force.empty(), incident = !step.field.empty();
    std::vector<std::array<double, 3>> sums(n); // radiated energy, damping losses, work of forces
#pragma omp parallel for schedule(static)
    for (int k = 0; k < n; ++k)
    {
      double            &transmitted = sums[k][0], &lost = sums[k][1], &external = sums[k][2];
      const unsigned int d = kept[k];
      transmitted = lost = external = 0.;
      const Dashpot    &dashpot = dashpots[d];
      const std::size_t first = 3 * std::size_t(dashpot.node);
      const double      m = step.mass[dashpot.node];
      const Vector3     old = {{w[first], w[first + 1], w[first + 2]}},
                    now = {{u[first], u[first + 1], u[first + 2]}};
      Vector3       boundary = incident ? free_field_force(step, d) : Vector3{};
      const Vector3 spring = dashpot.stiffness * now, drag = dashpot.damping * old;
      Vector3       f;
      for (unsigned int c = 0; c < 3; ++c)
      {
        boundary[c] -= spring[c];
        f[c] = boundary[c] - drag[c] - K_x[first + c] - damping.mass * m * old[c] +
               (loaded ? force[first + c] : 0.);
      }
      const Vector3 a = effective[d] * f;
      Vector3       v;
      for (unsigned int c = 0; c < 3; ++c)
      {
        if (!step.is_fixed[first + c])
          w[first + c] += dt * a[c];
        v[c] = .5 * (old[c] + w[first + c]);
      }
      const Vector3 dragged = dashpot.damping * v;
      for (unsigned int c = 0; with_energy && c < 3; ++c)
      {
        const std::size_t k = first + c;
        transmitted += dt * v[c] * (dragged[c] - boundary[c]);
        lost += .5 * dt * (damping.mass * m * old[c] + K_x[k] - K_u[k]) * w[k];
        external += loaded ? .5 * dt * force[k] * w[k] : 0.;
      }
    }
    for (int k = 0; with_energy && k < n; ++k) // in sequence for any number of threads
    {
      step.add_work(gone_through_boundary, node[kept[k]], sums[k][0]);
      step.add_work(lost_in_damping, node[kept[k]], sums[k][1]);
      step.add_work(done_by_forces, node[kept[k]], sums[k][2]);
    }
  }
} // namespace Voussoir
