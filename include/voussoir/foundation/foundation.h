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

  /** Where a foundation is made. */
  struct FoundationSite
  {
    const FoundationParameters &parameters;
    const HexMesh              &mesh;   ///< of dam and rock
    std::string                 source; ///< of the mesh: arch210, or its file
    unsigned int                degree = 1;
    bool                        incompatible_modes = true;
    bool one_body = false; ///< no joint opens, or the operator of the joints is asked for without a support
  };

  /** What no earthquake does to the ground, see StabilityWatch. */
  struct WatchBounds
  {
    double velocity = 0., displacement = 0.; ///< [m/s], [m]
    double strain = 0.;                      ///< energy of the dam's static state [J]
  };

  /** The static state of the dam under a load [N]. */
  using DamSolve = std::function<ContactResult(const Unknowns &load)>;

  /** What the dam stands on. This class itself is the rigid ground, which moves as the ground motion says:
   * displacements of the dam are relative to it. Others override what they do in another way; who runs the
   * dam does not ask which one it has. */
  class Foundation
  {
  public:
    virtual ~Foundation() = default;

    /** What becomes of the nodes of the dam's base: held, without unknowns; shared by the monoliths that meet
     * there; free, with the pairs of joints there tied; or led by the foundation, each by itself. */
    enum class Base
    {
      held,
      shared,
      tied,
      led
    };
    virtual Base base() const { return Base::held; }
    virtual bool uses_rock() const { return false; } ///< does it need the rock of the mesh?
    virtual bool moves_base() const
    {
      return true;
    } ///< else displacements are absolute, the dam has no inertia load
    virtual bool resumes_longer_only() const { return false; } ///< what a checkpoint's motion may become

    /** Before anything else; @p dam: its final nodes, the base as base() says. */
    virtual void add_stiffness(const SolidModel &, Structure &) {}
    virtual void add_mass(Structure &) const {} ///< the rock's at the base; after the inertia loads

    virtual void   report(Log &, const TimeGrid &) const {} ///< what it is, and warnings
    virtual double delay() const { return 0.; } ///< with which the ground motion is at the dam's base [s]
    virtual std::string about_steps() const;    ///< what follows "Steps N of DT s" in the log
    virtual void        add_to_summary(Json &, const TimeGrid &) const {}

    /** InputError for what would become unstable with these steps, of which there are that many of the dam in
     * a sample of the motion. */
    virtual void check(const TimeGrid &, unsigned int /*steps_per_sample*/) const {}

    /** Springs between dam and foundation for the static iteration, per component of the dam [N/m], or empty.
     */
    virtual Unknowns static_springs(const Structure &) const { return {}; }

    /** What the feet, with these springs, stand on where it gives way at once (compliance for forces), or
     * null; marks them as interface of their bodies. */
    virtual std::unique_ptr<FootElimination::Feet> static_feet(Structure &) const { return nullptr; }

    /** The static state: calls @p solve, which leaves the dam's displacement in @p u, on the @p springs,
     * until the foundation follows; adds the foundation's forces to @p load [N]. */
    virtual ContactResult settle(const DamSolve &solve, const Unknowns &springs, const Unknowns &u,
                                 Unknowns &load, Log &log);

    /** Add the mass to the feet that substeps need; to be done before the dam's Newmark is made. Returns that
     * mass [kg]. */
    virtual double add_interface_mass(Structure &, const TimeGrid &) const { return 0.; }

    /** What leads the dam's base, or null; marks its feet as interface of their bodies. To be done before the
     * dam's Newmark is made, after start(). */
    virtual Support *support(Structure &) { return nullptr; }

    /** Another one, for steps of the size @p dt [s]; or null. */
    virtual std::unique_ptr<Support> support_of_companion(const Structure &, double /*dt*/) const
    {
      return nullptr;
    }

    /** Make ready for these steps from the static displacement of the dam, at rest. */
    virtual void start(const GroundMotion &, const TimeGrid &, const Unknowns & /*u*/) {}

    virtual void advance(Unknowns &) {} ///< its part of the next step; adds its forces to the load [N]
    virtual void follow(const DynamicState &) {} ///< the dam has made its step

    /** Mean velocity of the feet as predicted for the end of the step, after advance() [m/s]. */
    virtual Vector3 base_velocity() const { return {}; }
    /** Strain energy at the start of what moves with the dam at once [J]. */
    virtual double strain_at_start() const { return 0.; }

    virtual double seconds() const { return 0.; } ///< of wall time in advance()
    virtual double work() const { return 0.; }    ///< of processor time there, but for messages [s]

    /** Its energies and works now [J], with the names of their columns in energy.csv; after start() always
     * the same names. */
    virtual std::vector<std::pair<std::string, double>> energies() const { return {}; }
    virtual double balance_error() const { return 0.; } ///< of its energies, over the largest
    virtual void   report_balance(Log &) const {}

    virtual std::vector<std::vector<double> *> state() { return {}; } ///< for checkpoints, after start()

    /** With several ranks, by all: the first one's state() is the whole one after that. */
    virtual void collect() {}

    /** For StabilityWatch: bounds, what is wrong now (or empty), and what may help (empty: nothing of its
     * own). */
    virtual void        watch(const GroundMotion &, const WatchBounds &) {}
    virtual std::string trouble_of_energy() const { return {}; }
    virtual std::string trouble_of_motion() const { return {}; }
    virtual std::string remedies() const { return {}; }
  };
} // namespace Voussoir

#endif
