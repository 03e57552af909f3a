// SPDX-License-Identifier: GPL-3.0-or-later
// Ground motions: design spectra, response spectra, artificial records, readers, bad input.

#include "testing.h"

#include <voussoir/base/entries.h>
#include <voussoir/base/error.h>
#include <voussoir/base/output_file.h>
#include <voussoir/motion/motion.h>
#include <voussoir/motion/motion_artificial.h>
#include <voussoir/motion/motion_report.h>
#include <voussoir/motion/response_spectrum.h>

#include <algorithm>
#include <cmath>
#include <fstream>

using namespace Voussoir;
using namespace Testing;

namespace
{
  // The numbers are those of the codes' formula with T_g = 0.2 s, to the digits of a published table.
  void design_spectra()
  {
    const DesignSpectrum dl{"DL5073-2000", 0.2, 2.5}, nb{"NB35047-2015", 0.2, 2.5};

    const double table[][3] = {{0.00, 1.0000, 1.0000}, {0.04, 1.6000, 1.6000}, {0.10, 2.5000, 2.5000},
                               {0.20, 2.5000, 2.5000}, {0.25, 2.0451, 2.1867}, {0.30, 1.7356, 1.9601},
                               {0.50, 1.0960, 1.4427}, {0.70, 0.8096, 1.1790}, {1.00, 0.5873, 0.9518},
                               {1.20, 0.5000, 0.8532}, {2.00, 0.5000, 0.6280}, {3.00, 0.5000, 0.5000}};
    for (const auto &row : table)
    {
      expect_within(design_beta(dl, row[0]), row[1], 5e-5, "DL 5073-2000");
      expect_within(design_beta(nb, row[0]), row[2], 5e-5, "NB 35047-2015");
    }
    // Beyond the codes' 3 s it falls with the square of the period.
    const MotionParameters parameters;
    const double           longest = .5 * .5575 * standard_gravity;
    expect_close(parameters.target(0, 3.), longest, 1e-6, "target at 3 s");
    expect_close(parameters.target(0, 6.), longest / 4., 1e-6, "target at 6 s");
    expect_close(parameters.target(2, 9.), .666667 * longest / 9., 1e-6, "vertical target at 9 s");
    // A worked example of the code's users: site II at long period, T_g = 0.35 s.
    expect_within(design_beta({"DL5073-2000", 0.35, 2.5}, 1.5), 0.675, 5e-4, "worked example");
    expect_error([] { design_beta({"GB50011", 0.2, 2.5}, 1.); }, {"GB50011", "DL5073-2000"});
  }

  void response_spectra()
  {
    // A suddenly constant acceleration: the peak is a (1 + exp(-pi zeta / sqrt(1 - zeta^2))).
    const double              zeta = 0.05, a = 3.;
    const std::vector<double> step(2001, a), periods = {0.04, 0.1, 0.5, 3.};
    const double              exact = a * (1. + std::exp(-M_PI * zeta / std::sqrt(1. - zeta * zeta)));
    for (const double value : pseudo_acceleration_spectrum(step, 0.01, periods, zeta))
      expect_within(value, exact, 0.013 * exact, "peak under a step");
    expect_within(pseudo_acceleration_spectrum(step, 0.0005, {0.2}, zeta)[0], exact, 1e-4 * exact,
                  "step, fine");

    // With 20 steps of a period a peak of what oscillates, exp(..) a, is missed by 1 - cos(pi/20) at most.
    const std::vector<double> many = logarithmic_periods(0.04, 3., 40),
                              seen =
                                  pseudo_acceleration_spectrum(std::vector<double>(501, a), 0.01, many, zeta);
    for (std::size_t i = 0; i < many.size(); ++i)
      expect(seen[i] < exact * (1. + 1e-9) &&
                 seen[i] > exact - 1.03 * (1. - std::cos(M_PI / 20.)) * (exact - a),
             "steps of a period of " + text(many[i]) + " s");

    // A ramp of acceleration q t without damping: w^2 u = -q (t - sin(w t) / w), exact at every sample.
    const double        q = 2., period = 0.7, w = 2. * M_PI / period;
    std::vector<double> ramp;
    for (unsigned int k = 0; k <= 100; ++k)
      ramp.push_back(q * 0.01 * k);
    const Oscillator oscillator(period, 0., 0.01);
    const auto       peak = oscillator.peak(ramp);
    expect_within(peak.value, -q * (1. - std::sin(w) / w), 1e-12, "response to a ramp");

    // With damping: w^2 u = -q (t - 2 zeta/w + exp(-zeta w t) (2 zeta/w cos(wd t) - (1 - 2 zeta^2)/wd sin(wd
    // t))).
    for (const double damping : {0.05, 0.4})
    {
      const double wd = w * std::sqrt(1. - damping * damping),
                   free = 2. * damping / w * std::cos(wd) - (1. - 2. * damping * damping) / wd * std::sin(wd);
      expect_within(Oscillator(period, damping, 0.01).peak(ramp).value,
                    -q * (1. - 2. * damping / w + std::exp(-damping * w) * free), 1e-12,
                    "response to a ramp with damping");
    }

    // The sensitivity reproduces the response.
    const std::vector<double> derivative = oscillator.sensitivity(peak.substep, ramp.size());
    double                    response = 0.;
    for (std::size_t k = 0; k < ramp.size(); ++k)
      response += derivative[k] * ramp[k];
    expect_within(response, peak.value, 1e-12, "response from the sensitivity");

    const auto hundred = logarithmic_periods(0.04, 3., 100);
    expect(hundred.size() == 189 && std::abs(hundred.back() - 3.) < 1e-12, "periods");
  }

  /** Mean square of all components from @p begin to @p end [m^2/s^4]. */
  double mean_square(const GroundMotion &motion, const double begin, const double end)
  {
    double       sum = 0.;
    unsigned int n = 0;
    for (std::size_t k = 0; k < motion.acceleration.size(); ++k)
      if (const double t = k * motion.dt; t >= begin && t <= end)
        for (const double x : motion.acceleration[k])
          sum += x * x, ++n;
    return sum / n;
  }

  void artificial_motions()
  {
    for (const std::string code : {"DL5073-2000", "NB35047-2015"})
      for (unsigned int seed = 1; seed <= 3; ++seed)
        for (const double dt : {0.01, 0.005})
        {
          if (dt < 0.01 && seed > 1)
            continue;
          MotionParameters parameters;
          parameters.spectrum.code = code;
          parameters.seed = seed;
          parameters.time_step = dt;
          parameters.scale = {{1., -1., 1.}};
          const GroundMotion motion = make_motion(parameters, "");
          expect(motion.acceleration.size() == parameters.n_steps() + 1, "wrong number of samples");
          expect_within(motion.duration(), 20.48, 1e-9, "duration");

          // Mean squares over that of the plateau. It rises as t^2: an envelope that rises as t would have
          // the limit by itself. It decays as exp(-(t - 11)/4); half of the exponent would make it five times
          // larger.
          const double plateau = mean_square(motion, 2.5, 11.);
          expect(mean_square(motion, 0., .15) < .15 * .15 / (3. * 2.5 * 2.5) * plateau,
                 "rise of the envelope");
          const double decay =
              mean_square(motion, 16., 19.) / plateau * 1.5 / (std::exp(-2.5) - std::exp(-4.));
          expect(decay > .4 && decay < 2.5, "decay of the envelope, measured over exact: " + text(decay));

          const MotionReport report = report_motion(motion, parameters);
          for (unsigned int d = 0; d < 3; ++d)
          {
            const auto  &c = report.components[d];
            const double peak = 0.5575 * standard_gravity * (d == 2 ? 0.666667 : 1.);
            expect_within(c.peak_acceleration, peak, 1e-9 * peak, "peak acceleration");
            expect(c.maximum_error <= 0.10 && c.mean_error <= 0.05, code + ": spectrum not matched");
            expect(std::abs(c.end_velocity) < 1e-9 && std::abs(c.end_displacement) < 1e-9, "drift");
            expect(c.peak_displacement < 2., "displacement out of proportion");
            expect(c.significant_duration > 7. && c.significant_duration < 15., "D5-95");
            expect(std::abs(report.correlations[d]) <= 0.3, "correlation");
            expect(motion.acceleration.front()[d] == 0. && std::abs(motion.acceleration.back()[d]) < 1e-12,
                   "does not begin and end at zero");

            // What a program sees that looks at the samples alone.
            for (const double period : logarithmic_periods(0.04, 3., 100))
            {
              const double sampled = Oscillator(period, 0.05, dt).peak(motion.component(d)).sampled;
              expect_within(sampled / parameters.target(d, period), 1., 0.10, "spectrum at the samples");
            }
          }
          std::ostringstream table;
          print_report(report, table);
          expect(table.str().find("warning") == std::string::npos, table.str());
        }
  }

  void seeds()
  {
    MotionParameters parameters;
    const auto       first = make_artificial_component(parameters, 0, 0);
    expect(first == make_artificial_component(parameters, 0, 0), "the same seed gives another motion");
    parameters.seed = 2;
    expect(first != make_artificial_component(parameters, 0, 0), "another seed gives the same motion");
  }

  void warnings()
  {
    MotionReport report;
    report.artificial = true;
    report.components[1].maximum_error = 0.12;
    report.correlations[2] = -0.4;
    std::ostringstream table;
    print_report(report, table);
    expect(table.str().find("spectrum of y has an error of up to 12.0 %") != std::string::npos, table.str());
    expect(table.str().find("correlation of y-z is -0.400") != std::string::npos, table.str());
  }

  MotionParameters file_parameters()
  {
    MotionParameters parameters;
    parameters.source = "file";
    parameters.duration = 0.03;
    parameters.time_step = 0.01;
    return parameters;
  }

  void readers()
  {
    // Four columns: comments, headings, commas, a later start, half the time step.
    write_text("motion_table.csv",
               "\xEF\xBB\xBF# a record\r\nt, ax, ay, az\r\n5.000,1,10,-100\n5.005,2,20,-200 # "
               "remark\n\n5.010,3,30,-300\n"
               "5.015,4,40,-400\n5.020,5,50,-500\n5.025,6,60,-600\n5.030,7,70,-700\n5.035,8,80,-800\n");
    MotionParameters parameters = file_parameters();
    parameters.file = "motion_table.csv";
    parameters.unit = "cm/s^2";
    parameters.factor = 2.;
    parameters.scale = {{1., 0., -1.}};
    GroundMotion motion = make_motion(parameters, ".");
    expect(motion.acceleration.size() == 4, "table: samples");
    for (unsigned int k = 0; k < 4; ++k)
    {
      expect_within(motion.acceleration[k][0], 0.02 * (1 + 2 * k), 1e-12, "table: x");
      expect_within(motion.acceleration[k][1], 0., 0., "table: y is switched off");
      expect_within(motion.acceleration[k][2], 2. * (1 + 2 * k), 1e-12, "table: z");
    }

    // Two columns, finer than the file: interpolated. PEER's three headers, with a short last line.
    write_text("motion_two.txt", "0 0.0\n0.02\t+1.0D0\n0.04 0.5\n");
    const std::string              title = "PEER STRONG MOTION DATABASE RECORD\nAN EVENT, STATION 5\n"
                                           "ACCELERATION TIME HISTORY IN UNITS OF G\n";
    const std::string              data = "  -.64E-02   .50E-02   0.1   -1.E-03   0.2\n   .25\n";
    const std::vector<std::string> headers = {"    6    0.0100    NPTS, DT\n", "NPTS=  6, DT= .01000 SEC\n",
                                              "NPTS=      6, DT=   .0100 SEC,\n"};
    for (const std::string &header : headers)
    {
      write_text("motion_peer.AT2", title + header + data);
      parameters = file_parameters();
      parameters.component_files[0] = "motion_two.txt";
      parameters.component_files[2] = "motion_peer.AT2";
      parameters.unit = "m/s^2";
      motion = make_motion(parameters, "");
      const double two[] = {0., 0.5, 1., 0.75}, peer[] = {-0.0064, 0.005, 0.1, -0.001};
      for (unsigned int k = 0; k < 4; ++k)
      {
        expect_within(motion.acceleration[k][0], two[k], 1e-12, "two columns");
        expect_within(motion.acceleration[k][1], 0., 0., "absent component");
        expect_within(motion.acceleration[k][2], peer[k] * standard_gravity, 1e-12, "AT2 " + header);
      }
    }
    parameters.unit = "g";
    expect_within(make_motion(parameters, "").acceleration[2][0], standard_gravity, 1e-12, "unit g");
    write_text("motion_gal.AT2",
               "AN EVENT\nACCELERATION TIME SERIES IN UNITS OF CM/S/S\n" + headers[1] + data);
    parameters.component_files[2] = "motion_gal.AT2";
    expect_within(make_motion(parameters, "").acceleration[2][2], .001, 1e-15, "AT2 in cm/s/s");

    // What is written can be read again.
    write_motion(motion, "motion_written.csv");
    parameters = file_parameters();
    parameters.file = "motion_written.csv";
    const GroundMotion same = make_motion(parameters, "");
    for (unsigned int k = 0; k < 4; ++k)
      for (unsigned int d = 0; d < 3; ++d)
        expect_within(same.acceleration[k][d], motion.acceleration[k][d], 1e-10, "written and read");

    parameters = file_parameters();
    parameters.source = "none";
    motion = make_motion(parameters, "");
    expect(motion.acceleration.size() == 4 && motion.sample(2)[0] == 0., "Source = none");
  }

  void bad_files()
  {
    const auto table = [](const std::string &text)
    {
      write_text("motion_bad.txt", text);
      MotionParameters parameters = file_parameters();
      parameters.component_files[1] = "motion_bad.txt";
      return [parameters] { make_motion(parameters, ""); };
    };
    expect_error(table("0 1\n.01 2\n.02 3\n"), {"motion_bad.txt", "0.02 s", "Motion/Duration", "0.03"});
    expect_error(table("t a\n0 1\n.01 nan\n.02 3\n"), {"motion_bad.txt", "line 3", "nan"});
    expect_error(table("0 1\n.01 1e999\n.02 3\n"), {"line 2", "1e999"});
    expect_error(table("0 1\n\n.01 1,5x\n"), {"line 3", "columns"});
    expect_error(table("0 1\n.01 5x\n"), {"line 2", "5x"});
    expect_error(table("# t a\n0 1\n.01 2\n.005 3\n"), {"line 4", "increase"});
    expect_error(table("0 1\n.01 2\n.02 3\n.04 4\n.05 3\n"), {"line 4", "equal steps"});
    expect_error(table("0 1 2 3\n"), {"line 1", "4 columns", "Motion/File"});
    expect_error(table("t a\n"), {"motion_bad.txt", "two"});
    expect_error(table("X\nY\nZ\n6 .01 NPTS, DT\n1 2 3\n4 5\n"),
                 {"line 4", "states 6 values", "there are 5"});
    expect_error(table("X\nY\nZ\nNPTS= 2, DT= -.01 SEC\n1 2\n"), {"line 4", "positive"});
    expect_error(table("X\nY\nZ\nNPTS= 2, DT= .01 SEC\n1 2*\n"), {"line 5", "2*"});
    expect_error(table("X\nY\nVELOCITY IN CM/S\nNPTS= 2, DT= .01 SEC\n1 2\n"), {"line 3", "acceleration"});

    MotionParameters parameters = file_parameters();
    expect_error([&] { make_motion(parameters, ""); }, {"Motion/File"});
    parameters.file = "no such file.csv";
    expect_error([&] { make_motion(parameters, "scenes"); }, {"scenes/no such file.csv", "cannot be opened"});
    parameters.component_files[0] = "motion_two.txt";
    expect_error([&] { make_motion(parameters, ""); }, {"both"});
    parameters.file = "";
    parameters.component_files[2] = "motion_late.txt";
    write_text("motion_late.txt", "1 0\n1.02 1\n1.04 0\n");
    expect_error([&] { make_motion(parameters, ""); }, {"motion_late.txt", "first time"});
    expect_error<WriteError>([] { write_motion({}, "no such directory/motion.csv"); },
                             {"no such directory/motion.csv"});
  }

  void entries()
  {
    MotionParameters parameters;
    Entries          prm;
    parameters.add_parameters(prm);
    expect(parameters.vertical_ratio == 0.666667 && parameters.peak_acceleration == 0.5575,
           "defaults change");
    parameters.check();
    prm.parse_input_from_string(
        "subsection Motion\n set Spectrum = NB35047-2015\n set Seed = 7\n set Scale z = 0\n"
        " set Damping = 0.03\n set File x = a b.AT2\nend\n");
    expect(parameters.spectrum.code == "NB35047-2015" && parameters.seed == 7 && parameters.scale[2] == 0. &&
               parameters.damping == 0.03 && parameters.component_files[0] == "a b.AT2",
           "entries are not read");

    const auto wrong = [](const std::function<void(MotionParameters &)> &change, const std::string &entry)
    {
      MotionParameters parameters;
      change(parameters);
      expect_error([&] { parameters.check(); }, {"Motion/" + entry});
    };
    wrong([](MotionParameters &p) { p.time_step = 0.; }, "Time step");
    wrong([](MotionParameters &p) { p.time_step = NAN; }, "Time step");
    wrong([](MotionParameters &p) { p.duration = -2.; }, "Duration");
    wrong([](MotionParameters &p) { p.duration = 20.485; }, "Duration");
    wrong([](MotionParameters &p) { p.duration = 10., p.decay_begin = 11.; }, "Duration");
    wrong([](MotionParameters &p) { p.file = "a.csv"; }, "Source");
    wrong([](MotionParameters &p) { p.decay_begin = 2.; }, "Decay begin");
    wrong([](MotionParameters &p) { p.vertical_ratio = 0.; }, "Vertical ratio");
    wrong([](MotionParameters &p) { p.spectrum.characteristic_period = 0.; }, "Characteristic period");
  }
} // namespace

int main(int argc, char **argv)
{
  return run({{"design_spectra", design_spectra},
              {"response_spectra", response_spectra},
              {"artificial_motions", artificial_motions},
              {"seeds", seeds},
              {"warnings", warnings},
              {"readers", readers},
              {"bad_files", bad_files},
              {"entries", entries}},
             argc, argv);
}
