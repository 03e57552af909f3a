// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/blas.h>
#include <voussoir/foundation/massless_support.h>

#include <algorithm>
#include <cmath>

namespace Voussoir
{
  namespace
  {
    enum Entry
    {
      strain,
      at_start,
      damped,
      worked,
      largest,
      n_entries
    };

    Unknowns plus(Unknowns place, const Unknowns &offset)
    {
      for (std::size_t k = 0; k < offset.size(); ++k)
        place[k] += offset[k];
      return place;
    }

    /** Returns the displacement @p place without the offset [m]. */
    Unknowns difference(Unknowns place, const Unknowns &offset)
    {
      for (std::size_t k = 0; k < offset.size(); ++k)
        place[k] -= offset[k];
      return place;
    }
  } // namespace

  MasslessSupport::MasslessSupport(const CondensedRock &rock, const DamNodes &dam_nodes,
                                   const double stiffness_damping, const double dt, const Unknowns &offset,
                                   const BaseMotion *motion)
      : rock(rock), dam_nodes(dam_nodes), damping(stiffness_damping), dt(dt), offset(offset), motion(motion)
  {
  }

  BlockSparseMatrix MasslessSupport::compliance(const unsigned int n) const
  {
    BlockSparseMatrix result = rock.compliance(std::vector<double>(rock.base_nodes.size(), 0.));
    for (Matrix3 &block : result.value)
      for (double &x : block)
        x *= 2. / (1. + ratio(n));
    return dam_nodes.matrix(result);
  }

  Unknowns MasslessSupport::predict(const unsigned int n, const double time, const Unknowns &at)
  {
    from = offset_at(time);
    to = motion ? offset_at(time + n * dt / n_full) : from;
    before = difference(at, from);
    Unknowns place = before;
    for (double &x : place)
      x *= (ratio(n) - 1.) / (ratio(n) + 1.);
    for (std::size_t k = 0; k < to.size(); ++k)
      place[k] += to[k];
    return place;
  }

  /** Returns the displacement of the dam nodes without force at a time [m], or empty if it is zero. */
  Unknowns MasslessSupport::offset_at(const double time) const
  {
    return motion ? plus(motion->displacement(time), offset) : offset;
  }

  /** Returns the values of one dam node per base node. Dam nodes on the same base node have equal values. */
  Unknowns MasslessSupport::of_rock(const Unknowns &of_nodes) const
  {
    Unknowns result(rock.n());
    for (std::size_t i = 0; i < dam_nodes.node.size(); ++i)
      std::copy_n(of_nodes.begin() + 3 * i, 3, result.begin() + 3 * std::size_t(dam_nodes.base_node[i]));
    return result;
  }

  /** Returns a S a / 2. */
  double MasslessSupport::energy(const Unknowns &a) const
  {
    const int    n = rock.n(), stride = 1;
    const double one = 1., zero = 0.;
    Unknowns     Sa(n);
    dgemv_("N", &n, &n, &one, rock.stiffness.data(), &n, a.data(), &stride, &zero, Sa.data(), &stride);
    double sum = 0.;
    for (int i = 0; i < n; ++i)
      sum += .5 * a[i] * Sa[i];
    return sum;
  }

  void MasslessSupport::start_account(const Unknowns &u)
  {
    Unknowns at;
    for (const unsigned int node : dam_nodes.node)
      at.insert(at.end(), u.begin() + 3 * std::size_t(node), u.begin() + 3 * std::size_t(node) + 3);
    account.assign(n_entries, 0.);
    account[strain] = account[at_start] = energy(of_rock(difference(at, offset)));
  }

  void MasslessSupport::advance(const unsigned int n, const Unknowns &force, const Unknowns &place,
                                const double work)
  {
    if (account.empty())
      return;
    const Unknowns now = difference(place, to);
    account[strain] = energy(of_rock(now));
    account[damped] += ratio(n) * energy(of_rock(difference(now, before)));
    account[worked] -= work;
    for (std::size_t k = 0; motion && k < force.size(); ++k) // work of the moving rock
      account[worked] += force[k] * (to[k] - from[k]);
    account[largest] = std::max({account[largest], std::abs(account[strain] - account[at_start]),
                                 account[damped], std::abs(account[worked])});
  }

  std::vector<std::pair<std::string, double>> MasslessSupport::energies() const
  {
    const double change = account[strain] - account[at_start];
    return {{"rock_strain", change},
            {"rock_damping", account[damped]},
            {"rock_feet", account[worked]},
            {"rock_balance", change + account[damped] - account[worked]}};
  }

  double MasslessSupport::strain_at_start() const
  {
    return account.empty() ? 0. : account[at_start];
  }

  double MasslessSupport::balance_error() const
  {
    const double scale = account.empty() ? 0. : std::max(account[largest], 1e-6 * account[at_start]);
    return scale > 0.
               ? std::abs(account[strain] - account[at_start] + account[damped] - account[worked]) / scale
               : 0.;
  }
} // namespace Voussoir
