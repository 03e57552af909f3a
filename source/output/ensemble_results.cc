// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/output/assessment.h>
#include <voussoir/output/ensemble_results.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace Voussoir
{
  namespace
  {
    constexpr double unknown_value = std::numeric_limits<double>::quiet_NaN();

    /** Returns a percentile of sorted values by linear interpolation. @p share: from 0 to 1. */
    double percentile(const std::vector<double> &sorted, const double share)
    {
      const double      at = share * (sorted.size() - 1);
      const std::size_t k = std::min<std::size_t>(at, sorted.size() - 1);
      return k + 1 == sorted.size() ? sorted[k] : sorted[k] + (at - k) * (sorted[k + 1] - sorted[k]);
    }

    double median_of(std::vector<double> values)
    {
      std::sort(values.begin(), values.end());
      return percentile(values, .5);
    }

    /** Returns the sorted medians of samples with replacement. The sequence of samples is always the same. */
    std::vector<double> medians_of_samples(const std::vector<double> &values)
    {
      constexpr unsigned int n_samples = 2000;
      std::mt19937           random(1);
      std::vector<double>    medians, sample(values.size());
      for (unsigned int k = 0; k < n_samples; ++k)
      {
        for (double &x : sample)
          x = values[random() % values.size()];
        medians.push_back(median_of(sample));
      }
      std::sort(medians.begin(), medians.end());
      return medians;
    }

    std::string quoted(const std::string &text)
    {
      std::string result = "\"";
      for (const char c : text)
        result += c == '"' ? std::string("\"\"") : c == '\n' ? std::string(" ") : std::string(1, c);
      return result + "\"";
    }

    std::vector<double> values_of(const std::vector<const MotionResult *>           &motions,
                                  const std::function<double(const MotionResult &)> &value)
    {
      std::vector<double> values;
      for (const MotionResult *motion : motions)
        values.push_back(value(*motion));
      return values;
    }
  } // namespace

  MotionResult result_of(const JointObserver &joints, const StressObserver &stresses,
                         const Assessment &assessment)
  {
    MotionResult result;
    for (const NamedExtremes &extremes : {joints.extremes(), stresses.extremes()})
      for (const auto &[name, extreme] : extremes)
        if (name.find("above_foot") == std::string::npos)
          result.extremes.emplace_back(name, extreme.value);
    if (!joints.joints.largest.empty())
      result.extremes.emplace_back("kept_opening", joints.kept_opening());
    for (const JointRecorder::Largest &joint : joints.joints.largest)
    {
      result.openings.push_back(joint.opening());
      result.slips.push_back(std::max(joint.slip_upstream, joint.slip_downstream));
    }
    result.overstress = assessment.overstress_seconds().value_or(-1.);
    for (const Verdict &verdict : assessment.all())
      result.limits.emplace_back(verdict.name, verdict.satisfied());
    result.unevaluated = assessment.not_evaluated();
    if (stresses.is_recording())
      for (FieldWriter::NodalField &field : stresses.fields())
        result.fields.emplace_back(field.name, std::move(field.values));
    return result;
  }

  Spread::Spread(std::vector<double> values, const double noise)
  {
    median = p16 = p84 = min = max = known_68 = known_95 = needed = unknown_value;
    if (!std::all_of(values.begin(), values.end(), [](const double x) { return std::isfinite(x); }))
      return;
    std::sort(values.begin(), values.end());
    median = percentile(values, .5);
    p16 = percentile(values, .16);
    p84 = percentile(values, .84);
    min = values.front();
    max = values.back();
    if (values.size() < 3 || !(std::abs(median) > noise))
      return;
    const std::vector<double> medians = medians_of_samples(values);
    const auto                half_width = [&](const double share)
    {
      return .5 * (percentile(medians, .5 + .5 * share) - percentile(medians, .5 - .5 * share)) /
             std::abs(median);
    };
    known_68 = half_width(.68);
    known_95 = half_width(.95);
    if (values.front() * values.back() <= 0.)
      return;
    double sum = 0., squares = 0.;
    for (const double x : values)
      sum += std::log(std::abs(x)), squares += std::log(std::abs(x)) * std::log(std::abs(x));
    const double     n = values.size(), variance = std::max(0., squares - sum * sum / n) / (n - 1.);
    constexpr double of_median = 1.2533 / .1; // sqrt(pi / 2): standard error of a median over that of a mean
    needed = std::max(1., std::ceil(of_median * of_median * variance - 1e-9));
  }

  Json Spread::json() const
  {
    Json json;
    json.add("median", median).add("p16", p16).add("p84", p84).add("min", min).add("max", max);
    return json.add("known_68", known_68).add("known_95", known_95).add("motions_for_10_percent", needed);
  }

  namespace
  {
    bool is_length(const std::string &extreme)
    {
      return extreme == "max_opening" || extreme == "max_slip" || extreme == "kept_opening";
    }

    /** Returns the statistics of an extreme. @p k: its index. */
    Spread spread_of(const std::vector<const MotionResult *> &motions, const std::size_t k)
    {
      constexpr double noise = 1e-6; // [m]
      return Spread(values_of(motions, [&](const MotionResult &m) { return m.extremes[k].second; }),
                    is_length(motions.front()->extremes[k].first) ? noise : 0.);
    }
  } // namespace

  double EnsembleResults::factor() const
  {
    double nearest = motions.front().factor;
    for (const MotionResult &motion : motions)
      if (std::abs(std::log(motion.factor)) < std::abs(std::log(nearest)))
        nearest = motion.factor;
    return nearest;
  }

  std::vector<const MotionResult *> EnsembleResults::with_factor(const double factor) const
  {
    std::vector<const MotionResult *> result;
    for (const MotionResult &motion : motions)
      if (motion.factor == factor && motion.failure.empty())
        result.push_back(&motion);
    return result;
  }

  std::vector<std::string> EnsembleResults::failures() const
  {
    std::vector<std::string> result;
    for (const MotionResult &motion : motions)
      if (!motion.failure.empty())
        result.push_back(motion.name + (motion.factor == 1. ? "" : " times " + number_text(motion.factor)) +
                         " (" + motion.failure + ")");
    return result;
  }

  void EnsembleResults::write_motions(const std::string &file, const std::size_t n_joints) const
  {
    const auto complete = std::find_if(motions.begin(), motions.end(),
                                       [](const MotionResult &motion) { return motion.failure.empty(); });
    OutputFile out(file);
    out << "motion,name,factor,status,overstress_seconds";
    if (complete != motions.end())
      for (const auto &extreme : complete->extremes)
        out << ',' << extreme.first;
    for (const char *quantity : {"opening_", "slip_"})
      for (std::size_t j = 1; j <= n_joints; ++j)
        out << ',' << quantity << j;
    out << '\n';
    const auto add = [&](const double x)
    { out << ',' << (std::isfinite(x) ? number_text(x) : std::string()); };
    for (const MotionResult &motion : motions)
    {
      const bool ok = motion.failure.empty();
      out << &motion - motions.data() + 1 << ',' << quoted(motion.name) << ',' << number_text(motion.factor)
          << ',' << (ok ? "ok" : quoted(motion.failure));
      add(ok && motion.overstress >= 0. ? motion.overstress : unknown_value);
      const std::size_t n_extremes = complete == motions.end() ? 0 : complete->extremes.size();
      for (std::size_t k = 0; k < n_extremes; ++k)
        add(ok ? motion.extremes[k].second : unknown_value);
      for (const std::vector<double> *values : {&motion.openings, &motion.slips})
        for (std::size_t j = 0; j < n_joints; ++j)
          add(ok ? (*values)[j] : unknown_value);
      out << '\n';
    }
    out.check();
  }

  void EnsembleResults::write_joints(const std::string &file, const DamGeometry &geometry) const
  {
    Table table;
    table.columns = {"joint",       "s",        "opening_p16", "opening_median",
                     "opening_p84", "slip_p16", "slip_median", "slip_p84"};
    const auto of_factor = with_factor(factor());
    for (std::size_t j = 0; j < geometry.joints.size() && !of_factor.empty(); ++j)
    {
      const Spread opening(values_of(of_factor, [&](const MotionResult &m) { return m.openings[j]; })),
          slip(values_of(of_factor, [&](const MotionResult &m) { return m.slips[j]; }));
      table.rows.push_back({double(j + 1), geometry.joints[j].arc_length, opening.p16, opening.median,
                            opening.p84, slip.p16, slip.median, slip.p84});
    }
    table.write(file);
  }

  void EnsembleResults::write(const std::string &directory, const Dam &dam) const
  {
    write_motions(directory + "/ensemble.csv", dam.geometry->joints.size());
    write_joints(directory + "/ensemble_joints.csv", *dam.geometry);
    const auto of_factor = with_factor(factor());
    if (of_factor.empty() || of_factor.front()->fields.empty())
      return;
    std::vector<FieldWriter::NodalField> fields;
    for (std::size_t k = 0; k < of_factor.front()->fields.size(); ++k)
    {
      const auto &[name, first] = of_factor.front()->fields[k];
      std::vector<float> median, p16, p84;
      for (std::size_t i = 0; i < first.size(); ++i)
      {
        std::vector<double> values =
            values_of(of_factor, [&](const MotionResult &m) { return m.fields[k].second[i]; });
        std::sort(values.begin(), values.end());
        median.push_back(percentile(values, .5));
        p16.push_back(percentile(values, .16));
        p84.push_back(percentile(values, .84));
      }
      fields.push_back({name, median});
      if (name == "max_principal")
        fields.push_back({name + "_p16", p16}), fields.push_back({name + "_p84", p84});
    }
    const FieldWriter writer(*dam.model);
    writer.write_faces(directory, *dam.geometry, fields);
    writer.write_vtu(directory + "/envelope.vtu", {}, fields);
  }

  Json EnsembleResults::json_of_factor(const double factor) const
  {
    const auto of_factor = with_factor(factor);
    const auto n_all = std::count_if(motions.begin(), motions.end(),
                                     [&](const MotionResult &motion) { return motion.factor == factor; });
    Json       json, exceeded, unevaluated;
    json.add("n", of_factor.size()).add("n_failed", n_all - of_factor.size()).add("factor", factor);
    if (of_factor.empty())
      return json.add("motions_above_limit", exceeded);
    const MotionResult &first = *of_factor.front();
    for (std::size_t k = 0; k < first.extremes.size(); ++k)
      json.add(first.extremes[k].first, spread_of(of_factor, k).json());
    if (first.overstress >= 0.)
      json.add("overstress_seconds",
               Spread(values_of(of_factor, [](const MotionResult &m) { return m.overstress; })).json());
    for (std::size_t k = 0; k < first.limits.size(); ++k)
      exceeded.add(first.limits[k].first,
                   std::count_if(of_factor.begin(), of_factor.end(),
                                 [&](const MotionResult *m) { return !m->limits[k].second; }));
    for (const auto &[name, reason] : first.unevaluated)
      unevaluated.add(name, reason);
    return json.add("motions_above_limit", exceeded).add("limits_not_evaluated", unevaluated);
  }

  Json EnsembleResults::json(const unsigned int lanes) const
  {
    std::vector<std::string> names;
    std::vector<double>      factors;
    for (const MotionResult &motion : motions)
    {
      names.push_back(motion.name);
      if (std::find(factors.begin(), factors.end(), motion.factor) == factors.end())
        factors.push_back(motion.factor);
    }
    Json json = json_of_factor(factor());
    json.add_texts("names", names).add_texts("failures", failures()).add("lanes", lanes);
    std::vector<Json> all;
    for (const double factor : factors)
      all.push_back(json_of_factor(factor));
    return all.size() > 1 ? json.add("factors", all) : json;
  }

  void EnsembleResults::report(Log &log) const
  {
    const auto of_factor = with_factor(factor());
    if (of_factor.empty())
      return;
    log.line("Ensemble  %zu motions%s: median (16 to 84 %%; smallest to largest; the median is known within)",
             of_factor.size(), factor() == 1. ? "" : (" times " + number_text(factor())).c_str());
    for (std::size_t k = 0; k < of_factor.front()->extremes.size(); ++k)
    {
      const std::string &name = of_factor.front()->extremes[k].first;
      const bool         is_in_m = is_length(name);
      if (!is_in_m && name != "max_tension_upstream_away_from_base" &&
          name != "max_tension_downstream_away_from_base" && name != "max_compression_away_from_base")
        continue;
      const Spread spread = spread_of(of_factor, k);
      const double unit = is_in_m ? 1e3 : 1e-6;
      char         known[40] = "unknown";
      if (std::isfinite(spread.known_68))
        std::snprintf(known, sizeof(known), "%.1f %%", 100. * spread.known_68);
      std::string words = name;
      std::replace(words.begin(), words.end(), '_', ' ');
      log.line("          %s %.2f (%.2f to %.2f; %.2f to %.2f; %s) %s", words.c_str(), unit * spread.median,
               unit * spread.p16, unit * spread.p84, unit * spread.min, unit * spread.max, known,
               is_in_m ? "mm" : "MPa");
    }
    for (const std::string &failure : failures())
      log.line("warning: no result of %s", failure.c_str());
  }
} // namespace Voussoir
