// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_scene_h
#define voussoir_scene_h

#include <voussoir/contact/contact_solver.h>
#include <voussoir/contact/law_parameters.h>
#include <voussoir/dam/limits.h>
#include <voussoir/dam/load_parameters.h>
#include <voussoir/dam/reservoir.h>
#include <voussoir/foundation/foundation_parameters.h>
#include <voussoir/mesh/mesh_source.h>
#include <voussoir/motion/motion_parameters.h>
#include <voussoir/solid/zones.h>

#include <map>

namespace Voussoir
{
  struct ElementParameters
  {
    unsigned int degree = 1;
    bool         incompatible_modes = true;
    void         add_parameters(Entries &prm);
  };

  /** Rayleigh damping C = a0 M + a1 K with the damping ratio at two frequencies. */
  struct DampingParameters
  {
    double ratio = .05, frequency_1 = 1.2, frequency_2 = 6.; ///< [-], [Hz], [Hz]
    void   add_parameters(Entries &prm);
    void   check() const;
    double mass_factor() const;      ///< a0 [1/s]
    double stiffness_factor() const; ///< a1 [s]
  };

  /** Section "Joints": the laws of the joints and their parameters. */
  struct JointParameters : LawParameters
  {
    JointParameters() { keys.seat_compliance = -1.; } ///< [m/Pa]; -1: 20 height/E

    std::string                         model = "FJA";
    std::string                         equations_name = "alart-curnier";
    std::map<unsigned int, std::string> overrides; ///< joint number -> model
    void                                add_parameters(Entries &prm);
    void                                check() const;
    /** @p young: modulus of the concrete [Pa]. */
    LawParameters law(double young) const;
    /** Does the law of any joint use the entry ("Joints/Friction")? */
    bool               any_reads(const std::string &entry) const;
    const std::string &model_of(const unsigned int joint) const
    {
      const auto found = overrides.find(joint);
      return found == overrides.end() ? model : found->second;
    }
  };

  struct StaticParameters
  {
    std::string  self_weight = "staged"; ///< or monolithic, none
    unsigned int water_increments = 1;
    double       gravity = 9.81; ///< [m/s^2]
    std::string  stages;         ///< before the water is raised to its level: static_stages()
    void         add_parameters(Entries &prm);
  };

  struct OutputParameters
  {
    std::map<std::string, std::string> probes;                    ///< name -> "x y z" [m]
    unsigned int                       envelope_interval = 1;     ///< [steps], 0: none
    unsigned int                       solution_interval = 0;     ///< [steps], 0: none
    unsigned int                       checkpoint_interval = 500; ///< [steps], 0: none
    unsigned int                       progress_interval = 64;    ///< [steps]
    bool                               figures = true;
    bool                               block_forces = true;           ///< blocks.csv
    std::string                        stress_recovery = "tractions"; ///< or elements
    double                             tensile_strength = 0.;         ///< [Pa], 0: none
    void                               add_parameters(Entries &prm);
    void                               check() const;
    bool knows_tractions() const { return stress_recovery == "tractions"; } ///< do stresses take them?
    std::map<std::string, Vector3> probe_places() const; ///< throws InputError for a malformed one
  };

  /** All entries of a scene file. */
  struct Scene
  {
    std::string          name;      ///< of the file, without directory and .prm
    std::string          directory; ///< of the file: paths in it are relative to this
    std::string          impact_rule = "mean-force";
    std::string          factors = "double"; ///< precision in which those of steps are kept
    MeshParameters       mesh;
    ElementParameters    elements;
    Material             concrete; ///< where no zone says otherwise
    ZoneEntry            concrete_zones;
    DampingParameters    damping;
    ReservoirParameters  reservoir;
    JointParameters      joints;
    ContactParameters    contact;
    StaticParameters     statics;
    LoadParameters       loads;
    FoundationParameters foundation;
    unsigned int         steps_per_sample = 1;   ///< of the ground motion
    bool                 error_estimate = false; ///< of the time step
    MotionParameters     motion;
    LimitParameters      limits;
    OutputParameters     output;

    bool has_single_factors() const { return factors == "single"; }

    /** Of the area of the faces where tension is above it: Output/Tensile strength, else that of the limits;
     * 0: none [Pa]. */
    double strength_of_area() const
    {
      return output.tensile_strength > 0. ? output.tensile_strength : limits.tensile_strength;
    }

    std::vector<std::string> warnings; ///< of read_scene(), about entries that the user wrote

    void add_parameters(Entries &prm);
    void check() const;

    std::vector<std::string> sources; ///< the scene file and the files that it includes

    /** Meshes and motions that it names: entry and path. */
    std::vector<std::pair<std::string, std::string>> input_files() const;

    /** Throws InputError if @p file, which a command is to write, is one that the scene is made of, or has no
     * directory. */
    void check_output(const std::string &file) const;
  };

  /** Reads a scene file with its includes (relative to the including file), then applies @p overrides, each
   *  "Section/Subsection/Entry=value". Values may carry a unit, see in_declared_unit(). Throws InputError
   * with file, line and entry; for an unknown entry it names the nearest known one. Entries without effect
   * and implausible values go to Scene::warnings. @p prm: receives the declarations and values, for printing.
   */
  void read_scene(const std::string &file, const std::vector<std::string> &overrides, Scene &scene,
                  Entries &prm);
} // namespace Voussoir

#endif
