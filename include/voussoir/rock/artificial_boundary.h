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
    done_by_prescribed,
    n_region_works
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

    Unknowns            &w;              ///< (u(t + dt) - u(t)) / dt: to be set at the boundary's nodes [m/s]
    std::vector<double> &work_of_chunks; ///< of nodes, by RegionWork: see add_work() [J]

    /** If K_u is not empty: @p done at one of the nodes, by other nodes in their order. */
    void add_work(const RegionWork kind, const unsigned int node, const double done) const
    {
      work_of_chunks[n_region_works * (node / RockSplit::per_chunk) + kind] += done;
    }
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

    /** Only the nodes that are @p stepped here count from now on, with several ranks. */
    virtual void keep(const std::vector<bool> &stepped);

    /** Places among free_field_nodes() that the kept nodes, and all stepped ones, ask for; after keep(). */
    virtual std::vector<unsigned int> kept_points() const { return {}; }

    /** For each of free_field_nodes(), and what it remembers of them, the node whose owner has it. */
    virtual std::vector<unsigned int> nodes_of_points() const { return free_field_nodes(); }

    /** All that it remembers, for checkpoints; arrays of three numbers for each of free_field_nodes() are
     * gathered from the owners of nodes_of_points(), all others are to be the same on all ranks. */
    virtual std::vector<std::vector<double> *> state() { return {}; }
  };

  /** Adds to the works what nodes whose motion is not the region's own but given have done in the last step,
   * by the force that this motion takes: @p factor times it as @p kind; losses and the work of forces there.
   * @p kept: places among @p nodes. */
  void add_work_of_motion(const RegionStep &step, const std::vector<unsigned int> &nodes,
                          const std::vector<unsigned int> &kept, const Unknowns &w_before, RegionWork kind,
                          double factor);

  /** 0, 1, ... n - 1. */
  std::vector<unsigned int> all_of(std::size_t n);

  /** Places of the @p stepped ones among the @p nodes. */
  std::vector<unsigned int> stepped_of(const std::vector<unsigned int> &nodes,
                                       const std::vector<bool>         &stepped);

  /** InputError if one of the @p prescribed nodes is one of @p nodes: there must be @p layers of cells
   * between the base of the dam and the boundary. */
  void check_apart(const std::vector<unsigned int> &nodes, const std::vector<unsigned int> &prescribed,
                   unsigned int layers);
} // namespace Voussoir

#endif
