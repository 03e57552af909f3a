// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_support_h
#define voussoir_support_h

#include <voussoir/joints/foot_elimination.h>

namespace Voussoir
{
  /** What a dam's feet stand on when that makes steps of its own, several in each of the dam: the forces
   * between them are constant during a step of the dam, and such that the feet are where the support is at
   * its end. So the coupling neither gives nor takes energy, whatever the steps: the work of these forces is
   * the same on both sides (Gravouil and Combescure's macro-scale link, in displacements). */
  class Support
  {
  public:
    virtual ~Support() = default;

    /** Nodes of the dam that stand on it, ascending. */
    virtual const std::vector<unsigned int> &feet() const = 0;

    virtual unsigned int n_substeps() const = 0; ///< of its own in a whole step of the dam

    /** Displacement of the feet after @p n own steps for unit forces held at the feet [m/N]. */
    virtual BlockSparseMatrix compliance(unsigned int n) const = 0;

    /** Displacement of the feet, which are @p at now, after the next @p n own steps without forces [m];
     * nothing moves. */
    virtual Unknowns predict(unsigned int n, const Unknowns &at) = 0;

    /** Makes the @p n own steps of the last predict(); @p force: held, on the dam's feet [N]; @p place: where
     * they are after that [m]; @p work: what that did on the dam [J]. */
    virtual void push(unsigned int n, const Unknowns &force, const Unknowns &place, double work) = 0;
  };
} // namespace Voussoir

#endif
