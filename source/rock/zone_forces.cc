// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/rock/zone_forces.h>

namespace Voussoir
{
  ZoneForces::ZoneForces(std::unique_ptr<ZoneStrip> given, const RockRegionParameters &parameters)
      : strip(std::move(given)), dt(parameters.dt)
  {
    strip->field.evaluate(before);
    damped = DampedMotion(parameters.damping, dt, before.size());
  }

  void ZoneForces::end_step(Unknowns &force)
  {
    strip->field.end_step();
    Unknowns now, inside, outside;
    strip->field.evaluate(now);
    Unknowns w(now.size()), x(now.size());
    for (std::size_t k = 0; k < x.size(); ++k)
      w[k] = (now[k] - before[k]) / dt;
    damped.advance(now.data(), w.data(), x.data(), 0, x.size());
    before.swap(now);
    strip->separate(x, inside, outside);
    Unknowns f_inside(x.size()), f_outside(x.size());
    strip->stiffness.multiply(inside.data(), f_inside.data());
    strip->stiffness.multiply(outside.data(), f_outside.data());
    strip->gather(f_inside, f_outside, force);
  }

  std::vector<std::vector<double> *> ZoneForces::state()
  {
    auto arrays = strip->field.state();
    arrays.push_back(&before);
    for (auto *array : damped.state())
      arrays.push_back(array);
    return arrays;
  }

  StraightSection::StraightSection(std::unique_ptr<ExplicitRegion> given, std::unique_ptr<ZoneForces> acting)
      : region(std::move(given)), forces(std::move(acting))
  {
  }

  void StraightSection::begin_step(std::vector<Ranks::Message> &messages)
  {
    forces->begin_step(messages);
    region->begin_step({}, {}, messages);
  }

  void StraightSection::end_step()
  {
    forces->end_step(region->force);
    region->end_step({});
  }

  Vector3 StraightSection::displacement(const unsigned int node, double) const
  {
    const double *u = region->displacement().data() + 3 * std::size_t(node);
    return {{u[0], u[1], u[2]}};
  }

  std::vector<std::vector<double> *> StraightSection::state()
  {
    auto arrays = forces->state();
    for (auto *array : region->state())
      arrays.push_back(array);
    return arrays;
  }
} // namespace Voussoir
