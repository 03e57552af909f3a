// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/log.h>

#include <algorithm>
#include <cmath>
#include <cstdarg>
#include <cstdio>

namespace Voussoir
{
  void Log::open(const std::string &name, const bool append)
  {
    file = std::make_unique<OutputFile>(name, append ? std::ios::app : std::ios::trunc);
    *file << early;
    file->check();
  }

  void Log::line(const char *format, ...)
  {
    std::va_list arguments, again;
    va_start(arguments, format);
    va_copy(again, arguments);
    std::string buffer(std::max(0, std::vsnprintf(nullptr, 0, format, arguments)) + 1, '\0');
    std::vsnprintf(&buffer[0], buffer.size(), format, again);
    va_end(again);
    va_end(arguments);
    buffer.pop_back();
    const std::string sign = "warning: ";
    if (buffer.compare(0, sign.size(), sign) == 0 &&
        std::none_of(warned.begin(), warned.end(),
                     [&](const Warning &other) { return buffer.substr(sign.size()) == other.text; }))
      warned.push_back({Warning::Kind::physics, buffer.substr(sign.size()), ""});
    if (!quiet)
    {
      std::printf("%s\n", buffer.c_str());
      std::fflush(stdout);
    }
    if (file)
    {
      *file << buffer << '\n';
      file->check();
    }
    else
      early += buffer + "\n";
  }

  void Log::warn(const Warning &warning)
  {
    const std::size_t before = warned.size();
    line("warning: %s", warning.text.c_str());
    if (warned.size() > before)
      warned.back() = warning;
  }

  std::string clock_time(const double seconds)
  {
    const long s = std::lround(seconds);
    char       buffer[40];
    if (s >= 3600)
      std::snprintf(buffer, sizeof(buffer), "%ld:%02ld:%02ld", s / 3600, s / 60 % 60, s % 60);
    else
      std::snprintf(buffer, sizeof(buffer), "%ld:%02ld", s / 60, s % 60);
    return buffer;
  }

  std::string Json::number_text(const double number)
  {
    if (!std::isfinite(number))
      return "null";
    char buffer[40];
    std::snprintf(buffer, sizeof(buffer),
                  number == std::floor(number) && std::abs(number) < 1e15 ? "%.0f" : "%.9g", number);
    return buffer;
  }

  Json &Json::add_raw(const std::string &key, const std::string &raw)
  {
    members.emplace_back(key, raw);
    return *this;
  }

  namespace
  {
    /** Returns the number of bytes of the UTF-8 character at @p i; 0 if it is invalid. */
    std::size_t utf8_length(const std::string &text, const std::size_t i)
    {
      const auto byte = [&](const std::size_t k) -> unsigned char { return k < text.size() ? text[k] : 0; };
      const auto n = byte(i) < 0x80   ? 1u
                     : byte(i) < 0xC2 ? 0u
                     : byte(i) < 0xE0 ? 2u
                     : byte(i) < 0xF0 ? 3u
                     : byte(i) < 0xF5 ? 4u
                                      : 0u;
      for (std::size_t k = 1; k < n; ++k)
        if (byte(i + k) >> 6 != 2)
          return 0;
      return n;
    }

    std::string quoted_text(const std::string &text)
    {
      std::string quoted = "\"";
      for (std::size_t i = 0, n; i < text.size(); i += std::max<std::size_t>(n, 1))
      {
        const char c = text[i];
        char       code[8];
        n = utf8_length(text, i);
        if (c == '"' || c == '\\')
          (quoted += '\\') += c;
        else if (static_cast<unsigned char>(c) < 0x20)
        {
          std::snprintf(code, sizeof(code), "\\u%04x", c);
          quoted += code;
        }
        else
          quoted += n > 0 ? text.substr(i, n) : "\\ufffd"; // names of files need not be UTF-8
      }
      return quoted + "\"";
    }
  } // namespace

  Json &Json::add(const std::string &key, const std::string &text)
  {
    return add_raw(key, quoted_text(text));
  }

  Json &Json::add_texts(const std::string &key, const std::vector<std::string> &texts)
  {
    std::string list;
    for (const std::string &text : texts)
      list += (list.empty() ? "" : ", ") + quoted_text(text);
    return add_raw(key, "[" + list + "]");
  }

  Json &Json::add(const std::string &key, const double number)
  {
    return add_raw(key, number_text(number));
  }

  Json &Json::add(const std::string &key, const Json &object)
  {
    return add_raw(key, object.text());
  }

  Json &Json::add(const std::string &key, const std::vector<Json> &objects)
  {
    std::string list;
    for (const Json &object : objects)
      list += (list.empty() ? "" : ", ") + object.text();
    return add_raw(key, "[" + list + "]");
  }

  Json &Json::add(const std::string &key, const std::vector<Warning> &warnings)
  {
    std::vector<Json> objects;
    for (const Warning &warning : warnings)
      objects.push_back(Json()
                            .add("class", warning.kind == Warning::Kind::input ? "input" : "physics")
                            .add("text", warning.text)
                            .add("place", warning.place));
    return add(key, objects);
  }

  std::string Json::text() const
  {
    std::string result = "{";
    for (const auto &member : members)
    {
      std::string value = member.second; // indent all lines of the value
      for (std::size_t i = 0; (i = value.find('\n', i)) != std::string::npos; i += 3)
        value.insert(i + 1, "  ");
      result += (result.size() > 1 ? ",\n  " : "\n  ") + quoted_text(member.first) + ": " + value;
    }
    return result + (members.empty() ? "}" : "\n}");
  }

  std::string Json::line() const
  {
    std::string result = "{";
    for (const auto &member : members)
      result += (result.size() > 1 ? ", " : "") + quoted_text(member.first) + ": " + member.second;
    return result + "}";
  }
} // namespace Voussoir
