// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_scene_h
#define voussoir_scene_h

#include <voussoir/base/model_choices.h>
#include <voussoir/base/warning.h>
#include <voussoir/contact/contact_solver.h>
#include <voussoir/contact/law_parameters.h>
#include <voussoir/dam/limits.h>
#include <voussoir/dam/load_parameters.h>
#include <voussoir/dam/reservoir.h>
#include <voussoir/foundation/foundation_parameters.h>
#include <voussoir/mesh/mesh_joints.h>
#include <voussoir/mesh/mesh_source.h>
#include <voussoir/motion/motion_parameters.h>
#include <voussoir/solid/zones.h>

#include <map>

namespace Voussoir
{
  // Each struct has the entries of one subsection of the input file. add_parameters() declares the entries,
  // check() throws InputError for invalid values, add_choices() adds changes for `voussoir needs`.

  /** Parameters of the subsection "Elements". */
  struct ElementParameters
  {
    unsigned int degree = 1;                ///< 1: 8 nodes, 2: 27 nodes
    bool         incompatible_modes = true; ///< in elements of degree 1
    void         add_parameters(Entries &prm);
  };

  /** Parameters of the subsection "Damping". */
  struct DampingParameters
  {
    static constexpr double largest_uniform = .25;

    std::string model = "automatic";
    bool        with_explicit = false;                            ///< of the scene: automatic is then uniform
    double      ratio = .05, frequency_1 = 1.2, frequency_2 = 6.; ///< [-], [Hz], [Hz]
    double      mass_coefficient = -1., stiffness_coefficient = -1.;   ///< [1/s], [s]; -1: from the ratio
    double band_begin = .5, band_end = 20., reference_frequency = -1.; ///< [Hz]; -1: first natural frequency
    unsigned int                       terms = 3;                      ///< mechanisms of uniform damping
    std::map<std::string, std::string> zones; ///< uniform: ratios of zones of the dam
    void                               add_parameters(Entries &prm);
    void                               check() const;
    void                               add_choices(ModelChoices &choices) const;
    bool   is_uniform() const { return model == "uniform" || (model == "automatic" && with_explicit); }
    bool   needs_first_frequency() const { return is_uniform() && ratio > 0. && reference_frequency < 0.; }
    double mass_factor() const;      ///< a of Rayleigh damping [1/s]
    double stiffness_factor() const; ///< b of Rayleigh damping [s]
    Relaxation relaxation() const;   ///< fit of uniform damping; without weights if there is none

    /** Returns the ratios of #zones by zone_name() [-]. Throws InputError for an invalid ratio or name. */
    std::map<std::string, double> zone_ratios() const;

    /** Returns the damping of the dam. @p first_frequency: of the tied dam with its water [Hz], or 0: without this
     * frequency, uniform damping that needs it is left out. @p in_dam: zones of the dam. If their ratios differ, the fit
     * is that of the mean of the smallest and the largest one. */
    Damping law(double first_frequency = 0., const std::vector<Zone> &in_dam = {}) const;

    /** Returns the damping in words. @p first_frequency as in law(); @p zones: Damping::zones. */
    std::string in_words(double first_frequency, const std::vector<Damping::Zone> &zones = {}) const;

    /** Returns a warning if the ratio differs by more than 5 % in its band, of zones by 10 %, or an empty string.
     * @p in_dam: Damping::zones. */
    std::string warning(std::vector<Damping::Zone> in_dam) const;
  };

  /** Parameters of the subsection "Joints": joint laws and their parameters. */
  struct JointParameters : LawParameters
  {
    JointParameters() { keys.seat_compliance = -1.; } ///< [m/Pa]; -1: 20 height/E

    std::string                        model = "FJA";                    ///< joint law
    std::string                        equations_name = "alart-curnier"; ///< form of the joint equations
    std::map<std::string, std::string> overrides;  ///< model by number, name or kind of a joint
    std::map<std::string, std::string> gaps;       ///< "Initial gaps" by number, name or kind, with unit
    std::map<std::string, std::string> clearances; ///< "Keys/Clearances", likewise
    void                               add_parameters(Entries &prm);
    void                               check() const;
    void                               add_choices(ModelChoices &choices) const;

    /** Returns the parameters of the law of a joint, or without a joint those of all.
     * @p young: Young's modulus of the concrete [Pa]. */
    LawParameters law(double young, const Joint *joint = nullptr) const;

    /** Returns true if the law of any joint uses the @p entry, such as "Joints/Friction". */
    bool any_reads(const std::string &entry) const;

    /** Returns the model of a joint: that of its number or name, otherwise of its kind, otherwise #model. */
    const std::string &model_of(const Joint &joint) const;

    /** Returns the initial gap of a joint, with the priority of model_of() [m]. */
    double gap_of(const Joint &joint) const;
  };

  /** Parameters of the subsection "Statics". */
  struct StaticParameters
  {
    std::string  self_weight = "staged"; ///< staged, monolithic or none
    unsigned int water_increments = 1;   ///< steps per stage
    double       gravity = 9.81;         ///< [m/s^2]
    std::string  stages;                 ///< stages before the final water level: static_stages()
    void         add_parameters(Entries &prm);
    void         add_choices(ModelChoices &choices) const;
  };

  /** Interval of an output, as in the input file and in samples of the motion. */
  struct OutputInterval
  {
    std::string  text;    ///< number of samples, or a time with its unit
    unsigned int samples; ///< 0: none
  };

  /** Parameters of the subsection "Output". */
  struct OutputParameters
  {
    std::map<std::string, std::string> probes;          ///< positions "x y z" [m] by name
    std::vector<double>                pressure_depths; ///< below the water level [m]
    OutputInterval                     envelope_interval{"1", 1}, solution_interval{"0", 0};
    unsigned int                       frames = 200; ///< largest number, 0: none
    OutputInterval                     checkpoint_interval{"500", 500}, progress_interval{"64", 64};
    bool                               figures = true;                ///< draw figures
    bool                               block_forces = true;           ///< write blocks.csv
    std::string                        stress_recovery = "tractions"; ///< tractions or elements
    double                             tensile_strength = 0.;         ///< [Pa], 0: none
    void                               add_parameters(Entries &prm);
    void                               check() const;

    /** Computes the samples of all intervals. @p sample: sampling interval of the motion [s]. Throws InputError for
     * an interval that is not a whole number of samples. */
    void read_intervals(double sample);

    /** Returns true if the stress recovery uses the known tractions. */
    bool knows_tractions() const { return stress_recovery == "tractions"; }

    /** Returns the positions of the probes by name [m]. Throws InputError for a malformed probe. */
    std::map<std::string, Vector3> probe_places() const;
  };

  /** All entries of an input file. */
  struct Scene
  {
    std::string  name;                       ///< of the file, without directory and .prm
    std::string  directory;                  ///< of the file; paths in the file are relative to it
    std::string  impact_rule = "mean-force"; ///< "Dynamics/Impact"
    std::string  scheme = "trapezoidal";     ///< time scheme of integrator_table()
    double       explicit_step = -1.;        ///< [s]; -1: from the critical step
    double       mass_scaling = 0.;          ///< wanted explicit step of own meshes [s]; 0: none
    unsigned int n_explicit = 1; ///< steps of an explicit scheme in a time step, set by Simulation
    std::map<std::string, std::string> initial_velocity;   ///< "vx vy vz" [m/s] by block, or "all"
    std::string                        factors = "single"; ///< precision of the matrix factors of time steps
    MeshParameters                     mesh;
    ElementParameters                  elements;
    Material                           concrete; ///< of volumes without an entry in @p concrete_zones
    double               sustained = 0.; ///< sustained modulus of the concrete [Pa]; 0: Young's modulus
    ZoneEntry            concrete_zones;
    DampingParameters    damping;
    ReservoirParameters  reservoir;
    JointParameters      joints;
    ContactParameters    contact;
    StaticParameters     statics;
    LoadParameters       loads;
    FoundationParameters foundation;
    unsigned int         steps_per_sample = 1; ///< time steps per sample of the ground motion
    MotionParameters     motion;
    LimitParameters      limits;
    OutputParameters     output;

    /** Returns the ratio of sustained and Young's modulus, for all zones of the concrete [-]. */
    double sustained_ratio() const { return sustained > 0. ? sustained / concrete.young : 1.; }

    bool is_explicit() const { return scheme == "explicit"; }

    /** Returns true if the matrix factors are in single precision. */
    bool has_single_factors() const { return factors == "single"; }

    /** Returns the strength for the share of the faces with larger tension [Pa]: "Output/Tensile strength",
     * or if it is zero "Limits/Tensile strength". 0: none. */
    double strength_of_area() const
    {
      return output.tensile_strength > 0. ? output.tensile_strength : limits.tensile_strength;
    }

    /** Returns true if the dam moves without an earthquake: by force histories or initial velocities. */
    bool moves_alone() const { return !loads.force_history.empty() || !initial_velocity.empty(); }

    /** Returns the initial velocities by physical id of the block, 0 for all blocks [m/s]. Throws InputError for a
     * malformed entry. */
    std::map<int, Vector3> initial_velocities() const;

    std::vector<Warning> warnings;             ///< of read_scene()
    bool                 is_for_modes = false; ///< read by `voussoir modes`; set before read_scene()

    /** Declares all entries. */
    void add_parameters(Entries &prm);

    /** Returns changes of modelling and numerical choices, without those that have no effect. Throws
     * InputError like hex_mesh(). */
    std::vector<ModelChoice> model_choices() const;

    /** Generates or reads the mesh. A generated mesh has rock if the foundation needs it. Throws InputError like
     * make_mesh(). */
    HexMesh hex_mesh() const;

    /** Checks all entries. Throws InputError for invalid values or combinations of values. */
    void check() const;

    /** Sets what follows from several entries, after check(). Throws InputError, as check() does. */
    void complete();

    std::vector<std::string> sources; ///< input file and included files

    /** Returns entry and path of all files that the entries name. A resumed run compares their content. */
    std::vector<std::pair<std::string, std::string>> input_files() const;

    /** Throws InputError if the output @p file of a command is an input of the scene, or if its directory
     * does not exist. */
    void check_output(const std::string &file) const;

  private:
    void check_explicit() const; ///< what the explicit scheme does not have
  };

  /** Reads an input file with its included files. Entries without effect and implausible values are reported
   * in Scene::warnings.
   *
   * @param file path of the input file. Paths of included files are relative to the including file.
   * @param overrides assignments "Section/Subsection/Entry=value", applied after the file. Values may have
   * units: in_declared_unit().
   * @param scene result
   * @param prm receives declarations and values, for printing
   *
   * Throws InputError with file, line and entry. For an unknown entry it names the most similar one. */
  void read_scene(const std::string &file, const std::vector<std::string> &overrides, Scene &scene,
                  Entries &prm);
} // namespace Voussoir

#endif
