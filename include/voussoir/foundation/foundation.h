// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_foundation_h
#define voussoir_foundation_h

#include <voussoir/base/log.h>
#include <voussoir/contact/contact_result.h>
#include <voussoir/dynamics/newmark.h>
#include <voussoir/dynamics/time_grid.h>
#include <voussoir/foundation/foundation_parameters.h>
#include <voussoir/mesh/mesh.h>
#include <voussoir/solid/solid_model.h>

#include <functional>

namespace Voussoir
{
  struct GroundMotion;

  /** Input of the constructors of foundations. */
  struct FoundationSite
  {
    const FoundationParameters &parameters;
    const HexMesh              &mesh;                      ///< of dam and rock
    std::string                 source;                    ///< of the mesh: arch210 or the file name
    unsigned int                degree = 1;                ///< of the elements
    bool                        incompatible_modes = true; ///< in the elements of the dam

    /** true: massless rock forms one body with the dam. This is required if all joints are tied, if the
     * impact rule is not ImpactRule::mean_force, or if contact problems are written. */
    bool one_body = false;
  };

  /** Solves for the static state of the dam under a load [N]. */
  using DamSolve = std::function<ContactResult(const Unknowns &load)>;

  /** Part of a foundation that is known before a run: what it requires of mesh and time step, and its
   * description. */
  class FoundationSetup
  {
  public:
    virtual ~FoundationSetup() = default;

    /** Returns true if the mesh must contain rock. */
    virtual bool uses_rock() const { return false; }

    /** Returns true if a run can be resumed only with the same or a longer ground motion. */
    virtual bool resumes_longer_only() const { return false; }

    /** Writes properties and warnings to the log. */
    virtual void report(Log &, const TimeGrid &) const {}

    /** Returns the time that the ground motion needs to the base of the dam [s]. */
    virtual double delay() const { return 0.; }

    /** Returns the text after "Steps N of DT s" in the log. */
    virtual std::string about_steps() const;

    /** Adds the results of the foundation to summary.json. */
    virtual void add_to_summary(Json &, const TimeGrid &) const {}

    /** Throws InputError if the time integration would be unstable. The second argument is the number of time
     * steps of the dam per sample of the ground motion. */
    virtual void check(const TimeGrid &, unsigned int /*steps_per_sample*/) const {}
  };

  /** Part of a foundation under the base nodes of the dam: stiffness, mass, static state, and the support in
   * a time step. */
  class BaseSupport
  {
  public:
    virtual ~BaseSupport() = default;

    /** Treatment of the base nodes. */
    enum class Base
    {
      fixed,  ///< fixed, without unknowns
      merged, ///< free, one node for all monoliths that meet there
      tied,   ///< free, one node per monolith, joint pairs at the base are tied
      coupled ///< free, one node per monolith, without joint pairs, coupled to the support()
    };
    virtual Base base() const { return Base::fixed; }

    /** Returns true if displacements are relative to the ground and the dam has an inertia load. Returns
     * false if displacements are absolute. */
    virtual bool moves_base() const { return true; }

    /** Adds the stiffness of the foundation to the structure and stores the base nodes. The nodes of the dam
     * are final and treated according to base(). */
    virtual void add_stiffness(const SolidModel &, Structure &) {}

    /** Adds the rock mass of the base nodes to the structure, after the inertia loads were computed. */
    virtual void add_mass(Structure &) const {}

    /** Returns the auxiliary springs at the base nodes in the static solution, three values per node of the
     * dam [N/m], or an empty vector. */
    virtual Unknowns static_springs(const Structure &) const { return {}; }

    /** Returns the base nodes and the static compliance of the foundation without static_springs(). Marks the
     * base nodes as interface nodes of their bodies. Returns nullptr if the static solution does not
     * eliminate the base nodes. */
    virtual std::unique_ptr<BaseElimination::Nodes> static_base(Structure &) const { return nullptr; }

    /** Computes the static state of dam and foundation.
     *
     * @param solve computes the dam on the springs and stores its displacements in @p u
     * @param springs auxiliary springs of static_springs() [N/m]
     * @param u displacements of the dam, three values per node [m]
     * @param load nodal loads of the dam [N]. Forces of the foundation are added.
     * @param log receives the progress
     *
     * Throws ComputationError if dam and foundation do not converge. */
    virtual ContactResult solve_static(const DamSolve &solve, const Unknowns &springs, const Unknowns &u,
                                       Unknowns &load, Log &log);

    /** Returns the strain energy of massless rock in the static state [J], otherwise zero. */
    virtual double strain_at_start() const { return 0.; }

    /** Returns the support of the base nodes, or nullptr. Marks the base nodes as interface nodes of their
     * bodies. Must be called after start(), and before the Newmark object of the dam is created. */
    virtual Support *support(Structure &) { return nullptr; }

    /** Returns the mean predicted velocity of the base nodes at the end of the time step [m/s]. Must be
     * called after Neighbour::advance(). */
    virtual Vector3 base_velocity() const { return {}; }

    /** Returns a second support for the coarse-step comparison run (TimeErrorEstimate), or nullptr. The
     * second argument is the time step of this run [s]. */
    virtual std::unique_ptr<Support> support_of_companion(const Structure &, double /*dt*/) const
    {
      return nullptr;
    }
  };

  /** Upper bounds of the motion of a Neighbour. */
  struct NeighbourBounds
  {
    double velocity = 0., displacement = 0.; ///< of a node in a component [m/s], [m]
    double strain = 0.;                      ///< strain energy of dam and foundation in the static state [J]
  };

  /** Monitor of the instability of a Neighbour, called by StabilityMonitor. */
  class NeighbourMonitor
  {
  public:
    virtual ~NeighbourMonitor() = default;

    /** Number of time steps of the dam between two calls of motion_excess(). */
    static constexpr unsigned int interval = 10;

    /** Stores the bounds at the start of the time loop. @p motion: ground motion, from which bounds of
     * energies follow. */
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

  /** Part of the model beside the dam that exchanges forces with it in time, such as rock. The time loop
   * calls all Dam::neighbours. */
  class Neighbour
  {
  public:
    virtual ~Neighbour() = default;

    /** Prepares the time steps, from rest. The third argument is the static displacement of the dam, three
     * values per node [m]. */
    virtual void start(const GroundMotion &, const TimeGrid &, const Unknowns & /*u*/) {}

    /** Advances the neighbour by one time step and adds its forces to the nodal loads of the dam [N]. */
    virtual void advance(Unknowns &) {}

    /** Updates the base nodes from the state of the dam at the end of the time step. */
    virtual void update_from_dam(const DynamicState &) {}

    /** Returns the wall time of the neighbour in all time steps so far [s]. */
    virtual double seconds() const { return 0.; }

    /** Returns the CPU time of this rank in the same steps, without waiting for messages [s]. */
    virtual double work() const { return 0.; }

    /** Returns the current energies and works [J] with their column names in energy.csv. The names do not
     * change after start(). */
    virtual std::vector<std::pair<std::string, double>> energies() const { return {}; }

    /** Returns the error of the energy balance of the neighbour, relative to its largest energy [-]. */
    virtual double balance_error() const { return 0.; }

    /** Writes balance_error() to the log. */
    virtual void report_balance(Log &) const {}

    /** Returns the arrays of a checkpoint. Must be called after start(). */
    virtual std::vector<std::vector<double> *> state() { return {}; }

    /** Completes state() on the first rank. Must be called by all ranks. */
    virtual void gather_on_root() {}

    /** Returns the monitor of the instability, or nullptr if there is nothing to monitor. Must be called after
     * start(). */
    virtual NeighbourMonitor *monitor() { return nullptr; }
  };

  /** Foundation of the dam. The base class is the rigid foundation with prescribed ground motion.
   * Displacements of the dam are then relative to the ground. Derived classes are other foundations.
   *
   * Order of the calls:
   *  1. assembly of the dam: base(), add_stiffness(), add_mass(),
   *  2. before the run: delay(), check(), report(), about_steps(),
   *  3. static state: static_springs(), static_base(), and solve_static() for each load stage,
   *  4. start of the dynamic analysis: start(), support(), monitor(),
   *  5. time step: advance(), base_velocity(), step of the dam by Newmark, update_from_dam(),
   *  6. after the time step: energies(), NeighbourMonitor. */
  class Foundation : public FoundationSetup, public BaseSupport, public Neighbour
  {
  };
} // namespace Voussoir

#endif
