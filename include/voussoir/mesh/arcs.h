// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_arcs_h
#define voussoir_arcs_h

#include <voussoir/mesh/arch_grid.h>

#include <memory>

namespace Voussoir
{
  /** Parameters of a dam from a table of arcs, subsection "Mesh/Arcs". */
  struct ArcsParameters
  {
    std::string table = "";        ///< CSV file, relative to the directory of the input file
    std::string kind = "circular"; ///< of the arcs: arc_kinds()
    ArchGrid    grid;

    ArcsParameters();

    void add_parameters(Entries &prm);

    /** Throws InputError if the table is missing, or if the rows are not usable. */
    void check() const;

    /** Reads the table. @p directory: that of the input file. Throws InputError like read_arch_table(). */
    std::unique_ptr<ArchShape> shape(const std::string &directory) const;

    /** Returns the mesh that the entries describe: with the numbers of joints and rows that the lists have. */
    ArchGrid complete_grid() const;
  };
} // namespace Voussoir

#endif
