// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_support_h
#define voussoir_support_h

#include <voussoir/joints/base_elimination.h>

namespace Voussoir
{
  /** Foundation under the base nodes that is integrated with smaller time steps (subcycling), or that is
   * massless. The coupling forces are constant during a step of the dam. They are chosen such that the base
   * nodes and the support have equal displacements at the end of the step.
   *
   * The work of these forces is the same on both sides, so the coupling conserves energy for any number of
   * substeps (macro-scale link of Gravouil and Combescure, in displacements).
   *
   * Each step calls predict(), then advances the dam, then calls advance(). */
  class Support
  {
  public:
    virtual ~Support() = default;

    /** Returns the base nodes of the dam on the support, ascending. */
    virtual const std::vector<unsigned int> &base_nodes() const = 0;

    virtual unsigned int n_substeps() const = 0; ///< returns the number of substeps in a full step of the dam

    /** Returns the displacement of the base nodes after @p n substeps for constant unit forces
     * on them [m/N]. */
    virtual BlockSparseMatrix compliance(unsigned int n) const = 0;

    /** Returns the displacement of the base nodes after the next @p n substeps without coupling forces [m].
     * @p at: current displacement of the base nodes [m]. The support does not advance. */
    virtual Unknowns predict(unsigned int n, const Unknowns &at) = 0;

    /** Advances the support by the @p n substeps of the last predict().
     * @param n number of substeps
     * @param force constant coupling forces, on the base nodes of the dam, three values each [N]
     * @param place displacement of the base nodes at the end of the step [m]
     * @param work work of these forces on the dam [J] */
    virtual void advance(unsigned int n, const Unknowns &force, const Unknowns &place, double work) = 0;
  };
} // namespace Voussoir

#endif
