// SPDX-License-Identifier: GPL-3.0-or-later
// Bodies seen through their interfaces, with either order of elimination and with the kernels of any
// processor; the joints' own blocks of Newton's equations.

#include "testing.h"

#include <voussoir/joints/condensed_body.h>
#include <voussoir/joints/joint_block.h>
#include <voussoir/joints/packed_factor.h>

#include <random>

using namespace Voussoir;
using namespace Testing;

namespace
{
  double norm(const Unknowns &x)
  {
    double sum = 0.;
    for (const double y : x)
      sum += y * y;
    return std::sqrt(sum);
  }

  /** A box of nodes, each coupled to its 26 neighbours; of its @p layers across x, the first and the last are
   * the interface. */
  Structure box(const unsigned int layers, const unsigned int across, const unsigned int up,
                const bool joined)
  {
    std::mt19937                           random(7);
    std::uniform_real_distribution<double> number(-1., 1.);
    const int                              n[3] = {int(layers), int(across), int(up)};
    const auto node = [&](int i, int j, int k) { return (i * n[1] + j) * n[2] + k; };
    std::vector<std::vector<unsigned int>> columns(layers * across * up);
    const auto                             for_neighbours = [&](const auto &action)
    {
      for (int i = 0; i < n[0]; ++i)
        for (int j = 0; j < n[1]; ++j)
          for (int k = 0; k < n[2]; ++k)
            for (int a = std::max(0, i - 1); a < std::min(n[0], i + 2); ++a)
              for (int b = std::max(0, j - 1); b < std::min(n[1], j + 2); ++b)
                for (int c = std::max(0, k - 1); c < std::min(n[2], k + 2); ++c)
                  action(node(i, j, k), node(a, b, c));
    };
    for_neighbours([&](const unsigned int a, const unsigned int b) { columns[a].push_back(b); });
    Structure structure;
    structure.bodies.resize(1);
    Body &body = structure.bodies[0];
    body.stiffness = BlockSparseMatrix(columns);
    for_neighbours(
        [&](const unsigned int a, const unsigned int b)
        {
          if (a >= b)
            return;
          const Vector3 v = {{number(random), number(random), number(random)}};
          Matrix3       k, minus;
          for (unsigned int c = 0; c < 9; ++c)
          {
            k[c] = 1e9 * (v[c / 3] * v[c % 3] + (c % 4 == 0 ? .1 : 0.));
            minus[c] = -k[c];
          }
          body.stiffness.add(a, a, k);
          body.stiffness.add(b, b, k);
          body.stiffness.add(a, b, minus);
          body.stiffness.add(b, a, minus);
        });
    for (unsigned int i = 0; i < columns.size(); ++i)
    {
      structure.mass.push_back({{2e3, 1e2, 0., 1e2, 3e3, 0., 0., 0., 1e3}});
      if (joined && (i < across * up || i >= (layers - 1) * across * up))
        body.interface.push_back(i);
    }
    return structure;
  }

  constexpr double mass_factor = 4e4, stiffness_factor = 1.2;

  /** (mass_factor M + stiffness_factor K + springs) u */
  Unknowns multiply(const Structure &structure, const Unknowns &springs, const Unknowns &u)
  {
    Unknowns Au(u.size());
    structure.multiply_stiffness(u, Au);
    for (std::size_t i = 0; i < u.size(); ++i)
    {
      Au[i] = stiffness_factor * Au[i] + springs[i] * u[i];
      for (unsigned int c = 0; c < 3; ++c)
        Au[i] += mass_factor * structure.mass[i / 3][3 * (i % 3) + c] * u[i - i % 3 + c];
    }
    return Au;
  }

  void check_body(const std::string &name, const Structure &structure, const bool free_order,
                  const bool single = false)
  {
    const double                           limit = single ? 2e-6 : 1e-12;
    const Body                            &body = structure.bodies[0];
    const std::size_t                      n = 3 * structure.n_nodes();
    std::mt19937                           random(3);
    std::uniform_real_distribution<double> number(-1., 1.);
    Unknowns                               springs(n), b(n), u(n), free(n);
    for (std::size_t i = 0; i < n; ++i)
      springs[i] = i % 7 == 0 ? 1e8 : 0., b[i] = 1e6 * number(random);
    CondensedBody     condensed(structure, body, {mass_factor, stiffness_factor}, springs, single);
    const std::size_t m = condensed.n_interface();
    expect(m == 3 * body.interface.size(), name + ": size of the interface");
    if (m > 0)
      expect(condensed.has_free_order() == free_order, name + ": the order that reads less is chosen");
    Unknowns f(m), u_G(m), none(m, 0.), zero(n, 0.);
    for (double &x : f)
      x = 1e6 * number(random);

    condensed.apply_load(b.data(), u_G.data());
    condensed.apply_joint_forces(f.data(), u.data());
    Unknowns r = multiply(structure, springs, u);
    for (std::size_t i = 0; i < n; ++i)
      r[i] -= b[i];
    for (std::size_t i = 0; i < m; ++i)
      r[3 * body.interface[i / 3] + i % 3] -= f[i];
    below(name + ": residual of A u = b + G f", norm(r) / norm(b), limit);

    condensed.apply_load(b.data(), u_G.data());
    condensed.apply_joint_forces(none.data(), free.data());
    double                    error = 0., forced = 0., size = 0.;
    const std::vector<double> F = condensed.take_flexibility();
    expect(F.size() == m * m, name + ": size of the flexibility");
    for (std::size_t i = 0; i < m; ++i)
    {
      const std::size_t at = 3 * body.interface[i / 3] + i % 3;
      error = std::max(error, std::abs(u_G[i] - free[at]));
      double Ff = 0.;
      for (std::size_t j = 0; j < m; ++j)
        Ff += F[j * m + i] * f[j];
      forced = std::max(forced, std::abs(Ff - (u[at] - free[at])));
      size = std::max(size, std::abs(free[at]));
    }
    if (m == 0)
      return;
    below(name + ": displacement of the interface without forces", error / size, limit);
    below(name + ": its flexibility", forced / size, limit);
  }

  void test_bodies()
  {
    for (const bool plain : {false, true})
    {
      PackedFactor::plain_kernels = plain;
      const std::string kernels = plain ? ", plain kernels" : "";
      check_body("thin body" + kernels, box(3, 5, 12, true), true);
      check_body("thick body" + kernels, box(24, 4, 5, true), false);
      if (!plain)
        check_body("large body with joints, dissected", box(60, 10, 12, true), false);
      check_body("body without joints" + kernels, box(4, 5, 6, false), true);
      check_body("one node" + kernels, box(1, 1, 1, false), true);
      Structure divided = box(3, 4, 12, true); // its rest touches a part of the interface only
      for (unsigned int i = 2; i < 4; ++i)
        for (unsigned int k = 0; k < 12; ++k)
          divided.bodies[0].interface.push_back(12 * (4 + i) + k);
      std::sort(divided.bodies[0].interface.begin(), divided.bodies[0].interface.end());
      check_body("interface that the rest does not connect" + kernels, divided, true);
      check_body("thin body, single precision" + kernels, box(3, 5, 12, true), true, true);
      check_body("thick body, single precision" + kernels, box(24, 4, 5, true), false, true);
    }
    PackedFactor::plain_kernels = false;
    check_body("large body, packed in place", box(6, 30, 60, false), true);
    check_body("large body, single precision, packed in place", box(6, 30, 60, false), true, true);
  }

  /** A joint of @p n pairs whose W is smooth, with a small part of its own at each pair. */
  InterfaceOperator joint(const unsigned int n, const bool twice)
  {
    InterfaceOperator    W({n});
    std::vector<double> &w = W.block(0, 0);
    const unsigned int   m = 3 * n;
    for (unsigned int i = 0; i < m; ++i)
      for (unsigned int j = 0; j < m; ++j)
      {
        // The last pair is the first once more, or a pair of its own.
        const unsigned int a = twice && i / 3 == n - 1 ? i % 3 : i, b = twice && j / 3 == n - 1 ? j % 3 : j;
        const double       d = double(a / 3) - double(b / 3);
        w[i * m + j] = 1e-9 * (std::exp(-std::abs(d)) * (a % 3 == b % 3 ? 1. : .1));
      }
    W.finish();
    return W;
  }

  /** Equations of @p n pairs; of each eight, @p sticking stick, one slips, one is of no special form, the
   * others are open. */
  std::vector<PairEquations> equations_of(const unsigned int n, const unsigned int sticking)
  {
    std::vector<PairEquations> result(n);
    for (unsigned int i = 0; i < n; ++i)
    {
      PairEquations &e = result[i];
      e = {};
      const double rho = 1e9;
      if (i % 8 < sticking)
        for (unsigned int c = 0; c < 3; ++c)
          e.d_gap[4 * c] = rho;
      else if (i % 8 == sticking)
      {
        e.d_gap = {{rho, 0., 0., .3 * rho, .4 * rho, -.1 * rho, .2 * rho, -.1 * rho, .2 * rho}};
        e.d_force = {{0., 0., 0., -.3, .6, .1, -.2, .1, .8}};
      }
      else if (i % 8 == sticking + 1)
      {
        e.d_gap = {{rho, .1 * rho, 0., 0., .5 * rho, 0., 0., .1 * rho, rho}};
        e.d_force = {{.2, 0., .1, 0., .5, 0., .1, 0., .3}};
      }
      else
        e.d_force = {{1., 0., 0., 0., 1., 0., 0., 0., 1.}};
    }
    return result;
  }

  /** @p smooth: a right-hand side that needs small forces only; the inverse is inaccurate then, which makes
   * the solution worse, but W z must not. */
  void check_block(const std::string &name, const InterfaceOperator &W, const unsigned int sticking,
                   const bool smooth = false)
  {
    const unsigned int               n = W.n();
    const std::vector<PairEquations> equations = equations_of(n / 3, sticking);
    JointBlock                       block;
    block.initialise(W, 0);
    expect(block.update(equations.data()), name + ": the first equations are factorised");
    expect(!block.update(equations.data()), name + ": the same ones again are not");
    std::vector<float> r(n), z(n), y(n);
    for (unsigned int i = 0; i < n; ++i)
    {
      const PairEquations &e = equations[i / 3];
      r[i] =
          e.d_gap[4 * (i % 3)] == 0. ? 0.f : static_cast<float>(std::sin(1. + i)); // open pairs: always zero
    }
    for (unsigned int i = 0; i < n && smooth; ++i)
      r[i] = static_cast<float>(std::exp(-std::pow(.15 * (i / 3 - n / 6.), 2)));
    block.solve(r.data(), z.data(), y.data());
    Unknowns Wz, force(z.begin(), z.end());
    W.multiply(force, Wz);
    double error = 0., size = 0., product = 0., largest = 0.;
    for (unsigned int i = 0; i < n; ++i)
    {
      const PairEquations &e = equations[i / 3];
      double               sum = -r[i];
      for (unsigned int c = 0; c < 3; ++c)
        sum += e.d_force[3 * (i % 3) + c] * z[i - i % 3 + c] + e.d_gap[3 * (i % 3) + c] * Wz[i - i % 3 + c];
      error += sum * sum;
      size += double(r[i]) * r[i];
      product += (Wz[i] - y[i]) * (Wz[i] - y[i]);
      largest += Wz[i] * Wz[i];
    }
    below(name + ": residual of D z = r", std::sqrt(error / size), smooth ? 1e-3 : 2e-5);
    below(name + ": y = W z", std::sqrt(product / largest), 1e-6);
  }

  /** A joint whose W can be inverted, but not so that single precision would hold the inverse. */
  InterfaceOperator smooth_joint(const unsigned int n)
  {
    InterfaceOperator    W({n});
    std::vector<double> &w = W.block(0, 0);
    for (unsigned int i = 0; i < 3 * n; ++i)
      for (unsigned int j = i % 3; j < 3 * n; j += 3)
      {
        const double d = .3 * (double(i / 3) - double(j / 3));
        w[i * 3 * n + j] = 1e-9 * (std::exp(-d * d) + (i == j ? 1e-3 : 0.));
      }
    W.finish();
    return W;
  }

  /** The inverse is made when it is first of use, and is the same then. */
  void test_lazy_inverse()
  {
    const InterfaceOperator          W = joint(41, false);
    const unsigned int               n = W.n();
    const std::vector<PairEquations> sticking = equations_of(n / 3, 6), open = equations_of(n / 3, 1);
    JointBlock                       early, late;
    early.initialise(W, 0);
    late.initialise(W, 0);
    expect(late.update(open.data()), "lazy: equations of open pairs are factorised");
    expect(!late.holds_inverse(), "lazy: open pairs need no inverse");
    expect(late.update(sticking.data()), "lazy: other equations are factorised");
    expect(late.holds_inverse(), "lazy: sticking pairs need it");
    early.update(sticking.data());
    std::vector<float> r(n), z[2], y[2];
    for (unsigned int i = 0; i < n; ++i)
      r[i] = static_cast<float>(std::cos(2. + i));
    for (const unsigned int k : {0u, 1u})
    {
      z[k].resize(n);
      y[k].resize(n);
      (k == 0 ? early : late).solve(r.data(), z[k].data(), y[k].data());
    }
    expect(z[0] == z[1] && y[0] == y[1], "lazy: an inverse that was made late gives the same");
  }

  void test_blocks()
  {
    const InterfaceOperator W = joint(41, false);
    check_block("most pairs stick", W, 6);
    check_block("most pairs are open", W, 1);
    check_block("half of the pairs stick", W, 4);
    check_block("an inverse beyond single precision", smooth_joint(41), 8, true);
    check_block("W_jj that cannot be inverted", joint(44, true),
                1); // the pair that is there twice sticks and is open
  }
} // namespace

int main(int argc, char **argv)
{
  return run({{"bodies", test_bodies}, {"blocks", test_blocks}, {"lazy", test_lazy_inverse}}, argc, argv);
}
