// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/error.h>
#include <voussoir/base/output_file.h>

#include <cerrno>
#include <cstring>
#include <sys/stat.h>

namespace Voussoir
{
  WriteError WriteError::of(const std::string &file)
  {
    const std::string reason = errno != 0 ? std::strerror(errno) + std::string(".") : "the disk may be full.";
    return WriteError("The file " + file + " cannot be written: " + reason);
  }

  OutputFile::OutputFile(const std::string &file, const std::ios::openmode mode) : name(file)
  {
    errno = 0;
    open(file, mode | std::ios::out);
    if (!*this)
      throw WriteError::of(name);
  }

  void OutputFile::check()
  {
    errno = 0;
    if (!flush())
      throw WriteError::of(name);
    // The number of a file is no criterion: some network file systems change it.
    struct stat found = {};
    if (stat(name.c_str(), &found) != 0 || (S_ISREG(found.st_mode) && found.st_size < tellp()))
      throw WriteError("The file " + name +
                       " was removed or replaced, or its directory renamed, while the program wrote it.");
  }
} // namespace Voussoir
