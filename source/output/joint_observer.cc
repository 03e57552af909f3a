// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/output/archive.h>
#include <voussoir/output/assessment.h>
#include <voussoir/output/observers.h>

namespace Voussoir
{
  JointObserver::JointObserver(const RunState &run) : joints(run.dam->structure, *run.dam->geometry), run(run)
  {
    const Structure &structure = run.dam->structure;
    const Scene     &scene = run.scene();
    joints.reach = JointReach(*run.dam->model, structure.pairs);
    joints.points =
        JointPoints(*run.dam->model, structure.pairs, structure.n_joints, scene.limits.waterstop_depth);
    joints.keys = KeyForces(structure, scene.joints);
  }

  void JointObserver::open(const std::string &directory)
  {
    file.open(directory + "/joint_history.csv", joints.history);
  }

  void JointObserver::write_tables(const std::string &directory)
  {
    flush();
    joints.maxima().write(directory + "/joints.csv");
    if (!run.dam->structure.pairs.empty())
      joints.points.write(directory, *run.dam->geometry);
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
  }

  void JointObserver::add_extremes(Json &json) const
  {
    json.add("max_opening", json_of(joints.opening)).add("max_slip", json_of(joints.slip));
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
