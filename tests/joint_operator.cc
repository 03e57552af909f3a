// SPDX-License-Identifier: GPL-3.0-or-later
// The operator of the joints in blocks: Gauss-Seidel iterations against the same in double precision, and the
// linear systems of Newton's method.

#include "testing.h"

#include <voussoir/contact/contact_solver.h>
#include <voussoir/contact/law_table.h>
#include <voussoir/joints/joint_jacobian.h>

#include <random>

using namespace Voussoir;
using namespace Testing;

namespace
{
  constexpr double flexibility = 1e-9; // [m/N]

  /** Joints between five bodies in a row, the first and last of which stand against the ground. Each body
   * adds a positive definite flexibility of the joints on both of its sides.
   * @param compact couplings of two bytes */
  InterfaceOperator row_of_bodies(const bool compact = false)
  {
    const std::vector<unsigned int>        n_pairs = {7, 9, 5, 8};
    std::mt19937                           random(11);
    std::uniform_real_distribution<double> number(-1., 1.);
    InterfaceOperator                      W(n_pairs);
    for (unsigned int body = 0; body <= n_pairs.size(); ++body)
    {
      std::vector<std::pair<unsigned int, unsigned int>> unknowns; // joint, row
      for (unsigned int j = std::max(body, 1u) - 1; j <= body && j < n_pairs.size(); ++j)
        for (unsigned int i = 0; i < W.size(j); ++i)
          unknowns.push_back({j, i});
      const std::size_t                m = unknowns.size();
      std::vector<std::vector<double>> modes(6,
                                             std::vector<double>(m)); // by which its joints feel each other
      for (auto &mode : modes)
        for (double &x : mode)
          x = .25 * number(random);
      for (std::size_t a = 0; a < m; ++a)
        for (std::size_t b = 0; b < m; ++b)
        {
          const auto &[j, row] = unknowns[a];
          const auto &[k, column] = unknowns[b];
          if (j > k)
            continue;
          double sum = a == b ? 1. : 0.;
          for (const auto &mode : modes)
            sum += mode[a] * mode[b];
          W.block(j, k)[std::size_t(column) * W.size(j) + row] += flexibility * sum;
        }
    }
    W.finish(nullptr, compact);
    return W;
  }

  Unknowns random_unknowns(const std::size_t n, const unsigned int seed, const double size)
  {
    std::mt19937                           random(seed);
    std::uniform_real_distribution<double> number(-size, size);
    Unknowns                               result(n);
    for (double &x : result)
      x = number(random);
    return result;
  }

  double distance(const Unknowns &a, const Unknowns &b)
  {
    double error = 0., size = 0.;
    for (std::size_t i = 0; i < a.size(); ++i)
    {
      error += (a[i] - b[i]) * (a[i] - b[i]);
      size += b[i] * b[i];
    }
    return std::sqrt(error / size);
  }

  /** A pair that opens, and slips without friction. */
  Vector3 frictionless(const unsigned int, const Matrix3 &H, const Vector3 &free)
  {
    return {{std::max(0., -free[0] / H[0]), 0., 0.}};
  }

  /** A bonded pair; every second pair also bears a shear force. */
  Vector3 bonded(const unsigned int pair, const Matrix3 &H, const Vector3 &free)
  {
    return {{-free[0] / H[0], pair % 2 == 0 ? -.5 * free[1] / H[4] : 0., 0.}};
  }

  /** A Gauss-Seidel iteration, entry by entry: joints of even number first (they do not touch), then the others;
   * the pairs of each in turn, three times over. */
  void sweep_exactly(const InterfaceOperator &W, const ContactOperator::PairSolver &solve_pair,
                     Unknowns &force, Unknowns &gap)
  {
    for (const unsigned int parity : {0u, 1u})
      for (unsigned int g = parity; g < W.n_groups(); g += 2)
        for (unsigned int pass = 0; pass < 3; ++pass)
          for (unsigned int pair = W.begin(g) / 3; pair < (W.begin(g) + W.size(g)) / 3; ++pair)
          {
            const Matrix3 H = W.diagonal(pair);
            Vector3       free = get(gap, pair);
            const Vector3 before = get(force, pair), Hf = H * before;
            for (unsigned int c = 0; c < 3; ++c)
              free[c] -= Hf[c];
            const Vector3 after = solve_pair(pair, H, free);
            Unknowns      change(W.n(), 0.), moved;
            for (unsigned int c = 0; c < 3; ++c)
              change[3 * pair + c] = after[c] - before[c];
            set(force, pair, after);
            W.multiply(change, moved);
            for (std::size_t i = 0; i < gap.size(); ++i)
              gap[i] += moved[i];
          }
  }

  /** Returns the largest absolute value in the block of 8 x 8 entries that contains an entry. */
  double largest_near(const Unknowns &A, const std::size_t m, const std::size_t row, const std::size_t column)
  {
    double result = 0.;
    for (std::size_t j = column / 8 * 8; j < std::min(column / 8 * 8 + 8, A.size() / m); ++j)
      for (std::size_t i = row / 8 * 8; i < std::min(row / 8 * 8 + 8, m); ++i)
        result = std::max(result, std::abs(A[j * m + i]));
    return result;
  }

  /** Entries and products of matrices whose sizes are no multiples of the blocks. */
  void check_matrix(const bool is_compact)
  {
    const std::string of = is_compact ? " of two bytes" : " of four bytes";
    double            rounding = 0., of_product = 0., of_plain = 0., units = 0.;
    for (const auto &[m, n] : {std::array<std::size_t, 2>{1, 1}, {8, 8}, {9, 16}, {16, 7}, {37, 29}, {3, 40}})
    {
      Unknowns A = random_unknowns(m * n, m + n, 1.);
      for (std::size_t i = 0; i < A.size(); ++i) // of different size; some blocks have zeros only
      {
        const std::size_t block = i % m / 8 + i / m / 8;
        A[i] *= block % 5 == 3 ? 0. : std::pow(10., -double(i % 5) - double(block));
      }
      const CompactMatrix compact(A, m, is_compact), in_mm(
                                                         [&]
                                                         {
                                                           Unknowns B = A;
                                                           for (double &b : B)
                                                             b *= 1e3;
                                                           return B;
                                                         }(),
                                                         m, is_compact);
      const std::vector<float> entries = compact.by_column();
      const Unknowns x = random_unknowns(std::max(m, n), 3, 1.), y = random_unknowns(std::max(m, n), 4, 1.);
      const std::vector<float> in(x.begin(), x.end());
      for (std::size_t j = 0; j < n; ++j)
        for (std::size_t i = 0; i < m; ++i)
        {
          const double size = std::max(1e-30, is_compact ? largest_near(A, m, i, j) : std::abs(A[j * m + i]));
          rounding = std::max(rounding, std::abs(compact(i, j) - A[j * m + i]) / size);
          units = std::max(units, std::abs(in_mm(i, j) / 1e3 - compact(i, j)) / size);
          if (entries[j * m + i] != compact(i, j))
            rounding = 1.;
        }
      for (const bool transposed : {false, true})
      {
        Unknowns exact = y;
        for (std::size_t j = 0; j < n; ++j)
          for (std::size_t i = 0; i < m; ++i)
            exact[transposed ? j : i] += double(compact(i, j)) * in[transposed ? i : j];
        std::vector<float> out(y.begin(), y.end()), plain = out;
        transposed ? compact.add_transposed(in.data(), out.data()) : compact.add(in.data(), out.data());
        transposed ? compact.add_transposed(in.data(), plain.data(), true)
                   : compact.add(in.data(), plain.data(), true);
        of_product = std::max(of_product, distance(Unknowns(out.begin(), out.end()), exact));
        of_plain = std::max(of_plain, distance(Unknowns(plain.begin(), plain.end()), exact));
      }
    }
    below("error of an entry" + of, rounding, 1.01 * std::ldexp(1., is_compact ? -16 : -23));
    below("difference in other units, entries" + of, units, 1e-6);
    below("error of products, entries" + of, of_product, 3e-7);
    below("error of products without AVX2, entries" + of, of_plain, 3e-7);
    report("empty matrix", CompactMatrix().memory(), "0",
           CompactMatrix().empty() && CompactMatrix({}, 0, is_compact).empty());
  }

  void test_compact()
  {
    check_matrix(true);
    check_matrix(false);
    float       y = 2.f;
    const float x = 3.f;
    CompactMatrix({0.}, 1, true).add(&x, &y);
    CompactMatrix({}, 8, true).add(&x, &y); // rows of another process
    report("zero and empty matrices add nothing", y, "2", y == 2.f);
    std::array<float, 2> z = {};
    for (const bool is_compact : {true, false})
      for (const double wrong : {std::nan(""), HUGE_VAL})
        for (const Unknowns &A : {Unknowns{1., wrong}, Unknowns{wrong, 1.}})
        {
          z = {};
          CompactMatrix(A, 1, is_compact).add_transposed(&x, z.data());
          report("a product with an entry that is not a number", z[1], "not a number", std::isnan(z[1]));
        }
  }

  /** Entry by entry. Sizes of joints are not multiples of the blocks of the kernels. */
  void test_product()
  {
    const InterfaceOperator W = row_of_bodies();
    const Unknowns          x = random_unknowns(W.n(), 7, 1e6);
    Unknowns                y, expected(W.n(), 0.);
    for (unsigned int j = 0; j < W.n_groups(); ++j)
      for (unsigned int k = 0; k < W.n_groups(); ++k)
        if (const std::vector<double> *block = W.find_block(std::min(j, k), std::max(j, k)))
          for (unsigned int r = 0; r < W.size(j); ++r)
            for (unsigned int c = 0; c < W.size(k); ++c)
              expected[W.begin(j) + r] +=
                  (*block)[j <= k ? c * W.size(j) + r : r * W.size(k) + c] * x[W.begin(k) + c];
    W.multiply(x, y);
    below("product of the operator, entry by entry", distance(y, expected), 1e-15);
  }

  void check_sweeps(const bool compact)
  {
    const InterfaceOperator W = row_of_bodies(compact);
    const std::string       of = std::string(compact ? "two" : "four") + " bytes, ";
    for (const auto &[name, solve_pair] :
         {std::pair<std::string, ContactOperator::PairSolver>{"open or closed", frictionless},
          {"bonded in part", bonded}})
    {
      const Unknowns b = random_unknowns(W.n(), 5, 1e-3);
      Unknowns       force = random_unknowns(W.n(), 6, 1e5), gap;
      W.multiply(force, gap);
      for (std::size_t i = 0; i < b.size(); ++i)
        gap[i] += b[i];
      Unknowns exact_force = force, exact_gap = gap;
      for (unsigned int sweep = 0; sweep < 2; ++sweep)
      {
        W.sweep(solve_pair, force, gap);
        sweep_exactly(W, solve_pair, exact_force, exact_gap);
      }
      below("Gauss-Seidel, " + of + name + ": forces", distance(force, exact_force), compact ? 3e-6 : 5e-7);
      below("Gauss-Seidel, " + of + name + ": gaps", distance(gap, exact_gap), compact ? 3e-6 : 5e-7);
    }
  }

  void test_sweeps()
  {
    check_sweeps(false);
    check_sweeps(true);
  }

  /** Of all kinds: open, stick, slip, of no special form. */
  std::vector<PairEquations> mixed_equations(const unsigned int n, const unsigned int first_kind)
  {
    const double               rho = .5 / flexibility;
    const Unknowns             residual = random_unknowns(3 * n, 9, 1e6);
    std::vector<PairEquations> result(n);
    for (unsigned int i = 0; i < n; ++i)
    {
      PairEquations     &e = result[i] = PairEquations();
      const unsigned int kind = (i + first_kind) % 5;
      e.residual = get(residual, i);
      if (kind == 0)
        e.d_force = {{1., 0., 0., 0., 1., 0., 0., 0., 1.}};
      else if (kind < 3)
        e.d_gap = {{rho, 0., 0., 0., rho, 0., 0., 0., rho}};
      else if (kind == 3)
      {
        e.d_gap = {{rho, 0., 0., .3 * rho, .4 * rho, -.1 * rho, .2 * rho, -.1 * rho, .2 * rho}};
        e.d_force = {{0., 0., 0., -.3, .6, .1, -.2, .1, .8}};
      }
      else
      {
        e.d_gap = {{rho, 0., 0., 0., 0., 0., 0., 0., 0.}};
        e.d_force = {{0., 0., 0., 0., 1., 0., -.4, 0., 1.}};
      }
    }
    return result;
  }

  /** |J step + residual| / |residual|, and |d_gap - W step| / |d_gap|. */
  void check_solution(const std::string &name, const InterfaceOperator &W,
                      const std::vector<PairEquations> &equations, const Unknowns &step,
                      const Unknowns &d_gap, const double gap_error)
  {
    Unknowns moved;
    W.multiply(step, moved);
    double error = 0., size = 0.;
    for (unsigned int i = 0; i < equations.size(); ++i)
    {
      const PairEquations &e = equations[i];
      const Vector3        f = e.d_force * get(step, i), g = e.d_gap * get(moved, i);
      for (unsigned int c = 0; c < 3; ++c)
      {
        error += std::pow(f[c] + g[c] + e.residual[c], 2);
        size += e.residual[c] * e.residual[c];
      }
    }
    below(name + ": residual of J step = -residual", std::sqrt(error / size), 3e-5);
    below(name + ": d_gap = W step", distance(d_gap, moved), gap_error);
  }

  void check_jacobian(const bool compact)
  {
    const InterfaceOperator W = row_of_bodies(compact);
    for (const bool far : {false, true})
    {
      JointJacobian jacobian(W);
      if (far)
        jacobian.expect_far_coupling();
      for (const unsigned int kind : {0u, 0u, 2u})
      {
        const std::string name = std::string(compact ? "two" : "four") + " bytes, " +
                                 (far ? "chain" : "joint by joint") + ", " + std::to_string(kind);
        const std::vector<PairEquations> equations = mixed_equations(W.n_pairs(), kind);
        jacobian.update(equations);
        Unknowns           step, d_gap;
        const unsigned int iterations = jacobian.solve(1e-5, step, d_gap);
        expect(iterations <= (far ? 2 : 12), name + ": " + std::to_string(iterations) + " iterations");
        check_solution(name, W, equations, step, d_gap, compact ? 3e-6 : 5e-7);
      }
    }
  }

  void test_jacobian()
  {
    check_jacobian(false);
    check_jacobian(true);
  }

  /** The first guess of a static state leaves small gaps, and Newton's method converges from it. */
  void test_guess()
  {
    const InterfaceOperator             W = row_of_bodies();
    const std::unique_ptr<JointLaw>     law = make_joint_law("FJA", LawParameters());
    const std::vector<const JointLaw *> laws(W.n_pairs(), law.get());
    Unknowns                            b = random_unknowns(W.n(), 5, 1e-4), gap;
    for (unsigned int i = 0; i < W.n_pairs(); ++i)
      b[3 * i] = i % 6 == 0 ? 1e-4 : -3e-4; // most pairs are pressed together
    ContactSolver solver(W, laws, ContactParameters());
    Unknowns      force(W.n(), 0.);
    solver.guess_bonded(b, force);
    W.multiply(force, gap);
    for (double &x : gap)
      x = -x;
    below("bonded pairs: gap that is left", distance(gap, b), 5e-3);
    const ContactResult result = solver.solve(b, Unknowns(W.n(), 0.), force, gap);
    expect(result.converged && result.path == ContactPath::newton, "Newton's method solves from the guess");
  }
} // namespace

int main(int argc, char **argv)
{
  return run({{"compact", test_compact},
              {"product", test_product},
              {"sweeps", test_sweeps},
              {"jacobian", test_jacobian},
              {"guess", test_guess}},
             argc, argv);
}
