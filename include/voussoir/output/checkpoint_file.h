// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_checkpoint_file_h
#define voussoir_checkpoint_file_h

#include <map>
#include <string>

namespace Voussoir
{
  /** Size and checksum of a file, as text; InputError if it cannot be read. */
  std::string digest_of_file(const std::string &file);

  /** Writes @p payload with its checksum, to the disk itself, and only then in the place of @p file; what was
   * there before is kept as FILE.before. Throws WriteError. */
  void write_checkpoint_file(const std::string &file, const std::string &payload);

  /** The payload of @p file, or, if that is missing or damaged, of FILE.before, and then @p warning says so.
   * Throws InputError if neither can be used. */
  std::string read_checkpoint_file(const std::string &file, std::string &warning);

  /** What a run depends on, by name: entries of the scene, files, the program. */
  using Provenance = std::map<std::string, std::string>;

  /** The values of a scene's text, by "Section/Entry", without those that may change when a run is resumed:
   * what is written and when, the settings of the joints' solver, and the duration of the motion. */
  Provenance decisive_entries(const std::string &scene_text);

  /** Throws InputError, naming what differs, unless @p now is what it was @p then. */
  void check_provenance(const Provenance &then, const Provenance &now, const std::string &checkpoint);
} // namespace Voussoir

#endif
