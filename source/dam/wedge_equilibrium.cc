// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/dam/wedge_equilibrium.h>

#include <limits>

namespace Voussoir
{
  namespace
  {
    constexpr double equal_modes = 1e-12; ///< difference of margins within round-off [-]

    /** Returns the state with the planes of @p contact, admissible or not, without resistance and safety.
     * @param total sum of all forces, with uplift [N] */
    WedgeState state_in(const std::vector<WedgePlane> &planes, const Vector3 &total,
                        const std::vector<bool> &contact)
    {
      Matrix3 gram{{1., 0., 0., 0., 1., 0., 0., 0., 1.}}; // of the planes in contact
      Vector3 right{};
      for (unsigned int i = 0; i < planes.size(); ++i)
        for (unsigned int j = 0; contact[i] && j < planes.size(); ++j)
          if (contact[j])
          {
            gram[3 * i + j] = dot(planes[i].normal, planes[j].normal);
            right[i] = -dot(planes[i].normal, total);
          }
      const Vector3 compression = inverse(gram) * right;
      WedgeState    state{contact, {}, total};
      for (unsigned int i = 0; i < planes.size(); ++i)
      {
        state.normal_force.push_back(contact[i] ? compression[i] : 0.);
        add(state.driving, scaled(state.normal_force[i], planes[i].normal));
      }
      return state;
    }

    /** Returns the smallest of the compressions on the planes in contact and of the forces S . n that open the
     * other planes [N]. It is negative if the mode is not admissible. */
    double margin(const std::vector<WedgePlane> &planes, const WedgeState &state)
    {
      double least = std::numeric_limits<double>::infinity();
      for (unsigned int i = 0; i < planes.size(); ++i)
        least =
            std::min(least, state.contact[i] ? state.normal_force[i] : dot(state.driving, planes[i].normal));
      return least;
    }
  } // namespace

  unsigned int WedgeState::mode() const
  {
    unsigned int digits = 0;
    for (unsigned int i = 0; i < contact.size(); ++i)
      if (contact[i])
        digits = 10 * digits + i + 1;
    return digits;
  }

  WedgeState wedge_equilibrium(const std::vector<WedgePlane> &planes, const Vector3 &force)
  {
    const unsigned int n = planes.size();
    Vector3            total = force;
    for (const WedgePlane &plane : planes)
      add(total, scaled(plane.uplift * plane.area, plane.normal));
    WedgeState best;
    double     largest = -std::numeric_limits<double>::infinity();
    for (unsigned int n_contacts = n + 1; n_contacts-- > 0;)
      for (unsigned int set = 0; set < 1u << n; ++set)
      {
        std::vector<bool> contact;
        for (unsigned int i = 0; i < n; ++i)
          contact.push_back((set >> i & 1u) == 1u);
        if (std::count(contact.begin(), contact.end(), true) != n_contacts)
          continue;
        const WedgeState state = state_in(planes, total, contact);
        if (const double now = margin(planes, state);
            best.contact.empty() || now > largest + equal_modes * norm(total))
          best = state, largest = now;
      }
    for (unsigned int i = 0; i < n; ++i)
      if (best.contact[i])
        best.resistance +=
            planes[i].friction * std::max(0., best.normal_force[i]) + planes[i].cohesion * planes[i].area;
    const bool   is_fixed = best.mode() == 123;
    const double shear = norm(best.driving);
    if (is_fixed)
      best.driving = {};
    best.safety = is_fixed || shear == 0. ? std::numeric_limits<double>::infinity() : best.resistance / shear;
    return best;
  }

  double independence(const std::vector<WedgePlane> &planes)
  {
    double least = 1.;
    for (unsigned int i = 0; i < planes.size(); ++i)
      for (unsigned int j = 0; j < i; ++j)
      {
        const double cosine = dot(planes[i].normal, planes[j].normal);
        least = std::min(least, std::sqrt(std::max(0., 1. - cosine * cosine)));
      }
    if (planes.size() < 3)
      return least;
    Matrix3 normals{};
    for (unsigned int i = 0; i < 3; ++i)
      std::copy(planes[i].normal.begin(), planes[i].normal.end(), normals.begin() + 3 * i);
    return std::min(least, std::abs(determinant(normals)));
  }
} // namespace Voussoir
