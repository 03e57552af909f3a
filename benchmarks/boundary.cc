// SPDX-License-Identifier: GPL-3.0-or-later
// The artificial boundary against extended meshes and analytic solutions: the rows of doc/boundary.md.
// Usage: benchmark_boundary [products|speed|halfspace|canyon|psv|lamb|hemisphere]...; all without an
// argument. A = must, M = wish.

#include "boundary_canyon.h"

#include <voussoir/base/log.h>

#include <cstdio>

#ifdef _OPENMP
#include <omp.h>
#endif

namespace
{
  using namespace Benchmarks;

  double median(std::vector<double> values)
  {
    std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
    return values[values.size() / 2];
  }

  /** Times of some actions, in short turns, one after the other [ms]: median and least. */
  struct Times
  {
    static constexpr unsigned int turns = 25, repeat = 4;

    explicit Times(const std::vector<std::function<void()>> &actions) : times(actions.size())
    {
      for (unsigned int turn = 0; turn < turns; ++turn)
        for (std::size_t k = 0; k < actions.size(); ++k)
          for (unsigned int i = 0; i < repeat; ++i)
          {
            const Stopwatch watch;
            actions[k]();
            times[k].push_back(1e3 * watch.seconds());
          }
    }

    double middle(const std::size_t k) const { return median(times[k]); }
    double least(const std::size_t k) const { return *std::min_element(times[k].begin(), times[k].end()); }

    std::vector<std::vector<double>> times;
  };

  /** With one thread, and with two where there are as many. */
  void with_threads(const std::function<void(int)> &action)
  {
#ifdef _OPENMP
    const int all_threads = omp_get_max_threads();
    for (int n = 1; n <= std::min(2, omp_get_num_procs()); ++n)
    {
      omp_set_num_threads(n);
      action(n);
    }
    omp_set_num_threads(all_threads);
#else
    action(1);
#endif
  }

  /** A box of cubes of the size of prm/rock28.prm. */
  constexpr unsigned int cells_of_speed = 46;

  HexMesh mesh_of_speed()
  {
    constexpr unsigned int n = cells_of_speed;
    return box({n, n, n}, {"x-", "x+", "y-", "y+", "z-"},
               [](const double i, const double j, const double k) -> Vector3 {
                 return {{i, j, k}};
               });
  }

  /** Products with the stiffness of nodal quadrature: each kernel against the matrix. */
  void products()
  {
    auto p = parameters("mtf3", .3);
    p.rock.nodal_everywhere = true;
    const RockModel model = make_rock_model(mesh_of_speed(), p.rock);
    Unknowns        x(3 * model.points.size(), 1.), y(x);
    std::printf("\nProducts: %zu nodes, nodal quadrature everywhere; matrix %.0f MB\n", model.points.size(),
                1e-6 * (sizeof(Matrix3) + sizeof(unsigned int)) * model.stiffness.value.size());
    std::printf("%-10s %8s %14s %14s %8s %8s %14s\n", "kernel", "threads", "matrix [ms]", "kernel [ms]",
                "ratio", "least", "kernel's MB");
    with_threads(
        [&](const int n_threads)
        {
          for (const char *name : nodal_kernels())
          {
            const RockOperator K = make_operator(model, nodal_kernel(name));
            const Times        t({[&] { model.stiffness.multiply(x.data(), y.data()); },
                                  [&] { K.multiply(x.data(), y.data()); }});
            std::printf("%-10s %8d %14.2f %14.2f %8.2f %8.2f %14.1f\n", name, n_threads, t.middle(0),
                        t.middle(1), t.middle(0) / t.middle(1), t.least(0) / t.least(1), 1e-6 * K.memory());
            std::fflush(stdout);
          }
        });
  }

  /** Step of a region against the bare product with the matrix of its stiffness: with one thread and with
   * two; and the ratio of the shortest turns, for busy machines. */
  void speed()
  {
    constexpr unsigned int n = cells_of_speed;
    const HexMesh          mesh = mesh_of_speed();
    std::printf("\nSpeed: box of %u x %u x %u cells, %u nodes, earthquake, damping\n", n, n, n,
                (n + 1) * (n + 1) * (n + 1));
    std::printf("%-46s %8s %8s %14s %12s %8s %4s %8s\n", "boundary, quadrature, free field", "threads",
                "energy", "product [ms]", "step [ms]", "ratio", "A", "least");
    struct Row
    {
      std::string boundary, free_field;
      bool        nodal;
    };
    for (const Row &row : std::vector<Row>{{"mtf2", "columns", false},
                                           {"mtf3", "columns", false},
                                           {"viscous-spring", "columns", false},
                                           {"mtf2", "columns", true},
                                           {"mtf3", "columns", true},
                                           {"viscous-spring", "columns", true},
                                           {"mtf3", "sections", true}})
      for (const bool energy : {false, true})
      {
        auto p = parameters(row.boundary, .3);
        p.rock.nodal_everywhere = row.nodal;
        p.rock.centre = {{.5 * n, .5 * n, double(n)}};
        p.damping = {.001, .02};
        p.free_field = row.free_field;
        const RockModel model = make_rock_model(mesh, p.rock);
        auto            region = make_region(model, p);
        shake(
            *region, model, p,
            [](const double t) -> Vector3 {
              return {{ricker(t, .05, 30.), 0., 0.}};
            },
            1000);
        if (energy)
          region->keep_energy();
        Unknowns x(3 * model.points.size(), 1.), y(x);
        with_threads(
            [&](const int n_threads)
            {
              const Times t(
                  {[&] { model.stiffness.multiply(x.data(), y.data()); }, [&] { region->advance(); }});
              std::printf(
                  "%-46s %8d %8s %14.2f %12.2f %8.2f %4s %8.2f\n",
                  (row.boundary + (row.nodal ? ", nodal, " : ", Gauss inside, ") + row.free_field).c_str(),
                  n_threads, energy ? "yes" : "no", t.middle(0), t.middle(1), t.middle(1) / t.middle(0),
                  "0.5", t.least(1) / t.least(0));
              std::fflush(stdout);
            });
      }
  }

  /** Plane strain half-space in x and z, one layer of cells: nx by nz cells, the ground at z = 0. */
  struct Plane
  {
    HexMesh                         mesh;
    RockModel                       model;
    std::unique_ptr<ExplicitRegion> region;
    int                             nx, nz;

    Plane(const int nx, const int nz, RockRegionParameters p) : nx(nx), nz(nz)
    {
      mesh = box({unsigned(nx), 1, unsigned(nz)}, {"x-", "x+", "z-"},
                 [=](const double i, const double j, const double k) -> Vector3 {
                   return {{i - nx / 2, j, k - nz}};
                 });
      model = make_rock_model(mesh, p.rock, tie_layer(mesh, 1));
      if (p.boundary == "viscous-spring")
        p.boundary_maker = plane_viscous_spring;
      region = make_region(model, p);
      region->keep_energy();
      region->force.assign(3 * model.points.size(), 0.);
    }
    unsigned int node(const int i, const int k) const ///< from the middle of the ground
    {
      return model.node[(k + nz) * 2 * (nx + 1) + i + nx / 2];
    }
  };

  /** @p f: dominant frequency of the force; 1/20 for S waves of 20 cells. */
  void halfspace(const double f)
  {
    constexpr int          nx = 120, nz = 60, margin = 230;
    constexpr double       dt = .35;
    constexpr unsigned int n_steps = 743; // t = 260
    std::printf("\nHalf-space, plane strain, 120 x 60 cells, Ricker force on a node of the ground, S waves "
                "of %.0f cells\n",
                1. / f);
    std::printf("%-38s %12s %8s %8s %14s\n", "boundary", "rel. L2 [%]", "A", "M", "residual KE");
    std::vector<std::vector<float>> reference(n_steps);
    const auto                      sample = [&](const Plane &plane, std::vector<float> &values)
    {
      values.clear();
      const Unknowns &u = plane.region->displacement();
      for (int k = -nz; k <= 0; k += 2)
        for (int i = -nx / 2; i <= nx / 2; i += 2)
          for (const int c : {0, 2})
            values.push_back(u[3 * plane.node(i, k) + c]);
    };
    const auto push = [&](Plane &plane)
    { plane.region->force[3 * plane.node(0, 0) + 2] = -ricker(plane.region->time(), f, 1.2 / f); };
    {
      Plane large(nx + 2 * margin, nz + margin, parameters("mtf4", dt));
      for (auto &values : reference)
      {
        push(large);
        large.region->advance();
        sample(large, values);
      }
    }
    struct Row
    {
      std::string         name, boundary, A, M;
      TransmittingFormula formula;
    };
    const double m = 1.35, R = .92;
    for (const Row &row :
         std::vector<Row>{{"viscous", "viscous", "", "", {}},
                          {"viscous-spring", "viscous-spring", "", "", {}},
                          {"MTF2 (c_p, c_s), gamma = 0", "mtf", "3.5", "", formula({c_p, c_s}, 0.)},
                          {"mtf2", "mtf2", "", "", {}},
                          {"mtf3", "mtf3", "", "", {}},
                          {"MTF3 (c_p, c_s, .92 c_s), gamma", "mtf", "", "0.6", formula({c_p, c_s, R}, m)},
                          {"mtf4", "mtf4", "", "0.2", {}}})
    {
      auto p = parameters(row.boundary, dt);
      if (row.boundary == "mtf")
        p.boundary_maker = maker(row.formula);
      Plane              plane(nx, nz, p);
      std::vector<float> values;
      double             square = 0., error = 0., largest = 0.;
      for (const auto &expected : reference)
      {
        push(plane);
        plane.region->advance();
        largest = std::max(largest, plane.region->energy().kinetic);
        sample(plane, values);
        for (std::size_t i = 0; i < values.size(); ++i)
        {
          error += std::pow(values[i] - expected[i], 2);
          square += std::pow(expected[i], 2);
        }
      }
      std::printf("%-38s %12.3f %8s %8s %14.1e\n", row.name.c_str(), 100. * std::sqrt(error / square),
                  row.A.c_str(), row.M.c_str(), plane.region->energy().kinetic / largest);
      std::fflush(stdout);
    }
  }

  /** Trifunac 1973, Bull. Seism. Soc. Am. 63(4): plane SH waves, vertical, semicircular canyon of radius 1.
   */
  double trifunac(const double eta, const double x, const double depth)
  {
    const double k = pi * eta, r = std::hypot(x, depth), angle = std::atan2(depth, x);
    const auto   J = [](const int n, const double z)
    { return n < 0 ? -std::cyl_bessel_j(1., z) : std::cyl_bessel_j(n, z); };
    const auto H = [&](const int n, const double z)
    { return Complex(J(n, z), n < 0 ? -std::cyl_neumann(1., z) : std::cyl_neumann(n, z)); };
    Complex w = 2. * std::cos(k * depth), power = 1.;
    for (int n = 0; n < k + 22; ++n, power *= Complex(0., 1.))
    {
      const Complex dJ = .5 * (J(n - 1, k) - J(n + 1, k)), dH = .5 * (H(n - 1, k) - H(n + 1, k));
      const double  angular = std::cos(n * (angle + pi / 2.)) + std::cos(n * (angle - pi / 2.));
      if (angular != 0.)
        w -= (n == 0 ? 1. : 2.) * power * dJ / dH * H(n, k * r) * angular;
    }
    return std::abs(w);
  }

  Amplitudes plane_canyon(const double h, const double size, const unsigned int component,
                          const std::string &boundary)
  {
    static const std::map<std::string, TransmittingFormula> formulas = {
        // the others have a name in scenes
        {"MTF2 (c_p, c_s), gamma = 0", formula({c_p, c_s}, 0.)},
        {"MTF2 (c_s, c_s), gamma = 0", formula({c_s, c_s}, 0.)}};
    Canyon     canyon{h, size, true, component, boundary};
    const auto given = formulas.find(boundary);
    if (given != formulas.end())
      canyon.maker = maker(given->second);
    return amplitudes(canyon, [](const Vector3 &x) { return x[0] < 2.01; });
  }

  void print_row(const double h, const double size, const std::string &boundary, const double error[2],
                 const std::string &A, const std::string &M)
  {
    char name[80];
    std::snprintf(name, sizeof(name), "%.3g a, a/%.0f, %s", size, 1. / h, boundary.c_str());
    std::printf("%-38s %10.3f %10.3f %8s %8s\n", name, error[0], error[1], A.c_str(), M.c_str());
    std::fflush(stdout);
  }

  struct CanyonRow
  {
    double      size, h;
    std::string boundary, A, M;
  };

  void canyon()
  {
    std::printf(
        "\nSemicircular canyon, vertical SH, amplitudes of wall and ground, |x| < 2, rms error [%% of 2]\n");
    std::printf("%-38s %10s %10s %8s %8s\n", "box, cells, boundary", "eta 0.5", "eta 1", "A", "M");
    for (const CanyonRow &row : std::vector<CanyonRow>{{2.4, .1, "viscous-spring", "", ""},
                                                       {2.4, .1, "mtf2", "1", ""},
                                                       {2.4, .1, "mtf2-plain", "1", ""},
                                                       {2.4, .1, "MTF2 (c_p, c_s), gamma = 0", "1", ""},
                                                       {2.4, .1, "MTF2 (c_s, c_s), gamma = 0", "1", ""},
                                                       {2.4, .1, "mtf3", "1", ""},
                                                       {4., .05, "mtf2", "", "0.2"},
                                                       {4., .05, "mtf2-plain", "", "0.2"},
                                                       {4., .05, "MTF2 (c_p, c_s), gamma = 0", "", "0.2"},
                                                       {4., .05, "MTF2 (c_s, c_s), gamma = 0", "", "0.2"},
                                                       {4., .05, "mtf3", "", "0.2"}})
    {
      const Amplitudes run = plane_canyon(row.h, row.size, 1, row.boundary);
      double           error[2] = {0., 0.};
      for (unsigned int e = 0; e < 2; ++e)
      {
        for (std::size_t i = 0; i < run.place.size(); ++i)
          error[e] += std::pow(run.value[e][i][1] - trifunac(etas[e], run.place[i][0], -run.place[i][2]), 2);
        error[e] = 100. * std::sqrt(error[e] / run.place.size()) / 2.;
      }
      print_row(row.h, row.size, row.boundary, error, row.A, row.M);
    }
  }

  /** In-plane waves. The reference is a box out of which nothing returns, so what is shown is the boundary's
   * error; that of the cells is shown apart. */
  void psv()
  {
    for (const unsigned int component : {0u, 2u})
    {
      std::printf(
          "\nSemicircular canyon, vertical %s, amplitudes of wall and ground, |x| < 2, rms difference "
          "of both components\nfrom the same cells in a box of %.3g a [%% of 2]\n",
          component == 2 ? "P" : "SV", extended);
      std::printf("%-38s %10s %10s %8s %8s\n", "box, cells, boundary", "eta 0.5", "eta 1", "A", "M");
      Amplitudes reference;
      double     error[2];
      for (const double h : {.1, .05})
      {
        reference = plane_canyon(h, extended, component, "mtf3");
        const bool fine = h < .1;
        for (const std::string boundary :
             {"viscous", "viscous-spring", "mtf2-plain", "MTF2 (c_p, c_s), gamma = 0", "mtf2", "mtf3"})
        {
          const double     size = fine ? 4. : 2.4;
          const Amplitudes run = plane_canyon(h, size, component, boundary);
          for (unsigned int e = 0; e < 2; ++e)
            error[e] = rms_difference(e, run, reference);
          print_row(h, size, boundary, error, fine ? "1.5" : "", fine ? "0.5" : "");
        }
      }
      const Amplitudes coarse = plane_canyon(.1, 6., component, "mtf3"),
                       middle = plane_canyon(.05, 6., component, "mtf3"),
                       fine = plane_canyon(.025, 6., component, "mtf3");
      for (unsigned int e = 0; e < 2; ++e)
        error[e] = rms_difference(e, middle, reference);
      print_row(.05, 6., "mtf3", error, "", "");
      std::printf("cells, differences in the box of 6 a, mtf3:\n");
      const auto cells = [&](const char *name, const Amplitudes &a, const Amplitudes &b)
      {
        for (unsigned int e = 0; e < 2; ++e)
          error[e] = rms_difference(e, a, b);
        std::printf("%-38s %10.3f %10.3f\n", name, error[0], error[1]);
      };
      cells("a/10 and a/40", coarse, fine);
      cells("a/20 and a/40", middle, fine);
      const Amplitudes small = plane_canyon(.05, 4., component, "mtf3");
      cells("mtf3, 4 a, a/20, and mtf3, 6 a, a/40", small, fine);
      std::printf("a/40, 6 a, mtf3: %10s %10s %10s %10s %10s\n", "x/a", "eta 0.5 |u_x|", "|u_z|",
                  "eta 1 |u_x|", "|u_z|");
      for (const double x : {0., 1., 1.6, 2.}) // bottom of the canyon, edge, ground
      {
        const Vector3 place = {{x, 0., x == 0. ? -1. : 0.}};
        std::printf("%28.1f %10.4f %10.4f %10.4f %10.4f\n", x, fine.at(0, place)[0], fine.at(0, place)[2],
                    fine.at(1, place)[0], fine.at(1, place)[2]);
      }
    }
  }

  /** Vertical S polarised along x, |u_x| at r/a = 0, 0.1, ... 2: eta 0.5 on the x and the y axis, eta 1 on
   * both. Frequency-domain spectral elements of order 10 (see doc/boundary.md), radius a = 1. */
  constexpr double hemisphere_table[21][4] = {
      {1.49877, 1.49877, 1.06579, 1.06579}, {1.47446, 1.47410, 1.11201, 1.10934},
      {1.40115, 1.39984, 1.24604, 1.23422}, {1.27802, 1.27566, 1.45211, 1.42229},
      {1.10559, 1.10282, 1.69885, 1.64054}, {0.89210, 0.89030, 1.93328, 1.83655},
      {0.67984, 0.67958, 2.07230, 1.93158}, {0.62979, 0.62217, 1.99116, 1.81089},
      {0.93988, 0.90593, 1.51353, 1.31514}, {1.55440, 1.46935, 0.58142, 0.44753},
      {2.74355, 2.23530, 2.85321, 2.23797}, {2.71880, 2.22793, 2.77943, 2.25637},
      {2.67751, 2.24966, 2.62190, 2.29609}, {2.63029, 2.27785, 2.42530, 2.32247},
      {2.58198, 2.30422, 2.21891, 2.32573}, {2.53392, 2.32540, 2.02426, 2.30457},
      {2.48617, 2.33986, 1.86104, 2.26122}, {2.43840, 2.34704, 1.74759, 2.20000},
      {2.39037, 2.34693, 1.69728, 2.12663}, {2.34202, 2.33972, 1.71263, 2.04769},
      {2.29352, 2.32583, 1.78356, 1.97034}};

  /** Rms over the table's places on both axes of what @p run differs there, in per cent of the flat ground's
   * 2. */
  double hemisphere_error(const unsigned int frequency, const Amplitudes &run)
  {
    double sum = 0.;
    for (unsigned int axis = 0; axis < 2; ++axis)
      for (unsigned int i = 0; i < 21; ++i)
        sum += std::pow(
            at_radius(run, frequency, 0, axis, .1 * i) - hemisphere_table[i][2 * frequency + axis], 2);
    return 100. * std::sqrt(sum / 42.) / 2.;
  }

  void hemisphere()
  {
    const auto axes = [](const double furthest)
    {
      return [furthest](const Vector3 &x)
      { return (std::abs(x[0]) < 1e-9 || std::abs(x[1]) < 1e-9) && std::hypot(x[0], x[1]) < furthest; };
    };
    std::printf(
        "\nHemispherical canyon, vertical S along x, |u_x| on both axes at r/a = 0, 0.1 ... 2, rms error "
        "[%% of 2]\n");
    std::printf("%-38s %10s %10s %8s %8s\n", "box, cells, boundary", "eta 0.5", "eta 1", "A", "M");
    for (const CanyonRow &row : std::vector<CanyonRow>{{3., .1, "viscous-spring", "4", "1.5"},
                                                       {3., .1, "mtf2", "4", "1.5"},
                                                       {3., .1, "mtf3", "4", "1.5"},
                                                       {3., 1. / 15., "mtf3", "4", "1.5"},
                                                       {6., .1, "mtf3", "", ""}})
    {
      const Amplitudes run = amplitudes({row.h, row.size, false, 0, row.boundary}, axes(2.35));
      const double     error[2] = {hemisphere_error(0, run), hemisphere_error(1, run)};
      print_row(row.h, row.size, row.boundary, error, row.A, row.M);
    }

    std::printf(
        "\nHemispherical canyon, vertical P, all components on both axes, r < 2 a, rms difference from "
        "the same cells\nin a box of 6 a with mtf3 [%% of 2]\n");
    std::printf("%-38s %10s %10s %8s %8s\n", "box, cells, boundary", "eta 0.5", "eta 1", "A", "M");
    const Amplitudes reference = amplitudes({.1, 6., false, 2, "mtf3"}, axes(2.));
    const auto       compare = [&](const CanyonRow &row)
    {
      const Amplitudes run = amplitudes({row.h, row.size, false, 2, row.boundary}, axes(2.));
      double           error[2];
      for (unsigned int e = 0; e < 2; ++e)
        error[e] = rms_difference(e, run, reference);
      print_row(row.h, row.size, row.boundary, error, row.A, row.M);
    };
    for (const std::string boundary : {"viscous-spring", "mtf2-plain", "mtf2", "mtf3"})
      compare({3., .1, boundary, "4", "1.5"});
    compare({4.5, .1, "mtf3", "", ""});
    for (const double r : {0., 1., 1.6})
    {
      const Vector3 place = {{r, 0., r == 0. ? -1. : 0.}};
      std::printf("6 a, r/a %.1f: |u_r|, |u_z| %8.4f %8.4f (eta 0.5) %8.4f %8.4f (eta 1)\n", r,
                  reference.at(0, place)[0], reference.at(0, place)[2], reference.at(1, place)[0],
                  reference.at(1, place)[2]);
    }
  }

  /** Integral over tau of Pekeris' displacement u_z mu r / P under a point load that is put on at once,
   * Poisson's ratio 1/4 (Pekeris 1955, Proc. Nat. Acad. Sci. 41). */
  double pekeris_integral(const double tau)
  {
    const double root = std::sqrt(3.), c = .75 + root / 4., d = .75 - root / 4.;
    const double a = std::sqrt(3. * root + 5.), b = std::sqrt(3. * root - 5.), first = 1. / root,
                 last = std::sqrt(c);
    const auto early = [&](const double t)
    {
      return (6. * t - root * std::acosh(2. * t) - a * std::asin(std::min(1., t / last)) +
              b * std::log(t + std::sqrt(std::max(0., t * t - d)))) /
             (32. * pi);
    };
    const auto middle = [&](const double t)
    { return (6. * t - a * std::asin(std::min(1., t / last))) / (16. * pi); };
    double sum = 0.;
    if (tau > first)
      sum += early(std::min(tau, 1.)) - early(first);
    if (tau > 1.)
      sum += middle(std::min(tau, last)) - middle(1.);
    if (tau > last)
      sum += 3. / (8. * pi) * (tau - last);
    return sum;
  }

  /** Displacement at the distance @p r under the load (1 - cos(pi t/T))/2. */
  double lamb_exact(const double r, const double t, const double T)
  {
    constexpr int n = 2000;
    const double  end = std::min(t, T);
    double        sum = 0.; // second derivative of the load times the integral of the step's response
    for (int i = 0; i < n; ++i)
    {
      const double s = end * (i + .5) / n;
      sum += .5 * std::pow(pi / T, 2) * std::cos(pi * s / T) * pekeris_integral((t - s) / r) * end / n;
    }
    return sum;
  }

  void lamb()
  {
    constexpr unsigned int n = 28, n_steps = 900;
    constexpr double       dt = .3, T = 20.;
    const std::vector<int> distance = {8, 12, 16, 20, 24};
    std::printf("\nLamb's problem: vertical force put on in 20 h/c_s, quarter box of 28^3 cells, u_z at r = "
                "8 .. 24 h\n");
    std::printf("%-38s %20s %20s\n", "boundary", "rel. L2 (t<150) [%]", "late / static");
    std::printf("%-38s %20s %20s\n", "A", "6", "0.90 - 1.10");
    std::printf("%-38s %20s %20s\n", "M", "2", "0.98 - 1.02");
    for (const std::string boundary : {"viscous", "viscous-spring", "mtf2", "mtf3", "mtf4"})
    {
      auto p = parameters(boundary, dt);
      p.rock.centre = {{0., 0., double(n)}};
      const HexMesh             mesh = box({n, n, n}, {"x+", "y+", "z-"},
                                           [](const double i, const double j, const double k) -> Vector3 {
                                 return {{i, j, k}};
                               });
      const RockModel           model = make_rock_model(mesh, p.rock);
      auto                      region = make_region(model, p);
      std::vector<unsigned int> fixed;
      for (unsigned int i = 0; i < model.points.size(); ++i)
        for (unsigned int c = 0; c < 2; ++c)
          if (model.points[i][c] == 0.)
            fixed.push_back(3 * i + c);
      region->fix(fixed);
      const unsigned int source = n * (n + 1) * (n + 1);
      region->force.assign(3 * model.points.size(), 0.);
      std::vector<double> error(5, 0.), square(5, 0.), late(5, 0.);
      for (unsigned int step = 1; step <= n_steps; ++step)
      {
        const double t = region->time();
        region->force[3 * source + 2] = -.25 * (t < T ? .5 * (1. - std::cos(pi * t / T)) : 1.);
        region->advance();
        for (unsigned int k = 0; k < 5; ++k)
        {
          const double u = -region->displacement()[3 * (source + distance[k]) + 2];
          if (region->time() < 150. && step % 5 == 0)
          {
            const double exact = lamb_exact(distance[k], region->time(), T);
            error[k] += std::pow(u - exact, 2);
            square[k] += exact * exact;
          }
          if (step + 50 > n_steps)
            late[k] += u / 50. / (3. / (8. * pi) / distance[k]);
        }
      }
      double least = 1e9, most = 0.;
      for (unsigned int k = 0; k < 5; ++k)
      {
        least = std::min(least, std::sqrt(error[k] / square[k]));
        most = std::max(most, std::sqrt(error[k] / square[k]));
      }
      char text[80], text2[80];
      std::snprintf(text, sizeof(text), "%.2f - %.2f", 100. * least, 100. * most);
      std::snprintf(text2, sizeof(text2), "%.3f - %.3f", *std::min_element(late.begin(), late.end()),
                    *std::max_element(late.begin(), late.end()));
      std::printf("%-38s %20s %20s\n", boundary.c_str(), text, text2);
      std::fflush(stdout);
    }
  }
} // namespace

int main(const int argc, char **argv)
{
  const std::vector<std::pair<std::string, void (*)()>> all = {{"products", products},
                                                               {"speed", speed},
                                                               {"halfspace",
                                                                []
                                                                {
                                                                  halfspace(1. / 20.);
                                                                  halfspace(1. / 10.);
                                                                }},
                                                               {"canyon", canyon},
                                                               {"psv", psv},
                                                               {"lamb", lamb},
                                                               {"hemisphere", hemisphere}};
  for (const auto &benchmark : all)
    if (argc == 1 || std::find(argv + 1, argv + argc, benchmark.first) != argv + argc)
    {
      const Stopwatch clock;
      benchmark.second();
      std::printf("(%.0f s)\n", clock.seconds());
    }
  return 0;
}
