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
  /** The writing end between two processes of one program: plain numbers, vectors of them, texts. */
  class PipeWriter
  {
  public:
    explicit PipeWriter(const int descriptor) : descriptor(descriptor) {}

    /** Throws std::runtime_error if nobody reads any more. */
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

  /** The reading end: in the order in which it was written. Throws PipeReader::End where it ends too early.
   */
  class PipeReader
  {
  public:
    struct End : std::runtime_error
    {
      End() : std::runtime_error("the other process ended too early") {}
    };

    /** @p seconds: how long to wait for the other process, altogether. */
    PipeReader(int descriptor, double seconds);

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
    /** Grows in pieces: a size that the other process, gone wild, made up is not believed. */
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
    const double deadline; ///< of the steady clock [s]
  };

  /** What a child process may use. */
  struct GuardLimits
  {
    double cpu_seconds; ///< CPU time [s]; ten times that by the clock on the wall
    double memory;      ///< beyond what the program has when the child starts [byte]
  };

  /** Limits for reading a file of @p size bytes by a library: 10 s and 5 s per MB, 4 GB and 100 bytes per
   * byte. */
  GuardLimits limits_for_file(double size);

  /** Runs @p work in a child process, for libraries that crash, end the program or never end on bad files:
   *  whatever happens to the child does not touch the program. Then @p send, in the child, puts the results
   * into a pipe, and @p receive, here, gets them out of it in the same order. The child's output (stdout,
   * stderr) is dropped. An InputError or ComputationError of @p work is thrown here again. If
   * the child dies, ends by itself, or exceeds its limits, throws InputError: "@p problem: " and the reason.
   *  @p work must not use threads: only the calling one exists in the child. */
  void run_guarded(const std::string &problem, const GuardLimits &limits, const std::function<void()> &work,
                   const std::function<void(PipeWriter &)> &send,
                   const std::function<void(PipeReader &)> &receive);
} // namespace Voussoir

#endif
