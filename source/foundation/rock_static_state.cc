// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/number_text.h>
#include <voussoir/foundation/rock_static_state.h>

#include <algorithm>
#include <cmath>

namespace Voussoir
{
  namespace
  {
    /** Anderson acceleration: x += f - sum of g (dx + df). The coefficients g minimise |f - sum of g df|. */
    void accelerate(std::vector<Unknowns> df, std::vector<Unknowns> dx, Unknowns f, Unknowns &x)
    {
      const auto dot_product = [](const Unknowns &a, const Unknowns &b)
      {
        double sum = 0.;
        for (std::size_t k = 0; k < a.size(); ++k)
          sum += a[k] * b[k];
        return sum;
      };
      for (std::size_t j = df.size(); j-- > 0;) // Gram-Schmidt, newest first
      {
        const double before = dot_product(df[j], df[j]);
        for (std::size_t i = df.size(); i-- > j + 1;)
          if (const double square = dot_product(df[i], df[i]); square > 0.)
          {
            const double factor = dot_product(df[i], df[j]) / square;
            for (std::size_t k = 0; k < x.size(); ++k)
            {
              df[j][k] -= factor * df[i][k];
              dx[j][k] -= factor * dx[i][k];
            }
          }
        const double square = dot_product(df[j], df[j]);
        if (square <= 1e-20 * before)
        {
          std::fill(df[j].begin(), df[j].end(), 0.);
          continue;
        }
        const double factor = dot_product(df[j], f) / square;
        for (std::size_t k = 0; k < x.size(); ++k)
        {
          f[k] -= factor * df[j][k];
          x[k] -= factor * dx[j][k];
        }
      }
      for (std::size_t k = 0; k < x.size(); ++k)
        x[k] += f[k];
    }

    /** Last differences of the residuals f and the base displacements x, for accelerate(). */
    struct Differences
    {
      std::vector<Unknowns> df, dx;
      Unknowns              last_f, last_x;

      void add(const Unknowns &f, const Unknowns &x)
      {
        constexpr std::size_t most = 25;
        if (!last_f.empty())
        {
          df.push_back(f);
          dx.push_back(x);
          for (std::size_t k = 0; k < f.size(); ++k)
          {
            df.back()[k] -= last_f[k];
            dx.back()[k] -= last_x[k];
          }
          if (df.size() > most)
          {
            df.erase(df.begin());
            dx.erase(dx.begin());
          }
        }
        last_f = f;
        last_x = x;
      }
    };
  } // namespace

  NodeSprings springs_of_far_rock(const RockModel &model, const Vector3 &centre)
  {
    NodeSprings result;
    for (const BoundaryFace &face : model.faces)
    {
      const double nu = face.material.poisson, G = face.material.young / (2. + 2. * nu),
                   along = (2. - nu) / (1. - nu), across = 2. * (1. - 2. * nu) / (3. - 4. * nu);
      for (const unsigned int node : face.nodes)
      {
        Matrix3     &spring = result[node];
        const double r = norm(model.points[node] - centre);
        for (unsigned int a = 0; a < 3; ++a)
          for (unsigned int b = 0; b < 3; ++b)
          {
            const double normal = face.normal[a] * face.normal[b];
            spring[3 * a + b] +=
                G / r * (along * normal + across * ((a == b ? 1. : 0.) - normal)) * face.area / 4.;
          }
      }
    }
    return result;
  }

  RockStaticState::RockStaticState(const RockModel &model, const std::vector<BaseNode> &base_nodes,
                                   const double ratio, const bool has_footings, const bool is_held,
                                   const bool is_slice)
      : model(model), base_nodes(base_nodes), ratio(ratio), has_footings(has_footings), is_held(is_held),
        is_slice(is_slice)
  {
    const auto is_across = [&](const unsigned int i, const unsigned int k)
    {
      const Vector3 d = model.points[base_nodes[k].rock] - model.points[base_nodes[i].rock];
      return is_slice && std::hypot(d[0], d[2]) <= 1e-6 * std::abs(d[1]);
    };
    for (unsigned int i = 0, k = 0; i < base_nodes.size(); across.push_back(k), k = 0, ++i)
      while (k < i && !is_across(i, k))
        ++k;
  }

  Unknowns RockStaticState::springs(const Structure &structure) const
  {
    Unknowns result(3 * structure.n_nodes(), 0.);
    double   largest = 0.;
    for (const Body &body : structure.bodies)
      for (const BaseNode &base_node : base_nodes)
        for (const unsigned int node : base_node.nodes)
          if (node >= body.first_node && node < body.first_node + body.n_nodes())
          {
            const unsigned int i = node - body.first_node;
            for (std::size_t k = body.stiffness.start[i]; k < body.stiffness.start[i + 1]; ++k)
              if (body.stiffness.column[k] == i)
                largest = std::max(largest, body.stiffness.value[k][0]);
          }
    for (const BaseNode &base_node : base_nodes)
      for (const unsigned int node : base_node.nodes)
        for (unsigned int c = 0; c < 3; ++c)
          result[3 * node + c] = 10. * largest;
    return result;
  }

  void RockStaticState::solve_rock(const Unknowns &r, const double part, Unknowns &u_base, Log &log)
  {
    if (!rock)
    {
      Vector3 centre{};
      for (const BaseNode &base_node : base_nodes)
        for (unsigned int c = 0; c < 3; ++c)
          centre[c] += model.points[base_node.rock][c] / base_nodes.size();
      std::vector<bool> held(model.points.size(), false);
      for (const BoundaryFace &face : model.faces)
        for (const unsigned int node : face.nodes)
          held[node] = is_held;
      rock = std::make_unique<RockStatics>(model, held,
                                           is_held ? NodeSprings() : springs_of_far_rock(model, centre));
      log.line("Rock      static solution with %u unknowns; multigrid set up in %.1f s", rock->n_unknowns(),
               rock->seconds_setup());
    }
    Unknowns b(3 * model.points.size(), 0.), u;
    for (const BaseNode &base_node : base_nodes)
      for (const unsigned int node : base_node.nodes)
        for (unsigned int c = 0; c < 3; ++c)
          b[3 * base_node.rock + c] += r[3 * node + c];
    const Stopwatch    watch;
    constexpr double   tolerance = 1e-11;
    const unsigned int iterations = rock->solve(b, u, log, tolerance, part);
    log.line("          static solution %u of the rock: %u iterations, %.1f s", ++n_solutions, iterations,
             watch.seconds());
    u_base.resize(3 * base_nodes.size());
    for (std::size_t i = 0; i < base_nodes.size(); ++i)
      for (unsigned int c = 0; c < 3; ++c)
        u_base[3 * i + c] = c == 1 && is_slice ? 0. : u[3 * base_nodes[across[i]].rock + c] / ratio;
  }

  Unknowns RockStaticState::with_springs(const Unknowns &external, const Unknowns &springs,
                                         const Unknowns &base, const Unknowns &r) const
  {
    Unknowns load = external;
    for (std::size_t i = 0; i < base_nodes.size(); ++i)
      for (const unsigned int node : base_nodes[i].nodes)
        for (unsigned int c = 0; c < 3; ++c)
          load[3 * node + c] += springs[3 * node + c] * base[3 * i + c] - r[3 * node + c];
    return load;
  }

  double RockStaticState::add_spring_forces(const Unknowns &springs, const Unknowns &u, const Unknowns &base,
                                            Unknowns &r) const
  {
    double slack = 0.;
    for (std::size_t i = 0; i < base_nodes.size(); ++i)
      for (const unsigned int node : base_nodes[i].nodes)
        for (unsigned int c = 0; c < 3; ++c)
        {
          const double difference = u[3 * node + c] - base[3 * i + c];
          r[3 * node + c] += springs[3 * node + c] * difference;
          slack = std::max(slack, std::abs(difference));
        }
    return slack;
  }

  ContactResult RockStaticState::solve(const DamSolve &solve_dam, const Unknowns &springs, const Unknowns &u,
                                       Unknowns &load, std::string &failure, Log &log)
  {
    constexpr double  enough = 1e-9;
    const std::size_t n = 3 * base_nodes.size();
    Unknowns          base(n, 0.), r(load.size(), 0.), u_rock;
    Differences       differences;
    double            error = 1.;
    ContactResult     total;
    unsigned int      round = 0;
    total.converged = true;
    double sum = 0., stiffest = 1e-300; // the rock is at rest if the loads in base joints balance each other
    for (std::size_t k = 0; k < load.size(); ++k)
    {
      sum += std::abs(load[k]);
      stiffest = std::max(stiffest, springs[k]);
    }
    for (; round < 200 && error > enough; ++round)
    {
      const ContactResult contact = solve_dam(with_springs(load, springs, base, r));
      total += contact;
      if (!contact.converged)
        break;
      const double slack = add_spring_forces(springs, u, base, r);
      Unknowns     f;
      const auto   solve_rock_to = [&](const double part) // returns the relative error
      {
        solve_rock(r, part, u_rock, log);
        f = u_rock;
        double most = slack, size = has_footings ? 10. * sum / stiffest : 1e-300;
        for (std::size_t k = 0; k < n; ++k)
        {
          f[k] -= base[k];
          most = std::max(most, std::abs(f[k]));
          size = std::max(size, std::abs(u_rock[k]));
        }
        return most / size;
      };
      error = solve_rock_to(.01); // sufficient for an intermediate iteration
      if (error <= enough)
        error = solve_rock_to(0.);
      differences.add(f, base);
      accelerate(differences.df, differences.dx, f, base);
    }
    if (total.converged && error > enough)
    {
      failure =
          "The static state of dam and rock did not converge: relative error " + number_text(error) +
          " (limit " + number_text(enough) + ") after " + std::to_string(round) +
          " iterations. Check the entries of the section Foundation and the quality of the rock elements "
          "(`voussoir mesh`). Blocks that slide or open without self-weight can have no unique state: bond base and "
          "lift joints (\"Joints/Overrides\" = base: tied, lift: tied).";
      total.converged = false;
    }
    for (std::size_t k = 0; k < r.size(); ++k)
      load[k] -= r[k];
    log.line("Rock      static state of dam and rock after %u iterations", round);
    return total;
  }
} // namespace Voussoir
