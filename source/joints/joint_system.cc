// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/parallel.h>
#include <voussoir/joints/joint_system.h>

#include <voussoir/joints/friction_problem.h>
#include <voussoir/joints/pairs.h>
#include <voussoir/mesh/mesh.h>

#include <algorithm>
#include <cassert>
#include <chrono>
#include <map>
#include <set>

namespace Voussoir
{
  namespace
  {
    /** Returns the group of each pair. Where joints cross, each joint is a group in dynamics; in statics the groups
     * form a chain, because distant joints are strongly coupled. */
    std::vector<unsigned int> groups_of_pairs(const Structure &structure, const bool is_static)
    {
      std::vector<unsigned int> result;
      for (const Pair &pair : structure.pairs)
        if (is_static || structure.clusters.empty())
          result.push_back(structure.group(pair));
        else if (result.empty())
          result.push_back(0);
        else
          result.push_back(result.back() + (pair.joint != structure.pairs[result.size() - 1].joint));
      return result;
    }

    std::vector<unsigned int> pairs_per_group(const Structure                 &structure,
                                              const std::vector<unsigned int> &group)
    {
      std::vector<unsigned int> n(structure.n_groups(), 0);
      n.resize(std::max<std::size_t>(n.size(), group.empty() ? 0 : group.back() + 1), 0);
      for (const unsigned int g : group)
        ++n[g];
      return n;
    }

    /** Assigns each group of joints to the process that has its first body. */
    Shares shares_of_joints(const Structure &structure, const std::vector<unsigned int> &group)
    {
      if (structure.share.are_trivial())
        return Shares();
      const std::size_t         n_groups = pairs_per_group(structure, group).size();
      std::vector<unsigned int> first(n_groups, rigid_ground), owner(n_groups, 0);
      for (std::size_t p = 0; p < group.size(); ++p)
        if (const unsigned int node = std::min(structure.pairs[p].node_1, structure.pairs[p].node_2);
            node < first[group[p]])
        {
          first[group[p]] = node;
          owner[group[p]] = structure.share.owner(structure.body_of(node));
        }
      for (unsigned int j = 1; j < owner.size(); ++j) // groups without pairs; parts must ascend
        owner[j] = std::max(owner[j], owner[j - 1]);
      return Shares::of_owners(owner);
    }

    double now()
    {
      return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
    }

    /** Returns R F R^T for the frames of two pairs. */
    Matrix3 rotate(const std::array<Vector3, 3> &p, const Matrix3 &F, const std::array<Vector3, 3> &q)
    {
      Matrix3 result;
      for (unsigned int j = 0; j < 3; ++j)
      {
        const Vector3 Fq = F * q[j];
        for (unsigned int i = 0; i < 3; ++i)
          result[3 * i + j] = p[i][0] * Fq[0] + p[i][1] * Fq[1] + p[i][2] * Fq[2];
      }
      return result;
    }
  } // namespace

  JointSystem::JointSystem(const Structure &structure, const PairLaws &laws,
                           const ContactParameters &parameters, const StepOperator &step,
                           const Unknowns &springs, const BaseElimination::Nodes *given_base,
                           const bool single_factors)
      : structure(structure), parameters(parameters), laws(laws), step(step), is_static(step.mass == 0.),
        sides(structure.pairs.size()), group(groups_of_pairs(structure, is_static)),
        W(pairs_per_group(structure, group), shares_of_joints(structure, group),
          is_static ? std::vector<std::vector<unsigned int>>() : clusters_with_feet(structure)),
        n_solved(parameters.first_problem)
  {
    bodies.resize(structure.bodies.size());
    for_each_own_body(
        [&](const unsigned int b)
        {
          bodies[b] =
              std::make_unique<CondensedBody>(structure, structure.bodies[b], step, springs, single_factors);
        });
    for (const Body &body : structure.bodies)
      interface.begin.push_back(interface.begin.back() + 3 * body.interface.size());
    interface.value.resize(interface.begin.back());
    if (given_base)
      base = std::make_shared<BaseElimination>(structure, *given_base, group);
    condense();
    if (base && is_static)
      make_whole();
    // Near crossings of joints the entries of a block differ too much for a common scale.
    W.finish(is_static ? nullptr : base, !is_static && structure.clusters.empty());
    solver = std::make_unique<ContactSolver>(W, laws.of_pair, parameters);
  }

  template <class Action> void JointSystem::for_each_own_body(const Action &action)
  {
    for_each_parallel(static_cast<int>(bodies.size()),
                      [&](const int b)
                      {
                        if (structure.share.is_mine(b))
                          action(b);
                      });
  }

  /** Returns share times the flexibility of the interface of a body, computed here, or by another process if
   * rows of W on this process require it. Otherwise empty. */
  std::vector<double>
  JointSystem::flexibility_of(const unsigned int                                        b,
                              const std::vector<std::pair<unsigned int, unsigned int>> &sides_of_body)
  {
    std::vector<double> F;
    if (structure.share.is_mine(b))
    {
      F = bodies[b]->take_flexibility();
      for (double &x : F)
        x *= step.share;
    }
    const unsigned int owner = structure.share.owner(b);
    const bool         needed_elsewhere =
        Ranks::size() > 1 &&
        (base || std::any_of(sides_of_body.begin(), sides_of_body.end(),
                             [&](const auto &side) { return W.shares().owner(group[side.first]) != owner; }));
    if (needed_elsewhere)
    {
      F.resize(9 * structure.bodies[b].interface.size() * structure.bodies[b].interface.size());
      Ranks::broadcast(F.data(), F.size(), owner);
    }
    return F;
  }

  /** Assembles W = share G A^-1 G^T from the flexibilities of the bodies. */
  void JointSystem::condense()
  {
    std::vector<std::vector<std::pair<unsigned int, unsigned int>>> of_body(bodies.size()); // pair, side
    for (unsigned int p = 0; p < sides.size(); ++p)
      for (unsigned int side = 0; side < 2; ++side)
      {
        const Pair        &pair = structure.pairs[p];
        const unsigned int node = side == 0 ? pair.node_1 : pair.node_2;
        if (node == rigid_ground)
          continue;
        const unsigned int b = structure.body_of(node);
        const Body        &body = structure.bodies[b];
        const auto        &nodes = body.interface;
        sides[p][side] = {
            b, static_cast<unsigned int>(
                   std::lower_bound(nodes.begin(), nodes.end(), node - body.first_node) - nodes.begin())};
        of_body[sides[p][side].body].push_back({p, side});
      }

    for (unsigned int j = 0; j < W.n_groups(); ++j)
      W.block(j, j); // also for joints without pairs: an empty block
    couple_footings();
    for (unsigned int b = 0; b < bodies.size(); ++b)
    {
      const std::vector<double> F = flexibility_of(b, of_body[b]);
      const std::size_t         m = 3 * structure.bodies[b].interface.size();
      if (base)
        base->add_body(b, F);
      for (const auto &q : of_body[b]) // columns
        for (const auto &p : of_body[b])
        {
          const Pair        &pair_p = structure.pairs[p.first], &pair_q = structure.pairs[q.first];
          const unsigned int group_p = group[p.first], group_q = group[q.first];
          if (group_p > group_q)
            continue;
          std::vector<double> &block = W.block(group_p, group_q);
          if (block.empty())
            continue;
          Matrix3      f;
          const double sign = p.second == q.second ? 1. : -1.;
          for (unsigned int j = 0; j < 3; ++j)
            for (unsigned int i = 0; i < 3; ++i)
              f[3 * i + j] =
                  sign *
                  F[(3 * sides[q.first][q.second].node + j) * m + 3 * sides[p.first][p.second].node + i];
          const Matrix3     w = rotate(pair_p.frame, f, pair_q.frame);
          const std::size_t rows = W.size(group_p), row = 3 * p.first - W.begin(group_p),
                            column = 3 * q.first - W.begin(group_q);
          for (unsigned int j = 0; j < 3; ++j)
            for (unsigned int i = 0; i < 3; ++i)
              block[(column + j) * rows + row + i] += w[3 * i + j];
        }
    }
    if (base)
      base->factorise();
  }

  /** Couples the groups of base joints on near footings, which the rock connects. Without, Newton's method needs three
   * times the steps on massless rock; a larger reach saves none. */
  void JointSystem::couple_footings()
  {
    constexpr int                         reach = 2; // monoliths
    std::map<int, std::set<unsigned int>> groups;    // by monolith
    for (unsigned int p = 0; base && p < sides.size(); ++p)
      if (const unsigned int b = sides[p][0].body;
          b != rigid_ground && is_footing(structure.bodies[b].number))
        groups[monolith_of(structure.bodies[b].number)].insert(group[p]);
    for (const auto &[m, of_m] : groups)
      for (const auto &[n, of_n] : groups)
        for (const unsigned int j : of_m)
          for (const unsigned int k : of_n)
            if (j < k && std::abs(m - n) <= reach)
              W.block(j, k);
  }

  /** Replaces W by W - B H^-1 B^T in all blocks. In statics the base nodes couple distant joints as strongly
   * as neighbours, so an iteration with neighbours only would not converge. */
  void JointSystem::make_whole()
  {
    for (unsigned int k = 0; k < W.n_groups(); ++k)
      for (unsigned int j = 0; j <= k; ++j)
        W.block(j, k);
    base->for_blocks([&](const unsigned int j, const unsigned int k) { return W.holds(j, k); },
                     [&](const unsigned int j, const unsigned int k, const std::vector<double> &part)
                     {
                       std::vector<double> &block = W.block(j, k);
                       for (std::size_t i = 0; i < part.size(); ++i)
                         block[i] -= part[i];
                     });
  }

  /** Returns G u + offset for the current displacements of the interface and the forces on the base nodes. */
  Unknowns JointSystem::gaps_without_forces(const Unknowns &offset, const Unknowns &base_force) const
  {
    Unknowns b = offset;
    for (unsigned int p = 0; p < sides.size(); ++p)
      for (unsigned int side = 0; side < 2; ++side)
        if (const Side &s = sides[p][side]; s.body != rigid_ground)
          for (unsigned int c = 0; c < 3; ++c)
          {
            const double x = (side == 0 ? -1. : 1.) * interface.of_body(s.body)[3 * s.node + c];
            for (unsigned int i = 0; i < 3; ++i)
              b[3 * p + i] += structure.pairs[p].frame[i][c] * x;
          }
    if (base)
      base->add_gaps(1., base_force, b.data());
    return b;
  }

  /** Sets the work array of the interface to share times the forces of joints and base nodes. Completes the
   * forces on the base nodes by the part of the joint forces. */
  void JointSystem::put_on_interface(const Unknowns &force, BaseOfStep &of_step)
  {
    std::fill(interface.value.begin(), interface.value.end(), 0.);
    for (unsigned int p = 0; p < sides.size(); ++p)
      for (unsigned int side = 0; side < 2; ++side)
        if (const Side &s = sides[p][side]; s.body != rigid_ground)
          for (unsigned int c = 0; c < 3; ++c)
            for (unsigned int i = 0; i < 3; ++i)
              interface.of_body(s.body)[3 * s.node + c] +=
                  (side == 0 ? -1. : 1.) * structure.pairs[p].frame[i][c] * force[3 * p + i];
    if (base)
    {
      Unknowns by_joints;
      base->take_gaps(force.data(), by_joints);
      base->solve(by_joints);
      for (std::size_t k = 0; k < by_joints.size(); ++k)
        of_step.force[k] -= by_joints[k];
      base->add_to(interface, of_step.force);
    }
    for (double &f : interface.value)
      f *= step.share;
  }

  /** Computes the forces on the base nodes without joint forces. */
  void JointSystem::release_joints(BaseOfStep &of_step) const
  {
    of_step.displacement.resize(base->n(), 0.); // zero displacement unless given
    base->take_from(interface, of_step.force);
    for (std::size_t k = 0; k < of_step.force.size(); ++k)
      of_step.force[k] = of_step.displacement[k] - of_step.force[k];
    base->solve(of_step.force);
  }

  ContactResult JointSystem::solve(const Unknowns &load, const Unknowns &offset, const Unknowns &start,
                                   Unknowns &memory, Unknowns &force, Unknowns &gap, Unknowns &u,
                                   BaseOfStep *of_step)
  {
    assert(load.size() == 3 * std::size_t(structure.n_nodes()));
    assert(offset.size() == 3 * sides.size());
    assert(start.size() == 3 * sides.size());
    assert(force.size() == 3 * sides.size());
    const double begin = now();
    u.resize(load.size());
    for_each_own_body(
        [&](const unsigned int b)
        {
          bodies[b]->apply_load(load.data() + 3 * std::size_t(structure.bodies[b].first_node),
                                interface.of_body(b));
        });
    if (!structure.share.are_trivial())
      Ranks::gather(interface.value.data(), structure.share.parts(interface.begin));

    const double  middle = now();
    ContactResult result;
    result.converged = true;
    BaseOfStep at_rest;
    of_step = of_step ? of_step : &at_rest;
    if (base)
      release_joints(*of_step);
    if (!sides.empty())
    {
      const Unknowns b = gaps_without_forces(offset, of_step->force);
      if (parameters.write_problems && n_solved++ % parameters.write_interval == 0)
        write_problem(b, start, memory, force);
      if (is_static && parameters.method != "sweeps" &&
          std::all_of(force.begin(), force.end(), [](const double f) { return f == 0.; }))
        solver->guess_bonded(b, force);
      result = solve_pairs(b, start, memory, force, gap);
    }
    put_on_interface(force, *of_step);

    const double after = now();
    for_each_own_body(
        [&](const unsigned int b)
        {
          bodies[b]->apply_joint_forces(interface.of_body(b),
                                        u.data() + 3 * std::size_t(structure.bodies[b].first_node));
        });
    structure.gather(u);
    times.substitutions += middle - begin + now() - after;
    times.joints += after - middle;
    return result;
  }

  /** Solves the joint problem, again after each crack event. */
  ContactResult JointSystem::solve_pairs(const Unknowns &b, const Unknowns &start, Unknowns &memory,
                                         Unknowns &force, Unknowns &gap)
  {
    ContactResult total;
    total.converged = true;
    for (bool again = true; again;)
    {
      const ContactResult result =
          solver->solve(b, laws.histories(start, step.has_mean_forces(), memory), force, gap);
      if (!laws.have_memory())
        return result;
      total += result;
      again = result.converged && laws.revise(W, start, step.has_mean_forces(), gap, force, memory) > 0;
    }
    return total;
  }

  namespace
  {
    /** Gathers all blocks of @p W on the first process; other processes have none. */
    InterfaceOperator on_first(const InterfaceOperator &W)
    {
      std::vector<unsigned int> n_pairs;
      for (unsigned int j = 0; j < W.n_groups(); ++j)
        n_pairs.push_back(Ranks::is_first() ? W.size(j) / 3 : 0);
      InterfaceOperator whole(n_pairs);
      for (unsigned int k = 0; k < W.n_groups(); ++k)
        for (unsigned int j = 0; j <= k; ++j)
          if (const std::vector<double> *mine = W.find_block(j, k))
          {
            const unsigned int   from = W.shares().owner(j);
            std::vector<double> &to = whole.block(j, k);
            if (Ranks::is_first() && from > 0)
              Ranks::exchange({{from, nullptr, 0, to.data(), to.size()}});
            else if (Ranks::is_first())
              to = *mine;
            else if (from == Ranks::rank())
              Ranks::exchange({{0, mine->data(), mine->size(), nullptr, 0}});
          }
      return whole;
    }
  } // namespace

  void JointSystem::write_problem(const Unknowns &b, const Unknowns &start, const Unknowns &memory,
                                  const Unknowns &force) const
  {
    std::unique_ptr<InterfaceOperator> gathered;
    if (Ranks::size() > 1)
      gathered = std::make_unique<InterfaceOperator>(on_first(W));
    const InterfaceOperator &whole = gathered ? *gathered : W;
    Ranks::on_first(
        [&]
        {
          FrictionProblem problem =
              friction_problem(whole, laws, laws.histories(start, step.has_mean_forces(), memory), b);
          char name[40];
          std::snprintf(name, sizeof(name), "/problem-%06u.txt", n_solved);
          if (problem.q.size() == force.size())
            problem.guess = force;
          problem.guess.resize(problem.q.size(), 0.); // several surfaces of a pair: zero
          write_friction_problem(parameters.write_directory + name, problem);
        });
  }

  void JointSystem::solve_free(const Unknowns &load, Unknowns &u)
  {
    assert(load.size() == 3 * std::size_t(structure.n_nodes()));
    u.resize(load.size());
    for_each_own_body(
        [&](const unsigned int b)
        {
          const std::size_t first = 3 * std::size_t(structure.bodies[b].first_node);
          bodies[b]->solve(load.data() + first, u.data() + first);
        });
    structure.gather(u);
  }

  double JointSystem::memory_consumption() const
  {
    double bytes = W.memory();
    for (const auto &body : bodies)
      bytes += body ? body->memory() : 0.;
    return bytes;
  }

  std::string largest_error(const Structure &structure, const ContactResult &result)
  {
    if (result.worst_pair >= structure.pairs.size())
      return "";
    const Pair &pair = structure.pairs[result.worst_pair];
    return " The largest error is in joint " + std::to_string(pair.joint + 1) + " at " + place(pair.place) +
           ".";
  }
} // namespace Voussoir
