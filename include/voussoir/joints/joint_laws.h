// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_joint_laws_h
#define voussoir_joint_laws_h

#include <voussoir/contact/law_table.h>
#include <voussoir/solid/structure.h>

namespace Voussoir
{
  /** What the force of a pair is in a linear system: factor times the force at the end of the step, or its
   * mean over the step. */
  struct ForceMeaning
  {
    double factor = 1.;
    bool   is_mean = false;
  };

  /** Energy in joints [J]. */
  struct JointEnergy
  {
    double stored = 0.;   ///< that the seats of keys hold
    double fracture = 0.; ///< that bonds hold and have lost
  };

  /** The laws of all pairs of a structure, and where their memories lie in one array. */
  struct PairLaws
  {
    std::vector<const JointLaw *> of_pair;

    /** Memory of all pairs, one after the other, before anything has happened. */
    Unknowns initial_memory() const { return Unknowns(n_memory(), 0.); }
    bool     have_memory() const { return n_memory() > 0; }
    bool     need_mean_force() const; ///< does any: see JointLaw::needs_mean_force()

    /** What each law is told of its pair; points into @p memory. @p start: 3 per pair [m]. */
    std::vector<PairPast> pasts(const Unknowns &start, const ForceMeaning &meaning,
                                const Unknowns &memory) const;

    /** Releases the pairs that a solution asks most of, within a tenth of the worst, since others may then be
     * relieved: the events go into @p memory, and the forces become 0, a guess for the next. How many. */
    unsigned int revise(const Unknowns &start, const ForceMeaning &meaning, const Unknowns &gap,
                        Unknowns &force, Unknowns &memory) const;

    /** The step from @p start with this solution is accepted. */
    void commit(const Unknowns &start, const ForceMeaning &meaning, const Unknowns &force,
                const Unknowns &gap, Unknowns &memory) const;

    /** Returns the energy in the joints; @p gap: 3 per pair [m]. */
    JointEnergy joint_energy(const Unknowns &gap, const Unknowns &memory) const;

    bool have_seats() const { return have_memory_with(true); } ///< can JointEnergy::stored be other than 0?
    bool have_bonds() const
    {
      return have_memory_with(false);
    } ///< can JointEnergy::fracture be other than 0?

    /** Returns the sum of SurfacesLaw::friction_correction() over a step of mean forces [J]; 0 where forces
     * are those at the end of a step. @p memory: before commit(). */
    double friction_correction(const Unknowns &start, const ForceMeaning &meaning, const Unknowns &force,
                               const Unknowns &gap, const Unknowns &memory) const;

    void add(const JointLaw *law, double tributary_area);

  private:
    bool        have_memory_with(bool surfaces) const;
    std::size_t n_memory() const { return memory_end.empty() ? 0 : memory_end.back(); }
    std::size_t memory_begin(const std::size_t pair) const { return pair == 0 ? 0 : memory_end[pair - 1]; }

    std::vector<double>      area;       ///< tributary, of each pair [m^2]
    std::vector<std::size_t> memory_end; ///< of each pair
  };

  /** The joint laws of a structure, owned once per joint, but for the pairs on edges. */
  struct JointLaws : PairLaws
  {
    std::vector<std::unique_ptr<JointLaw>> of_joint;
    std::vector<std::unique_ptr<JointLaw>> of_edges; ///< of single pairs

    /** Gives every pair the law of its joint. A pair on an edge of a joint with Coulomb friction (FJA)
     * touches on all its planes, with that friction; the other laws do not know edges. */
    void assign(const std::vector<Pair> &pairs);
  };
} // namespace Voussoir

#endif
