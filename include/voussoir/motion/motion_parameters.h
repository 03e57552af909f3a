// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_motion_parameters_h
#define voussoir_motion_parameters_h

#include <voussoir/motion/design_spectrum.h>

#include <array>
#include <string>

namespace Voussoir
{
  class Entries;

  /** Envelope of an artificial motion: t^2, then one, then exp(-decay_rate (t - decay_begin)). */
  struct MotionEnvelope
  {
    double rise_end, decay_begin; ///< [s]
    double decay_rate;            ///< [1/s]
  };

  /** Section "Motion" of a scene. */
  struct MotionParameters
  {
    static constexpr double automatic = -1.; ///< of entries that follow from others
    static constexpr double most_steps = 1e7;

    std::string           source = "artificial";  ///< or "file", "none"
    double                duration = automatic;   ///< [s]; see length()
    double                time_step = 0.01;       ///< [s]
    double                factor = 1.;            ///< on all components, whatever the source
    std::array<double, 3> scale = {{1., 1., 1.}}; ///< on one each

    // Source = file. Paths are relative to the scene's directory.
    std::string                file;            ///< one file with t, a_x, a_y, a_z,
    std::array<std::string, 3> component_files; ///< or one for each component, with t, a, or AT2
    std::string                unit = "m/s^2";

    // Source = artificial
    DesignSpectrum spectrum;
    double         peak_acceleration = 0.5575; ///< horizontal [g]
    double         vertical_ratio = 0.666667;  ///< vertical to horizontal
    double         damping = 0.05;
    unsigned int   seed = 1;
    double         rise_end = automatic;    ///< [s]; see envelope()
    double         decay_begin = automatic; ///< [s]
    double         decay_rate = automatic;  ///< [1/s]
    unsigned int   matching_iterations = 20;

    void add_parameters(Entries &prm);
    void check() const; ///< throws InputError, naming the entry

    bool         duration_is_automatic() const { return duration == automatic; }
    double       length() const;  ///< "Duration", or 20.48 s where it is automatic, but for records [s]
    unsigned int n_steps() const; ///< length() / time_step

    /** As the entries say; those that are automatic: 2.5 s, 11 s and 0.25 1/s where the motion is longer than
     * that, else the envelope of a motion of 15 s in the time scale length()/15 s. */
    MotionEnvelope envelope() const;

    /** What an artificial motion is to match: pseudo-acceleration [m/s^2] in a direction at a period [s];
     *  at period zero the peak acceleration. Beyond 3 s, where the codes end, the displacement spectrum is
     *  constant. Without "Scale". */
    double target(unsigned int direction, double period) const;

  private:
    void add_file_parameters(Entries &prm);
    void add_artificial_parameters(Entries &prm);
  };

  /** Where artificial motions are to match, and how well: Chinese hydraulic practice. */
  namespace MotionCriteria
  {
    constexpr double first_period = 0.04, last_period = 3.; ///< [s]
    constexpr double maximum_error = 0.10, mean_error = 0.05, correlation = 0.3;

    /** At the end of a motion, over the peaks. Records that were corrected, and artificial ones, come back to
     * rest within a few per cent. What remains above these is an uncorrected baseline, a record that is cut
     * while it shakes, or a permanent displacement of the ground; on rock (absolute displacements) the dam
     * goes with it, and a velocity that remains carries it on. */
    constexpr double end_displacement = 0.2, end_velocity = 0.1;
  } // namespace MotionCriteria
} // namespace Voussoir

#endif
