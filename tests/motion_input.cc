// SPDX-License-Identifier: GPL-3.0-or-later
// What goes into a motion: resampling of records, records of unequal length and step, scaling, envelopes of
// short motions, residual motions at the end, and input that must be refused.

#include "testing.h"

#include <voussoir/base/entries.h>
#include <voussoir/base/error.h>
#include <voussoir/motion/motion.h>
#include <voussoir/motion/motion_report.h>
#include <voussoir/motion/record_processing.h>
#include <voussoir/motion/resample.h>
#include <voussoir/motion/response_spectrum.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <set>
#include <sys/stat.h>

using namespace Voussoir;
using namespace Testing;

namespace
{
  std::vector<double> sine(double frequency, double phase, double dt, std::size_t n)
  {
    std::vector<double> a;
    for (std::size_t k = 0; k < n; ++k)
      a.push_back(std::sin(2. * M_PI * frequency * k * dt + phase));
    return a;
  }

  /** Returns the largest difference of two records, without @p margin samples at each end. */
  double difference(const std::vector<double> &a, const std::vector<double> &b, std::size_t margin)
  {
    expect(a.size() == b.size() && a.size() > 2 * margin, "lengths");
    double largest = 0.;
    for (std::size_t k = margin; k + margin < a.size(); ++k)
      largest = std::max(largest, std::abs(a[k] - b[k]));
    return largest;
  }

  // Steps of 5, 2 and 4 ms to 10 ms, whose Nyquist frequency is 50 Hz.
  void resampling()
  {
    const double new_dt = 0.01;
    for (const double dt : {0.005, 0.002, 0.004})
    {
      const std::size_t n_old = std::lround(10. / dt) + 1, n = 1001;
      for (const double f : {0.5, 3., 12.5, 25., 39.})
      {
        const auto a = resample(sine(f, 0.7, dt, n_old), dt, new_dt, n);
        expect_within(difference(a, sine(f, 0.7, new_dt, n), 30), 0., 3e-4, "a sine of the pass band");
        const auto from_rest = resample(sine(f, 0., dt, n_old), dt, new_dt, n); // whole periods: to its ends
        expect_within(difference(from_rest, sine(f, 0., new_dt, n), 0), 0., 1e-3, "its ends");
      }
      for (const double f : {50.5, 60., 70., 87.5, 99.5})
      {
        const std::vector<double> none(n, 0.);
        const auto                a = resample(sine(f, 0.7, dt, n_old), dt, new_dt, n);
        expect_within(difference(a, none, 30), 0., 3e-4, "a sine above the new Nyquist frequency");
      }
      // Straight lines stay, to the ends.
      std::vector<double> line, expected;
      for (std::size_t k = 0; k < n_old; ++k)
        line.push_back(2. - 0.3 * k * dt);
      for (std::size_t k = 0; k < n; ++k)
        expected.push_back(2. - 0.3 * k * new_dt);
      expect_within(difference(resample(line, dt, new_dt, n), expected, 0), 0., 1e-6, "a straight line");
    }
    // To a finer step: linear, and the same step is untouched, even with a rounded interval.
    const auto                finer = resample({1., 3., 2.}, 0.02, 0.005, 9);
    const std::vector<double> exact = {1., 1.5, 2., 2.5, 3., 2.75, 2.5, 2.25, 2.};
    expect_within(difference(finer, exact, 0), 0., 1e-14, "linear interpolation");
    const auto wild = sine(49., 1., 0.01, 500);
    expect_within(difference(resample(wild, 0.01, 0.01, 500), wild, 0), 0., 1e-12, "the same step");
    expect_within(difference(resample(wild, 0.00999999, 0.01, 499), sine(49., 1., 0.01, 499), 0), 0., 1e-2,
                  "a rounded step");
  }

  std::string table(const std::vector<double> &a, double dt, double start = 0.)
  {
    std::ostringstream text;
    text.precision(15);
    for (std::size_t k = 0; k < a.size(); ++k)
      text << start + k * dt << ' ' << a[k] << '\n';
    return text.str();
  }

  MotionParameters file_parameters()
  {
    MotionParameters parameters;
    parameters.source = "file";
    parameters.time_step = 0.01;
    return parameters;
  }

  // Three records with steps of 5, 10 and 20 ms, which last 4, 5 and 3.5 s.
  void unequal_records()
  {
    write_text("input_x.txt", table(sine(2., 0., 0.005, 801), 0.005));
    write_text("input_y.txt", table(sine(2., 0., 0.01, 501), 0.01));
    write_text("input_z.txt", table(sine(2., 0., 0.02, 176), 0.02));
    MotionParameters p = file_parameters();
    p.component_files = {{"input_x.txt", "input_y.txt", "input_z.txt"}};
    const GroundMotion motion = make_motion(p, "");
    expect(motion.acceleration.size() == 351, "not as long as the shortest record");
    const auto expected = sine(2., 0., 0.01, 351);
    expect_within(difference(motion.component(0), expected, 0), 0., 3e-4, "filtered");
    expect_within(difference(motion.component(1), expected, 0), 0., 1e-13, "as it is");
    expect_within(difference(motion.component(2), expected, 0), 0., 0.5 * std::pow(2. * M_PI * 2. * 0.01, 2),
                  "interpolated");
    expect(motion.notes.size() == 5 && motion.notes[0].find("3.5 s") != std::string::npos &&
               motion.notes[0].find("input_z.txt") != std::string::npos &&
               std::any_of(motion.notes.begin(), motion.notes.end(),
                           [](const std::string &note) { return note.find("50 Hz") != std::string::npos; }),
           "notes");
    p.duration = 3.;
    expect(make_motion(p, "").acceleration.size() == 301, "Duration that is set");
    p.duration = 4.;
    expect_error([&] { make_motion(p, ""); }, {"input_z.txt", "3.5 s", "Motion/Duration", "4 s"});
    p.duration = -1.;
    p.time_step = 4.;
    expect_error([&] { make_motion(p, ""); }, {"input_z.txt", "less than one", "Time step"});
    p.time_step = 1e-9;
    expect_error([&] { make_motion(p, ""); }, {"ten million", "Time step"});
  }

  // A station whose record begins later: as with zeros before; a delay of no whole number of steps is interpolated.
  void delayed_stations()
  {
    const auto a = sine(2., .3, .01, 301), b = sine(3., .7, .01, 301);
    write_text("input_base.txt", table(a, .01, 3.));
    MotionParameters p = file_parameters();
    p.component_files = {{"input_base.txt", "", ""}};
    p.abutments = {{"left 5", "input_station.txt, -, -"}};
    const auto station = [&](const std::vector<double> &samples, const double start)
    {
      write_text("input_station.txt", table(samples, .01, start));
      return make_motion(p, "").stations.at(0).acceleration;
    };
    std::vector<double> with_zeros(50, 0.);
    with_zeros.insert(with_zeros.end(), b.begin(), b.end());
    const auto late = station(b, 3.5), padded = station(with_zeros, 3.);
    for (std::size_t k = 0; k < 301; ++k)
      expect_within(late[k][0], padded[k][0], 1e-10, "zeros before the first time");
    const auto later = station(b, 3.137);
    expect(later.size() == 301 && later[13][0] == 0., "zero before");
    for (std::size_t k = 14; k < 301; ++k)
      expect_within(later[k][0], .7 * b[k - 14] + .3 * b[k - 13], 1e-9, "linear between the samples");
    p.baseline = "linear"; // of the record alone
    const auto corrected = without_baseline(std::vector<double>(b.begin(), b.begin() + 251), 1);
    const auto baseline = station(b, 3.5);
    for (std::size_t k = 0; k < 301; ++k)
      expect_within(baseline[k][0], k < 50 ? 0. : corrected[k - 50], 1e-10, "baseline of a later record");
    p.baseline = "none";
    expect_error([&] { station(b, 2.9); }, {"left 5", "begins at 2.9 s", "begins at 3 s"});
    expect_error(
        [&] {
          station({b.begin(), b.begin() + 200}, 3.5);
        },
        {"left 5", "ends at 5.49 s", "ends at 6 s", "Duration", "at most 2.49 s"});
    expect_error([&] { station(b, 6.5); }, {"left 5", "begins at 6.5 s", "after the end"});
  }

  void factors()
  {
    MotionParameters   p;
    const GroundMotion one = make_motion(p, "");
    p.factor = -0.5;
    p.scale = {{1., 2., 1.}};
    const GroundMotion half = make_motion(p, "");
    expect(one.acceleration.size() == 2049 && half.acceleration.size() == 2049, "default duration");
    for (std::size_t k = 0; k < one.acceleration.size(); ++k)
    {
      expect_within(half.acceleration[k][0], -0.5 * one.acceleration[k][0], 1e-14, "Factor, artificial, x");
      expect_within(half.acceleration[k][1], -one.acceleration[k][1], 1e-14, "Factor, artificial, y");
    }
    expect(motion_warnings(report_motion(half, p)).empty(), "the spectrum to match is scaled, too");
  }

  // An artificial motion is as good as the default one when it is shorter, without entries for the envelope.
  void short_motions()
  {
    MotionParameters p;
    for (const double duration : {11.5, 15.36, 20.48, 40.})
    {
      p.duration = duration;
      const MotionEnvelope e = p.envelope();
      expect(e.rise_end == 2.5 && e.decay_begin == 11. && e.decay_rate == 0.25, "envelope of long motions");
    }
    for (const double duration : {0.2, 0.5, 1., 2.5, 5., 10., 12.})
    {
      p.duration = duration;
      p.check();
      const MotionReport report = report_motion(make_motion(p, ""), p);
      for (const auto &c : report.components)
      {
        expect(std::isfinite(c.maximum_error), "not finite");
        expect(std::abs(c.end_velocity) < 1e-9 && std::abs(c.end_displacement) < 1e-9, "drift");
        if (duration >= 5.)
          expect(c.maximum_error <= 0.10, "a motion of " + std::to_string(duration) + " s does not match");
      }
      expect_within(report.components[0].peak_acceleration, 0.5575 * standard_gravity, 1e-6, "peak");
    }
    p.duration = 5.;
    p.decay_begin = 3.; // with the usual rise
    expect(p.envelope().decay_begin == 3. && p.envelope().rise_end == 2.5 && p.envelope().decay_rate == 0.25,
           "one entry that is set");
    p.decay_begin = 2.; // too early for it
    expect(p.envelope().decay_begin == 2. && std::abs(p.envelope().rise_end - 2.5 / 3.) < 1e-12,
           "one entry that is set, early");
    p.decay_begin = 6.;
    expect_error([&] { p.check(); }, {"Motion/Duration is 5", "Decay begin, 6 s"});
    p.decay_begin = -1.;
    p.rise_end = 4.;
    expect(p.envelope().decay_begin == 4.5, "a decay that begins after the rise that is set");
    p.check();
    p.rise_end = 5.5;
    expect_error([&] { p.check(); }, {"Motion/Decay begin", "Rise end, 5.5 s"});
  }

  void ends()
  {
    GroundMotion motion;
    motion.dt = 0.01;
    for (const double a : sine(1., 0., 0.01, 1001)) // from rest: velocity never negative, it drifts away
      motion.acceleration.push_back({{a, 0., 0.}});
    MotionParameters p = file_parameters();
    auto             warnings = motion_warnings(report_motion(motion, p));
    expect(warnings.size() == 1 && warnings[0].find("in x") != std::string::npos &&
               warnings[0].find("100 %") != std::string::npos,
           "drift produces no warning");
    // Back and forth, to rest at its place: a tenth of the displacement (1 - cos wt)^2.
    for (std::size_t k = 0; k < motion.acceleration.size(); ++k)
    {
      const double w = 2. * M_PI * 0.5, t = k * 0.01, c = std::cos(w * t), s = std::sin(w * t);
      motion.acceleration[k][0] = .2 * w * w * (s * s + c * (1. - c));
    }
    warnings = motion_warnings(report_motion(motion, p));
    expect(warnings.empty(),
           "a motion that ends at rest produces a warning: " + (warnings.empty() ? "" : warnings[0]));
    motion.acceleration.resize(751); // cut in its middle
    expect(motion_warnings(report_motion(motion, p)).size() == 1, "a cut motion produces no warning");
  }

  /** a = (3 t - 1, 2, -t): v and u by hand, also with three steps per sample and twice the size. */
  void arithmetic()
  {
    GroundMotion motion;
    motion.dt = .25;
    for (unsigned int k = 0; k < 9; ++k)
      motion.acceleration.push_back({{.75 * k - 1., 2., -.25 * k}});
    for (const unsigned int n : {1, 3})
      for (const double factor : {1., 2.})
      {
        const GroundMotion other = motion.refined(n).scaled(factor);
        expect(other.acceleration.size() == 8 * n + 1, "number of samples");
        expect_within(other.duration(), 2., 1e-14, "duration");
        const MotionIntegrals integrals = other.integrated();
        for (std::size_t k = 0; k < other.acceleration.size(); ++k)
        {
          const double t = k * other.dt, a[] = {3. * t - 1., 2., -t},
                       v[] = {1.5 * t * t - t, 2. * t, -.5 * t * t},
                       u[] = {.5 * t * t * t - .5 * t * t, t * t, -t * t * t / 6.};
          for (unsigned int c = 0; c < 3; ++c)
          {
            expect_within(other.acceleration[k][c], factor * a[c], 1e-13, "acceleration");
            expect_within(integrals.velocity[k][c], factor * v[c], 1e-13, "velocity");
            expect_within(integrals.displacement[k][c], factor * u[c], 1e-13, "displacement");
          }
        }
      }
  }

  std::vector<double> plus(std::vector<double> a, const std::vector<double> &b)
  {
    for (std::size_t k = 0; k < a.size(); ++k)
      a[k] += b[k];
    return a;
  }

  void baselines()
  {
    const std::size_t   n = 1001;
    std::vector<double> record = sine(1.3, .4, .01, n), line(n), parabola(n), square(n), fitted(n);
    for (std::size_t k = 0; k < n; ++k)
    {
      const double t = .01 * k;
      line[k] = .7 - .11 * t;
      parabola[k] = line[k] + .02 * t * t;
      square[k] = t * t;
      fitted[k] = 10. * t - 100. / 6.; // least-squares line of t^2 from 0 to 10 s
    }
    for (const unsigned int degree : {1, 2})
    {
      const std::vector<double> &added = degree == 1 ? line : parabola,
                                once = without_baseline(record, degree);
      expect_within(difference(without_baseline(plus(once, added), degree), once, 0), 0., 1e-14,
                    "a record with a baseline");
      expect_within(difference(without_baseline(added, degree), std::vector<double>(n, 0.), 0), 0., 1e-14,
                    "a baseline");
      GroundMotion motion;
      motion.dt = .01;
      for (const double a : without_baseline(plus(record, added), degree))
        motion.acceleration.push_back({{a, 0., 0.}});
      const MotionIntegrals integrals = motion.integrated();
      expect_within(integrals.velocity.back()[0], 0., 1e-13, "velocity at the end");
      expect_within(integrals.displacement.back()[0], 0., 1e-12, "displacement at the end");
    }
    // With rests: the ground is at rest after each part, also with a jump at the ends of the record.
    std::vector<double> jumping(n);
    for (std::size_t k = 0; k < n; ++k)
      jumping[k] = line[k] + std::cos(.01 * k);
    write_text("input_jumping.txt", table(jumping, .01));
    for (const char *baseline : {"linear", "quadratic"})
    {
      MotionParameters rests = file_parameters();
      rests.sequence = "input_jumping.txt, input_jumping.txt, input_jumping.txt; input_jumping.txt, -, -";
      rests.baseline = baseline;
      rests.rest = 1.;
      const GroundMotion    both = make_motion(rests, "");
      const MotionIntegrals of = both.integrated();
      for (const double time : {10., 11., 21.5})
      {
        const std::size_t k = std::lround(time / .01);
        expect_within(of.velocity[k][0], 0., 1e-12, std::string(baseline) + ": velocity in a rest");
        expect_within(of.displacement[k][0], 0., 1e-11, std::string(baseline) + ": displacement in a rest");
      }
    }
    // The interpolation of t^2 has an error of dt^2/6 on average.
    expect_within(difference(plus(without_baseline(square, 1), fitted), square, 0), 0., 2e-5, "line of t^2");

    write_text("input_drift.txt", table(plus(record, line), .01));
    MotionParameters p = file_parameters();
    p.component_files[2] = "input_drift.txt";
    p.baseline = "linear";
    p.factor = -3.;
    p.scale[2] = 2.;
    const GroundMotion  motion = make_motion(p, "");
    std::vector<double> expected = without_baseline(record, 1);
    for (double &a : expected)
      a *= -6.;
    expect_within(difference(motion.component(2), expected, 0), 0., 1e-12, "baseline and factors");
    expect(motion.notes.size() == 3 && motion.notes[2].find("z: linear baseline") == 0,
           "note of the baseline");
  }

  /** Text of the target spectrum of design_beta() at the periods of make_artificial_motion(), in all digits. */
  std::string spectrum_text(const MotionParameters &p, const bool three)
  {
    std::set<double> periods = {0.};
    std::size_t      n_points = 1;
    while (n_points <= p.n_steps())
      n_points *= 2;
    const double df = 1. / (n_points * p.time_step);
    for (std::size_t k = 1; k < n_points / 2 && k * df <= 1.25 / .04; ++k)
      periods.insert(1. / (k * df));
    for (const auto &more : {logarithmic_periods(.04, 3., 100), logarithmic_periods(3., 20., 10),
                             logarithmic_periods(.04, 3., 200)})
      periods.insert(more.begin(), more.end());
    std::ostringstream text;
    text.precision(17);
    for (const double period : periods)
    {
      text << period;
      for (unsigned int d = 0; d < (three ? 3 : 1); ++d)
        text << ',' << p.target(d, period);
      text << '\n';
    }
    return text.str();
  }

  void target_spectra()
  {
    MotionParameters p;
    p.duration = 5.;
    const GroundMotion built_in = make_motion(p, "");
    for (const bool three : {true, false})
    {
      write_text("input_target.csv", "T, Sa (m/s2)\n" + spectrum_text(p, three));
      MotionParameters with_file = p;
      with_file.target_file = "input_target.csv";
      with_file.peak_acceleration = 1.; // without effect
      const GroundMotion same = make_motion(with_file, "");
      for (unsigned int d = 0; d < (three ? 3 : 2); ++d)
        expect(same.component(d) == built_in.component(d), "the spectrum of the code from a file");
      expect_within(difference(same.component(2), built_in.component(2), 0), 0., 1e-6, "Vertical ratio");
    }
    // Power laws between periods, linear after 0, constant displacement beyond.
    write_text("input_target.csv", "0 0.2\n.02 .3\n.1 .5\n1 .05\n4 .0125\n");
    p.target_file = "input_target.csv";
    p.unit = "g";
    p.read_target("");
    const double g = standard_gravity;
    expect_within(p.target(0, 0.), .2 * g, 1e-14, "peak acceleration");
    expect_within(p.target(1, .01), .25 * g, 1e-14, "after 0");
    expect_within(p.target(0, .2), .25 * g, 1e-13, "power law");
    expect_within(p.target(2, 2.), .025 * .666667 * g, 1e-13, "vertical");
    expect_within(p.target(0, 8.), .0125 / 4. * g, 1e-14, "beyond");

    const auto bad = [&](const std::string &text)
    {
      write_text("input_target.csv", text);
      return [=] { make_motion(p, ""); };
    };
    expect_error(bad("0 1\n.1 2 3\n3 1\n"), {"Spectrum 'input_target.csv', line 2", "3 columns"});
    expect_error(bad("0 1 1\n3 1 1\n"), {"line 1", "3 columns"});
    expect_error(bad("0 1\n.1 nan\n3 1\n"), {"input_target.csv', line 2", "nan"});
    expect_error(bad("0 1\n.1 -1\n3 1\n"), {"line 2", "-1", "positive"});
    expect_error(bad("0 1\n.2 1\n.1 1\n3 1\n"), {"line 3", "0.1 s", "increase"});
    expect_error(bad("-.1 1\n3 1\n"), {"line 1", "negative"});
    expect_error(bad(".04 1\n3 1\n"), {"input_target.csv", "at most 0.02 s", "0.04 s to 3 s"});
    expect_error(bad("0 1\n2 1\n"), {"at 3 s or later", "0 s to 2 s"});
    expect_error(bad("T Sa\n"), {"no numbers"});
    expect_error(bad("# 2% damping\nT Sa [cm/s2]\n0 1\n3 1\n"),
                 {"damping ratio of 0.02", "Motion/Damping is 0.05"});
    p.target_file = "input_none.csv";
    expect_error([&] { make_motion(p, ""); }, {"input_none.csv", "cannot be opened"});
  }

  void wrong_entries()
  {
    const auto wrong = [](const std::function<void(MotionParameters &)> &change, const std::string &entry)
    {
      MotionParameters p;
      change(p);
      expect_error([&] { p.check(); }, {"Motion/" + entry});
    };
    const double inf = HUGE_VAL;
    for (const double value : {1e308, inf, -inf, double(NAN), 0.})
    {
      wrong([&](MotionParameters &p) { p.peak_acceleration = value; }, "Peak acceleration");
      wrong([&](MotionParameters &p) { p.vertical_ratio = value; }, "Vertical ratio");
      wrong([&](MotionParameters &p) { p.spectrum.maximum_beta = value; }, "Maximum beta");
      wrong([&](MotionParameters &p) { p.spectrum.characteristic_period = value; }, "Characteristic period");
      wrong([&](MotionParameters &p) { p.damping = value; }, "Damping");
      wrong([&](MotionParameters &p) { p.time_step = value; }, "Time step");
      wrong([&](MotionParameters &p) { p.duration = value; }, value > 1. ? "" : "Duration");
      wrong([&](MotionParameters &p) { p.rise_end = value; }, value > 1. ? "Decay begin" : "Rise end");
      wrong([&](MotionParameters &p) { p.decay_begin = value; }, value > 1. ? "Duration" : "Decay begin");
      if (value != 0.)
      {
        wrong([&](MotionParameters &p) { p.decay_rate = value; }, "Decay rate");
        wrong([&](MotionParameters &p) { p.factor = value; }, "Factor");
        wrong([&](MotionParameters &p) { p.scale[2] = value; }, "Scale z");
      }
    }
    wrong([](MotionParameters &p) { p.duration = -2.; }, "Duration");
    wrong([](MotionParameters &p) { p.rest = -2.; }, "Rest");
    wrong([](MotionParameters &p) { p.rest = NAN; }, "Rest");
    wrong([](MotionParameters &p) { p.rest = .015; }, "Rest");
    wrong([](MotionParameters &p) { p.sequence = "1;2", p.rest = 0.; }, "Rest");
    for (const std::string sequence : {"1;", ";", "1; a.csv", "-1", "1.5", "1 2"})
      wrong([&](MotionParameters &p) { p.sequence = sequence; }, "Sequence");
    for (const std::string sequence : {"a;;b", "a;b;", "a,b", "a,b,", "a,,c", "a,b,c,d", "-", "-,-,-", ",,"})
      wrong([&](MotionParameters &p) { p.source = "file", p.sequence = sequence; }, "Sequence");
    wrong([](MotionParameters &p) { p.source = "file", p.sequence = "a;b", p.file = "c"; }, "Sequence");
    wrong([](MotionParameters &p) { p.source = "file", p.file = "a", p.match = "true"; }, "Match");
    wrong([](MotionParameters &p)
          { p.source = "file", p.file = "a", p.match = "true", p.target_file = "b", p.time_step = .05; },
          "Time step");
    wrong([](MotionParameters &p) { p.duration = 0.1; }, "Duration");
    wrong([](MotionParameters &p) { p.duration = 3000.; }, "Duration");
    MotionParameters p;
    p.factor = 1e4;
    expect_error([&] { make_motion(p, ""); }, {"1000 g", "Factor"});

    MotionParameters declared;
    Entries          prm;
    declared.add_parameters(prm);
    for (const std::string entry : {"Seed = -1", "Matching iterations = -1", "Matching iterations = 5000000"})
    {
      bool refused = false;
      try
      {
        prm.parse_input_from_string("subsection Motion\n set " + entry + "\nend\n");
      }
      catch (const dealii::ExceptionBase &)
      {
        refused = true;
      }
      expect(refused, entry + " is not refused");
    }
  }

  void wrong_files()
  {
    MotionParameters p = file_parameters();
    const auto       read = [&](const std::string &text, bool three = false)
    {
      write_text("input_bad.txt", text);
      p.file = three ? "input_bad.txt" : "";
      p.component_files[0] = three ? "" : "input_bad.txt";
      return [=] { make_motion(p, ""); };
    };
    const std::string good = "0 0\n.01 1\n.02 0\n";
    read(good)();
    read("t;a\r\n0;0\r\n.01;1e-400\r\n.02;0\r\n")();
    read("t a\r0 0\r.01 1\r.02 0\r")();
    read("0 0 0 0\n.01 1 1 1\n", true)();
    expect_error(read("t a\r\n0 0\r\n.01 x\r\n"), {"line 3", "'x'"});
    expect_error(read(good.substr(0, 4)), {"input_bad.txt", "fewer than two"});
    expect_error(read(""), {"input_bad.txt", "fewer than two"});
    expect_error(read("O.00 1\n.01 1\n.02 0\n"), {"line 1", "O.00"}); // a letter: not headings
    expect_error(read("a record\ns m/s2\n" + good), {"line 2", "'s'"});
    expect_error(read("a record\nof a place\n" + good), {"line 2", "headings"});
    expect_error(read("0,0;1,5\n0,01;2,5\n"), {"line 1", "4 columns"}); // decimal commas
    expect_error(read(good + "\n.03 0 0\n"), {"line 5", "3 columns"});
    expect_error(read(good + ".02 0\n"), {"line 4", "increase"});
    expect_error(read("0 0\n1e308 1\n2e308 1\n"), {"line 3", "2e308"});
    expect_error(read("0 0\n.01 1e308\n.02 0\n"), {"1000 g"});
    expect_error(read("0 0\n.01 -inf\n.02 0\n"), {"line 2", "-inf"});
    expect_error(read("0 0\n.01 1\0\n.02 0\n" + std::string(1, '\0')), {"plain text"});
    std::string
        drifts; // each step within 5 % of the usual one, but 2 % more on the average of the second half
    for (unsigned int k = 0; k <= 200; ++k)
      drifts += std::to_string(k * .01 + (k > 100 ? (k - 100) * .0004 : 0.)) + " 0\n";
    expect_error(read(drifts), {"line", "equal steps"});
    expect_error(read("0 0\n" + std::string(1100000, '1')), {"line 2", "million characters"});
    expect_error(read("A\nB\nC\nNPTS= 3, DT= .01 SEC\n0 1\n"), {"line 4", "states 3 values", "there are 2"});
    expect_error(read("A\nB\nC\nNPTS= 3, DT= .01 SEC\n0 1 2 3\n"),
                 {"line 4", "states 3 values", "there are 4"});
    expect_error(read("A\nB\nC\nNPTS= 3, DT= nan SEC\n0 1 2\n"), {"line 4", "positive"});

    p = file_parameters();
    const auto from = [&](const std::string &name)
    {
      p.component_files[1] = name;
      return [=] { make_motion(p, ""); };
    };
    std::filesystem::create_directories("input_directory");
    ::mkfifo("input_pipe", 0600);
    {
      write_text("input_huge.txt", "");
      std::filesystem::resize_file("input_huge.txt", 200000000); // sparse
    }
    expect_error(from("input_directory"), {"input_directory", "directory"});
    expect_error(from("input_pipe"), {"input_pipe", "pipe"});
    expect_error(from("/dev/zero"), {"/dev/zero", "device"});
    expect_error(from("input_huge.txt"), {"input_huge.txt", "100 MB"});
    std::filesystem::remove("input_huge.txt");
    std::filesystem::remove("input_pipe");
  }
} // namespace

int main(int argc, char **argv)
{
  return run({{"resampling", resampling},
              {"unequal_records", unequal_records},
              {"delayed_stations", delayed_stations},
              {"factors", factors},
              {"short_motions", short_motions},
              {"ends", ends},
              {"arithmetic", arithmetic},
              {"baselines", baselines},
              {"target_spectra", target_spectra},
              {"wrong_entries", wrong_entries},
              {"wrong_files", wrong_files}},
             argc, argv);
}
