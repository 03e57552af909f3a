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
  /** The processes of one run, as mpirun starts them: rank 0 speaks and writes the files, all make the same
   *  decisions. Each does its share of the work, and what it has made is copied to the others, never added
   * up over ranks: so results do not depend on their number, to the last bit. A program that was started
   * alone is rank 0 of 1; then nothing here calls MPI. */
  namespace Ranks
  {
    unsigned int rank();
    unsigned int size();
    inline bool  is_first()
    {
      return rank() == 0;
    }

    /** Makes this process one of @p n, by MPI; others than the first lose their screen. InputError if MPI
     * does not know of so many. */
    void start(unsigned int n);

    /** To be called once at the end by all. With status 0 it waits for all others. With an error, that ranks
     * meet at the same place or one alone does, it waits for some seconds: then @p message is told, if this
     * is the only rank to tell it, and all others are ended. Returns the largest status. */
    int finish(int status, const std::string &message);

    /** @p data from begin[r] to begin[r + 1] is what rank r has made: all get all of it. */
    void gather(double *data, const std::vector<std::size_t> &begin);
    void gather(float *data, const std::vector<std::size_t> &begin);
    void gather(float *a, float *b, const std::vector<std::size_t> &begin); ///< of two in one message
    void gather(unsigned int *data, const std::vector<std::size_t> &begin);

    void broadcast(double *data, std::size_t n, unsigned int root);
    void broadcast(float *data, std::size_t n, unsigned int root);

    /** The or of all ranks' @p bits. */
    unsigned int any(unsigned int bits);

    /** Have all ranks the same @p text? */
    bool have_same(const std::string &text);

    /** Messages of this process so far; one call counts once. */
    std::size_t n_messages();

    /** Processor time of this process so far, but for that in messages, which is mostly waiting [s]. */
    double work();

    /** @p value of each rank. */
    std::vector<double> of_all(double value);

    /** The first rank has ended with an error: no message is due from here. */
    class FailedElsewhere : public std::exception
    {
    public:
      const char *what() const noexcept override { return "another process has failed"; }
    };

    /** @p action by the first rank; its exceptions end the others, too. To be called by all at once. */
    void on_first(const std::function<void()> &action);

    /** Parts of a value that moves between two ranks. */
    struct Transfer
    {
      unsigned int item; ///< whose part it is, for those who ask
      std::size_t  first, n;
      unsigned int from, to;
    };

    /** To and from another rank. */
    struct Message
    {
      unsigned int  rank;
      const double *out;
      std::size_t   n_out;
      double       *in;
      std::size_t   n_in;
    };

    /** All at once; both sides must name each other. */
    void exchange(const std::vector<Message> &list);

    /** @p list: the same on all ranks; those who are concerned move their parts of @p data. */
    void exchange(float *data, const std::vector<Transfer> &list);
  } // namespace Ranks

  /** Who makes what: items in contiguous parts, one of each rank. */
  class Shares
  {
  public:
    Shares() = default;

    /** Parts of about the same sum of @p weight, of each item. */
    explicit Shares(const std::vector<double> &weight);

    /** With the owner of each item, which must ascend. */
    static Shares of_owners(const std::vector<unsigned int> &owner);

    /** All items are everybody's: nothing is shared. */
    bool         are_trivial() const { return owners.empty(); }
    unsigned int owner(const unsigned int item) const
    {
      return owners.empty() ? Ranks::rank() : owners[item];
    }
    bool is_mine(const unsigned int item) const { return owner(item) == Ranks::rank(); }

    /** Where the parts begin in an array that has @p offset of the items. */
    template <class Offsets> std::vector<std::size_t> parts(const Offsets &offset) const
    {
      std::vector<std::size_t> result;
      for (const unsigned int i : first)
        result.push_back(offset[i]);
      return result;
    }

  private:
    std::vector<unsigned int> owners; ///< of the items; empty with one rank
    std::vector<unsigned int> first;  ///< item of each rank
  };
} // namespace Voussoir

#endif
