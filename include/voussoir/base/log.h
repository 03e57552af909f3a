// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_log_h
#define voussoir_log_h

#include <voussoir/base/output_file.h>
#include <voussoir/base/warning.h>

#include <chrono>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace Voussoir
{
  /** Log of a run. Each line is printed to stdout (unless quiet) and appended to a file after open(). */
  class Log
  {
  public:
    explicit Log(bool quiet) : quiet(quiet) {}

    /** Opens the log file and writes all earlier lines to it.
     * @param file name of the file
     * @param append whether to keep the present content of the file
     *
     * Throws WriteError. After open(), line() throws it as well. */
    void open(const std::string &file, bool append);

    /** Adds a line. The arguments are those of printf, without the newline. A line "warning: TEXT" is a warning
     * about physics. */
    void line(const char *format, ...) __attribute__((format(printf, 2, 3)));

    /** Adds the line "warning: TEXT". */
    void warn(const Warning &warning);

    /** Returns the warnings so far, without repetition. */
    const std::vector<Warning> &warnings() const { return warned; }

  private:
    const bool                  quiet;
    std::vector<Warning>        warned;
    std::string                 early;
    std::unique_ptr<OutputFile> file;
  };

  /** Elapsed time since construction. */
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

  /** Returns the time as "1:02:03" (hours, minutes, seconds) or "2:03".
   * @param seconds time [s] */
  std::string clock_time(double seconds);

  /** JSON object under construction. The members keep the order of the calls. Numbers that are not finite are
   * written as null. */
  class Json
  {
  public:
    /** Adds a member: a string, a number or an object. All functions return the object itself. */
    Json &add(const std::string &key, const std::string &text);
    Json &add(const std::string &key, const char *text) { return add(key, std::string(text)); }
    Json &add(const std::string &key, double number);

    /** Adds true or false. */
    Json &add_flag(const std::string &key, const bool value)
    {
      return add_raw(key, value ? "true" : "false");
    }
    Json &add(const std::string &key, const Json &object);
    Json &add(const std::string &key, const std::vector<Json> &objects);            ///< adds a list
    Json &add(const std::string &key, const std::vector<Warning> &warnings);        ///< adds a list
    Json &add_texts(const std::string &key, const std::vector<std::string> &texts); ///< adds a list

    /** Adds a list of numbers. */
    template <class Numbers> Json &add_list(const std::string &key, const Numbers &numbers)
    {
      std::string list;
      for (const double x : numbers)
        list += (list.empty() ? "" : ", ") + number_text(x);
      return add_raw(key, "[" + list + "]");
    }

    std::string text() const; ///< returns the object with one member per line
    std::string line() const; ///< returns the object on one line; it must not contain other objects

  private:
    static std::string number_text(double number);
    Json              &add_raw(const std::string &key, const std::string &raw);

    std::vector<std::pair<std::string, std::string>> members;
  };
} // namespace Voussoir

#endif
