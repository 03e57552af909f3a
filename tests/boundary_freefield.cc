// SPDX-License-Identifier: GPL-3.0-or-later
// Earthquake input: without dam and topography the total motion is the free field; so it is in a prismatic
// valley, with the section's motion as free field.

#include "box.h"
#include "column.h"

#include <voussoir/rock/arrival.h>
#include <voussoir/solid/critical_step.h>

#include <complex>

namespace
{
  using namespace Boxes;
  using Columns::above;
  using Columns::below;
  using Columns::note;

  RockRegionParameters parameters(const std::string &boundary, const bool nodal)
  {
    RockRegionParameters p;
    p.rock.materials[rock] = unit_rock();
    p.rock.nodal_everywhere = nodal;
    p.rock.nodal_layers = 3;
    p.rock.centre = {{7., 6.5, 12.}};
    p.dt = .3;
    p.boundary = boundary;
    return p;
  }

  /** A pulse of all three components. */
  Vector3 pulse(const double t)
  {
    return {{ricker(t, .05, 30.), .7 * ricker(t, .04, 35.), .5 * ricker(t, .06, 28.)}};
  }

  /** Returns the larger number, or NaN if a number is NaN. */
  double larger(const double a, const double b)
  {
    return a >= b ? a : b;
  }

  Difference run(const HexMesh &mesh, const RockRegionParameters &p, const unsigned int n_steps,
                 const std::string &expected_of)
  {
    return difference(make_rock_model(mesh, p.rock), p, pulse, expected_of, n_steps);
  }

  constexpr int stiff = rock + 1; ///< the volume of the half-space below a layer

  /** A layer of speed 1 and density 1 above z = @p below on rock of 2 and 1.1. */
  HexMesh layered(HexMesh mesh, const double below)
  {
    for (auto &cell : mesh.cells)
      if (centre(mesh, cell.nodes)[2] < below)
        cell.volume = stiff;
    return mesh;
  }

  RockRegionParameters layered(RockRegionParameters p)
  {
    Material m = unit_rock();
    m.density = 1.1;
    m.young *= 1.1 * 4.;
    p.rock.materials[stiff] = m;
    p.dt = .15;
    return p;
  }

  Vector3 unit_cells(const double i, const double j, const double k)
  {
    return {{i, j, k}};
  }

  const std::vector<std::string> open_box = {"x-", "x+", "y-", "y+", "z-"};

  void flat(const std::string &boundary, const bool nodal, const RockDamping &damping,
            const std::string &free_field = "columns")
  {
    auto p = parameters(boundary, nodal);
    p.damping = damping;
    p.free_field = free_field;
    const Difference r = run(box({14, 13, 12}, open_box, unit_cells), p, 400, "columns");
    below("flat, " + boundary + ", " + free_field + (nodal ? ", nodal" : ", Gauss inside") +
              (damping.stiffness > 0. ? ", damped" : "") + ": total - free field / peak",
          r.error / r.peak, 1e-10);
    below("  energy balance / largest energy", r.energy_error, 1e-10);
  }

  /** Motion at the ground above is twice the incident wave. */
  void surface_factor()
  {
    auto p = parameters("mtf2", true);
    p.free_field = "columns";
    const HexMesh   mesh = box({10, 10, 20}, open_box, unit_cells);
    const RockModel model = make_rock_model(mesh, p.rock);
    FreeField       field(model, p.damping, p.dt, 600,
                          [](const double t) -> Vector3 {
                      return {{ricker(t, .02, 70.), 0., ricker(t, .02, 70.)}};
                    });
    field.add_nodes(model, {static_cast<unsigned int>(model.points.size()) - 1});
    Unknowns u;
    double   error_s = 0., error_p = 0.;
    for (unsigned int i = 1; i <= 600; ++i)
    {
      field.advance();
      field.evaluate(u);
      const double depth = 21.; // of where the wave enters
      error_s = std::max(error_s, std::abs(u[0] - 2. * ricker(i * p.dt - depth, .02, 70.)));
      error_p = std::max(error_p, std::abs(u[2] - 2. * ricker(i * p.dt - depth / std::sqrt(3.), .02, 70.)));
    }
    below("column, 50 points per S wavelength: surface - 2 incident, S", error_s, .03);
    below("  P", error_p, .01);
  }

  /** A layer of thickness H on a half-space amplifies harmonic waves from below. The factor is
   * 2/|cos kH + i sin kH (rho c)_1 / (rho c)_2|. At c/4H the factor is twice the ratio of the impedances, 4.4
   * for a layer of 1 and 1 on 2 and 1.1. At c/2H the factor is 2, as without a layer. */
  void layer_on_half_space()
  {
    auto p = layered(parameters("mtf2", true));
    p.free_field = "columns";
    constexpr double H = 20., period = 4. * H;
    const HexMesh    mesh = layered(box({6, 6, 30}, open_box, unit_cells), 30. - H);
    const RockModel  model = make_rock_model(mesh, p.rock);
    const double     w = 2. * pi / period;
    FreeField        field(model, p.damping, p.dt, 8000,
                           [&](const double t) -> Vector3
                           {
                      const double rise = t < 3. * period ? .5 - .5 * std::cos(pi * t / 3. / period) : 1.;
                      return {{rise * std::sin(w * t), rise * std::sin(2. * w * t),
                               rise * std::sin(std::sqrt(3.) * w * t)}}; // P: c is sqrt(3) times as large
                    });
    field.add_nodes(model, {static_cast<unsigned int>(model.points.size()) - 1});
    Unknowns           u;
    double             largest[3] = {0., 0., 0.};
    const unsigned int n = std::lround(10. * period / p.dt);
    for (unsigned int i = 1; i <= n; ++i)
    {
      field.advance();
      field.evaluate(u);
      for (unsigned int c = 0; c < 3 && i * p.dt > 8. * period; ++c)
        largest[c] = larger(largest[c], std::abs(u[c]));
    }
    Columns::between("layer on half-space, surface / incident at c/4H, S", largest[0], 4.39, 4.41);
    Columns::between("  P", largest[2], 4.39, 4.41);
    Columns::between("  at c/2H, S", largest[1], 1.99, 2.01);
  }

  /** The region has the motion of its columns: layers of different rock are the same in both. */
  void flat_layers(const std::string &boundary, const std::string &free_field)
  {
    auto p = layered(parameters(boundary, true));
    p.free_field = free_field;
    const Difference r = run(layered(box({14, 13, 12}, open_box, unit_cells), 8.), p, 400, "columns");
    below("flat, two layers, " + boundary + ", " + free_field + ": total - free field / peak",
          r.error / r.peak, 1e-10);
    below("  energy balance / largest energy", r.energy_error, 1e-10);
  }

  /** The wave enters earlier where the bottom of the rock is deeper, so the level ground moves as one. */
  void stepped_bottom()
  {
    auto p = parameters("mtf2", true);
    p.dt = .1;
    const auto place = [](const double i, const double j, const double k) -> Vector3 {
      return {{i, j, (k - 24.) * (i < 3. ? 1. : i < 4. ? .75 : .5)}};
    };
    const HexMesh      mesh = box({7, 6, 24}, open_box, place);
    const RockModel    model = make_rock_model(mesh, p.rock);
    FreeField          field(model, p.damping, p.dt, 1200,
                             [](const double t) -> Vector3 {
                      return {{ricker(t, .02, 50.), 0., ricker(t, .02, 50.)}};
                    });
    const unsigned int corner = 24 * 7 * 8;
    field.add_nodes(model, {corner, corner + 7}); // of the ground above 24 m and above 12 m of rock
    Unknowns u;
    double   difference[3] = {0., 0., 0.}, peak[3] = {0., 0., 0.};
    for (unsigned int i = 1; i <= 1200; ++i)
    {
      field.advance();
      field.evaluate(u);
      for (const unsigned int c : {0u, 2u})
      {
        difference[c] = larger(difference[c], std::abs(u[c] - u[3 + c]));
        peak[c] = larger(peak[c], std::abs(u[c]));
      }
    }
    above("bottom at two depths: peak of the level ground", peak[0], 1.9);
    below("  ground above one - above the other / peak, S", difference[0] / peak[0], .01);
    below("  P", difference[2] / peak[2], .01);
  }

  /** Times of the waves from one cell below the bottom, through rock of speed 2 up to z = 10 and of 1 from
   * there on, P waves sqrt(3) times as fast. They are when the columns move. */
  void arrival()
  {
    auto            p = layered(parameters("mtf2", true));
    const RockModel model = make_rock_model(layered(box({6, 6, 30}, open_box, unit_cells), 10.), p.rock);
    double          error = 0.;
    for (const auto &[z, time] : std::vector<std::pair<double, double>>{
             {-5., 0.}, {-.5, .25}, {6., 3.5}, {10., 5.5}, {17.25, 12.75}, {30., 25.5}, {50., 25.5}})
    {
      const Vector3 found = travel_times(model, z);
      for (unsigned int c = 0; c < 3; ++c)
        error = larger(error, std::abs(found[c] - time / (c == 2 ? std::sqrt(3.) : 1.)));
    }
    below("arrival of S and P, two layers: error [s]", error, 1e-12);

    // A ramp of the incident wave: its middle is at the ground at these times.
    p.free_field = "columns";
    FreeField  field(model, p.damping, p.dt, 400,
                     [](const double t) -> Vector3
                     {
                      const double ramp = t < 0. ? 0. : t < 8. ? .5 - .5 * std::cos(pi * t / 8.) : 1.;
                      return {{ramp, ramp, ramp}};
                    });
    const auto top = static_cast<unsigned int>(model.points.size()) - 1;
    field.add_nodes(model, {top});
    Unknowns      u;
    const Vector3 times = travel_times(model, 30.);
    Vector3       middle{};
    const double  raised =
        2. * 2. * 2.2 / (1. + 2.2); // by the ground, out of rock with 2.2 times the impedance
    for (unsigned int i = 1; i <= 400; ++i)
    {
      field.advance();
      field.evaluate(u);
      for (const unsigned int c : {0u, 2u})
        if (middle[c] == 0. && u[c] > .5 * raised)
          middle[c] = i * p.dt - 4.;
    }
    below("arrival at the ground against the times told, S [s]", std::abs(middle[0] - times[0]), .3);
    below("  P", std::abs(middle[2] - times[2]), .3);
  }

  /** Valley along x: the ground's height over y is lowered in the middle, vertical lines stay vertical. */
  Vector3 valley(const double i, const double j, const double k)
  {
    const double y = j - 10., depth = std::abs(y) < 6. ? 2.5 * (1. + std::cos(pi * y / 6.)) : 0.;
    return {{i, y, k < 6. ? k : 6. + (k - 6.) * (8. - depth) / 8.}};
  }

  void prismatic(const std::string &free_field, const bool nodal)
  {
    auto p = parameters("mtf2", nodal);
    p.dt = .13;
    p.free_field = free_field;
    const HexMesh   mesh = box({12, 20, 14}, open_box, valley);
    const RockModel model = make_rock_model(mesh, p.rock);
    auto            region = make_region(model, p);
    shake(*region, model, p, pulse, 900);
    const auto           field = make_free_field(model, p, pulse, 900);
    std::vector<Vector3> places; // of the first section
    for (unsigned int i = 0; i < model.points.size(); i += 13)
      places.push_back(model.points[i]);
    // Prismatic: the motion depends on y and z only.
    double error = 0., peak = 0., off_upstream = 0.;
    for (unsigned int i = 0; i < 900; ++i)
    {
      region->advance();
      const Unknowns &u = region->displacement();
      for (unsigned int k = 0; k < u.size(); ++k)
      {
        const unsigned int in_section = k / 39 * 39 + k % 3;
        error = larger(error, std::abs(u[k] - u[in_section]));
        peak = larger(peak, std::abs(u[k]));
      }
      field->advance();
      const Unknowns upstream = field->upstream(places);
      for (std::size_t k = 0; k < upstream.size(); ++k)
        off_upstream = larger(off_upstream, std::abs(upstream[k] - u[k / 3 * 39 + k % 3]));
    }
    const std::string what = "prismatic valley, " + free_field + (nodal ? ", nodal" : ", Gauss inside");
    if (free_field == "sections" && nodal)
    {
      below(what + ": total - section / peak", error / peak, 1e-9);
      const Difference r = run(mesh, p, 300, p.free_field);
      below("  total - free field / peak", r.error / r.peak, 1e-9);
      below("  total - motion of the valley upstream / peak", off_upstream / peak, 1e-9);
    }
    else
      note(what + ": variation along the valley / peak", error / peak);
  }

  /** Grid lines that are bent across the valley, as below an arch dam: bottom nodes halfway between those of
   * the section have the mean motion of both. */
  void bent_lines()
  {
    auto p = parameters("mtf2", true);
    p.dt = .13;
    p.free_field = "sections";
    const auto bent = [](const double i, const double j, const double k)
    {
      const Vector3 straight = valley(i, j, k);
      return Vector3{{straight[0], straight[1] + (i == 6. && j > 0. && j < 20. ? .5 : 0.), straight[2]}};
    };
    constexpr unsigned int    n_along = 13, n_below = 5; // nodes along x; of a line
    std::vector<unsigned int> lines;                     // bent ones of the bottom
    std::vector<Unknowns>     u(2);                      // bent, straight
    std::vector<double>       error(2, 0.), peak(2, 0.);
    std::vector<RockModel>    models = {make_rock_model(box({12, 20, 14}, open_box, bent), p.rock),
                                        make_rock_model(box({12, 20, 14}, open_box, valley), p.rock)};
    std::vector<unsigned int> line_of(models[0].points.size(), no_node), nodes;
    for (unsigned int l = 0; l < models[0].lines.size(); ++l)
      line_of[models[0].lines[l].nodes[0]] = l;
    for (unsigned int j = 1; j < 19; ++j)
      nodes.push_back(j * n_along + 6);
    std::vector<std::unique_ptr<FreeField>> fields;
    for (const RockModel &model : models)
    {
      fields.push_back(make_free_field(model, p, pulse, 900));
      fields.back()->add_lines(model, n_below);
      fields.back()->add_nodes(model, nodes);
    }
    for (unsigned int i = 0; i < 900; ++i)
    {
      for (unsigned int f = 0; f < 2; ++f)
      {
        fields[f]->advance();
        fields[f]->evaluate(u[f]);
      }
      for (unsigned int j = 0; j < nodes.size(); ++j)
        for (unsigned int k = 0; k < 3 * n_below; ++k)
        {
          const std::size_t first = 3 * std::size_t(n_below), here = first * line_of[nodes[j]] + k,
                            next = first * line_of[nodes[j] + n_along] + k,
                            node = first * models[0].lines.size() + 3 * j + k;
          const double mean = .5 * (u[1][here] + u[1][next]);
          error[0] = larger(error[0], std::abs(u[0][here] - mean));
          if (k < 3)
            error[1] = larger(error[1], std::abs(u[0][node] - mean));
          peak[0] = larger(peak[0], std::abs(mean));
        }
    }
    below("bottom lines bent across the valley: off the section / peak", error[0] / peak[0], .01);
    below("  nodes of viscous boundaries", error[1] / peak[0], .01);
  }

  /** A valley that changes along x: FreeField::upstream() has the motion of the free field at the nodes
   * with the smallest x. */
  void varying_valley()
  {
    auto p = parameters("mtf2", true);
    p.dt = .13;
    p.free_field = "sections";
    const auto shallower = [](const double i, const double j, const double k)
    {
      const Vector3 deep = valley(i, j, k);
      return Vector3{{deep[0], deep[1], deep[2] + i / 12. * .5 * (k - deep[2])}};
    };
    const RockModel           model = make_rock_model(box({12, 20, 14}, open_box, shallower), p.rock);
    const auto                field = make_free_field(model, p, pulse, 900);
    std::vector<unsigned int> first, last;
    std::vector<Vector3>      places;
    for (unsigned int i = 0; i < model.points.size(); i += 13)
    {
      first.push_back(i);
      last.push_back(i + 12);
      places.push_back(model.points[i]);
    }
    field->add_nodes(model, first);
    field->add_nodes(model, last);
    double   error = 0., other = 0., peak = 0.;
    Unknowns u;
    for (unsigned int i = 0; i < 900; ++i)
    {
      field->advance();
      field->evaluate(u);
      const Unknowns upstream = field->upstream(places);
      for (std::size_t k = 0; k < upstream.size(); ++k)
      {
        error = larger(error, std::abs(upstream[k] - u[k]));
        other = larger(other, std::abs(u[upstream.size() + k] - u[k]));
        peak = larger(peak, std::abs(u[k]));
      }
    }
    below("varying valley: upstream - its section / peak", error / peak, 1e-12);
    Columns::between("  section downstream - section upstream / peak", other / peak, .01, 10.);
  }

  /** Returns the motion across a valley at 13 points of the ground, in a section with a zone of the given
   * width. */
  std::vector<double> motion_of_valley(const double width_of_zone)
  {
    auto p = parameters("mtf3", true);
    p.dt = .13;
    p.rock.centre = {{0., 0., 9.}};
    p.width_of_zone = width_of_zone;
    const RockModel      model = make_rock_model(box({1, 20, 14}, {"x-", "y-", "y+", "z-"}, valley), p.rock);
    std::vector<Vector3> places;
    for (unsigned int j = 4; j <= 16; ++j)
      places.push_back(valley(0., j, 14.));
    const auto wave = [](const double t) -> Vector3 {
      return {{ricker(t, .03, 50.), ricker(t, .02, 60.), 0.}};
    };
    const auto          field = make_free_field(model, p, wave, 1600);
    std::vector<double> result;
    for (unsigned int i = 0; i < 1600; ++i)
    {
      field->advance();
      const Unknowns u = field->upstream(places);
      result.insert(result.end(), u.begin(), u.end());
    }
    return result;
  }

  /** Difference of two motions at the frequency eta c_s / (2 a), a = 6, relative to the second: components x
   * (SH) or y and z (SV). */
  double difference_at(const double eta, const bool is_sh, const std::vector<double> &u,
                       const std::vector<double> &v)
  {
    constexpr unsigned int            n_values = 3 * 13;
    std::vector<std::complex<double>> error(n_values), size(n_values);
    for (std::size_t k = 0; k < u.size(); ++k)
    {
      const double               t = .13 * (k / n_values + 1.);
      const std::complex<double> phase = std::exp(std::complex<double>(0., -pi * eta / 6. * t));
      error[k % n_values] += phase * (u[k] - v[k]);
      size[k % n_values] += phase * v[k];
    }
    double of_error = 0., of_size = 0.;
    for (unsigned int k = 0; k < n_values; ++k)
      if ((k % 3 == 0) == is_sh)
      {
        of_error += std::norm(error[k]);
        of_size += std::norm(size[k]);
      }
    return std::sqrt(of_error / of_size);
  }

  /** The free field of a valley is almost independent of the width of the zone. */
  void width_of_zone()
  {
    const auto far = motion_of_valley(8.), near = motion_of_valley(.75), least = motion_of_valley(0.);
    double     of_least = 0.;
    for (const bool is_sh : {true, false})
      for (const double eta : {.1, .15, .2, .3, .5})
      {
        const std::string name =
            std::string(is_sh ? ", SH" : ", SV") + ", eta " + std::to_string(eta).substr(0, 4);
        below("motion of a valley, zone of .75 heights against 8" + name,
              difference_at(eta, is_sh, near, far), .01);
        const double error = difference_at(eta, is_sh, least, far);
        note("  zone of 2N + 1 cells" + name, error);
        of_least = std::max(of_least, error);
      }
    above("zone of 2N + 1 cells: largest of these differences", of_least, .015);
  }

  void refuses()
  {
    auto            p = parameters("mtf2", true);
    const RockModel model = make_rock_model(box({6, 6, 6}, open_box, unit_cells), p.rock);
    p.dt = .5;
    std::string message;
    try
    {
      make_region(model, p);
    }
    catch (const std::exception &error)
    {
      message = error.what();
    }
    Columns::report("too large a time step is refused", .5, message.substr(0, 20),
                    message.find("critical time step") != std::string::npos);
    const double w = largest_frequency(model.stiffness, model.mass);
    // Cube with nodal quadrature, nu = 0.25: c_p dt/h = 0.775
    Columns::between("critical time step of a cube, c_p dt/h", std::sqrt(3.) * critical_time_step(w, {}), .74,
                     .78);
  }
} // namespace

int main()
{
  return Columns::run_all({refuses,
                           surface_factor,
                           layer_on_half_space,
                           stepped_bottom,
                           arrival,
                           [] { flat_layers("mtf3", "columns"); },
                           [] { flat_layers("mtf3", "sections"); },
                           [] { flat_layers("viscous-spring", "columns"); },
                           [] { flat("mtf2", true, {}); },
                           [] { flat("mtf2", false, {}); },
                           [] { flat("mtf3", true, {}); },
                           [] {
                             flat("mtf2", true, {.01, .05});
                           },
                           [] {
                             flat("mtf2", true, {.01, .05}, "sections");
                           },
                           [] { flat("mtf2", false, {}, "sections"); },
                           [] {
                             flat("viscous", true, {.01, .05});
                           },
                           [] { flat("viscous-spring", true, {}); },
                           [] { prismatic("sections", true); },
                           [] { prismatic("sections", false); },
                           [] { prismatic("columns", true); },
                           bent_lines,
                           varying_valley,
                           width_of_zone});
}
