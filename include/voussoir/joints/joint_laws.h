// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_joint_laws_h
#define voussoir_joint_laws_h

#include <voussoir/contact/law_table.h>
#include <voussoir/solid/structure.h>

namespace Voussoir
{
  /** Energy in joints [J]. */
  struct JointEnergy
  {
    double stored = 0.;   ///< energy of the flank contacts of shear keys
    double fracture = 0.; ///< energy of bonds, current and lost
  };

  /** Joint laws of all pairs of a structure, and the position of their history variables in one array. */
  struct PairLaws
  {
    std::vector<const JointLaw *> of_pair; ///< law of each pair

    /** Returns the initial history variables of all pairs, pair after pair. */
    Unknowns initial_memory() const { return Unknowns(n_memory(), 0.); }
    bool     have_memory() const { return n_memory() > 0; } ///< true if a law has history variables
    bool     need_mean_force() const; ///< true if a law has JointLaw::needs_mean_force()

    /** Returns the data of each pair for its law. The result points into @p memory.
     * @param start gap at the start of the step, three values per pair [m]
     * @param is_mean true: forces are means over the step; false: forces at its end
     * @param memory history variables of all pairs */
    std::vector<PairHistory> histories(const Unknowns &start, bool is_mean, const Unknowns &memory) const;

    /** Applies crack events to the pairs with the highest utilisation above 1: all pairs within a tenth of
     * the largest one. Other pairs may be relieved by these events. Sets the history variables in @p memory
     * and the forces of these pairs to 0, as a first guess. Returns the number of events. */
    unsigned int revise(const Unknowns &start, bool is_mean, const Unknowns &gap, Unknowns &force,
                        Unknowns &memory) const;

    /** Updates the history variables @p memory for an accepted step. @p start: gap at the start of the step,
     * three values per pair [m]. */
    void commit(const Unknowns &start, bool is_mean, const Unknowns &force, const Unknowns &gap,
                Unknowns &memory) const;

    /** Returns the energy in the joints [J]. @p gap: three values per pair [m]. */
    JointEnergy joint_energy(const Unknowns &gap, const Unknowns &memory) const;

    bool have_seats() const { return have_memory_with(true); } ///< true if JointEnergy::stored can be nonzero
    /** Returns true if JointEnergy::fracture can be nonzero. */
    bool have_bonds() const { return have_memory_with(false); }

    /** Returns the sum of SurfacesLaw::friction_correction() over all pairs in a step with mean forces [J]; 0
     * for forces at the end of a step. @p memory: history variables before commit(). */
    double friction_correction(const Unknowns &start, bool is_mean, const Unknowns &force,
                               const Unknowns &gap, const Unknowns &memory) const;

    /** Appends a pair with its law and tributary area [m^2]. */
    void add(const JointLaw *law, double tributary_area);

  private:
    bool        have_memory_with(bool surfaces) const;
    std::size_t n_memory() const { return memory_end.empty() ? 0 : memory_end.back(); }
    std::size_t memory_begin(const std::size_t pair) const { return pair == 0 ? 0 : memory_end[pair - 1]; }

    std::vector<double>      area;       ///< tributary area of each pair [m^2]
    std::vector<std::size_t> memory_end; ///< end of the history variables of each pair
  };

  /** Joint laws of a structure, with ownership: one law per joint, and one per pair on an edge. */
  struct JointLaws : PairLaws
  {
    std::vector<std::unique_ptr<JointLaw>> of_joint; ///< one per joint
    std::vector<std::unique_ptr<JointLaw>> of_edges; ///< one per pair on an edge

    /** Assigns the law of its joint to each pair. A pair on an edge of a joint with Coulomb friction (FJA)
     * gets a law with friction on all its planes. Other laws do not support edges. */
    void assign(const std::vector<Pair> &pairs);
  };
} // namespace Voussoir

#endif
