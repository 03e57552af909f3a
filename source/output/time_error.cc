// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/mesh/mesh.h>
#include <voussoir/output/time_error.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace Voussoir
{
  TimeErrorEstimate::TimeErrorEstimate(const Dam &dam, const ContactParameters &parameters, const double dt,
                                       const ImpactRule rule, const DynamicState &start,
                                       const StaticState &statics)
      : support(dam.foundation->support_of_companion(dam.structure, 2. * dt)),
        newmark(dam.structure, dam.laws, parameters, 2. * dt, rule, support.get(),
                dam.scene.has_single_factors()),
        dam(dam), statics(statics), joints(dam.structure, *dam.geometry)
  {
    joints.reach = JointReach(*dam.model, dam.structure.pairs);
    newmark.start(start.u, start.v, start.force, start.load, statics.closed, start.memory,
                  statics.modulus_force);
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
    envelope->record(state.time, statics.elastic(state.u),
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

  namespace
  {
    constexpr double part = .4;                  // of the difference of both runs
    constexpr double part_of_history = .1;       // of the largest difference at equal times
    constexpr double round_off = 1e-9;           // [m]
    constexpr double largest_extrapolated = .01; // estimate of all openings

    /** Returns the sum over the crest openings of the squared largest difference at common times [m^2]. */
    double difference_over_time(const Table &fine, const Table &coarse)
    {
      std::vector<double> largest(coarse.columns.size(), 0.);
      auto                row = fine.rows.begin();
      for (const std::vector<double> &then : coarse.rows)
      {
        while (row != fine.rows.end() && (*row)[0] < then[0] - 1e-9)
          ++row;
        if (row == fine.rows.end())
          break;
        for (std::size_t k = 1; k < then.size(); ++k)
          if ((k - 1) % 4 < 2) // two openings, then two slips
            largest[k] = std::max(largest[k], std::abs((*row)[k] - then[k]));
      }
      return std::inner_product(largest.begin(), largest.end(), largest.begin(), 0.);
    }
  } // namespace

  double TimeErrorEstimate::of_openings(const JointRecorder &of_run) const
  {
    double difference = 0., sum = 0.;
    for (std::size_t j = 0; j < joints.largest.size(); ++j)
      for (const auto opening :
           {&JointRecorder::Largest::opening_upstream, &JointRecorder::Largest::opening_downstream})
      {
        const double fine = of_run.largest[j].*opening, coarse = joints.largest[j].*opening;
        difference += (fine - coarse) * (fine - coarse);
        sum += fine * fine;
      }
    if (!(sum > round_off * round_off))
      return 0.;
    // The largest openings of both runs may agree by chance, but the histories differ.
    return std::max(part * std::sqrt(difference / sum),
                    part_of_history * std::sqrt(difference_over_time(of_run.history, joints.history) / sum));
  }

  TimeError TimeErrorEstimate::of(const JointRecorder &of_run, const EnvelopeRecorder &stresses,
                                  const FaceTension &tension) const
  {
    TimeError error;
    error.opening = of_openings(of_run);
    error.largest_opening = std::max(part * std::abs(of_run.opening.value - joints.opening.value),
                                     error.opening * of_run.opening.value);
    if (error.opening > 0. && error.opening < largest_extrapolated)
      error.extrapolated_opening = of_run.opening.value + (of_run.opening.value - joints.opening.value) / 3.;
    if (!envelope)
      return error;
    const auto of_face = [&](const int face) { return part * tension.difference(stresses, *envelope, face); };
    error.tension_upstream = of_face(PhysicalId::upstream);
    error.tension_downstream = of_face(PhysicalId::downstream);
    return error;
  }
} // namespace Voussoir
