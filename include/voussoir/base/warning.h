// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_warning_h
#define voussoir_warning_h

#include <string>

namespace Voussoir
{
  /** Warning of the program. */
  struct Warning
  {
    enum class Kind
    {
      input,  ///< about the input file, without influence on the results, such as an entry without effect
      physics ///< the results may be wrong, or not what is meant
    };

    Kind        kind;
    std::string text;  ///< sentences for log and report
    std::string place; ///< line of the input file, or position and time; or empty
  };
} // namespace Voussoir

#endif
