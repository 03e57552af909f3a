// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_log_h
#define voussoir_log_h

#include <voussoir/base/output_file.h>

#include <chrono>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace Voussoir
{
  /** What the user reads: each line goes to the screen (unless quiet) and to a file once there is one. */
  class Log
  {
  public:
    explicit Log(bool quiet) : quiet(quiet) {}

    /** Also write to this file from now on, with all lines so far. @p append: keep what is in it. Throws
     * WriteError, as line() does when there is a file. */
    void open(const std::string &file, bool append);

    /** printf-style line. */
    void line(const char *format, ...) __attribute__((format(printf, 2, 3)));

    /** What the lines "warning: ..." have said, each once. */
    const std::vector<std::string> &warnings() const { return warned; }

  private:
    const bool                  quiet;
    std::vector<std::string>    warned;
    std::string                 early;
    std::unique_ptr<OutputFile> file;
  };

  /** Wall clock. */
  class Stopwatch
  {
  public:
    Stopwatch() : start(std::chrono::steady_clock::now()) {}
    double seconds() const
    {
      return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    }

  private:
    std::chrono::steady_clock::time_point start;
  };

  /** "1:02:03" or "2:03". */
  std::string clock_time(double seconds);

  /** A JSON object under construction, in the order of the calls. */
  class Json
  {
  public:
    Json &add(const std::string &key, const std::string &text);
    Json &add(const std::string &key, const char *text) { return add(key, std::string(text)); }
    Json &add(const std::string &key, double number);
    Json &add_flag(const std::string &key, const bool value)
    {
      return add_raw(key, value ? "true" : "false");
    }
    Json &add(const std::string &key, const Json &object);
    Json &add_texts(const std::string &key, const std::vector<std::string> &texts); ///< a list
    template <class Numbers> Json &add_list(const std::string &key, const Numbers &numbers)
    {
      std::string list;
      for (const double x : numbers)
        list += (list.empty() ? "" : ", ") + number_text(x);
      return add_raw(key, "[" + list + "]");
    }

    std::string text() const;
    std::string line() const; ///< the same on one line; no objects inside

  private:
    static std::string number_text(double number);
    Json              &add_raw(const std::string &key, const std::string &raw);

    std::vector<std::pair<std::string, std::string>> members;
  };
} // namespace Voussoir

#endif
