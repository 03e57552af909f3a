// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/foundation/partitioned_rock.h>
#include <voussoir/foundation/region_parameters.h>
#include <voussoir/foundation/subcycled_rock.h>

#include <algorithm>
#include <sstream>

namespace Voussoir
{
  std::unique_ptr<Foundation> make_explicit_rock(const FoundationSite &site)
  {
    if (site.parameters.coupling == "common step")
      return std::make_unique<CommonStepRock>(site);
    if (site.parameters.is_subcycled())
      return std::make_unique<SubcycledRock>(site);
    return std::make_unique<PartitionedRock>(site);
  }

  RockDamping SubcycledRock::damping() const
  {
    return region_parameters(parameters, centre, 0.).damping;
  }

  std::string SubcycledRock::about_steps() const
  {
    std::ostringstream text;
    text.precision(4);
    text << ", " << parameters.n_substeps() << (parameters.n_substeps() == 1 ? " rock step" : " rock steps")
         << " each, coupled by mean tractions; critical time step "
         << "of the rock " << dt_critical << " s";
    return text.str();
  }

  void SubcycledRock::check(const TimeGrid &steps, const unsigned int steps_per_sample) const
  {
    ExplicitRock::check(steps, steps_per_sample);
    RockPatch(model, damping(), steps.substep(), rock_nodes(at_base), steps.substeps);
  }

  void SubcycledRock::start(const GroundMotion &outcrop, const TimeGrid &steps, const Unknowns &u)
  {
    patch =
        std::make_unique<RockPatch>(model, damping(), steps.substep(), rock_nodes(at_base), steps.substeps);
    make_rock(outcrop, steps, .5 * steps.substep(), patch->nodes());
    region->force.assign(3 * model.points.size(), 0.);
    dam_nodes = DamNodes(at_base);
    rest.clear();
    for (const unsigned int node : dam_nodes.node)
      rest.insert(rest.end(), u.begin() + 3 * std::size_t(node), u.begin() + 3 * std::size_t(node) + 3);
    mean_v.assign(3, 0.);
    mean_a = mean_v;
  }

  Support *SubcycledRock::support(Structure &structure)
  {
    dam_nodes.mark(structure);
    return this;
  }

  BlockSparseMatrix SubcycledRock::compliance(const unsigned int n) const
  {
    return dam_nodes.matrix(patch->compliance(n));
  }

  Unknowns SubcycledRock::predict(const unsigned int n, double, const Unknowns &)
  {
    const Stopwatch watch;
    const double    worked = Ranks::work();
    Unknowns        place(3 * at_base.size());
    if (Ranks::rank() == predicting_rank)
      place = patch->places(n, region->displacement(), region->half_step_velocity(), region->damped_motion());
    Ranks::broadcast(place.data(), place.size(), predicting_rank);
    Unknowns result = rest;
    for (std::size_t i = 0; i < dam_nodes.node.size(); ++i)
      for (unsigned int c = 0; c < 3; ++c)
        result[3 * i + c] += place[3 * std::size_t(dam_nodes.base_node[i]) + c];
    seconds_advancing += watch.seconds();
    work_advancing += Ranks::work() - worked;
    return result;
  }

  Unknowns SubcycledRock::places() const
  {
    const Unknowns &u = region->displacement(), &w = region->half_step_velocity();
    Unknowns        result;
    for (const BaseNode &base_node : at_base)
      for (unsigned int c = 0; c < 3; ++c)
      {
        const std::size_t k = 3 * std::size_t(base_node.rock) + c;
        result.push_back(u[k] + .5 * region->time_step() * w[k]);
      }
    return result;
  }

  void SubcycledRock::advance(const unsigned int n, const Unknowns &on_dam, const Unknowns &,
                              const double work)
  {
    const Stopwatch watch;
    const double    worked = Ranks::work();
    Unknowns        on_rock(3 * at_base.size(), 0.);
    for (std::size_t i = 0; i < dam_nodes.node.size(); ++i)
      for (unsigned int c = 0; c < 3; ++c)
        on_rock[3 * std::size_t(dam_nodes.base_node[i]) + c] -= on_dam[3 * i + c];
    for (std::size_t i = 0; i < at_base.size(); ++i)
      std::copy_n(on_rock.begin() + 3 * i, 3, region->force.begin() + 3 * std::size_t(at_base[i].rock));
    const Unknowns before = places();
    for (unsigned int j = 0; j < n; ++j)
      region->advance();
    const Unknowns after = places();
    for (std::size_t k = 0; k < on_rock.size(); ++k)
      balance->entries[RockBalance::on_rock] += on_rock[k] * (after[k] - before[k]);
    balance->entries[RockBalance::on_dam] += work;
    seconds_advancing += watch.seconds();
    work_advancing += Ranks::work() - worked;
  }

  /** Predicts the mean velocity of the base nodes. Forces are exchanged by Support. */
  void SubcycledRock::advance(Unknowns &)
  {
    for (unsigned int c = 0; c < 3; ++c)
      predicted_velocity[c] = mean_v[c] + .5 * grid.dt * mean_a[c];
  }

  void SubcycledRock::update_from_dam(const DynamicState &state)
  {
    Vector3 mean{};
    for (const BaseNode &base_node : at_base)
      for (const unsigned int node : base_node.nodes)
        for (unsigned int c = 0; c < 3; ++c)
          mean[c] += state.v[3 * std::size_t(node) + c] / (at_base.size() * base_node.nodes.size());
    for (unsigned int c = 0; c < 3; ++c)
    {
      mean_a[c] = 2. / grid.dt * (mean[c] - mean_v[c]) - mean_a[c];
      mean_v[c] = mean[c];
    }
    finish_step(state.time);
  }

  std::vector<std::vector<double> *> SubcycledRock::state()
  {
    if (!region)
      return {};
    std::vector<std::vector<double> *> arrays = region->state();
    for (Unknowns *array : {&rest, &mean_v, &mean_a, &balance->entries})
      arrays.push_back(array);
    return arrays;
  }
} // namespace Voussoir
