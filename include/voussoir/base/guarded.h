// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_guarded_h
#define voussoir_guarded_h

#include <cstddef>
#include <functional>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

namespace Voussoir
{
  /** Writing end of a pipe between two processes of the same program. Transfers numbers, vectors of
   * numbers and strings. */
  class PipeWriter
  {
  public:
    explicit PipeWriter(const int descriptor) : descriptor(descriptor) {}

    /** Writes @p n bytes. Throws std::runtime_error if the reading end is closed. */
    void put(const void *bytes, std::size_t n);

    template <typename Number> void put(const Number number)
    {
      static_assert(std::is_trivially_copyable_v<Number>);
      put(&number, sizeof(number));
    }
    template <typename Entry> void put(const std::vector<Entry> &vector)
    {
      static_assert(std::is_trivially_copyable_v<Entry>);
      put(vector.size());
      put(vector.data(), vector.size() * sizeof(Entry));
    }
    void put(const std::string &text)
    {
      put(text.size());
      put(text.data(), text.size());
    }

  private:
    const int descriptor;
  };

  /** Reading end of a pipe. Values must be read in the order in which they were written. All get() functions
   * throw PipeReader::End if the data end too early or the time limit is exceeded. */
  class PipeReader
  {
  public:
    /** Exception: the writer ended before all data had arrived, or the time limit was exceeded. */
    struct End : std::runtime_error
    {
      End() : std::runtime_error("the other process ended too early") {}
    };

    /** @param descriptor file descriptor of the pipe, not owned
     * @param seconds time limit for all reads together [s] */
    PipeReader(int descriptor, double seconds);

    /** Reads @p n bytes. */
    void get(void *bytes, std::size_t n);

    template <typename Number> void get(Number &number)
    {
      static_assert(std::is_trivially_copyable_v<Number>);
      get(&number, sizeof(number));
    }
    template <typename Entry> void get(std::vector<Entry> &vector)
    {
      static_assert(std::is_trivially_copyable_v<Entry>);
      get_sized(vector);
    }
    void get(std::string &text) { get_sized(text); }

  private:
    /** Reads a size and the entries after it. The container grows in pieces, since a crashing writer may send
     * a wrong size. */
    template <typename Container> void get_sized(Container &container)
    {
      constexpr std::size_t piece = 1 << 20;
      std::size_t           size = 0;
      get(size);
      container.clear();
      for (std::size_t done = 0; done < size;)
      {
        const std::size_t n = size - done < piece ? size - done : piece;
        if (container.capacity() < done + n)
          container.reserve(done + n < size / 2 ? 2 * (done + n) : size);
        container.resize(done + n);
        get(&container[done], n * sizeof(container[0]));
        done += n;
      }
    }

    const int    descriptor;
    const double deadline; ///< time limit, on the steady clock [s]
  };

  /** Resource limits of a child process. */
  struct GuardLimits
  {
    double cpu_seconds; ///< CPU time [s]; the elapsed time may be ten times as long
    double memory; ///< address space in addition to that of the program at the start of the child [bytes]
  };

  /** Returns the limits for reading a file of @p size bytes with a library: 10 s + 5 s per MB, and 4 GB + 100
   * bytes per byte. */
  GuardLimits limits_for_file(double size);

  /** Runs @p work in an isolated child process. A library that crashes, exits or does not end on a damaged
   * file then leaves the program intact. The child's stdout and stderr are discarded.
   *
   * @param problem beginning of the message of an error
   * @param limits CPU time and memory of the child
   * @param work task of the child; it must not use threads, because the child has only the calling one
   * @param send writes the results into a pipe, in the child
   * @param receive reads the results from the pipe in the same order, in this process
   *
   * Throws the InputError or ComputationError of @p work in this process. Throws InputError ("@p problem: "
   * and the reason) if the child crashes, exits or exceeds its limits, or on another exception of @p work. */
  void run_guarded(const std::string &problem, const GuardLimits &limits, const std::function<void()> &work,
                   const std::function<void(PipeWriter &)> &send,
                   const std::function<void(PipeReader &)> &receive);
} // namespace Voussoir

#endif
