// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/app/scene_ranges.h>
#include <voussoir/app/scene_text.h>
#include <voussoir/base/error.h>
#include <voussoir/base/output_file.h>
#include <voussoir/foundation/foundation_names.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <sstream>

namespace Voussoir
{
  namespace fs = std::filesystem;

  std::string choices_of(const DeclaredEntry &entry)
  {
    return entry.pattern.rfind("[Selection", 0) == 0 ? ", " + pattern_in_words(entry.pattern) : "";
  }

  namespace
  {
    /** Returns a comment on an entry: the first sentence of its help text, with the unit and the choices, and the
     * sentence about the value -1. */
    std::string comment_of(const DeclaredEntry &entry, const std::string &value)
    {
      const std::string &help = entry.documentation;
      const auto         sentence = [&help](const std::size_t from)
      {
        const std::string text = help.substr(from, help.find(". ", from) - from);
        return text.substr(0, text.find_last_not_of('.') + 1);
      };
      const auto automatic = value == "-1" ? help.find("-1: ") : std::string::npos;
      return sentence(0) + choices_of(entry) + "." +
             (automatic == std::string::npos ? "" : " " + sentence(automatic) + ".");
    }
  } // namespace

  SceneText::SceneText(const std::string &file) : file(file)
  {
    scene.add_parameters(prm);
    known = declared_entries(prm);
    scene.name = fs::path(file).stem().string();
    scene.directory = scene.reservoir.directory = fs::path(file).parent_path().string();
  }

  const DeclaredEntry *SceneText::find(const std::string &name) const
  {
    const auto found = std::find_if(known.begin(), known.end(),
                                    [&](const DeclaredEntry &entry) { return entry.name() == name; });
    return found == known.end() ? nullptr : &*found;
  }

  void SceneText::set(const std::string &name, const std::string &value)
  {
    const DeclaredEntry &declared = *find(name);
    if (value.find('#') != std::string::npos)
      throw InputError("An input file cannot contain \"#\" in \"" + value + "\". Rename the file.");
    const std::string converted = set_entry(prm, declared, value, "\"" + name + "\"");
    const UsedValue   used = {name, name, declared.unit(), std::strtod(converted.c_str(), nullptr), ""};
    if (const std::string warning = implausible(used, prm.usual_ranges()); !warning.empty())
      throw InputError(warning);
    values[name] = value;
  }

  void SceneText::add_joints()
  {
    for (const DeclaredEntry &entry : known)
      if (entry.name().rfind("Joints/", 0) == 0 && entry.unit() != "" && scene.joints.any_reads(entry.name()))
        add(entry.name());
  }

  void SceneText::add_foundation()
  {
    for (const char *entry : {"Young's modulus", "Poisson's ratio", "Density"})
      if (const std::string name = std::string("Foundation/") + entry;
          foundation_reads(scene.foundation.model, name))
        add(name);
  }

  void SceneText::add_materials()
  {
    for (const char *entry : {"Young's modulus", "Poisson's ratio", "Density"})
      add(std::string("Concrete/") + entry);
    if (scene.motion.source != "none")
      for (const char *entry : {"Ratio", "Frequency 1", "Frequency 2"})
        add(std::string("Damping/") + entry);
  }

  std::string SceneText::text() const
  {
    scene.check();
    std::ostringstream       out;
    std::vector<std::string> section;
    const auto               indent = [&] { return std::string(2 * section.size(), ' '); };
    const auto               close = [&](const std::size_t depth)
    {
      while (section.size() > depth)
      {
        section.pop_back();
        out << indent() << "end\n";
      }
    };
    for (const DeclaredEntry &entry : known)
    {
      const auto value = values.find(entry.name());
      if (value == values.end())
        continue;
      std::size_t common = 0;
      while (common < section.size() && common + 1 < entry.path.size() &&
             section[common] == entry.path[common])
        ++common;
      close(common);
      for (std::size_t i = common; i + 1 < entry.path.size(); ++i)
      {
        out << (section.empty() ? "\n" : "") << indent() << "subsection " << entry.path[i] << "\n";
        section.push_back(entry.path[i]);
      }
      out << indent() << "# " << comment_of(entry, value->second) << "\n"
          << indent() << "set " << entry.path.back() << " = " << value->second << "\n";
    }
    close(0);
    return out.str();
  }

  void SceneText::expect_new() const
  {
    std::error_code error;
    if (fs::exists(fs::symlink_status(file, error)))
      throw InputError("The file " + file + " exists, and is not replaced. Name another file, or remove it.");
    const fs::path directory = fs::path(file).parent_path();
    if (!directory.empty() && !fs::is_directory(directory, error))
      throw InputError("There is no directory " + directory.string() + " for the file " + file +
                       ". Create it, or name another file.");
  }

  void SceneText::write(const std::string &heading) const
  {
    const std::string content = text();
    expect_new();
    OutputFile out(file);
    out << heading << content;
    out.check();
  }
} // namespace Voussoir
