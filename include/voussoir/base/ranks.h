// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_ranks_h
#define voussoir_ranks_h

#include <cstddef>
#include <exception>
#include <functional>
#include <string>
#include <vector>

namespace Voussoir
{
  /** MPI processes (ranks) of one run. Rank 0 prints and writes the files; all ranks take the same decisions.
   * Each rank computes a part, and its results are copied to the others without sums over ranks. Results are
   * therefore bitwise identical for any number of ranks. A program started without mpirun is rank 0 of 1 and
   * makes no MPI calls. */
  namespace Ranks
  {
    unsigned int rank(); ///< returns the number of this process
    unsigned int size(); ///< returns the number of processes
    inline bool  is_first()
    {
      return rank() == 0;
    }

    /** Initialises MPI for @p n processes. Ranks above 0 print nothing from then on. Throws InputError if MPI
     * reports another number of processes. */
    void start(unsigned int n);

    /** Ends MPI. All ranks call it once, at the end. With status 0 it waits for all other ranks. With an
     * error it waits 20 s for ranks that fail with the same error. If a rank is still missing then, rank > 0
     * prints @p message and all ranks are ended. Returns the largest status of all ranks. */
    int finish(int status, const std::string &message);

    /** Distributes an array of which each rank has computed a part. Entries begin[r] to begin[r+1] - 1 of
     * @p data are those of rank r. All ranks receive all entries. */
    void gather(double *data, const std::vector<std::size_t> &begin);
    void gather(float *data, const std::vector<std::size_t> &begin);
    void gather(float *a, float *b, const std::vector<std::size_t> &begin); ///< two arrays in one message
    void gather(unsigned int *data, const std::vector<std::size_t> &begin);

    /** Copies the @p n entries of @p data from rank @p root to all ranks. */
    void broadcast(double *data, std::size_t n, unsigned int root);
    void broadcast(float *data, std::size_t n, unsigned int root);

    /** Returns the bitwise or of @p bits over all ranks. */
    unsigned int any(unsigned int bits);

    /** Returns the first rank whose @p text differs from that of rank 0 (compared by a hash). Returns size()
     * if there is none. */
    unsigned int first_different(const std::string &text);

    /** Returns the number of messages (MPI calls) of this process so far. */
    std::size_t n_messages();

    /** Returns the CPU time of this process so far, without the time in messages, which is
     * mostly waiting [s]. */
    double work();

    /** Returns the @p value of each rank. */
    std::vector<double> of_all(double value);

    /** Exception on ranks above 0 after a failure of rank 0. Rank 0 prints the message. */
    class FailedElsewhere : public std::exception
    {
    public:
      const char *what() const noexcept override { return "another process has failed"; }
    };

    /** Runs @p action on rank 0 while the other ranks wait. All ranks must call it. Rank 0 throws the
     * exception of @p action again; the other ranks then throw FailedElsewhere. */
    void on_first(const std::function<void()> &action);

    /** Part of an array that moves from one rank to another. */
    struct Transfer
    {
      unsigned int item;     ///< number of the item in the part; for the caller only
      std::size_t  first, n; ///< first entry and number of entries of the part
      unsigned int from, to; ///< ranks
    };

    /** Data that this rank sends to and receives from another rank. */
    struct Message
    {
      unsigned int  rank; ///< the other rank
      const double *out;
      std::size_t   n_out; ///< number of values sent
      double       *in;
      std::size_t   n_in; ///< number of values received
    };

    /** Sends and receives all messages of @p list. Both ranks of a message must list each other. */
    void exchange(const std::vector<Message> &list);

    /** Moves the parts of @p data in @p list between their ranks. The list must be the same on all ranks. */
    void exchange(float *data, const std::vector<Transfer> &list);
  } // namespace Ranks

  /** Distribution of items over the ranks. Each rank owns a contiguous range of items. */
  class Shares
  {
  public:
    Shares() = default;

    /** Distributes items so that each rank has about the same sum of @p weight (one value per item). */
    explicit Shares(const std::vector<double> &weight);

    /** Returns the distribution with the given @p owner of each item. The owners must ascend. */
    static Shares of_owners(const std::vector<unsigned int> &owner);

    /** Returns whether there is a single rank, which owns all items. */
    bool         are_trivial() const { return owners.empty(); }
    unsigned int owner(const unsigned int item) const
    {
      return owners.empty() ? Ranks::rank() : owners[item];
    }
    bool is_mine(const unsigned int item) const { return owner(item) == Ranks::rank(); }

    /** Returns the beginning of each rank's part, and the end, in an array. @p offset: beginning of each item
     * in that array, and the end. */
    template <class Offsets> std::vector<std::size_t> parts(const Offsets &offset) const
    {
      std::vector<std::size_t> result;
      for (const unsigned int i : first)
        result.push_back(offset[i]);
      return result;
    }

  private:
    std::vector<unsigned int> owners; ///< rank of each item; empty with one rank
    std::vector<unsigned int> first;  ///< first item of each rank, and the end
  };
} // namespace Voussoir

#endif
