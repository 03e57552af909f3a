// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/error.h>
#include <voussoir/base/model_choices.h>
#include <voussoir/base/names.h>
#include <voussoir/foundation/foundation_table.h>
#include <voussoir/foundation/massless_rock.h>
#include <voussoir/foundation/subcycled_rock.h>
#include <voussoir/rock/boundary_table.h>

#include <algorithm>

namespace Voussoir
{
  namespace
  {
    struct FoundationRow
    {
      const char *name, *doc;
      std::unique_ptr<Foundation> (*make)(const FoundationSite &);
      EntryNames entries; ///< entries of section Foundation that the model reads
    };

    std::unique_ptr<Foundation> make_rigid_ground(const FoundationSite &)
    {
      return std::make_unique<Foundation>();
    }

    /** Table of all foundations. It defines the options and the help text of the entry "Foundation/Model". */
    const FoundationRow rows[] = {
        {"rigid", "prescribed ground motion at the base of the dam", make_rigid_ground, {"Foundation/Model"}},
        {"rock",
         "elastic rock with mass and explicit time integration, the earthquake enters from below",
         make_explicit_rock,
         {"Foundation/"}},
        {"massless",
         "elastic rock without mass, the ground motion is prescribed at its outer boundary",
         make_massless_rock,
         {"Foundation/Model", "Foundation/Young's modulus", "Foundation/Sustained modulus",
          "Foundation/Poisson's ratio", "Foundation/Zones"}}};

    const FoundationRow &row_of_model(const std::string &model)
    {
      return row_of(rows, model, "is no foundation", "The foundations are:");
    }

    void check_mesh(const FoundationSite &site, const Foundation &foundation)
    {
      const auto &cells = site.mesh.cells;
      const bool  has_rock = std::any_of(cells.begin(), cells.end(),
                                         [](const HexMesh::Cell &cell) { return !is_monolith(cell.volume); });
      if (foundation.uses_rock() && !has_rock)
        throw InputError("Foundation/Model is " + site.parameters.model + ", but the mesh " + site.source +
                         " has no rock. Add rock to the mesh (volumes from id 1000 on), or set "
                         "Foundation/Model to rigid.");
      if (has_rock && !foundation.uses_rock() && site.generated_in.empty() && !site.parameters.ignores_rock)
        throw InputError(
            "mesh " + site.source +
            " has rock (volumes from id 1000 on), but Foundation/Model is rigid. Set it to rock or "
            "massless, or remove the rock from the mesh.");
    }
  } // namespace

  std::unique_ptr<Foundation> make_foundation(const FoundationSite &site)
  {
    std::unique_ptr<Foundation> foundation = row_of_model(site.parameters.model).make(site);
    check_mesh(site, *foundation);
    return foundation;
  }

  void FoundationParameters::add_choices(ModelChoices &choices) const
  {
    const EntryNames read = row_of_model(model).entries;
    for (const FoundationRow &row : rows)
      if (row.name != model && choices.has_rock)
        choices.add("foundation", row.name, {{"Foundation/Model", row.name}},
                    includes_all(read, row.entries));
    if (model == "rigid")
      return;
    for (const double share : {.8, 1.25})
      choices.add("foundation",
                  "modulus of the rock " + std::string(share < 1. ? "20 % lower" : "25 % higher"),
                  "Foundation/Young's modulus", share * rock.young);
    if (model != "rock")
      return;
    for (const char *name : {"mtf2", "viscous-spring"})
      if (boundary != name && (quality == 0. || make_boundary(name)->nodes_per_line() > 0))
        choices.add("foundation", "boundary " + std::string(name), {{"Foundation/Boundary", name}});
    if (quality == 0. && incidence == "vertical" && make_boundary(boundary)->nodes_per_line() > 0)
      choices.add("foundation", "quality factor 50 of the rock", "Foundation/Quality factor", 50.);
    if (incidence == "vertical" && quality == 0.)
      for (const auto &[from, azimuth] :
           {std::pair<const char *, const char *>("right bank", "90"), {"upstream", "0"}})
      {
        std::string waves;
        for (const char *type : {"SV 15 ", ", SH 15 ", ", P 15 "})
          waves += std::string(type) + azimuth;
        choices.add("foundation", "waves at 15 degrees from " + std::string(from),
                    {{"Foundation/Incidence", waves}});
      }
    if (coupling != "partition" && substeps > 0)
      choices.add("foundation", "twice the rock steps", "Foundation/Substeps", 2. * n_substeps());
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
