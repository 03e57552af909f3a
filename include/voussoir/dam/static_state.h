// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_static_state_h
#define voussoir_static_state_h

#include <voussoir/base/log.h>
#include <voussoir/contact/contact_parameters.h>
#include <voussoir/contact/contact_result.h>
#include <voussoir/contact/joint_law.h>
#include <voussoir/dam/dam.h>

#include <functional>

namespace Voussoir
{
  /** End of a step of the static load history: a row of stages.csv. */
  struct StaticStep
  {
    unsigned int stage = 1;                         ///< number of the stage, from 1
    double       share = 1.;                        ///< of the loads of the stage that are applied, up to 1
    double       level = 0.;                        ///< of the reservoir [m]
    Vector3      crown{};                           ///< displacement of the crest against the base [m]
    unsigned int n_open = 0, n_slip = 0, n_wet = 0; ///< pairs: open, slipping, under water pressure
    double       opening = 0.;                      ///< largest, of joints that are grouted [m]
  };

  /** Static state: the equilibrium of dam, joints and foundation under the static loads, from which the
   * dynamic analysis starts. Its stiffness K_s has the sustained moduli (Dam::sustained_structure()), and that
   * of the dynamic analysis, K, acts on the increment of the displacement: K_s u_s + K (u - u_s). */
  struct StaticState
  {
    Unknowns                u;           ///< displacement, 3 per node [m]
    Unknowns                force;       ///< of the joints, 3 per pair [N]
    Unknowns                load;        ///< of all static loads, 3 per node [N]
    Unknowns                memory;      ///< history variables of the joint laws
    Unknowns                closed;      ///< jumps at which the pairs are closed, 3 per pair [m]
    std::vector<double>     removed;     ///< width of initial gap and cuts of each pair [m]
    std::vector<double>     joint_water; ///< pressure in each pair [Pa], or empty
    std::vector<PairState>  pairs;
    ContactResult           contact; ///< sum over all steps
    unsigned int            n_open = 0;
    Vector3                 crown{}; ///< displacement of the crest against the base [m]
    std::vector<StaticStep> steps;

    /** Force (K - K_s) u_s, a constant load of the dynamic analysis, three values per node [N]. Empty without
     * sustained moduli. */
    Unknowns modulus_force;
    double   modulus_share = 0.; ///< 1 - sustained modulus / Young's modulus of the concrete [-]

    /** Returns the loads of the dynamic analysis without inertia: load + modulus_force [N]. */
    Unknowns constant_load() const;

    /** Returns the displacement for which the dynamic moduli of the concrete give the stresses of the
     * displacement @p total: total - modulus_share u. Three values per node [m]. */
    Unknowns elastic(const Unknowns &total) const;
  };

  /** Computes the static state along StaticPath. A step is solved again until water spreads to no further
   * pair.
   *
   * @param dam dam with its foundation
   * @param parameters of the contact solver. Problems are written from full grouting on.
   * @param log receives one line per stage and one line with the result
   * @param stop_if_asked called before each solution. An exception ends the computation.
   *
   * Throws ComputationError if the joints do not converge. Throws InputError for an implausible state: the
   * crest displacement exceeds 1/100 of the size of the dam, or that of a joint exceeds largest_joint_share
   * of it. */
  StaticState static_state(Dam &dam, const ContactParameters &parameters, Log &log,
                           const std::function<void()> &stop_if_asked);

  /** Largest plausible joint displacement, relative to the size of the dam [-]. */
  constexpr double largest_joint_share = .02;
} // namespace Voussoir

#endif
