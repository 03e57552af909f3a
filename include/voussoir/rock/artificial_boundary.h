// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_artificial_boundary_h
#define voussoir_artificial_boundary_h

#include <voussoir/rock/rock_model.h>

#include <string>

namespace Voussoir
{
  /** What has been done to a region up to now [J]: places in its list of works. */
  enum RegionWork
  {
    lost_in_damping,
    done_by_forces,
    gone_through_boundary,
    done_by_prescribed
  };

  /** A region at time t, as its boundary sees it: all but the boundary's nodes have made their step. Three
   * values per node unless said otherwise. */
  struct RegionStep
  {
    double                     dt; ///< [s]
    const RayleighDamping     &damping;
    const std::vector<double> &mass;     ///< one value per node [kg]
    const std::vector<bool>   &is_fixed; ///< components that must not move
    const Unknowns            &u;        ///< displacement at t [m]
    const Unknowns &K_x;      ///< force of the elements at t, stiffness-proportional damping included [N]
    const Unknowns &K_u;      ///< without that damping; empty where no account of energy is kept
    const Unknowns &force;    ///< handed in from outside [N]; empty if there is none
    const Unknowns &w_before; ///< of the boundary's nodes only: w of half a step before t

    /** Free field at t - dt, t and t + dt at free_field_nodes() of the boundary [m]; empty without a wave. */
    const Unknowns &field_before, &field, &field_next;

    Unknowns            &w;    ///< (u(t + dt) - u(t)) / dt: to be set at the boundary's nodes [m/s]
    std::vector<double> &work; ///< by RegionWork: to be added to, if K_u is not empty [J]
  };

  /** Where the mesh ends and the rock does not: gives the motion of its nodes from that of the region and of
   * the free field. One file per boundary, one row in boundary_table.cc; the region asks no boundary which
   * one it is. */
  class ArtificialBoundary
  {
  public:
    virtual ~ArtificialBoundary() = default;

    // Before there is a mesh:

    /** Layers of equal, straight cells along the artificial faces that it needs. */
    virtual unsigned int n_layers() const { return 0; }

    /** Do waves leave through it? One that throws them back gives the rock the energy of its motion, too. */
    virtual bool absorbs() const { return true; }

    /** InputError for what is known to be unstable; @p critical_time_step: of the rock [s]. */
    virtual void check(const RockRegionParameters &parameters, double critical_time_step) const;

    /** Why it may be unstable with these parameters, for the user; empty if it should not. */
    virtual std::string warning(const RockRegionParameters &parameters) const;

    // On a mesh:

    /** Make ready for a model, once. InputError if mesh or time step @p dt [s] do not allow it.
     * @p centre: where the scattered waves come from [m]. */
    virtual void attach(const RockModel &model, const Vector3 &centre, double dt) = 0;

    /** Nodes of the region whose motion it gives. */
    virtual const std::vector<unsigned int> &nodes() const = 0;

    /** Nodes where it asks for the free field. */
    virtual const std::vector<unsigned int> &free_field_nodes() const = 0;

    /** If not 0: free_field_nodes() are the first so many of each line of the model, line after line, and
     * what is near a section of the free field is so with its whole line. */
    virtual unsigned int nodes_per_line() const { return 0; }

    /** InputError if one of the @p prescribed nodes, which others move, is too near. */
    virtual void check_prescribed(const std::vector<unsigned int> &prescribed) const;

    /** Before the first step, at t = 0, if the first motion follows from displacement and free field. */
    virtual void start(const RegionStep &step);

    /** Sets the velocities w of its nodes, and adds to the works. */
    virtual void advance(const RegionStep &step) = 0;

    /** All that it remembers, for checkpoints. */
    virtual std::vector<std::vector<double> *> state() { return {}; }
  };

  /** Work on the region, in the last step, of nodes whose motion is not its own but given, from the force
   * that this motion takes [J]. Adds the losses and the work of forces there to the works. */
  double work_of_motion(const RegionStep &step, const std::vector<unsigned int> &nodes,
                        const Unknowns &w_before);

  /** InputError if one of the @p prescribed nodes is one of @p nodes: there must be @p layers of cells
   * between the base of the dam and the boundary. */
  void check_apart(const std::vector<unsigned int> &nodes, const std::vector<unsigned int> &prescribed,
                   unsigned int layers);
} // namespace Voussoir

#endif
