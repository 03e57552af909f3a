// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_overstress_h
#define voussoir_overstress_h

#include <voussoir/base/ranks.h>

#include <array>
#include <cstddef>
#include <vector>

namespace Voussoir
{
  /** For how long the stress at each node is above the tensile strength f_t, and above 1.1, 1.2, ... 2 f_t:
   * the cumulative inelastic duration of USACE EM 1110-2-6053 (and of Ghanaat, "Failure modes approach to
   * safety evaluation of dams", 13WCEE, 2004). Each record stands for the time since the one before it. */
  class Overstress
  {
  public:
    static constexpr unsigned int n_levels = 11;
    using Levels = std::array<double, n_levels>;                      ///< a value of each
    static double level(const unsigned int k) { return 1. + .1 * k; } ///< stress over f_t

    Overstress() = default; ///< watches nothing

    /** @p strength: f_t [Pa], 0: watches nothing. */
    Overstress(const double strength, const std::size_t n_nodes)
        : strength(static_cast<float>(strength)), seconds(strength > 0. ? n_levels * n_nodes : 0, 0.)
    {
    }

    bool watches() const { return strength > 0.f; }

    /** Has any time passed? Without, as in a static state, no duration is known. */
    bool has_lasted() const { return last > 0.; }

    /** The stresses that follow are those of this time [s]. */
    void begin(const double time)
    {
      interval = last < 0. ? 0. : time - last;
      last = time;
    }

    /** The largest principal stress of a node [Pa]. */
    void add(const std::size_t node, const float stress)
    {
      if (watches() && stress > strength)
        for (unsigned int k = 0; k < n_levels && stress > static_cast<float>(level(k)) * strength; ++k)
          seconds[n_levels * node + k] += interval;
    }

    double duration(const std::size_t node, const unsigned int k) const
    {
      return seconds[n_levels * node + k];
    }

    /** With several ranks, of nodes from begin[r] to begin[r + 1] each: all get all. */
    void collect(std::vector<std::size_t> begin)
    {
      for (std::size_t &i : begin)
        i *= n_levels;
      if (watches())
        Ranks::gather(seconds.data(), begin);
    }

    template <class Archive> void serialize(Archive &archive, unsigned int) { archive &seconds &last; }

  private:
    float               strength = 0.f;
    double              last = -1., interval = 0.; ///< [s]
    std::vector<double> seconds;                   ///< n_levels of each node
  };
} // namespace Voussoir

#endif
