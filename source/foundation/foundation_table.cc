// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/names.h>
#include <voussoir/foundation/foundation_table.h>
#include <voussoir/foundation/massless_rock.h>
#include <voussoir/foundation/own_step_rock.h>

#include <algorithm>

namespace Voussoir
{
  namespace
  {
    struct FoundationRow
    {
      const char *name, *doc;
      std::unique_ptr<Foundation> (*make)(const FoundationSite &);
      EntryNames entries; ///< that it reads
    };

    std::unique_ptr<Foundation> make_rigid_ground(const FoundationSite &)
    {
      return std::make_unique<Foundation>();
    }

    /** All foundations. The selection of the entry "Foundation/Model", its text and the messages follow from
     * these rows. */
    const FoundationRow rows[] = {
        {"rigid", "the base moves as the ground motion says", make_rigid_ground, {"Foundation/Model"}},
        {"rock",
         "the rock of the mesh, explicit, the earthquake from below",
         make_explicit_rock,
         {"Foundation/"}},
        {"massless",
         "its stiffness only, on a rigid ground that moves as the ground motion says",
         make_massless_rock,
         {"Foundation/Model", "Foundation/Young's modulus", "Foundation/Poisson's ratio",
          "Foundation/Zones"}}};

    const FoundationRow &row_of_model(const std::string &model)
    {
      return row_of(rows, model, "is no foundation", "They are:");
    }

    void check_mesh(const FoundationSite &site, const Foundation &foundation)
    {
      const auto &cells = site.mesh.cells;
      const bool  has_rock = std::any_of(cells.begin(), cells.end(),
                                         [](const HexMesh::Cell &cell) { return !is_monolith(cell.volume); });
      if (foundation.uses_rock() && !has_rock)
        throw InputError("Foundation/Model is " + site.parameters.model +
                         ", but the mesh has no rock (volumes from id 1000 on). Set "
                         "Mesh/Arch210/Rock/Enabled = true, or give a mesh with rock.");
      if (has_rock && !foundation.uses_rock() && site.source != "arch210")
        throw InputError(
            "The mesh has rock (volumes from id 1000 on), but Foundation/Model is rigid: set it to rock or "
            "massless, or leave the rock out of the mesh.");
    }
  } // namespace

  std::unique_ptr<Foundation> make_foundation(const FoundationSite &site)
  {
    std::unique_ptr<Foundation> foundation = row_of_model(site.parameters.model).make(site);
    check_mesh(site, *foundation);
    return foundation;
  }

  std::string foundation_names()
  {
    return names_of(rows);
  }

  std::string foundation_docs()
  {
    return docs_of(rows);
  }

  bool foundation_reads(const std::string &model, const std::string &entry)
  {
    return includes(row_of_model(model).entries, entry);
  }
} // namespace Voussoir
