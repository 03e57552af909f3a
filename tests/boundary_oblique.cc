// SPDX-License-Identifier: GPL-3.0-or-later
// Plane waves at an angle: motion of level ground against the closed form, at the surface and at depth; a
// flat region and a prismatic valley against their free field; the limits of the angle.

#include "box.h"
#include "column.h"
#include "transfer_matrix.h"

#include <voussoir/rock/arrival.h>

namespace
{
  using namespace Boxes;
  using Columns::below;
  using Columns::note;

  const std::vector<std::string> open_box = {"x-", "x+", "y-", "y+", "z-"};

  Vector3 unit_cells(const double i, const double j, const double k)
  {
    return {{i, j, k}};
  }

  constexpr double degree = pi / 180.;

  PlaneWave wave_of(const std::string &type, const double angle, const double azimuth)
  {
    return read_incidence(type + " " + std::to_string(angle) + " " + std::to_string(azimuth))[0];
  }

  /** Level ground of unit rock under a plane wave, in closed form. The axes are s, along the horizontal
   * direction of propagation, n normal to it, and z. The reflected waves follow from the motion of the
   * surface (Aki and Richards 2002, Quantitative Seismology, 2nd ed., section 5.2.2), or from the condition
   * that the surface has no traction. */
  class LevelGround
  {
  public:
    LevelGround(const PlaneWave &wave, const double nu)
        : type(wave.type), alpha(std::sqrt(2. * (1. - nu) / (1. - 2. * nu)))
    {
      p = std::sin(wave.angle) / (type == PlaneWave::P ? alpha : 1.);
      q_p = std::sqrt(std::max(0., 1. / (alpha * alpha) - p * p));
      q_s = std::sqrt(1. - p * p);
      const double b = 1. - 2. * p * p, D = b * b + 4. * p * p * q_p * q_s;
      if (type == PlaneWave::P)
      {
        surface = {{4. * alpha * p * q_p * q_s / D, 0., 2. * alpha * q_p * b / D}};
        solve(alpha * p, alpha * q_p);
      }
      else if (type == PlaneWave::SV)
      {
        surface = {{2. * q_s * b / D, 0., -4. * p * q_p * q_s / D}};
        solve(q_s, -p);
      }
      else
        surface = {{0., 2., 0.}};
    }

    /** Displacement at a depth for the amplitude f(t) of the incident wave at the surface, at s = 0. */
    template <class Function> Vector3 motion(const double depth, const double t, const Function &f) const
    {
      if (type == PlaneWave::SH)
        return {{0., f(t + q_s * depth) + f(t - q_s * depth), 0.}};
      const bool   is_p = type == PlaneWave::P;
      const double in = f(t + (is_p ? q_p : q_s) * depth), p_out = back_p * f(t - q_p * depth),
                   s_out = back_s * f(t - q_s * depth);
      return {{(is_p ? alpha * p : q_s) * in + alpha * p * p_out + q_s * s_out, 0.,
               (is_p ? alpha * q_p : -p) * in - alpha * q_p * p_out + p * s_out}};
    }

    /** Largest traction of the surface for a unit amplitude of strain, which must vanish: a check of the
     * formulas. */
    double traction() const
    {
      if (type == PlaneWave::SH)
        return 0.;
      const double lambda = alpha * alpha - 2.;
      double       shear = 0., normal = 0.;
      const auto   add =
          [&](const double a, const double u, const double w, const double q) // a (u, w) f(t - p s - q z)
      {
        shear += a * (q * u + p * w);
        normal += a * (lambda * (p * u + q * w) + 2. * q * w);
      };
      const bool is_p = type == PlaneWave::P;
      is_p ? add(1., alpha * p, alpha * q_p, q_p) : add(1., q_s, -p, q_s);
      add(back_p, alpha * p, -alpha * q_p, -q_p);
      add(back_s, q_s, p, -q_s);
      return std::max(std::abs(shear), std::abs(normal));
    }

    Vector3 surface;

  private:
    /** Amplitudes of the reflected waves from the motion of the surface, less the incident wave. */
    void solve(const double u_in, const double w_in)
    {
      const double u = surface[0] - u_in, w = surface[2] - w_in,
                   determinant = alpha * p * p + alpha * q_p * q_s;
      back_p = (u * p - w * q_s) / determinant;
      back_s = (alpha * p * w + alpha * q_p * u) / determinant;
    }

    PlaneWave::Type type;
    double          alpha, p, q_p, q_s, back_p = 0., back_s = 0.;
  };

  /** Amplitude of all three components of the motion. */
  double pulse(const double t)
  {
    return ricker(t, .02, 80.);
  }
  Vector3 pulses(const double t)
  {
    return {{pulse(t), pulse(t), pulse(t)}};
  }

  RockRegionParameters parameters(const std::vector<PlaneWave> &waves, const double nu = .25)
  {
    RockRegionParameters p;
    p.rock.materials[rock] = unit_rock(nu);
    p.rock.nodal_everywhere = true;
    p.rock.centre = {{6., 6., 0.}};
    p.free_field = "columns";
    p.damping = {};
    p.incidence = {waves, p.rock.centre};
    p.dt = .25;
    return p;
  }

  /** Level ground at the surface and at half of the depth against the closed form: largest error relative to
   * the incident wave. */
  double error_of_ground(const PlaneWave &wave, const double nu)
  {
    auto            p = parameters({wave}, nu);
    const RockModel model = make_rock_model(box({3, 3, 16}, open_box, unit_cells), p.rock);
    const Vector3   top = {{p.rock.centre[0], p.rock.centre[1], 16.}};
    p.dt *= .9;
    p.incidence = timed(model, p.incidence, top);
    const double              arrives = arrival_time(model, {{wave}, p.rock.centre}, top);
    const unsigned int        n = (300. + arrives) / p.dt;
    FreeField                 field(model, p.damping, p.dt, n, pulses, p.incidence);
    std::vector<unsigned int> nodes; // above each other
    for (const double z : {16., 8.})
      for (unsigned int i = 0; i < model.points.size(); ++i)
        if (const Vector3 &x = model.points[i]; x[0] == 1. && x[1] == 2. && x[2] == z)
          nodes.push_back(i);
    field.add_nodes(model, nodes);
    const LevelGround ground(wave, nu);
    const double      late =
        wave.slowness(unit_rock(nu)) * (wave.along({{1., 2., 0.}}) - wave.along(top)); // at the nodes
    const double x = std::cos(wave.azimuth), y = std::sin(wave.azimuth);
    // The motion of the file along the direction of the wave has the amplitude of its pulse times this
    // factor.
    const double scale = wave.type == PlaneWave::P ? 1. : wave.type == PlaneWave::SV ? x + y : x - y;
    Unknowns     u;
    double       error = 0.;
    for (unsigned int i = 1; i <= n; ++i)
    {
      field.advance();
      field.evaluate(u);
      for (unsigned int k = 0; k < 2; ++k)
      {
        const Vector3 v = ground.motion(8. * k, i * p.dt - arrives - late, pulse);
        const Vector3 expected = {{x * v[0] - y * v[1], y * v[0] + x * v[1], v[2]}};
        for (unsigned int c = 0; c < 3; ++c)
          error =
              std::max(error, std::abs(u[3 * k + c] - scale * expected[c]) / std::max(.1, std::abs(scale)));
        if (!std::isfinite(u[3 * k]))
          return HUGE_VAL;
      }
    }
    return error;
  }

  /** The two ways to the motion of the surface, and two values that do not come from us. */
  void closed_form()
  {
    double traction = 0.;
    for (const double nu : {.2, .25, .33})
      for (const double angle : {0., 10., 21., 30.})
        for (const char *type : {"P", "SV"})
          traction = std::max(traction, LevelGround(wave_of(type, angle, 0.), nu).traction());
    below("closed form: traction of the surface", traction, 1e-12);
    const Vector3 p = LevelGround(wave_of("P", 21., 0.), .25).surface,
                  s = LevelGround(wave_of("SV", 21., 0.), .25).surface;
    below("  P at 21 degrees: 0.816, 1.843", std::max(std::abs(p[0] - .816), std::abs(p[2] - 1.843)), 6e-4);
    below("  SV at 21 degrees: 1.804, -0.787", std::max(std::abs(s[0] - 1.804), std::abs(s[2] + .787)), 6e-4);
    double difference = 0.;
    for (const double nu : {.2, .25, .33})
      for (const auto &[type, largest] :
           std::vector<std::pair<const char *, double>>{{"P", 80.}, {"SV", 30.}, {"SH", 80.}})
        for (double angle = 0.; angle <= largest; angle += 10.)
        {
          const PlaneWave wave = wave_of(type, angle, 0.);
          const auto      u = TransferMatrix::surface(wave, unit_rock(nu), 7., unit_rock(nu), .3);
          const Vector3   v = LevelGround(wave, nu).surface;
          for (unsigned int c = 0; c < 3; ++c)
            difference = std::max(difference, std::abs(std::abs(u[c]) - std::abs(v[c])));
        }
    below("  against transfer matrices", difference, 1e-12);
  }

  /** Spectra of the motion of a layer on a half-space of speed 2 and density 1.1 against transfer matrices. */
  double error_of_layer(const PlaneWave &wave, const double nu)
  {
    constexpr int    stiff = rock + 1;
    constexpr double h = 12.;
    auto             p = parameters({wave}, nu);
    Material         half_space = unit_rock(nu);
    half_space.density = 1.1;
    half_space.young *= 4.4;
    p.rock.materials[stiff] = half_space;
    p.dt = .12;
    HexMesh mesh = box({3, 3, 16}, open_box, unit_cells);
    for (auto &cell : mesh.cells)
      if (centre(mesh, cell.nodes)[2] < 16. - h)
        cell.volume = stiff;
    const RockModel model = make_rock_model(mesh, p.rock);
    p.incidence = timed(model, p.incidence, {{6., 6., 16.}});
    p.incidence.half_space = half_space_of(model);
    const unsigned int n = 500. / p.dt;
    FreeField          field(model, p.damping, p.dt, n, pulses, p.incidence);
    field.add_nodes(model, {static_cast<unsigned int>(model.points.size()) - 1});
    constexpr unsigned int n_frequencies = 4;
    constexpr double       frequency[n_frequencies] = {.008, .0156, .0208, .03}; // below .75 c/h
    std::array<TransferMatrix::State, n_frequencies> spectrum{};
    const double                                     x = std::cos(wave.azimuth), y = std::sin(wave.azimuth);
    Unknowns                                         u;
    for (unsigned int i = 1; i <= n; ++i)
    {
      field.advance();
      field.evaluate(u);
      for (unsigned int f = 0; f < n_frequencies; ++f)
      {
        const auto   phase = std::exp(TransferMatrix::Complex(0., -2. * pi * frequency[f] * i * p.dt));
        const double in_axes[3] = {x * u[0] + y * u[1], x * u[1] - y * u[0], u[2]};
        for (unsigned int c = 0; c < 3; ++c)
          spectrum[f][c] += phase * in_axes[c];
        spectrum[f][3] += phase * pulse(i * p.dt);
      }
    }
    // As in error_of_ground()
    const double scale = wave.type == PlaneWave::P ? 1. : wave.type == PlaneWave::SV ? x + y : x - y;
    double       error = 0.;
    for (unsigned int f = 0; f < n_frequencies; ++f)
    {
      const auto expected =
          TransferMatrix::surface(wave, unit_rock(nu), h, half_space, 2. * pi * frequency[f]);
      const double size = std::sqrt(std::norm(expected[0]) + std::norm(expected[1]) + std::norm(expected[2]));
      for (unsigned int c = 0; c < 3; ++c)
        error = std::max(
            error,
            std::abs(std::abs(spectrum[f][c] / (scale * spectrum[f][3])) - std::abs(expected[c])) / size);
    }
    return error;
  }

  void layered_ground()
  {
    for (const double nu : {.2, .25, .33})
    {
      double error = 0.;
      for (const auto &[type, largest] :
           std::vector<std::pair<const char *, double>>{{"P", 60.}, {"SV", 30.}, {"SH", 60.}})
        for (double angle = 0.; angle <= largest; angle += 15.)
          error = std::max(error, error_of_layer(wave_of(type, angle, 25.), nu));
      below("layer on a half-space, P and SH to 60, SV to 30 degrees, Poisson's ratio " + Columns::text(nu) +
                ": spectra against transfer matrices",
            error, .01);
    }
  }

  void level_ground()
  {
    for (const double nu : {.2, .25, .33})
    {
      double       of_p = 0., of_s = 0., of_sh = 0.;
      const double critical = std::asin(std::sqrt((1. - 2. * nu) / (2. - 2. * nu))) / degree;
      for (const double angle : {0., 15., 30., 45., 60., 70., 80.})
        of_p = std::max(of_p, error_of_ground(wave_of("P", angle, 25.), nu));
      for (const double angle : {0., 10., 21., .9 * critical, .97 * critical})
        of_s = std::max(of_s, error_of_ground(wave_of("SV", angle, -70.), nu));
      for (const double angle : {0., 30., 60., 80.})
        of_sh = std::max(of_sh, error_of_ground(wave_of("SH", angle, 200.), nu));
      const std::string of = ", Poisson's ratio " + std::to_string(nu).substr(0, 4);
      below("level ground, P to 80 degrees" + of, of_p, .01);
      below("  SV to 0.97 of the critical angle" + of, of_s, .01);
      below("  SH to 80 degrees" + of, of_sh, .01);
    }
  }

  /** Angle zero: the motion is that of vertical incidence. */
  void vertical()
  {
    auto            p = parameters({});
    const RockModel model = make_rock_model(box({3, 3, 16}, open_box, unit_cells), p.rock);
    p.damping = {.01, .05};
    p.dt = .2;
    FreeField                       straight(model, p.damping, p.dt, 800, pulses);
    FreeField                       oblique(model, p.damping, p.dt, 800, pulses,
                                            {{wave_of("SV", 0., 0.), wave_of("SH", 0., 0.), wave_of("P", 0., 0.)}, p.rock.centre});
    const std::vector<unsigned int> nodes = {0, 100, static_cast<unsigned int>(model.points.size()) - 1};
    straight.add_nodes(model, nodes);
    oblique.add_nodes(model, nodes);
    double   of_sv = 0., of_others = 0.; // u_x, u_y and u_z
    Unknowns u, v;
    for (unsigned int i = 0; i < 800; ++i)
    {
      straight.advance();
      oblique.advance();
      straight.evaluate(u);
      oblique.evaluate(v);
      for (std::size_t k = 0; k < u.size(); ++k)
      {
        double &error = k % 3 == 0 ? of_sv : of_others;
        error = std::max(error, std::abs(u[k] - v[k]));
      }
    }
    below("angle 0 against vertical incidence, SH and P", of_others, 1e-9);
    below("  SV, between its half steps", of_sv, 1e-4);
  }

  Difference run(const HexMesh &mesh, RockRegionParameters p, const std::string &expected_of,
                 const unsigned int n)
  {
    const RockModel model = make_rock_model(mesh, p.rock);
    p.incidence = timed(model, p.incidence, p.rock.centre);
    return difference(model, p, pulses, expected_of, n);
  }

  /** A flat region moves like its columns, except for the error of the elements along the ground. */
  void flat_region(const std::string &free_field, const std::vector<PlaneWave> &waves,
                   const std::string &name)
  {
    auto p = parameters(waves);
    p.free_field = free_field;
    p.damping = {0., .01};
    const Difference d = run(box({14, 13, 12}, open_box, unit_cells), p, "columns", 900);
    below("flat region, " + free_field + ", " + name + ": total - columns / peak", d.error / d.peak, 2e-3);
    below("  energy balance / largest energy", d.energy_error, 1e-10);
  }

  Vector3 valley(const double i, const double j, const double k)
  {
    const double y = j - 10., depth = std::abs(y) < 6. ? 2.5 * (1. + std::cos(pi * y / 6.)) : 0.;
    return {{i, y, k < 6. ? k : 6. + (k - 6.) * (8. - depth) / 8.}};
  }

  /** The motion of the valley decays after the waves have passed, also near the critical angle. */
  void long_run(const std::string &boundary, const double nu, const double share_of_critical,
                const double damping)
  {
    const double critical = std::asin(std::sqrt((1. - 2. * nu) / (2. - 2. * nu))) / degree;
    auto         p = parameters({wave_of("SV", share_of_critical * critical, 0.)}, nu);
    p.dt = .13;
    p.boundary = boundary;
    p.free_field = "sections";
    p.damping.stiffness = damping * p.dt;
    p.rock.centre = p.incidence.centre = {{1., 0., 9.}};
    const RockModel model = make_rock_model(box({2, 20, 14}, open_box, valley), p.rock);
    p.incidence = timed(model, p.incidence, p.rock.centre);
    constexpr unsigned int n = 8000;
    const auto             field = make_free_field(model, p, pulses, n);
    std::vector<Vector3>   places;
    for (unsigned int j = 4; j <= 16; ++j)
      places.push_back(valley(0., j, 14.));
    double peak = 0., middle = 0., end = 0.;
    for (unsigned int i = 0; i < n; ++i)
    {
      field->advance();
      if (i % 10 != 0)
        continue;
      for (const double u : field->upstream(places))
      {
        peak = std::max(peak, std::abs(u));
        if (i >= n / 2 && i < n / 2 + 1000)
          middle = std::max(middle, std::abs(u));
        if (!(i < n - 1000 && std::isfinite(u)))
          end = std::max(end, std::isfinite(u) ? std::abs(u) : HUGE_VAL);
      }
    }
    const std::string what = "valley, " + boundary + ", SV at " + Columns::text(share_of_critical) +
                             " of the critical angle, Poisson's ratio " + Columns::text(nu) +
                             ": motion at the end / ";
    below(what + "peak", end / peak, 1e-2);
    below(what + "half of the time before", end / middle, .6);
  }

  /** The motion upstream belongs to x of the centre, with sections and with columns. */
  void upstream()
  {
    auto            p = parameters({wave_of("SV", 20., 0.)});
    const RockModel model = make_rock_model(box({8, 10, 9}, open_box, unit_cells), p.rock);
    p.incidence = timed(model, p.incidence, p.rock.centre);
    const auto columns = make_free_field(model, p, pulses, 800);
    p.free_field = "sections";
    const auto                 sections = make_free_field(model, p, pulses, 800);
    const std::vector<Vector3> places = {{{-400., 4., 9.}}, {{-3., 6., 5.}}};
    double                     error = 0., peak = 0.;
    for (unsigned int i = 0; i < 800; ++i)
    {
      columns->advance();
      sections->advance();
      const Unknowns u = columns->upstream(places), v = sections->upstream(places);
      for (std::size_t k = 0; k < u.size(); ++k)
      {
        error = std::max(error, std::abs(u[k] - v[k]));
        peak = std::max(peak, std::abs(u[k]));
      }
    }
    below("level ground, motion upstream: sections - columns / peak", error / peak, 2e-3);
  }

  /** A valley along x: the region has the motion of the section, which is delayed along x. */
  void prismatic(const std::vector<PlaneWave> &waves, const std::string &name, const double limit)
  {
    auto p = parameters(waves);
    p.dt = .13;
    p.boundary = "mtf2";
    p.free_field = "sections";
    p.rock.centre = p.incidence.centre = {{6., 0., 9.}};
    const Difference d = run(box({12, 20, 14}, open_box, valley), p, "sections", 1600);
    below("prismatic valley, " + name + ": total - section / peak", d.error / d.peak, limit);
    below("  energy balance / largest energy", d.energy_error, 1e-10);
  }

  void prismatic_across()
  {
    std::vector<PlaneWave> waves = {wave_of("P", 40., 90.), wave_of("SV", 25., 90.),
                                    wave_of("SH", 50., -90.)};
    waves[1].delay = 7.;
    prismatic(waves, "P, SV and SH across", 1e-9);
  }

  std::string message_of(const std::function<void()> &call)
  {
    try
    {
      call();
    }
    catch (const std::exception &error)
    {
      return error.what();
    }
    return "";
  }

  void expect_message(const std::string &what, const std::string &words, const std::function<void()> &call)
  {
    const std::string message = message_of(call);
    Columns::report(what, 0., message.substr(0, 60), message.find(words) != std::string::npos);
  }

  void refuses()
  {
    for (const std::pair<const char *, const char *> &text :
         std::vector<std::pair<const char *, const char *>>{{"", "a wave is missing"},
                                                            {"SV", "no angle and azimuth"},
                                                            {"SV 30", "no angle and azimuth"},
                                                            {"S 30 90", "unknown type"},
                                                            {"P 90 0", "outside of 0 to 90"},
                                                            {"P -1 0", "outside of 0 to 90"},
                                                            {"P nan 0", "no angle"},
                                                            {"P 30 90 x", "delay"},
                                                            {"P 30 90 -1", "delay"},
                                                            {"P 30 90 1 2", "more than four"},
                                                            {"P 30 90,", "a wave is missing"},
                                                            {"P 30 90,,", "a wave is missing"}})
      expect_message(std::string("refused: \"") + text.first + "\"", text.second,
                     [&] { read_incidence(text.first); });
    const auto run = [](const std::string &incidence, const std::string &free_field)
    {
      auto p = parameters(read_incidence(incidence));
      p.free_field = free_field;
      const RockModel model = make_rock_model(box({6, 6, 9}, open_box, unit_cells), p.rock);
      make_free_field(model, p, pulses, 10);
    };
    expect_message("refused: SV beyond the critical angle", "below 35.2",
                   [&] { run("SV 36 90", "columns"); });
    expect_message("refused: SV almost at the critical angle along the valley", "below 34.6",
                   [&] { run("SV 35 0", "sections"); });
    expect_message("refused: SH at a grazing angle", "critical", [&] { run("SH 89 90", "columns"); });
    expect_message("refused: SH beyond the critical angle along the valley", "along the valley",
                   [&] { run("SH 45 0", "sections"); });
    Columns::report("accepted: SH across the valley", 0., "",
                    message_of([&] { run("SH 45 90", "sections"); }).empty());
    Columns::report("accepted: along level ground", 0., "",
                    message_of([&] { run("P 30 80", "columns"); }).empty());
    const auto waves = read_incidence("SV 30 90, P 20 -90 0.5");
    Columns::report("a list of waves", waves[1].delay, "",
                    waves.size() == 2 && waves[1].type == PlaneWave::P &&
                        std::abs(waves[1].azimuth + pi / 2.) < 1e-15 && waves[1].delay == .5);
    Columns::report("vertical", 0., "", read_incidence("vertical").empty());
  }
} // namespace

int main()
{
  return Columns::run_all(
      {closed_form,
       layered_ground,
       level_ground,
       vertical,
       [] { flat_region("columns", {wave_of("P", 30., 20.)}, "P 30"); },
       [] { flat_region("columns", {wave_of("SV", 20., -140.)}, "SV 20"); },
       [] { flat_region("columns", {wave_of("SH", 60., 30.)}, "SH 60"); },
       [] {
         flat_region("sections", {wave_of("SV", 25., 90.), wave_of("P", 50., -90.)}, "SV 25 and P 50 across");
       },
       [] { flat_region("sections", {wave_of("P", 21., 0.)}, "P 21 along"); },
       [] { flat_region("sections", {wave_of("SV", 21., 180.)}, "SV 21 upstream"); },
       [] {
         flat_region("sections", {wave_of("SH", 25., 20.), wave_of("P", 40., -50.)}, "SH 25 and P 40");
       },
       prismatic_across,
       [] { prismatic({wave_of("P", 21., 0.)}, "P 21 along", 2e-3); },
       [] { prismatic({wave_of("SV", 21., 0.)}, "SV 21 along", 2e-3); },
       [] { prismatic({wave_of("SV", 30., 0.)}, "SV 30 along", 2e-3); },
       [] {
         prismatic({wave_of("SH", 25., 180.), wave_of("P", 45., 120.)}, "SH 25 upstream and P 45", 2e-3);
       },
       upstream,
       [] { long_run("mtf3", .25, .97, 0.); },
       [] { long_run("mtf3", .25, .98, .01); },
       [] { long_run("mtf2", .33, .97, .01); },
       [] { long_run("viscous-spring", .25, .9, .01); },
       refuses});
}
