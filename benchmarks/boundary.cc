// The artificial boundary against extended meshes and analytic solutions: the rows of doc/boundary.md.
// Usage: benchmark_boundary [speed|halfspace|canyon|lamb|hemisphere]...; all without an argument.
// A = must, M = wish.

#include "../tests/box.h"

#include <voussoir/log.h>

#include <complex>
#include <cstdio>
#include <map>

namespace
{
  using namespace Boxes;
  using Complex = std::complex<double>;

  const double c_p = std::sqrt(3.), c_s = 1.; // Poisson's ratio 0.25

  RockRegionParameters parameters(const std::string &boundary, const double dt)
  {
    RockRegionParameters p;
    p.rock.materials[rock] = unit_rock();
    p.rock.nodal_everywhere = true;
    p.boundary = boundary;
    p.free_field = "columns";
    p.dt = dt;
    return p;
  }

  TransmittingFormula formula(const std::vector<double> &speeds, const double gamma_speed)
  {
    TransmittingFormula f;
    f.uniform_distance = true;
    for (const double c : speeds)
      f.factors.push_back({0., c, 0., gamma_speed});
    return f;
  }

  /** A box with the same rock; seconds of its step and of the bare product. */
  void speed()
  {
    constexpr unsigned int n = 46;
    const HexMesh          mesh = box({n, n, n}, {"x-", "x+", "y-", "y+", "z-"},
                                      [](const double i, const double j, const double k) -> Vector3 {
                               return {{i, j, k}};
                             });
    std::printf("\nSpeed: box of %u x %u x %u cells, %u nodes\n", n, n, n, (n + 1) * (n + 1) * (n + 1));
    std::printf("%-44s %12s %12s %8s\n", "", "product [ms]", "step [ms]", "ratio");
    for (const bool nodal : {false, true})
      for (const std::string kind : {"mtf2", "mtf3", "viscous-spring"})
      {
        auto p = parameters(kind, .3);
        p.rock.nodal_everywhere = nodal;
        p.rock.centre = {{.5 * n, .5 * n, double(n)}};
        p.damping = {.001, .02};
        const RockModel model = make_rock_model(mesh, p.rock);
        auto            region = make_region(model, p);
        shake(
            *region, mesh, model, p,
            [](const double t) -> Vector3 {
              return {{ricker(t, .05, 30.), 0., 0.}};
            },
            1000);
        region->keep_energy();
        Unknowns               x(3 * model.points.size(), 1.), y(x);
        constexpr unsigned int repeat = 100;
        const Stopwatch        product;
        for (unsigned int i = 0; i < repeat; ++i)
          model.stiffness.multiply(x.data(), y.data());
        const double    t_product = product.seconds() / repeat;
        const Stopwatch step;
        for (unsigned int i = 0; i < repeat; ++i)
          region->advance();
        const double t_step = step.seconds() / repeat;
        std::printf("%-44s %12.2f %12.2f %8.2f\n",
                    (kind + (nodal ? ", nodal" : ", Gauss inside") + ", earthquake, energy").c_str(),
                    1e3 * t_product, 1e3 * t_step, t_step / t_product);
        std::fflush(stdout);
      }
  }

  /** Plane strain half-space in x and z, one layer of cells: nx by nz cells, the ground at z = 0. */
  struct Plane
  {
    HexMesh                         mesh;
    RockModel                       model;
    std::unique_ptr<ExplicitRegion> region;
    int                             nx, nz;

    Plane(const int nx, const int nz, RockRegionParameters p, const TransmittingFormula *f = nullptr)
        : nx(nx), nz(nz)
    {
      mesh = box({unsigned(nx), 1, unsigned(nz)}, {"x-", "x+", "z-"},
                 [=](const double i, const double j, const double k) -> Vector3 {
                   return {{i - nx / 2, j, k - nz}};
                 });
      model = make_rock_model(mesh, p.rock, tie_layer(mesh, 1));
      const bool spring = p.boundary == "viscous-spring"; // two-dimensional factors: 1 and 1/2
      if (spring)
        p.boundary = "fixed";
      region = spring ? std::make_unique<ExplicitRegion>(model.stiffness, model.mass, p.damping, p.dt)
                      : make_region(model, p, f);
      if (spring)
        region->set_boundary(viscous_boundary(model, p.rock.centre, 1., .5));
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
      Plane plane(nx, nz, parameters(row.boundary, dt), row.boundary == "mtf" ? &row.formula : nullptr);
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

  /** A regular grid with the cells about a circular or spherical canyon bent to it. Built cell by cell. */
  class CanyonMesh
  {
  public:
    HexMesh mesh;

    /** Half-space z < 0, cells of size @p h, the canyon of radius 1 about the origin. @p plane: x and z only,
     * one layer in y, -size < x < size; else the quarter x, y > 0. */
    CanyonMesh(const double h, const double size, const bool plane) : h(h), plane(plane)
    {
      block = h * std::round(1.6 / h);
      const int n = std::lround(size / h), b = std::lround(block / h);
      const int layers = std::max(1L, std::lround((block - 1.) / h * 1.2));
      for (int k = -n; k < 0; ++k)
        for (int j = 0; j < (plane ? 1 : n); ++j)
          for (int i = plane ? -n : 0; i < n; ++i)
          {
            const bool inside = k >= -b && (plane || j < b) && i >= -b && i < b;
            if (!inside)
            {
              add(
                  [&](const int di, const int dj, const int dk) {
                    return Vector3{{(i + di) * h, (j + dj) * h, (k + dk) * h}};
                  });
              artificial(i, j, k, n);
              continue;
            }
            if (i == b - 1)
              shell(layers, i + 1, j, k, 0, 1., true);
            if (plane && i == -b)
              shell(layers, i, j, k, 0, -1., false);
            if (!plane && j == b - 1)
              shell(layers, i, j + 1, k, 1, 1., false);
            if (k == -b)
              shell(layers, i, j, k, 2, -1., true);
          }
    }

  private:
    const double                                h;
    const bool                                  plane;
    double                                      block;
    std::map<std::array<long, 3>, unsigned int> number;

    unsigned int node(const Vector3 &p)
    {
      const std::array<long, 3> key = {std::lround(p[0] * 1e6), std::lround(p[1] * 1e6),
                                       std::lround(p[2] * 1e6)};
      const auto                found = number.try_emplace(key, mesh.nodes.size());
      if (found.second)
        mesh.nodes.push_back(p);
      return found.first->second;
    }

    void add(const std::function<Vector3(int, int, int)> &place)
    {
      HexMesh::Cell cell{{}, rock};
      for (unsigned int v = 0; v < 8; ++v)
        cell.nodes[v] = node(place(v % 4 == 1 || v % 4 == 2, v % 4 > 1, v > 3));
      if (min_jacobian(mesh, cell) < 0.)
        for (unsigned int v = 0; v < 4; ++v)
          std::swap(cell.nodes[v], cell.nodes[v + 4]);
      mesh.cells.push_back(cell);
    }

    void artificial(const int i, const int j, const int k, const int n)
    {
      const auto face = [&](const unsigned int row)
      {
        HexMesh::Face f{{}, PhysicalId::artificial};
        for (unsigned int v = 0; v < 4; ++v)
          f.nodes[v] = mesh.cells.back().nodes[hex_faces[row][v]];
        mesh.faces.push_back(f);
      };
      if (i == n - 1)
        face(3);
      if (plane && i == -n)
        face(5);
      if (!plane && j == n - 1)
        face(4);
      if (k == -n)
        face(0);
    }

    /** Between the point @p p on the block and the canyon, @p t = 0 at the canyon. Equal angles. */
    Vector3 between(const Vector3 &p, const double t) const
    {
      Vector3 q;
      double  norm = 0.;
      for (unsigned int d = 0; d < 3; ++d)
      {
        q[d] = plane && d == 1 ? 0. : std::tan(pi / 4. * p[d] / block);
        norm += q[d] * q[d];
      }
      for (unsigned int d = 0; d < 3; ++d)
        q[d] = plane && d == 1 ? p[d] : q[d] / std::sqrt(norm) * (1. - t) + p[d] * t;
      return q;
    }

    /** Cells between the canyon and one face of the block's surface, normal to @p axis. */
    void shell(const int layers, const int i, const int j, const int k, const unsigned int axis, double, bool)
    {
      for (int layer = 0; layer < layers; ++layer)
        add(
            [&](const int di, const int dj, const int dk)
            {
              const int     across = axis == 0 ? di : axis == 1 ? dj : dk;
              const Vector3 p = {{(i + (axis == 0 ? 0 : di)) * h, (j + (axis == 1 ? 0 : dj)) * h,
                                  (k + (axis == 2 ? 0 : dk)) * h}};
              return between(p, double(layer + across) / layers);
            });
    }
  };

  /** Amplitude at one frequency, sample by sample. */
  struct Spectrum
  {
    double               w;
    std::vector<Complex> sum;
    Complex              incident = 0.;
    void                 see(const double t, const std::vector<double> &values, const double wave)
    {
      const Complex phase = std::exp(Complex(0., -w * t));
      sum.resize(values.size());
      for (std::size_t i = 0; i < values.size(); ++i)
        sum[i] += phase * values[i];
      incident += phase * wave;
    }
  };

  struct CanyonRun
  {
    std::vector<std::array<double, 3>> place;
    std::vector<std::vector<double>>   amplitude; ///< by frequency and point, incident wave 1
  };

  /** Response of the ground (nodes chosen by @p wanted) to a vertical S wave along @p component. */
  CanyonRun canyon_run(const double h, const double size, const bool plane, const unsigned int component,
                       const std::string &boundary, const TransmittingFormula *given,
                       const std::vector<double>                                &etas,
                       const std::function<bool(const std::array<double, 3> &)> &wanted)
  {
    const CanyonMesh canyon(h, size, plane);
    auto             p = parameters(boundary, 1.);
    p.rock.nodal_everywhere = plane; // Gauss points where the cells are bent in three dimensions
    const auto      master = plane ? tie_layer(canyon.mesh, 1) : std::vector<unsigned int>();
    const RockModel model = make_rock_model(canyon.mesh, p.rock, master);
    p.dt = .9 * critical_time_step(largest_frequency(model.stiffness, model.mass), {});
    auto         region = make_region(model, p, given);
    const double f0 = .4, t0 = 3.5, end = 2. * size + 16. + t0;
    const auto   n_steps = static_cast<unsigned int>(end / p.dt);
    const auto   wave = [=](const double t) { return ricker(t, f0, t0); };
    shake(
        *region, canyon.mesh, model, p,
        [=](const double t) -> Vector3
        {
          Vector3 u{};
          u[component] = wave(t);
          return u;
        },
        n_steps, given);
    std::vector<unsigned int> fixed, nodes;
    CanyonRun                 result;
    for (unsigned int i = 0; i < model.points.size(); ++i)
    {
      const auto &x = model.points[i];
      if (!plane && std::abs(x[0]) < 1e-9) // S in x: antisymmetric about x = 0, symmetric about y = 0
        fixed.insert(fixed.end(), {3 * i + 1, 3 * i + 2});
      if (!plane && std::abs(x[1]) < 1e-9)
        fixed.push_back(3 * i + 1);
      const double r = std::sqrt(x[0] * x[0] + (plane ? 0. : x[1] * x[1]) + x[2] * x[2]);
      if ((std::abs(x[2]) < 1e-9 || std::abs(r - 1.) < 1e-9) && wanted(x))
      {
        nodes.push_back(3 * i + component);
        result.place.push_back(x);
      }
    }
    region->fix(fixed);
    std::vector<Spectrum> spectra;
    for (const double eta : etas)
      spectra.push_back({pi * eta * c_s, {}, 0.}); // eta = 2 a / lambda
    std::vector<double> values(nodes.size());
    for (unsigned int step = 1; step <= n_steps; ++step)
    {
      region->advance();
      for (std::size_t i = 0; i < nodes.size(); ++i)
        values[i] = region->displacement()[nodes[i]];
      for (Spectrum &s : spectra)
        s.see(step * p.dt, values, wave(step * p.dt));
    }
    for (const Spectrum &s : spectra)
    {
      result.amplitude.emplace_back();
      for (const Complex &sum : s.sum)
        result.amplitude.back().push_back(std::abs(sum / s.incident));
    }
    return result;
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

  void canyon()
  {
    std::printf(
        "\nSemicircular canyon, vertical SH, amplitudes of wall and ground, |x| < 2, rms error [%% of 2]\n");
    std::printf("%-38s %10s %10s %8s %8s\n", "box, cells, boundary", "eta 0.5", "eta 1", "A", "M");
    struct Row
    {
      double      size, h;
      std::string boundary, A, M;
    };
    for (const Row &row : std::vector<Row>{{2.4, .1, "viscous-spring", "", ""},
                                           {2.4, .1, "mtf2", "1", ""},
                                           {2.4, .1, "MTF2 (c_p, c_s), gamma = 0", "1", ""},
                                           {2.4, .1, "MTF2 (c_s, c_s), gamma = 0", "1", ""},
                                           {2.4, .1, "mtf3", "", ""},
                                           {4., .05, "mtf2", "", "0.2"},
                                           {4., .05, "MTF2 (c_p, c_s), gamma = 0", "", "0.2"},
                                           {4., .05, "MTF2 (c_s, c_s), gamma = 0", "", "0.2"},
                                           {4., .05, "mtf3", "", "0.2"}})
    {
      const bool                named = row.boundary.compare(0, 3, "MTF") != 0;
      const TransmittingFormula without =
          formula({row.boundary.find("c_p") == std::string::npos ? c_s : c_p, c_s}, 0.);
      const std::vector<double> etas = {.5, 1.};
      const auto                run =
          canyon_run(row.h, row.size, true, 1, named ? row.boundary : "mtf", named ? nullptr : &without, etas,
                     [](const std::array<double, 3> &x) { return std::abs(x[0]) < 2.01; });
      double error[2] = {0., 0.};
      for (unsigned int e = 0; e < 2; ++e)
      {
        for (std::size_t i = 0; i < run.place.size(); ++i)
          error[e] += std::pow(run.amplitude[e][i] - trifunac(etas[e], run.place[i][0], -run.place[i][2]), 2);
        error[e] = 100. * std::sqrt(error[e] / run.place.size()) / 2.;
      }
      char name[80];
      std::snprintf(name, sizeof(name), "%.1f a, a/%.0f, %s", row.size, 1. / row.h, row.boundary.c_str());
      std::printf("%-38s %10.3f %10.3f %8s %8s\n", name, error[0], error[1], row.A.c_str(), row.M.c_str());
      std::fflush(stdout);
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

  /** Cubic in the table's column, not across the canyon's edge. */
  double hemisphere_value(const unsigned int column, const double r)
  {
    const int low = r < 1. - 1e-9 ? 0 : 10, high = r < 1. + 1e-9 && low == 0 ? 10 : 20;
    const int first = std::min(std::max(static_cast<int>(r * 10.) - 1, low), high - 3);
    double    value = 0.;
    for (int i = first; i < first + 4; ++i)
    {
      double weight = 1.;
      for (int j = first; j < first + 4; ++j)
        if (j != i)
          weight *= (10. * r - j) / (i - j);
      value += weight * hemisphere_table[i][column];
    }
    return value;
  }

  void hemisphere()
  {
    std::printf("\nHemispherical canyon, vertical S along x, box 3 a, |u_x| on both axes, r < 2 a, rms error "
                "[%% of 2]\n");
    std::printf("%-38s %10s %10s %8s %8s\n", "cells, boundary", "eta 0.5", "eta 1", "A", "M");
    for (const auto &[boundary, h] : std::vector<std::pair<std::string, double>>{
             {"viscous-spring", .1}, {"mtf2", .1}, {"mtf3", .1}, {"mtf3", 1. / 15.}})
    {
      const std::vector<double> etas = {.5, 1.};
      const auto                run =
          canyon_run(h, 3., false, 0, boundary, nullptr, etas,
                     [](const std::array<double, 3> &x)
                     {
                       return (std::abs(x[0]) < 1e-9 || std::abs(x[1]) < 1e-9) &&
                              std::hypot(x[0], x[1]) < 2. &&
                              (std::hypot(x[0], x[1]) < .9 || std::hypot(x[0], x[1]) > 1. - 1e-9);
                     });
      double error[2] = {0., 0.};
      for (unsigned int e = 0; e < 2; ++e)
      {
        for (std::size_t i = 0; i < run.place.size(); ++i)
        {
          const auto        &x = run.place[i];
          const unsigned int column = 2 * e + (std::abs(x[1]) < 1e-9 ? 0 : 1);
          error[e] += std::pow(run.amplitude[e][i] - hemisphere_value(column, std::hypot(x[0], x[1])), 2);
        }
        error[e] = 100. * std::sqrt(error[e] / run.place.size()) / 2.;
      }
      std::printf("%-38s %10.3f %10.3f %8s %8s\n",
                  ("a/" + std::to_string(std::lround(1. / h)) + ", " + boundary).c_str(), error[0], error[1],
                  "4", "1.5");
      std::fflush(stdout);
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
  const std::vector<std::pair<std::string, void (*)()>> all = {{"speed", speed},
                                                               {"halfspace",
                                                                []
                                                                {
                                                                  halfspace(1. / 20.);
                                                                  halfspace(1. / 10.);
                                                                }},
                                                               {"canyon", canyon},
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
