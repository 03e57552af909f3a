// SPDX-License-Identifier: GPL-3.0-or-later
// Dam and rock of one material, without joints: implicit dam on explicit rock (Foundation, as the program
// runs it) against a single body of the same elements that is implicit throughout, in the same box and in a
// larger domain. What pushes is a smooth pulse at the dam's top.

#include "rock_block.h"

namespace
{
  using namespace Voussoir;
  using namespace Blocks;
  using Columns::below;
  using Columns::between;

  void print(const std::string &text)
  {
    std::printf("%s\n", text.c_str());
  }

  /** The same box with a fixed boundary: what the partition does, and nothing else. */
  void partition()
  {
    for (const double stiffness_damping : {0., 1e-3})
    {
      print("Fixed box, partition - implicit run of the same step / peak; stiffness damping " +
            Columns::text(stiffness_damping) + " s");
      print("  dt [ms]        top   (ratio)      foot   (ratio)");
      double top = 0., foot = 0., top_ratio = 0., foot_ratio = 0.;
      Case   c;
      c.stiffness_damping = stiffness_damping;
      c.duration = .4;
      for (const double dt : {.002, .001, .0005})
      {
        c.dt = dt;
        const History one = implicit(box(5), c), two = partitioned(box(5), c);
        const double  top_now = difference(two.top, one.top), foot_now = difference(two.foot, one.foot);
        top_ratio = top / top_now;
        foot_ratio = foot / foot_now;
        top = top_now;
        foot = foot_now;
        std::printf("  %7.3f %10.2e %9.2f %10.2e %9.2f\n", 1e3 * dt, top, top_ratio, foot, foot_ratio);
      }
      // The explicit part takes the damping at the predicted velocity, which is of first order.
      const bool damped = stiffness_damping > 0.;
      between("  ratio of the last two, top", top_ratio, damped ? 1.9 : 3.7, damped ? 3. : 4.2);
      between("  ratio of the last two, foot", foot_ratio, damped ? 1.9 : 3.7, damped ? 3. : 4.2);
      below("  difference at the smallest step, top", top, damped ? 1e-3 : 2.5e-4);
      below("  difference at the smallest step, foot", foot, damped ? 2e-3 : 1e-3);
    }
  }

  /** A foot on which two monoliths stand. */
  void tied_joint()
  {
    Case c;
    c.stiffness_damping = 1e-4;
    const History whole = partitioned(box(5), c), cut = partitioned(box(5), c, true);
    below("dam of two monoliths with a tied joint: difference, top", difference(cut.top, whole.top), 1e-9);
    below("  foot", difference(cut.foot, whole.foot), 1e-9);
  }

  /** The reference of the next test is a quarter of the domain. */
  void symmetry()
  {
    Case c;
    c.dt = .002;
    for (const Vector3 direction : {Vector3{{1., 0., 0.}}, Vector3{{0., 0., 1.}}})
    {
      c.direction = direction;
      const History whole = implicit(box(4), c), part = implicit(quarter(4), c);
      below("implicit, a quarter of the box against the box: top", difference(part.top, whole.top), 1e-11);
      below("  foot", difference(part.foot, whole.foot), 1e-11);
    }
  }

  /** Small boxes with an artificial boundary against an implicit run of a domain from whose fixed boundary
   * nothing comes back: P waves take 0.31 s there and back. Beyond the small box its cells grow by 15 %, up
   * to 45 m; growth by 6 % changes the reference by less than 0.04 % (top) and 0.06 % (foot). */
  void larger_domain()
  {
    struct Row
    {
      std::string boundary;
      int         n;         ///< cells of rock beside and below the dam
      double      top, foot; ///< limits [%]
    };
    const std::vector<Row> rows[2] = {
        {{"viscous-spring", 8, 1.5, 5.}, {"mtf2", 8, .4, 1.5}, {"mtf3", 8, .2, 1.3}, {"mtf3", 12, .25, .5}},
        {{"viscous-spring", 8, 4.5, 8.5}, {"mtf2", 8, .7, 1.7}, {"mtf3", 8, .6, 1.3}, {"mtf3", 12, .4, .7}}};
    Case c;
    c.dt = .002;
    for (const bool is_vertical : {false, true})
    {
      c.direction = is_vertical ? Vector3{{0., 0., 1.}} : Vector3{{1., 0., 0.}};
      const History large = implicit(quarter(8, 1.15, 400.), c);
      print(std::string("Against an implicit run of a larger domain, ") +
            (is_vertical ? "vertical" : "horizontal") + " pulse: difference / peak [%]");
      const auto compare = [&](const std::string &boundary, const int n)
      {
        c.boundary = boundary;
        const History small = partitioned(box(n), c);
        return std::array<double, 2>{
            {100. * difference(small.top, large.top), 100. * difference(small.foot, large.foot)}};
      };
      for (const Row &row : rows[is_vertical])
      {
        const auto        d = compare(row.boundary, row.n);
        const std::string name = "  " + row.boundary + ", rock of " + std::to_string(row.n) + " cells, ";
        below(name + "top", d[0], row.top);
        below(name + "foot", d[1], row.foot);
      }
      const auto d = compare("fixed", 8); // what a boundary is for
      Columns::above("  fixed, rock of 8 cells, top", d[0], 5.);
      Columns::above("  fixed, rock of 8 cells, foot", d[1], 20.);
    }
  }

  /** Near the critical time step (3.004 ms), without damping, long after the pulse: neither growth nor drift.
   */
  void long_run()
  {
    Case c;
    c.dt = .00295;
    c.duration = 6000 * c.dt;
    for (const std::string boundary : {"viscous-spring", "mtf2", "mtf3"})
    {
      c.boundary = boundary;
      const History h = partitioned(box(8), c);
      const auto    late = [](const std::vector<Vector3> &u)
      { return peak(std::vector<Vector3>(u.end() - 500, u.end())) / peak(u); };
      below(boundary + ", largest after 5500 steps at 0.98 of the critical one / peak, top", late(h.top),
            .01);
      below("  foot", late(h.foot), .01);
    }
    // With the dam's elements in three layers of rock: waves of the size of cells, which they keep, die away.
    c.layers_at_dam = 3;
    c.duration *= 4.;
    const History h = partitioned(box(12), c);
    const auto    part = [&](const std::size_t from, const std::size_t to)
    { return peak(std::vector<Vector3>(h.top.begin() + from, h.top.begin() + to)) / peak(h.top); };
    below("the dam's elements at the dam, largest after 5500 steps / peak", part(5500, 6000), .03);
    below("  after 23500 steps, over that", part(23500, 24000) / part(5500, 6000), .5);
  }
} // namespace

/** Usage: rock_implicit partition|domain|long */
int main(int argc, char **argv)
{
  const std::string part = argc > 1 ? argv[1] : "";
  if (part == "partition")
    return Columns::run_all({partition, tied_joint});
  if (part == "domain")
    return Columns::run_all({symmetry, larger_domain});
  if (part == "long")
    return Columns::run_all({long_run});
  std::fprintf(stderr, "usage: rock_implicit partition|domain|long\n");
  return 2;
}
