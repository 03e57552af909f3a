// SPDX-License-Identifier: GPL-3.0-or-later
// The static solver of the rock: equilibrium; halving the mesh adds few iterations; coarse problems by CHOLMOD and ML.

#include <voussoir/foundation/rock_aggregates.h>
#include <voussoir/foundation/rock_static_state.h>
#include <voussoir/rock/rock_model.h>

#include "box.h"
#include "mesh_testing.h"

#include <cmath>
#include <iostream>

namespace
{
  using namespace Voussoir;
  using namespace MeshTesting;

  struct Solved
  {
    unsigned int iterations = 0, again = 0, rounds = 0;
    double       residual = 0., held = 0., middle = 0., part = 0.;
    double       share = 0.; ///< unknowns of the coarse problem over those of the rock [-]
  };

  /** Pushes the middle of the ground of 600 m x 600 m of rock, of n x n x n flat elements. All other sides are
   * held. @p thin: the elements in the middle are thin under the ground, and all elements have the dam's size.
   * @p flat: height of the elements over their width [-]; @p soft: Young's modulus of the
   * upper half over that of the lower one [-]. */
  Solved push(const unsigned int n, const bool thin = false, const MakeCoarseRock &solver = make_coarse_rock,
              const double flat = .5, const double soft = 1.)
  {
    const double h = 600. / n, height = 600. * flat;
    HexMesh      mesh =
        Boxes::box({n, n, n}, {"x-", "x+", "y-", "y+", "z-"},
                   [&](const double i, const double j, const double k)
                   {
                     const bool   sheets = thin && std::abs(i - .5 * n) < 1.5 && std::abs(j - .5 * n) < 1.5;
                     const double z = sheets ? height * (1. - std::pow(1. - k / n, 2)) : flat * h * k;
                     return Vector3{{h * i, h * j, z}};
                   });
    RockParameters parameters;
    parameters.nodal_everywhere = true;
    if (thin)
    {
      parameters.layers_at_dam = n;
      parameters.nodal_layers = 0;
      HexMesh::Face ground{{}, PhysicalId::base};
      for (unsigned int v = 0; v < 4; ++v)
        ground.nodes[v] = mesh.cells.back().nodes[hex_faces[1][v]];
      mesh.faces.push_back(ground);
    }
    parameters.materials[Boxes::rock] = Material{15e9, .25, 2700.};
    parameters.materials[Boxes::rock + 1] = Material{soft * 15e9, .25, 2700.};
    for (std::size_t c = mesh.cells.size() / 2; c < mesh.cells.size(); ++c)
      mesh.cells[c].volume = Boxes::rock + 1;
    const RockModel   model = make_rock_model(mesh, parameters);
    const std::size_t n_nodes = model.points.size();
    std::vector<bool> held(n_nodes, false);
    for (const BoundaryFace &face : model.faces)
      for (const unsigned int node : face.nodes)
        held[node] = true;
    Unknowns     b(3 * n_nodes, 0.), x, Kx(3 * n_nodes);
    unsigned int top = 0;
    for (unsigned int i = 0; i < n_nodes; ++i)
      if (const auto &p = model.points[i]; !held[i] && p[2] > height - .1)
      {
        const double weight = h * h * std::exp(-(std::pow(p[0] - 300., 2) + std::pow(p[1] - 300., 2)) / 1e4);
        b[3 * i] = 1e6 * weight;
        b[3 * i + 2] = -2e6 * weight;
        if (std::hypot(p[0] - 300., p[1] - 300.) < 1e-3)
          top = i;
      }
    Solved result;
    result.share = 2. * RockAggregates(model.stiffness, model.points, held, strong_coupling()).n() /
                   n_nodes; // 6 and 3 per node
    RockStatics statics(model, held, {}, solver);
    Log         log(true);
    result.iterations = statics.solve(b, x, log);
    model.stiffness.multiply(x.data(), Kx.data());
    double load = 0.;
    for (std::size_t k = 0; k < b.size(); ++k)
    {
      load += b[k] * b[k];
      if (held[k / 3])
        result.held = std::max(result.held, std::abs(x[k]));
      else
        result.residual += std::pow(b[k] - Kx[k], 2);
    }
    result.residual = std::sqrt(result.residual / load);
    result.middle = x[3 * top + 2];
    for (double &force : b)
      force *= -3.;
    result.again = statics.solve(b, x, log, 1e-9); // known
    for (std::size_t k = 0; k < b.size(); ++k)
      b[k] *= 1. + .1 * std::sin(double(k));
    const auto left = [&]
    {
      model.stiffness.multiply(x.data(), Kx.data());
      double sum = 0.;
      for (std::size_t k = 0; k < b.size(); ++k)
        sum += held[k / 3] ? 0. : std::pow(b[k] - Kx[k], 2);
      return std::sqrt(sum);
    };
    const double before = left();
    result.rounds = statics.solve(b, x, log, 1e-11, .01);
    result.part = left() / before;
    return result;
  }

  void halving()
  {
    const Solved coarse = push(12), fine = push(24);
    for (const Solved &solved : {coarse, fine})
    {
      expect(solved.residual < 2e-11, "equilibrium");
      expect(solved.held == 0., "held nodes");
      expect(solved.again == 0, "a load that is a multiple of the one before");
      expect(solved.part <= .01 && solved.part > 1e-5,
             "a hundredth of what the solution before leaves: " + std::to_string(solved.part));
      expect(solved.rounds > 0 && 2 * solved.rounds < solved.iterations,
             "in few iterations: " + std::to_string(solved.rounds));
    }
    expect(coarse.middle < -1e-4, "the ground gives way");
    expect_close(fine.middle, coarse.middle, .03, "displacement of the ground");
    expect(fine.iterations < 1.5 * coarse.iterations,
           "iterations when the mesh is halved: " + std::to_string(coarse.iterations) + ", " +
               std::to_string(fine.iterations));
    expect(fine.iterations < 30, "iterations"); // 19
    std::cout << "iterations: " << coarse.iterations << " on 12^3 elements, " << fine.iterations
              << " on 24^3\n";
  }

  /** A vertical force on a box of rock on springs: displacements of the half-space (Boussinesq), at a quarter of the width on
   * the ground and below the force, with elements of h [m]. Returns the larger error; with held sides for comparison. */
  double half_space(const bool is_held)
  {
    constexpr unsigned int n = 24;
    constexpr double       h = 25., nu = .25, young = 15e9, force = -1e9, G = young / (2. + 2. * nu),
                     r = n * h / 4.;
    RockParameters parameters;
    parameters.nodal_everywhere = true;
    parameters.materials[Boxes::rock] = Material{young, nu, 2700.};
    const RockModel   model = make_rock_model(Boxes::box({n, n, n / 2}, {"x-", "x+", "y-", "y+", "z-"},
                                                         [](const double i, const double j, const double k) {
                                                         return Vector3{{h * i, h * j, h * k}};
                                                       }),
                                              parameters);
    const Vector3     middle = {{n * h / 2., n * h / 2., n * h / 2.}};
    std::vector<bool> held(model.points.size(), false);
    for (const BoundaryFace &face : model.faces)
      for (const unsigned int node : face.nodes)
        held[node] = is_held;
    const auto at = [&](const double x, const double z)
    {
      unsigned int nearest = 0;
      for (unsigned int i = 0; i < model.points.size(); ++i)
        if (const Vector3 p = {{middle[0] + x, middle[1], middle[2] + z}};
            norm(model.points[i] - p) < norm(model.points[nearest] - p))
          nearest = i;
      return 3 * nearest + 2;
    };
    Unknowns b(3 * model.points.size(), 0.), u;
    b[at(0., 0.)] = force;
    Log log(true);
    RockStatics(model, held, is_held ? NodeSprings() : springs_of_far_rock(model, middle)).solve(b, u, log);
    const double on_ground = u[at(r, 0.)] / (force * (1. - nu) / (2. * M_PI * G * r)),
                 below = u[at(0., -r)] / (force * (3. - 2. * nu) / (4. * M_PI * G * r));
    std::cout << (is_held ? "held" : "springs") << ": displacement over that of the half-space " << on_ground
              << " on the ground, " << below << " below the force\n";
    return std::max(std::abs(on_ground - 1.), std::abs(below - 1.));
  }

  void far_rock()
  {
    const double springs = half_space(false), held = half_space(true);
    expect(springs < .06 && springs < .3 * held,
           "springs of the far rock: " + std::to_string(springs) + ", held: " + std::to_string(held));
  }

  /** The coarse solvers by CHOLMOD and by ML: both converge to the same displacement. */
  void coarse_solvers()
  {
    const Solved direct = push(12, false, make_direct_coarse_rock);
    expect(direct.residual < 2e-11, "equilibrium");
    // 16; 18 without Trilinos
    expect(direct.iterations < 23, "iterations with CHOLMOD: " + std::to_string(direct.iterations));
    std::cout << "iterations: " << direct.iterations << " with CHOLMOD\n";
#ifdef VOUSSOIR_WITH_TRILINOS
    const Solved multigrid = push(12, false, make_multigrid_coarse_rock);
    expect_close(direct.middle, multigrid.middle, 1e-9, "displacement of the ground with CHOLMOD and ML");
    std::cout << "iterations: " << multigrid.iterations << " with ML\n";
#endif
  }

  /** Flat elements: nodes above one another are strongly coupled, nodes of one layer weakly. Half of the rock may be
   * soft. */
  void flat_elements()
  {
#ifdef VOUSSOIR_WITH_TRILINOS
    constexpr unsigned int most = 45; // 39
#else
    constexpr unsigned int most = 55; // 51: nodes of one layer count as strongly coupled, too
#endif
    for (const double soft : {1., .01})
    {
      const Solved direct = push(16, false, make_direct_coarse_rock, .15, soft),
                   usual = push(16, false, make_coarse_rock, .15, soft);
      expect(std::max(direct.residual, usual.residual) < 2e-11, "equilibrium");
      // 0.12; 0.55 if groups contain strongly coupled nodes only
      expect(direct.share < .2, "unknowns of the coarse problem: " + std::to_string(direct.share));
      std::cout << "iterations: " << direct.iterations << " with flat elements and CHOLMOD, "
                << usual.iterations << " with the usual solver; coarse unknowns " << direct.share << '\n';
      for (const unsigned int n : {direct.iterations, usual.iterations})
        expect(n < most, "iterations with flat elements: " + std::to_string(n));
    }
  }

  /** Elements with large eigenvalues. */
  void sheets()
  {
    const Solved solved = push(16, true);
    expect(solved.residual < 2e-11, "equilibrium");
    std::cout << "iterations: " << solved.iterations << " with sheets\n";
    expect(solved.iterations < 80, "iterations"); // 51
  }
} // namespace

int main()
{
  return run({{"halving the mesh", halving},
              {"far rock", far_rock},
              {"coarse solvers", coarse_solvers},
              {"flat elements", flat_elements},
              {"sheets", sheets}});
}
