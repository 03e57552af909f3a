// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_boundary_table_h
#define voussoir_boundary_table_h

#include <voussoir/rock/artificial_boundary.h>

namespace Voussoir
{
  /** What a scene can choose as artificial boundary. */
  struct BoundaryRow
  {
    std::string name;
    std::string doc; ///< what it is, for help texts: half a sentence
    std::unique_ptr<ArtificialBoundary> (*make)();
  };

  const std::vector<BoundaryRow> &boundary_table();

  /** The names between a sign, in the order of the table. */
  std::string boundary_names(const std::string &between);

  /** Names and what they mean, for help texts. */
  std::string boundary_help();

  /** InputError, which lists the names, if there is none of that name. */
  std::unique_ptr<ArtificialBoundary> make_boundary(const std::string &name);

  /** Two of the well-tried boundaries but @p name, as advice: "mtf2 or viscous-spring". */
  std::string other_boundaries(const std::string &name);
} // namespace Voussoir

#endif
