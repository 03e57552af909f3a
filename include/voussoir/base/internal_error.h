// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_internal_error_h
#define voussoir_internal_error_h

#include <stdexcept>

namespace Voussoir
{
  /** Throws std::logic_error with the text @p what if @p condition is false: an error of the program, not of
   * its input. */
  inline void ensure(const bool condition, const char *what)
  {
    if (!condition)
      throw std::logic_error(what);
  }
} // namespace Voussoir

#endif
