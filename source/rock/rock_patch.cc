// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/error.h>
#include <voussoir/base/internal_error.h>
#include <voussoir/rock/rock_patch.h>

#include <algorithm>
#include <set>

namespace Voussoir
{
  RockPatch::RockPatch(const RockModel &model, const RockDamping &damping, const double dt,
                       const std::vector<unsigned int> &base_nodes, const unsigned int n_steps)
      : damping(damping), dt(dt), node(base_nodes), n_layer(1, base_nodes.size())
  {
    add_layers(model, n_steps);
    std::vector<bool> on_boundary(model.points.size(), false);
    for (const BoundaryFace &face : model.faces)
      for (const unsigned int i : face.nodes)
        on_boundary[i] = true;
    const unsigned int n_rows = n_layer[n_steps - 1];
    for (unsigned int i = 0; i < n_rows; ++i)
    {
      ensure(model.stiffness.start[node[i]] < model.stiffness.start[node[i] + 1],
             "A row of the rock below the dam is not on this rank.");
      if (on_boundary[node[i]])
        throw InputError("The base of the dam is fewer than " + std::to_string(n_steps) +
                         " layers of rock elements from the artificial boundary, which is too near for "
                         "\"Foundation/Substeps\" = " +
                         std::to_string(n_steps) +
                         ". Enlarge the rock, or reduce \"Foundation/Substeps\" and "
                         "increase \"Dynamics/Steps per sample\".");
      inverse_mass.push_back(1. / model.mass[node[i]]);
    }
    std::vector<unsigned int> number(model.points.size(), no_node);
    for (unsigned int i = 0; i < node.size(); ++i)
      number[node[i]] = i;
    start.assign(1, 0);
    const BlockSparseMatrix &K = model.stiffness;
    for (unsigned int i = 0; i < n_rows; ++i)
    {
      for (std::size_t k = K.start[node[i]]; k < K.start[node[i] + 1]; ++k)
      {
        column.push_back(number[K.column[k]]);
        value.push_back(K.value[k]);
      }
      start.push_back(column.size());
    }
  }

  void RockPatch::add_layers(const RockModel &model, const unsigned int n_steps)
  {
    const BlockSparseMatrix &K = model.stiffness;
    std::vector<bool>        is_there(model.points.size(), false);
    for (const unsigned int i : node)
      is_there[i] = true;
    for (unsigned int layer = 1, first = 0; layer <= n_steps; ++layer)
    {
      const unsigned int end = node.size();
      for (unsigned int i = first; i < end; ++i)
        for (std::size_t k = K.start[node[i]]; k < K.start[node[i] + 1]; ++k)
          if (!is_there[K.column[k]])
          {
            is_there[K.column[k]] = true;
            node.push_back(K.column[k]);
          }
      first = end;
      n_layer.push_back(node.size());
    }
  }

  /** Advances the nodes within @p n_left layers by one step of ExplicitRegion. @p force: on the base nodes
   * [N], or nullptr. */
  void RockPatch::step(const unsigned int n_left, const double *force, Motion &motion) const
  {
    Unknowns &u = motion.u, &w = motion.w, &x = motion.x;
    const int n_moved = 3 * n_layer[n_left + 1], n_rows = n_layer[n_left],
              n_forces = force ? n_base_nodes() : 0;
    constexpr int piece = 768;
#pragma omp parallel for schedule(static)
    for (int first = 0; first < n_moved; first += piece)
    {
      const int last = std::min(n_moved, first + piece);
#pragma omp simd
      for (int k = first; k < last; ++k)
        u[k] += dt * w[k];
      motion.damped.advance(u.data(), w.data(), x.data(), first, last);
    }
#pragma omp parallel for schedule(static)
    for (int i = 0; i < n_rows; ++i)
    {
      double K[3] = {0., 0., 0.};
      for (std::size_t e = start[i]; e < start[i + 1]; ++e)
      {
        const double  *y = x.data() + 3 * std::size_t(column[e]);
        const Matrix3 &a = value[e];
        for (unsigned int c = 0; c < 3; ++c)
          K[c] += a[3 * c] * y[0] + a[3 * c + 1] * y[1] + a[3 * c + 2] * y[2];
      }
      for (unsigned int c = 0; c < 3; ++c)
      {
        const double f = i < n_forces ? force[3 * i + c] : 0.;
        double      &v = w[3 * std::size_t(i) + c];
        v += dt * (inverse_mass[i] * (f - K[c]) - damping.mass * v);
      }
    }
  }

  Unknowns RockPatch::at_base(const Motion &motion) const
  {
    Unknowns place(3 * std::size_t(n_base_nodes()));
    for (std::size_t k = 0; k < place.size(); ++k)
      place[k] = motion.u[k] + .5 * dt * motion.w[k];
    return place;
  }

  RockPatch::Motion RockPatch::at_rest(const unsigned int n_steps) const
  {
    const std::size_t n = 3 * std::size_t(n_layer[n_steps]);
    return {Unknowns(n, 0.), Unknowns(n, 0.), Unknowns(n, 0.), DampedMotion(damping, dt, n)};
  }

  Unknowns RockPatch::places(const unsigned int n_steps, const Unknowns &u, const Unknowns &w,
                             const DampedMotion &damped) const
  {
    Motion motion = at_rest(n_steps);
    for (std::size_t i = 0; i < n_layer[n_steps]; ++i)
      for (unsigned int c = 0; c < 3; ++c)
      {
        motion.u[3 * i + c] = u[3 * std::size_t(node[i]) + c];
        motion.w[3 * i + c] = w[3 * std::size_t(node[i]) + c];
      }
    motion.damped.copy(damped, node);
    for (unsigned int left = n_steps; left-- > 0;)
      step(left, nullptr, motion);
    return at_base(motion);
  }

  /** Returns for each base node the base nodes that its force moves within @p n_steps steps: those up to
   * n_steps - 1 layers away. */
  std::vector<std::vector<unsigned int>> RockPatch::reach(const unsigned int n_steps) const
  {
    std::vector<std::vector<unsigned int>> result(n_base_nodes());
    for (unsigned int base_node = 0; base_node < n_base_nodes(); ++base_node)
    {
      std::set<unsigned int>    found = {base_node};
      std::vector<unsigned int> edge = {base_node}, next;
      for (unsigned int layer = 1; layer < n_steps; ++layer, edge.swap(next), next.clear())
        for (const unsigned int i : edge)
          for (std::size_t e = start[i]; i < n_layer[n_steps - 1] && e < start[i + 1]; ++e)
            if (found.insert(column[e]).second)
              next.push_back(column[e]);
      for (const unsigned int i : found)
        if (i < n_base_nodes())
          result[base_node].push_back(i);
    }
    return result;
  }

  BlockSparseMatrix RockPatch::compliance(const unsigned int n_steps) const
  {
    const auto        reached = reach(n_steps);
    BlockSparseMatrix result(reached);
    std::vector<bool> done(n_base_nodes(), false);
    for (unsigned int first = 0; first < n_base_nodes(); ++first)
    {
      if (done[first])
        continue;
      std::vector<unsigned int> together; // base nodes whose forces move disjoint sets of base nodes
      std::vector<bool>         taken(n_base_nodes(), false);
      for (unsigned int base_node = first; base_node < n_base_nodes(); ++base_node)
        if (!done[base_node] && std::none_of(reached[base_node].begin(), reached[base_node].end(),
                                             [&](const unsigned int i) { return taken[i]; }))
        {
          done[base_node] = true;
          together.push_back(base_node);
          for (const unsigned int i : reached[base_node])
            taken[i] = true;
        }
      for (unsigned int c = 0; c < 3; ++c)
      {
        Motion   motion = at_rest(n_steps);
        Unknowns force(3 * std::size_t(n_base_nodes()), 0.);
        for (const unsigned int base_node : together)
          force[3 * base_node + c] = 1.;
        for (unsigned int left = n_steps; left-- > 0;)
          step(left, force.data(), motion);
        const Unknowns place = at_base(motion);
        for (const unsigned int base_node : together)
          for (const unsigned int i : reached[base_node])
          {
            Matrix3 block{};
            for (unsigned int r = 0; r < 3; ++r)
              block[3 * r + c] = place[3 * i + r];
            result.add(i, base_node, block);
          }
      }
    }
    return result;
  }
} // namespace Voussoir
