// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_ensemble_results_h
#define voussoir_ensemble_results_h

#include <voussoir/output/observers.h>

namespace Voussoir
{
  /** Results of one motion of an ensemble. */
  struct MotionResult
  {
    template <class T> using Named = std::vector<std::pair<std::string, T>>;

    std::string               name;            ///< of the motion
    double                    factor = 1.;     ///< of "Motion/Ensemble factors" [-]
    std::string               failure;         ///< reason without results; empty: complete
    Named<double>             extremes;        ///< members of "extremes" in summary.json [m], [Pa]
    std::vector<double>       openings, slips; ///< largest of each joint at the crest [m]
    double                    overstress = 0.; ///< Assessment::overstress_seconds() [s]; -1: no strength
    Named<bool>               limits;          ///< whether each evaluated limit is satisfied
    Named<std::string>        unevaluated;     ///< limits that are not evaluated, and the reasons
    Named<std::vector<float>> fields;          ///< envelopes of the stresses at the nodes of the model [Pa]

    template <class Archive> void serialize(Archive &archive, unsigned int)
    {
      archive &name &factor &failure &extremes &openings &slips &overstress &limits &unevaluated &fields;
    }
  };

  /** Returns the results of a completed run, without name and factor. @p assessment: of the run. */
  MotionResult result_of(const JointObserver &joints, const StressObserver &stresses,
                         const Assessment &assessment);

  /** Statistics of a result over motions. */
  struct Spread
  {
    double median, p16, p84, min, max;

    /** Half widths of the intervals that contain the median of infinitely many motions with a probability of 68 and
     * 95 %, over the median [-], by 2,000 samples with replacement; NaN with fewer than three motions. */
    double known_68, known_95;

    /** Number of motions for a half width of 10 % at 68 %: (1.2533 s / 0.1)^2 with the standard deviation s of the
     * logarithm, as for a log-normal distribution; NaN with fewer than three motions. */
    double needed; ///< also NaN if values have different signs or are zero

    /** Computes the statistics. The percentiles are interpolated linearly.
     * @param values at least one; if one is not finite, all statistics are NaN
     * @param noise medians below this value have no known_68, known_95 and needed */
    explicit Spread(std::vector<double> values, double noise = 0.);

    Json json() const; ///< member of "ensemble" in summary.json
  };

  /** Results of all motions of an ensemble. */
  class EnsembleResults
  {
  public:
    std::vector<MotionResult> motions;

    /** Returns the factor of the statistics: the one nearest to 1 [-]. */
    double factor() const;

    /** Returns the complete results with a factor. */
    std::vector<const MotionResult *> with_factor(double factor) const;

    /** Returns "NAME (REASON)" of each motion without results. */
    std::vector<std::string> failures() const;

    /** Writes ensemble.csv, ensemble_joints.csv, and the medians of the stress envelopes to envelope.vtu, faces.csv and
     * faces_cells.csv. Throws WriteError. */
    void write(const std::string &directory, const Dam &dam) const;

    /** Returns "ensemble" of summary.json. @p lanes: motions of a batch; 1: one after another. */
    Json json(unsigned int lanes) const;

    /** Prints median and scatter of the main results. */
    void report(Log &log) const;

  private:
    void write_motions(const std::string &file, std::size_t n_joints) const;
    void write_joints(const std::string &file, const DamGeometry &geometry) const;
    Json json_of_factor(double factor) const;
  };
} // namespace Voussoir

#endif
