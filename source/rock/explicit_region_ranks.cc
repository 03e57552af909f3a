// SPDX-License-Identifier: GPL-3.0-or-later
// ExplicitRegion distributed over several MPI processes.

#include <voussoir/base/excess.h>
#include <voussoir/rock/explicit_region.h>

#include <algorithm>

namespace Voussoir
{
  void ExplicitRegion::split_up(RockSplit given, RockOperator part)
  {
    split = std::move(given);
    stiffness = std::move(part);
    pieces = split.pieces(n_nodes());
    if (!boundary)
      return;
    boundary->keep(split.stepped());
    boundary_kept = stepped_of(boundary->nodes(), split.stepped());
  }

  bool ExplicitRegion::exceeds(const double velocity, const double displacement) const
  {
    return std::any_of(pieces.begin(), pieces.end(),
                       [&](const std::pair<int, int> &piece)
                       {
                         const std::size_t first = 3 * std::size_t(piece.first),
                                           n = 3 * std::size_t(piece.second - piece.first);
                         return count_excess(w.data() + first, n, velocity) > 0 ||
                                count_excess(u.data() + first, n, displacement) > 0;
                       });
  }

  void ExplicitRegion::gather_energy()
  {
    split.gather_chunks(account, n_energies + n_region_works);
  }

  void ExplicitRegion::gather_motion()
  {
    split.gather(u, 3);
    split.gather(w, 3);
  }

  void ExplicitRegion::gather_on_root()
  {
    if (!is_split())
      return;
    gather_motion();
    split.gather(K_x, 3);
    split.gather(K_u, 3);
    for (auto *values : damped.state())
      split.gather(*values, 3);
    split.gather_chunks(work, n_region_works);
    if (free_field)
      free_field->gather_on_root();
    if (!boundary)
      return;
    split.gather(boundary_w, 3, boundary->nodes());
    const std::vector<unsigned int> node = boundary->nodes_of_points();
    for (Unknowns *values : {&field, &field_before, &field_next})
      split.gather(*values, 3, node);
    for (auto *values : boundary->state())
      if (values->size() == 3 * node.size())
        split.gather(*values, 3, node);
  }
} // namespace Voussoir
