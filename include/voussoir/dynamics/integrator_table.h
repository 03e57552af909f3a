// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_integrator_table_h
#define voussoir_integrator_table_h

#include <voussoir/dynamics/impact.h>
#include <voussoir/dynamics/integrator.h>
#include <voussoir/dynamics/support.h>

namespace Voussoir
{
  /** What an integrator is made from. Structure, laws and support must outlive it. */
  struct IntegratorInput
  {
    const Structure             &structure;
    const JointLaws             &laws;
    ContactParameters            contact;                       ///< parameters of the contact solver
    double                       dt = 0.;                       ///< time step [s]
    ImpactRule                   rule = ImpactRule::mean_force; ///< velocity correction of closed pairs
    Support                     *support = nullptr;      ///< subcycled or massless foundation, or nullptr
    bool                         single_factors = false; ///< factors in single precision
    unsigned int                 n_steps = 1;            ///< steps of the explicit scheme in a time step
    std::vector<StepNeighbour *> neighbours = {};        ///< take these steps, too
  };

  /** A time scheme that an input file can choose. */
  struct IntegratorRow
  {
    const char *name;
    const char *doc;
    std::unique_ptr<Integrator> (*make)(const IntegratorInput &input);
  };

  /** Returns all time schemes. */
  const std::vector<IntegratorRow> &integrator_table();
  std::string                       integrator_names(); ///< separated by |
  std::string                       integrator_docs();  ///< names and docs, separated by semicolons

  /** Makes the integrator of the scheme @p name. Errors: those of its constructor. */
  std::unique_ptr<Integrator> make_integrator(const std::string &name, const IntegratorInput &input);
} // namespace Voussoir

#endif
