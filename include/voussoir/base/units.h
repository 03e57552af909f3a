// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_units_h
#define voussoir_units_h

#include <string>

namespace Voussoir
{
  /** A value that a user wrote, "21 GPa", in the unit of its entry, "Pa": "21000000000". What has no unit, or
   * is no number, is returned as it is. @p declared: the unit that the entry's documentation declares; "-" or
   *  empty if it has none. Throws InputError, beginning with @p what, for a unit that is unknown, of another
   *  dimension, or on an entry without unit. */
  std::string in_declared_unit(const std::string &value, const std::string &declared,
                               const std::string &what);
} // namespace Voussoir

#endif
