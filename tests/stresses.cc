// SPDX-License-Identifier: GPL-3.0-or-later
// Stresses where tractions are known: on faces, edges and corners, and at joints.

#include <voussoir/base/lanes.h>
#include <voussoir/dam/dam_loads.h>
#include <voussoir/dam/face_pressure.h>
#include <voussoir/dam/load_table.h>
#include <voussoir/dam/tractions.h>
#include <voussoir/joints/joint_system.h>
#include <voussoir/joints/pairs.h>
#include <voussoir/mesh/mesh_joints.h>
#include <voussoir/output/archive.h>
#include <voussoir/output/face_tension.h>
#include <voussoir/solid/face_quads.h>
#include <voussoir/solid/initial_strain.h>
#include <voussoir/solid/stress.h>
#include <voussoir/solid/traction_condition.h>

#include "grids.h"
#include "testing.h"

#include <algorithm>
#include <sstream>
#include <utility>

using namespace Voussoir;
using namespace Testing;

namespace
{
  constexpr double thick = 10., wide = 20., tall = 30.;

  Unknowns field(const SolidModel &model, const std::function<Vector3(const Vector3 &)> &u)
  {
    Unknowns result(3 * std::size_t(model.first_equation.back()));
    for (unsigned int i = 0; i < model.n_nodes(); ++i)
      if (model.equation[i] != rigid_ground)
        for (unsigned int c = 0; c < 3; ++c)
          result[3 * model.equation[i] + c] = u(model.points[i])[c];
    return result;
  }

  Vector3 traction(const Stress &s, const Vector3 &n)
  {
    return {{s[0] * n[0] + s[3] * n[1] + s[5] * n[2], s[3] * n[0] + s[1] * n[1] + s[4] * n[2],
             s[5] * n[0] + s[4] * n[1] + s[2] * n[2]}};
  }

  /** A uniform stress on distorted elements stays, if the tractions are its own. */
  void patch()
  {
    Material m;
    m.young = 25e9;
    m.poisson = .2;
    const auto distort = [](const Vector3 &x) {
      return Vector3{{x[0] + .4 * std::sin(x[1] + x[2]), x[1] + .5 * std::sin(x[0] + x[2]), x[2]}};
    };
    const double e[6] = {1e-5, -2e-5, 4e-5, 3e-5, -1e-5, 2e-5};
    for (const unsigned int degree : {1, 2})
    {
      SolidModel model(Grids::wall({{thick, wide, tall}}, {{2, 3, 3}}, 3, distort), degree);
      model.free_base();
      const Unknowns u = field(
          model,
          [&](const Vector3 &x) {
            return Vector3{{e[0] * x[0] + e[3] * x[1], e[1] * x[1] + e[4] * x[2], e[2] * x[2] + e[5] * x[0]}};
          });
      const std::vector<NodeFace> faces = faces_at_nodes(model);
      std::vector<Stress>         plain, known;
      StressRecovery(model, {m}, true).apply(u, {}, plain);
      std::vector<Vector3> tractions;
      for (const NodeFace &face : faces)
        tractions.push_back(traction(plain[face.node], face.normal));
      StressRecovery(model, {m}, true, faces, true).apply(u, tractions, known);
      double change = 0.;
      for (std::size_t i = 0; i < known.size(); ++i)
        for (unsigned int c = 0; c < 6; ++c)
          change = std::max<double>(change, std::abs(known[i][c] - plain[i][c]));
      below("uniform stress with its tractions, degree " + std::to_string(degree), change / 1e6, 5e-5);
    }
  }

  /** A corner of three planes gives all six components; an edge leaves the strain along it; a plane those in
   * it. */
  void corner()
  {
    const double                              nu = .17, s[6] = {1., -2., 3., .4, -.5, .6};
    const std::array<std::vector<Vector3>, 3> planes = {{{{{1., 0., 0.}}},
                                                         {{{1., 0., 0.}}, {{0., .8, .6}}},
                                                         {{{1., 0., 0.}}, {{0., .8, .6}}, {{.6, 0., .8}}}}};
    for (const auto &normals : planes)
    {
      const TractionCondition known(nu, normals);
      Stress                  result{};
      for (unsigned int c = 0; c < 6; ++c)
        for (std::size_t k = 0; k < normals.size(); ++k)
        {
          const Vector3 t = traction({{1.f, -2.f, 3.f, .4f, -.5f, .6f}}, normals[k]);
          for (unsigned int d = 0; d < 3; ++d)
            result[c] += known.of_traction[k][3 * c + d] * t[d];
        }
      double along = 0.; // strain along the edge, or, of one plane, along y
      if (normals.size() == 1)
        expect_within(result[1], nu / (1. - nu) * s[0], 1e-6, "plane stress of a pressed face");
      else if (normals.size() == 2)
        for (const double a : {-.6})
        {
          const double b = .8, edge = a * a * result[1] + b * b * result[2] + 2. * a * b * result[4];
          along = edge - nu * (result[0] + result[1] + result[2] - edge);
          expect_within(along, 0., 1e-6, "strain along an edge");
        }
      else
        for (unsigned int c = 0; c < 6; ++c)
          expect_within(result[c], s[c], 1e-6, "stress of a corner");
      for (const Vector3 &n : normals)
        for (unsigned int d = 0; d < 3; ++d)
          expect_within(traction(result, n)[d], traction({{1.f, -2.f, 3.f, .4f, -.5f, .6f}}, n)[d], 1e-6,
                        "traction");
    }
  }

  /** A thick ring under pressure from outside (Lame), its displacement that of the exact solution: the stress
   * on its faces. */
  void ring()
  {
    const double p = 1e6, a = 40., b = 50., nu = .2; // radii inside and outside
    Material     m;
    m.young = 25e9;
    m.poisson = nu;
    const auto bent = [&](const Vector3 &x)
    {
      const double r = b - x[0], angle = .02 * x[1];
      return Vector3{{-r * std::cos(angle), r * std::sin(angle), x[2]}};
    };
    SolidModel model(Grids::wall({{thick, wide, tall}}, {{2, 8, 3}}, 8, bent), 1);
    model.free_base();
    const double          A = -p * b * b / (b * b - a * a), B = a * a * A; // s_r = A - B/r^2, s_t = A + B/r^2
    const Unknowns        u = field(model,
                                    [&](const Vector3 &x)
                                    {
                               const double r = std::hypot(x[0], x[1]);
                               const double radial =
                                   (1. + nu) / m.young * ((1. - 2. * nu) * A * r + B / r); // plane strain
                               return Vector3{{radial * x[0] / r, radial * x[1] / r, 0.}};
                             });
    std::vector<NodeFace> faces;
    for (const NodeFace &face : faces_at_nodes(model))
      if (face.surface == PhysicalId::upstream || face.surface == PhysicalId::downstream)
        faces.push_back(face);
    std::vector<Vector3> tractions;
    for (const NodeFace &face : faces)
    {
      const double pressure = face.surface == PhysicalId::upstream ? p : 0.;
      tractions.push_back(
          {{-pressure * face.normal[0], -pressure * face.normal[1], -pressure * face.normal[2]}});
    }
    std::vector<Stress> plain, known;
    StressRecovery(model, {m}, true).apply(u, {}, plain);
    StressRecovery(model, {m}, true, faces).apply(u, tractions, known);
    double missed = 0., hoop[2] = {0., 0.}, normal = 0.;
    for (std::size_t f = 0; f < faces.size(); ++f)
    {
      const NodeFace &face = faces[f];
      const Vector3   miss = traction(known[face.node], face.normal) - tractions[f];
      missed = std::max(missed, norm(miss));
      normal = std::max(normal, norm(traction(plain[face.node], face.normal) - tractions[f]));
      const Vector3 t = {{-face.normal[1], face.normal[0], 0.}};
      const double  r = face.surface == PhysicalId::upstream ? b : a, exact = A + B / (r * r);
      if (std::abs(model.points[face.node][1]) > 1. && std::abs(model.points[face.node][1]) < 15.)
        for (const bool with : {false, true})
          hoop[with] =
              std::max(hoop[with], std::abs(dot(t, traction((with ? known : plain)[face.node], t)) - exact) /
                                       std::abs(exact));
    }
    below("ring: traction on its faces, of the pressure", missed / p, 1e-5);
    above("ring: the same from strains alone", normal / p, .1);
    below("ring: hoop stress", hoop[true], .01);
    note("ring: the same from strains alone", hoop[false]);
  }

  /** The same ring with elements of degree 2: the arch stress is the hoop stress, the two others that of plane
   * strain, 2 nu A. */
  void ring_in_faces()
  {
    const double p = 1e6, a = 40., b = 50., nu = .2, A = -p * b * b / (b * b - a * a), B = a * a * A;
    Material     m;
    m.young = 25e9;
    m.poisson = nu;
    const auto bent = [&](const Vector3 &x)
    {
      const double r = b - x[0], angle = .02 * x[1];
      return Vector3{{-r * std::cos(angle), r * std::sin(angle), x[2]}};
    };
    SolidModel model(Grids::wall({{thick, wide, tall}}, {{4, 8, 3}}, 8, bent), 2);
    model.free_base();
    const Unknowns      u = field(model,
                                  [&](const Vector3 &x)
                                  {
                               const double r = std::hypot(x[0], x[1]);
                               const double radial = (1. + nu) / m.young * ((1. - 2. * nu) * A * r + B / r);
                               return Vector3{{radial * x[0] / r, radial * x[1] / r, 0.}};
                             });
    std::vector<Stress> stress, exact;
    StressRecovery(model, {m}, true).apply(u, {}, stress);
    for (const auto &x : model.points)
    {
      const double r = std::hypot(x[0], x[1]), c = x[0] / r, s = x[1] / r, radial = A - B / (r * r),
                   hoop = A + B / (r * r);
      exact.push_back({{float(radial * c * c + hoop * s * s), float(radial * s * s + hoop * c * c),
                        float(2. * nu * A), float((radial - hoop) * c * s), 0.f, 0.f}});
    }
    const FaceDirections faces(model);
    double               error[2][FaceDirections::n_stresses] = {};
    for (const NodeOnFace &at : faces.nodes)
      if (const auto &x = model.points[at.node];
          std::abs(std::atan2(x[1], -x[0]) - .2) < .19) // not at the ends, whose normals are of one side
      {
        const double r = std::hypot(x[0], x[1]), known[] = {A + B / (r * r), 2. * nu * A, 2. * nu * A};
        for (const bool of_elements : {false, true})
          for (unsigned int k = 0; k < FaceDirections::n_stresses; ++k)
          {
            const double now = at.stresses((of_elements ? stress : exact)[at.node])[k];
            error[of_elements][k] = std::max(error[of_elements][k], std::abs(now / known[k] - 1.));
          }
      }
    expect(faces.nodes.size() == 2 * 17 * 7, "nodes of both faces");
    for (unsigned int k = 0; k < FaceDirections::n_stresses; ++k)
    {
      below(std::string("ring: ") + FaceDirections::name(k) + " stress of the exact tensor", error[0][k],
            1e-6);
      below("  of elements of degree 2", error[1][k], .003);
    }
  }

  /** Faces that lean and are not parallel to the y axis, x = .75 z + .3 y: a uniform stress of a linear
   * displacement, and then its opposite. The arch direction is (.3, 1, 0), the steepest ascent (.75/1.09,
   * -.3 .75/1.09, 1). */
  void leaning_faces()
  {
    Material m;
    m.young = 25e9;
    m.poisson = .2;
    const auto lean = [](const Vector3 &x)
    {
      const double y = x[1] + .5 * std::sin(x[0] + x[2]);
      return Vector3{{x[0] + .75 * x[2] + .3 * y, y, x[2]}};
    };
    const double e[6] = {1e-5, -2e-5, 4e-5, 3e-5, -1e-5, 2e-5}, trace = e[0] + e[1] + e[2];
    const double shear = m.young / 2. / (1. + m.poisson),
                 lame = m.young * m.poisson / (1. + m.poisson) / (1. - 2. * m.poisson);
    const double  rise = .75 / 1.09;
    const Vector3 tangents[] = {{{.3, 1., 0.}}, {{rise, -.3 * rise, 1.}}, {{0., 0., 1.}}};
    Stress        uniform;
    for (unsigned int c = 0; c < 6; ++c)
      uniform[c] = float(c < 3 ? lame * trace + 2. * shear * e[c] : shear * e[c]);
    for (const unsigned int degree : {1, 2})
    {
      SolidModel model(Grids::wall({{thick, wide, tall}}, {{2, 3, 3}}, 3, lean), degree);
      model.free_base();
      Unknowns u = field(
          model,
          [&](const Vector3 &x) {
            return Vector3{{e[0] * x[0] + e[3] * x[1], e[1] * x[1] + e[4] * x[2], e[2] * x[2] + e[5] * x[0]}};
          });
      const StressRecovery recovery(model, {m}, true);
      EnvelopeRecorder     envelope(recovery, std::vector<Stress>(model.n_nodes(), Stress{}));
      envelope.faces = FaceEnvelope(model);
      envelope.record(1., u, {});
      for (double &x : u)
        x = -x;
      envelope.record(2., u, {});
      envelope.gather();
      double worst = 0.;
      for (std::size_t i = 0; i < envelope.faces.directions.nodes.size(); ++i)
        for (unsigned int k = 0; k < FaceDirections::n_stresses; ++k)
        {
          const double exact =
              dot(tangents[k], traction(uniform, tangents[k])) / dot(tangents[k], tangents[k]);
          for (const bool largest : {true, false})
          {
            const auto [value, time] = envelope.faces.extreme(i, k, largest);
            worst = std::max(worst, std::abs(value - (largest ? 1. : -1.) * std::abs(exact)));
            expect(time == (largest == (exact > 0.) ? 1.f : 2.f), "time of the extreme");
          }
        }
      below("leaning faces: uniform stress, degree " + std::to_string(degree), worst / 1e6, 5e-5);
      expect(envelope.faces.directions.nodes.size() == 2 * std::pow(3 * degree + 1, 2),
             "nodes of both faces");
      const std::vector<float> arch = envelope.faces.field(model.n_nodes(), 0, true);
      for (unsigned int i = 0; i < model.n_nodes(); ++i)
        expect((arch[i] == 0.f) == !(model.on_surface(i, PhysicalId::upstream) ||
                                     model.on_surface(i, PhysicalId::downstream)),
               "the field has values on both faces only");
    }
  }

  /** Stresses of several times are computed together: the extremes equal those of each time alone, and those of the
   * stresses of StressRecovery. */
  void times_together()
  {
    Material m;
    m.young = 25e9;
    m.poisson = .2;
    SolidModel model(Grids::wall({{thick, wide, tall}}, {{2, 3, 3}}, 3), 1);
    model.free_base();
    const std::vector<NodeFace> faces = faces_at_nodes(model);
    const StressRecovery        recovery(model, {m}, true, faces);
    const std::vector<Stress>   none(model.n_nodes(), Stress{});
    EnvelopeRecorder            together(recovery, none), alone(recovery, none);
    for (EnvelopeRecorder *envelope : {&together, &alone})
      envelope->overstress = Overstress(1e6, model.n_nodes());
    std::vector<float>     largest(model.n_nodes(), -1e30f), time(largest);
    constexpr unsigned int n = 2 * most_lanes + 3;
    for (unsigned int t = 0; t < n; ++t)
    {
      const Unknowns             u = field(model,
                                           [&](const Vector3 &x)
                                           {
                                 return Vector3{{1e-3 * std::sin(x[1] + 3. * t), 1e-3 * std::cos(x[2] * t),
                                                 1e-3 * std::sin(x[0] - 2. * t)}};
                               });
      const std::vector<Vector3> tractions(faces.size(), Vector3{{1e5 * std::sin(t), 2e5, 1e5 * t}});
      std::vector<Stress>        stress;
      recovery.apply(u, tractions, stress);
      for (unsigned int i = 0; i < model.n_nodes(); ++i)
        if (const float now = principal_stresses(stress[i])[0]; now > largest[i])
          largest[i] = now, time[i] = static_cast<float>(.01 * t);
      together.record(.01 * t, u, tractions);
      alone.record(.01 * t, u, tractions);
      alone.gather();
    }
    together.gather();
    expect(together.maximum == largest && together.time_of_maximum == time,
           "largest stresses and their times");
    expect(together.minimum == alone.minimum && together.time_of_minimum == alone.time_of_minimum,
           "smallest stresses and their times");
    double sum = 0.;
    for (unsigned int i = 0; i < model.n_nodes(); ++i)
    {
      sum += alone.overstress.duration(i, 0);
      expect(together.overstress.duration(i, 0) == alone.overstress.duration(i, 0), "durations");
    }
    expect(sum > 0., "some nodes are above the strength");

    std::stringstream file; // the archive has the recorded state of together, but not that of loaded
    EnvelopeRecorder  loaded(recovery, none);
    const Unknowns    large = field(model, [](const Vector3 &x) { return Vector3{{x[2], 0., x[2]}}; });
    loaded.record(9., large, {});
    together.record(8., large, {});
    boost::archive::binary_oarchive(file) << std::as_const(together);
    boost::archive::binary_iarchive(file) >> loaded;
    loaded.gather();
    expect(loaded.maximum == together.maximum && loaded.time_of_maximum == together.time_of_maximum &&
               together.maximum != largest,
           "archive");
  }

  /** Two monoliths, the joint pressed by a force that is the work of a given pressure. */
  void joint(const unsigned int degree)
  {
    const HexMesh mesh = open_joints(Grids::wall({{thick, wide, tall}}, {{2, 4, 6}}, 2));
    SolidModel    model(mesh, degree);
    model.free_base();
    Structure structure = assemble_structure(model, {Material()}, true);
    structure.pairs = find_pairs(model, 1);
    const auto pressure = [](const Vector3 &x, const double slope)
    { return 2e6 + slope * (3e4 * x[0] - 5e4 * x[2]); };
    for (const double slope : {0., 1.})
    {
      // One dimension after the other: nodes of two elements along x, six along z, linear in each.
      Unknowns force(3 * structure.pairs.size());
      for (std::size_t i = 0; i < structure.pairs.size(); ++i)
      {
        const Pair &pair = structure.pairs[i];
        Vector3     x = pair.place; // where the mean of the node's shape function lies
        for (const auto &edge : {std::make_pair(0, thick), {2, tall}})
          if (degree == 1 && (x[edge.first] == 0. || x[edge.first] == edge.second))
            x[edge.first] += (x[edge.first] == 0. ? 5. : -5.) / 3.;
        force[3 * i] = pair.area * pressure(x, slope);
      }
      Tractions   tractions(model, structure, [](int, double, const Vector3 &) { return Vector3{}; });
      const auto &at = tractions.at(force);
      double      worst = 0., raw = 0.;
      for (std::size_t f = 0; f < at.size(); ++f)
      {
        const NodeFace &face = tractions.faces[f];
        const auto     &x = model.points[face.node];
        const bool      in_joint = is_joint_side(face.surface);
        const double    exact = in_joint ? -pressure({{x[0], x[1], x[2]}}, slope) : 0.;
        worst = std::max(worst, std::abs(dot(at[f], face.normal) - exact));
        expect_within(norm(at[f]), std::abs(dot(at[f], face.normal)), 1., "pressure alone");
      }
      for (std::size_t i = 0; i < structure.pairs.size(); ++i)
        raw = std::max(raw, std::abs(force[3 * i] / structure.pairs[i].area -
                                     pressure(structure.pairs[i].place, slope)));
      below("joint: pressure at its nodes, degree " + std::to_string(degree), worst / 2e6,
            slope == 0. ? 1e-12 : .45 * raw / 2e6 + 1e-12);
    }
    Unknowns half(3 * structure.pairs.size(), 0.); // open above: there is nothing, or round-off
    for (std::size_t i = 0; i < structure.pairs.size(); ++i)
      half[3 * i] = structure.pairs[i].place[2] < 14. ? 1e6 : i % 2 == 0 ? 0. : -1e-6;
    JointTractions joint(model, structure);
    const auto    &at = joint.at(half);
    for (std::size_t i = 0; i < at.size(); ++i)
      expect(half[3 * i] > 0. ? at[i][0] > 0. : std::abs(at[i][0]) <= -2. * half[3 * i] && at[i][1] == 0.,
             "no pressure where it is open");
  }

  /** A joint that is not normal to the upstream face, with the pressures p on the face and q in the joint.
   * Shear stresses are equal on the edge: t = -q n + (q - p) c/(1 - c^2) (m - c n) in the joint, with c =
   * m.n. At the crest the joint has two edges that are not orthogonal. */
  void skew_joint()
  {
    const double p = 1e6, q = 2e6;
    const auto   skew = [](const Vector3 &x) { return Vector3{{x[0] + .6 * x[1] + .5 * x[2], x[1], x[2]}}; };
    SolidModel   model(open_joints(Grids::wall({{thick, wide, tall}}, {{2, 4, 6}}, 2, skew)), 1);
    Structure    structure = assemble_structure(model, {Material()}, true);
    structure.pairs = find_pairs(model, 1);
    Unknowns force(3 * structure.pairs.size(), 0.);
    for (std::size_t i = 0; i < structure.pairs.size(); ++i)
      force[3 * i] = q * structure.pairs[i].area;
    Tractions                  tractions(model, structure,
                                         [&](const int surface, double, const Vector3 &n)
                                         { return scaled(surface == PhysicalId::upstream ? -p : 0., n); });
    const std::vector<Vector3> at = tractions.at(force);
    const Vector3              m = scaled(1. / std::hypot(1., .6, .5), {{-1., .6, .5}});
    double                     worst = 0., unequal = 0.;
    unsigned int               n_edge = 0, n_equal = 0;
    for (std::size_t f = 0; f < at.size(); ++f)
    {
      for (std::size_t g = 0; g < at.size(); ++g)
        if (const NodeFace &a = tractions.faces[f], &b = tractions.faces[g];
            a.node == b.node && is_joint_side(a.surface) && !is_joint_side(b.surface))
          unequal = std::max(unequal, std::abs(dot(at[f], b.normal) - dot(at[g], a.normal))), ++n_equal;
      if (const NodeFace &face = tractions.faces[f]; is_joint_side(face.surface) &&
                                                     model.on_surface(face.node, PhysicalId::upstream) &&
                                                     model.points[face.node][2] < tall - 1.)
      {
        const Vector3 &n = face.normal;
        const double   c = dot(m, n);
        Vector3        exact = scaled(-q, n);
        add(exact, scaled((q - p) * c / (1. - c * c), m - scaled(c, n)));
        worst = std::max(worst, norm(at[f] - exact));
        ++n_edge;
      }
    }
    below("shear stresses on both sides of edges and corners, of q", unequal / q, 1e-12);
    expect(n_equal == 2 * (2 * 6 + 3), "edges upstream, downstream and at the crest, with its corners");
    expect(n_edge == 2 * 5, "nodes of both sides on the edge");
    below("joint that is not normal to the face: its traction on the edge, of q", worst / q, 1e-12);
  }

  /** A wall under water that stands on its base: the tractions on all its faces are those that are known. */
  void dam()
  {
    SolidModel      model(Grids::wall({{thick, wide, tall}}, {{2, 4, 6}}, 4), 1);
    const Structure structure = assemble_structure(model, {Material()}, true);
    Scene           scene;
    scene.reservoir.level = 26.;
    scene.statics.gravity = 9.81;
    Unknowns load(3 * structure.n_nodes(), 0.), u;
    add_traction(
        model, PhysicalId::upstream,
        [&](const double z, const Vector3 &normal) { return water_traction(scene, 1., z, normal); }, load);
    JointSystem(structure, JointLaws(), ContactParameters(), {}).solve_free(load, u);
    Tractions            tractions(model, structure, known_traction(scene));
    const StressRecovery recovery(model, {Material()}, true, tractions.faces);
    std::vector<Stress>  stress;
    recovery.apply(u, tractions.at({}), stress);
    double worst = 0., push = 0.;
    for (const NodeFace &face : tractions.faces)
    {
      const double  depth = 26. - model.points[face.node][2];
      const bool    wet = face.normal[0] < -.9 && depth > 0.;
      const double  p = wet ? 9810. * depth : 0.;
      const Vector3 known = {{-p * face.normal[0], 0., 0.}};
      worst = std::max(worst, norm(traction(stress[face.node], face.normal) - known));
      push += wet;
    }
    const double size = *std::max_element(u.begin(), u.end()) * 21e9 / tall;
    below("wall under water: tractions on faces, edges, corners, of its stress", worst / size, 1e-5);
    expect(push == 5 * 5, "the nodes under water but those of the base");
  }

  /** A wall under its own weight on a base that neither bends nor holds it back (no Poisson's ratio): the
   * stress is linear, and so it is on the base. */
  void weight_on_base()
  {
    Material m;
    m.young = 25e9;
    m.poisson = 0.;
    const double foot = m.density * 9.81 * tall;
    for (const bool modes : {true, false})
      for (const unsigned int degree : {1, 2})
      {
        const auto graded = [](const Vector3 &x)
        {
          return Vector3{{x[0], x[1], x[2] * (.4 + .6 * x[2] / tall)}}; // lower elements are flatter
        };
        SolidModel      model(Grids::wall({{thick, wide, tall}}, {{2, 4, 4}}, 4, graded), degree);
        const Structure structure = assemble_structure(model, {m}, modes);
        Unknowns        load(3 * structure.n_nodes(), 0.), u;
        add_weight(structure, 9.81, load);
        JointSystem(structure, JointLaws(), ContactParameters(), {}).solve_free(load, u);
        std::vector<Stress> plain, known;
        StressRecovery(model, {m}, modes).apply(u, {}, plain);
        StressRecovery(model, {m}, modes, {}, true).apply(u, {}, known);
        double error = 0., without = 0.;
        for (unsigned int i = 0; i < model.n_nodes(); ++i)
          if (model.on_surface(i, PhysicalId::base))
          {
            error = std::max(error, std::abs(known[i][2] / foot + 1.));
            without = std::max(without, std::abs(plain[i][2] / foot + 1.));
          }
          else
            expect(known[i] == plain[i], "other nodes are as before");
        below("weight: stress on the base, degree " + std::to_string(degree), error, 1e-5);
        if (degree == 1)
          above("  from the lowest elements alone", without, .06);
      }
  }

  /** A prism under its own weight: cantilever and vertical stress are -rho g (h - z), the arch stress is zero.
   * The extremes away from the base are those of the crest and of the lowest node above a tenth of the height. */
  void weight_in_faces()
  {
    Material m;
    m.young = 25e9;
    m.poisson = 0.;
    SolidModel      model(Grids::wall({{thick, wide, tall}}, {{2, 4, 4}}, 4), 2);
    const Structure structure = assemble_structure(model, {m}, true);
    Unknowns        load(3 * structure.n_nodes(), 0.), u;
    add_weight(structure, 9.81, load);
    JointSystem(structure, JointLaws(), ContactParameters(), {}).solve_free(load, u);
    const StressRecovery recovery(model, {m}, true);
    EnvelopeRecorder     envelope(recovery, std::vector<Stress>(model.n_nodes(), Stress{}));
    envelope.faces = FaceEnvelope(model);
    envelope.record(0., u, {});
    envelope.gather();
    const double weight = m.density * 9.81;
    double       worst[FaceDirections::n_stresses] = {};
    for (std::size_t i = 0; i < envelope.faces.directions.nodes.size(); ++i)
      for (unsigned int k = 0; k < FaceDirections::n_stresses; ++k)
      {
        const double depth = tall - model.points[envelope.faces.directions.nodes[i].node][2];
        worst[k] = std::max(
            worst[k], std::abs(envelope.faces.extreme(i, k, false).first + (k == 0 ? 0. : weight * depth)));
      }
    for (unsigned int k = 0; k < FaceDirections::n_stresses; ++k)
      below(std::string("weight: ") + FaceDirections::name(k) + " stress, of that at the base",
            worst[k] / (weight * tall), 1e-5);
    const FaceTension tension(model);
    for (const int surface : {PhysicalId::upstream, PhysicalId::downstream})
    {
      const Extreme least = tension.extreme_away_from_base(envelope.faces, model, surface, 1, false);
      expect_close(least.value, -weight * (tall - 3.75), 1e-5, "cantilever stress away from the base");
      expect_close(least.place[2], 3.75, 1e-12, "its elevation");
      expect_within(least.place[0], surface == PhysicalId::upstream ? 0. : thick, 1e-12, "its face");
      expect_within(tension.extreme_away_from_base(envelope.faces, model, surface, 1, true).value, 0., 10.,
                    "cantilever stress at the crest");
    }
    expect(
        std::isnan(tension.extreme_away_from_base(envelope.faces, model, PhysicalId::crest, 0, true).value),
        "no node");
  }

  /** A linear stress on a sheared mesh with Poisson's ratio, from its exact displacement: all components on
   * the base. */
  void linear_on_base()
  {
    Material m;
    m.young = 25e9;
    m.poisson = .2;
    const double slope = -2400. * 9.81; // of the vertical stress [Pa/m]; sheared along x, planes stay level
    SolidModel   model(Grids::wall({{thick, wide, tall}}, {{2, 4, 5}}, 4,
                                   [](const Vector3 &x) {
                                   return Vector3{{x[0] + .3 * x[2], x[1], x[2] * (.5 + .5 * x[2] / tall)}};
                                 }),
                       1);
    model.free_base();
    const Unknowns      u = field(model,
                                  [&](const Vector3 &x)
                                  {
                               const double k = slope / m.young, z = x[2] - tall;
                               return Vector3{{-m.poisson * k * z * x[0], -m.poisson * k * z * x[1],
                                               .5 * k * (z * z + m.poisson * (x[0] * x[0] + x[1] * x[1]))}};
                             });
    std::vector<Stress> plain, known;
    StressRecovery(model, {m}, true).apply(u, {}, plain);
    StressRecovery(model, {m}, true, {}, true).apply(u, {}, known);
    double error[2] = {0., 0.};
    for (unsigned int i = 0; i < model.n_nodes(); ++i)
      if (model.on_surface(i, PhysicalId::base))
        for (unsigned int c = 0; c < 6; ++c)
          for (const bool with : {false, true})
            error[with] = std::max<double>(error[with],
                                           std::abs((with ? known : plain)[i][c] + (c == 2) * slope * tall) /
                                               std::abs(slope * tall));
    below("linear stress with Poisson's ratio on the base", error[true], .003);
    above("  from the lowest elements alone", error[false], .05);
  }

  /** Concrete that expands, linear in the height, on a base that is free: no stress, on the base neither. */
  void expansion_on_base()
  {
    Material m;
    m.young = 25e9;
    m.poisson = .2;
    SolidModel model(Grids::wall({{thick, wide, tall}}, {{2, 4, 5}}, 4), 1);
    model.free_base();
    std::vector<double> strain;
    for (const auto &x : model.points)
      strain.push_back(1e-5 * (3. + x[2]));
    const InitialStrain free = initial_strain(model, {m}, true, strain, true);
    const Unknowns      u =
        field(model,
              [](const Vector3 &x)
              {
                const double e = 1e-5 * (3. + x[2]);
                return Vector3{{e * x[0], e * x[1],
                                1e-5 * (3. * x[2] + .5 * (x[2] * x[2] - x[0] * x[0] - x[1] * x[1]))}};
              });
    std::vector<Stress> stress;
    StressRecovery(model, {m}, true, {}, true).apply(u, {}, stress);
    double worst = 0.;
    for (unsigned int i = 0; i < model.n_nodes(); ++i)
      for (unsigned int c = 0; c < 6; ++c)
        worst = std::max<double>(worst, std::abs(stress[i][c] + free.stress[i][c]));
    below("free expansion, of E times the strain", worst / (m.young * 1e-5 * 30.), 1e-5);
  }

  /** Water that moves with a leaning wall: its pressure opposes the acceleration into it, and on the whole
   * face it is the force of the added mass in the equations of motion. */
  void moving_water()
  {
    const double        level = 24., lean = .2;
    SolidModel          model(Grids::wall({{thick, wide, tall}}, {{2, 4, 60}}, 4,
                                          [=](const Vector3 &x) {
                                   return Vector3{{x[0] + lean * x[2], x[1], x[2]}};
                                 }),
                              1);
    Structure           structure = assemble_structure(model, {Material()}, true);
    ReservoirParameters water;
    water.level = level;
    water.factor = .6;
    add_added_mass(model, water, structure);
    Tractions tractions(
        model, structure, [](int, double, const Vector3 &) { return Vector3{}; }, {}, {},
        added_mass_per_area(model, water));
    const auto     acceleration = [&](const Vector3 &x) { return Vector3{{-2. + .1 * x[1], .7, 1.3}}; };
    const Unknowns a = field(model, acceleration);
    const std::vector<Vector3> still = tractions.at({}), moved = tractions.at({}, a);
    std::vector<Vector3>       of_node(model.n_nodes());
    double                     worst = 0.;
    unsigned int               n_wet = 0;
    for (std::size_t f = 0; f < moved.size(); ++f)
    {
      const NodeFace &face = tractions.faces[f];
      const auto     &x = model.points[face.node];
      const bool      is_wet = face.surface == PhysicalId::upstream && x[2] < level;
      const double    w = is_wet ? .6 * 7. / 8. * 1000. * std::sqrt(level * (level - x[2])) : 0.;
      const Vector3   t = scaled(-w * dot(face.normal, acceleration(x)), face.normal);
      worst = std::max({worst, norm(moved[f] - t), norm(still[f])});
      n_wet += is_wet;
      if (is_wet)
      {
        of_node[face.node] = moved[f];
        expect(face.normal[0] < 0. && moved[f][0] > 0., "pushed downstream by the water it goes into");
      }
    }
    expect(n_wet == 5 * 47, "the nodes under water but those of the base");
    below("moving water: -w (n.a) n on its faces, nothing elsewhere [Pa]", worst, 1e-9);
    Vector3 pressed{}, inertia{};
    for (const FaceQuad &quad : face_quads(model, PhysicalId::upstream))
      for (const unsigned int node : quad.nodes)
        add(pressed, scaled(area(model, quad) / 4., of_node[node]));
    for (unsigned int i = 0; i < structure.n_nodes(); ++i)
      add(inertia, scaled(-1., structure.added_mass[i] * get(a, i)));
    below("  resultant against that of the added mass", norm(pressed - inertia) / norm(inertia), .01);
  }

  /** Velocities count from the base, which is accelerated, too. */
  void mean_accelerations()
  {
    const Unknowns a = mean_acceleration({1., 2., 3., 0., 0., 0.}, {3., 2., 1., 0., 0., .5}, .5,
                                         {{1., 0., -2.}}, {{3., 0., 4.}}),
                   expected = {6., 0., -3., 2., 0., 2.};
    for (std::size_t k = 0; k < 6; ++k)
      expect_within(a[k], expected[k], 1e-14, "mean acceleration");
  }
} // namespace

int main()
{
  return run({{"patch", patch},
              {"corner", corner},
              {"ring", ring},
              {"arch stress of a ring", ring_in_faces},
              {"leaning faces", leaning_faces},
              {"times together", times_together},
              {"joint of degree 1", [] { joint(1); }},
              {"joint of degree 2", [] { joint(2); }},
              {"joint that is not normal to the face", skew_joint},
              {"dam", dam},
              {"weight on the base", weight_on_base},
              {"weight in the faces", weight_in_faces},
              {"linear stress on the base", linear_on_base},
              {"expansion on the base", expansion_on_base},
              {"moving water", moving_water},
              {"mean acceleration", mean_accelerations}});
}
