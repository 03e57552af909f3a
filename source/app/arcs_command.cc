// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/app/arcs_command.h>
#include <voussoir/base/error.h>
#include <voussoir/base/nearest_name.h>
#include <voussoir/base/number_text.h>
#include <voussoir/mesh/arch_table.h>
#include <voussoir/mesh/mesh_source.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
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

    Measures measures_of(const MeshParameters &parameters)
    {
      const HexMesh mesh = make_mesh(parameters, "");
      const auto    shape = parameters.arcs.shape("");
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
    Measures choose_mesh(MeshParameters &parameters)
    {
      constexpr double usual_width = 18.; ///< of a monolith [m]
      ArchGrid        &grid = parameters.arcs.grid;
      const auto       shape = parameters.arcs.shape("");
      const double     length = crest_length_of(*shape), height = shape->top() - shape->bottom();
      grid.n_joints = std::clamp(std::round(length / usual_width) - 1, 0., double(PhysicalId::max_joints));
      const double per_monolith = std::ceil(length / grid.n_monoliths() / (height / 10) - 1e-9);
      grid.elements_along = grid.n_monoliths() * std::max(2., per_monolith);
      while (grid.smallest_height > 0.5)
        try
        {
          return measures_of(parameters);
        }
        catch (const InputError &)
        {
          grid.smallest_height /= 2;
        }
      return measures_of(parameters);
    }

    std::string chosen_kind(const Arguments &arguments)
    {
      const std::string kind = arguments.value("--kind", ArcsParameters().kind);
      const std::string kinds = "|" + arc_kinds() + "|";
      if (kinds.find("|" + kind + "|") == std::string::npos)
        throw InputError("--kind must be " + arc_kinds() + ", not \"" + kind + "\".");
      return kind;
    }

    std::string scene_text(const MeshParameters &parameters, const Measures &dam, const std::string &table)
    {
      const ArchGrid    &grid = parameters.arcs.grid;
      const double       height = dam.top - dam.bottom;
      std::ostringstream text;
      text
          << "# A dam from a table of arcs: " << number_text(std::round(height * 10) / 10)
          << " m high, crest " << number_text(std::round(dam.crest_length * 10) / 10) << " m, "
          << number_text(std::round(dam.volume))
          << " m^3.\n# Check every entry. All others have the defaults of `voussoir parameters`.\n\n"
          << "subsection Mesh\n  set Source = arcs\n  subsection Arcs\n    set Table            = " << table
          << "\n    set Kind             = " << parameters.arcs.kind
          << "\n    set Joints           = " << grid.n_joints
          << "     # at equal distances; or: set Joint chainages = 20, 38, ... [m]\n"
          << "    set Elements along   = " << grid.elements_along << "     # along the crest\n"
          << "    set Elements up      = " << grid.elements_up << "     # from the base to the crest\n"
          << (grid.smallest_height == ArchGrid().smallest_height
                  ? ""
                  : "    set Smallest height  = " + number_text(grid.smallest_height) +
                        "   # m, of the dam at the banks\n")
          << "    set Elements through = " << grid.elements_through
          << "      # through the thickness; `voussoir accuracy` estimates the error\n  end\nend\n\n"
          << "subsection Concrete\n  set Young's modulus = 24 GPa    # dynamic\n"
          << "  set Poisson's ratio = 0.2\n  set Density         = 2400 kg/m^3\nend\n\n"
          << "subsection Damping\n  set Ratio       = 0.05\n"
          << "  set Frequency 1 = 1.2         # Hz; `voussoir modes` prints the frequencies of the dam\n"
          << "  set Frequency 2 = 6\nend\n\n"
          << "subsection Reservoir\n  set Water level = " << number_text(std::floor(dam.top - 0.05 * height))
          << "          # m, in the elevations of the table\nend\n\n"
          << "subsection Joints\n  set Model    = FJA           # opens and slides; FJB: no slip; KSM: shear keys\n"
          << "  set Friction = 0.7\nend\n\n"
          << "subsection Foundation\n  set Model           = rigid   # or massless, or rock (with mass)\n"
          << "  # set Young's modulus = 20 GPa   # of the rock\nend\n\n"
          << "subsection Motion\n  set Source            = artificial   # or file, with File x, File y, File z\n"
          << "  set Peak acceleration = 0.2          # g, in x and y\n  set Duration          = 10.24        # s\n"
          << "end\n";
      return text.str();
    }
  } // namespace

  void write_scene_of_arcs(const Arguments &arguments)
  {
    if (arguments.words.size() != 1)
      throw InputError("`voussoir arcs` needs one table of arcs. `voussoir arcs --help` shows the usage.");
    const std::string table = arguments.words[0];
    if (table.find('#') != std::string::npos)
      throw InputError("The path " + table +
                       " contains #, which begins a comment in an input file. Rename the table.");
    const fs::path file = arguments.value("--output", fs::path(table).replace_extension(".prm").string());
    if (fs::exists(file))
      throw InputError("The file " + file.string() +
                       " exists. Choose another one with --output, or remove it.");
    MeshParameters parameters;
    parameters.source = "arcs";
    parameters.arcs.table = table;
    parameters.arcs.kind = chosen_kind(arguments);
    parameters.check();
    const Measures dam = choose_mesh(parameters);

    std::error_code error;
    fs::path from_scene = fs::relative(table, file.parent_path().empty() ? "." : file.parent_path(), error);
    if (error || from_scene.empty())
      from_scene = fs::absolute(table);
    std::ofstream out(file);
    out << scene_text(parameters, dam, from_scene.string());
    out.close();
    if (!out)
      throw InputError("The file " + file.string() + " cannot be written. Choose another one with --output.");
    const ArchGrid &grid = parameters.arcs.grid;
    std::printf(
        "%s: height %.1f m, crest %.1f m, volume %.0f m3; %u joints, %u x %u x %u elements, smallest scaled "
        "Jacobian %.2f\n",
        file.c_str(), dam.top - dam.bottom, dam.crest_length, dam.volume, grid.n_joints, grid.elements_along,
        grid.elements_up, grid.elements_through, dam.jacobian);
    std::printf("Next: voussoir view %s, voussoir %s --validate\n", file.c_str(), file.c_str());
  }
} // namespace Voussoir
