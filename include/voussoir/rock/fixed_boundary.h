// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_fixed_boundary_h
#define voussoir_fixed_boundary_h

#include <voussoir/rock/artificial_boundary.h>

namespace Voussoir
{
  /** Fixed boundary: it moves with the free field, or is at rest without one. It reflects all waves
   * of the dam. */
  class FixedBoundary : public ArtificialBoundary
  {
  public:
    bool absorbs() const override { return false; }

    void attach(const RockModel &model, const Vector3 &centre, double dt) override;

    const std::vector<unsigned int> &nodes() const override { return node; }
    const std::vector<unsigned int> &free_field_nodes() const override { return node; }
    unsigned int                     nodes_per_line() const override { return 1; }

    void check_prescribed(const std::vector<unsigned int> &prescribed) const override;

    void start(const RegionStep &step) override { advance(step); }
    void advance(const RegionStep &step) override;

    void keep(const std::vector<bool> &stepped) override { kept = stepped_of(node, stepped); }
    std::vector<unsigned int> kept_points() const override { return kept; }

  private:
    std::vector<unsigned int> node, kept; ///< boundary nodes; kept: indices in node of this process
  };
} // namespace Voussoir

#endif
