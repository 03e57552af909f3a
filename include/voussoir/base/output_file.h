// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_output_file_h
#define voussoir_output_file_h

#include <voussoir/base/error.h>

#include <fstream>
#include <string>

namespace Voussoir
{
  /** A file cannot be written: the disk is full, a directory is in the way, or permission is missing. */
  class WriteError : public ComputationError
  {
  public:
    using ComputationError::ComputationError;

    /** "The file FILE cannot be written: REASON. ...", the reason as the system gave it last. */
    static WriteError of(const std::string &file);
  };

  /** A file that is being written. Not to be able to is a WriteError, from the constructor and from check().
   */
  class OutputFile : public std::ofstream
  {
  public:
    explicit OutputFile(const std::string &file, std::ios::openmode mode = std::ios::out);

    /** Hands everything to the system. */
    void check();

  private:
    const std::string name;
  };
} // namespace Voussoir

#endif
