// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/app/spectrum_analysis.h>
#include <voussoir/base/error.h>
#include <voussoir/base/number_text.h>
#include <voussoir/dynamics/spectrum_response.h>
#include <voussoir/motion/ground_motion.h>
#include <voussoir/motion/spectrum_file.h>
#include <voussoir/output/face_tension.h>
#include <voussoir/output/recorders.h>
#include <voussoir/output/spectrum_fields.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <iostream>

namespace Voussoir
{
  namespace
  {
    void warn(const std::string &text)
    {
      std::cerr << "voussoir: warning: " << text << "\n";
    }

    void print_row(const char *name, const Vector3 &x)
    {
      std::printf("%-42s %10.3f %10.3f %10.3f\n", name, x[0], x[1], x[2]);
    }

    /** Returns the two frequencies of Gupta's method for the ground motion along axis @p d [Hz]: modes below the
     * first one have no rigid share, and modes above the second one are rigid. The first one is that of the longest
     * period with 99 % of the largest acceleration: the end of the plateau of a design spectrum. */
    std::array<double, 2> rigid_range(const ChosenSpectrum &spectrum, const unsigned int d)
    {
      constexpr unsigned int n = 500; // periods, at equal ratios
      std::vector<double>    periods, accelerations;
      for (unsigned int k = 0; k <= n; ++k)
      {
        periods.push_back(spectrum.last_period *
                          std::pow(SpectrumTable::rigid_period / spectrum.last_period, k / double(n)));
        accelerations.push_back(spectrum.at(periods.back())[d]);
      }
      const double largest = *std::max_element(accelerations.begin(), accelerations.end());
      const auto   is_large = [&](const double a) { return a >= .99 * largest; };
      const auto   k =
          std::find_if(accelerations.begin(), accelerations.end(), is_large) - accelerations.begin();
      double inside = periods[k], outside = periods[std::max<std::ptrdiff_t>(k - 1, 0)];
      for (unsigned int pass = 0; pass < 40; ++pass)
        (is_large(spectrum.at(.5 * (inside + outside))[d]) ? inside : outside) = .5 * (inside + outside);
      const double first = 1. / inside;
      return {first, (first + 2. / SpectrumTable::rigid_period) / 3.};
    }

    /** Returns the modes of the combination, with their accelerations. */
    std::vector<SpectrumResponse::Mode> modes_to_combine(const std::vector<NaturalMode> &modes,
                                                         const ChosenSpectrum &spectrum, const double damping)
    {
      std::vector<SpectrumResponse::Mode> result;
      for (const NaturalMode &mode : modes)
        if (const double period = 1. / mode.frequency; period > SpectrumTable::rigid_period)
          result.push_back({mode, damping, spectrum.at(period), {}});
      for (unsigned int d = 0; d < 3; ++d)
      {
        const auto [first, second] =
            rigid_range(spectrum, d); // first < second, unless all modes are flexible
        for (SpectrumResponse::Mode &m : result)
          m.rigid_share[d] =
              first < second
                  ? std::clamp(std::log(m.mode.frequency / first) / std::log(second / first), 0., 1.)
                  : 0.;
      }
      return result;
    }

    /** Returns the effective mass of the modes relative to the mass of the free nodes [-]. */
    Vector3 share_of(const std::vector<SpectrumResponse::Mode> &modes, const Structure &structure)
    {
      Vector3 share{};
      for (const SpectrumResponse::Mode &m : modes)
        add(share, m.mode.mass_share(structure));
      return share;
    }

    void warn_of_share(const Vector3 &share, const Vector3 &peak, const bool plane_strain)
    {
      std::string low;
      for (unsigned int d = 0; d < 3; ++d)
        if (share[d] < .9 && peak[d] > 0. && !(plane_strain && d == 1))
          low += (low.empty() ? "" : ", ") + number_text(std::floor(1000. * share[d]) / 10.) + " % in " +
                 "xyz"[d];
      if (!low.empty())
        warn(
            "the effective mass of the modes is below 90 % of the mass: " + low +
            ". The rest of the mass follows the peak ground acceleration. Increase the number of modes (--count).");
    }

    /** Returns the combined displacement of a node relative to the base along x, y, z [m]. */
    Vector3 relative_displacement(const Dam &dam, const SpectrumResponse &response,
                                  const std::vector<Vector3> &base, const unsigned int node)
    {
      Vector3            result{};
      const unsigned int e = dam.model->equation[node];
      for (unsigned int c = 0; c < 3 && e != rigid_ground; ++c)
      {
        std::vector<double> of_parts;
        for (std::size_t k = 0; k < base.size(); ++k)
          of_parts.push_back(response.parts()[k].displacement[3 * e + c] - base[k][c]);
        result[c] = response.combine(of_parts);
      }
      return result;
    }

    void print_crest(const Dam &dam, const SpectrumResponse &response)
    {
      std::vector<Vector3> base;
      for (const SpectrumResponse::Part &part : response.parts())
        base.push_back(dam.base_motion(part.displacement));
      Vector3 crown = relative_displacement(dam, response, base, dam.geometry->crown), largest{};
      for (unsigned int i = 0; i < dam.model->n_nodes(); ++i)
        if (dam.model->on_surface(i, PhysicalId::crest))
        {
          const Vector3 u = relative_displacement(dam, response, base, i);
          for (unsigned int c = 0; c < 3; ++c)
            largest[c] = std::max(largest[c], 1e3 * u[c]);
        }
      for (double &x : crown)
        x *= 1e3;
      print_row("displacement of the crown [mm]", crown);
      print_row("largest displacement of the crest [mm]", largest);
    }

    void print_forces(const Dam &dam, const SpectrumResponse &response)
    {
      std::array<std::vector<double>, 3> of_parts;
      for (const SpectrumResponse::Part &part : response.parts())
      {
        const Vector3 force = support_force(dam.structure, part);
        for (unsigned int c = 0; c < 3; ++c)
          of_parts[c].push_back(1e-6 * force[c]);
      }
      print_row("base force [MN]", {{response.combine(of_parts[0]), response.combine(of_parts[1]),
                                     response.combine(of_parts[2])}});
    }

    /** Prints the largest stresses of both faces away from the base. */
    void print_stresses(const Dam &dam, const SpectrumFields &fields)
    {
      const FaceTension near(*dam.model);
      const auto        largest = [&](const std::vector<float> &field, const int surface)
      {
        float result = 0.f;
        for (unsigned int i = 0; i < field.size(); ++i)
          if (dam.model->on_surface(i, surface) && !near.is_near_base(i))
            result = std::max(result, field[i]);
        return 1e-6 * result;
      };
      std::printf("%-42s %10s %10s\n", "stress away from the base, +/- [MPa]", "upstream", "downstream");
      for (const auto &[name, field] :
           {std::make_pair("  arch (horizontal in the face)", &fields.arch),
            std::make_pair("  cantilever (across it in the face)", &fields.cantilever)})
        std::printf("%-42s %10.3f %10.3f\n", name, largest(*field, PhysicalId::upstream),
                    largest(*field, PhysicalId::downstream));
    }

    /** Returns the table of response_spectrum.csv. */
    Table table_of(const std::vector<SpectrumResponse::Mode> &modes, const Structure &structure)
    {
      Table table;
      table.columns = {"mode",
                       "frequency",
                       "damping",
                       "spectral_acceleration_x",
                       "spectral_acceleration_y",
                       "spectral_acceleration_z",
                       "participation_x",
                       "participation_y",
                       "participation_z",
                       "rigid_share_x",
                       "rigid_share_y",
                       "rigid_share_z"};
      for (std::size_t k = 0; k < modes.size(); ++k)
      {
        const Vector3 &a = modes[k].acceleration, factor = modes[k].mode.participation(structure);
        table.rows.push_back({double(k + 1), modes[k].mode.frequency, modes[k].damping, a[0], a[1], a[2],
                              factor[0], factor[1], factor[2], modes[k].rigid_share[0],
                              modes[k].rigid_share[1], modes[k].rigid_share[2]});
      }
      return table;
    }

    void write_fields(const Dam &dam, const SpectrumFields &fields, const std::string &file)
    {
      std::vector<FieldWriter::NodalField> nodal = {{"arch_stress", fields.arch},
                                                    {"cantilever_stress", fields.cantilever}};
      const char *const                    names[] = {"stress_xx", "stress_yy", "stress_zz",
                                                      "stress_xy", "stress_yz", "stress_zx"};
      for (unsigned int c = 0; c < 6; ++c)
      {
        nodal.push_back({names[c], {}});
        for (const Stress &s : fields.stress)
          nodal.back().values.push_back(s[c]);
      }
      FieldWriter(*dam.model).write_vtu(file, fields.displacement, nodal);
    }

    /** Returns the spectrum without the factors of the ground motion. */
    ChosenSpectrum without_factors(const Scene &scene, const std::string &choice)
    {
      if (choice != "design")
      {
        if (!std::filesystem::is_regular_file(file_and_choice(choice).first))
          throw InputError(
              "--spectrum " + choice +
              ": this file cannot be read. Give --spectrum design, or a table of period [s] and acceleration.");
        const SpectrumTable table =
            read_spectrum(choice, "", scene.motion.vertical_ratio, {SpectrumTable::rigid_period, .1});
        if (const double peak = table.at(0, 0.); !table.states_unit && peak < 1.)
          warn(
              "the peak ground acceleration of " + choice + " is " + number_text(peak) +
              " m/s^2, because the file has no headings with a unit. If it is in g, add the headings \"period [s], "
              "acceleration [g]\".");
        const double last = table.periods.back();
        return {choice + " (" + table.note + ")", table.damping > 0. ? table.damping : scene.damping.ratio,
                [=](const double period)
                {
                  if (period > last)
                    throw InputError("The spectrum " + choice + " ends at the period " + number_text(last) +
                                     " s, but a mode has " + number_text(period) + " s. Extend the table.");
                  return Vector3{{table.at(0, period), table.at(1, period), table.at(2, period)}};
                },
                std::min(last, MotionCriteria::last_period)};
      }
      const MotionParameters &motion = scene.motion;
      if (motion.source != "artificial")
        throw InputError("--spectrum design: the scene has no design spectrum, because Motion/Source is " +
                         motion.source + ". Set Motion/Source to artificial, or give a file of a spectrum.");
      return {
          motion.spectrum.code + " (section Motion)", motion.damping,
          [motion](const double period) {
            return Vector3{{motion.target(0, period), motion.target(1, period), motion.target(2, period)}};
          },
          MotionCriteria::last_period};
    }
  } // namespace

  ChosenSpectrum choose_spectrum(const Scene &scene, const std::string &choice)
  {
    ChosenSpectrum spectrum = without_factors(scene, choice);
    Vector3        factor;
    for (unsigned int d = 0; d < 3; ++d)
      factor[d] = std::abs(scene.motion.factor * scene.motion.scale[d] * scene.loads.factor("earthquake"));
    spectrum.at = [unscaled = spectrum.at, factor](const double period)
    {
      const Vector3 a = unscaled(period);
      return Vector3{{factor[0] * a[0], factor[1] * a[1], factor[2] * a[2]}};
    };
    const Vector3 peak = spectrum.at(0.);
    if (!(std::max({peak[0], peak[1], peak[2]}) > 0.))
      throw InputError(
          "--spectrum " + choice +
          ": the peak ground acceleration is zero. Correct the first line of the file, Motion/Factor, "
          "Motion/Scale x, y, z, or Loads/Combination.");
    return spectrum;
  }

  void print_spectrum_analysis(const Dam &dam, const std::vector<NaturalMode> &all,
                               const ChosenSpectrum &spectrum, const std::string &directory)
  {
    const double                              damping = dam.scene.damping.ratio;
    const std::vector<SpectrumResponse::Mode> modes = modes_to_combine(all, spectrum, damping);
    const Vector3                             peak = spectrum.at(0.);
    const SpectrumResponse                    response(dam.structure, modes, peak);
    const SpectrumFields                      fields = spectrum_fields(dam, response);
    Vector3                                   share = share_of(modes, dam.structure), in_g = peak;
    warn_of_share(share, peak, dam.structure.plane_strain);
    if (std::abs(spectrum.damping - damping) > 1e-6)
      warn(
          "the spectrum is for a damping ratio of " + number_text(spectrum.damping) +
          " (of its file, or Motion/Damping), but Damping/Ratio is " + number_text(damping) +
          ". The code has no correction, so the spectral accelerations are unchanged. Make both equal, or give "
          "the spectrum for this damping as a file.");
    for (unsigned int d = 0; d < 3; ++d)
    {
      share[d] *= 100.;
      in_g[d] /= standard_gravity;
    }
    std::printf(
        "\nResponse spectrum %s: complete quadratic combination of %zu modes, damping %g %%;\nsquare root of "
        "the sum of squares of the three directions. Without static values.\n",
        spectrum.name.c_str(), modes.size(), 100. * damping);
    std::printf("%-42s %10s %10s %10s\n", "", "x", "y", "z");
    print_row("peak ground acceleration [g]", in_g);
    print_row("effective mass of the modes [%]", share);
    print_crest(dam, response);
    print_forces(dam, response);
    print_stresses(dam, fields);
    std::fflush(stdout);
    if (directory.empty())
      return;
    table_of(modes, dam.structure).write(directory + "/response_spectrum.csv");
    write_fields(dam, fields, directory + "/response_spectrum.vtu");
  }
} // namespace Voussoir
