// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_simulation_h
#define voussoir_simulation_h

#include <voussoir/base/interrupt.h>
#include <voussoir/base/log.h>
#include <voussoir/dam/static_state.h>
#include <voussoir/dam/tractions.h>
#include <voussoir/motion/ground_motion.h>
#include <voussoir/output/block_recorder.h>
#include <voussoir/output/checkpoint_file.h>
#include <voussoir/output/face_tension.h>
#include <voussoir/output/recorder.h>
#include <voussoir/output/run_directory.h>
#include <voussoir/output/stability_watch.h>
#include <voussoir/output/time_error.h>

#include <functional>
#include <optional>

namespace Voussoir
{
  struct RunOptions
  {
    std::string output;            ///< directory; empty: output/NAME
    bool        resume = false;    ///< go on from the last checkpoint
    bool        validate = false;  ///< set up and report, but do not compute
    bool        overwrite = false; ///< replace a checkpoint, and write beside files of others
    bool        quiet = false;
  };

  /** One run of a scene: set up, static state, shaking, results. */
  class Simulation
  {
  public:
    /** @p scene_text: the scene with all defaults, for the output directory. */
    Simulation(const Scene &scene, const std::string &scene_text, const RunOptions &options);

    void run();

  private:
    void              check_ranks() const;
    void              read_input();
    void              begin_files();
    TimeGrid          grid() const { return {motion.dt, scene.foundation.substeps, n_steps}; }
    void              report_setup();
    void              report_motion_notes();
    void              report_motion_and_warnings();
    void              find_static_state();
    Vector3           relative_to_base(unsigned int node) const;
    ContactParameters contact_parameters(const std::string &stage) const;
    void              start_foundation();
    void              start_shaking();
    void              declare_tables();
    void              declare_history(Recorder &table);
    void              declare_energy(Recorder &table);
    void              shake();
    void              advance();
    void    advance_companion(const Unknowns &load, const Vector3 &base_velocity, const Vector3 &ground);
    Vector3 ground_acceleration(unsigned int after) const;
    void    follow_blocks(const Unknowns &u_before, const Vector3 &base_before);
    void    step_once();
    void    record_on_first(const std::function<void()> &action);
    void    record_stresses();
    void    collect_stresses();
    void    collect();
    void    gather_per_rank();
    void    record();
    void    report_step();
    void    write_solution();
    void    open_tables();
    void    write_tables();
    void    write_fields();
    void    report_tension();
    std::vector<Vector3> known_tractions();
    void                 write_results();
    void                 write_summary();
    Json                 json_of_mesh() const;
    Json                 json_of_times() const;
    Json                 json_of_newton() const;
    Json                 json_per_rank() const;
    Json                 json_of_statics() const;
    Json                 json_of_extremes() const;
    Json                 json_of_time_error() const;
    Json                 json_of_strength() const;
    double               largest_energy() const; ///< of the dam, that has gone through [J]
    double               balance_error() const;  ///< largest |balance| of its energies, over largest_energy()
    void                 check_balance() const;  ///< ComputationError where an account does not close
    void                 draw_figures();
    void                 stop_if_asked() const;
    const char          *signal() const;
    void                 keep_and_stop(const char *signal);
    std::string          keep_last_state();
    std::string          checkpoint_name() const { return directory + "/checkpoint.bin"; }
    void                 save_checkpoint();
    Provenance           provenance_now() const;
    void                 open_checkpoint();
    void                 check_longer_motion(unsigned int n_steps_then, std::size_t samples_then) const;
    void                 load_checkpoint();
    void                 report_loads();
    Json                 json_of_loads() const;

    const Scene                   scene;
    const std::string             scene_text;
    const RunOptions              options;
    RunDirectory                  run_directory;
    const std::string             directory; ///< its path
    std::optional<InterruptGuard> interrupt; ///< of a run, not of --validate
    Log                           log;
    Stopwatch                     clock, shaking_clock;
    double                        clock_before = 0., cpu_before = 0.; ///< of the runs this one resumes [s]

    std::unique_ptr<Dam>   dam;
    GroundMotion           motion;
    unsigned int           n_steps = 0, step = 0, first_step = 0;
    Provenance             provenance;
    std::string            checkpoint;          ///< its payload, until it is loaded
    std::vector<PairState> pairs_at_start;      ///< of this process
    unsigned int           start_step = 0;      ///< of this process
    bool                   inside_step = false; ///< the state is not one of any time

    StaticState statics;

    struct Counters
    {
      double                      seconds_rock = 0.;
      std::array<unsigned int, 4> path{}; ///< steps by ContactPath
      double newton = 0., newton_max = 0., krylov = 0., factorisations = 0., gauss_seidel = 0., residual = 0.,
             imbalance = 0.; // largest |balance| of the energies of the dam [J]
      double seconds_setup = 0., seconds_static = 0., seconds_substitutions = 0., seconds_joints = 0.,
             seconds_stepping = 0., seconds_stresses = 0., seconds_output = 0., seconds_shaking = 0.,
             cpu_shaking = 0.; // of all threads
      template <class Archive> void serialize(Archive &archive, unsigned int)
      {
        archive &seconds_rock;
        for (unsigned int &n : path)
          archive &n;
        archive &newton &newton_max &krylov &factorisations &gauss_seidel &residual &imbalance;
        archive &seconds_setup &seconds_static &seconds_substitutions &seconds_joints &seconds_stepping
            &seconds_stresses &seconds_output &seconds_shaking &cpu_shaking;
      }
    } count;

    struct PerRank ///< of the shaking of this process, gathered at its end
    {
      double              work_before = 0., messages_before = 0.;
      std::vector<double> work, rock_work, messages, memory; ///< [s], [s], per step, [bytes]
    } per_rank;

    std::unique_ptr<Newmark>           newmark;
    std::unique_ptr<StabilityWatch>    stability;
    std::unique_ptr<Tractions>         tractions;
    Unknowns                           acceleration; ///< mean of the last step, of the base, too [m/s^2]
    std::unique_ptr<StressRecovery>    stress;
    std::unique_ptr<EnvelopeRecorder>  envelope;
    std::unique_ptr<FaceTension>       tension;
    std::unique_ptr<JointRecorder>     joints;
    std::unique_ptr<BlockRecorder>     blocks;    ///< if the scene asks for it
    std::unique_ptr<TimeErrorEstimate> companion; ///< if the scene asks for it
    Table                              history, energy;
    std::unique_ptr<Recorder>          history_columns, energy_columns;
    TableFile                          history_file, energy_file, joint_file, block_file;
    std::vector<std::pair<double, std::string>> solutions; ///< time and file of solution.pvd
  };
} // namespace Voussoir

#endif
