// SPDX-License-Identifier: GPL-3.0-or-later
#include <deal.II/base/parameter_handler.h>

#include <voussoir/app/scene_warnings.h>
#include <voussoir/base/curve_file.h>
#include <voussoir/base/error.h>
#include <voussoir/base/nearest_name.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>
#include <sstream>

namespace Voussoir
{
  using namespace dealii;

  namespace
  {
    /** Line "set a = b" with its subsections. */
    struct Entry
    {
      std::vector<std::string>     path; ///< subsections, then the entry
      std::string                  value;
      std::string                  place;            ///< position for messages
      std::size_t                  text = no_number; ///< number of its file; no_number: --set
      static constexpr std::size_t no_number = -1;
    };

    std::string trimmed(const std::string &s)
    {
      const auto first = s.find_first_not_of(" \t\r\n"), last = s.find_last_not_of(" \t\r\n");
      return first == std::string::npos ? "" : s.substr(first, last - first + 1);
    }

    bool starts_with(const std::string &line, const std::string &word, std::string &rest)
    {
      if (line.compare(0, word.size(), word) != 0 ||
          (line.size() > word.size() && line[word.size()] != ' ' && line[word.size()] != '\t'))
        return false;
      rest = trimmed(line.substr(word.size()));
      return true;
    }

    /** All entries of a .prm text. @p directory: of the file, for its includes. */
    void parse(std::istream &in, const std::string &file, const std::string &directory,
               std::vector<Entry> &entries, std::vector<std::string> &section,
               std::vector<std::string> &files)
    {
      if (files.size() > 1000)
        throw InputError(file + ": files include each other in a circle.");
      const std::size_t text = files.size(), outer = section.size();
      files.push_back(file);
      std::string line, more, rest;
      for (unsigned int number = 1; std::getline(in, line); ++number)
      {
        const std::string place = file + ", line " + std::to_string(number);
        line = trimmed(line);
        while (!line.empty() && line.back() == '\\' && std::getline(in, more))
        {
          line.pop_back();
          line += trimmed(more);
          ++number;
        }
        line = trimmed(line.substr(0, line.find('#')));
        if (line.empty())
          continue;
        if (starts_with(line, "subsection", rest) && !rest.empty())
          section.push_back(rest);
        else if (line == "end")
        {
          if (section.size() == outer)
            throw InputError(place + ": \"end\" without a \"subsection\" before it. Remove it.");
          section.pop_back();
        }
        else if (starts_with(line, "include", rest))
        {
          const std::string included = (std::filesystem::path(directory) / rest).string();
          std::ifstream     stream = open_text(
                  included, place + ": the included file " + included +
                                " cannot be read. Paths of includes are relative to the including file.");
          parse(stream, included, std::filesystem::path(included).parent_path().string(), entries, section,
                files);
        }
        else if (starts_with(line, "set", rest) && rest.find('=') != std::string::npos)
        {
          Entry entry{section, trimmed(rest.substr(rest.find('=') + 1)), place, text};
          entry.path.push_back(trimmed(rest.substr(0, rest.find('='))));
          entries.push_back(entry);
        }
        else
          throw InputError(
              place + (text == 0 ? ": \"" + line + "\"" : ", an included file: the line") + // may be any file
              " is none of: subsection NAME, end, set ENTRY = VALUE, include FILE, # comment.");
      }
      if (section.size() != outer)
        throw InputError(file + ": subsection \"" + section.back() + "\" is not closed. Add an \"end\".");
    }

    /** Removed entries, which are ignored with a warning: what to use instead. */
    const std::map<std::string, std::string> removed = {
        {"Dynamics/Error estimate",
         "was removed in version 0.6.0, which does not change the results. Remove the entry, and use `voussoir "
         "accuracy` to estimate the error of the time step."},
        {"Contact/Method", "was removed in version 0.6.0: the solver chooses its method. Remove the entry."}};

    /** Returns the declaration of an entry. Throws InputError, with the most similar one, for an unknown
     * entry name. */
    const DeclaredEntry &declaration(const std::vector<DeclaredEntry> &known, const Entry &entry)
    {
      const auto found = std::find_if(known.begin(), known.end(),
                                      [&](const DeclaredEntry &k) { return k.path == entry.path; });
      if (found != known.end())
        return *found;
      // Most similar name; the same entry in another section is similar.
      const std::string path = joined(entry.path);
      const auto        distance = [&](const DeclaredEntry &k) {
        return std::min(edit_distance(k.name(), path), edit_distance(k.path.back(), entry.path.back()) + 2);
      };
      const auto nearest = std::min_element(known.begin(), known.end(),
                                            [&](const DeclaredEntry &a, const DeclaredEntry &b)
                                            { return distance(a) < distance(b); });
      throw InputError(entry.place + ": there is no entry \"" + path + "\". Did you mean \"" +
                       nearest->name() + "\"? `voussoir parameters` prints all entries.");
    }

    /** Throws InputError for a list of pairs "key: value" with a repeated key. */
    void expect_different_keys(const std::string &value, const char separator, const std::string &what)
    {
      std::istringstream    pairs(value);
      std::set<std::string> keys;
      for (std::string pair; std::getline(pairs, pair, separator);)
        if (const std::string key = trimmed(pair.substr(0, pair.find(':'))); !keys.insert(key).second)
          throw InputError(what + " has \"" + key + "\" twice. Remove or rename one of them.");
    }

    /** Sets the entry in @p prm. Converts its value to the declared unit. */
    void apply(ParameterHandler &prm, const DeclaredEntry &declared, Entry &entry)
    {
      const std::string what = entry.place + ": entry \"" + declared.name() + "\"";
      if (declared.pattern.rfind("[Map", 0) == 0)
        expect_different_keys(entry.value, separator_of(declared.pattern), what);
      entry.value = set_entry(prm, declared, entry.value, what);
    }
  } // namespace

  void read_scene(const std::string &file, const std::vector<std::string> &overrides, Scene &scene,
                  Entries &prm)
  {
    scene.add_parameters(prm);
    const std::vector<DeclaredEntry> known = declared_entries(prm);
    std::vector<Entry>               entries;
    std::vector<std::string>         section;

    std::ifstream in =
        open_text(file, "The scene file " + file + " cannot be read. Check the path of the .prm file.");
    const std::filesystem::path path(file);
    scene.name = path.stem().string();
    scene.directory = scene.reservoir.directory = path.parent_path().string();
    parse(in, file, scene.directory, entries, section, scene.sources);
    for (const std::string &override : overrides)
    {
      const auto equals = override.find('=');
      if (equals == std::string::npos)
        throw InputError("--set '" + override + "': write --set 'Section/Entry=value'.");
      if (equals == 0)
        throw InputError("--set '" + override +
                         "': there is no entry before the \"=\". Write --set 'Section/Entry=value'.");
      Entry              entry{{}, trimmed(override.substr(equals + 1)), "--set"};
      std::istringstream parts(override.substr(0, equals));
      for (std::string part; std::getline(parts, part, '/');)
        entry.path.push_back(trimmed(part));
      entries.push_back(entry);
    }
    std::map<std::string, WrittenEntry>                        written; // the last value is used
    std::map<std::pair<std::string, std::size_t>, std::string> places;  // by entry and file
    std::vector<Warning>                                       warnings;
    for (Entry &entry : entries)
    {
      if (const auto gone = removed.find(joined(entry.path)); gone != removed.end())
      {
        warnings.push_back({Warning::Kind::input,
                            entry.place + ": entry \"" + gone->first + "\" " + gone->second, entry.place});
        continue;
      }
      const DeclaredEntry &declared = declaration(known, entry);
      apply(prm, declared, entry);
      written[declared.name()] = {declared, entry.value, entry.place};
      std::string &before = places[{declared.name(), entry.text}];
      if (!before.empty() && entry.text != Entry::no_number)
        warnings.push_back({Warning::Kind::input,
                            declared.name() + " is in the file twice, " + before + " and " + entry.place +
                                ": the last value is used, " + entry.value + ". Remove one of them.",
                            entry.place});
      before = entry.place;
    }
    scene.complete();
    std::vector<WrittenEntry> in_order;
    for (const DeclaredEntry &declared : known)
      if (const auto found = written.find(declared.name()); found != written.end())
        in_order.push_back(found->second);
    scene.warnings = scene_warnings(scene, in_order, prm.usual_ranges());
    scene.warnings.insert(scene.warnings.end(), warnings.begin(), warnings.end());
  }
} // namespace Voussoir
