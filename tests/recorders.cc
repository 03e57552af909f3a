// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers that a run reports, of given forces, stresses and movements: against integrals by hand.

#include <voussoir/contact/law_table.h>
#include <voussoir/dam/scene.h>
#include <voussoir/dynamics/newmark.h>
#include <voussoir/joints/pairs.h>
#include <voussoir/mesh/mesh_joints.h>
#include <voussoir/output/face_tension.h>

#include "grids.h"
#include "testing.h"

using namespace Voussoir;
using namespace Testing;

namespace
{
  constexpr double thick = 10., wide = 20., tall = 30.;

  /** A wall of two monoliths, with a joint in its middle. */
  struct Wall
  {
    explicit Wall(const std::array<unsigned int, 3> &n = {{2, 4, 6}}, const unsigned int degree = 1,
                  const std::function<Vector3(const Vector3 &)> &place = nullptr)
        : model(open_joints(Grids::wall({{thick, wide, tall}}, n, n[1] / 2, place)), degree),
          structure(assemble_structure(model, {Material()}, true))
    {
      structure.pairs = find_pairs(model, 1);
      structure.n_joints = 1;
      structure.collect_interfaces();
      geometry = std::make_unique<DamGeometry>(model, structure.pairs, 1, "wall");
    }

    SolidModel                   model;
    Structure                    structure;
    std::unique_ptr<DamGeometry> geometry;
  };

  /** Two records of a pressure that grows with the height, the second one half of the first. */
  void joint_pressures()
  {
    const Wall wall;
    JointLaws  laws;
    laws.of_joint.push_back(make_joint_law("FJA", LawParameters(.8)));
    laws.assign(wall.structure);
    JointRecorder  recorder(wall.structure, *wall.geometry);
    const Unknowns none(3 * wall.structure.n_nodes(), 0.), closed(3 * wall.structure.pairs.size(), 0.);
    for (const double part : {1., .5})
    {
      Unknowns force = closed;
      for (std::size_t p = 0; p < wall.structure.pairs.size(); ++p)
        force[3 * p] = part * (1e6 + 1e5 * wall.structure.pairs[p].place[2]) * wall.structure.pairs[p].area;
      Newmark newmark(wall.structure, laws, ContactParameters(), .01, ImpactRule::mean_force);
      newmark.start(none, none, force, none, closed);
      recorder.record(newmark);
    }
    // The pairs at z = 5, 10, ... 25 have 5 m of the height, those of the crest 2.5 m. Nodes at z = 0 are
    // fixed.
    const double mean = 1e6 + 1e5 * (5. * (5. + 10. + 15. + 20. + 25.) + 2.5 * 30.) / 27.5;
    const auto   rows = recorder.pressures().rows;
    expect(rows.size() == 1, "joints");
    expect_close(rows[0][2], 4e6, 1e-12, "largest pressure");
    expect_close(rows[0][5], tall, 1e-12, "its height");
    expect_close(rows[0][7], .75 * mean, 1e-12, "mean pressure over joint and time");
  }

  /** Envelopes on the upstream face of 20 m x 30 m: its nodes at z = 0, 5, ... 30. */
  void face_tensions()
  {
    const Wall                wall;
    const StressRecovery      recovery(wall.model, {Material()}, true);
    const std::vector<Stress> still(wall.model.n_nodes(), Stress{});
    EnvelopeRecorder          a(recovery, still);
    for (unsigned int i = 0; i < wall.model.n_nodes(); ++i)
    {
      const double z = wall.model.points[i][2];
      a.maximum[i] = z < 1. ? 9e6f : z < 12. ? .9e6f : 2e6f;
    }
    const FaceTension tension(wall.model);
    // Nodes at z = 15, 20, 25 and 30, and those at z = 0.
    const FaceTension::Part part = tension.above(a, PhysicalId::upstream, 1e6);
    expect_close(part.whole, wide * tall, 1e-12, "area of the face");
    expect_close(part.area, wide * (2.5 + 3 * 5. + 2.5), 1e-12, "area above the strength, with the base");
    expect_close(part.share(), 20. / 30., 1e-12, "its share");
    expect_close(tension.largest_away_from_base(a, wall.model, PhysicalId::upstream).value, 2e6, 1e-6,
                 "largest tension away from the base");
    expect_close(tension.headline(a), 2e6, 1e-6, "the larger one of both faces");
  }

  /** The joint whose keys carry the larger stress, not the larger force. */
  void key_forces()
  {
    Structure structure;
    structure.n_joints = 2;
    for (const auto &[joint, area] : {std::make_pair(0u, 50.), {0u, 50.}, {1u, 4.}, {1u, 6.}})
    {
      Pair pair{};
      pair.joint = joint;
      pair.area = area;
      structure.pairs.push_back(pair);
    }
    KeyForces keys(structure, {"KSM", "KSM", "KSM"}, .5);
    keys.record(1., {10., 3., 4., -20., 6., 8., 2., 3., 4., 100., 20., 21.}); // 0 + 10; 4 + 0
    keys.record(2., {10., 3., 4., 0., 0., 3., 0., 0., 0., 0., 0., 0.});       // 0 + 3; 0
    expect(keys.joints.size() == 2, "joints with keys");
    expect_close(keys.joints[0].force, 10., 1e-12, "force of the first joint's keys");
    expect_close(keys.joints[1].force, 4., 1e-12, "force of the second joint's keys");
    expect_close(keys.joints[0].stress(), .1, 1e-12, "stress of the first joint's keys");
    expect_close(keys.joints[1].stress(), .4, 1e-12, "stress of the second joint's keys");
    expect(keys.worst().joint == 1 && keys.worst().time == 1., "the worst joint and its time");
  }

  /** A wall whose faces lean by 3 to 4: a point x m behind the upstream face is .8 x deep. Movements are
   * linear in x, and largest at z = 20. */
  void waterstops()
  {
    const Wall  wall({{2, 4, 6}}, 1,
                     [](const Vector3 &x) {
                      return Vector3{{x[0] + .75 * x[2], x[1], x[2]}};
                    });
    JointPoints points(wall.model, wall.structure.pairs, 1, 2.);
    expect(points.has_waterstops(), "waterstops");
    for (std::size_t p = 0; p < wall.structure.pairs.size(); ++p)
    {
      const Vector3 &at = wall.structure.pairs[p].place;
      const double   x = at[0] - .75 * at[2], part = 1. - std::abs(at[2] - 20.) / 40.;
      points.record(p, {{part * (.001 + .003 * x), part * (.01 + .002 * x), part * (.02 - .001 * x)}});
    }
    points.end_record(3.);
    expect_close(points.waterstop_opening.value, .001 + .003 * 2.5, 1e-12, "opening at the waterstop");
    expect_close(points.waterstop_slip.value, std::hypot(.015, .0175), 1e-12, "slip at the waterstop");
    const Vector3 &place = points.waterstop_slip.place;
    expect(points.waterstop_slip.time == 3. && std::abs(place[0] - 17.5) < 1e-12 &&
               std::abs(place[2] - 20.) < 1e-12,
           "its place and time");
    expect_close(points.residual(true).value, std::hypot(.03, .01), 1e-12, "slip that remains");
    points.write(".", *wall.geometry,
                 std::vector<Vector3>(wall.structure.pairs.size(), Vector3{{1., 2., 3.}}));
    std::ifstream in("joint_points.csv");
    std::string   line;
    std::getline(in, line);
    unsigned int n = 0;
    while (std::getline(in, line))
    {
      std::istringstream  text(line);
      std::vector<double> row;
      for (std::string word; std::getline(text, word, ',');)
        row.push_back(std::stod(word));
      if (const double x = row[1] - .75 * row[3]; row[3] < 25.1) // above, the crest's edge is the nearest
      {
        expect_within(row[5], .8 * x, 1e-6, "depth");
        ++n;
      }
    }
    expect(n == 3 * 5, "pairs below the crest's region");
  }

  /** Shortest edges of the joint's faces are 2.5 m; of degree 2, nodes are half of that apart. */
  void reach()
  {
    for (const unsigned int degree : {1, 2})
    {
      const Wall wall({{4, 4, 6}}, degree);
      JointReach reach(wall.model, wall.structure.pairs);
      for (const double width : reach.widths())
        expect_close(width, 2.5 / degree, 1e-12, "width at a pair");
      const Pair &pair = wall.structure.pairs[3];
      reach.record(3, pair, {{.1 / degree, .72 / degree, .96 / degree}}); // 1.2 of 2.5
      expect(reach.warnings().empty(), "a slip of less than half of the width");
      reach.record(3, pair, {{.3 / degree, 1.2 / degree, 1.6 / degree}});
      const std::vector<std::string> warnings = reach.warnings();
      expect(warnings.size() == 1, "a slip of more than half of the width");
      for (const std::string &part :
           {std::string("joint 1 has slipped by ") + text(2. / degree), std::string("0.8 times")})
        expect(warnings[0].find(part) != std::string::npos, "'" + part + "' is missing in: " + warnings[0]);
    }
  }
} // namespace

int main(int argc, char **argv)
{
  return run({{"joint pressures", joint_pressures},
              {"tension on faces", face_tensions},
              {"forces of keys", key_forces},
              {"waterstops", waterstops},
              {"reach of joints", reach}},
             argc, argv);
}
