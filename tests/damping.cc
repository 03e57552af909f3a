// SPDX-License-Identifier: GPL-3.0-or-later
// Uniform damping: the fit of its ratio, free decay of natural modes against the complex pole, and blocks with joints
// against an explicit scheme with the exact solution of the memory variables, written here.

#include "blocks.h"

#include <voussoir/dynamics/leapfrog.h>
#include <voussoir/dynamics/modes.h>

#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/lapack_full_matrix.h>
#include <deal.II/lac/vector.h>

using namespace Columns;

namespace
{
  constexpr double two_pi = 2. * pi;

  /** Damping with the modulus of the input at @p reference [Hz]. */
  Damping uniform(const double ratio, const double begin, const double end, const double reference)
  {
    Relaxation law = Relaxation::of_ratio(ratio, begin, end, 3);
    law.unrelaxed = 1. / law.modulus(two_pi * reference).real();
    return Damping(law);
  }

  void test_fit()
  {
    for (const double ratio : {.02, .05, .1})
    {
      const std::string what = "uniform damping, " + text(100. * ratio) + " % from 0.5 to 20 Hz: ";
      const auto        error = Relaxation::of_ratio(ratio, .5, 20., 3).error_of(ratio, .5, 20.);
      below(what + "error of the ratio", std::max(-error.first, error.second), .03);
      const Damping law = uniform(ratio, .5, 20., 2.7);
      // By causality the modulus grows by 4 ratio/pi per e-fold of the frequency (Kjartansson 1979).
      const double growth =
          std::log(law.of_mode(two_pi * 8.).second / law.of_mode(two_pi * 1.).second) / std::log(8.);
      between(what + "growth of a frequency over 2 ratio/pi", growth / (2. * ratio / pi), .9, 1.1);
      between(what + "modulus at the reference frequency", law.of_mode(two_pi * 2.7).second, .99, 1.01);
    }
    const auto four = Relaxation::of_ratio(.05, .5, 20., 4).error_of(.05, .5, 20.);
    below("uniform damping, four terms: error of the ratio", std::max(-four.first, four.second), .014);
    const Damping rayleigh(.6, .002);
    between("Rayleigh damping: ratio of a mode", rayleigh.of_mode(10.).first, .04 - 1e-15, .04 + 1e-15);
  }

  /** Damping ratio from the differences of successive extremes, in which a slow offset cancels. */
  double ratio_of(const std::vector<double> &q)
  {
    std::vector<double> peaks;
    for (std::size_t i = 1; i + 1 < q.size(); ++i)
      if ((q[i] - q[i - 1]) * (q[i + 1] - q[i]) < 0.)
      {
        const double a = .5 * (q[i - 1] - 2. * q[i] + q[i + 1]), b = .5 * (q[i + 1] - q[i - 1]);
        peaks.push_back(q[i] - b * b / (4. * a));
      }
    const unsigned int n = 10, first = 4;
    const auto         swing = [&](const unsigned int k) { return std::abs(peaks.at(k + 1) - peaks.at(k)); };
    const double       decrement = std::log(swing(first) / swing(first + n)) / n; // per half cycle
    return decrement / std::hypot(pi, decrement);
  }

  /** Blocks of five stiffnesses in their first mode, by a pulse in its shape: frequencies of the first modes of a dam. */
  void test_decay()
  {
    const SolidModel model(blocks(1, true), 1);
    for (const double wanted : {1.25, 1.8, 2.5, 4., 6.})
    {
      Material soft;
      soft.young = 2.4e5 * std::pow(wanted / 2.5, 2.);
      Structure structure = assemble_structure(model, {soft}, true);
      structure.collect_interfaces();
      const NaturalMode mode = natural_modes(structure, 1)[0];
      structure.damping = uniform(.05, .5, 20., 1.25);
      const JointLaws laws;
      const Unknowns  zero(3 * structure.n_nodes(), 0.);
      Unknowns        shape(zero);
      for (unsigned int i = 0; i < structure.n_nodes(); ++i)
        set(shape, i, structure.mass[i] * get(mode.shape, i));
      for (const double dt : {.005, .0025})
      {
        Newmark newmark(structure, laws, tight(), dt, ImpactRule::mean_force);
        newmark.start(zero, zero, {}, zero, {});
        std::vector<double> q;
        const double        period = 1. / mode.frequency;
        for (unsigned int step = 1; step * dt < 12. * period; ++step)
        {
          Unknowns load(zero);
          if (const double t = step * dt; t < .5 * period)
            for (std::size_t j = 0; j < load.size(); ++j)
              load[j] = shape[j] * std::sin(two_pi * t / period);
          newmark.advance(load);
          double sum = 0.;
          for (std::size_t j = 0; j < zero.size(); ++j)
            sum += shape[j] * newmark.state().u[j];
          q.push_back(sum);
        }
        const std::string what =
            "free decay at " + text(wanted) + " Hz, steps of " + text(1e3 * dt) + " ms: ";
        between(what + "frequency of the mode", mode.frequency / wanted, .999, 1.001);
        below(what + "error of the ratio",
              ratio_of(q) / structure.damping.of_mode(two_pi * mode.frequency).first - 1., .02);
        below(what + "error of the energy balance", newmark.energy_error(), 1e-10);
      }
    }
  }

  /** Structure in an explicit scheme (leapfrog), with joints that open without friction. */
  class Explicit
  {
  public:
    Explicit(const Structure &structure, const double h) : structure(structure), law(structure.damping), h(h)
    {
      u.assign(3 * structure.n_nodes(), 0.);
      v = u;
      d.assign(law.c.size(), u);
    }

    void advance(const Unknowns &load)
    {
      Unknowns w(u), Kw;
      for (std::size_t k = 0; k < u.size(); ++k)
      {
        w[k] *= law.modulus;
        for (std::size_t l = 0; l < d.size(); ++l)
          w[k] += law.modulus * law.c[l] * d[l][k];
      }
      structure.multiply_stiffness(w, Kw);
      for (unsigned int row = 0; row < dense.m(); ++row)
        for (unsigned int k = 0; k < dense.m(); ++k)
          Kw[row] += dense(row, k) * v[k];
      for (std::size_t k = 0; k < u.size(); ++k)
        v[k] += h / structure.mass[k / 3][4 * (k % 3)] * (load[k] - Kw[k]);
      for (const Pair &pair : structure.pairs) // each node is in one pair
      {
        Unknowns next(u);
        for (const unsigned int i : {pair.node_1, pair.node_2})
          for (unsigned int c = 0; c < 3; ++c)
            next[3 * i + c] += h * v[3 * i + c];
        const double gap = structure.jump(pair, next)[0];
        if (gap >= 0.)
          continue;
        const double inverse = 1. / structure.mass[pair.node_1][0] + 1. / structure.mass[pair.node_2][0];
        const double impulse = -gap / (h * inverse);
        for (unsigned int c = 0; c < 3; ++c)
        {
          v[3 * pair.node_2 + c] += impulse / structure.mass[pair.node_2][0] * pair.frame[0][c];
          v[3 * pair.node_1 + c] -= impulse / structure.mass[pair.node_1][0] * pair.frame[0][c];
        }
      }
      for (std::size_t k = 0; k < u.size(); ++k)
      {
        for (std::size_t l = 0; l < d.size(); ++l)
        {
          const double kept = std::exp(-h / law.tau[l]);
          d[l][k] = kept * d[l][k] + law.tau[l] * (1. - kept) * v[k];
        }
        u[k] += h * v[k];
      }
    }

    Unknowns                   u, v;
    dealii::FullMatrix<double> dense; ///< damping matrix, or empty [N s/m]

  private:
    const Structure      &structure;
    const Damping         law;
    const double          h;
    std::vector<Unknowns> d;
  };

  /** Returns the damping matrix 2 ratio M sqrt(M^-1 K) of all bodies, which gives all modes of each the same ratio. */
  dealii::FullMatrix<double> damping_of_all_modes(const Structure &structure, const double ratio)
  {
    const unsigned int               n = 3 * structure.n_nodes();
    dealii::LAPACKFullMatrix<double> A(n, n);
    std::vector<double>              root(n);
    for (unsigned int k = 0; k < n; ++k)
      root[k] = std::sqrt(structure.mass[k / 3][4 * (k % 3)]);
    for (unsigned int k = 0; k < n; ++k)
    {
      Unknowns unit(n, 0.), column;
      unit[k] = 1.;
      structure.multiply_stiffness(unit, column);
      for (unsigned int i = 0; i < n; ++i)
        A(i, k) = column[i] / (root[i] * root[k]);
    }
    dealii::Vector<double>     values(n);
    dealii::FullMatrix<double> vectors(n, n), C(n, n);
    A.compute_eigenvalues_symmetric(-1., 1e300, 1e-9, values, vectors);
    for (unsigned int m = 0; m < n; ++m)
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int k = 0; k < n; ++k)
          C(i, k) += 2. * ratio * std::sqrt(values[m]) * vectors(i, m) * vectors(k, m) * root[i] * root[k];
    return C;
  }

  void test_joint()
  {
    Material soft;
    soft.young = 2.4e7;
    soft.poisson = 0.;
    const SolidModel model(blocks(2, false), 1);
    Structure        structure = with_joints(model, {soft});
    const Vector3    n = structure.pairs[0].frame[0];
    const auto       at = [&](const double t)
    {
      Unknowns load(3 * structure.n_nodes());
      for (unsigned int i = 0; i < structure.n_nodes(); ++i)
        for (unsigned int c = 0; c < 3; ++c)
          load[3 * i + c] = (structure.body_of(i) == 0 ? -1. : 1.) * structure.mass[i][0] * 30. *
                            std::sin(two_pi * 24. * t) * n[c];
      return load;
    };
    const auto opening_of =
        [&](const Damping &damping, const unsigned int n_implicit, const unsigned int n_explicit)
    {
      structure.damping = damping;
      const JointLaws laws = make_laws(structure, "FJA", 0.);
      const double    end = .4;
      const Unknowns  none(3 * structure.pairs.size(), 0.), zero(3 * structure.n_nodes(), 0.);
      Newmark         newmark(structure, laws, tight(), end / n_implicit, ImpactRule::mean_force);
      Explicit        leapfrog(structure, end / n_explicit);
      newmark.start(zero, zero, none, zero, none);
      double difference = 0., most = 0.;
      for (unsigned int i = 1; i <= n_implicit; ++i)
      {
        newmark.advance(at(i * end / n_implicit));
        for (unsigned int k = 0; k < n_explicit / n_implicit; ++k)
          leapfrog.advance(at(((i - 1) * (n_explicit / n_implicit) + k) * end / n_explicit));
        for (unsigned int p = 0; p < structure.pairs.size(); ++p)
        {
          const double a = newmark.opening_and_slip(p)[0],
                       b = structure.jump(structure.pairs[p], leapfrog.u)[0];
          difference = std::max(difference, std::abs(a - b));
          most = std::max(most, b);
        }
      }
      below("blocks with a joint: error of the energy balance", newmark.energy_error(), 1e-10);
      return std::make_pair(difference / most, most);
    };
    const Damping law = uniform(.1, 2., 200., 20.);
    structure.damping = law; // the explicit scheme of the program has the same steps as that of this file
    const JointLaws laws = make_laws(structure, "FJA", 0.);
    const Unknowns  none(3 * structure.pairs.size(), 0.), zero(3 * structure.n_nodes(), 0.);
    Leapfrog        ours(structure, laws, 1e-3, 100);
    Explicit        theirs(structure, 1e-5);
    ours.start(zero, zero, none, zero, none);
    for (unsigned int i = 0; i < 100; ++i)
    {
      ours.advance(at((i + 1) * 1e-3));
      const Unknowns before = at(i * 1e-3), after = at((i + 1) * 1e-3);
      Unknowns       load = before;
      for (unsigned int k = 0; k < 100; ++k)
      {
        for (std::size_t j = 0; j < load.size(); ++j)
          load[j] = (1. - .01 * k) * before[j] + .01 * k * after[j];
        theirs.advance(load);
      }
    }
    double off = 0.;
    for (std::size_t k = 0; k < zero.size(); ++k)
      off = std::max(off, std::abs(ours.state().u[k] - theirs.u[k]));
    below("blocks with a joint, leapfrog: displacements against the scheme of this test",
          off / largest(theirs.u), 1e-10);
    below("blocks with a joint, leapfrog: error of the energy balance", ours.energy_error(), 1e-12);
    const auto fine = opening_of(law, 8000, 32000);
    below("blocks with a joint, uniform damping: openings against an explicit scheme", fine.first, 1e-4);
    above("blocks with a joint, uniform damping: openings change by damping",
          std::abs(fine.second / opening_of(Damping(), 8000, 32000).second - 1.), .02);

    // All modes of both blocks with 5 %, and a modulus that does not depend on the frequency. The modulus of the
    // uniform damping changes by 4.4 % from 20 to 40 Hz: the openings must agree within what this change makes.
    const unsigned int n_steps = 8000;
    const auto         largest_opening = [&](const double modulus, const bool is_dense)
    {
      structure.damping = is_dense ? Damping() : uniform(.05, 2., 200., 20.);
      structure.damping.modulus *= modulus;
      Explicit run(structure, .4 / n_steps);
      if (is_dense)
        run.dense = damping_of_all_modes(structure, .05);
      double result = 0.;
      for (unsigned int i = 0; i < n_steps; ++i)
      {
        run.advance(at(i * .4 / n_steps));
        for (const Pair &pair : structure.pairs)
          result = std::max(result, structure.jump(pair, run.u)[0]);
      }
      return result;
    };
    const double dense = largest_opening(1., true);
    note("blocks with a joint, 5 %: largest opening over that with C = 2 z M sqrt(M^-1 K)",
         largest_opening(1., false) / dense);
    between("  with the modulus of 10 Hz", largest_opening(1. / 1.044, false) / dense, 1., 1.2);
    between("  with the modulus of 40 Hz", largest_opening(1.044, false) / dense, .8, 1.);
  }
} // namespace

int main()
{
  return run_all({test_fit, test_decay, test_joint});
}
