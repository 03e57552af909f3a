// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/dynamics/spectrum_response.h>
#include <voussoir/joints/joint_system.h>

#include <algorithm>
#include <cmath>

namespace Voussoir
{
  double cqc_coefficient(const double f_1, const double z_1, const double f_2, const double z_2)
  {
    if (f_1 == f_2 && z_1 == z_2)
      return 1.;
    const double r = f_2 / f_1, rr = r * r;
    return 8. * std::sqrt(z_1 * z_2) * (z_1 + r * z_2) * r * std::sqrt(r) /
           ((1. - rr) * (1. - rr) + 4. * z_1 * z_2 * r * (1. + rr) + 4. * (z_1 * z_1 + z_2 * z_2) * rr);
  }

  namespace
  {
    double omega_squared(const NaturalMode &mode)
    {
      return std::pow(2. * M_PI * mode.frequency, 2);
    }

    /** Returns the part of a mode. */
    SpectrumResponse::Part part_of(const NaturalMode &mode)
    {
      SpectrumResponse::Part part{mode.shape, mode.shape};
      for (double &a : part.acceleration)
        a *= -omega_squared(mode);
      return part;
    }

    /** Returns the rigid part for the ground motion along axis @p d: the rigid shares of the modes, and the static
     * response to the peak ground acceleration @p peak without its parts in the modes. */
    SpectrumResponse::Part rigid_part(const Structure &structure, JointSystem &system,
                                      const std::vector<SpectrumResponse::Mode> &modes,
                                      const std::vector<Vector3> &participation, const unsigned int d,
                                      const double peak)
    {
      SpectrumResponse::Part part;
      part.acceleration.assign(3 * structure.n_nodes(), 0.);
      for (std::size_t i = d; i < part.acceleration.size(); i += 3)
        part.acceleration[i] = peak;
      for (std::size_t k = 0; k < modes.size(); ++k)
        for (std::size_t i = 0; i < part.acceleration.size(); ++i)
          part.acceleration[i] -= peak * participation[k][d] * modes[k].mode.shape[i];
      Unknowns load(part.acceleration.size());
      for (unsigned int i = 0; i < structure.n_nodes(); ++i)
      {
        const Vector3 force = structure.mass[i] * get(part.acceleration, i);
        set(load, i, {{-force[0], -force[1], -force[2]}});
      }
      structure.remove_held_forces(load);
      system.solve_free(load, part.displacement);
      for (std::size_t k = 0; k < modes.size(); ++k)
      {
        const double share = modes[k].rigid_share[d] * modes[k].acceleration[d] * participation[k][d];
        for (std::size_t i = 0; i < part.acceleration.size(); ++i)
        {
          part.acceleration[i] += share * modes[k].mode.shape[i];
          part.displacement[i] -= share * modes[k].mode.shape[i] / omega_squared(modes[k].mode);
        }
      }
      return part;
    }
  } // namespace

  SpectrumResponse::SpectrumResponse(const Structure &structure, const std::vector<Mode> &modes,
                                     const Vector3 &peak)
  {
    const std::size_t    n = modes.size() + 3;
    std::vector<Vector3> participation, amplitude;
    for (const Mode &m : modes)
    {
      participation.push_back(m.mode.participation(structure));
      amplitude.emplace_back();
      for (unsigned int d = 0; d < 3; ++d)
        amplitude.back()[d] = participation.back()[d] * m.acceleration[d] *
                              std::sqrt(1. - m.rigid_share[d] * m.rigid_share[d]) / omega_squared(m.mode);
      all.push_back(part_of(m.mode));
    }
    JointSystem system(structure, JointLaws(), ContactParameters(), {});
    for (unsigned int d = 0; d < 3; ++d)
      all.push_back(rigid_part(structure, system, modes, participation, d, peak[d]));
    weight.assign(n * n, 0.);
    for (std::size_t i = 0; i < modes.size(); ++i)
      for (std::size_t j = 0; j < modes.size(); ++j)
        weight[i * n + j] =
            dot(amplitude[i], amplitude[j]) * cqc_coefficient(modes[i].mode.frequency, modes[i].damping,
                                                              modes[j].mode.frequency, modes[j].damping);
    for (unsigned int d = 0; d < 3; ++d)
      weight[(modes.size() + d) * (n + 1)] = 1.;
  }

  double SpectrumResponse::combine(const std::vector<double> &of_parts) const
  {
    const std::size_t n = all.size();
    double            sum = 0.;
    for (std::size_t i = 0; i < n; ++i)
    {
      double row = 0.;
      for (std::size_t j = 0; j < n; ++j)
        row += weight[i * n + j] * of_parts[j];
      sum += of_parts[i] * row;
    }
    return std::sqrt(std::max(sum, 0.)); // round-off can make it negative
  }

  Vector3 support_force(const Structure &structure, const SpectrumResponse::Part &part)
  {
    Vector3 sum{};
    for (unsigned int i = 0; i < structure.n_nodes(); ++i)
    {
      const Vector3 force = structure.mass[i] * get(part.acceleration, i);
      for (unsigned int c = 0; c < 3; ++c)
        sum[c] -= force[c];
    }
    return sum;
  }
} // namespace Voussoir
