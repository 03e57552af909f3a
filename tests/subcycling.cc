// SPDX-License-Identifier: GPL-3.0-or-later
// Subcycled rock, coupled by mean tractions: compliance of its base nodes, energy, accuracy, joints.

#include "rock_block.h"

namespace
{
  using namespace Voussoir;
  using namespace Blocks;
  using Columns::below;
  using Columns::between;

  constexpr double near_critical = .98 * .003004; ///< step of the rock of the block's cells [s]

  Case subcycling(const unsigned int m, const double dt)
  {
    Case c;
    c.coupling = "mean traction";
    c.substeps = m;
    c.dt = m * dt;
    return c;
  }

  RockModel model_of(const Ground &ground)
  {
    RockParameters p;
    p.materials[PhysicalId::first_rock] = rock;
    p.nodal_everywhere = true;
    return make_rock_model(make_mesh(ground, true, false), p);
  }

  /** Displacements of the base nodes after m steps with constant unit forces. */
  void compliance()
  {
    const RockModel           model = model_of(box(6));
    std::vector<unsigned int> feet;
    for (unsigned int i = 0; i < model.points.size(); ++i)
      if (const auto &p = model.points[i]; std::abs(p[0]) < 11. && std::abs(p[1]) < 11. && p[2] > -1.)
        feet.push_back(i);
    RockDamping damping;
    damping.mass = .3;
    damping.stiffness = 1e-4;
    damping.quality = 20.;
    const double h = .0027;
    for (const unsigned int m : {1, 2, 4, 5})
    {
      const RockPatch         patch(model, damping, h, feet, m);
      const BlockSparseMatrix R = patch.compliance(m);
      double                  asymmetry = 0., largest = 0., off = 0., own = 0.;
      std::vector<double>     dense(9 * feet.size() * feet.size(), 0.);
      const std::size_t       n = 3 * feet.size();
      for (unsigned int i = 0; i < R.n_rows(); ++i)
        for (std::size_t k = R.start[i]; k < R.start[i + 1]; ++k)
          for (unsigned int a = 0; a < 9; ++a)
            dense[(3 * i + a / 3) * n + 3 * R.column[k] + a % 3] = R.value[k][a];
      for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < n; ++j)
        {
          largest = std::max(largest, std::abs(dense[i * n + j]));
          asymmetry = std::max(asymmetry, std::abs(dense[i * n + j] - dense[j * n + i]));
          if (m == 1 && i != j)
            off = std::max(off, std::abs(dense[i * n + j]));
          if (m == 1 && i == j)
            own = std::max(own, std::abs(dense[i * n + i] * 2. * model.mass[feet[i / 3]] / (h * h) - 1.));
        }
      const std::string name = "compliance of the base nodes, m = " + std::to_string(m);
      below(name + ": asymmetry / largest", asymmetry / largest, 1e-14);
      if (m == 1)
      {
        between("  off the diagonal", off, 0., 0.);
        below("  against h^2/2M", own, 1e-14);
      }

      // The region itself, under all forces together.
      ExplicitRegion            region(make_operator(model), model.mass, damping, h);
      std::vector<unsigned int> held;
      for (const BoundaryFace &face : model.faces)
        for (const unsigned int node : face.nodes)
          held.insert(held.end(), {3 * node, 3 * node + 1, 3 * node + 2});
      region.fix(held);
      region.force.assign(3 * model.points.size(), 0.);
      Unknowns f(n), Rf(n);
      for (std::size_t k = 0; k < n; ++k)
        region.force[3 * feet[k / 3] + k % 3] = f[k] = Columns::random_number();
      for (unsigned int j = 0; j < m; ++j)
        region.advance();
      R.multiply(f.data(), Rf.data());
      double error = 0., size = 0.;
      for (std::size_t k = 0; k < n; ++k)
      {
        const std::size_t i = 3 * feet[k / 3] + k % 3;
        const double      place = region.displacement()[i] + .5 * h * region.half_step_velocity()[i];
        error = std::max(error, std::abs(place - Rf[k]));
        size = std::max(size, std::abs(place));
      }
      below(name + ": against the region / largest", error / size, 1e-13);
    }
  }

  /** Energies and base nodes of a run, relative errors. */
  struct Account
  {
    double dam = 0., rock = 0., interface = 0., largest = 0., apart = 0., far = 1e-300;

    void see(const Newmark &newmark, ExplicitRock &foundation)
    {
      largest = std::max(largest, newmark.largest_energy());
      dam = std::max(dam, std::abs(newmark.state().energy.balance(newmark.initial_energy())));
      rock = std::max(rock, foundation.balance_error());
      interface = std::max(interface, std::abs(foundation.energy_balance().coupling_error()));
      auto          &own = dynamic_cast<SubcycledRock &>(foundation);
      const Unknowns places = own.predict(0, 0., {}); // where they are
      for (std::size_t k = 0; k < places.size(); ++k)
      {
        const double u = newmark.state().u[3 * std::size_t(own.base_nodes()[k / 3]) + k % 3];
        apart = std::max(apart, std::abs(u - places[k]));
        far = std::max(far, std::abs(u));
      }
    }

    void report(const std::string &name, const double limit) const
    {
      below(name + ": account of the dam", dam / largest, limit);
      below(name + ": account of the rock", rock, limit);
      below(name + ": energy made by the coupling", interface / largest, limit);
      below(name + ": distance of the base nodes of dam and rock / displacement", apart / far, 1e-12);
    }
  };

  /** A closed box without damping, near the critical step: all energy stays. */
  void closed_box()
  {
    for (const unsigned int m : {1, 2, 4, 7})
    {
      Case c = subcycling(m, near_critical);
      c.duration = 20000 / m * c.dt;
      Account       account;
      const History h =
          partitioned(box(7), c, false, [&](const Newmark &n, ExplicitRock &r) { account.see(n, r); });
      account.report("closed box, m = " + std::to_string(m), 1e-11);
      const std::vector<Vector3> begin(h.top.begin(), h.top.begin() + h.top.size() / 10),
          end(h.top.end() - h.top.size() / 10, h.top.end());
      below("  top, last tenth / first", peak(end) / peak(begin), 1.2);
    }
  }

  /** A closed box with a quality factor: the base nodes are predicted with the memory variables, and the motion
   * decays. */
  void box_with_quality()
  {
    Case c = subcycling(4, .8 * near_critical);
    c.quality = 20.;
    c.duration = 3000 * c.dt;
    Account       account;
    const History h =
        partitioned(box(7), c, false, [&](const Newmark &n, ExplicitRock &r) { account.see(n, r); });
    account.report("closed box, Q 20, m = 4", 1e-11);
    const std::vector<Vector3> begin(h.top.begin(), h.top.begin() + h.top.size() / 10),
        end(h.top.end() - h.top.size() / 10, h.top.end());
    below("  top, last tenth / first", peak(end) / peak(begin), .5);
  }

  /** Without damping, near the critical step, in a box that waves leave: no growth long after the pulse, and
   * no drift. */
  void open_box()
  {
    for (const unsigned int m : {2, 4, 7})
    {
      Case c = subcycling(m, near_critical);
      c.boundary = "mtf3";
      c.duration = 12000 / m * c.dt;
      const History h = partitioned(box(8), c);
      const auto    late = [](const std::vector<Vector3> &u)
      { return peak(std::vector<Vector3>(u.end() - u.size() / 10, u.end())) / peak(u); };
      below("mtf3, m = " + std::to_string(m) + ": last tenth of 12000 steps of the rock / peak, top",
            late(h.top), 1e-3);
      below("  foot", late(h.foot), 1e-3);
    }
  }

  /** The velocity of the base, known before the step by half of its acceleration: twice as near as the one
   * before. */
  void base_velocity()
  {
    for (const unsigned int m : {2, 5})
    {
      Case c = subcycling(m, .01 / 7.);
      c.pulse_length = .4;
      c.duration = 280 / m * c.dt;
      Vector3 before{};
      double  off = 0., of_last = 0.;
      partitioned(box(6), c, false,
                  [&](const Newmark &n, ExplicitRock &r)
                  {
                    auto   &own = dynamic_cast<SubcycledRock &>(r);
                    Vector3 mean{};
                    for (const unsigned int node : own.base_nodes())
                      for (unsigned int d = 0; d < 3; ++d)
                        mean[d] += n.state().v[3 * std::size_t(node) + d] / own.base_nodes().size();
                    const Vector3 predicted = own.base_velocity() - mean, last = before - mean;
                    off += dot(predicted, predicted);
                    of_last += dot(last, last);
                    before = mean;
                  });
      between("base velocity, m = " + std::to_string(m) + ": off, over that of the step before",
              std::sqrt(off / of_last), .4, .6);
    }
  }

  /** Against an implicit run of the same step. */
  void accuracy()
  {
    std::printf("Fixed box, pulse of 0.4 s: difference to an implicit run of the same step / peak\n");
    for (const auto &[m, top, foot] : {std::tuple<unsigned int, double, double>{1, 5e-4, 1e-3},
                                       {2, 1.5e-3, 3e-3},
                                       {4, 5e-3, 1e-2},
                                       {7, 2.5e-2, 2.5e-2}})
    {
      Case c = subcycling(m, .01 / 7.);
      c.pulse_length = .4;
      c.duration = 560 / m * c.dt;
      const History     one = implicit(box(7), c), own = partitioned(box(7), c);
      const std::string name = "  m = " + std::to_string(m);
      below(name + ", top", difference(own.top, one.top), top);
      below(name + ", foot", difference(own.foot, one.foot), foot);
    }
  }

  /** Two monoliths on one rock, contact and friction between them. */
  void friction(const std::string &name, const unsigned int m)
  {
    Case c = subcycling(m, .00143);
    c.law = "FJA";
    c.duration = 280 / m * c.dt;
    Account account;
    double  created = 0., penetration = 0., opening = 0., taken = 0.;
    double  path = 0.;
    bool    slips = false;
    partitioned(box(7), c, true,
                [&](const Newmark &n, ExplicitRock &r)
                {
                  account.see(n, r);
                  const Energy &e = n.state().energy;
                  created = std::max(created, taken - e.friction - e.impact);
                  taken = e.friction + e.impact;
                  for (unsigned int p = 0; p < n.pair_states().size(); ++p)
                  {
                    const Vector3 jump = n.opening_and_slip(p);
                    penetration = std::max(penetration, -jump[0]);
                    opening = std::max(opening, jump[0]);
                    path = std::max(path, std::hypot(jump[1], jump[2]));
                    slips = slips || n.pair_states()[p] == PairState::slip;
                  }
                });
    account.report(name, 1e-11);
    below(name + ": energy created by the joint in a step", created / account.largest, 1e-12);
    below(name + ": penetration / opening", penetration / opening, 1e-9);
    Columns::above(name + ": slip", slips ? path : 0., 1e-12);
    Columns::above(name + ": taken by friction and impact", taken / account.largest, 1e-6);
  }

  void joints()
  {
    for (const unsigned int m : {1, 2, 4, 7})
      friction("friction, m = " + std::to_string(m), m);
  }
} // namespace

/** Usage: subcycling compliance|energy|accuracy|joints */
int main(int argc, char **argv)
{
  const std::string part = argc > 1 ? argv[1] : "";
  if (part == "compliance")
    return Columns::run_all({compliance});
  if (part == "energy")
    return Columns::run_all({closed_box, box_with_quality, open_box});
  if (part == "accuracy")
    return Columns::run_all({accuracy, base_velocity});
  if (part == "joints")
    return Columns::run_all({joints});
  std::fprintf(stderr, "usage: subcycling compliance|energy|accuracy|joints\n");
  return 2;
}
