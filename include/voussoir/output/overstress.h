// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_overstress_h
#define voussoir_overstress_h

#include <voussoir/base/ranks.h>

#include <array>
#include <cstddef>
#include <limits>
#include <vector>

namespace Voussoir
{
  /** Cumulative duration of overstress: time during which the stress at a node exceeds the static tensile strength
   * f_t, and 1.1, 1.2, ... 2 f_t (cumulative inelastic duration of USACE EM 1110-2-6053, and of Ghanaat,
   * "Failure modes approach to safety evaluation of dams", 13WCEE, 2004). A record represents the time since
   * the previous record. */
  class Overstress
  {
  public:
    static constexpr unsigned int n_levels = 11; ///< number of levels
    using Levels = std::array<double, n_levels>; ///< one value per level

    /** Returns level @p k: stress divided by f_t, from 1 to 2 [-]. */
    static double level(const unsigned int k) { return 1. + .1 * k; }

    Overstress() = default; ///< inactive: add() ignores all stresses

    /** Sets all durations to zero.
     * @param strength static tensile strength f_t [Pa]; 0: inactive
     * @param n_nodes number of nodes */
    Overstress(const double strength, const std::size_t n_nodes)
        : strength(static_cast<float>(strength)), seconds(strength > 0. ? n_levels * n_nodes : 0, 0.)
    {
    }

    /** Returns true if durations are recorded: f_t is positive. */
    bool is_active() const { return strength > 0.f; }

    /** Returns true if there is a record after the initial one. A static state has no duration. */
    bool has_lasted() const { return last > 0.; }

    /** Begins a record, and returns the time since the previous one [s]. @p time: present time [s]. */
    double begin(const double time)
    {
      const double interval = last < 0. ? 0. : time - last;
      last = time;
      return interval;
    }

    /** Returns the stress above which durations are recorded [Pa]. */
    float lowest_level() const { return is_active() ? strength : std::numeric_limits<float>::infinity(); }

    /** Adds a node to a record.
     * @param stress its maximum principal stress at the time of the record [Pa]
     * @param interval as begin() returned it [s] */
    void add(const std::size_t node, const float stress, const double interval)
    {
      if (stress > lowest_level())
        for (unsigned int k = 0; k < n_levels && stress > static_cast<float>(level(k)) * strength; ++k)
          seconds[n_levels * node + k] += interval;
    }

    /** Returns the duration for which the stress of a node exceeds level @p k [s]. */
    double duration(const std::size_t node, const unsigned int k) const
    {
      return seconds[n_levels * node + k];
    }

    /** Exchanges the durations of all ranks. Rank r owns the nodes begin[r] to begin[r + 1]. */
    void gather(std::vector<std::size_t> begin)
    {
      for (std::size_t &i : begin)
        i *= n_levels;
      if (is_active())
        Ranks::gather(seconds.data(), begin);
    }

    template <class Archive> void serialize(Archive &archive, unsigned int) { archive &seconds &last; }

  private:
    float               strength = 0.f;
    double              last = -1.; ///< time of the last record [s]
    std::vector<double> seconds;    ///< n_levels values per node [s]
  };
} // namespace Voussoir

#endif
