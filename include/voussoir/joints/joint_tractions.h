// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_joint_tractions_h
#define voussoir_joint_tractions_h

#include <voussoir/solid/structure.h>

namespace Voussoir
{
  class SolidModel;

  /** Tractions of the joints from the joint forces.
   *
   * The normal force of a pair is the work of the pressure p on the shape function of its node: f = M p with
   * the mass matrix M of the joint faces. The quotient f/A with the tributary area A is a mean value. At an
   * edge of the joint it has an error of a third of an element. One correction step p += A^-1 (f - M p) from
   * p = f/A removes most of this error. Shear tractions are not corrected, because they are
   * not smooth enough. */
  class JointTractions
  {
  public:
    /** Computes A^-1 M. @p structure must outlive the object. */
    JointTractions(const SolidModel &model, const Structure &structure);

    /** Returns the traction of side 1 on side 2 at each pair, in the frame of the pair; compression is
     * positive [Pa]. @p force: three values per pair [N]. The correction keeps the sign of a normal
     * traction and at most doubles it, so that a force of the size of round-off has no effect. */
    std::vector<Vector3> at(const Unknowns &force) const
    {
      std::vector<Vector3> result;
      find<double>([&](const std::size_t k) { return force[k]; }, result);
      return result;
    }

    /** at() for doubles, or for vectors of numbers. @p force: function of the index of a component. */
    template <class Scalar, class Force, class T>
    void find(const Force &force, std::vector<std::array<T, 3>> &traction) const
    {
      const T        zero = {};
      std::vector<T> first(structure.pairs.size()); // uncorrected normal tractions [Pa]
      traction.resize(first.size());
      for (std::size_t p = 0; p < first.size(); ++p)
        for (unsigned int c = 0; c < 3; ++c)
          traction[p][c] = force(3 * p + c) / static_cast<Scalar>(structure.pairs[p].area);
      for (std::size_t p = 0; p < first.size(); ++p)
        first[p] = traction[p][0];
      for (std::size_t p = 0; p < first.size(); ++p)
      {
        const T twice = first[p] + first[p], low = twice < zero ? twice : zero,
                high = twice < zero ? zero : twice;
        T corrected = twice;
        for (const auto &[other, factor] : mean[p])
          corrected -= static_cast<Scalar>(factor) * first[other];
        corrected = corrected < low ? low : corrected;
        traction[p][0] = corrected > high ? high : corrected;
      }
    }

  private:
    const Structure                                          &structure;
    std::vector<std::vector<std::pair<unsigned int, double>>> mean; ///< rows of A^-1 M: pair, factor
  };
} // namespace Voussoir

#endif
