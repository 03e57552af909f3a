// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_output_file_h
#define voussoir_output_file_h

#include <fstream>
#include <string>

namespace Voussoir
{
  /** File opened for writing. The constructor throws WriteError if the file cannot be opened. */
  class OutputFile : public std::ofstream
  {
  public:
    explicit OutputFile(const std::string &file, std::ios::openmode mode = std::ios::out);

    /** Flushes the file. Throws WriteError if output so far could not be written, or if the file was removed. */
    void check();

  private:
    const std::string name;
  };
} // namespace Voussoir

#endif
