// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_explicit_region_h
#define voussoir_explicit_region_h

#include <voussoir/rock/artificial_boundary.h>
#include <voussoir/rock/incident_field.h>

#include <memory>

namespace Voussoir
{
  /** Energies of the explicit region [J]. The values belong to half a step before ExplicitRegion::time(). */
  struct RegionEnergy
  {
    double kinetic = 0., strain = 0.; ///< current kinetic and strain energy
    double damping = 0.;              ///< dissipated by the damping of the rock since the start
    double external = 0.;             ///< work of ExplicitRegion::force since the start
    double transmitted = 0.;          ///< energy radiated through the artificial boundary; negative: entered
    double prescribed = 0.;           ///< work of the prescribed nodes on the region

    /** Returns the error of the energy balance [J]; zero up to round-off in a correct run. */
    double balance() const { return kinetic + strain + damping + transmitted - external - prescribed; }
  };

  /** Linear elastic region with lumped masses, integrated explicitly: Newmark with beta = 0 and gamma = 1/2.
   * Damping is evaluated with the predicted velocity (Hughes and Liu 1978, J. Appl. Mech. 45, 371-378).
   *
   * Between two steps the region stores the displacement u at t and the predicted velocity of the next step,
   * w = (u(t + dt) - u(t)) / dt. A step needs one product with the stiffness matrix. All nodes are
   * explicit except
   * - nodes of the artificial boundary, which the boundary moves;
   * - prescribed nodes (the base of the dam): element partition of Hughes and Liu. The caller supplies their predicted
   *   motion and receives their force on the rock elements.
   *
   * Displacements are absolute, without static ones. Values per node are x, y, z in the axes of the mesh.
   *
   * The region is created at rest. Optional calls before the first step, in this order: set_boundary(),
   * split_up(), set_free_field(); fix(), set_prescribed() and keep_energy() in any order; start(). */
  class ExplicitRegion
  {
  public:
    /** Creates a region at rest.
     * @param stiffness stiffness operator of the whole region
     * @param mass lumped mass of each node, positive [kg]
     * @param damping damping of the rock
     * @param dt time step of the rock [s]
     *
     * Throws InputError if @p dt exceeds the critical time step. */
    ExplicitRegion(RockOperator stiffness, std::vector<double> mass, const RockDamping &damping, double dt);

    /** Sets the artificial boundary. @p boundary must be attached to the model of the region. Throws
     * InputError if prescribed nodes are too close to it. */
    void set_boundary(std::unique_ptr<ArtificialBoundary> boundary);

    /** Returns the artificial boundary, or nullptr if there is none. */
    const ArtificialBoundary *artificial_boundary() const { return boundary.get(); }

    /** Sets the free field, which is the motion without the dam, at t = 0. Its points must be
     * ArtificialBoundary::free_field_nodes() of the boundary. */
    void set_free_field(std::unique_ptr<IncidentField> field);

    /** Fixes the given components, with the index 3 node + component: their displacement remains zero. */
    void fix(const std::vector<unsigned int> &components);

    /** Declares nodes whose motion the caller prescribes, in all components. The region ignores their masses,
     * except for mass-proportional damping. Call it once. Throws InputError if the nodes are too close to the
     * artificial boundary. */
    void set_prescribed(const std::vector<unsigned int> &nodes);

    /** External forces, three per node [N]. They act in all steps until they are changed. Empty: none. */
    Unknowns force;

    /** Restricts this MPI process to its part of the region. All processes call it before the first step,
     * after set_boundary().
     * @param split distribution of the nodes, equal on all processes
     * @param part stiffness operator of the part of this process, made with the same @p split */
    void split_up(RockSplit split, RockOperator part);
    /** Returns true if several processes share the region. */
    bool is_split() const { return !split.is_trivial(); }
    /** Returns the distribution of the nodes over the processes. */
    const RockSplit &parts() const { return split; }

    /** Returns true if a component of a node of this process exceeds @p velocity [m/s] or @p displacement [m]
     * in absolute value, or is not finite. */
    bool exceeds(double velocity, double displacement) const;

    // All processes call the functions gather_...(). With one process the functions do nothing.

    /** Gathers the values of energy() of the whole region on all processes. */
    void gather_energy();
    /** Gathers displacement() and half_step_velocity() of all nodes on all processes. */
    void gather_motion();

    /** Gathers the state of the whole region in the arrays of state() on the first process. */
    void gather_on_root();

    /** Advances the region by one step to t + dt.
     * @param u predicted displacement of the prescribed nodes at t + dt, three values each in the order of
     * set_prescribed() [m]; empty without prescribed nodes
     * @param v predicted velocity of the prescribed nodes at t + dt, in the same format [m/s]
     *
     * Returns K u + C v at t + dt, the force of the prescribed nodes on the elements with their damping, in
     * the same format [N]. The elements act on the nodes with the opposite force. The next step changes the
     * values of the reference. */
    const Unknowns &advance(const Unknowns &u = {}, const Unknowns &v = {});

    /** Begins the step of advance(), with its arguments. The caller must exchange the appended @p messages
     * (Ranks::exchange()) before end_step(). */
    void begin_step(const Unknowns &u, const Unknowns &v, std::vector<Ranks::Message> &messages);
    /** Completes the step of begin_step(). @p v and the result are those of advance(). */
    const Unknowns &end_step(const Unknowns &v);

    double       time() const { return clock[0] * dt; }         ///< current time t [s]
    double       time_step() const { return dt; }               ///< time step dt [s]
    unsigned int n_nodes() const { return stiffness.n_rows(); } ///< number of nodes
    /** Returns the displacement u at t, three values per node [m]. With several processes, the values of the
     * nodes of other processes are those of the last gather_motion(). */
    const Unknowns &displacement() const { return u; }
    /** Returns w = (u(t + dt) - u(t)) / dt, three values per node [m/s]. As to several processes, see
     * displacement(). */
    const Unknowns &half_step_velocity() const { return w; }
    /** Returns the memory variables at t. As to several processes, they are those of stepped nodes. */
    const DampedMotion &damped_motion() const { return damped; }

    /** Returns the largest stable time step of the region, with damping [s]. */
    double critical_time_step() const { return dt_critical; }

    /** Enables the energy balance, which takes a tenth of the time of a step. Call it while the region is at
     * rest, before start(). */
    void keep_energy();
    /** Returns the energies. They are zero before the first step and without keep_energy(). With several
     * processes they are those of the last gather_energy(). */
    RegionEnergy energy() const;

    /** Returns all state variables of the region, its boundary and its free field, for checkpoints. The
     * pointers are valid while the region exists. With several processes, gather_on_root() must precede
     * reading. */
    std::vector<std::vector<double> *> state();

    /** Sets an initial displacement at t = 0 [m] and an initial velocity half a step later [m/s], three
     * values per node. Fixed components remain zero. With keep_energy(), the initial energy counts as
     * external work. Not for a region with a free field. */
    void start(const Unknowns &displacement, const Unknowns &velocity);

  private:
    /** Twice the kinetic energy, twice the strain energy, damping losses and work of forces over dt/2, and the
     * result of DampedMotion::elastic(). Chunks of nodes are added in sequence, so that sums do not depend on the number
     * of threads. */
    using Sums = std::array<double, 5>;
    static constexpr unsigned int    n_energies = 3; ///< of a chunk in account, before its works
    static constexpr int             per_chunk = RockSplit::per_chunk;
    template <bool with_energy> Sums step_nodes(int first, int last);

    void                             move_prescribed(const Unknowns &u_new, const Unknowns &v_new);
    template <bool with_energy> void step_explicit_nodes();
    RegionStep                       step_of_region();
    RegionStep step_of_boundary(); ///< also stores the velocity of the boundary nodes in boundary_w

    RockOperator        stiffness;
    std::vector<double> mass, inverse_mass; ///< per node [kg]; per component [1/kg], 0 if not explicit
    std::vector<bool>   is_fixed;           ///< per component
    RockDamping         damping;
    double              dt, dt_critical;
    DampedMotion        damped;
    std::vector<double> clock = {0.}; ///< number of the step; a vector for state()

    Unknowns u, w;   ///< displacement, and velocity half a step later [m, m/s]
    Unknowns x, K_x; ///< displacement with damping (DampedMotion) [m], and K x [N]
    Unknowns K_u;    ///< forces without damping, computed from K_x [N]; empty without energy balance

    std::vector<unsigned int> prescribed;
    std::vector<double>       prescribed_mass;
    Unknowns                  prescribed_w, prescribed_force;

    std::unique_ptr<ArtificialBoundary> boundary;
    Unknowns                            boundary_w;    ///< velocity w of its nodes in the previous step [m/s]
    std::vector<unsigned int>           boundary_kept; ///< indices of its nodes that this process integrates

    std::unique_ptr<IncidentField> free_field;
    Unknowns field_before, field, field_next; ///< at its points, for the last, current and next time [m]
    std::vector<double> work;                 ///< per chunk and RegionWork [J]
    /** Per chunk: twice the kinetic and twice the strain energy half a step before time(), twice the energy
     * of the mechanisms of the damping, and the works at that time. */
    std::vector<double>              account;
    RockSplit                        split;
    std::vector<std::pair<int, int>> pieces; ///< ranges of nodes of this process, within chunks
  };

  /** Returns the message for a time step @p dt above the @p critical one [s]. The caller appends the
   * suggested action. */
  std::string beyond_critical_step(double dt, double critical);
} // namespace Voussoir

#endif
