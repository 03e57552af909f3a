// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/output_file.h>

#include <cerrno>
#include <cstring>

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
  }
} // namespace Voussoir
