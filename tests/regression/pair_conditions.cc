// SPDX-License-Identifier: GPL-3.0-or-later
// The equations of single conditions, with their derivatives, at an open, a sticking and a sliding pair; and
// exact solutions of one pair with friction.

#include <voussoir/contact/pair_conditions.h>

#include <cstdio>

using namespace Voussoir;

namespace
{
  void print(const char *name, const PairEquations &e)
  {
    std::printf("  %s: state %d, residual (%.9f, %.9f, %.9f)\n", name, int(e.state), e.residual[0],
                e.residual[1], e.residual[2]);
    for (unsigned int i = 0; i < 3; ++i)
      std::printf("    d force %.9f %.9f %.9f, d gap %.9f %.9f %.9f\n", e.d_force[3 * i],
                  e.d_force[3 * i + 1], e.d_force[3 * i + 2], e.d_gap[3 * i], e.d_gap[3 * i + 1],
                  e.d_gap[3 * i + 2]);
  }
} // namespace

int main()
{
  const double friction = .8, rho = 2.5;
  struct
  {
    const char *name;
    Vector3     force, gap;
  } const pairs[] = {{"open", {{0., 0., 0.}}, {{1.5, .2, -.3}}},
                     {"sticking", {{3., 1., -.5}}, {{0., .1, .2}}},
                     {"sliding", {{3., -2., 1.}}, {{0., 1.2, -.7}}},
                     {"penetrating", {{2., .4, .1}}, {{-.3, .2, .1}}}};
  for (const auto &pair : pairs)
  {
    std::printf("%s\n", pair.name);
    PairEquations e{};
    normal_condition(pair.force[0], pair.gap[0], rho, e);
    print("normal condition", e);
    e = PairEquations{};
    alart_curnier(pair.force, pair.gap[0], {{pair.gap[1], pair.gap[2]}}, friction, rho, e);
    print("Alart and Curnier", e);
  }
  const Matrix3 H = {{2., .3, -.2, .3, 1.5, .1, -.2, .1, 1.8}};
  for (const Vector3 &b : {Vector3{{1., .5, 0.}}, {{-3., .5, .2}}, {{-2., 4., -3.}}})
  {
    const Vector3 force = solve_coulomb(H, b, friction);
    std::printf("gap without force (%.3f, %.3f, %.3f): force %.9f %.9f %.9f\n", b[0], b[1], b[2], force[0],
                force[1], force[2]);
  }
}
