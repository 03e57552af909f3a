// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_observers_h
#define voussoir_observers_h

#include <voussoir/base/log.h>
#include <voussoir/dam/dam_geometry.h>
#include <voussoir/dam/tractions.h>
#include <voussoir/output/block_observer.h>
#include <voussoir/output/face_tension.h>
#include <voussoir/output/floor_accelerations.h>
#include <voussoir/output/table_columns.h>

#include <optional>

namespace Voussoir
{
  /** Extremes of a run by their names in summary.json. */
  using NamedExtremes = std::vector<std::pair<std::string, Extreme>>;

  /** Displacements and accelerations of crest and probes (history.csv, floor_spectra.csv) and energies
   * (energy.csv). */
  class HistoryObserver : public Observer
  {
  public:
    /** Declares the columns of the tables. @p run must outlive the observer. */
    explicit HistoryObserver(const RunState &run);
    void record() override;
    void flush() override;
    void open(const std::string &directory) override;
    void write_tables(const std::string &) override { flush(); }
    void finish(const std::string &directory, Log &log) override;
    void report(Log &log) const override;
    void save(boost::archive::binary_oarchive &archive) const override;
    void load(boost::archive::binary_iarchive &archive) override;

    /** Returns the present kinetic energy of the concrete relative to the largest energy [-]. */
    double kinetic_share() const
    {
      return run.integrator->state().energy.kinetic / std::max(run.largest_energy(), 1e-300);
    }

    /** Returns "accelerations" of summary.json [m/s^2]. */
    Json json_of_accelerations() const { return FloorAccelerations(history, points).json(); }

    /** Returns the largest error of the energy balance so far, relative to the largest energy [-]. */
    double balance_error() const { return imbalance / std::max(run.largest_energy(), 1e-300); }

  private:
    void declare_history();
    void declare_energy();
    void declare_point(const std::string &name, const PlaceInDam &place);
    void declare_accelerations();

    const RunState          &run;
    bool                     crown_is_at_joint = false; ///< history.csv has both sides of the joint
    double                   imbalance = 0.;            ///< largest |energy balance| so far [J]
    std::vector<std::string> points;                    ///< names of the crest and the probes
    std::vector<PlaceInDam>  places;                    ///< their places in the mesh
    Table                    history, energy;
    TableColumns             history_columns{history}, energy_columns{energy};
    TableFile                history_file, energy_file;
  };

  /** Dynamic pressures of acoustic water on the upstream face (water_pressure.csv). */
  class WaterObserver : public Observer
  {
  public:
    /** @p run must outlive the observer; its dam has acoustic water. */
    explicit WaterObserver(const RunState &run) : run(run), water(*run.dam->water) {}
    void record() override;
    void write_tables(const std::string &directory) override;
    void report(Log &log) const override;
    void save(boost::archive::binary_oarchive &archive) const override;
    void load(boost::archive::binary_iarchive &archive) override;

    /** Returns the largest and smallest dynamic pressure at the nodes of the model of the dam [Pa]. */
    std::vector<FieldWriter::NodalField> fields() const;

    /** Returns "water" of summary.json: largest and smallest dynamic pressure [Pa] with place [m] and time [s]. */
    Json json() const;

  private:
    struct Extreme
    {
      double       value = 0., time = 0.;
      unsigned int node = 0;
    };
    const RunState      &run;
    const AcousticWater &water;
    std::vector<double>  largest, smallest; ///< per node of the section [Pa]
    Extreme              highest, lowest;   ///< dynamic pressure
    Extreme              driest{1e300};     ///< absolute pressure
  };

  /** Openings, slips and pressures of the joints. */
  class JointObserver : public Observer
  {
  public:
    /** @p run must outlive the observer. */
    explicit JointObserver(const RunState &run);
    void record() override;
    void flush() override { file.append(joints.history); }
    void open(const std::string &directory) override;
    void write_tables(const std::string &directory) override;
    void finish(const std::string &directory, Log &log) override;
    void report(Log &log) const override;
    void save(boost::archive::binary_oarchive &archive) const override;
    void load(boost::archive::binary_iarchive &archive) override;

    /** Returns the largest opening and slip [m]: members of "extremes" in summary.json. */
    NamedExtremes extremes() const { return {{"max_opening", joints.opening}, {"max_slip", joints.slip}}; }

    /** Returns the largest opening that a joint keeps at the crest from its largest opening to the end [m]; 0: all joints
     * close again. */
    double kept_opening() const;

    /** Returns "motion_parts" of summary.json: source, times [s], and largest opening and slip of each joint
     * after the rest [m]. */
    Json json_of_parts() const;

    JointRecorder joints; ///< the records

  private:
    const RunState &run;
    TableFile       file;
  };

  /** Stresses at the present time and their envelope over time. */
  class StressObserver : public Observer
  {
  public:
    /** @p joints: recorder of the contact pressures for envelope.vtu. Both arguments must outlive the observer. */
    StressObserver(const RunState &run, const JointRecorder &joints);

    /** Observer of another motion of the same dam, which shares the operator of @p other. */
    StressObserver(const RunState &run, const JointRecorder &joints, const StressObserver &other);

    const WaterObserver *water = nullptr; ///< recorder of the dynamic pressures for the envelope; null: none

    void start() override { follow(); }
    void follow() override;
    void gather_on_root() override { envelope.gather(); }
    void finish(const std::string &directory, Log &log) override;
    void report(Log &log) const override;
    void save(boost::archive::binary_oarchive &archive) const override;
    void load(boost::archive::binary_iarchive &archive) override;

    /** Returns the total stresses at the nodes of the model at the present time [Pa]. */
    std::vector<Stress> now() const
    {
      return stress_of(run.statics.elastic(run.integrator->state().u), tractions_now());
    }

    /** Returns the stresses of StressRecovery::apply() and the initial stresses [Pa]. */
    std::vector<Stress> stress_of(const Unknowns &u, const std::vector<Vector3> &tractions) const;

    StressView view() const { return recovery->view(); } ///< with the operator only

    /** Returns true if stresses are recorded. */
    bool is_recording() const { return run.scene().output.envelope_interval.samples > 0; }

    /** Returns the largest stresses [Pa]: members of "extremes" in summary.json. Empty if no stresses are recorded. */
    NamedExtremes extremes() const;

    /** Returns the envelope of the stresses at the nodes of the model [Pa]. */
    std::vector<FieldWriter::NodalField> fields() const;

    /** Returns "tension_above_strength" of summary.json: area of each face with a maximum principal stress
     * above the tensile strength [m^2]. */
    Json json_of_strength() const;

    /** Returns the boundary tractions for the stress recovery, or a null pointer if the input file disables
     * them (Output/Stress recovery). */
    const Tractions *known_tractions() const
    {
      return run.scene().output.knows_tractions() ? &tractions : nullptr;
    }

  private:
    std::vector<Vector3> tractions_now() const;
    std::string          largest_in_words(int surface, bool with_base) const;
    std::string          range_in_words(unsigned int k, int surface) const;

    const RunState      &run;
    const JointRecorder &joints;
    const Tractions      tractions;

    const std::shared_ptr<const StressRecovery> recovery; ///< stresses at the nodes from displacements

  public:
    const FaceTension tension;      ///< evaluation of the envelope
    EnvelopeRecorder  envelope;     ///< largest and smallest principal stresses over time
    double            seconds = 0.; ///< wall time of follow(), summed over all calls [s]
  };

  class Assessment;

  /** Returns the assessment of the results so far. @p blocks: forces at the base, or null. @p wedge_safety: see
   * Assessment. */
  Assessment assess(const RunState &run, const JointObserver &joints, const StressObserver &stresses,
                    const BlockObserver *blocks = nullptr, std::optional<double> wedge_safety = {});

  /** Fields on the mesh and on the joints for ParaView (solution-NNNNN.vtu, solution.pvd). */
  class FieldObserver : public Observer
  {
  public:
    /** Both arguments must outlive the observer. */
    FieldObserver(const RunState &run, StressObserver &stresses) : run(run), stresses(stresses) {}
    void flush() override;
    void open(const std::string &path) override;
    void save(boost::archive::binary_oarchive &archive) const override;
    void load(boost::archive::binary_iarchive &archive) override;

  private:
    void write();
    void write_collection() const;
    void add_stresses(std::vector<FieldWriter::NodalField> &fields) const;
    void add_joints(std::vector<FieldWriter::NodalField> &fields) const;

    const RunState                             &run;
    StressObserver                             &stresses;
    std::string                                 directory;
    bool                                        is_resumed = false;
    std::vector<std::pair<double, std::string>> files; ///< time [s] and name of each file
  };
} // namespace Voussoir

#endif
