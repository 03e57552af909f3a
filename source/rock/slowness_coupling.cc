// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/rock/slowness_coupling.h>

#include <algorithm>
#include <cmath>

namespace Voussoir
{
  SlownessCoupling::SlownessCoupling(const HexMesh &mesh, const RockModel &model,
                                     const std::map<int, Material> &materials, const double p)
      : mass_along(model.points.size(), 0.), mass_across(mass_along)
  {
    std::vector<double> mass(model.points.size(), 0.); // by nodal quadrature [kg]
    for (const HexMesh::Cell &cell : mesh.cells)
    {
      const Material &m = materials.at(cell.volume);
      const double    mu = m.young / (2. * (1. + m.poisson)),
                   lambda = 2. * mu * m.poisson / (1. - 2. * m.poisson);
      const double thickness = std::abs(mesh.nodes[cell.nodes[0]][0] - mesh.nodes[cell.nodes[4]][0]);
      for (unsigned int a = 0; a < 4; ++a)
      {
        // The quadrature point at corner a, with local axes along the edges to the next and the previous
        // corner.
        const unsigned int corner[3] = {a, (a + 1) % 4, (a + 3) % 4};
        Vector3            x[3];
        unsigned int       node[3];
        for (unsigned int k = 0; k < 3; ++k)
        {
          x[k] = mesh.nodes[cell.nodes[4 + corner[k]]];
          node[k] = model.node[cell.nodes[4 + corner[k]]];
        }
        const Vector3 next = x[1] - x[0], previous = x[2] - x[0];
        const double  J = next[1] * previous[2] - next[2] * previous[1], w = thickness * std::abs(J) / 4.;
        const double  y[3] = {(next[2] - previous[2]) / J, previous[2] / J, -next[2] / J},
                     z[3] = {(previous[1] - next[1]) / J, -previous[1] / J, next[1] / J};
        mass_along[node[0]] += w * p * p * (lambda + 2. * mu);
        mass_across[node[0]] += w * p * p * mu;
        mass[node[0]] += w * m.density;
        for (unsigned int k = 0; k < 3; ++k)
        {
          entries.push_back({node[0], node[k], p * w * lambda * y[k], p * w * lambda * z[k]});
          entries.push_back({node[k], node[0], -p * w * mu * y[k], -p * w * mu * z[k]});
        }
      }
    }
    // The masses of the model have other quadrature points. Near the critical angle the difference could be
    // negative; the share of the mass is below one.
    const auto limit = [](const double all, const double nodal, double &subtracted)
    {
      const double share = nodal > 0. ? subtracted / nodal : 0.;
      if (all - subtracted < .5 * all * (1. - share))
        subtracted = all * share;
    };
    for (std::size_t i = 0; i < mass.size(); ++i)
    {
      limit(model.mass[i], mass[i], mass_along[i]);
      limit(model.mass[i], mass[i], mass_across[i]);
    }
    merge();
  }

  /** Adds up the entries of the same nodes and sorts them by nodes. */
  void SlownessCoupling::merge()
  {
    const auto place = [](const Entry &e) { return std::make_pair(e.i, e.j); };
    std::stable_sort(entries.begin(), entries.end(),
                     [&](const Entry &a, const Entry &b) { return place(a) < place(b); });
    std::size_t n = 0;
    for (const Entry e : entries)
      if (n > 0 && place(entries[n - 1]) == place(e))
      {
        entries[n - 1].y += e.y;
        entries[n - 1].z += e.z;
      }
      else
        entries[n++] = e;
    entries.resize(n);
  }

  void SlownessCoupling::add_along(const Unknowns &w, Unknowns &force) const
  {
    for (const Entry &e : entries)
      force[3 * std::size_t(e.i)] += e.y * w[3 * std::size_t(e.j) + 1] + e.z * w[3 * std::size_t(e.j) + 2];
  }

  void SlownessCoupling::add_across(const Unknowns &w, Unknowns &force) const
  {
    for (const Entry &e : entries)
    {
      force[3 * std::size_t(e.j) + 1] -= e.y * w[3 * std::size_t(e.i)];
      force[3 * std::size_t(e.j) + 2] -= e.z * w[3 * std::size_t(e.i)];
    }
  }
} // namespace Voussoir
