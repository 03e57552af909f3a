// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/output/archive.h>
#include <voussoir/output/assessment.h>
#include <voussoir/output/observers.h>

#include <algorithm>

namespace Voussoir
{
  JointObserver::JointObserver(const RunState &run) : joints(run.dam->structure, *run.dam->geometry), run(run)
  {
    const Structure &structure = run.dam->structure;
    const Scene     &scene = run.scene();
    joints.reach = JointReach(*run.dam->model, structure.pairs);
    joints.points =
        JointPoints(*run.dam->model, structure.pairs, structure.n_joints, scene.limits.waterstop_depth);
    joints.keys = KeyForces(structure, run.dam->layout.models, scene.joints.friction);
  }

  void JointObserver::record()
  {
    joints.record(*run.integrator);
    for (std::size_t part = 0; run.n_steps > 0 && part < run.motion.parts.size(); ++part)
      if (run.step == run.end_of_part(part))
        joints.points.end_part();
  }

  void JointObserver::open(const std::string &directory)
  {
    file.open(directory + "/joint_history.csv", joints.history);
  }

  void JointObserver::write_tables(const std::string &directory)
  {
    flush();
    joints.maxima().write(directory + "/joints.csv");
    std::vector<Vector3> at_start;
    for (const Pair &pair : run.dam->structure.pairs)
    {
      const std::size_t p = at_start.size();
      const double      jump = run.dam->structure.jump(pair, run.statics.u)[0];
      at_start.push_back({{run.statics.force[3 * p] / pair.area, jump - run.statics.closed[3 * p],
                           jump + run.statics.removed[p]}});
    }
    if (!at_start.empty())
      joints.points.write(directory, *run.dam->geometry, at_start);
    joints.pressures().write(directory + "/joint_pressures.csv");
  }

  void JointObserver::finish(const std::string &, Log &log)
  {
    for (const std::string &warning : joints.reach.warnings())
      log.line("warning: %s", warning.c_str());
    const LimitParameters &limits = run.scene().limits;
    const auto [missing, joint] = joints.points.height_without_waterstop();
    if (joints.points.has_waterstops() && missing > 0. &&
        (limits.waterstop_opening > 0. || limits.waterstop_slip > 0.))
      log.line("warning: in the uppermost %.1f m joint %u is thinner than Limits/Waterstop depth (%g m): "
               "the limits of the waterstops are not evaluated there. Reduce the depth.",
               missing, joint, limits.waterstop_depth);
  }

  void JointObserver::report(Log &log) const
  {
    log.line("Joints    largest opening %.2f mm, largest slip %.2f mm", 1e3 * joints.opening.value,
             1e3 * joints.slip.value);
    const std::size_t n_parts = run.n_steps > 0 ? run.motion.parts.size() : 0;
    for (std::size_t part = 0; part < n_parts; ++part)
    {
      const std::vector<JointPoints::Residual> residuals = joints.points.residuals_of_part(part);
      if (residuals.empty())
        continue;
      const auto opening =
          std::max_element(residuals.begin(), residuals.end(),
                           [](const auto &a, const auto &b) { return a.opening < b.opening; });
      const auto slip = std::max_element(residuals.begin(), residuals.end(),
                                         [](const auto &a, const auto &b) { return a.slip < b.slip; });
      const auto name = [&](const auto &joint)
      { return run.dam->layout.joints[joint - residuals.begin()].name(); };
      log.line("Residual  at t = %.2f s: opening %.2f mm (%s), slip %.2f mm (%s)",
               run.end_of_part(part) * run.motion.dt, 1e3 * opening->opening, name(opening).c_str(),
               1e3 * slip->slip, name(slip).c_str());
    }
  }

  double JointObserver::kept_opening() const
  {
    constexpr double opens = 1e-4, closed = .01; // [m]; of the largest opening
    double           kept = 0.;
    for (std::size_t j = 0; j < joints.largest.size(); ++j)
      for (const std::size_t column : {4 * j + 1, 4 * j + 2}) // openings of both ends of the crest
      {
        double largest = 0., least = 0.;
        for (const std::vector<double> &row : joints.history.rows)
          if (row[column] > largest)
            largest = least = row[column];
          else
            least = std::min(least, row[column]);
        if (largest > opens && least > closed * largest && run.dam->layout.joints[j].is_contraction())
          kept = std::max(kept, least);
      }
    return kept;
  }

  Json JointObserver::json_of_parts() const
  {
    Json all;
    for (std::size_t part = 0; part < run.motion.parts.size(); ++part)
    {
      const MotionPart &of_motion = run.motion.parts[part];
      Json              json;
      json.add("source", of_motion.name)
          .add("begin", of_motion.begin)
          .add("end", of_motion.end)
          .add("end_of_rest", run.motion.end_of_rest(part))
          .add("time_of_residual", run.end_of_part(part) * run.motion.dt);
      std::vector<double> openings, slips;
      for (const JointPoints::Residual &of_joint : joints.points.residuals_of_part(part))
      {
        openings.push_back(of_joint.opening);
        slips.push_back(of_joint.slip);
      }
      all.add("part " + std::to_string(part + 1),
              json.add_list("openings", openings).add_list("slips", slips));
    }
    return all;
  }

  void JointObserver::save(boost::archive::binary_oarchive &archive) const
  {
    archive << joints;
  }

  void JointObserver::load(boost::archive::binary_iarchive &archive)
  {
    archive >> joints;
  }
} // namespace Voussoir
