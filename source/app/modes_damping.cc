// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/app/modes_damping.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace Voussoir
{
  namespace
  {
    constexpr double heavy_share = .8; // of the effective mass
    constexpr double heavy = .01;      // share of a single mode in a direction
    constexpr double tolerance = .3;   // relative difference from the ratio
    constexpr double range = 5.;       // Frequency 2 over Frequency 1 without sufficient modes

    /** Returns the smallest ratio between two frequencies with the ratio 1, at their geometric mean. */
    double smallest_between(const double f1, const double f2)
    {
      return 2. * std::sqrt(f1 * f2) / (f1 + f2);
    }

    /** Returns a text with two numbers, in the format of printf. */
    template <class... Numbers> std::string text(const char *format, const Numbers... numbers)
    {
      char line[400];
      std::snprintf(line, sizeof(line), format, numbers...);
      return line;
    }
  } // namespace

  ModesDamping::ModesDamping(const DampingParameters &damping, const std::vector<NaturalMode> &modes,
                             const Structure &structure)
      : damping(damping), law(structure.damping)
  {
    const double n_directions = structure.plane_strain ? 2. : 3.;
    for (const NaturalMode &mode : modes)
    {
      const Vector3 part = mode.mass_share(structure);
      const double  mean = (part[0] + part[1] + part[2]) / n_directions;
      frequency.push_back(mode.frequency);
      scale.push_back(mode.scale(structure));
      is_heavy.push_back(*std::max_element(part.begin(), part.end()) >= heavy);
      if (share < heavy_share)
      {
        share += mean;
        ++n_modes;
      }
    }
  }

  double ModesDamping::ratio(const std::size_t mode) const
  {
    return law.of_mode(2. * M_PI * frequency[mode], scale[mode]).first;
  }

  std::pair<double, double> ModesDamping::proposal() const
  {
    const double first = frequency.front(), last = frequency[n_modes - 1];
    return {first, share >= heavy_share && last > first ? last : range * first};
  }

  std::string ModesDamping::in_words() const
  {
    if (damping.is_uniform())
      return damping.in_words(frequency.front(), law.zones);
    const auto [f1, f2] = proposal();
    const bool is_reached = share >= heavy_share;
    return text("proposal: Damping/Frequency 1 = %.3g, Frequency 2 = %.3g (", f1, f2) +
           (is_reached ? text("modes 1 to %zu: %.0f %% of the effective mass", n_modes, 100. * share)
                       : text("5 times the first: increase --count, the modes have only %.0f %% of the mass",
                              100. * share)) +
           text("); at least %.2f %% in between", 100. * damping.ratio * smallest_between(f1, f2));
  }

  std::string ModesDamping::warning() const
  {
    if (damping.is_uniform())
      return damping.warning(law.zones);
    if (damping.mass_coefficient >= 0.)
      return "";
    std::size_t n_off = 0, worst = 0;
    double      largest = 0.;
    for (std::size_t k = 0; k < n_modes && damping.ratio > 0.; ++k)
      if (const double off = std::abs(ratio(k) / damping.ratio - 1.); is_heavy[k] && off > tolerance)
      {
        ++n_off;
        if (off > largest)
        {
          largest = off;
          worst = k;
        }
      }
    if (n_off == 0)
      return "";
    const auto [f1, f2] = proposal();
    return text(
               "the damping ratio of %zu mode%s differs from \"Damping/Ratio\" (%.3g %%) by more than 30 %%, "
               "most of all %.2f %% in mode %zu (%.3g Hz). ",
               n_off, n_off == 1 ? "" : "s", 100. * damping.ratio, 100. * ratio(worst), worst + 1,
               frequency[worst]) +
           (smallest_between(f1, f2) < 1. - tolerance
                ? "Set \"Damping/Model\" to uniform."
                : "Set \"Damping/Frequency 1\" and \"Frequency 2\" to the proposal.");
  }
} // namespace Voussoir
