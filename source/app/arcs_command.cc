// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/app/arcs_command.h>
#include <voussoir/app/scene_text.h>
#include <voussoir/base/error.h>
#include <voussoir/base/number_text.h>
#include <voussoir/mesh/arch_table.h>
#include <voussoir/mesh/mesh_source.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <sstream>

namespace Voussoir
{
  namespace
  {
    namespace fs = std::filesystem;

    /** Measures of a dam that the input file needs. */
    struct Measures
    {
      double bottom, top, crest_length, volume, jacobian; ///< [m, m^3, -]
    };

    Measures measures_of(const MeshParameters &parameters, const std::string &directory)
    {
      const HexMesh mesh = make_mesh(parameters, directory);
      const auto    shape = parameters.arcs.shape(directory);
      return {shape->bottom(), shape->top(), crest_length(mesh), volume(mesh),
              mesh_quality(mesh, false).smallest_scaled_jacobian};
    }

    double crest_length_of(const ArchShape &shape)
    {
      double length = 0;
      for (const Bank bank : {Bank::right, Bank::left})
        length += shape.crest_length(bank, shape.end(bank, shape.top()));
      return length;
    }

    /** Sets joints at distances of about 18 m, and elements of about a tenth of the height. Reduces the smallest height
     * if the end monoliths are low. Returns the measures of the mesh. */
    Measures choose_mesh(MeshParameters &parameters, const std::string &directory)
    {
      constexpr double usual_width = 18.; ///< of a monolith [m]
      ArchGrid        &grid = parameters.arcs.grid;
      const auto       shape = parameters.arcs.shape(directory);
      const double     length = crest_length_of(*shape), height = shape->top() - shape->bottom();
      grid.n_joints = std::clamp(std::round(length / usual_width) - 1, 0., double(PhysicalId::max_joints));
      const double per_monolith = std::ceil(length / grid.n_monoliths() / (height / 10) - 1e-9);
      grid.elements_along = grid.n_monoliths() * std::max(2., per_monolith);
      while (grid.smallest_height > 0.5)
        try
        {
          return measures_of(parameters, directory);
        }
        catch (const InputError &)
        {
          grid.smallest_height /= 2;
        }
      return measures_of(parameters, directory);
    }

    std::string chosen_kind(const Arguments &arguments)
    {
      const std::string kind = arguments.value("--kind", ArcsParameters().kind);
      const std::string kinds = "|" + arc_kinds() + "|";
      if (kinds.find("|" + kind + "|") == std::string::npos)
        throw InputError("--kind must be " + arc_kinds() + ", not \"" + kind + "\".");
      return kind;
    }

    /** Returns the path of the table as the input file names it: relative to the directory of the input file. */
    std::string table_of_scene(const std::string &table, const fs::path &directory)
    {
      std::error_code error;
      const fs::path  relative = fs::relative(table, directory.empty() ? "." : directory, error);
      return error || relative.empty() ? fs::absolute(table).string() : relative.string();
    }

    /** Sets the entries of the mesh. */
    void set_mesh(SceneText &text, const ArchGrid &grid)
    {
      const ArchGrid standard;
      for (const auto &[name, value] : {std::pair("Joints", double(grid.n_joints)),
                                        std::pair("Elements along", double(grid.elements_along)),
                                        std::pair("Elements up", double(grid.elements_up)),
                                        std::pair("Elements through", double(grid.elements_through))})
        text.set(std::string("Mesh/Arcs/") + name, number_text(value));
      if (grid.smallest_height != standard.smallest_height)
        text.set("Mesh/Arcs/Smallest height", number_text(grid.smallest_height));
    }

    std::string heading(const Measures &dam)
    {
      std::ostringstream text;
      text << "# A dam from a table of arcs: " << number_text(std::round((dam.top - dam.bottom) * 10) / 10)
           << " m high, crest " << number_text(std::round(dam.crest_length * 10) / 10) << " m, "
           << number_text(std::round(dam.volume))
           << " m^3.\n# Check every entry. All others have the defaults of `voussoir parameters`.\n";
      return text.str();
    }
  } // namespace

  void write_scene_of_arcs(const Arguments &arguments)
  {
    if (arguments.words.size() != 1)
      throw InputError("`voussoir arcs` needs one table of arcs. `voussoir arcs --help` shows the usage.");
    const std::string table = arguments.words[0];
    const fs::path    file = arguments.value("--output", fs::path(table).replace_extension(".prm").string());
    SceneText         text(file.string());
    text.expect_new();
    text.set("Mesh/Source", "arcs");
    text.set("Mesh/Arcs/Kind", chosen_kind(arguments));
    text.set("Mesh/Arcs/Table", table_of_scene(table, file.parent_path()));
    MeshParameters parameters = text.scene.mesh;
    const Measures dam = choose_mesh(parameters, text.scene.directory);
    set_mesh(text, parameters.arcs.grid);
    text.set("Reservoir/Water level", number_text(std::floor(dam.top - 0.05 * (dam.top - dam.bottom))));
    text.add("Joints/Model");
    text.add_joints();
    text.add("Foundation/Model");
    text.add_foundation();
    text.set("Motion/Source", "artificial");
    for (const char *entry : {"Motion/Peak acceleration", "Motion/Duration"})
      text.add(entry);
    text.add_materials();
    text.write(heading(dam));
    const ArchGrid &grid = parameters.arcs.grid;
    std::printf(
        "%s: height %.1f m, crest %.1f m, volume %.0f m3; %u joints, %u x %u x %u elements, smallest scaled "
        "Jacobian %.2f\n",
        file.c_str(), dam.top - dam.bottom, dam.crest_length, dam.volume, grid.n_joints, grid.elements_along,
        grid.elements_up, grid.elements_through, dam.jacobian);
    std::printf("Next: voussoir view %s, voussoir %s --validate\n", file.c_str(), file.c_str());
  }
} // namespace Voussoir
