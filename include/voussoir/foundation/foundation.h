#ifndef voussoir_foundation_h
#define voussoir_foundation_h

#include <voussoir/dynamics/newmark.h>
#include <voussoir/foundation/foundation_parameters.h>
#include <voussoir/foundation/rock_statics.h>
#include <voussoir/rock/rock_region.h>
#include <voussoir/solid/solid_model.h>

namespace Voussoir
{
  struct GroundMotion;

  /** One foot of the dam: a node of the rock and the free nodes of the dam that stand on it. */
  struct Foot
  {
    unsigned int              rock;
    std::vector<unsigned int> nodes; ///< equations of the dam
  };

  /** The feet of the dam on the rock nodes at @p points; @p source names the mesh. Throws InputError where a
   * node of the dam's base has no rock. */
  std::vector<Foot> find_feet(const SolidModel &dam, const std::vector<std::array<double, 3>> &points,
                              const std::string &source);

  /** What the scene says of the rock; @p centre: of the dam's base [m], @p dt: of the rock [s]. */
  RockRegionParameters region_parameters(const FoundationParameters &p, const std::array<double, 3> &centre,
                                         double dt);

  /** Layers of equal, straight elements that an artificial boundary needs: mtfN 2 N, since each of its lines
   * has 2 N + 1 nodes, and at least 6; the others none. */
  unsigned int n_boundary_layers(const std::string &boundary);

  /** InputError where the mesh has fewer of them. @p source names the mesh. */
  void check_boundary_layers(const FoundationParameters &parameters, const HexMesh &mesh,
                             const std::string &source);

  /** The rock under and around the dam: explicit, in the element partition of Hughes and Liu (1978): the
   * nodes of the dam's base are the dam's, with the rock's mass lumped to them; the rock's elements act on
   * them with the forces of their predicted motion, u + dt v + dt^2/4 a. Displacements of the rock are those
   * of the earthquake; the static state is superposed.
   *
   *  With m substeps the rock makes m steps in one of the dam: the feet go evenly from one prediction to the
   * next (Belytschko, Yen and Mullen 1979), and the dam feels the force at the end. Predictions over so long
   * a step make feet unstable that are lighter than the rock's stiffness there asks; so for m > 1 each foot
   * carries in addition the mass k dt^2/2, k bounding the rock's stiffness between the feet: an error in the
   * order of dt^2, whose size is in doc/rock.md. For m > 2 slow growth is left, which stiffness-proportional
   * damping of 0.15 steps of the rock suppresses; check() asks for it. */
  class Foundation
  {
  public:
    /** @p mesh: dam and rock; @p dam: the dam's own nodes, those of its base free. Throws InputError for a
     * mesh that the boundary or the program cannot use. */
    Foundation(const FoundationParameters &parameters, const HexMesh &mesh, const SolidModel &dam,
               const std::string &source);

    /** The rock's mass at the base, half of it each where two monoliths stand on a node. */
    void add_mass(Structure &structure) const;

    unsigned int n_nodes() const { return static_cast<unsigned int>(model.points.size()); }
    double       critical_time_step() const { return dt_critical; } ///< of the rock [s]
    std::string  warning(double dt) const;                          ///< why it may be unstable, or empty

    /** Springs between dam and rock for the static iteration, per component of the dam [N/m]. */
    Unknowns static_springs(const Structure &structure) const;

    /** Displacements of the rock, fixed at its artificial boundary, under the forces @p r of the dam on it, 3
     * per node of the dam [N], with a residual of @p tolerance times their size; only at the base, 3 per foot
     * [m]. Sets up the solver when first called, and says in @p log what it does. */
    void settle(const Unknowns &r, double tolerance, Unknowns &u_base, Log &log);

    /** InputError for what would become unstable at the dam's step @p dt [s]: an artificial boundary with
     * lines too short, waves too fast, Gauss points, or too near the base; a high Poisson's ratio, or more
     * than two substeps, without enough damping. */
    void check(double dt) const;

    /** Add the mass to the feet that substeps need, if there are more than one in a step @p dt of the dam; to
     * be done before its Newmark is made. Returns that mass [kg]. */
    double add_interface_mass(Structure &structure, double dt) const;

    /** Make ready for @p n_steps of the dam of size @p dt [s] from its static displacement @p u, at rest. */
    void start(const GroundMotion &outcrop, double dt, unsigned int n_steps, const Unknowns &u);

    /** The rock's part of the next step of the dam; adds its forces to @p load [N]. */
    void advance(Unknowns &load);

    /** The dam has made its step. */
    void follow(const DynamicState &state);

    /** Mean velocity of the feet as predicted for the end of the step, v + dt/2 a, after advance(); off by
     * dt/2 times the change of acceleration [m/s]. */
    Vector3 base_velocity() const;

    /** Energies of the rock, half a step of its own before the dam's time [J]. */
    const RegionEnergy &energy() const { return region->energy(); }

    /** Work of the rock's elements on the feet so far, as the dam counts it [J]. With that of the feet on the
     * rock (energy().prescribed) it adds up to what the coupling made. */
    double work_on_dam() const { return work[0]; }

    double seconds = 0.; ///< of wall time in advance()

    const std::vector<Foot> &feet() const { return foot; }
    const RockModel         &rock() const { return model; }
    const ExplicitRegion    &explicit_region() const { return *region; } ///< after start()

    std::vector<std::vector<double> *> state(); ///< for checkpoints, after start()

  private:
    const FoundationParameters      parameters;
    HexMesh                         mesh;
    std::array<double, 3>           centre{}; ///< of the dam's base: scattered waves come from there [m]
    RockModel                       model;
    std::vector<Foot>               foot;
    std::unique_ptr<ExplicitRegion> region;
    std::unique_ptr<RockStatics>    statics; ///< while the static state is looked for
    unsigned int                    n_settled = 0;
    double                          dt = 0., dt_critical = 0.; ///< of the dam, for the rock [s]
    Unknowns                        rest;                      ///< of the feet [m]
    Unknowns                        u_feet, v, a;              ///< of the feet
    Unknowns                        force, force_before;       ///< of the rock's elements on them [N]
    std::vector<double>             work = {0.};               ///< on the dam [J]
    Unknowns                        u_predicted, v_predicted;  ///< for the end of the step
  };
} // namespace Voussoir

#endif
