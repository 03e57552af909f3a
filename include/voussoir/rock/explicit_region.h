// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_explicit_region_h
#define voussoir_explicit_region_h

#include <voussoir/rock/artificial_boundary.h>
#include <voussoir/rock/incident_field.h>

#include <memory>

namespace Voussoir
{
  /** Energies of the explicit region half a step before its time [J]. */
  struct RegionEnergy
  {
    double kinetic = 0., strain = 0.;
    double damping = 0.;     ///< dissipated so far by Rayleigh damping
    double external = 0.;    ///< work so far of the forces handed in
    double transmitted = 0.; ///< what left so far through the artificial boundary; negative if it came in
    double prescribed = 0.;  ///< work so far of the prescribed nodes on the region

    double balance() const { return kinetic + strain + damping + transmitted - external - prescribed; }
  };

  /** A linear elastic region with lumped masses, integrated explicitly: Newmark with beta = 0, gamma = 1/2,
   * damping evaluated with the predicted velocity (Hughes and Liu 1978, J. Appl. Mech. 45, 371-378).
   *
   *  Between the steps it keeps u at t and the predicted velocity of the next step, (u(t + dt) - u(t)) / dt:
   *  one product with the stiffness per step. Nodes are explicit but for
   *  - those of the artificial boundary, which moves them as it will;
   *  - prescribed ones (the dam's base), whose predicted motion is handed in: there the region gives the
   * force of its elements, the element partition of Hughes and Liu. */
  class ExplicitRegion
  {
  public:
    /** @p mass: of each node [kg]. At rest. InputError if @p dt exceeds the critical time step. */
    ExplicitRegion(RockOperator stiffness, std::vector<double> mass, const RayleighDamping &damping,
                   double dt);

    /** @p boundary: attached to the region's model. */
    void set_boundary(std::unique_ptr<ArtificialBoundary> boundary);

    /** Null if there is none. */
    const ArtificialBoundary *artificial_boundary() const { return boundary.get(); }

    /** Motion without dam; its points are to be the boundary's free_field_nodes(). */
    void set_free_field(std::unique_ptr<IncidentField> field);

    /** Components that do not move: 3 node + component. */
    void fix(const std::vector<unsigned int> &components);
    void fix_nodes(const std::vector<unsigned int> &nodes);

    /** Nodes whose motion is handed in. Their masses do not count here. InputError if the
     * boundary finds them too near. */
    void set_prescribed(const std::vector<unsigned int> &nodes);

    /** External forces, three per node [N], kept until changed. Empty at first: none. */
    Unknowns force;

    /** This rank shall step its part of the region: to be done with several, before the first step, by all.
     * @p part: of the operator, made with the @p split. */
    void             split_up(RockSplit split, RockOperator part);
    bool             is_split() const { return !split.is_trivial(); }
    const RockSplit &parts() const { return split; }

    /** Does a node that this rank steps move faster, or has it moved farther [m/s, m]? */
    bool exceeds(double velocity, double displacement) const;

    /** With several ranks: all get the whole region's energies up to now, and displacement() and
     * half_step_velocity() of all nodes. */
    void gather_energy();
    void gather_motion();

    /** With several ranks: what state() has is the whole region's after that, on the first rank. */
    void collect();

    /** One step, to t + dt. @p u, @p v: predicted displacement [m] and velocity [m/s] of the prescribed nodes
     * at t + dt, three values each, in the order of set_prescribed(). Returns what the region's elements and
     * their damping take from these nodes, K u + C v [N]. */
    const Unknowns &advance(const Unknowns &u = {}, const Unknowns &v = {});

    /** The same in two parts, between which the @p messages that it adds are to be exchanged. */
    void            begin_step(const Unknowns &u, const Unknowns &v, std::vector<Ranks::Message> &messages);
    const Unknowns &end_step(const Unknowns &v);

    double          time() const { return clock[0] * dt; } ///< [s]
    double          time_step() const { return dt; }
    unsigned int    n_nodes() const { return stiffness.n_rows(); }
    const Unknowns &displacement() const { return u; }
    /** (u(t + dt) - u(t)) / dt [m/s] */
    const Unknowns &half_step_velocity() const { return w; }
    /** At the time itself; of prescribed nodes half a step earlier. */
    Unknowns velocity() const;

    /** Time step beyond which the region is unstable, damping included [s]. */
    double critical_time_step() const { return dt_critical; }

    /** The energy account costs a tenth of a step; off at first. Switch on at rest. */
    void         keep_energy() { K_u.assign(u.size(), 0.); }
    RegionEnergy energy() const; ///< with several ranks: at the last gather_energy()

    std::vector<std::vector<double> *> state();

    /** Any start: displacement at t = 0, and velocity half a step later. Without a free field. */
    void start(const Unknowns &displacement, const Unknowns &velocity);

  private:
    /** Kinetic energy and strain energy, twice; losses and work of forces over dt/2. Chunks of nodes are
     * added in their order, so that sums do not depend on the number of threads. */
    using Sums = std::array<double, 4>;
    static constexpr int             per_chunk = RockSplit::per_chunk;
    template <bool with_energy> Sums step_nodes(int first, int last);

    void                             move_prescribed(const Unknowns &u_new, const Unknowns &v_new);
    template <bool with_energy> void step_explicit_nodes();
    RegionStep                       step_of_region();
    RegionStep                       step_of_boundary(); ///< the motion of its nodes kept

    RockOperator        stiffness;
    std::vector<double> mass, inverse_mass; ///< of nodes; of components, zero where not explicit
    std::vector<bool>   is_fixed;           ///< components
    RayleighDamping     damping;
    double              dt, dt_critical;
    std::vector<double> clock = {0.}; ///< number of the step

    Unknowns u, w;   ///< displacement, and velocity of half a step later [m, m/s]
    Unknowns x, K_x; ///< displacement with the stress of damping added, and its force
    Unknowns K_u;    ///< force of the displacement alone, from K_x; empty without the energy account

    std::vector<unsigned int> prescribed;
    std::vector<double>       prescribed_mass;
    Unknowns                  prescribed_w, prescribed_force;

    std::unique_ptr<ArtificialBoundary> boundary;
    Unknowns                            boundary_w;    ///< w of its nodes a step before
    std::vector<unsigned int>           boundary_kept; ///< places of those of its nodes that are stepped here

    std::unique_ptr<IncidentField> free_field;
    Unknowns            field_before, field, field_next; ///< at its points: last, this and next time
    std::vector<double> work;                            ///< by chunk and RegionWork
    /** Of each chunk: kinetic and twice the strain energy half a step before the time, and the works then. */
    std::vector<double>              account;
    RockSplit                        split;
    std::vector<std::pair<int, int>> pieces; ///< nodes that are stepped here, in parts of chunks
  };

  /** Returns the largest circular frequency of M^-1 K [1/s], from above by at most 5e-6 of it: Lanczos'
   * method, with the residual added. @p mass: of each node [kg]. */
  double largest_frequency(const RockOperator &stiffness, const std::vector<double> &mass);
  double largest_frequency(const BlockSparseMatrix &stiffness, const std::vector<double> &mass);

  /** Critical time step of the explicit scheme with damping lagged [s]: w dt = 2 (sqrt(1 + xi^2) - xi), xi
   * the damping ratio at the frequency @p w (Hughes and Liu 1978). */
  double critical_time_step(double w, const RayleighDamping &damping);

  /** The message for a time step beyond the critical one, to which the mend is added. */
  std::string beyond_critical_step(double dt, double critical);
} // namespace Voussoir

#endif
