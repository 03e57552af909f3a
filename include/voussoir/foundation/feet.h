// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_feet_h
#define voussoir_feet_h

#include <voussoir/solid/solid_model.h>

namespace Voussoir
{
  /** One foot of the dam: a node of the rock and the free nodes of the dam that stand on it. */
  struct Foot
  {
    unsigned int              rock;
    std::vector<unsigned int> nodes; ///< equations of the dam
  };

  /** The feet of the dam on the rock nodes at @p points; @p source names the mesh. Throws InputError where a
   * node of the dam's base has no rock. */
  std::vector<Foot> find_feet(const SolidModel &dam, const std::vector<std::array<double, 3>> &points,
                              const std::string &source);

  /** The nodes of the dam that stand on feet, ascending, and the foot below each. */
  struct StandingNodes
  {
    StandingNodes() = default;
    explicit StandingNodes(const std::vector<Foot> &feet);

    /** They become interface nodes of their bodies, if they were none. */
    void mark(Structure &structure) const;

    /** A matrix of the feet for them: those on one foot have the same rows and columns. */
    BlockSparseMatrix matrix(const BlockSparseMatrix &of_feet) const;

    std::vector<unsigned int> node, foot;
  };
} // namespace Voussoir

#endif
