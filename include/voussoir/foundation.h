#ifndef voussoir_foundation_h
#define voussoir_foundation_h

#include <voussoir/foundation_parameters.h>
#include <voussoir/newmark.h>
#include <voussoir/rock_region.h>
#include <voussoir/solid_model.h>

namespace Voussoir
{
  struct GroundMotion;

  /** The rock under and around the dam: explicit, in the element partition of Hughes and Liu (1978): the
   * nodes of the dam's base are the dam's, with the rock's mass lumped to them; the rock's elements act on
   * them with the forces of their predicted motion, u + dt v + dt^2/4 a. Displacements of the rock are those
   * of the earthquake; the static state is superposed. */
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
    double       critical_time_step() const; ///< [s]
    std::string  warning(double dt) const;   ///< why it may be unstable, or empty

    /** Springs between dam and rock for the static iteration, per component of the dam [N/m]. */
    Unknowns static_springs(const Structure &structure) const;

    /** Displacements of the rock, fixed at its artificial boundary, under the forces @p r of the dam on it, 3
     *  per node of the dam [N]; only at the base, 3 per foot [m]. */
    void settle(const Unknowns &r, Unknowns &u_base);

    /** Make ready for shaking from the static displacement @p u of the dam, at rest. @p mass_damping: of the
     * dam [1/s]. */
    void start(const GroundMotion &outcrop, double dt, unsigned int n_steps, const Unknowns &u,
               double mass_damping);

    /** One step of the rock, to the time of the next step of the dam, whose state is still that before it;
     *  subtracts the forces of the rock from @p load [N]. */
    void advance(const DynamicState &state, Unknowns &load);

    /** The dam has made its step. */
    void follow(const DynamicState &state);

    /** Mean displacement of the lowest part of the base [m]. */
    Vector3 base_motion(const Unknowns &u) const;

    double seconds = 0.; ///< of wall time in advance()

    /** One foot of the dam: a rock node and the one or two free nodes of the dam that stand on it. */
    struct Foot
    {
      unsigned int              rock;
      std::vector<unsigned int> nodes; ///< equations of the dam
    };
    const std::vector<Foot> &feet() const { return foot; }

    std::vector<std::vector<double> *> state(); ///< for checkpoints, after start()

  private:
    const FoundationParameters      parameters;
    HexMesh                         mesh;
    RockModel                       model;
    std::vector<Foot>               foot;
    std::vector<unsigned int>       lowest; ///< feet
    std::unique_ptr<ExplicitRegion> region;
    double                          dt = 0., dam_mass_damping = 0.;
    Unknowns rock_static;                    ///< displacement of the whole rock in the static state: guess
    Unknowns rest;                           ///< of the feet [m]
    Unknowns v, a, u_predicted, v_predicted; ///< of the feet
  };
} // namespace Voussoir

#endif
