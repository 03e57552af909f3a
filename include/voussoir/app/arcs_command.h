// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_arcs_command_h
#define voussoir_arcs_command_h

#include <voussoir/app/command_options.h>

namespace Voussoir
{
  /** Executes `voussoir arcs TABLE.csv`: meshes the dam of the table, prints its measures and writes a commented input
   * file.
   *
   * Throws InputError for a table that cannot be used, or if the input file exists. */
  void write_scene_of_arcs(const Arguments &arguments);
} // namespace Voussoir

#endif
