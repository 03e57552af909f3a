// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_entries_h
#define voussoir_entries_h

#include <deal.II/base/parameter_handler.h>

#include <map>
#include <string>

namespace Voussoir
{
  /** Usual values of a number, in the declared unit. Other values produce a warning. */
  struct UsualRange
  {
    double low, high;
    bool   or_zero = false; ///< true: zero is usual as well, such as for a load that is switched off
  };

  using UsualRanges = std::map<std::string, UsualRange>; ///< by "Section/Entry"

  /** ParameterHandler with usual ranges of the entries. */
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

    /** Enters a subsection, as in ParameterHandler. */
    void enter_subsection(const std::string &name)
    {
      dealii::ParameterHandler::enter_subsection(name);
      section += name + "/";
    }

    /** Leaves the subsection. */
    void leave_subsection()
    {
      dealii::ParameterHandler::leave_subsection();
      section.erase(section.rfind('/', section.size() - 2) + 1);
    }

    /** Returns the usual ranges of all declared entries. */
    const UsualRanges &usual_ranges() const { return usual; }

  private:
    std::string section; ///< current section: "Section/Subsection/"
    UsualRanges usual;
  };
} // namespace Voussoir

#endif
