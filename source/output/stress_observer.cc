// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/dam/load_table.h>
#include <voussoir/mesh/mesh.h>
#include <voussoir/output/archive.h>
#include <voussoir/output/assessment.h>
#include <voussoir/output/observers.h>

#include <cmath>

namespace Voussoir
{
  namespace
  {
    std::vector<double> water_mass(const Dam &dam)
    {
      return dam.facts.added_mass > 0. ? added_mass_per_area(*dam.model, dam.scene.reservoir)
                                       : std::vector<double>();
    }
  } // namespace

  StressObserver::StressObserver(const RunState &run, const JointRecorder &joints)
      : run(run), joints(joints),
        tractions(*run.dam->model, run.dam->structure, known_traction(run.scene()), run.dam->initial_stress,
                  run.statics.joint_water, water_mass(*run.dam)),
        recovery(std::make_shared<StressRecovery>(
            *run.dam->model, run.dam->materials, run.scene().elements.incompatible_modes,
            run.scene().output.knows_tractions() ? tractions.faces : std::vector<NodeFace>(),
            run.scene().output.knows_tractions())),
        tension(*run.dam->model), envelope(*recovery, run.dam->initial_stress)
  {
    envelope.overstress = Overstress(run.scene().limits.static_strength(), run.dam->model->n_nodes());
    envelope.faces = FaceEnvelope(*run.dam->model);
  }

  StressObserver::StressObserver(const RunState &run, const JointRecorder &joints,
                                 const StressObserver &other)
      : run(run), joints(joints), tractions(other.tractions), recovery(other.recovery),
        tension(other.tension), envelope(*recovery, run.dam->initial_stress)
  {
    envelope.overstress = Overstress(run.scene().limits.static_strength(), run.dam->model->n_nodes());
    envelope.faces = other.envelope.faces;
  }

  /** Records the stresses of this rank's nodes. Before the first rank prints stresses, they are gathered. */
  void StressObserver::follow()
  {
    if (!is_recording())
      return;
    const Stopwatch watch;
    if (run.is_due(run.scene().output.envelope_interval.samples))
      envelope.record(run.integrator->state().time, run.statics.elastic(run.integrator->state().u),
                      tractions_now());
    if (run.is_due(run.scene().output.progress_interval.samples) || run.is_last())
      envelope.gather();
    seconds += watch.seconds();
  }

  std::vector<Vector3> StressObserver::tractions_now() const
  {
    if (!known_tractions())
      return {};
    const AcousticWater *water = run.dam->water.get();
    return tractions.at(run.integrator->state().force, run.acceleration,
                        water ? water->at_dam(water->pressure()) : std::vector<double>());
  }

  std::vector<Stress> StressObserver::stress_of(const Unknowns &u, const std::vector<Vector3> &by_faces) const
  {
    std::vector<Stress> result;
    recovery->apply(u, by_faces, result);
    for (std::size_t i = 0; i < result.size(); ++i)
      for (unsigned int c = 0; c < 6; ++c)
        result[i][c] += run.dam->initial_stress[i][c];
    return result;
  }

  std::vector<FieldWriter::NodalField> StressObserver::fields() const
  {
    std::vector<FieldWriter::NodalField> fields = {{"max_principal", envelope.maximum},
                                                   {"min_principal", envelope.minimum}};
    for (unsigned int k = 0; k < FaceDirections::n_stresses; ++k)
      for (const bool largest : {true, false})
        fields.push_back(
            {FaceEnvelope::name(k, largest), envelope.faces.field(run.dam->model->n_nodes(), k, largest)});
    return fields;
  }

  void StressObserver::finish(const std::string &directory, Log &)
  {
    if (!is_recording())
      return;
    const SolidModel                    &model = *run.dam->model;
    const FieldWriter                    writer(model);
    std::vector<FieldWriter::NodalField> fields = this->fields();
    if (water != nullptr)
      for (const FieldWriter::NodalField &field : water->fields())
        fields.push_back(field);
    writer.write_faces(directory, *run.dam->geometry, fields);
    fields.push_back({"max_joint_pressure", joints.largest_pressure(model)});
    writer.write_vtu(directory + "/envelope.vtu", {}, fields);
  }

  std::string StressObserver::largest_in_words(const int surface, const bool with_base) const
  {
    const Extreme largest = with_base ? envelope.extreme(*run.dam->model, surface, true)
                                      : tension.largest_away_from_base(envelope, *run.dam->model, surface);
    char          text[40];
    std::snprintf(text, sizeof(text), "%.2f MPa", 1e-6 * largest.value);
    return std::isfinite(largest.value) ? text : "none";
  }

  std::string StressObserver::range_in_words(const unsigned int k, const int surface) const
  {
    double range[2];
    for (const bool largest : {false, true})
      range[largest] =
          1e-6 * tension.extreme_away_from_base(envelope.faces, *run.dam->model, surface, k, largest).value;
    char text[60];
    std::snprintf(text, sizeof(text), "from %.2f to %.2f MPa", range[0], range[1]);
    return std::isfinite(range[0]) ? text : "none";
  }

  void StressObserver::report(Log &log) const
  {
    if (!is_recording())
      return;
    log.line(
        "Tension   largest %s upstream, %s downstream, farther than a tenth of the height from the base; "
        "with the base, where it grows with refinement, %s and %s",
        largest_in_words(PhysicalId::upstream, false).c_str(),
        largest_in_words(PhysicalId::downstream, false).c_str(),
        largest_in_words(PhysicalId::upstream, true).c_str(),
        largest_in_words(PhysicalId::downstream, true).c_str());
    for (const unsigned int k : {0, 1})
      log.line("          %s stress away from the base %s upstream, %s downstream", FaceDirections::name(k),
               range_in_words(k, PhysicalId::upstream).c_str(),
               range_in_words(k, PhysicalId::downstream).c_str());
    if (const double f = run.scene().strength_of_area(); f > 0.)
      log.line(
          "          above the strength of %.2f MPa: %.1f %% of the upstream face, %.1f %% of the downstream "
          "face",
          1e-6 * f, 100. * tension.above(envelope, PhysicalId::upstream, f).share(),
          100. * tension.above(envelope, PhysicalId::downstream, f).share());
  }

  NamedExtremes StressObserver::extremes() const
  {
    if (!is_recording())
      return {};
    const SolidModel &model = *run.dam->model;
    NamedExtremes     result = {
            {"max_tension_upstream", envelope.extreme(model, PhysicalId::upstream, true)},
            {"max_tension_downstream", envelope.extreme(model, PhysicalId::downstream, true)},
            {"max_compression", envelope.extreme(model, 0, false)},
            {"max_compression_away_from_base", tension.smallest_away_from_base(envelope, model)}};
    for (const auto &[name, surface] :
         {std::make_pair(std::string("max_tension_upstream"), PhysicalId::upstream),
          {"max_tension_downstream", PhysicalId::downstream}})
    {
      const Extreme largest = tension.largest_away_from_base(envelope, model, surface);
      result.emplace_back(name + "_away_from_base", largest);
      result.emplace_back(name + "_above_foot", largest); // for one release
    }
    for (unsigned int k = 0; k < FaceDirections::n_stresses; ++k)
      for (const auto &[face, surface] :
           {std::make_pair("upstream", PhysicalId::upstream), {"downstream", PhysicalId::downstream}})
        for (const bool largest : {true, false})
          result.emplace_back(FaceEnvelope::name(k, largest) + "_" + face + "_away_from_base",
                              tension.extreme_away_from_base(envelope.faces, model, surface, k, largest));
    return result;
  }

  Json StressObserver::json_of_strength() const
  {
    Json json;
    json.add("strength", run.scene().strength_of_area());
    for (const auto &face :
         {std::make_pair("upstream", PhysicalId::upstream), {"downstream", PhysicalId::downstream}})
    {
      const FaceTension::Part part = tension.above(envelope, face.second, run.scene().strength_of_area());
      Json                    of_face;
      json.add(face.first, of_face.add("area", part.area).add("share", part.share()));
    }
    return json;
  }

  Assessment assess(const RunState &run, const JointObserver &joints, const StressObserver &stresses,
                    const BlockObserver *blocks, const std::optional<double> wedge_safety)
  {
    const StressesOfRun of_run{stresses.envelope, stresses.tension,
                               run.n_steps > 0 ? run.scene().output.envelope_interval.samples : 1};
    return {run.scene().limits,
            *run.dam->model,
            stresses.is_recording() ? &of_run : nullptr,
            run.dam->structure.pairs.empty() ? nullptr : &joints.joints,
            blocks,
            wedge_safety};
  }

  void StressObserver::save(boost::archive::binary_oarchive &archive) const
  {
    archive << envelope << seconds;
  }

  void StressObserver::load(boost::archive::binary_iarchive &archive)
  {
    archive >> envelope >> seconds;
  }
} // namespace Voussoir
