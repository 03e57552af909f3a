// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/error.h>
#include <voussoir/rock/plane_wave.h>

#include <cmath>
#include <sstream>

namespace Voussoir
{
  namespace
  {
    constexpr double degree = 3.14159265358979323846 / 180.;

    /** Least 1 - p^2 c^2, which the masses of a column and of a section are proportional to. The
     * transmitting boundary of sections was unstable with 0.004 and stable with 0.035
     * (tests/boundary_oblique.cc). */
    constexpr double least_mass = 1e-3, least_mass_of_section = .03;

    double speed(const PlaneWave::Type type, const Material &m)
    {
      return type == PlaneWave::P ? p_wave_speed(m) : s_wave_speed(m);
    }
  } // namespace

  double PlaneWave::slowness(const Material &material) const
  {
    return std::sin(angle) / speed(type, material);
  }

  double PlaneWave::vertical_slowness(const Material &layer, const double p) const
  {
    const double c = speed(type, layer);
    return std::sqrt(std::max(0., 1. / (c * c) - p * p));
  }

  double PlaneWave::along(const Vector3 &place) const
  {
    return std::cos(azimuth) * place[0] + std::sin(azimuth) * place[1];
  }

  namespace
  {
    [[noreturn]] void fail(const std::string &wave, const std::string &why)
    {
      const bool is_blank = wave.find_first_not_of(" \t") == std::string::npos;
      throw InputError(
          "\"Foundation/Incidence\": " +
          (is_blank ? "a wave is missing" : "the wave \"" + wave + "\" " + why) +
          ". Set the entry to vertical, or to a list such as \"SV 30 90, P 20 90 0.5\": type (P, SV or SH), "
          "angle from the vertical [deg], azimuth of the horizontal direction of propagation from x to y "
          "[deg] and, for a wave that arrives later than the others, the delay [s].");
    }

    PlaneWave read_wave(const std::string &text)
    {
      std::istringstream stream(text);
      std::string        type, rest;
      PlaneWave          wave;
      if (!(stream >> type))
        fail("", "");
      if (type != "P" && type != "SV" && type != "SH")
        fail(text, "has the unknown type \"" + type + "\"");
      wave.type = type == "P" ? PlaneWave::P : type == "SV" ? PlaneWave::SV : PlaneWave::SH;
      if (!(stream >> wave.angle >> wave.azimuth))
        fail(text, "has no angle and azimuth");
      if (!(wave.angle >= 0. && wave.angle < 90.))
        fail(text, "has an angle outside of 0 to 90 degrees");
      if (!std::isfinite(wave.azimuth))
        fail(text, "has an azimuth that is not finite");
      if (!stream.eof() && !(stream >> std::ws).eof() && !(stream >> wave.delay))
        fail(text, "has a delay that is no number");
      if (!(wave.delay >= 0. && wave.delay < 1e3))
        fail(text, "has a delay outside of 0 to 1000 s");
      if (!stream.eof() && stream >> rest)
        fail(text, "has more than four values");
      wave.angle *= degree;
      wave.azimuth *= degree;
      return wave;
    }
  } // namespace

  std::vector<PlaneWave> read_incidence(const std::string &text)
  {
    std::vector<PlaneWave> waves;
    if (text == "vertical")
      return waves;
    std::istringstream list(text);
    for (std::string part; std::getline(list, part, ',');)
      waves.push_back(read_wave(part));
    if (waves.empty() || text.back() == ',')
      fail("", "");
    return waves;
  }

  namespace
  {
    /** Throws InputError if the horizontal slowness, or that along the valley, is not below 1/c of each
     * layer. */
    void check_slowness(const PlaneWave &wave, const bool is_along, const PlaneWave::Type type,
                        const std::vector<Material> &layers, const Material &half_space)
    {
      const double least = is_along ? least_mass_of_section : least_mass;
      const double p = (is_along ? std::abs(std::cos(wave.azimuth)) : 1.) * wave.slowness(half_space);
      for (const Material &m : layers)
      {
        const double c = speed(type, m);
        if (p * p * c * c <= 1. - least)
          continue;
        const double       limit = std::asin(std::sqrt(1. - least) * std::sin(wave.angle) / (p * c));
        std::ostringstream text;
        text << "\"Foundation/Incidence\": the wave of type "
             << (wave.type == PlaneWave::P    ? "P"
                 : wave.type == PlaneWave::SV ? "SV"
                                              : "SH")
             << " at " << wave.angle / degree
             << " degrees is beyond the critical angle: " << (type == PlaneWave::P ? "P" : "S")
             << " waves with its horizontal slowness" << (is_along ? " along the valley" : "")
             << " do not propagate in rock with " << c << " m/s. Use an angle below " << limit / degree
             << " degrees.";
        throw InputError(text.str());
      }
    }
  } // namespace

  void check_incidence(const PlaneWave &wave, const std::vector<Material> &layers, const Material &half_space)
  {
    check_slowness(wave, false, wave.type == PlaneWave::SH ? PlaneWave::SH : PlaneWave::P, layers,
                   half_space);
  }

  void check_incidence_along(const PlaneWave &wave, const std::vector<Material> &layers,
                             const Material &half_space)
  {
    check_slowness(wave, true, PlaneWave::P, layers, half_space);
  }
} // namespace Voussoir
