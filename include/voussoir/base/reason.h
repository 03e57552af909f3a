// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_reason_h
#define voussoir_reason_h

#include <deal.II/base/exceptions.h>

#include <sstream>
#include <string>

namespace Voussoir
{
  /** Returns the first line of the description of an exception of deal.II, for a message. */
  inline std::string reason(const dealii::ExceptionBase &error)
  {
    std::stringstream text;
    error.print_info(text);
    std::string line;
    std::getline(text >> std::ws, line);
    return line;
  }
} // namespace Voussoir

#endif
