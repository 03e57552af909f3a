// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_new_command_h
#define voussoir_new_command_h

#include <string>
#include <vector>

namespace Voussoir
{
  /** Runs `voussoir new`: asks for dam, water level, joint model, foundation and ground motion on standard
   * input, checks each answer, and writes a commented scene. An empty answer or the end of the input is the
   * default.
   *
   * @param words file to write; none: dam.prm
   *
   * Throws InputError if the file exists, or if the input ends before a valid answer; WriteError. */
  void write_new_scene(const std::vector<std::string> &words);
} // namespace Voussoir

#endif
