// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_modes_damping_h
#define voussoir_modes_damping_h

#include <voussoir/dam/scene.h>
#include <voussoir/dynamics/modes.h>

#include <string>
#include <vector>

namespace Voussoir
{
  /** Damping of the natural modes: Rayleigh damping C = a M + b K gives a mode of the circular frequency w the ratio
   * a/(2 w) + b w/2, uniform damping that of its free oscillation. */
  class ModesDamping
  {
  public:
    /** @param damping section "Damping" of the scene
     * @param modes lowest natural modes, by ascending frequency; at least one
     * @param structure structure of the modes, with their damping */
    ModesDamping(const DampingParameters &damping, const std::vector<NaturalMode> &modes,
                 const Structure &structure);

    /** Returns the damping ratio of a mode [-]. @p mode: counted from 0. */
    double ratio(std::size_t mode) const;

    /** Returns a proposal for "Damping/Frequency 1" and "Frequency 2" [Hz]: the first natural frequency, and
     * the frequency at which the lowest modes together have 80 % of the effective mass, the mean of the shares
     * along x, y and z; if the modes have less, five times the first one. Between both frequencies the damping
     * ratio is smaller than "Ratio", a cautious choice. */
    std::pair<double, double> proposal() const;

    /** Returns the proposal in words. */
    std::string in_words() const;

    /** Returns a warning if the damping ratio of a significant mode differs from "Ratio" by more than 30 %,
     * otherwise an empty string. Significant are the modes up to 80 % of the effective mass that have at least
     * 1 % in a direction. */
    std::string warning() const;

  private:
    const DampingParameters damping;
    Damping                 law;
    std::vector<double>     frequency; ///< of each mode [Hz]
    std::vector<double>     scale;     ///< NaturalMode::scale()
    std::vector<bool>       is_heavy;  ///< at least 1 % of the effective mass in a direction
    double      share = 0.;            ///< of the effective mass that the significant modes have together [-]
    std::size_t n_modes = 0;           ///< number of lowest modes with 80 % of the effective mass, or all
  };
} // namespace Voussoir

#endif
