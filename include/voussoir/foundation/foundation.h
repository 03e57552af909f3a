// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_foundation_h
#define voussoir_foundation_h

#include <voussoir/base/log.h>
#include <voussoir/contact/contact_result.h>
#include <voussoir/dynamics/dynamic_state.h>
#include <voussoir/dynamics/support.h>
#include <voussoir/dynamics/time_grid.h>
#include <voussoir/foundation/foundation_parameters.h>
#include <voussoir/mesh/mesh.h>
#include <voussoir/solid/solid_model.h>

#include <functional>
#include <limits>

namespace Voussoir
{
  struct GroundMotion;

  /** Input of the constructors of foundations. */
  struct FoundationSite
  {
    const FoundationParameters &parameters; ///< of the input file
    const HexMesh              &mesh;       ///< mesh of dam and rock
    std::string                 source;     ///< name of the mesh: arch210, or the table or mesh file
    unsigned int                degree = 1; ///< polynomial degree of the elements
    bool                        incompatible_modes = true; ///< the elements of the dam have these modes

    /** true: massless rock forms one body with the dam. This is required for the explicit scheme, tied joints (not with
     * uniform damping), impact rules other than ImpactRule::mean_force, and written contact problems. */
    bool one_body = false;

    std::string generated_in =
        ""; ///< section of the entries of a generated mesh: Mesh/Arch210; empty: mesh from a file
  };

  // Nodes of the dam are its free nodes, numbered by SolidModel::equation. Components are in the axes of the
  // mesh: x downstream, y to the left bank, z up.

  /** Solves for the static state of the dam under nodal loads, three values per node of the dam [N]. */
  using DamSolve = std::function<ContactResult(const Unknowns &load)>;

  /** Motion of the ground without the dam at places of the valley, integrated in step with the dam. */
  class ValleyMotion
  {
  public:
    virtual ~ValleyMotion() = default;

    /** Advances by @p n steps of the rock. Returns the displacement since the start of the earthquake, three values
     * per place [m]. Must be called by all ranks. */
    virtual Unknowns advance(unsigned int n) = 0;

    /** Returns the time of the displacement minus the time at which the step of the dam ends [s]. */
    virtual double lead() const = 0;

    /** Returns all state variables, as Neighbour::state(). */
    virtual std::vector<std::vector<double> *> state() = 0;
  };

  /** Part of a foundation that is known before a run: what it requires of mesh and time step, and its
   * description. */
  class FoundationSetup
  {
  public:
    virtual ~FoundationSetup() = default;

    /** Returns true if the mesh must contain rock. */
    virtual bool uses_rock() const { return false; }

    /** Returns true if a run can be resumed only with the same or a longer ground motion. This applies if
     * arrays of the checkpoint have the length of the ground motion, as the free field of explicit rock:
     * Checkpoint can extend an array, but not shorten it. */
    virtual bool resumes_longer_only() const { return false; }

    /** Writes properties and warnings to the log. Without an earthquake the grid has no time steps. */
    virtual void report(Log & /*log*/, const TimeGrid & /*grid*/) const {}

    /** Returns the time from the start of the ground motion to its arrival at the lowest base node [s]. It is
     * the same for all components, and 0 if the motion is prescribed. An automatic duration of the run is
     * longer by this time. Must be called after BaseSupport::add_stiffness(). */
    virtual double delay() const { return 0.; }

    /** Returns the largest stable step of the foundation [s]; infinity: no limit. */
    virtual double largest_step() const { return std::numeric_limits<double>::infinity(); }

    /** Returns the text after "Steps N of DT s" in the log, with the punctuation before it. Examples:
     *  - "; the scheme of the dam is implicit, without a critical time step" (default),
     *  - ", 1 rock step each; critical time step of the rock 0.00125 s". */
    virtual std::string about_steps() const;

    /** Adds properties and results of the foundation to summary.json, at the end of the run. */
    virtual void add_to_summary(Json & /*summary*/, const TimeGrid & /*grid*/) const {}

    /** Throws InputError if the time integration would be unstable. The message uses the number of time steps
     * of the dam per sample of the ground motion. Called before a dynamic analysis only. */
    virtual void check(const TimeGrid & /*grid*/, unsigned int /*steps_per_sample*/) const {}

    /** Throws InputError if stations of the motion do not fit the base. Called before a dynamic analysis only. */
    virtual void check_stations(const GroundMotion & /*motion*/) const {}
  };

  /** Part of a foundation under the base nodes of the dam: stiffness, mass, static state, and the support in
   * a time step. */
  class BaseSupport
  {
  public:
    virtual ~BaseSupport() = default;

    /** Treatment of the nodes of the dam on its base. Monoliths that meet at the base have nodes at the same
     * position there. */
    enum class Base
    {
      fixed,  ///< no unknowns: the nodes have the motion of the ground
      merged, ///< unknowns, one node for all monoliths that meet at a position
      tied,   ///< unknowns, one node per monolith; tied joint pairs connect nodes at the same position
      coupled ///< unknowns, one node per monolith, without joint pairs; support() connects these nodes
    };
    virtual Base base() const { return Base::fixed; } ///< returns the treatment; known before the assembly

    /** Returns true if displacements are relative to the ground and the ground motion acts as an inertia load
     * on the dam. Returns false if displacements are absolute. */
    virtual bool moves_base() const { return true; }

    /** Returns the motion of the valley upstream of the dam at the given places [m], or null if it is the ground
     * motion. The x coordinate of a place does not count. Must be called after Neighbour::start(). */
    virtual std::unique_ptr<ValleyMotion> valley(const std::vector<Vector3> & /*places*/) { return nullptr; }

    /** Adds the stiffness of the foundation to the structure and stores the base nodes. The nodes of the dam
     * are final and treated according to base(). */
    virtual void add_stiffness(const SolidModel & /*dam*/, Structure & /*structure*/) {}

    /** Changes the stiffness of the foundation in a structure of the static state, where all stiffnesses have a
     * common factor, to the one with the sustained modulus of the rock. Only if add_stiffness() has added a
     * stiffness. */
    virtual void add_sustained_stiffness(double /*ratio*/, Structure & /*structure*/) const {}

    /** Adds the rock mass of the base nodes to Structure::mass [kg]. Must be called after the inertia loads
     * of the dam were computed, which exclude the rock. The structure may have masses only (critical step). */
    virtual void add_mass(Structure & /*structure*/) const {}

    /** Returns auxiliary springs at the base nodes for the static solution, three values per node of the dam
     * [N/m], or an empty vector. A monolith without fixed nodes has a singular stiffness matrix; the springs
     * make it regular. They do not change the result: the foundation subtracts their stiffness in
     * static_base(), or solve_static() iterates until they are free of force. */
    virtual Unknowns static_springs(const Structure & /*structure*/) const { return {}; }

    /** Returns the dam nodes on the foundation and the compliance (S - springs)^-1 [m/N], with the
     * sustained stiffness S of the foundation and the springs of static_springs(). Marks these nodes as
     * interface nodes of their bodies. Returns nullptr if the static solution does not eliminate the base nodes. */
    virtual std::unique_ptr<BaseElimination::Nodes> static_base(Structure & /*structure*/) const
    {
      return nullptr;
    }

    /** Computes the static state of dam and foundation.
     *
     * @param solve computes the dam on the springs and stores its displacements in @p u
     * @param springs auxiliary springs of static_springs(), three values per node of the dam [N/m]
     * @param u displacements of the dam, three values per node; each call of @p solve changes them [m]
     * @param load nodal loads of the dam, three values per node [N]. Forces of the foundation are added.
     * @param failure message if dam and foundation do not converge
     * @param log receives the progress
     *
     * Returns costs of the contact problems. ContactResult::converged is false if one of them, or dam and
     * foundation, did not converge. */
    virtual ContactResult solve_static(const DamSolve &solve, const Unknowns &springs, const Unknowns &u,
                                       Unknowns &load, std::string &failure, Log &log);

    /** Returns the strain energy of massless rock in the static state [J], otherwise zero. It is zero before
     * support(). */
    virtual double strain_at_start() const { return 0.; }

    /** Returns the support of the base nodes, or nullptr if the dam is not coupled by a support
     * (Support: massless or subcycled rock). The foundation owns the support. Marks the base nodes as
     * interface nodes of their bodies. Must be called after Neighbour::start() and before the Newmark object
     * of the dam is created. */
    virtual Support *support(Structure & /*structure*/) { return nullptr; }

    /** Returns what takes the steps of an explicit scheme, or nullptr. The foundation owns it. Its stiffness leaves the
     * structure. Must be called after Neighbour::start(). */
    virtual StepNeighbour *step_neighbour(Structure & /*structure*/) { return nullptr; }

    /** Returns the mean predicted velocity of the base nodes at the end of the time step: components x, y, z
     * in the axes of the mesh [m/s]. It is the absolute velocity if displacements are absolute, and zero if
     * they are relative to the ground (moves_base()). Integrator::advance() requires it for mass-proportional
     * damping. Must be called after Neighbour::advance(). */
    virtual Vector3 base_velocity() const { return {}; }
  };

  /** Upper bounds of the motion of a Neighbour, and the reference of its energies. */
  struct NeighbourBounds
  {
    double velocity = 0.;     ///< bound of a component at a node, absolute value [m/s]
    double displacement = 0.; ///< bound of a component at a node from the static state, absolute value [m]
    double strain = 0.;       ///< strain energy of dam and foundation in the static state [J]
  };

  /** Monitor of the instability of a Neighbour, called by StabilityMonitor. */
  class NeighbourMonitor
  {
  public:
    virtual ~NeighbourMonitor() = default;

    /** Number of time steps of the dam between two calls of motion_excess(). */
    static constexpr unsigned int interval = 10;

    /** Stores the bounds at the start of the time loop. The bounds of energies follow from the ground
     * @p motion. Must be called on all ranks, with equal bounds. */
    virtual void set_bounds(const GroundMotion &motion, const NeighbourBounds &bounds) = 0;

    /** Returns a message if an energy exceeds its bound, otherwise an empty string. Called on the first rank
     * after each step. */
    virtual std::string energy_excess() const = 0;

    /** Returns a message if a velocity or a displacement exceeds its bound, otherwise an empty string. Called
     * on the first rank after every interval steps and after the last step. */
    virtual std::string motion_excess() const = 0;

    /** Returns what to change in the input file after an instability. */
    virtual std::string suggestions() const = 0;
  };

  /** Part of the model next to the dam that exchanges forces with it in time, such as rock. The time loop
   * calls all Dam::neighbours. */
  class Neighbour
  {
  public:
    virtual ~Neighbour() = default;

    /** Prepares the time steps, from rest in the static state. Arguments:
     *  - GroundMotion: motion of a free ground surface without the dam, absolute,
     *  - TimeGrid: time steps of the dynamic analysis,
     *  - Unknowns u: static displacement of the dam, three values per node [m].
     *
     * The neighbour copies the data that it requires: the arguments need not outlive the call. Must be called
     * once, by all ranks. */
    virtual void start(const GroundMotion & /*motion*/, const TimeGrid & /*grid*/, const Unknowns & /*u*/) {}

    /** Advances the neighbour by one time step of the dam. Adds its forces on the dam at the end of the step
     * to the nodal loads of the dam, three values per node [N]. Must be called by all ranks. A neighbour that
     * exchanges its forces by Support adds none. */
    virtual void advance(Unknowns & /*load*/) {}

    /** Stores the motion of the dam at the end of the time step. Its displacements include the static ones.
     * Must be called by all ranks. */
    virtual void update_from_dam(const DynamicState & /*state*/) {}

    /** Returns the wall time of the neighbour in all time steps so far [s]. */
    virtual double seconds() const { return 0.; }

    /** Returns the CPU time of this rank in the same steps, without waiting for messages [s]. */
    virtual double work() const { return 0.; }

    /** Returns the current energies and works [J] with their column names in energy.csv. The names do not
     * change after start(). */
    virtual std::vector<std::pair<std::string, double>> energies() const { return {}; }

    /** Returns the largest error of the energy balance of the neighbour so far, relative to its largest
     * energy [-]. */
    virtual double balance_error() const { return 0.; }

    /** Writes balance_error() to the log. */
    virtual void report_balance(Log & /*log*/) const {}

    /** Returns the arrays that determine the further time steps, always in the same order. A checkpoint
     * contains their values, and a resumed run overwrites them. The pointers are valid while the neighbour
     * exists, and the sizes are constant. Empty before start(), and for massless rock before support(). */
    virtual std::vector<std::vector<double> *> state() { return {}; }

    /** Completes the arrays of state() on the first rank, which writes the checkpoint. Otherwise a rank has
     * only the values of the nodes that it computes. Must be called by all ranks. */
    virtual void gather_on_root() {}

    /** Returns the monitor of the instability, or nullptr if there is nothing to monitor or before
     * start(). */
    virtual NeighbourMonitor *monitor() { return nullptr; }
  };

  /** Foundation of the dam. The base class is the rigid foundation with prescribed ground motion.
   * Displacements of the dam are then relative to the ground. Derived classes are other foundations.
   *
   * Order of the calls:
   *  1. assembly of the dam: base(), add_stiffness(), add_mass(),
   *  2. before the run: delay(), check(), report(), about_steps(),
   *  3. static state: static_springs(), static_base(), and solve_static() for each static step, again
   *     while water enters joints,
   *  4. start of the dynamic analysis: start(), support(), explicit scheme: step_neighbour(), monitor(),
   *  5. time step: advance(), base_velocity(), Integrator::advance(), update_from_dam(),
   *  6. after the time step: energies(), NeighbourMonitor,
   *  7. checkpoint: gather_on_root(), state(); end of the run: add_to_summary(), report_balance(). */
  class Foundation : public FoundationSetup, public BaseSupport, public Neighbour
  {
  };
} // namespace Voussoir

#endif
