// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_boundary_table_h
#define voussoir_boundary_table_h

#include <voussoir/rock/artificial_boundary.h>

namespace Voussoir
{
  /** Type of artificial boundary that an input file can choose. */
  struct BoundaryRow
  {
    std::string name;                              ///< value of "Foundation/Boundary"
    std::string doc;                               ///< description for help texts, without a full stop
    std::unique_ptr<ArtificialBoundary> (*make)(); ///< creates a boundary that is not attached
  };

  /** Returns all types of artificial boundary. */
  const std::vector<BoundaryRow> &boundary_table();

  /** Returns the names of all boundaries, separated by @p between, in the order of the table. */
  std::string boundary_names(const std::string &between);

  /** Returns the names with their descriptions, for help texts. */
  std::string boundary_help();

  /** Creates the boundary @p name. Throws InputError with the list of names if there is none. */
  std::unique_ptr<ArtificialBoundary> make_boundary(const std::string &name);

  /** Returns two proven boundaries other than @p name as advice, such as "mtf2 or viscous-spring". */
  std::string other_boundaries(const std::string &name);
} // namespace Voussoir

#endif
