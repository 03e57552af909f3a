// SPDX-License-Identifier: GPL-3.0-or-later
// Columns of hexahedra with a cross-section of 1 m x 1 m along x, their runs and energies.

#ifndef voussoir_tests_column_h
#define voussoir_tests_column_h

#include "grids.h"
#include "testing.h"

#include <voussoir/contact/law_table.h>
#include <voussoir/dynamics/newmark.h>
#include <voussoir/joints/pairs.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <random>
#include <string>
#include <vector>

#ifdef _OPENMP
#include <omp.h>
#endif

namespace Columns
{
  using namespace Voussoir;

  using namespace Testing;

  inline std::mt19937 &random_engine()
  {
    static std::mt19937 engine(7);
    return engine;
  }

  /** Random numbers in [-1, 1], the same on every machine. */
  inline double random_number()
  {
    return random_engine()() / 2147483647.5 - 1.;
  }

  /** Runs the tests; main's status. */
  inline int run_all(const std::vector<std::function<void()>> &tests)
  {
#ifdef _OPENMP
    omp_set_num_threads(1); // the bodies are tiny
#endif
    std::vector<Test> unnamed;
    for (const auto &test : tests)
      unnamed.push_back({"", test});
    return run(unnamed);
  }

  struct Bar
  {
    double       from, to;
    unsigned int n;                     ///< elements
    double       rho, cp, cs;           ///< density and wave speeds; cs = cp/sqrt(2): no lateral contraction
    double       first = 0., last = 0.; ///< lengths of the elements at the ends, if not those of the others

    double layer(const unsigned int i) const ///< its place
    {
      const unsigned int inner = n - (first > 0.) - (last > 0.), k = i - (i > 0 && first > 0.);
      return i == 0 ? from : i == n ? to : from + first + (to - from - first - last) * k / inner;
    }
  };

  inline Bar bar(const double from, const double to, const unsigned int n, const double E, const double rho)
  {
    return {from, to, n, rho, std::sqrt(E / rho), std::sqrt(.5 * E / rho)};
  }

  inline Material material(const Bar &bar)
  {
    Material     m;
    const double p = bar.cp * bar.cp, s = bar.cs * bar.cs;
    m.density = bar.rho;
    m.poisson = (p - 2. * s) / (2. * (p - s));
    m.young = 2. * bar.rho * s * (1. + m.poisson);
    return m;
  }

  struct Column
  {
    Structure                              structure;
    std::vector<std::vector<unsigned int>> node; ///< by bar and layer
    std::vector<std::vector<double>>       x;    ///< of the layers

    double total(const unsigned int bar, const unsigned int component,
                 const Unknowns &v) const ///< sum of m v
    {
      double sum = 0.;
      for (const unsigned int i : node[bar])
        sum += structure.mass[i][4 * component] * v[3 * i + component];
      return sum;
    }
    double mass(const unsigned int bar) const { return total(bar, 0, Unknowns(3 * structure.n_nodes(), 1.)); }
    void   set(Unknowns &u, const unsigned int bar, const Vector3 &value) const
    {
      for (const unsigned int i : node[bar])
        std::copy(value.begin(), value.end(), u.begin() + 3 * i);
    }
    Unknowns zero() const { return Unknowns(3 * structure.n_nodes(), 0.); }
    double   kinetic(const Unknowns &v) const
    {
      double sum = 0.;
      for (unsigned int i = 0; i < structure.n_nodes(); ++i)
        for (unsigned int c = 0; c < 3; ++c)
          sum += .5 * structure.mass[i][4 * c] * v[3 * i + c] * v[3 * i + c];
      return sum;
    }
  };

  /** A pair between the rigid ground and a node, n = x (or any other axes by turning {x,y,z} @p turn times).
   */
  inline Pair wall(const unsigned int node, const unsigned int turn = 0)
  {
    Pair pair;
    pair.node_2 = node;
    for (unsigned int i = 0; i < 3; ++i)
      for (unsigned int d = 0; d < 3; ++d)
        pair.frame[i][d] = (i + turn) % 3 == d ? 1. : 0.;
    return pair;
  }

  /** The nodes of a layer move as one. Two bars that meet have a joint. @p rigid: all nodes of a bar move as
   * one. */
  inline Column make_column(const std::vector<Bar>            &bars,
                            const std::function<bool(double)> &is_fixed = nullptr, const bool rigid = false)
  {
    std::vector<std::vector<double>> layers(bars.size());
    std::vector<Material>            materials;
    for (unsigned int b = 0; b < bars.size(); ++b)
    {
      materials.push_back(material(bars[b]));
      for (unsigned int i = 0; i <= bars[b].n; ++i)
        layers[b].push_back(bars[b].layer(i));
    }
    HexMesh mesh = Grids::columns(layers);
    for (HexMesh::Cell &cell : mesh.cells) // each bar is a zone
      cell.zone = cell.volume - 1;
    mesh.zones.resize(bars.size());
    SolidModel        model(mesh, 1);
    std::vector<bool> fixed(model.n_nodes());
    const auto        layer = [&](const unsigned int i)
    {
      const Bar   &bar = bars[model.body[i]];
      unsigned int nearest = 0;
      for (unsigned int k = 1; !rigid && k <= bar.n; ++k)
        if (std::abs(model.points[i][0] - bar.layer(k)) < std::abs(model.points[i][0] - bar.layer(nearest)))
          nearest = k;
      return nearest;
    };
    std::map<std::pair<unsigned int, unsigned int>, unsigned int> first;
    for (unsigned int i = 0; i < model.n_nodes(); ++i)
    {
      model.master[i] = first.try_emplace({model.body[i], layer(i)}, i).first->second;
      fixed[i] = is_fixed && is_fixed(model.points[i][0]);
    }
    model.number_equations(fixed);

    Column column;
    column.structure = assemble_structure(model, materials, true);
    column.node.resize(bars.size());
    column.x.resize(bars.size());
    for (const auto &entry : first) // ascending in bar and layer
      if (model.equation[entry.second] != rigid_ground)
      {
        column.node[entry.first.first].push_back(model.equation[entry.second]);
        column.x[entry.first.first].push_back(model.points[entry.second][0]);
      }
    column.structure.n_joints = bars.size() > 1 ? bars.size() - 1 : 1;
    if (bars.size() > 1)
      column.structure.pairs = find_pairs(model, bars.size() - 1);
    column.structure.collect_interfaces();
    return column;
  }

  inline JointLaws make_laws(const Structure &structure, const std::string &name, const double friction,
                             const std::string &equations = "alart-curnier")
  {
    JointLaws laws;
    for (unsigned int j = 0; j < structure.n_joints; ++j)
      laws.of_joint.push_back(make_joint_law(name, LawParameters(friction, equations_from_name(equations))));
    laws.assign(structure);
    return laws;
  }

  /** Largest energies that friction and impact in joints created in a step. Zero: the joints only took energy. */
  struct JointAccount
  {
    double friction = 0., impact = 0., total = 0.; ///< the largest that was created in a step [J]
    Energy before;

    explicit JointAccount(const Integrator &integrator) : before(integrator.state().energy) {}
    void see(const Integrator &integrator)
    {
      const Energy &now = integrator.state().energy;
      friction = std::max(friction, before.friction - now.friction);
      impact = std::max(impact, before.impact - now.impact);
      total = std::max(total, before.friction + before.impact - now.friction - now.impact);
      before = now;
    }
  };

  /** Of all runs since it was last reported, over the largest energy of each run. */
  inline double worst_energy_error = 0., worst_friction = 0., worst_impact = 0., worst_gain = 0.;

  inline void see_energy(const Integrator &integrator, const JointAccount &joints)
  {
    const double scale = std::max(integrator.largest_energy(), 1e-300);
    worst_energy_error = std::max(worst_energy_error, integrator.energy_error());
    worst_friction = std::max(worst_friction, joints.friction / scale);
    worst_impact = std::max(worst_impact, joints.impact / scale);
    worst_gain = std::max(worst_gain, joints.total / scale);
  }

  /** @p rule: only mean_force creates no energy in the joints. */
  inline void report_energy(const std::string &what, const ImpactRule rule = ImpactRule::mean_force)
  {
    below(what + ": energy account, error / largest energy", worst_energy_error, 1e-10);
    if (rule == ImpactRule::mean_force)
    {
      below(what + ": work of friction in a step / largest energy", worst_friction, 1e-12);
      // In an oblique impact the velocity correction may give back work of friction of the same step.
      missed(what + ": gain by impacts in a step / largest energy", worst_impact, 1e-12);
      below(what + ": energy created in a step / largest energy", worst_gain, 1e-12);
    }
    else
      note(what + ": energy created in a step / largest energy", worst_gain);
    worst_energy_error = worst_friction = worst_impact = worst_gain = 0.;
  }

  inline ContactParameters tight()
  {
    ContactParameters parameters;
    parameters.tolerance = 1e-13;
    return parameters;
  }

  /** What a run left in its pair 0, step by step. */
  struct History
  {
    std::vector<double>  t, t_force; ///< of the state; of the force, which may be the mean over the step
    std::vector<Vector3> force, gap;
  };

  /** Steps @p integrator n times under load(t); @p see is called after the start and after each step. */
  inline History run(Integrator &integrator, const double dt, const unsigned int n,
                     const std::function<void(double, Unknowns &)> &load, const Unknowns &zero,
                     const std::function<void()> &see = nullptr, const bool is_mean = true)
  {
    History      h;
    JointAccount joints(integrator);
    for (unsigned int i = 0; i <= n; ++i)
    {
      if (i > 0)
      {
        Unknowns f = zero;
        if (load)
          load(i * dt, f);
        integrator.advance(f);
        joints.see(integrator);
      }
      const Unknowns &force = integrator.state().force;
      h.t.push_back(i * dt);
      h.t_force.push_back(i == 0 || !is_mean ? i * dt : (i - .5) * dt);
      h.force.push_back({{force[0], force[1], force[2]}});
      h.gap.push_back(integrator.opening_and_slip(0));
      if (see)
        see();
    }
    see_energy(integrator, joints);
    return h;
  }

} // namespace Columns

#endif
