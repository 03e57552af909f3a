// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_support_h
#define voussoir_support_h

#include <voussoir/joints/base_elimination.h>

namespace Voussoir
{
  /** Compliant foundation under the base nodes: massless rock, or rock with smaller time steps than the dam
   * (subcycling). Coupling forces act between dam and support. They are constant during a step of the dam and
   * make the displacements of both equal at the end of the step.
   *
   * The work of these forces is the same on both sides, so the coupling conserves energy for any number of
   * substeps (macro-scale link of Gravouil and Combescure, in displacements).
   *
   * A full time step of the dam has n_substeps() substeps, a reduced time step fewer. Newmark calls
   * predict(), solves for dam and coupling forces, then calls advance(). */
  class Support
  {
  public:
    virtual ~Support() = default;

    /** Returns the equation numbers of the dam nodes on the support, ascending. All vectors below have three
     * values x, y, z per entry. Displacements are those of the dam: they include the static ones. */
    virtual const std::vector<unsigned int> &base_nodes() const = 0;

    /** Returns the number of substeps in a full time step of the dam. */
    virtual unsigned int n_substeps() const = 0;

    /** Returns the compliance matrix: displacements of the base nodes after @p n substeps from rest, for
     * constant unit forces on them, with one block row per entry of base_nodes() [m/N]. @p n: 1 to
     * n_substeps(). */
    virtual BlockSparseMatrix compliance(unsigned int n) const = 0;

    /** Returns the displacement of the base nodes after the next @p n substeps without coupling forces [m].
     * @p time: time at the start of the step [s]; @p at: displacement of the base nodes at the start of the step
     * [m]. The support does not advance. Must be called by all ranks. */
    virtual Unknowns predict(unsigned int n, double time, const Unknowns &at) = 0;

    /** Advances the support by the @p n substeps of the last predict(). Must be called by all ranks.
     * @param n number of substeps
     * @param force constant coupling forces on the base nodes of the dam [N]; the support has the opposite
     * @param place displacement of the base nodes at the end of the step [m]
     * @param work work of these forces on the dam [J] */
    virtual void advance(unsigned int n, const Unknowns &force, const Unknowns &place, double work) = 0;
  };

  /** Part of the model next to the dam that takes the steps of an explicit scheme together with it (Leapfrog), in which
   * Neighbour::advance() must add nothing. Vectors have three values per node of the dam. */
  class StepNeighbour
  {
  public:
    virtual ~StepNeighbour() = default;

    /** Adds the forces on the dam at the present time to @p load [N]. */
    virtual void add_forces(Unknowns &load) const = 0;

    /** Advances by a step of the scheme. @p u: displacement of the dam at the end of the step [m], @p w: velocity in
     * the step [m/s]. */
    virtual void advance(const Unknowns &u, const Unknowns &w) = 0;

    /** Returns the change of the strain energy since the start at the middle of the last step [J]. A neighbour with its
     * own energy balance returns zero. */
    virtual double strain() const { return 0.; }
  };
} // namespace Voussoir

#endif
