// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_checkpoint_file_h
#define voussoir_checkpoint_file_h

#include <map>
#include <string>

namespace Voussoir
{
  /** Returns size and checksum (CRC-64) of a file as text. Throws InputError if the file cannot be read. */
  std::string digest_of_file(const std::string &file);

  /** Writes @p payload with its checksum to a new file, and then replaces @p file by it. The previous file is
   * renamed to FILE.before. Throws WriteError. */
  void write_checkpoint_file(const std::string &file, const std::string &payload);

  /** Returns the payload of a checkpoint file.
   * @param file name of the file
   * @param warning receives a text if @p file is missing or damaged. The result is then the payload of
   * FILE.before.
   *
   * Throws InputError if both files are missing or damaged. */
  std::string read_checkpoint_file(const std::string &file, std::string &warning);

  /** Inputs on which the results of a run depend, as texts by name: entries of the input file, digests of
   * other files, revision of the program. */
  using Provenance = std::map<std::string, std::string>;

  /** Returns the values of all entries in the text of an input file, by "Section/Entry". Entries that may
   * change when a run is resumed are excluded: intervals of checkpoint, progress and solution, figures, contact solver and duration of the
   * motion. */
  Provenance decisive_entries(const std::string &scene_text);

  /** Throws InputError with a list of all differences if the inputs have changed.
   * @param then inputs of the run that wrote the checkpoint
   * @param now inputs of the resumed run
   * @param checkpoint file name of the checkpoint, for the message */
  void check_provenance(const Provenance &then, const Provenance &now, const std::string &checkpoint);
} // namespace Voussoir

#endif
