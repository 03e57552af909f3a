// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/lanes.h>
#include <voussoir/output/batch_stresses.h>

namespace Voussoir
{
  BatchStresses::BatchStresses(const RunState &start, const StressObserver &observer,
                               const MotionBatch &batch)
      : run(start), batch(batch), lanes(n_lanes()), view(observer.view()),
        tractions(observer.known_tractions())
  {
    const std::size_t n_nodes = run.dam->model->n_nodes(),
                      n_faces = observer.envelope.faces.directions.nodes.size();
    at_rest = observer.stress_of(run.statics.elastic(run.statics.u), {});
    maximum.assign(lanes * n_nodes, -1e30f);
    minimum.assign(lanes * n_nodes, 1e30f);
    times_of_faces.assign(lanes * 2 * NodeOnFace::n_stresses * n_faces, 0.f);
    of_faces.resize(times_of_faces.size());
    for (std::size_t k = 0; k < of_faces.size(); ++k)
      of_faces[k] = k / lanes % 2 == 0 ? -1e30f : 1e30f;
    observer.envelope.faces.show(view);
    view.u = batch.displacements();
    view.added = at_rest.data();
    view.maximum = maximum.data();
    view.minimum = minimum.data();
    view.by_column = true;
    view.new_of_faces = of_faces.data();
    view.times_of_faces = times_of_faces.data();
    view.lowest = observer.envelope.overstress.lowest_level();
    if (tractions != nullptr)
    {
      of_tractions.resize(3 * lanes * tractions->faces.size());
      forces.resize(3 * lanes * run.dam->structure.pairs.size());
      before.resize(lanes * tractions->wet_faces.size());
      acceleration.resize(before.size());
      view.traction = of_tractions.data();
    }
  }

  void BatchStresses::find_velocities(std::vector<float> &velocity) const
  {
    const float *v = batch.velocities();
    for (std::size_t w = 0; w < velocity.size() / lanes; ++w)
    {
      const Tractions::WetFace &wet = tractions->wet_faces[w];
      const Vector3            &normal = tractions->faces[wet.face].normal;
      const float               n[3] = {float(normal[0]), float(normal[1]), float(normal[2])},
                  *at = v + 3 * lanes * wet.free_node;
      for (unsigned int lane = 0; lane < lanes; ++lane)
        velocity[lanes * w + lane] = n[0] * at[lane] + n[1] * at[lanes + lane] + n[2] * at[2 * lanes + lane];
    }
  }

  void BatchStresses::begin_step()
  {
    find_velocities(before);
  }

  void BatchStresses::find_tractions(const std::vector<Vector3> &ground)
  {
    batch.find_joint_forces(forces.data());
    for (std::size_t k = 0; ground.empty() && k < forces.size(); ++k)
      forces[k] = static_cast<float>(run.statics.force[k / lanes]);
    find_velocities(acceleration);
    for (std::size_t w = 0; !ground.empty() && w < tractions->wet_faces.size(); ++w)
    {
      const Vector3 &normal = tractions->faces[tractions->wet_faces[w].face].normal;
      for (unsigned int lane = 0; lane < lanes; ++lane)
      {
        float &a = acceleration[lanes * w + lane];
        a = (a - before[lanes * w + lane]) / float(run.motion.dt) + float(dot(normal, ground[lane]));
      }
    }
    tractions->at(lanes, forces.data(), ground.empty() ? nullptr : acceleration.data(), of_tractions.data());
  }

  void BatchStresses::record(const std::vector<EnvelopeRecorder *> &recorders,
                             const std::vector<Vector3>            &ground)
  {
    if (tractions != nullptr)
      find_tractions(ground);
    std::vector<double> intervals;
    for (EnvelopeRecorder *recorder : recorders)
      intervals.push_back(recorder != nullptr ? recorder->overstress.begin(batch.time()) : 0.);
    view.time = static_cast<float>(batch.time());
    const StressKernel kernel = stress_kernel();
#pragma omp parallel for schedule(static)
    for (std::size_t i = 0; i < at_rest.size(); ++i)
    {
      float stress[6 * most_lanes];
      if (const unsigned int columns = kernel(view, i, stress); columns != 0)
        for (std::size_t lane = 0; lane < recorders.size(); ++lane)
          if ((columns >> lane & 1u) != 0 && recorders[lane] != nullptr)
            update(*recorders[lane], lane, i, intervals[lane], column_of(stress, lanes, lane));
    }
  }

  void BatchStresses::update(EnvelopeRecorder &recorder, const std::size_t lane, const std::size_t node,
                             const double interval, const Stress &stress)
  {
    recorder.update(node, batch.time(), interval, stress);
    maximum[lanes * node + lane] = recorder.maximum[node];
    minimum[lanes * node + lane] = recorder.minimum[node];
  }

  void BatchStresses::finish(EnvelopeRecorder &recorder, const std::size_t lane) const
  {
    recorder.faces.take(of_faces, times_of_faces, lanes, lane);
  }
} // namespace Voussoir
