// SPDX-License-Identifier: GPL-3.0-or-later
// A dam with compliant base nodes: the joint operator after their elimination, and a solution, against the
// complete system.

#include "blocks.h"

#include <voussoir/base/error.h>
#include <voussoir/foundation/massless_support.h>

using namespace Columns;

extern "C"
{
  void dgesv_(const int *n, const int *n_rhs, double *a, const int *lda, int *pivots, double *b,
              const int *ldb, int *info);
}

namespace
{
  constexpr StepOperator step = {4e6, 1.02, 2.}; // step of 1 ms with damping, mean forces

  /** Three blocks in a row, with some of their nodes as base nodes: A u = load + G^T force + L^T
   * base_force, L u = displacement - R base_force. */
  struct Standing
  {
    Standing() : model(blocks(3, false), 1)
    {
      Material concrete;
      concrete.young = 1e9;
      structure = with_joints(model, {concrete, concrete, concrete});
      for (unsigned int i = 0; i < structure.n_nodes(); i += 9) // inside, outside, and at the joints
        base.node.push_back(i);
      base.compliance = compliance();
      for (Body &body : structure.bodies)
      {
        for (const unsigned int node : base.node)
          if (node >= body.first_node && node < body.first_node + body.n_nodes())
            body.interface.push_back(node - body.first_node);
        std::sort(body.interface.begin(), body.interface.end());
        body.interface.erase(std::unique(body.interface.begin(), body.interface.end()), body.interface.end());
      }
    }

    /** Symmetric and positive definite; each base node is coupled to the next two, also those of the next block. */
    BlockSparseMatrix compliance() const
    {
      const unsigned int                     n = base.node.size();
      std::vector<std::vector<unsigned int>> columns(n);
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int k = i - std::min(i, 2u); k < std::min(n, i + 3); ++k)
          columns[i].push_back(k);
      BlockSparseMatrix R(columns);
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int k = i; k < std::min(n, i + 3); ++k)
        {
          Matrix3 block, transposed;
          for (unsigned int c = 0; c < 9; ++c)
            block[c] = 1e-9 * (k == i ? (c % 4 == 0 ? 2. : 0.) : .1 * random_number());
          for (unsigned int c = 0; c < 9; ++c)
            transposed[c] = block[3 * (c % 3) + c / 3];
          R.add(i, k, block);
          if (k != i)
            R.add(k, i, transposed);
        }
      return R;
    }

    std::size_t n_u() const { return 3 * std::size_t(structure.n_nodes()); }
    std::size_t n() const { return n_u() + 3 * base.node.size(); }

    Unknowns A(const Unknowns &u) const
    {
      Unknowns Au;
      structure.multiply_stiffness(u, Au);
      for (unsigned int i = 0; i < structure.n_nodes(); ++i)
      {
        const Vector3 Mu = structure.mass[i] * get(u, i);
        for (unsigned int c = 0; c < 3; ++c)
          Au[3 * i + c] = step.stiffness * Au[3 * i + c] + step.mass * Mu[c];
      }
      return Au;
    }

    /** Product of the complete system with displacements and base forces: A u - share L^T f, then L u + R f. */
    Unknowns product(const Unknowns &x) const
    {
      const Unknowns u(x.begin(), x.begin() + n_u()), f(x.begin() + n_u(), x.end());
      Unknowns       result = A(u), Rf(f.size());
      base.compliance.multiply(f.data(), Rf.data());
      for (std::size_t k = 0; k < f.size(); ++k)
      {
        const std::size_t at = 3 * std::size_t(base.node[k / 3]) + k % 3;
        result[at] -= step.share * f[k];
        result.push_back(u[at] + Rf[k]);
      }
      return result;
    }

    /** Solves for all columns of @p rhs. */
    void solve(Unknowns &rhs) const
    {
      const int        size = n(), n_rhs = rhs.size() / n();
      Unknowns         matrix;
      std::vector<int> pivots(size);
      int              info = 0;
      for (int k = 0; k < size; ++k)
      {
        Unknowns x(size, 0.);
        x[k] = 1.;
        const Unknowns column = product(x);
        matrix.insert(matrix.end(), column.begin(), column.end());
      }
      dgesv_(&size, &n_rhs, matrix.data(), &size, pivots.data(), rhs.data(), &size, &info);
      expect(info == 0, "the whole system has a solution");
    }

    SolidModel             model;
    Structure              structure;
    BaseElimination::Nodes base;
  };

  JointSystem system_of(const Standing &dam, const JointLaws &laws)
  {
    return JointSystem(dam.structure, laws, tight(), step, Unknowns(), &dam.base);
  }

  /** Gaps for unit joint forces, column by column. */
  void test_operator()
  {
    const Standing    dam;
    const JointLaws   laws = make_laws(dam.structure, "FJA", .5);
    const JointSystem system = system_of(dam, laws);
    const auto       &W = system.joint_operator();
    const std::size_t n = 3 * dam.structure.pairs.size();
    Unknowns          x(n * dam.n(), 0.), dense(n * n);
    for (std::size_t k = 0; k < n; ++k)
    {
      Unknowns unit(dam.n_u(), 0.);
      Vector3  f{};
      f[k % 3] = step.share;
      dam.structure.add_pair_force(dam.structure.pairs[k / 3], f, unit);
      std::copy(unit.begin(), unit.end(), x.begin() + k * dam.n());
    }
    dam.solve(x);
    double error = 0., size = 0., far = 0., diagonal = 0., single = 0.;
    for (std::size_t k = 0; k < n; ++k)
    {
      const Unknowns u(x.begin() + k * dam.n(), x.begin() + k * dam.n() + dam.n_u());
      Unknowns       unit(n, 0.), gap;
      unit[k] = 1.;
      W.multiply(unit, gap);
      for (std::size_t p = 0; p < n / 3; ++p)
        for (unsigned int c = 0; c < 3; ++c)
        {
          const std::size_t i = 3 * p + c;
          dense[k * n + i] = dam.structure.jump(dam.structure.pairs[p], u)[c];
          error = std::max(error, std::abs(gap[i] - dense[k * n + i]));
          size = std::max(size, std::abs(dense[k * n + i]));
          if (k / 3 == p)
            diagonal = std::max(diagonal, std::abs(W.diagonal(p)[3 * c + k % 3] - dense[k * n + i]));
        }
    }
    for (unsigned int g = 0; g < W.n_groups(); ++g)
    {
      const std::vector<double> block = W.own_block(g);
      for (unsigned int k = 0; k < W.size(g); ++k)
        for (unsigned int i = 0; i < W.size(g); ++i)
          single = std::max(single, std::abs(block[std::size_t(k) * W.size(g) + i] -
                                             dense[(W.begin(g) + k) * n + W.begin(g) + i]));
    }
    const JointSystem loose(dam.structure, laws, tight(), step); // without base nodes
    for (std::size_t k = 0; k < n; ++k)
    {
      Unknowns unit(n, 0.), gap;
      unit[k] = 1.;
      loose.joint_operator().multiply(unit, gap);
      for (std::size_t i = 0; i < n; ++i)
        far = std::max(far, std::abs(gap[i] - dense[k * n + i]));
    }
    below("operator of the joints against the whole system / largest", error / size, 1e-12);
    below("  diagonal blocks", diagonal / size, 1e-12);
    below("  own blocks of the joints, in single precision", single / size, 1e-6);
    above("  part of the elimination", far / size, .01);
  }

  /** Contact and friction: a solution satisfies the equations of bodies, joints and base nodes. */
  void test_solution()
  {
    const Standing    dam;
    const JointLaws   laws = make_laws(dam.structure, "FJA", .5);
    JointSystem       system = system_of(dam, laws);
    const std::size_t n = 3 * dam.structure.pairs.size();
    Unknowns          load(dam.n_u()), none(n, 0.), offset(n), force(n, 0.), gap, u, memory;
    BaseOfStep        base;
    for (double &f : load)
      f = 1e6 * random_number();
    for (double &x : offset)
      x = 1e-4 * random_number();
    for (std::size_t k = 0; k < 3 * dam.base.node.size(); ++k)
      base.displacement.push_back(1e-3 * random_number());
    const ContactResult result = system.solve(load, offset, none, memory, force, gap, u, &base);
    report("joints and base nodes: residual", result.residual, "converged", result.converged);
    Unknowns x = u;
    x.insert(x.end(), base.force.begin(), base.force.end());
    Unknowns expected = load;
    for (std::size_t p = 0; p < n / 3; ++p)
    {
      Vector3 f = get(force, p);
      for (double &x : f)
        x *= step.share;
      dam.structure.add_pair_force(dam.structure.pairs[p], f, expected);
    }
    const double forces = largest(expected), places = largest(base.displacement);
    expected.insert(expected.end(), base.displacement.begin(), base.displacement.end());
    const Unknowns left = dam.product(x);
    double         of_bodies = 0., of_base = 0., of_gaps = 0.;
    for (std::size_t k = 0; k < left.size(); ++k)
    {
      double &worst = k < dam.n_u() ? of_bodies : of_base;
      worst = std::max(worst, std::abs(left[k] - expected[k]));
    }
    for (std::size_t k = 0; k < n; ++k)
      of_gaps = std::max(
          of_gaps, std::abs(dam.structure.jump(dam.structure.pairs[k / 3], u)[k % 3] + offset[k] - gap[k]));
    below("  equations of motion / largest force", of_bodies / forces, 1e-12);
    below("  base nodes: displacement - R force / largest displacement", of_base / places, 1e-12);
    below("  gaps / largest", of_gaps / largest(gap), 1e-10);
    above("  forces of the joints", largest(force), 0.);
    above("  forces on the base nodes / largest force", largest(base.force) / forces, .01);
  }

  /** A part of a step of massless rock is a whole step of that length. */
  void test_parts()
  {
    CondensedRock rock;
    rock.base_nodes = {{0, {0}}};
    rock.stiffness = {3e9, 1e9, 0., 1e9, 2e9, 0., 0., 0., 4e9};
    const DamNodes     standing(rock.base_nodes);
    constexpr double   damping = 2e-3, dt = 1e-2;
    MasslessSupport    whole(rock, standing, damping, dt), quarter(rock, standing, damping, dt / 4);
    const unsigned int n = whole.n_substeps();
    const Unknowns     at = {1., -2., 3.}, a = whole.predict(n / 4, 0., at), b = quarter.predict(n, 0., at);
    const auto         c = whole.compliance(n / 4), d = quarter.compliance(n);
    for (unsigned int i = 0; i < 3; ++i)
      below("massless rock, a quarter of a step: place", a[i] / b[i] - 1., 1e-14);
    for (unsigned int i = 0; i < 9; ++i)
      below("  compliance", c.value[0][i] - d.value[0][i], 1e-14 * d.value[0][0]);
    below("  place by hand", a[0] - (2. * damping * 4. / dt - 1.) / (2. * damping * 4. / dt + 1.), 1e-14);
  }

  /** Constant accelerations at stations: displacements a t^2/2, interpolated by height. */
  void test_base_motion()
  {
    GroundMotion motion;
    motion.dt = .5;
    motion.acceleration.assign(5, {{1., 0., 0.}});
    motion.stations = {{false, 150., std::vector<std::array<double, 3>>(5, {{3., 0., 0.}})},
                       {true, 120., std::vector<std::array<double, 3>>(5, {{1., 4., 0.}})},
                       {false, 120., std::vector<std::array<double, 3>>(5, {{2., 0., 0.}})}};
    const std::vector<Vector3> places = {{{0., 0., 100.}},  {{0., -1., 110.}}, {{0., -1., 120.}},
                                         {{0., -1., 135.}}, {{0., -1., 170.}}, {{0., 1., 105.}},
                                         {{0., 1., 200.}}};
    const double               x[] = {0., .5, 1., 1.5, 2., 0., 0.}, y[] = {0., 0., 0., 0., 0., 1., 4.};
    const BaseMotion           base(motion, places);
    const Unknowns             u = base.displacement(1.5), v = base.velocity(1.25);
    for (unsigned int i = 0; i < places.size(); ++i)
    {
      below("base motion: displacement x", u[3 * i] - x[i] * 1.125, 1e-14);
      below("  displacement y", u[3 * i + 1] - y[i] * 1.125, 1e-14);
      below("  velocity x, between two samples", v[3 * i] - x[i] * 1.25, 1e-14);
    }
    below("  after the motion", base.displacement(9.)[12] - 2. * 2., 1e-14);
    motion.stations.resize(1);
    motion.stations[0].height = 100.;
    below("  one station at the lowest node", BaseMotion(motion, places).displacement(1.)[0] - 1., 1e-14);
  }
} // namespace

int main()
{
  return run_all({test_operator, test_solution, test_parts, test_base_motion});
}
