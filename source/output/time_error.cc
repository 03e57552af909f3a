// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/mesh/mesh.h>
#include <voussoir/output/time_error.h>

#include <cmath>

namespace Voussoir
{
  TimeErrorEstimate::TimeErrorEstimate(const Dam &dam, const ContactParameters &parameters, const double dt,
                                       const ImpactRule rule, const DynamicState &start,
                                       const Unknowns &reference_jump)
      : support(dam.foundation->support_of_companion(dam.structure, 2. * dt)),
        newmark(dam.structure, dam.laws, parameters, 2. * dt, rule, support.get()), dam(dam),
        joints(dam.structure, *dam.geometry)
  {
    joints.reach = JointReach(*dam.model, dam.structure.pairs);
    newmark.start(start.u, start.v, start.force, start.load, reference_jump, start.memory);
    joints.record(newmark);
  }

  void TimeErrorEstimate::record_stresses(const StressRecovery &stress, Tractions *known)
  {
    tractions = known;
    envelope.emplace(stress, dam.initial_stress);
    record_stresses();
  }

  void TimeErrorEstimate::record_stresses()
  {
    const DynamicState &state = newmark.state();
    envelope->record(state.time, state.u,
                     tractions == nullptr ? std::vector<Vector3>()
                                          : tractions->at(state.force, acceleration));
  }

  void TimeErrorEstimate::advance(const unsigned int step, const Unknowns &load, const Vector3 &base_velocity,
                                  const Vector3 &ground)
  {
    if (step % 2 == 1)
      return;
    const Unknowns v_before = newmark.state().v;
    const double   t_before = newmark.state().time;
    newmark.advance(load, base_velocity);
    acceleration = mean_acceleration(v_before, newmark.state().v, newmark.state().time - t_before,
                                     ground_before, ground);
    ground_before = ground;
    joints.record(newmark);
    if (envelope)
      record_stresses();
  }

  TimeError TimeErrorEstimate::of(const JointRecorder &of_run, const EnvelopeRecorder &stresses,
                                  const FaceTension &tension) const
  {
    constexpr double part = .4;        // of the difference
    constexpr double round_off = 1e-9; // [m]
    TimeError        error;
    double           difference = 0., sum = 0.;
    for (std::size_t j = 0; j < joints.largest.size(); ++j)
    {
      const double fine = of_run.largest[j].opening(), coarse = joints.largest[j].opening();
      difference += (fine - coarse) * (fine - coarse);
      sum += fine * fine;
    }
    error.opening = sum > round_off * round_off ? part * std::sqrt(difference / sum) : 0.;
    error.largest_opening = part * std::abs(of_run.opening.value - joints.opening.value);
    if (!envelope)
      return error;
    const auto of_face = [&](const int face)
    {
      return part * std::abs(tension.largest_above_foot(stresses, *dam.model, face).value -
                             tension.largest_above_foot(*envelope, *dam.model, face).value);
    };
    error.tension_upstream = of_face(PhysicalId::upstream);
    error.tension_downstream = of_face(PhysicalId::downstream);
    return error;
  }
} // namespace Voussoir
