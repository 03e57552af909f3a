// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_units_h
#define voussoir_units_h

#include <string>

namespace Voussoir
{
  /** Returns the name of a unit, the same for equal units: "cm/s^2" for "cm/s2", "cm/sec/sec" and "gal".
   * @param text unit, as after a number in the input file
   * @param dimension such as "acceleration"; an empty string is returned if @p text is no unit of it */
  std::string unit_name(const std::string &text, const std::string &dimension);

  /** Returns all units of a dimension for a selection, such as "m|km|...", with "m/s^2" and "m/s2". */
  std::string unit_choices(const std::string &dimension);

  /** Converts a value with a unit to the unit of its entry: "21 GPa" to "21000000000" for an entry in "Pa".
   * Text without a number or without a unit is returned unchanged.
   * @param value text of the input file
   * @param declared unit of the entry; "-" or empty: none
   * @param what beginning of the message of an error
   *
   * Throws InputError for an unknown unit, a unit of another dimension, or a unit on an entry without one. */
  std::string in_declared_unit(const std::string &value, const std::string &declared,
                               const std::string &what);

  /** Returns a number in the unit @p declared, or NaN for invalid text. The arguments are those of
   * in_declared_unit(). Throws InputError like it. */
  double number_in_unit(const std::string &value, const std::string &declared, const std::string &what);
} // namespace Voussoir

#endif
