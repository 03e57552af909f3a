// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/entries.h>
#include <voussoir/base/error.h>
#include <voussoir/base/number_text.h>
#include <voussoir/base/units.h>
#include <voussoir/dam/scene.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace Voussoir
{
  using dealii::Patterns::Double;

  void DampingParameters::add_parameters(Entries &prm)
  {
    prm.enter_subsection("Damping");
    prm.add_parameter(
        "Model", model,
        "Rayleigh: C = a M + b K, with the ratio at two frequencies. uniform: the ratio in a band of "
        "frequencies, of the deformation of the concrete only: a free monolith moves without damping. automatic: "
        "Rayleigh, with \"Dynamics/Scheme\" = explicit uniform.",
        dealii::Patterns::Selection("automatic|Rayleigh|uniform"));
    prm.add_parameter("Ratio", ratio, "Damping ratio [-].", {.001, .2, true}, Double(0., 1.));
    prm.add_parameter("Frequency 1", frequency_1, "Rayleigh: lower frequency with this damping ratio [Hz].",
                      {0., 20.}, Double(1e-6));
    prm.add_parameter("Frequency 2", frequency_2, "Rayleigh: upper frequency with this damping ratio [Hz].",
                      {.5, 100.}, Double(1e-6));
    prm.add_parameter("Mass coefficient", mass_coefficient,
                      "Rayleigh: the factor a, in place of ratio and frequencies [1/s]. -1: from these.",
                      {-1., 10.}, Double(-1.));
    prm.add_parameter("Stiffness coefficient", stiffness_coefficient,
                      "Rayleigh: the factor b, in place of ratio and frequencies [s]. -1: from these.",
                      {-1., .1}, Double(-1.));
    prm.add_parameter("Band begin", band_begin, "uniform: lowest frequency of the band [Hz].", {.05, 5.},
                      Double(1e-3));
    prm.add_parameter("Band end", band_end, "uniform: highest frequency of the band [Hz].", {5., 100.},
                      Double(1e-3));
    prm.add_parameter("Terms", terms, "uniform: number of Maxwell elements.",
                      dealii::Patterns::Integer(1, 6));
    prm.add_parameter(
        "Reference frequency", reference_frequency,
        "uniform: frequency at which Young's modulus is that of the input file [Hz]; it grows with the "
        "frequency. -1: first natural frequency of the tied dam with its water.",
        {-1., 20.}, Double(-1.));
    prm.add_parameter(
        "Zones", zones,
        "uniform: damping ratios of dam zones [-], as \"NAME: ratio, NAME: ratio\", with the names of "
        "\"Concrete/Zones\". The rest of the dam has \"Ratio\".",
        dealii::Patterns::Map(dealii::Patterns::Anything(), dealii::Patterns::Anything()));
    prm.leave_subsection();
  }

  void DampingParameters::add_choices(ModelChoices &choices) const
  {
    for (const double other : {.03, .1})
      if (ratio != other && zones.empty()) // zones keep their ratios
        choices.add("material", "damping " + number_text(100. * other) + " %", "Damping/Ratio", other);
  }

  void DampingParameters::check() const
  {
    const auto order = [](const std::string &low, const double a, const std::string &high, const double b)
    {
      if (!(b > a))
        throw InputError("Entry \"Damping/" + high + "\" (" + number_text(b) +
                         " Hz) must be larger than \"Damping/" + low + "\" (" + number_text(a) +
                         " Hz). Exchange or correct the frequencies.");
    };
    order("Frequency 1", frequency_1, "Frequency 2", frequency_2);
    order("Band begin", band_begin, "Band end", band_end);
    if (!zone_ratios().empty() && !(ratio > 0.))
      throw InputError("Entry \"Damping/Zones\" requires a damping ratio of the rest of the dam. Set "
                       "\"Damping/Ratio\" to a number above 0.");
    if ((mass_coefficient >= 0.) != (stiffness_coefficient >= 0.))
      throw InputError(
          "Entries \"Damping/Mass coefficient\" and \"Stiffness coefficient\" are given together. Set the "
          "other one, too: 0 if there is none.");
    if (is_uniform() && ratio > 0.)
    {
      if (ratio > largest_uniform)
        throw InputError("Entry \"Damping/Ratio\" = " + number_text(ratio) + " is above " +
                         number_text(largest_uniform) +
                         ", the limit of \"Damping/Model\" = uniform. Reduce the ratio.");
      if (!(reference_frequency > 0. || reference_frequency == -1.))
        throw InputError(
            "Entry \"Damping/Reference frequency\" = " + number_text(reference_frequency) +
            " must be a frequency in Hz, or -1 for the first natural frequency of the tied dam.");
      if (relaxation().weight.empty())
        throw InputError(
            "\"Damping/Terms\" = " + std::to_string(terms) + " cannot give a damping ratio between " +
            number_text(band_begin) + " and " + number_text(band_end) +
            " Hz. Change the number of terms, or widen the band from \"Band begin\" to \"Band end\".");
    }
  }

  double DampingParameters::mass_factor() const
  {
    return mass_coefficient >= 0.
               ? mass_coefficient
               : 2. * ratio * 2. * M_PI * frequency_1 * frequency_2 / (frequency_1 + frequency_2);
  }

  double DampingParameters::stiffness_factor() const
  {
    return stiffness_coefficient >= 0. ? stiffness_coefficient
                                       : 2. * ratio / (2. * M_PI * (frequency_1 + frequency_2));
  }

  Relaxation DampingParameters::relaxation() const
  {
    return Relaxation::of_ratio(ratio, band_begin, band_end, terms);
  }

  std::map<std::string, double> DampingParameters::zone_ratios() const
  {
    std::map<std::string, double> ratios;
    for (const auto &[zone, text] : zones)
    {
      const std::string what = "Entry \"Damping/Zones\": zone \"" + zone + "\"";
      const double      value = number_in_unit(text, "-", what);
      if (zone_name(zone).empty() || !(value > 0. && value <= largest_uniform))
        throw InputError(what + " cannot have the damping ratio \"" + text +
                         "\". Give a ratio above 0 and up to " + number_text(largest_uniform) +
                         ", as in \"heel: 0.03\".");
      if (!ratios.emplace(zone_name(zone), value).second)
        throw InputError(what + " has two ratios. Remove one of them.");
    }
    return ratios;
  }

  Damping DampingParameters::law(const double first_frequency, const std::vector<Zone> &in_dam) const
  {
    if (!is_uniform())
      return {mass_factor(), stiffness_factor()};
    const double reference = reference_frequency > 0. ? reference_frequency : first_frequency;
    if (!(ratio > 0.) || !(reference > 0.))
      return Damping();
    std::vector<Damping::Zone> found;
    const auto                 ratios = zone_ratios();
    double                     least = 1., most = 0.;
    DampingParameters          mean = *this;
    for (std::size_t i = 0; !ratios.empty() && i < in_dam.size(); ++i)
    {
      const auto own = ratios.find(in_dam[i].name);
      found.push_back({in_dam[i].name, own == ratios.end() ? ratio : own->second, 1., {}});
      least = std::min(least, found[i].ratio);
      most = std::max(most, found[i].ratio);
      mean.ratio = .5 * (least + most);
    }
    if (!found.empty())
      mean.check(); // throws InputError if there is no fit
    Relaxation fit = mean.relaxation();
    fit.unrelaxed = 1. / fit.modulus(2. * M_PI * reference).real();
    Damping result(fit);
    for (Damping::Zone &zone : found)
    {
      if (least < most)
        zone.scale = fit.scale_of(zone.ratio, band_begin, band_end);
      if (!(zone.scale > 0.))
        throw InputError(
            "Entry \"Damping/Zones\": the ratio " + number_text(zone.ratio) + " of " +
            (zone.name.empty() ? std::string("the rest of the dam") : "zone \"" + zone.name + "\"") +
            " cannot be reached with the relaxation times that all zones have in common. Bring the ratios closer "
            "together, or the band and \"Damping/Reference frequency\" closer to the frequencies of the dam.");
      zone.error = fit.scaled(zone.scale).error_of(zone.ratio, band_begin, band_end);
    }
    result.zones = found;
    return result;
  }

  std::string DampingParameters::in_words(const double                      first_frequency,
                                          const std::vector<Damping::Zone> &in_dam) const
  {
    char line[200];
    if (!is_uniform())
    {
      std::snprintf(line, sizeof(line), "Rayleigh, C = a M + b K with a = %.4g 1/s, b = %.4g s",
                    mass_factor(), stiffness_factor());
      std::string text = line;
      std::snprintf(line, sizeof(line), " (%.3g %% at %g and %g Hz)", 100. * ratio, frequency_1, frequency_2);
      return mass_coefficient >= 0. ? text : text + line;
    }
    if (!(ratio > 0.))
      return "none";
    std::vector<Damping::Zone> all = in_dam;
    if (all.empty())
      all = {{"", ratio, 1., relaxation().error_of(ratio, band_begin, band_end)}};
    std::string text = "uniform";
    for (const Damping::Zone &zone : all)
    {
      std::snprintf(line, sizeof(line), " %.3g %% (%+.1f to %+.1f %% of it)", 100. * zone.ratio,
                    100. * zone.error.first, 100. * zone.error.second);
      text += (zone.name.empty() ? "," : ", zone " + zone.name) + line;
    }
    std::snprintf(line, sizeof(line), " from %g to %g Hz; modulus of the input file at ", band_begin,
                  band_end);
    return text + line +
           (reference_frequency > 0. ? number_text(reference_frequency) + " Hz"
            : first_frequency > 0.
                ? number_text(std::round(1e4 * first_frequency) / 1e4) + " Hz, the first frequency"
                : std::string("the first frequency"));
  }

  std::string DampingParameters::warning(std::vector<Damping::Zone> in_dam) const
  {
    if (!is_uniform() || !(ratio > 0.))
      return "";
    if (in_dam.empty())
      in_dam = {{"", ratio, 1., relaxation().error_of(ratio, band_begin, band_end)}};
    const auto largest_of = [](const Damping::Zone &zone)
    { return std::max(-zone.error.first, zone.error.second); };
    const auto   zone = *std::max_element(in_dam.begin(), in_dam.end(),
                                          [&](const Damping::Zone &a, const Damping::Zone &b)
                                          { return largest_of(a) < largest_of(b); });
    const double largest = largest_of(zone);
    if (largest <= (in_dam.size() > 1 ? .1 : .05))
      return "";
    return "the damping ratio" + (zone.name.empty() ? "" : " of zone \"" + zone.name + "\"") +
           " differs from its entry by up to " + number_text(std::round(1000. * largest) / 10.) +
           " % in its band. " +
           (in_dam.size() > 1 ? "Bring the ratios of the zones closer together, or narrow the band."
                              : "Increase \"Damping/Terms\", or narrow the band.");
  }
} // namespace Voussoir
