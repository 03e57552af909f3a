// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_joint_laws_h
#define voussoir_joint_laws_h

#include <voussoir/contact/contact_operator.h>
#include <voussoir/solid/structure.h>

namespace Voussoir
{
  /** Energies of all joints [J]. */
  struct JointEnergy
  {
    double stored = 0.;   ///< ElasticLaw::stored_energy(), and JointLaw::bond_energy() of laws with several
                          ///< surfaces, such as shear keys [J]
    double fracture = 0.; ///< JointLaw::bond_energy(): stored and dissipated by bonds [J]
  };

  /** Joint laws of all pairs of a structure, and the position of their history variables in one array.
   *
   * Arguments of the functions, pair after pair:
   * - start: gap at the start of the step, three values per pair [m],
   * - is_mean: true: forces are means over the step; false: forces at its end,
   * - force, gap: force [N] and gap [m] of the solution, three values per pair,
   * - memory: history variables of all pairs, JointLaw::n_memory() values per pair. */
  struct PairLaws
  {
    std::vector<const JointLaw *> of_pair; ///< law of each pair

    /** Returns the initial history variables of all pairs: zeros. */
    Unknowns initial_memory() const { return Unknowns(n_memory(), 0.); }

    /** Returns true if any law has history variables. */
    bool have_memory() const { return n_memory() > 0; }

    /** Returns true if any law requires mean forces (JointLaw::needs_mean_force()). */
    bool need_mean_force() const;

    /** Returns the data of each pair for its law. The result points into @p memory. */
    std::vector<PairHistory> histories(const Unknowns &start, bool is_mean, const Unknowns &memory) const;

    /** Applies events (JointLaw::apply_event()) to the pairs with the highest utilisation: all pairs above 1
     * and above 0.9 of the largest value. These events may relieve the other pairs. Changes the history
     * variables of these pairs, and sets their forces to 0 as a first guess. Returns the number of events.
     *
     * In a time step a crack that softens faster than its pair relaxes loses its bond at once (JointEvent::cut). With
     * its softening, the step would have several solutions. @p W: operator of the step, for the flexibility of the
     * pairs. */
    unsigned int revise(const ContactOperator &W, const Unknowns &start, bool is_mean, const Unknowns &gap,
                        Unknowns &force, Unknowns &memory) const;

    /** Restores the bond of a pair, or removes it (JointEvent::cut). */
    void restore_bond(std::size_t pair, Unknowns &memory) const;
    void lose_bond(std::size_t pair, Unknowns &memory) const;

    /** Updates the history variables after a step is accepted. */
    void commit(const Unknowns &start, bool is_mean, const Unknowns &force, const Unknowns &gap,
                Unknowns &memory) const;

    /** Returns the energies of the joints for gaps and history variables at the same time [J]. */
    JointEnergy joint_energy(const Unknowns &gap, const Unknowns &memory) const;

    /** Returns true if JointEnergy::stored can be nonzero: a law is elastic, or has elastic key flanks. */
    bool have_seats() const;

    /** Returns true if JointEnergy::fracture can be nonzero: a law has a bond. */
    bool have_bonds() const;

    /** Returns the sum of friction_correction() of SurfacesLaw and ElasticLaw over all pairs [J]; 0 if @p is_mean is
     * false.
     * @p memory: history variables before commit(). */
    double friction_correction(const Unknowns &start, bool is_mean, const Unknowns &force,
                               const Unknowns &gap, const Unknowns &memory) const;

    /** Appends a pair.
     * @param law joint law; must outlive the object
     * @param tributary_area tributary area [m^2] */
    void add(const JointLaw *law, double tributary_area);

    /** Returns the first history variable of a pair. The law of a pair may be replaced by one with fewer variables. */
    std::size_t memory_begin(const std::size_t pair) const { return pair == 0 ? 0 : memory_end[pair - 1]; }

  private:
    std::size_t n_memory() const { return memory_end.empty() ? 0 : memory_end.back(); }

    std::vector<double>      area;       ///< tributary area of each pair [m^2]
    std::vector<std::size_t> memory_end; ///< end of the history variables of each pair
  };

  /** Joint laws of a structure, with ownership of the laws. */
  struct JointLaws : PairLaws
  {
    std::vector<std::unique_ptr<JointLaw>> of_joint; ///< law of each joint
    std::vector<std::unique_ptr<JointLaw>> of_edges; ///< law of each pair on an edge, see assign()

    /** Law of the pairs of each joint that share nodes with other pairs; empty or null: of_joint. */
    std::vector<std::unique_ptr<JointLaw>> of_crossings;

    /** Appends all pairs of a structure, with the law of their joint. A pair that shares nodes with other pairs has
     * the law of #of_crossings. A pair on an edge of a joint with Coulomb friction (FJA) has an own law, with friction
     * on all its planes (Pair::planes). Other laws treat edges as flat. */
    void assign(const Structure &structure);
  };
} // namespace Voussoir

#endif
