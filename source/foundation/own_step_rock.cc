// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/foundation/own_step_rock.h>

#include <algorithm>
#include <sstream>

namespace Voussoir
{
  std::unique_ptr<Foundation> make_explicit_rock(const FoundationSite &site)
  {
    if (site.parameters.has_own_steps())
      return std::make_unique<OwnStepRock>(site);
    return std::make_unique<ExplicitRock>(site);
  }

  RayleighDamping OwnStepRock::damping() const
  {
    return region_parameters(parameters, centre, 0.).damping;
  }

  std::string OwnStepRock::about_steps() const
  {
    std::ostringstream text;
    text.precision(4);
    text << ", in each " << parameters.substeps
         << " of the rock, coupled by mean tractions; critical time step "
         << "of the rock " << dt_critical << " s";
    return text.str();
  }

  void OwnStepRock::check(const TimeGrid &steps, const unsigned int steps_per_sample) const
  {
    ExplicitRock::check(steps, steps_per_sample);
    RockPatch(model, damping(), steps.substep(), feet_of_rock(), steps.substeps);
  }

  void OwnStepRock::start(const GroundMotion &outcrop, const TimeGrid &steps, const Unknowns &u)
  {
    patch = std::make_unique<RockPatch>(model, damping(), steps.substep(), feet_of_rock(), steps.substeps);
    make_rock(outcrop, steps, .5 * steps.substep(), patch->nodes());
    model.stiffness = BlockSparseMatrix(); // frees memory; not used by region and patch
    region->force.assign(3 * std::size_t(n_nodes()), 0.);
    standing = StandingNodes(foot);
    rest.clear();
    for (const unsigned int node : standing.node)
      rest.insert(rest.end(), u.begin() + 3 * std::size_t(node), u.begin() + 3 * std::size_t(node) + 3);
    v.assign(3, 0.); // mean of the base nodes
    a = v;
    account.assign(4, 0.);
  }

  Support *OwnStepRock::support(Structure &structure)
  {
    standing.mark(structure);
    return this;
  }

  BlockSparseMatrix OwnStepRock::compliance(const unsigned int n) const
  {
    return standing.matrix(patch->compliance(n));
  }

  Unknowns OwnStepRock::predict(const unsigned int n, const Unknowns &)
  {
    const Stopwatch watch;
    const double    worked = Ranks::work();
    Unknowns        place(3 * foot.size());
    if (Ranks::rank() == ahead)
      place = patch->places(n, region->displacement(), region->half_step_velocity());
    Ranks::broadcast(place.data(), place.size(), ahead);
    Unknowns result = rest;
    for (std::size_t i = 0; i < standing.node.size(); ++i)
      for (unsigned int c = 0; c < 3; ++c)
        result[3 * i + c] += place[3 * std::size_t(standing.foot[i]) + c];
    seconds_advancing += watch.seconds();
    work_advancing += Ranks::work() - worked;
    return result;
  }

  Unknowns OwnStepRock::places() const
  {
    const Unknowns &u = region->displacement(), &w = region->half_step_velocity();
    Unknowns        result;
    for (const Foot &f : foot)
      for (unsigned int c = 0; c < 3; ++c)
      {
        const std::size_t k = 3 * std::size_t(f.rock) + c;
        result.push_back(u[k] + .5 * region->time_step() * w[k]);
      }
    return result;
  }

  void OwnStepRock::push(const unsigned int n, const Unknowns &on_dam, const Unknowns &, const double work)
  {
    const Stopwatch watch;
    const double    worked = Ranks::work();
    Unknowns        on_rock(3 * foot.size(), 0.);
    for (std::size_t i = 0; i < standing.node.size(); ++i)
      for (unsigned int c = 0; c < 3; ++c)
        on_rock[3 * std::size_t(standing.foot[i]) + c] -= on_dam[3 * i + c];
    for (std::size_t i = 0; i < foot.size(); ++i)
      std::copy_n(on_rock.begin() + 3 * i, 3, region->force.begin() + 3 * std::size_t(foot[i].rock));
    const Unknowns before = places();
    for (unsigned int j = 0; j < n; ++j)
      region->advance();
    const Unknowns after = places();
    for (std::size_t k = 0; k < on_rock.size(); ++k)
      account[3] += on_rock[k] * (after[k] - before[k]);
    account[0] += work;
    seconds_advancing += watch.seconds();
    work_advancing += Ranks::work() - worked;
  }

  /** Predicts the mean velocity of the base nodes. Forces are exchanged by Support. */
  void OwnStepRock::advance(Unknowns &)
  {
    for (unsigned int c = 0; c < 3; ++c)
      predicted_velocity[c] = v[c] + .5 * grid.dt * a[c];
  }

  void OwnStepRock::follow(const DynamicState &state)
  {
    Vector3 mean{};
    for (const Foot &f : foot)
      for (const unsigned int node : f.nodes)
        for (unsigned int c = 0; c < 3; ++c)
          mean[c] += state.v[3 * std::size_t(node) + c] / (foot.size() * f.nodes.size());
    for (unsigned int c = 0; c < 3; ++c)
    {
      a[c] = 2. / grid.dt * (mean[c] - v[c]) - a[c];
      v[c] = mean[c];
    }
    keep_account(state.time);
  }

  std::vector<std::vector<double> *> OwnStepRock::state()
  {
    if (!region)
      return {};
    std::vector<std::vector<double> *> arrays = region->state();
    for (Unknowns *array : {&rest, &v, &a, &account})
      arrays.push_back(array);
    return arrays;
  }
} // namespace Voussoir
