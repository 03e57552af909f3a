// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_motion_parameters_h
#define voussoir_motion_parameters_h

#include <voussoir/motion/design_spectrum.h>
#include <voussoir/motion/spectrum_file.h>

#include <array>
#include <map>
#include <string>
#include <vector>

namespace Voussoir
{
  class Entries;
  struct ModelChoices;

  /** Envelope of an artificial motion: (t / rise_end)^2, then 1, then exp(-decay_rate (t - decay_begin)). */
  struct MotionEnvelope
  {
    double rise_end, decay_begin; ///< [s]
    double decay_rate;            ///< [1/s]
  };

  struct StationParameters;
  struct EnsembleMember;

  /** Section "Motion" of an input file. */
  struct MotionParameters
  {
    static constexpr double automatic = -1.;  ///< value of entries that are computed from others
    static constexpr double most_steps = 1e7; ///< largest number of time steps

    std::string           source = "artificial";  ///< or "file", "none"
    double                duration = automatic;   ///< of the ground motion or of its parts [s]; see length()
    double                time_step = 0.01;       ///< sampling interval [s]
    double                factor = 1.;            ///< of all components, for every source [-]
    std::array<double, 3> scale = {{1., 1., 1.}}; ///< of the single components, for every source [-]

    std::string sequence;         ///< records or seeds, one after another; empty: one motion; see parts()
    double      rest = automatic; ///< after each part [s]; see rest_length()
    std::string ensemble;         ///< seeds or files of motions, each for a run of its own; see members()
    std::string ensemble_factors; ///< of each motion of the ensemble [-]; empty: 1
    std::string ensemble_output;  ///< numbers of the motions whose tables are written; empty: none
    std::string target_file;      ///< spectrum for artificial motions and records to be matched, or empty

    // Source = file. Paths are relative to the directory of the input file.
    std::string                file;            ///< one file with t, a_x, a_y, a_z, or empty
    std::array<std::string, 3> component_files; ///< one file per component, with t, a or AT2, or empty
    std::string                unit = "m/s^2";  ///< of the accelerations in tables
    double                     file_step = 0.;  ///< sampling interval of tables without times [s]; 0: none

    /** Azimuth of the axis x and of channels or files, by name, clockwise from north [degrees]; see
     * read_motion(). */
    std::map<std::string, double> azimuths;
    std::string                   baseline = "none"; ///< or "linear", "quadratic": without_baseline()
    std::string                   match = "false"; ///< or "true": matched_record(); "scale": process_record()
    std::string                   match_band;      ///< periods of "scale" [s]; empty: see band()

    /** Files of records at the banks by "right HEIGHT" or "left HEIGHT"; see stations(). */
    std::map<std::string, std::string> abutments;

    // Source = artificial
    DesignSpectrum spectrum;
    double         peak_acceleration = 0.5575; ///< horizontal [g]
    double         vertical_ratio = 0.666667;  ///< vertical to horizontal acceleration [-]
    double         damping = 0.05;             ///< damping ratio of the spectrum [-]
    unsigned int   seed = 1;                   ///< selects the random phases
    double         rise_end = automatic;       ///< [s]; see envelope()
    double         decay_begin = automatic;    ///< [s]
    double         decay_rate = automatic;     ///< [1/s]
    unsigned int   matching_iterations = 20;   ///< largest number of passes of match_spectrum()

    void add_parameters(Entries &prm);

    /** Adds motions with fewer components, and other motions of the same spectrum ("scatter"). */
    void add_choices(ModelChoices &choices) const;

    /** Checks the entries. Throws InputError with the name of a wrong entry. @p runs_at_rest: a run without a motion
     * has its length. */
    void check(bool runs_at_rest = false) const;

    /** Returns true if "Duration" is -1. */
    bool duration_is_automatic() const { return duration == automatic; }

    /** Returns "Duration" [s], or 20.48 s in whole time steps if it is automatic. Not valid for records with
     * an automatic duration: their length is that of the files. */
    double length() const;

    /** Returns length() / time_step. */
    unsigned int n_steps() const;

    /** Returns the envelope with the values of the entries. The defaults are rise_end = 2.5 s, decay_begin =
     * 11 s and decay_rate = 0.25 1/s. If this envelope does not fit into length(), the default times are
     * scaled with min(1, length() / 15 s) and the default rate with the inverse. */
    MotionEnvelope envelope() const;

    /** Returns the rest after each part [s]: "Rest", or if it is automatic 10 s in whole time steps with
     * "Sequence" and 0 without. */
    double rest_length() const;

    /** Returns the sections "Motion" of the single parts of "Sequence", or this section. Throws InputError if
     * an element of "Sequence" is neither a seed (Source = artificial), nor one file, nor three. */
    std::vector<MotionParameters> parts() const;

    /** Returns the motions of "Ensemble" for the first factor, then those for the second one, and so on. Empty without
     * "Ensemble". Throws InputError if an entry is wrong. */
    std::vector<EnsembleMember> members() const;

    /** Returns the records of "Abutments", by bank and height. Throws InputError if an entry cannot be read. */
    std::vector<StationParameters> stations() const;

    /** Returns the name of a part for messages: its files, or its seed. */
    std::string name_of_part() const;

    /** Returns the periods from which to which spectra are compared with the target [s]: "Match band", otherwise
     * first_period and last_period. Throws InputError if the entry is wrong. */
    std::array<double, 2> band() const;

    /** Reads "Target spectrum" if it is given. Returns a note for the log. Throws InputError, see read_spectrum(), and
     * for another damping ratio than "Damping". Required before target(). */
    std::string read_target(const std::string &scene_directory);

    /** Returns true if "Target spectrum" was read, and its headings state no unit. */
    bool target_lacks_unit() const
    {
      return !target_spectrum.periods.empty() && !target_spectrum.states_unit;
    }

    /** Returns true if there is a target spectrum: for artificial motions, and for records with "Target
     * spectrum". */
    bool has_target() const { return source == "artificial" || (source == "file" && !target_file.empty()); }

    /** Returns the target: the pseudo-acceleration [m/s^2], without "Factor" and "Scale", of "Target spectrum"
     * or of the design spectrum. Beyond 3 s, where the codes end, the design spectrum decreases with an
     * additional factor (3 s / period)^2.
     * @param direction 0, 1 or 2 for x, y or z
     * @param period natural period [s]; 0: peak acceleration */
    double target(unsigned int direction, double period) const;

  private:
    void add_file_parameters(Entries &prm);
    void add_sequence_parameters(Entries &prm);
    void add_ensemble_parameters(Entries &prm);

    SpectrumTable target_spectrum; ///< content of target_file
    void          add_artificial_parameters(Entries &prm);
  };

  /** Motion of "Ensemble". */
  struct EnsembleMember
  {
    std::string                        name;        ///< as MotionParameters::name_of_part()
    double                             factor = 1.; ///< of "Ensemble factors" [-]
    MotionParameters                   motion;      ///< this motion alone
    std::map<std::string, std::string> entries; ///< "Section/Entry" and value that make it the only motion
    bool                               has_output = false; ///< "Ensemble output" contains its number
  };

  /** Record of "Abutments". */
  struct StationParameters
  {
    std::string      name; ///< "right HEIGHT" or "left HEIGHT"
    bool             is_left;
    double           height; ///< z [m]
    MotionParameters record;
  };

  /** Acceptance criteria of ground motions. Those of artificial motions follow Chinese hydraulic practice. */
  namespace MotionCriteria
  {
    constexpr double first_period = 0.04, last_period = 3.; ///< range of the spectrum to match [s]

    /** Largest admissible values for artificial motions: error of the spectrum at one period and on average
     * (relative to the target), and correlation of two components [-]. */
    constexpr double maximum_error = 0.10, mean_error = 0.05, correlation = 0.3;

    /** Largest admissible displacement and velocity at the end of a motion, relative to their peaks [-].
     *
     * Artificial motions and corrected records end at rest within a few per cent. Larger values have one of
     * three causes: an uncorrected baseline, a record that was cut during the strong motion, or a permanent
     * displacement of the ground. On rock, where displacements are absolute, the dam follows them. */
    constexpr double end_displacement = 0.2, end_velocity = 0.1;
  } // namespace MotionCriteria
} // namespace Voussoir

#endif
