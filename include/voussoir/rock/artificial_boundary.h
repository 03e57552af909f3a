// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_artificial_boundary_h
#define voussoir_artificial_boundary_h

#include <voussoir/rock/rock_model.h>

#include <string>

namespace Voussoir
{
  /** Works since the start of the run [J]: indices in the list of works of a region. */
  enum RegionWork
  {
    lost_in_damping,       ///< dissipated by the damping of the rock
    done_by_forces,        ///< done by the external forces
    gone_through_boundary, ///< radiated through the artificial boundary
    done_by_prescribed,    ///< done by the prescribed nodes on the region
    n_region_works         ///< number of works
  };

  /** State of a region at time t in which its artificial boundary advances: all nodes except those of the
   * boundary have completed the step. Vectors have three values per node unless stated otherwise. */
  struct RegionStep
  {
    double                     dt; ///< time step of the rock [s]
    const RockDamping         &damping;
    const std::vector<double> &mass;     ///< one value per node [kg]
    const std::vector<bool>   &is_fixed; ///< fixed components, three per node
    const Unknowns            &u;        ///< displacement at t [m]
    const Unknowns            &K_x;      ///< element forces at t, with stiffness-proportional damping [N]
    const Unknowns &K_u;      ///< element forces without damping [N]; empty if no energy balance is kept
    const Unknowns &force;    ///< external forces [N]; empty: none
    const Unknowns &w_before; ///< velocity w of the previous step, at nodes() of the boundary only [m/s]

    /** Free-field displacement at t - dt, t and t + dt at free_field_nodes() of the boundary [m]. Empty
     * without an incident wave. */
    const Unknowns &field_before, &field, &field_next;

    Unknowns            &w;              ///< (u(t + dt) - u(t)) / dt [m/s]; the boundary sets it at its nodes
    std::vector<double> &work_of_chunks; ///< works, n_region_works per chunk of nodes: see add_work() [J]

    /** Adds @p done [J] to the work @p kind of @p node. Call it only if K_u is not empty, and in the order of
     * the nodes, so that sums are bitwise reproducible. */
    void add_work(const RegionWork kind, const unsigned int node, const double done) const
    {
      work_of_chunks[n_region_works * (node / RockSplit::per_chunk) + kind] += done;
    }
  };

  /** Artificial boundary of the rock mesh. It computes the motion of the boundary nodes from the motion of
   * the region and the free field.
   *
   * Each boundary has one file and one row in boundary_table.cc. The region does not depend on the type of
   * its boundary.
   *
   * Order of calls: n_layers(), check() and warning() before the mesh exists; then attach(),
   * check_prescribed() and, with several MPI processes, keep(); then start() once and advance() in each step.
   */
  class ArtificialBoundary
  {
  public:
    virtual ~ArtificialBoundary() = default;

    // Before the mesh exists:

    /** Returns the number of layers of equal, straight cells that the boundary requires along
     * the artificial faces. */
    virtual unsigned int n_layers() const { return 0; }

    /** Returns true if waves leave through the boundary. With a reflecting boundary, the prescribed motion of
     * the boundary also supplies energy to the rock. */
    virtual bool absorbs() const { return true; }

    /** Throws InputError for parameters that are known to be unstable. check_growth() measures others. */
    virtual void check(const RockRegionParameters &parameters) const;

    /** Returns a warning for the user if the boundary may be unstable with these parameters; otherwise an
     * empty string. */
    virtual std::string warning(const RockRegionParameters &parameters) const;

    // On a mesh:

    /** Returns the largest time step that attach() accepts [s]; infinity: any. */
    virtual double largest_step(const RockModel &model) const;

    /** Prepares the boundary for a model. Call it once.
     * @param model rock model
     * @param centre source point of the scattered waves: base of the dam [m]
     * @param dt time step of the rock [s]
     *
     * Throws InputError if the mesh or the time step does not satisfy the requirements of the boundary. */
    virtual void attach(const RockModel &model, const Vector3 &centre, double dt) = 0;

    /** Returns the nodes of the region that the boundary moves. */
    virtual const std::vector<unsigned int> &nodes() const = 0;

    /** Returns the nodes at which the boundary requires the free field. */
    virtual const std::vector<unsigned int> &free_field_nodes() const = 0;

    /** Returns the number of nodes per grid line in free_field_nodes(). If it is not 0, free_field_nodes()
     * contains this number of nodes of each line of the model, line after line. A line near a section of the
     * free field follows the section with all its nodes. */
    virtual unsigned int nodes_per_line() const { return 0; }

    /** Throws InputError if one of the @p prescribed nodes (the base of the dam) is too close
     * to the boundary. */
    virtual void check_prescribed(const std::vector<unsigned int> &prescribed) const;

    /** Sets the first motion at t = 0, before the first step, if it follows from the displacement and the
     * free field. */
    virtual void start(const RegionStep &step);

    /** Sets the velocity w of the boundary nodes for the step from t to t + dt, and adds the work to the
     * works of the region. */
    virtual void advance(const RegionStep &step) = 0;

    /** Restricts the boundary to the nodes that this MPI process integrates. @p stepped: one flag per node of
     * the region. Throws InputError if the boundary supports one process only. */
    virtual void keep(const std::vector<bool> &stepped);

    /** Returns the indices in free_field_nodes() that this process requires. Call it after keep(). */
    virtual std::vector<unsigned int> kept_points() const { return {}; }

    /** Returns for each of free_field_nodes() the node whose owner stores the data of this point. */
    virtual std::vector<unsigned int> nodes_of_points() const { return free_field_nodes(); }

    /** Returns all state variables, for checkpoints. Arrays with three values for each of free_field_nodes()
     * are gathered from the owners of nodes_of_points(). All other arrays must be equal on all processes. */
    virtual std::vector<std::vector<double> *> state() { return {}; }
  };

  /** Adds the work of nodes with imposed motion in the last step: boundary nodes or prescribed nodes.
   * @param step state of the region
   * @param nodes nodes with imposed motion
   * @param kept indices in @p nodes that this process integrates
   * @param w_before velocity of @p nodes in the previous step, three values each [m/s]
   * @param kind work that receives @p factor times the work of the imposed force
   * @param factor sign of this work
   *
   * The damping losses and the work of external forces at these nodes are added, too. */
  void add_work_of_motion(const RegionStep &step, const std::vector<unsigned int> &nodes,
                          const std::vector<unsigned int> &kept, const Unknowns &w_before, RegionWork kind,
                          double factor);

  /** Returns the numbers 0, 1, ..., n - 1. */
  std::vector<unsigned int> all_of(std::size_t n);

  /** Returns the indices in @p nodes of the nodes for which @p stepped is true. */
  std::vector<unsigned int> stepped_of(const std::vector<unsigned int> &nodes,
                                       const std::vector<bool>         &stepped);

  /** Throws InputError if one of the @p prescribed nodes is one of @p nodes. @p layers: number of cell layers
   * that are required between the base of the dam and the boundary, for the message. */
  void check_apart(const std::vector<unsigned int> &nodes, const std::vector<unsigned int> &prescribed,
                   unsigned int layers);
} // namespace Voussoir

#endif
