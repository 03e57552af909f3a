// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_checkpoint_file_h
#define voussoir_checkpoint_file_h

#include <map>
#include <string>

namespace Voussoir
{
  /** Returns size and checksum of a file as text. Throws InputError if the file cannot be read. */
  std::string digest_of_file(const std::string &file);

  /** Writes @p payload with its checksum to a new file, and then replaces @p file by it. The previous file is
   * renamed to FILE.before. Throws WriteError. */
  void write_checkpoint_file(const std::string &file, const std::string &payload);

  /** Returns the payload of @p file. If this file is missing or damaged, returns that of FILE.before and sets
   * @p warning. Throws InputError if neither can be used. */
  std::string read_checkpoint_file(const std::string &file, std::string &warning);

  /** Inputs of a run by name: entries of the input file, files, revision of the program. */
  using Provenance = std::map<std::string, std::string>;

  /** Returns the values of the text of an input file, by "Section/Entry". Entries that may change when a run
   * is resumed are excluded: output intervals, contact solver and duration of the motion. */
  Provenance decisive_entries(const std::string &scene_text);

  /** Throws InputError with all differences if @p now and @p then differ. @p checkpoint: file name. */
  void check_provenance(const Provenance &then, const Provenance &now, const std::string &checkpoint);
} // namespace Voussoir

#endif
