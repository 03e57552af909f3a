// SPDX-License-Identifier: GPL-3.0-or-later
// A joint whose shear keys are meshed, law FJA on its faces and flanks, against a flat joint with the law
// KSM: two blocks of 4 m x 2 m x 2 m with one trapezoidal key, 20 cm high. The numbers are those of
// doc/keys.md.

#include "blocks.h"

#include <voussoir/contact/law_table.h>
#include <voussoir/dam/scene.h>
#include <voussoir/mesh/mesh_joints.h>

using namespace Columns;

namespace
{
  constexpr double height = .2, length = 4., half_width = 1., half_crest = .25; // [m]
  constexpr double pressing_force = 4e5;                                        // [N]: 0.1 MPa

  /** Blocks on both sides of the joint at y = 0, along y; the key of block 1 runs along z, with flanks at
   *  @p angle to y. Height 0: the same mesh with a flat joint. */
  HexMesh keyed_blocks(const double angle, const double key_height, const unsigned int refine)
  {
    const double        foot = half_crest + height * std::tan(angle * pi / 180.);
    const double        corners[] = {-half_width, -foot, -half_crest, half_crest, foot, half_width};
    const unsigned int  parts[] = {2, 1, 2, 1, 2};
    std::vector<double> x(1, -half_width), joint(1, 0.);
    for (unsigned int i = 0; i < 5; ++i)
      for (unsigned int k = 1; k <= parts[i] * refine; ++k)
      {
        const double t = double(k) / (parts[i] * refine);
        x.push_back(corners[i] + t * (corners[i + 1] - corners[i]));
        joint.push_back(key_height * (i == 1 ? t : i == 2 ? 1. : i == 3 ? 1. - t : 0.));
      }
    const unsigned int n_x = x.size(), n_y = 8 * refine + 1, n_z = 2 * refine + 1;
    HexMesh            mesh;
    for (unsigned int j = 0; j < 2 * n_y - 1; ++j) // shared nodes: the program opens the joint
      for (unsigned int i = 0; i < n_x; ++i)
        for (unsigned int k = 0; k < n_z; ++k)
        {
          const double t = std::abs(double(j) / (n_y - 1) - 1.), s = std::pow(t, 1.5); // finer at the joint
          mesh.nodes.push_back(
              {x[i], (j < n_y ? -s : s) * length + (1. - s) * joint[i], 2. * k / (n_z - 1.)});
        }
    const auto node = [&](const unsigned int i, const unsigned int j, const unsigned int k)
    { return (j * n_x + i) * n_z + k; };
    for (unsigned int j = 0; j + 1 < 2 * n_y - 1; ++j)
      for (unsigned int i = 0; i + 1 < n_x; ++i)
        for (unsigned int k = 0; k + 1 < n_z; ++k)
          mesh.cells.push_back(
              {{node(i, j, k), node(i + 1, j, k), node(i + 1, j + 1, k), node(i, j + 1, k), node(i, j, k + 1),
                node(i + 1, j, k + 1), node(i + 1, j + 1, k + 1), node(i, j + 1, k + 1)},
               j + 1 < n_y ? 1 : 2});
    for (const unsigned int j : {0u, 2 * n_y - 2}) // the far ends
      for (unsigned int i = 0; i + 1 < n_x; ++i)
        for (unsigned int k = 0; k + 1 < n_z; ++k)
          mesh.faces.push_back({{node(i, j, k), node(i + 1, j, k), node(i + 1, j, k + 1), node(i, j, k + 1)},
                                PhysicalId::base});
    return open_joints(mesh);
  }

  /** The far end of block 2 moves as a rigid plate, that of block 1 is held. */
  class Press
  {
  public:
    Press(const HexMesh &mesh, const std::string &law, const double face_friction, const KeyParameters &keys)
        : model(mesh, 1), structure(with_joints(model, {Material()}))
    {
      laws.of_joint.push_back(
          make_joint_law(law, LawParameters(face_friction, Equations::alart_curnier, keys)));
      laws.assign(structure);
      system = std::make_unique<JointSystem>(structure, laws, tight(), StepOperator());
      force.assign(3 * structure.pairs.size(), 0.);
      gap = force;
      memory = laws.initial_memory();
    }

    /** Moves the plate from the last accepted state to the displacement (x, y) [m]. */
    void move(const double x, const double y)
    {
      Unknowns     offset(gap.size()), u;
      const double d[] = {x, y, 0.};
      for (std::size_t p = 0; p < structure.pairs.size(); ++p)
        for (unsigned int i = 0; i < 3; ++i)
          for (unsigned int c = 0; c < 3; ++c)
            offset[3 * p + i] += structure.pairs[p].frame[i][c] * d[c];
      trial_force = force;
      result = system->solve(Unknowns(3 * structure.n_nodes(), 0.), offset, gap, memory, trial_force,
                             trial_gap, u);
      unconverged += !result.converged;
      iterations += result.iterations;
      worst = std::max(worst, result.residual);
      total = {};
      for (std::size_t p = 0; p < structure.pairs.size(); ++p)
        for (unsigned int i = 0; i < 3; ++i)
          for (unsigned int c = 0; c < 3; ++c)
            total[c] -= structure.pairs[p].frame[i][c] * trial_force[3 * p + i];
    }
    void accept()
    {
      laws.commit(gap, false, trial_force, trial_gap, memory);
      force = trial_force;
      gap = trial_gap;
    }
    /** Moves the plate to x, with y such that it is pressed by @p N. Returns y. */
    double push(const double x, const double N, double y)
    {
      double y_before = y, N_before = 0.;
      for (unsigned int i = 0; i < 40; ++i)
      {
        move(x, y);
        const double N_now = -total[1];
        if (std::abs(N_now - N) < 1e-7 * N)
          break;
        const double slope =
            i == 0 || y == y_before || N_now == N_before ? -stiffness : (N_now - N_before) / (y - y_before);
        y_before = y, N_before = N_now;
        y += std::max(-2e-4, std::min(2e-4, (N - N_now) / (slope < -.02 * stiffness ? slope : -stiffness)));
      }
      missed_force = std::max(missed_force, std::abs(-total[1] / N - 1.));
      accept();
      return y;
    }

    SolidModel                   model;
    Structure                    structure;
    JointLaws                    laws;
    std::unique_ptr<JointSystem> system;
    Unknowns                     force, gap, memory, trial_force, trial_gap;
    Vector3                      total{}; ///< on the plate, from outside [N]
    ContactResult                result;
    unsigned int                 unconverged = 0, iterations = 0;
    double                       worst = 0., missed_force = 0.;
    const double stiffness = Material().young * 4. / 8.; ///< of the blocks along y, about [N/m]
  };

  KeyParameters keys_of(const double angle, const double friction, const double seat)
  {
    KeyParameters keys;
    keys.height = height;
    keys.flank_angle = angle;
    keys.direction = "radial";
    keys.friction = friction;
    keys.seat_compliance = seat;
    return keys;
  }

  /** Seat compliance of a scene without that entry [m/Pa]. */
  double default_seat()
  {
    JointParameters joints;
    joints.keys.height = height;
    return joints.law(Material().young).keys.seat_compliance;
  }

  /** The areas of all pairs of meshed keys, with those on edges, are that of faces, flanks and crest. */
  void areas(const double angle)
  {
    const double     a = angle * pi / 180., foot = half_crest + height * std::tan(a);
    const SolidModel model(keyed_blocks(angle, height, 1), 1);
    double           sum = 0.;
    unsigned int     n_edge = 0;
    for (const Pair &pair : find_pairs(model, 1))
    {
      sum += pair.area;
      n_edge += pair.planes.size() == 2;
    }
    expect(n_edge == 4 * 3, "pairs on the four edges");
    below("area of the meshed joint, " + text(angle) + " deg / exact - 1",
          sum / (4. * (half_width - foot + height / std::cos(a) + half_crest)) - 1., 1e-12);
  }

  struct Curve
  {
    double       T_first = 0., T_last = 0.; ///< at 0.2 mm and at 4 mm [N]
    double       rise = 0.;                 ///< of the plate per slip, over the last millimetre
    double       play = 0.;                 ///< slip at an opening of 2 mm until the flanks touch [m]
    double       shear_stiffness = 0.;      ///< after that [N/m]
    unsigned int iterations = 0;
  };

  Curve measure(const std::string &what, const HexMesh &mesh, const std::string &law, const double angle,
                const double mu, const double seat = 0.)
  {
    Curve        curve;
    const double N = pressing_force;
    {
      Press        press(mesh, law, mu, keys_of(angle, mu, seat));
      double       y = press.push(0., N, -N / press.stiffness), y_before = y;
      const double step = 1e-4;
      for (unsigned int i = 1; i <= 40; ++i)
      {
        y = press.push(i * step, N, y);
        if (i == 2)
          curve.T_first = press.total[0];
        if (i == 30)
          y_before = y;
      }
      curve.T_last = press.total[0];
      curve.rise = (y - y_before) / 1e-3;
      curve.iterations = press.iterations;
      report(what + ": all steps converged; worst", press.worst, "", press.unconverged == 0);
      below(what + ": compression missed", press.missed_force, 1e-6);
    }
    Press press(mesh, law, mu, keys_of(angle, mu, seat));
    press.move(0., .002);
    press.accept();
    double T[2];
    for (unsigned int i = 0; i < 2; ++i)
    {
      press.move(.002 * std::tan(angle * pi / 180.) + (i + 1) * 2e-4, .002);
      press.accept();
      T[i] = press.total[0];
    }
    curve.shear_stiffness = (T[1] - T[0]) / 2e-4;
    curve.play = .002 * std::tan(angle * pi / 180.) + 2e-4 - T[0] / curve.shear_stiffness;
    return curve;
  }

  void compare(const double angle, const double mu, const unsigned int refine)
  {
    const std::string what = text(angle) + " deg, friction " + text(mu) + ", mesh " + text(refine);
    const double      a = angle * pi / 180., c = std::cos(a), s = std::sin(a);
    const Curve meshed = measure(what + ", meshed", keyed_blocks(angle, height, refine), "FJA", angle, mu),
                law = measure(what + ", law", keyed_blocks(angle, 0., refine), "KSM", angle, mu),
                seats = measure(what + ", law, elastic seats", keyed_blocks(angle, 0., refine), "KSM", angle,
                                mu, default_seat());
    const bool rides = mu < s / c;
    if (rides)
      note("  capacity, rigid blocks: T/N", (c + mu * s) / (s - mu * c));
    for (const Curve *curve : {&meshed, &law, &seats})
    {
      std::printf("  %s\n", curve == &meshed ? "meshed keys, FJA"
                            : curve == &law  ? "flat mesh, KSM, rigid seats"
                                             : "flat mesh, KSM, elastic seats");
      note("  stiffness at 0.2 mm [GN/m]", 1e-9 * curve->T_first / 2e-4);
      note("  T/N at 4 mm", curve->T_last / pressing_force);
      note("  rise of the plate per slip, 3 to 4 mm", curve->rise);
      note("  play at an opening of 2 mm [mm]", 1e3 * curve->play);
      note("  stiffness after it [GN/m]", 1e-9 * curve->shear_stiffness);
      note("  Newton steps", curve->iterations);
      if (rides)
      {
        below("  T/N at 4 mm against rigid blocks - 1",
              curve->T_last / pressing_force / ((c + mu * s) / (s - mu * c)) - 1., 1e-3);
        below("  rise of the plate against cot a - 1", curve->rise * s / c - 1., 1e-3);
      }
      else // jammed: elastic
        above("  T/N at 4 mm of jammed keys", curve->T_last / pressing_force, 5.);
      below("  play - 2 mm tan a [mm]", 1e3 * (curve->play - .002 * s / c), .01);
    }
    below("  stiffness at 0.2 mm, meshed/law - 1", meshed.T_first / law.T_first - 1., .05);
    below("  stiffness after the play, meshed/law - 1", meshed.shear_stiffness / law.shear_stiffness - 1.,
          .05);
    below("  stiffness at 0.2 mm, meshed/elastic seats - 1", meshed.T_first / seats.T_first - 1., .05);
    below("  stiffness after the play, meshed/elastic seats - 1",
          meshed.shear_stiffness / seats.shear_stiffness - 1., .05);
  }
} // namespace

int main(const int argc, char **argv)
{
  const unsigned int finest = argc > 1 ? std::atoi(argv[1]) : 1;
  return run_all({[&]
                  {
                    below("default seats against 20 Height/E - 1",
                          default_seat() * 21e9 / (20. * height) - 1., 1e-12);
                    for (const double angle : {30., 45., 60.})
                      areas(angle);
                    for (unsigned int refine = 1; refine <= finest; ++refine)
                    {
                      compare(45., 0., refine);
                      compare(45., .3, refine);
                      compare(60., .8, refine);
                      compare(30., .8, refine);
                    }
                  }});
}
