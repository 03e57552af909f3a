// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/entries.h>
#include <voussoir/base/error.h>
#include <voussoir/base/number_text.h>
#include <voussoir/mesh/arch_table.h>
#include <voussoir/mesh/arcs.h>

#include <filesystem>

namespace Voussoir
{
  ArcsParameters::ArcsParameters()
  {
    grid.n_joints = 10;
    grid.elements_along = 40;
    grid.elements_up = 10;
  }

  void ArcsParameters::add_parameters(Entries &prm)
  {
    using namespace dealii::Patterns;
    prm.enter_subsection("Mesh");
    prm.enter_subsection("Arcs");
    prm.add_parameter(
        "Table", table,
        "Table of arcs (CSV), relative to the directory of the input file. The first line names the "
        "columns. Each further line is the arc at one elevation [m, degrees], in any order. Lines "
        "that begin with # are comments.",
        Anything());
    prm.add_parameter("Kind", kind, "Kind of the arcs in the table. " + arc_kind_docs() + ".",
                      Selection(arc_kinds()));
    prm.add_parameter("Joints", grid.n_joints,
                      "Number of contraction joints [-], with equal spacing along the crest.",
                      Integer(0, PhysicalId::max_joints));
    prm.add_parameter(
        "Joint chainages", grid.joint_places,
        "Positions of the joints instead of \"Joints\", as \"20, 38.5, 57\": lengths of the centre "
        "line of the crest, from its right end [m].");
    grid.add_parameters(prm);
    prm.add_parameter(
        "Rows", grid.rows,
        "Ends of the rows of elements instead of \"Elements up\", as \"0.05, 0.15, 0.3, 0.6\": shares "
        "of the height of the dam between 0 (base) and 1 (crest) [-].");
    prm.leave_subsection();
    prm.leave_subsection();
  }

  void ArcsParameters::check() const
  {
    if (table.empty())
      throw InputError(
          "Entry \"Mesh/Source\" is arcs, but the entry \"Mesh/Arcs/Table\" is empty. Give the path "
          "of the table, relative to the directory of the input file.");
    double before = 0;
    for (const double row : grid.rows)
    {
      if (!(row > before && row < 1))
        throw InputError("Entry \"Mesh/Arcs/Rows\" has " + number_text(row) + " after " +
                         number_text(before) +
                         ". Give increasing shares of the height between 0 and 1, without 0 and 1.");
      before = row;
    }
    if (grid.joint_places.size() > PhysicalId::max_joints)
      throw InputError("Entry \"Mesh/Arcs/Joint chainages\" has " + std::to_string(grid.joint_places.size()) +
                       " joints. Give at most " + std::to_string(PhysicalId::max_joints) + ".");
  }

  std::unique_ptr<ArchShape> ArcsParameters::shape(const std::string &directory) const
  {
    return read_arch_table((std::filesystem::path(directory) / table).string(), kind);
  }

  ArchGrid ArcsParameters::complete_grid() const
  {
    ArchGrid result = grid;
    if (!grid.joint_places.empty())
      result.n_joints = grid.joint_places.size();
    if (!grid.rows.empty())
      result.elements_up = grid.rows.size() + 1;
    return result;
  }
} // namespace Voussoir
