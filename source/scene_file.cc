#include <deal.II/base/parameter_handler.h>

#include <voussoir/error.h>
#include <voussoir/scene.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <numeric>
#include <sstream>

namespace Voussoir
{
  using namespace dealii;

  namespace
  {
    /** A line "set a = b" with the subsections around it. */
    struct Entry
    {
      std::vector<std::string> path; ///< subsections, then the entry
      std::string              value;
      std::string              place; ///< for messages
    };

    std::string joined(const std::vector<std::string> &path)
    {
      std::string result;
      for (const std::string &part : path)
        result += (result.empty() ? "" : "/") + part;
      return result;
    }

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
               std::vector<Entry> &entries, std::vector<std::string> &section, const unsigned int depth)
    {
      const std::size_t outer = section.size();
      std::string       line, more, rest;
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
          std::ifstream     stream(included);
          if (!stream)
            throw InputError(place + ": the included file " + included +
                             " cannot be read. Paths of includes are relative to the including file.");
          if (depth > 20)
            throw InputError(place + ": files include each other in a circle.");
          parse(stream, included, std::filesystem::path(included).parent_path().string(), entries, section,
                depth + 1);
        }
        else if (starts_with(line, "set", rest) && rest.find('=') != std::string::npos)
        {
          Entry entry{section, trimmed(rest.substr(rest.find('=') + 1)), place};
          entry.path.push_back(trimmed(rest.substr(0, rest.find('='))));
          entries.push_back(entry);
        }
        else
          throw InputError(
              place + ": \"" + line +
              "\" is none of: subsection NAME, end, set ENTRY = VALUE, include FILE, # comment.");
      }
      if (section.size() != outer)
        throw InputError(file + ": subsection \"" + section.back() + "\" is not closed. Add an \"end\".");
    }

    unsigned int edit_distance(const std::string &a, const std::string &b)
    {
      std::vector<unsigned int> row(b.size() + 1);
      std::iota(row.begin(), row.end(), 0);
      for (std::size_t i = 1; i <= a.size(); ++i)
      {
        unsigned int diagonal = row[0]++;
        for (std::size_t j = 1; j <= b.size(); ++j)
        {
          const unsigned int old = row[j];
          row[j] = std::min({row[j] + 1, row[j - 1] + 1,
                             diagonal + (std::tolower(a[i - 1]) == std::tolower(b[j - 1]) ? 0 : 1)});
          diagonal = old;
        }
      }
      return row.back();
    }

    void apply(ParameterHandler &prm, const std::vector<Entry> &known, const Entry &entry)
    {
      const std::string path = joined(entry.path);
      if (std::none_of(known.begin(), known.end(), [&](const Entry &k) { return k.path == entry.path; }))
      {
        // Nearest by name; the same entry in another section counts as near.
        std::string  nearest;
        unsigned int best = 1000;
        for (const Entry &k : known)
        {
          const unsigned int d = std::min(edit_distance(joined(k.path), path),
                                          edit_distance(k.path.back(), entry.path.back()) + 2);
          if (d < best)
            best = d, nearest = joined(k.path);
        }
        throw InputError(entry.place + ": there is no entry \"" + path + "\". Did you mean \"" + nearest +
                         "\"? `voussoir parameters` prints all entries.");
      }
      for (std::size_t i = 0; i + 1 < entry.path.size(); ++i)
        prm.enter_subsection(entry.path[i]);
      try
      {
        prm.set(entry.path.back(), entry.value);
      }
      catch (const ParameterHandler::ExcValueDoesNotMatchPattern &error)
      {
        std::ostringstream info; // "... does not match the given pattern <...>."
        error.print_info(info);
        const std::string text = info.str(), before = "pattern <";
        const auto        from = text.find(before), to = text.rfind('>');
        throw InputError(entry.place + ": entry \"" + path + "\" cannot be \"" + entry.value +
                         "\". It must be " +
                         (from < to && to != std::string::npos
                              ? text.substr(from + before.size(), to - from - before.size())
                              : "of another kind: `voussoir parameters` prints all entries") +
                         ".");
      }
      catch (const ExceptionBase &)
      {
        throw InputError(entry.place + ": entry \"" + path + "\" cannot be \"" + entry.value + "\".");
      }
      for (std::size_t i = 0; i + 1 < entry.path.size(); ++i)
        prm.leave_subsection();
    }
  } // namespace

  void read_scene(const std::string &file, const std::vector<std::string> &overrides, Scene &scene,
                  ParameterHandler &prm)
  {
    scene.add_parameters(prm);
    std::ostringstream declared;
    prm.print_parameters(declared, ParameterHandler::ShortPRM | ParameterHandler::KeepDeclarationOrder);
    std::vector<Entry>       known, entries;
    std::vector<std::string> section;
    std::istringstream       declarations(declared.str());
    parse(declarations, "declarations", "", known, section, 0);

    std::ifstream in(file);
    if (!in || std::filesystem::is_directory(file))
      throw InputError("The scene file " + file + " cannot be read. Give the path of a .prm file.");
    const std::filesystem::path path(file);
    scene.name = path.stem().string();
    scene.directory = path.parent_path().string();
    parse(in, file, scene.directory, entries, section, 0);
    for (const std::string &override : overrides)
    {
      const auto equals = override.find('=');
      if (equals == std::string::npos)
        throw InputError("--set '" + override + "': write --set 'Section/Entry=value'.");
      Entry              entry{{}, trimmed(override.substr(equals + 1)), "--set"};
      std::istringstream parts(override.substr(0, equals));
      for (std::string part; std::getline(parts, part, '/');)
        entry.path.push_back(trimmed(part));
      entries.push_back(entry);
    }
    for (const Entry &entry : entries)
      apply(prm, known, entry);
    scene.check();
  }
} // namespace Voussoir
