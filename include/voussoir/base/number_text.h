// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_number_text_h
#define voussoir_number_text_h

#include <cstdio>
#include <string>

namespace Voussoir
{
  /** Returns a number for a message, with up to nine significant digits and without trailing zeros. */
  inline std::string number_text(const double number)
  {
    char text[32];
    std::snprintf(text, sizeof(text), "%.9g", number);
    return text;
  }
} // namespace Voussoir

#endif
