// SPDX-License-Identifier: GPL-3.0-or-later
#include <boost/crc.hpp>

#include <voussoir/base/error.h>
#include <voussoir/base/output_file.h>
#include <voussoir/output/checkpoint_file.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <unistd.h>
#include <vector>

namespace Voussoir
{
  namespace
  {
    /** CRC-64 of ECMA-182. It detects all changes of up to 64 adjacent bits. */
    using Checksum = boost::crc_optimal<64, 0x42F0E1EBA9EA3693u, 0, 0, false, false>;

    std::string hexadecimal(const Checksum &c)
    {
      char text[17];
      std::snprintf(text, sizeof(text), "%016llx", static_cast<unsigned long long>(c.checksum()));
      return text;
    }

    constexpr const char *format = "voussoir checkpoint 7\n";

    std::string seal(const std::string &payload)
    {
      Checksum c;
      c.process_bytes(payload.data(), payload.size());
      return format + std::to_string(payload.size()) + " " + hexadecimal(c) + "\n";
    }

    /** Returns the payload of a file, or sets the reason @p why it cannot be used. */
    std::string unsealed(const std::string &file, std::string &why)
    {
      std::error_code error;
      std::ifstream   in;
      if (std::filesystem::is_regular_file(file, error))
        in.open(file, std::ios::binary);
      if (!in.is_open())
      {
        why = "it cannot be read";
        return "";
      }
      const std::string whole((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
      const std::size_t first = whole.find('\n'),
                        second = first == std::string::npos ? first : whole.find('\n', first + 1);
      std::string payload = second == std::string::npos ? "" : whole.substr(second + 1);
      if (whole.compare(0, std::strlen("voussoir checkpoint "), "voussoir checkpoint ") == 0 &&
          whole.compare(0, std::strlen(format), format) != 0)
        why = "it is of another version of the program, or damaged";
      else if (second == std::string::npos || whole.compare(0, second + 1, seal(payload)) != 0)
        why = "it is damaged, or of another version of the program";
      return why.empty() ? payload : "";
    }

    /** Writes the buffered contents of a file or directory to the disk. */
    void synchronize(const std::string &file)
    {
      const int  descriptor = open(file.c_str(), O_RDONLY | O_CLOEXEC);
      const bool done =
          descriptor >= 0 && (fsync(descriptor) == 0 || errno == EINVAL); // EINVAL: not supported
      const int reason = errno;
      if (descriptor >= 0)
        close(descriptor);
      errno = reason;
      if (!done)
        throw WriteError::of(file);
    }

    void move_file(const std::string &from, const std::string &to)
    {
      errno = 0;
      if (std::rename(from.c_str(), to.c_str()) != 0)
        throw WriteError::of(to);
    }
  } // namespace

  std::string digest_of_file(const std::string &file)
  {
    std::ifstream     in(file, std::ios::binary);
    std::vector<char> part(1 << 20);
    Checksum          c;
    std::uint64_t     size = 0;
    while (in)
    {
      in.read(part.data(), part.size());
      c.process_bytes(part.data(), in.gcount());
      size += in.gcount();
    }
    if (!in.eof())
      throw InputError("The input file " + file + " cannot be read. Check its permissions and the disk.");
    return std::to_string(size) + " bytes, checksum " + hexadecimal(c);
  }

  void write_checkpoint_file(const std::string &file, const std::string &payload)
  {
    const std::string fresh = file + ".new";
    std::error_code   error;
    try
    {
      OutputFile out(fresh, std::ios::binary);
      out << seal(payload) << payload;
      out.check();
      synchronize(fresh);
    }
    catch (const WriteError &)
    {
      std::filesystem::remove(fresh, error); // incomplete file
      throw;
    }
    if (std::filesystem::exists(file, error))
      move_file(file, file + ".before");
    move_file(fresh, file);
    const std::string directory = std::filesystem::path(file).parent_path().string();
    synchronize(directory.empty() ? "." : directory);
  }

  std::string read_checkpoint_file(const std::string &file, std::string &warning)
  {
    std::string why, why_before;
    std::string payload = unsealed(file, why);
    if (why.empty())
      return payload;
    payload = unsealed(file + ".before", why_before);
    if (!why_before.empty())
      throw InputError("The checkpoint " + file + " cannot be used: " + why + ". The previous one, " + file +
                       ".before, cannot be used either: " + why_before +
                       ". Start again with --overwrite instead of --resume.");
    warning =
        "the checkpoint " + file + " cannot be used: " + why + ". The run continues from the previous one";
    return payload;
  }

  namespace
  {
    /** Returns numbers in a unique format, other text unchanged. */
    std::string normal(const std::string &value)
    {
      char        *end = nullptr, text[40];
      const double number = std::strtod(value.c_str(), &end);
      if (value.empty() || *end != 0)
        return value;
      std::snprintf(text, sizeof(text), "%.15g", number);
      if (std::strtod(text, nullptr) != number)
        std::snprintf(text, sizeof(text), "%.17g", number);
      return text;
    }
  } // namespace

  Provenance decisive_entries(const std::string &scene_text)
  {
    Provenance               entries;
    std::istringstream       in(scene_text);
    std::string              line, path;
    std::vector<std::size_t> lengths; // length of the path outside each subsection
    const auto               trimmed = [](const std::string &s)
    {
      const auto first = s.find_first_not_of(" \t"), last = s.find_last_not_of(" \t");
      return first == std::string::npos ? "" : s.substr(first, last - first + 1);
    };
    while (std::getline(in, line))
    {
      line = trimmed(line.substr(0, line.find('#')));
      if (line.compare(0, 11, "subsection ") == 0)
      {
        lengths.push_back(path.size());
        path += trimmed(line.substr(11)) + "/";
      }
      else if (line == "end" && !lengths.empty())
      {
        path.resize(lengths.back());
        lengths.pop_back();
      }
      else if (const auto equals = line.find('=');
               line.compare(0, 4, "set ") == 0 && equals != std::string::npos)
        entries[path + trimmed(line.substr(4, equals - 4))] = normal(trimmed(line.substr(equals + 1)));
    }
    for (auto entry = entries.begin(); entry != entries.end();)
      if (entry->first.compare(0, 8, "Contact/") == 0 || entry->first == "Motion/Duration" ||
          entry->first == "Output/Checkpoint interval" || entry->first == "Output/Progress interval" ||
          entry->first == "Output/Solution interval" || entry->first == "Output/Frames" ||
          entry->first == "Output/Figures")
        entry = entries.erase(entry);
      else
        ++entry;
    return entries;
  }

  void check_provenance(const Provenance &then, const Provenance &now, const std::string &checkpoint)
  {
    const auto value = [](const Provenance &provenance, const std::string &name)
    {
      const auto found = provenance.find(name);
      return found == provenance.end() ? std::string("absent") : "\"" + found->second + "\"";
    };
    std::string differences;
    Provenance  all = then;
    all.insert(now.begin(), now.end());
    for (const auto &entry : all)
      if (const std::string a = value(then, entry.first), b = value(now, entry.first); a != b)
        differences += (differences.empty() ? "" : "; ") + entry.first + " was " + a + " and is " + b;
    if (!differences.empty())
      throw InputError(
          "The checkpoint " + checkpoint + " belongs to another scene: " + differences +
          ". Restore these values to continue, or start again with --overwrite instead of --resume.");
  }
} // namespace Voussoir
