// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/contact/elastic_law.h>
#include <voussoir/contact/surfaces_law.h>
#include <voussoir/joints/joint_laws.h>

#include <algorithm>
#include <cassert>
#include <cmath>

namespace Voussoir
{
  void JointLaws::assign(const Structure &structure)
  {
    std::vector<bool> crosses(structure.pairs.size(), false);
    for (const auto &cluster : structure.clusters)
      for (const unsigned int p : cluster)
        crosses[p] = !of_crossings.empty() && of_crossings[structure.pairs[p].joint];
    for (std::size_t p = 0; p < crosses.size(); ++p)
    {
      const Pair     &pair = structure.pairs[p];
      const JointLaw *law = (crosses[p] ? of_crossings : of_joint)[pair.joint].get();
      if (const double friction = law->flat_friction(); friction >= 0. && !pair.planes.empty())
      {
        std::vector<ContactSurface> surfaces;
        for (const Matrix3 &plane : pair.planes)
          surfaces.push_back({plane, 0., friction});
        of_edges.push_back(std::make_unique<SurfacesLaw>(std::move(surfaces)));
        law = of_edges.back().get();
      }
      add(law, pair.area);
    }
  }

  void PairLaws::add(const JointLaw *law, const double tributary_area)
  {
    memory_end.push_back(n_memory() + law->n_memory());
    of_pair.push_back(law);
    area.push_back(tributary_area);
  }

  bool PairLaws::need_mean_force() const
  {
    return std::any_of(of_pair.begin(), of_pair.end(),
                       [](const JointLaw *law) { return law->needs_mean_force(); });
  }

  std::vector<PairHistory> PairLaws::histories(const Unknowns &start, const bool is_mean,
                                               const Unknowns &memory) const
  {
    assert(start.size() == 3 * of_pair.size());
    assert(memory.size() == n_memory());
    std::vector<PairHistory> list;
    list.reserve(of_pair.size());
    for (std::size_t p = 0; p < of_pair.size(); ++p)
    {
      list.emplace_back(get(start, p));
      list.back().area = area[p];
      list.back().is_mean = is_mean;
      list.back().memory = memory.data() + memory_begin(p);
    }
    return list;
  }

  namespace
  {
    /** Returns true if the force of a pair that begins to open falls faster than the flexibility @p H of the pair
     * relieves it: the diagonal of Newton's matrix is negative.
     * @param force force at which it cracks
     * @param gap gap at which it cracks
     * @param history data after the event */
    bool snaps(const JointLaw &law, const Matrix3 &H, const Vector3 &force, Vector3 gap,
               const PairHistory &history)
    {
      gap[0] += 1e-6 * H[0] * std::abs(force[0]); // the softening begins above the gap
      PairEquations e;
      law.evaluate(force, gap, history, 1. / H[0], e);
      return e.d_force[0] + e.d_gap[0] * H[0] < 0.;
    }
  } // namespace

  unsigned int PairLaws::revise(const ContactOperator &W, const Unknowns &start, const bool is_mean,
                                const Unknowns &gap, Unknowns &force, Unknowns &memory) const
  {
    assert(force.size() == 3 * of_pair.size());
    constexpr double               among_the_worst = .9;
    const std::vector<PairHistory> history = histories(start, is_mean, memory);
    std::vector<double>            utilisation(of_pair.size());
    double                         largest = 0.;
    for (std::size_t p = 0; p < of_pair.size(); ++p)
    {
      utilisation[p] = of_pair[p]->utilisation(get(force, p), get(gap, p), history[p]);
      largest = std::max(largest, utilisation[p]);
    }
    unsigned int count = 0;
    for (std::size_t p = 0; p < of_pair.size(); ++p)
      if (utilisation[p] > 1. && utilisation[p] >= among_the_worst * largest)
      {
        of_pair[p]->apply_event(memory.data() + memory_begin(p));
        if (is_mean && snaps(*of_pair[p], W.diagonal(p), get(force, p), get(gap, p), history[p]))
          of_pair[p]->apply_event(memory.data() + memory_begin(p), JointEvent::cut);
        set(force, p, {});
        ++count;
      }
    return count;
  }

  void PairLaws::restore_bond(const std::size_t pair, Unknowns &memory) const
  {
    std::fill_n(memory.begin() + memory_begin(pair), of_pair[pair]->n_memory(), 0.);
  }

  void PairLaws::lose_bond(const std::size_t pair, Unknowns &memory) const
  {
    if (of_pair[pair]->n_memory() > 0)
      of_pair[pair]->apply_event(memory.data() + memory_begin(pair), JointEvent::cut);
  }

  void PairLaws::commit(const Unknowns &start, const bool is_mean, const Unknowns &force, const Unknowns &gap,
                        Unknowns &memory) const
  {
    if (!have_memory())
      return;
    assert(force.size() == 3 * of_pair.size());
    assert(gap.size() == 3 * of_pair.size());
    const std::vector<PairHistory> history = histories(start, is_mean, memory);
    for (std::size_t p = 0; p < of_pair.size(); ++p)
      of_pair[p]->commit(get(force, p), get(gap, p), history[p], memory.data() + memory_begin(p));
  }

  JointEnergy PairLaws::joint_energy(const Unknowns &gap, const Unknowns &memory) const
  {
    JointEnergy sum;
    if (have_memory())
    {
      assert(gap.size() == 3 * of_pair.size());
      assert(memory.size() == n_memory());
      for (std::size_t p = 0; p < of_pair.size(); ++p)
      {
        const double *own = memory.data() + memory_begin(p);
        const double  of_bond = of_pair[p]->bond_energy(get(gap, p), area[p], own);
        (of_pair[p]->surfaces_law() ? sum.stored : sum.fracture) += of_bond;
        if (const ElasticLaw *law = of_pair[p]->elastic_law())
          sum.stored += law->stored_energy(area[p], own);
      }
    }
    return sum;
  }

  bool PairLaws::have_seats() const
  {
    return std::any_of(of_pair.begin(), of_pair.end(),
                       [](const JointLaw *law)
                       { return law->n_memory() > 0 && (law->surfaces_law() || law->elastic_law()); });
  }

  bool PairLaws::have_bonds() const
  {
    return std::any_of(of_pair.begin(), of_pair.end(),
                       [](const JointLaw *law)
                       {
                         return law->elastic_law() ? law->elastic_law()->has_bond()
                                                   : law->n_memory() > 0 && !law->surfaces_law();
                       });
  }

  double PairLaws::friction_correction(const Unknowns &start, const bool is_mean, const Unknowns &force,
                                       const Unknowns &gap, const Unknowns &memory) const
  {
    if (!is_mean ||
        std::none_of(of_pair.begin(), of_pair.end(),
                     [](const JointLaw *law) { return law->surfaces_law() || law->elastic_law(); }))
      return 0.;
    const std::vector<PairHistory> history = histories(start, is_mean, memory);
    double                         sum = 0.;
    for (std::size_t p = 0; p < of_pair.size(); ++p)
      if (const SurfacesLaw *law = of_pair[p]->surfaces_law())
        sum += law->friction_correction(get(force, p), get(gap, p), history[p]);
      else if (const ElasticLaw *elastic = of_pair[p]->elastic_law())
        sum += elastic->friction_correction(get(force, p), history[p]);
    return sum;
  }
} // namespace Voussoir
