// SPDX-License-Identifier: GPL-3.0-or-later
#include <deal.II/base/parameter_handler.h>
#include <deal.II/base/patterns.h>

#include <voussoir/app/declared_entries.h>
#include <voussoir/base/error.h>
#include <voussoir/base/nearest_name.h>
#include <voussoir/base/units.h>

#include <boost/algorithm/string/join.hpp>
#include <boost/property_tree/json_parser.hpp>
#include <boost/property_tree/ptree.hpp>

#include <ostream>
#include <sstream>

namespace Voussoir
{
  using namespace dealii;

  std::string joined(const std::vector<std::string> &path)
  {
    return boost::algorithm::join(path, "/");
  }

  std::string DeclaredEntry::name() const
  {
    return joined(path);
  }

  std::string DeclaredEntry::unit() const
  {
    const auto from = documentation.find('['), to = documentation.find(']', from);
    return to == std::string::npos ? "" : documentation.substr(from + 1, to - from - 1);
  }

  namespace
  {
    void collect(const boost::property_tree::ptree &tree, std::vector<std::string> &path,
                 std::vector<DeclaredEntry> &entries)
    {
      for (const auto &child : tree)
      {
        path.push_back(child.first);
        if (child.second.get_child_optional("pattern_description"))
          entries.push_back({path, child.second.get<std::string>("default_value"),
                             child.second.get<std::string>("documentation"),
                             child.second.get<std::string>("pattern_description")});
        else
          collect(child.second, path, entries);
        path.pop_back();
      }
    }

    void print_markdown(const std::vector<DeclaredEntry> &entries, std::ostream &out)
    {
      const auto escaped = [](std::string text)
      {
        for (std::size_t i = 0; (i = text.find('|', i)) != std::string::npos; i += 2)
          text.insert(i, "\\");
        return text;
      };
      out << "| entry | default | meaning |\n|---|---|---|\n";
      for (const DeclaredEntry &entry : entries)
        out << "| `" << entry.name() << "` | "
            << (entry.default_value.empty() ? "" : "`" + escaped(entry.default_value) + "`") << " | "
            << escaped(entry.documentation) << " |\n";
    }

    /** Returns the entries of a section, or a single entry. */
    std::vector<DeclaredEntry> entries_in(const std::vector<DeclaredEntry> &all, const std::string &section)
    {
      std::vector<DeclaredEntry> result;
      std::vector<std::string>   names; // names of all sections and entries
      for (const DeclaredEntry &entry : all)
      {
        const std::string name = entry.name();
        if (section.empty() || name == section || name.rfind(section + "/", 0) == 0)
          result.push_back(entry);
        for (auto end = entry.path.begin() + 1; end <= entry.path.end(); ++end)
          names.push_back(joined({entry.path.begin(), end}));
      }
      if (result.empty())
        throw InputError(
            "There is no section or entry \"" + section + "\". Did you mean \"" +
            nearest_name(names, section) +
            "\"? `voussoir parameters [prm|json|markdown]` without a section prints all entries.");
      return result;
    }

    /** Returns the text between two markers after @p position. Moves @p position behind the second marker. */
    std::string between(const std::string &text, const std::string &first, const std::string &second,
                        std::size_t &position)
    {
      const auto from = text.find(first, position);
      if (from == std::string::npos)
        return "";
      const auto to = text.find(second, from + first.size());
      if (to == std::string::npos)
        return "";
      position = to + second.size();
      return text.substr(from + first.size(), to - from - first.size());
    }

    /** Returns a range such as "0...MAX_DOUBLE (inclusive)" in words. */
    std::string range_in_words(const std::string &range)
    {
      if (range.empty())
        return "";
      std::size_t       position = 0;
      const auto        dots = range.find("...");
      const std::string low = range.substr(0, dots), high = between(range, "...", " (", position);
      const bool        from = low.find("MAX_") == std::string::npos && low != "-2147483648",
                 to = high.find("MAX_") == std::string::npos && high != "2147483647" && high != "4294967295";
      return from && to ? " from " + low + " to " + high
             : from     ? " of at least " + low
             : to       ? " of at most " + high
                        : "";
    }

    std::string with_commas(std::string text)
    {
      text.erase(text.find_last_not_of(' ') + 1);
      for (std::size_t i = 0; (i = text.find('|', i)) != std::string::npos; i += 2)
        text.replace(i, 1, ", ");
      return text;
    }
  } // namespace

  std::vector<DeclaredEntry> declared_entries(const ParameterHandler &prm)
  {
    std::stringstream text;
    prm.print_parameters(text, ParameterHandler::JSON | ParameterHandler::KeepDeclarationOrder);
    boost::property_tree::ptree tree;
    boost::property_tree::read_json(text, tree);
    std::vector<DeclaredEntry> entries;
    std::vector<std::string>   path;
    collect(tree, path, entries);
    return entries;
  }

  std::string pattern_in_words(const std::string &pattern)
  {
    std::size_t       position = 0;
    const auto        space = pattern.find_first_of(" ]");
    const std::string kind = pattern.substr(1, space - 1);
    if (kind == "Double")
      return "a number" + range_in_words(between(pattern, "Double ", "]", position));
    if (kind == "Integer")
      return "an integer" + range_in_words(between(pattern, "range ", "]", position));
    if (kind == "Bool")
      return "true or false";
    if (kind == "Selection")
      return "one of: " + with_commas(between(pattern, "Selection ", "]", position));
    const std::string separator = separator_of(pattern) == 0 ? "" : std::string(1, separator_of(pattern));
    if (kind == "Map")
    {
      const std::string key = between(pattern, "<", ">:<", position);
      --position;
      const std::string value = between(pattern, "<", "> of length", position);
      return "a list of pairs \"key: value" + separator + " key: value\", where the key is " +
             pattern_in_words(key) + " and the value " + pattern_in_words(value);
    }
    if (kind == "List")
      return "a list \"value" + separator + " value\", where each is " +
             pattern_in_words(between(pattern, "<", "> of length", position));
    return kind == "Anything" ? "any text" : "of another kind: `voussoir parameters` prints all entries";
  }

  char separator_of(const std::string &pattern)
  {
    if (pattern.rfind("[Map", 0) != 0 && pattern.rfind("[List", 0) != 0)
      return 0;
    std::size_t       position = 0;
    const std::string separator = between(pattern, "separated by <", ">", position);
    return separator.empty() ? ',' : separator[0];
  }

  std::string set_entry(ParameterHandler &prm, const DeclaredEntry &declared, const std::string &value,
                        const std::string &what)
  {
    const std::string &pattern = declared.pattern, unit = declared.unit();
    const bool         is_number = pattern.rfind("[Double", 0) == 0 || pattern.rfind("[Integer", 0) == 0;
    const std::string  converted = is_number ? in_declared_unit(value, unit, what) : value;
    for (std::size_t i = 0; i + 1 < declared.path.size(); ++i)
      prm.enter_subsection(declared.path[i]);
    bool is_valid = true;
    try
    {
      prm.set(declared.path.back(), converted);
    }
    catch (const ExceptionBase &)
    {
      is_valid = false;
    }
    for (std::size_t i = 0; i + 1 < declared.path.size(); ++i)
      prm.leave_subsection();
    if (!is_valid)
      throw InputError(what + " cannot be \"" + value + "\". It must be " + pattern_in_words(pattern) +
                       (is_number && !unit.empty() && unit != "-" ? ", in " + unit : "") + ".");
    return converted;
  }

  void print_entries(const ParameterHandler &prm, const std::string &format, const std::string &section,
                     std::ostream &out)
  {
    const std::vector<DeclaredEntry> entries = entries_in(declared_entries(prm), section);
    if (format == "markdown")
      return print_markdown(entries, out);
    if (format != "prm" && format != "json")
      throw InputError("`voussoir parameters` prints prm, json or markdown, not \"" + format + "\".");
    const auto style = (format == "prm" ? ParameterHandler::PRM : ParameterHandler::JSON) |
                       ParameterHandler::KeepDeclarationOrder;
    if (section.empty())
    {
      prm.print_parameters(out, style);
      return;
    }
    ParameterHandler part;
    for (const DeclaredEntry &entry : entries)
    {
      for (std::size_t i = 0; i + 1 < entry.path.size(); ++i)
        part.enter_subsection(entry.path[i]);
      part.declare_entry(entry.path.back(), entry.default_value, *Patterns::pattern_factory(entry.pattern),
                         entry.documentation);
      for (std::size_t i = 0; i + 1 < entry.path.size(); ++i)
        part.leave_subsection();
    }
    part.print_parameters(out, style);
  }
} // namespace Voussoir
