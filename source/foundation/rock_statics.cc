// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/error.h>
#include <voussoir/base/tridiagonal.h>
#include <voussoir/foundation/rock_statics.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace Voussoir
{
  namespace
  {
    double component(const Matrix3 &a, const std::size_t k, const Unknowns &x)
    {
      const double *row = a.data() + 3 * (k % 3), *at = x.data() + 3 * (k / 3);
      return row[0] * at[0] + row[1] * at[1] + row[2] * at[2];
    }
  } // namespace

  RockStatics::RockStatics(const RockModel &model, const std::vector<bool> &held, NodeSprings given,
                           const MakeCoarseRock &make_coarse_solver)
      : aggregates(model.stiffness, model.points, held, strong_coupling()), springs(std::move(given)),
        n_nodes(model.stiffness.n_rows()), split(n_nodes)
  {
    const Stopwatch watch;
    for (unsigned int a = 0; a < aggregates.n(); ++a)
    {
      seeds.push_back(aggregates.seed(a));
      n_free += 3 * aggregates.nodes(a).size();
      if (!split.is_trivial())
        split.step(aggregates.nodes(a), split.owner(seeds.back()));
    }
    stiffness = std::make_unique<RockOperator>(model.stiffness, model.points, model.nodal_cells,
                                               model.in_other_cell, nodal_kernel(), split);
    pieces = split.pieces(static_cast<int>(n_nodes));
    correction.assign(3 * std::size_t(n_nodes), 0.);
    work = rest = correction;
    find_inverse(model);
    eigenvalue = 1.1 * largest_eigenvalue();
    make_coarse(model, make_coarse_solver);
    setup = watch.seconds();
  }

  RockStatics::~RockStatics() = default;

  template <class Action> void RockStatics::everywhere(const Action &action) const
  {
    const int n = static_cast<int>(pieces.size());
#pragma omp parallel for schedule(static)
    for (int p = 0; p < n; ++p)
      for (std::size_t k = 3 * std::size_t(pieces[p].first); k < 3 * std::size_t(pieces[p].second); ++k)
        action(k);
  }

  void RockStatics::find_inverse(const RockModel &model)
  {
    const BlockSparseMatrix &K = model.stiffness;
    std::vector<double>      all(9 * std::size_t(n_nodes), 0.);
    for (unsigned int i = 0; i < n_nodes; ++i)
      for (std::size_t k = K.start[i]; k < K.start[i + 1] && split.owner(i) == Ranks::rank(); ++k)
        if (K.column[k] == i && aggregates.of_node(i) != RockAggregates::none)
        {
          Matrix3 block = K.value[k];
          if (const auto spring = springs.find(i); spring != springs.end())
            for (unsigned int c = 0; c < 9; ++c)
              block[c] += spring->second[c];
          block = Voussoir::inverse(block);
          std::copy(block.begin(), block.end(), all.begin() + 9 * std::size_t(i));
        }
    split.gather(all, 9);
    inverse.resize(n_nodes);
    for (unsigned int i = 0; i < n_nodes; ++i)
      std::copy_n(all.begin() + 9 * std::size_t(i), 9, inverse[i].begin());
  }

  void RockStatics::multiply(const Unknowns &x, Unknowns &y) const
  {
    stiffness->multiply(x.data(), y.data());
    for (const auto &[node, spring] : springs)
      for (std::size_t k = 3 * std::size_t(node); k < 3 * std::size_t(node) + 3; ++k)
        y[k] += component(spring, k, x);
    everywhere(
        [&](const std::size_t k)
        {
          if (aggregates.of_node(k / 3) == RockAggregates::none)
            y[k] = 0.;
        });
  }

  double RockStatics::product(const Unknowns &a, const Unknowns &b) const
  {
    constexpr unsigned int per_chunk = RockSplit::per_chunk;
    const int              n_chunks = static_cast<int>((n_nodes + per_chunk - 1) / per_chunk);
    std::vector<double>    of_chunk(n_chunks, 0.);
#pragma omp parallel for schedule(static)
    for (int c = 0; c < n_chunks; ++c)
      if (split.owner(c * per_chunk) == Ranks::rank())
        for (std::size_t k = 3 * std::size_t(c) * per_chunk;
             k < 3 * std::min<std::size_t>(n_nodes, std::size_t(c + 1) * per_chunk); ++k)
          of_chunk[c] += a[k] * b[k];
    split.gather_chunks(of_chunk, 1);
    double sum = 0.;
    for (const double part : of_chunk)
      sum += part;
    return sum;
  }

  /** Lanczos method. Power iteration converges slowly for distorted elements, and the smoother amplifies
   * modes above an eigenvalue that is too small. */
  double RockStatics::largest_eigenvalue() const
  {
    constexpr unsigned int n_iterations = 30;
    Unknowns               v(3 * std::size_t(n_nodes), 0.), w = v, w_before = v; // w = D v
    Tridiagonal            T;
    everywhere(
        [&](const std::size_t k)
        {
          work[k] = aggregates.of_node(k / 3) == RockAggregates::none
                        ? 0.
                        : 1. + .5 * std::sin(12.9898 * double(k));
        });
    for (unsigned int i = 0; i < n_iterations; ++i)
    {
      everywhere([&](const std::size_t k) { rest[k] = component(inverse[k / 3], k, work); });
      const double size = std::sqrt(product(work, rest));
      if (i > 0)
        T.off_diagonal.push_back(size);
      if (size == 0. && i > 0)
        break; // an invariant space
      if (!(size > 0.))
        throw ComputationError(
            n_free == 0 ? "All rock nodes are on the surface \"artificial boundary\". Refine the rock."
                        : "The stiffness matrix of the rock (" + std::to_string(n_free) +
                              " unknowns) is not positive definite. Connect all parts of the rock to each "
                              "other and to the surface \"artificial boundary\", and improve distorted "
                              "elements; `voussoir mesh` prints their quality.");
      everywhere(
          [&](const std::size_t k)
          {
            w_before[k] = w[k];
            w[k] = work[k] / size;
            v[k] = rest[k] / size;
          });
      multiply(v, work);
      T.diagonal.push_back(product(v, work));
      everywhere(
          [&](const std::size_t k)
          { work[k] -= T.diagonal.back() * w[k] + (i > 0 ? T.off_diagonal.back() * w_before[k] : 0.); });
    }
    return T.largest_eigenvalue();
  }

  void RockStatics::make_coarse(const RockModel &model, const MakeCoarseRock &make_coarse_solver)
  {
    std::vector<unsigned int> mine;
    for (unsigned int a = 0; a < aggregates.n(); ++a)
      if (split.owner(seeds[a]) == Ranks::rank())
        mine.push_back(a);
    const RockSmoothing      smoothing{model.stiffness, springs, inverse, 4. / (3. * eigenvalue)};
    std::vector<CoarseBlock> blocks = coarse_rows(aggregates, smoothing, mine);
    constexpr std::size_t    length = sizeof(CoarseBlock) / sizeof(double); // sent as doubles
    static_assert(sizeof(CoarseBlock) == 19 * sizeof(double), "no bytes between the blocks");
    const std::vector<double>   counts = Ranks::of_all(double(blocks.size()));
    std::size_t                 total = blocks.size();
    std::vector<Ranks::Message> messages;
    const auto numbers = [&](const std::size_t i) { return reinterpret_cast<double *>(blocks.data() + i); };
    if (Ranks::is_first())
    {
      for (unsigned int r = 1; r < counts.size(); ++r)
        total += static_cast<std::size_t>(counts[r]);
      std::size_t begin = blocks.size();
      blocks.resize(total);
      for (unsigned int r = 1; r < counts.size(); ++r)
      {
        const auto n = static_cast<std::size_t>(counts[r]);
        messages.push_back({r, nullptr, 0, numbers(begin), length * n});
        begin += n;
      }
    }
    else
      messages.push_back({0, numbers(0), length * blocks.size(), nullptr, 0});
    Ranks::exchange(messages);
    Ranks::on_first([&] { coarse = make_coarse_solver(aggregates, std::move(blocks)); });
  }

  /** Chebyshev polynomial of degree 2 for the upper part of the spectrum of D^-1 K (Adams, Brezina, Hu and
   * Tuminaro 2003, J. Comput. Phys. 188). Adds its product with the @p residual to @p z. Updates the @p
   * residual unless @p is_last. */
  void RockStatics::smooth(const bool is_last, Unknowns &residual, Unknowns &z) const
  {
    constexpr double part = 10.;
    const double     middle = .5 * eigenvalue * (1. + 1. / part), half = .5 * eigenvalue * (1. - 1. / part);
    const double     rho = half / middle, next = 1. / (2. / rho - rho);
    everywhere(
        [&](const std::size_t k)
        {
          correction[k] = component(inverse[k / 3], k, residual) / middle;
          z[k] += correction[k];
        });
    multiply(correction, work);
    everywhere([&](const std::size_t k) { residual[k] -= work[k]; });
    everywhere(
        [&](const std::size_t k)
        {
          correction[k] =
              next * rho * correction[k] + 2. * next / half * component(inverse[k / 3], k, residual);
          z[k] += correction[k];
        });
    if (is_last)
      return;
    multiply(correction, work);
    everywhere([&](const std::size_t k) { residual[k] -= work[k]; });
  }

  /** Correction in the space of smoothed rigid body motions of the aggregates. */
  void RockStatics::correct(Unknowns &residual, Unknowns &z) const
  {
    const double damping = 4. / (3. * eigenvalue);
    everywhere([&](const std::size_t k)
               { correction[k] = damping * component(inverse[k / 3], k, residual); });
    multiply(correction, work);
    std::vector<double> forces(6 * std::size_t(aggregates.n()), 0.), motions = forces;
    for (unsigned int a = 0; a < aggregates.n(); ++a)
      if (split.owner(seeds[a]) == Ranks::rank())
      {
        RigidMotion sum{};
        for (const unsigned int i : aggregates.nodes(a))
        {
          const std::size_t k = 3 * std::size_t(i);
          aggregates.add_force(
              i, {{residual[k] - work[k], residual[k + 1] - work[k + 1], residual[k + 2] - work[k + 2]}},
              sum);
        }
        std::copy(sum.begin(), sum.end(), forces.begin() + 6 * std::size_t(a));
      }
    split.gather(forces, 6, seeds);
    if (coarse)
      coarse->solve(forces, motions);
    Ranks::broadcast(motions.data(), motions.size(), 0);
    for (const auto &[begin, end] : pieces)
      for (int i = begin; i < end; ++i)
      {
        Vector3 u{};
        if (const unsigned int a = aggregates.of_node(i); a != RockAggregates::none)
        {
          RigidMotion motion;
          std::copy_n(motions.begin() + 6 * std::size_t(a), 6, motion.begin());
          u = aggregates.displacement(i, motion);
        }
        std::copy(u.begin(), u.end(), correction.begin() + 3 * std::size_t(i));
      }
    multiply(correction, work);
    everywhere([&](const std::size_t k)
               { z[k] += correction[k] -= damping * component(inverse[k / 3], k, work); });
    multiply(correction, work);
    everywhere([&](const std::size_t k) { residual[k] -= work[k]; });
  }

  void RockStatics::precondition(const Unknowns &r, Unknowns &z) const
  {
    everywhere(
        [&](const std::size_t k)
        {
          rest[k] = r[k];
          z[k] = 0.;
        });
    smooth(false, rest, z);
    correct(rest, z);
    smooth(true, rest, z);
  }

  unsigned int RockStatics::solve(const Unknowns &b, Unknowns &x, Log &log, const double tolerance,
                                  const double part)
  {
    last.resize(b.size(), 0.);
    multiply(last, work);
    everywhere([&](const std::size_t k)
               { rest[k] = aggregates.of_node(k / 3) == RockAggregates::none ? 0. : b[k] - work[k]; });
    const double goal = part * std::sqrt(product(rest, rest));
    Unknowns     guess = last;
    for (const std::vector<double> &before : solutions)
    {
      std::size_t j = 0;
      for (const auto &[begin, end] : pieces)
        for (std::size_t k = 3 * std::size_t(begin); k < 3 * std::size_t(end); ++k)
          correction[k] = before[j++];
      const double along = product(correction, rest);
      everywhere([&](const std::size_t k) { guess[k] += along * correction[k]; });
    }
    x = guess;
    const unsigned int n = iterate(b, x, log, tolerance, goal);
    keep(guess, x);
    last = x;
    split.gather(x, 3);
    return n;
  }

  unsigned int RockStatics::iterate(const Unknowns &b, Unknowns &x, Log &log, const double tolerance,
                                    const double goal) const
  {
    constexpr unsigned int most = 1000;
    constexpr double       interval = 10.; // [s]
    const Stopwatch        watch;
    double                 next = interval;
    Unknowns               r(x.size(), 0.), z = r, p = r;
    const auto             load = [&](const std::size_t k)
    { return aggregates.of_node(k / 3) == RockAggregates::none ? 0. : b[k]; };
    multiply(x, work);
    everywhere([&](const std::size_t k) { r[k] = load(k); });
    const double size = std::sqrt(product(r, r));
    everywhere([&](const std::size_t k) { r[k] -= work[k]; });
    double       last = 0., residual = 0.;
    unsigned int n = 0;
    for (; n <= most; ++n)
    {
      residual = std::sqrt(product(r, r));
      if (residual <= std::max(tolerance * size, goal))
        return n;
      if (watch.seconds() > next)
      {
        log.line("          iteration %u, residual %.1e of the load, after %.0f s", n, residual / size,
                 watch.seconds());
        next += interval;
      }
      precondition(r, z);
      const double rz = product(r, z), beta = n == 0 ? 0. : rz / last;
      everywhere([&](const std::size_t k) { p[k] = z[k] + beta * p[k]; });
      multiply(p, work);
      const double alpha = rz / product(p, work);
      last = rz;
      if (!(rz > 0.) || !(alpha > 0.)) // breakdown
        break;
      everywhere(
          [&](const std::size_t k)
          {
            x[k] += alpha * p[k];
            r[k] -= alpha * work[k];
          });
    }
    std::ostringstream message;
    message
        << "The static solution of the rock did not converge: after " << std::min(n, most)
        << " iterations the residual is " << residual / size << " of the load (limit "
        << std::max(tolerance, goal / size) << "). Check the materials in "
        << "section Foundation, and improve distorted rock elements; `voussoir mesh` prints their quality.";
    throw ComputationError(message.str());
  }

  /** Stores the normalised difference of @p x and @p guess. */
  void RockStatics::keep(const Unknowns &guess, const Unknowns &x)
  {
    constexpr std::size_t most = 60;
    if (solutions.size() == most)
      return;
    everywhere([&](const std::size_t k) { correction[k] = x[k] - guess[k]; });
    multiply(correction, work);
    const double square = product(correction, work);
    if (!(square > 0.))
      return;
    solutions.emplace_back();
    for (const auto &[begin, end] : pieces)
      for (std::size_t k = 3 * std::size_t(begin); k < 3 * std::size_t(end); ++k)
        solutions.back().push_back(correction[k] / std::sqrt(square));
  }
} // namespace Voussoir
