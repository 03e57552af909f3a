// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/rock/fixed_boundary.h>

namespace Voussoir
{
  void FixedBoundary::attach(const RockModel &model, const Vector3 &, double)
  {
    for (const BoundaryLine &line : model.lines)
      node.push_back(line.nodes[0]);
    kept = all_of(node.size());
  }

  void FixedBoundary::check_prescribed(const std::vector<unsigned int> &prescribed) const
  {
    check_apart(node, prescribed, 1);
  }

  void FixedBoundary::advance(const RegionStep &step)
  {
    for (const std::size_t i : kept)
      for (unsigned int c = 0; c < 3; ++c)
      {
        const std::size_t k = 3 * std::size_t(node[i]) + c;
        const double      next = step.field_next.empty() ? 0. : step.field_next[3 * i + c];
        step.w[k] = (next - step.u[k]) / step.dt;
      }
    if (!step.K_u.empty())
      add_work_of_motion(step, node, kept, step.w_before, gone_through_boundary, -1.);
  }
} // namespace Voussoir
