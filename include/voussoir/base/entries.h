// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_entries_h
#define voussoir_entries_h

#include <deal.II/base/parameter_handler.h>

#include <map>
#include <string>

namespace Voussoir
{
  /** Values of a number that occur in practice, in the declared unit; others produce a warning. */
  struct UsualRange
  {
    double low, high;
    bool   or_zero = false; ///< zero switches something off
  };

  using UsualRanges = std::map<std::string, UsualRange>; ///< by "Section/Entry"

  /** Declarations of entries, some with a usual range. */
  class Entries : public dealii::ParameterHandler
  {
  public:
    using dealii::ParameterHandler::add_parameter;

    /** Declares a number with its usual range; its default is @p value. */
    template <class Number>
    void add_parameter(const std::string &name, Number &value, const std::string &help,
                       const UsualRange                    &range,
                       const dealii::Patterns::PatternBase &pattern =
                           *dealii::Patterns::Tools::Convert<Number>::to_pattern())
    {
      add_parameter(name, value, help, pattern);
      usual[section + name] = range;
    }

    void enter_subsection(const std::string &name)
    {
      dealii::ParameterHandler::enter_subsection(name);
      section += name + "/";
    }

    void leave_subsection()
    {
      dealii::ParameterHandler::leave_subsection();
      section.erase(section.rfind('/', section.size() - 2) + 1);
    }

    const UsualRanges &usual_ranges() const { return usual; }

  private:
    std::string section; ///< "Section/Subsection/", where entries are declared now
    UsualRanges usual;
  };
} // namespace Voussoir

#endif
