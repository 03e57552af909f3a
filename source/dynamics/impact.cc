// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/error.h>
#include <voussoir/dynamics/impact.h>

#include <voussoir/base/names.h>
#include <voussoir/base/parallel.h>
#include <voussoir/contact/elastic_law.h>
#include <voussoir/contact/pair_conditions.h>
#include <voussoir/mesh/mesh.h>

#include <algorithm>

namespace Voussoir
{
  namespace
  {
    /** Returns true if a slipping pair has slid through the whole step without an impact and without a turn
     * of more than 60 degrees. Impact: the impulse that stops the motion normal to the surfaces exceeds a
     * millionth of the impulse of the step.
     * @param jump velocity jump at the end of the step [m/s]
     * @param applied impulse of the joint force in the step [N s]
     * @param change change of the jump in the step [m] */
    bool slides_on(const JointLaw &law, const Matrix3 &H, const Vector3 &jump, const Vector3 &applied,
                   const Vector3 &change, const unsigned char active)
    {
      const Vector3 back = {{-jump[0], -jump[1], -jump[2]}};
      const double  strike =
          norm(law.stop_normal(H, jump, {}, active)) + norm(law.stop_normal(H, back, {}, active));
      return strike <= 1e-6 * norm(applied) && dot(jump, change) >= .5 * norm(jump) * norm(change);
    }

    /** Returns the rows in which a joint is rigid, or its stiffness exceeds 4/dt^2 times the mass of the pair. The time
     * step resolves the vibration of a softer joint. The velocity of a stiffer one would change its sign in each step,
     * so that it is corrected like a rigid one; this takes less energy than the joint force of the step. Soft flanks of
     * keys leave the face. @p active: active surfaces. */
    ImpactRows stiff_rows(const JointLaw &law, const Matrix3 &H, const double area, const double dt,
                          const unsigned char active)
    {
      const ElasticLaw *elastic = law.elastic_law();
      if (!elastic)
        return active > 1 && law.flank_compliance() / area >= .25 * dt * dt * H[0] ? ImpactRows::normal
                                                                                   : ImpactRows::all;
      const Vector3 compliance = elastic->compliance(area);
      const auto    is_soft = [&](const unsigned int c) { return compliance[c] / H[4 * c] >= .25 * dt * dt; };
      return is_soft(0) ? ImpactRows::none : is_soft(1) || is_soft(2) ? ImpactRows::normal : ImpactRows::all;
    }

    /** Returns the energy that a pair dissipated in the step with the impulse @p i, by friction [J]. @p change: of its
     * gap [m]. */
    double dissipated_by(const JointLaw &law, const Vector3 &i, const Vector3 &change, const double dt,
                         const PairHistory &history)
    {
      const Vector3     f = {{i[0] / dt, i[1] / dt, i[2] / dt}};
      const ElasticLaw *elastic = law.elastic_law();
      return -dot(f, change) - (elastic ? elastic->stored_change(f, history) : 0.);
    }

    const Names<ImpactRule> names_of_rules = {
        {"mean-force", ImpactRule::mean_force}, {"paper", ImpactRule::paper}, {"none", ImpactRule::none}};
  } // namespace

  ImpactRule impact_rule(const std::string &name)
  {
    return value_of(names_of_rules, name, "is no impact rule", "rules");
  }

  std::string impact_rule_names()
  {
    return selection(names_of_rules);
  }

  Impact::Impact(const Structure &structure, const JointLaws &laws, const ImpactRule rule)
      : PairClusters(structure), structure(structure), laws(laws), rule(rule)
  {
    if (clusters.empty() || rule == ImpactRule::mean_force || rule == ImpactRule::none)
      return;
    const Pair &one = structure.pairs[clusters[0].pairs[0]], &two = structure.pairs[clusters[0].pairs[1]];
    throw InputError(
        "The joints " + std::to_string(one.joint + 1) + " and " + std::to_string(two.joint + 1) +
        " share the node at " + place(one.place) +
        ", which requires \"Dynamics/Impact\" = mean-force. Set this entry, or change the joints in the "
        "mesh so that they do not cross.");
  }

  void Impact::correct_velocity(const JointSystem &system, const std::vector<PairHistory> &histories,
                                const double dt, const Unknowns &change, Unknowns &v, Unknowns &impulse) const
  {
    for_each_in_chunks(single.size(), [&](const std::size_t i)
                       { correct_pair(system, histories[single[i]], dt, single[i], change, v, impulse); });
    for_each_in_chunks(clusters.size(), [&](const std::size_t i)
                       { correct_cluster(system, histories, dt, clusters[i], change, v, impulse); });
  }

  /** Impulses of a cluster in a step. */
  struct Impact::ClusterStep
  {
    std::vector<ImpactRows>    rows;
    std::vector<unsigned char> active;
    std::vector<Vector3>       jump;    ///< velocity jumps with the applied impulses [m/s]
    std::vector<Vector3>       applied; ///< impulses of the joint forces in the step [N s]
    std::vector<Vector3>       kept;    ///< impulses after the correction [N s]
  };

  bool Impact::solve_cluster(const Cluster &cluster, const std::vector<PairHistory> &histories,
                             ClusterStep &step) const
  {
    constexpr unsigned int most = 500; // iterations
    constexpr double       enough = 1e-10;
    const std::size_t      n = cluster.pairs.size();
    step.kept = step.applied;
    for (unsigned int sweep = 0; sweep < most; ++sweep)
    {
      double largest = 0., changed = 0.;
      for (std::size_t i = 0; i < n; ++i)
      {
        if (step.rows[i] == ImpactRows::none)
          continue;
        const unsigned int p = cluster.pairs[i];
        const JointLaw    &law = *laws.of_pair[p];
        Vector3 jump = step.jump[i]; // with the applied impulse of this pair and those of the others
        for (std::size_t j = 0; j < n; ++j)
          if (j != i)
            add(jump, cluster.between(i, j) * (step.kept[j] - step.applied[j]));
        const Matrix3 &H = of_pair(p);
        const Vector3  next =
            step.rows[i] == ImpactRows::normal
                 ? law.stop_normal(H, jump, step.applied[i], step.active[i])
                 : law.solve_impulse(H, jump - H * step.applied[i], histories[p], step.active[i]);
        changed = std::max(changed, norm(next - step.kept[i]));
        largest = std::max({largest, norm(next), norm(step.applied[i])});
        step.kept[i] = next;
      }
      if (changed <= enough * largest)
        return true;
    }
    return false;
  }

  void Impact::correct_cluster(const JointSystem &system, const std::vector<PairHistory> &histories,
                               const double dt, const Cluster &cluster, const Unknowns &change, Unknowns &v,
                               Unknowns &impulse) const
  {
    const std::size_t n = cluster.pairs.size();
    ClusterStep       step;
    double            dissipated = 0.; // by friction in the step [J]
    for (const unsigned int p : cluster.pairs)
    {
      const JointLaw &law = *laws.of_pair[p];
      const bool      closed = system.states()[p] != PairState::open;
      unsigned char   active = system.active_surfaces()[p];
      step.applied.push_back(get(impulse, p));
      step.jump.push_back(structure.jump(structure.pairs[p], v));
      ImpactRows rows = closed || law.is_tangentially_tied()
                            ? stiff_rows(law, of_pair(p), histories[p].area, dt, active)
                            : ImpactRows::none;
      if (rows == ImpactRows::normal)
        active &= 1;
      else if (rows == ImpactRows::all && system.states()[p] == PairState::slip &&
               slides_on(law, of_pair(p), step.jump.back(), step.applied.back(), get(change, p), active))
        rows = ImpactRows::normal;
      step.rows.push_back(rows);
      step.active.push_back(active);
      dissipated += dissipated_by(law, step.applied.back(), get(change, p), dt, histories[p]);
    }
    bool is_safe = solve_cluster(cluster, histories, step);
    if (is_safe)
    {
      double gain = 0., size = 0.; // of the kinetic energy
      for (std::size_t i = 0; i < n; ++i)
      {
        const Vector3 f = step.kept[i] - step.applied[i];
        Vector3       gained{};
        for (std::size_t j = 0; j < n; ++j)
          add(gained, cluster.between(i, j) * (step.kept[j] - step.applied[j]));
        gain += dot(f, step.jump[i]) + .5 * dot(f, gained);
        size += norm(f) * (norm(step.jump[i]) + norm(gained));
      }
      is_safe = gain <= dissipated + 1e-12 * size;
    }
    if (!is_safe) // the normal rows alone always dissipate energy
    {
      std::replace(step.rows.begin(), step.rows.end(), ImpactRows::all, ImpactRows::normal);
      solve_cluster(cluster, histories, step);
    }
    for (std::size_t i = 0; i < n; ++i)
    {
      add_impulse(structure.pairs[cluster.pairs[i]], step.kept[i] - step.applied[i], v);
      set(impulse, cluster.pairs[i], step.kept[i]);
    }
  }

  void Impact::correct_pair(const JointSystem &system, const PairHistory &history, const double dt,
                            const std::size_t p, const Unknowns &change, Unknowns &v, Unknowns &impulse) const
  {
    const Pair     &pair = structure.pairs[p];
    const JointLaw &law = *laws.of_pair[p];
    const bool      closed = system.states()[p] != PairState::open;
    if (!closed && !law.is_tangentially_tied())
      return;
    const Vector3       jump = structure.jump(pair, v), applied = get(impulse, p);
    const unsigned char active = system.active_surfaces()[p];
    const ImpactRows    rows = stiff_rows(law, of_pair(p), history.area, dt, active);
    if (rows == ImpactRows::none)
      return;
    if (rule == ImpactRule::paper)
    {
      const bool    tied = law.is_tangentially_tied() || system.states()[p] == PairState::stick;
      const bool    face = system.active_surfaces()[p] & 1; // not for a pair with flank contact only
      const Vector3 f = tie_rows(of_pair(p), jump, {{face, tied, tied}});
      add_impulse(pair, f, v);
      for (unsigned int c = 0; c < 3; ++c)
        impulse[3 * p + c] += f[c];
      return;
    }
    if (rows == ImpactRows::normal || (system.states()[p] == PairState::slip &&
                                       slides_on(law, of_pair(p), jump, applied, get(change, p), active)))
    {
      // The mean friction of the step has an error of second order. Friction from the velocity at the end
      // would have one of first order.
      const Vector3 kept =
          law.stop_normal(of_pair(p), jump, applied, rows == ImpactRows::normal ? active & 1 : active);
      add_impulse(pair, kept - applied, v);
      set(impulse, p, kept);
      return;
    }
    // Velocity without the joint forces of this step, then the impulse that the law allows.
    const Vector3 lost = of_pair(p) * applied;
    Vector3       allowed = law.solve_impulse(of_pair(p), jump - lost, history, system.active_surfaces()[p]);
    if (!law.is_tangentially_tied())
    {
      // If loads tear at a pair more than the impact, the new friction impulse could supply more energy than
      // the pair has dissipated. In this case only the normal row is corrected, which
      // always dissipates energy.
      const Vector3 f = allowed - applied, gained = of_pair(p) * f;
      double        gain = 0., size = 0.;
      for (unsigned int c = 0; c < 3; ++c)
      {
        gain += .5 * f[c] * (2. * jump[c] + gained[c]);
        size += std::abs(f[c] * jump[c]) + std::abs(f[c] * gained[c]);
      }
      if (gain > dissipated_by(law, applied, get(change, p), dt, history) + 1e-12 * size)
        allowed = law.stop_normal(of_pair(p), jump, applied, system.active_surfaces()[p]);
    }
    add_impulse(pair, allowed - applied, v);
    set(impulse, p, allowed);
  }

  Unknowns Impact::end_force(const JointSystem &system, const Unknowns &force,
                             const Unknowns &nodal_force) const
  {
    Unknowns a(nodal_force.size()), result(force.size(), 0.);
    for (std::size_t i = 0; i < structure.n_nodes(); ++i)
      set(a, i, inverse_masses()[i] * get(nodal_force, i));
    for (std::size_t p = 0; p < structure.pairs.size(); ++p)
      add_impulse(structure.pairs[p], get(force, p), a);
    for (std::size_t p = 0; p < structure.pairs.size(); ++p)
    {
      const Pair   &pair = structure.pairs[p];
      const bool    tied = laws.of_pair[p]->is_tangentially_tied() || system.states()[p] == PairState::stick;
      const bool    face = system.active_surfaces()[p] & 1;
      const Vector3 f = tie_rows(of_pair(p), structure.jump(pair, a), {{face, tied, tied}});
      add_impulse(pair, f, a);
      Vector3 total = get(force, p);
      add(total, f);
      set(result, p, total);
    }
    return result;
  }
} // namespace Voussoir
