// SPDX-License-Identifier: GPL-3.0-or-later
// Products with the rock's stiffness: from the cells, by every kernel that the processor can run, against the
// matrix.

#include <voussoir/rock/sections.h>

#include "box.h"

#include <cstdlib>
#include <cstring>
#include <random>

#ifdef _OPENMP
#include <omp.h>
#endif

namespace
{
  using namespace Voussoir;
  using namespace Boxes;
  using namespace Testing;

  const std::vector<std::string> open_box = {"x-", "x+", "y-", "y+", "z-"};

  /** Bent cells of three rocks whose stiffness differs a hundredfold; far from the origin. */
  HexMesh bent(const std::array<unsigned int, 3> &n)
  {
    std::mt19937 engine(11);
    HexMesh      mesh = box(n, open_box,
                            [&](const double i, const double j, const double k) -> Vector3
                            {
                         Vector3 x = {{300. + i, j - 200., 2. * k}};
                         for (double &c : x)
                           c += .2 * (engine() / 2147483647.5 - 1.);
                         return x;
                       });
    for (std::size_t k = 0; k < mesh.cells.size(); ++k)
      mesh.cells[k].volume = rock + k % 7 % 3;
    return mesh;
  }

  RockParameters parameters()
  {
    RockParameters p;
    p.nodal_everywhere = true;
    p.materials[rock] = unit_rock();
    p.materials[rock + 1] = Material{.1, .1, 5.};
    p.materials[rock + 2] = Material{10., .4, 2.};
    return p;
  }

  Unknowns rough(const std::size_t n)
  {
    std::mt19937 engine(3);
    Unknowns     x(n);
    for (double &value : x)
      value = engine() / 2147483647.5 - 1.;
    return x;
  }

  Unknowns product(const RockOperator &K, const Unknowns &x)
  {
    Unknowns y(x.size(), 1e300); // each is to be set
    K.multiply(x.data(), y.data());
    return y;
  }

  double difference(const Unknowns &a, const Unknowns &b)
  {
    double largest = 0., size = 0.;
    for (std::size_t i = 0; i < a.size(); ++i)
    {
      largest = std::max(largest, std::abs(a[i] - b[i]));
      size = std::max(size, std::abs(b[i]));
    }
    return largest / size;
  }

  bool is_same(const Unknowns &a, const Unknowns &b)
  {
    return std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
  }

  /** Every kernel against the matrix. @p share: of nodes that keep their rows, at least and at most. */
  void compare(const std::string &name, const RockModel &model, const double least, const double most)
  {
    const Unknowns x = rough(3 * model.points.size());
    Unknowns       y(x);
    model.stiffness.multiply(x.data(), y.data());
    for (const char *kernel : nodal_kernels())
    {
      const RockOperator K = make_operator(model, nodal_kernel(kernel));
      expect(K.n_rows() == model.points.size(), "a row for each node");
      const bool all = nodal_kernel(kernel) == nullptr; // "matrix"
      between(name + ", " + kernel + ": rows of the matrix / nodes", double(K.n_matrix_rows()) / K.n_rows(),
              all ? 1. : least, all ? 1. : most);
      below("  product against the matrix", difference(product(K, x), y), 1e-13);
    }
  }

  /** Nodal everywhere, in layers around Gauss points, and in tied layers, whose nodes stand for several. */
  void products()
  {
    const HexMesh   mesh = bent({17, 13, 11});
    const RockModel model = make_rock_model(mesh, parameters());
    compare("bent cells", model, 0., 0.);
    below("  memory over that of the matrix",
          double(make_operator(model, nodal_kernel("plain")).memory()) / (76. * model.stiffness.value.size()),
          .2);
    compare("less than a pack", make_rock_model(bent({1, 3, 1}), parameters()), 0., 0.);
    RockParameters p = parameters();
    p.nodal_everywhere = false;
    p.nodal_layers = 3;
    compare("Gauss points inside", make_rock_model(mesh, p), .2, .5);
    p.nodal_layers = 0;
    compare("Gauss points everywhere", make_rock_model(mesh, p), 1., 1.);
    const HexMesh layer = box({9, 1, 7}, {"x-", "x+", "z-"},
                              [](const double i, const double j, const double k) -> Vector3 {
                                return {{i, j, k}};
                              });
    compare("tied layer", make_rock_model(layer, parameters(), tie_layer(layer, 1)), 1., 1.);
  }

  /** Differences of displacements alone count: no force without them. */
  void translation()
  {
    const RockModel model = make_rock_model(bent({17, 13, 11}), parameters());
    for (const char *kernel : nodal_kernels())
      if (const NodalKernel cells = nodal_kernel(kernel)) // the matrix has round-off
        for (const double f :
             product(make_operator(model, cells), Unknowns(3 * model.points.size(), 1.234567)))
          expect(f == 0., std::string(kernel) + ": force of a translation");
  }

  /** The same bits from any number of threads, and each time. */
  void threads()
  {
#ifdef _OPENMP
    const int      before = omp_get_max_threads();
    RockParameters p = parameters();
    for (const bool everywhere : {true, false})
    {
      p.nodal_everywhere = everywhere;
      p.nodal_layers = 3;
      const RockModel model = make_rock_model(bent({17, 19, 23}), p);
      const Unknowns  x = rough(3 * model.points.size());
      for (const char *kernel : nodal_kernels())
      {
        const RockOperator K = make_operator(model, nodal_kernel(kernel));
        omp_set_num_threads(1);
        const Unknowns one = product(K, x);
        for (const int n : {2, 3, 1})
          for (unsigned int time = 0; time < 5; ++time)
          {
            omp_set_num_threads(n);
            expect(is_same(one, product(K, x)),
                   std::string(kernel) + " with " + std::to_string(n) + " threads");
          }
      }
      omp_set_num_threads(before);
    }
#endif
  }

  /** VOUSSOIR_KERNEL names the kernel of all products; the default is the fastest. */
  void choice()
  {
    const RockModel model = make_rock_model(bent({17, 13, 11}), parameters());
    const Unknowns  x = rough(3 * model.points.size());
    expect(std::string(nodal_kernels().back()) == "plain", "the last kernel is for any processor");
    for (const char *kernel : nodal_kernels())
    {
      const Unknowns wanted = product(make_operator(model, nodal_kernel(kernel)), x);
      setenv("VOUSSOIR_KERNEL", kernel, 1);
      expect(is_same(wanted, product(make_operator(model), x)), std::string(kernel) + " is used");
      unsetenv("VOUSSOIR_KERNEL");
    }
    expect(nodal_kernel() == nodal_kernel(nodal_kernels().front()), "the fastest is used");
    throws<InputError>("a kernel that there is not", [] { nodal_kernel("abacus"); },
                       {"abacus", "VOUSSOIR_KERNEL", "plain"});
  }
} // namespace

int main(int argc, char **argv)
{
  return run({{"products", products}, {"translation", translation}, {"threads", threads}, {"choice", choice}},
             argc, argv);
}
