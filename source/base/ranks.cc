// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/error.h>
#include <voussoir/base/ranks.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <fcntl.h>
#include <numeric>
#include <thread>
#include <unistd.h>

#ifdef VOUSSOIR_WITH_MPI
#include <mpi.h>
#endif
#ifdef _OPENMP
#include <omp.h>
#endif

namespace Voussoir
{
  namespace
  {
    unsigned int this_rank = 0, n_ranks = 1;
    std::size_t  messages = 0;

    double waited = 0.; ///< CPU time in messages [s]

    double processor_time()
    {
      timespec now;
      clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
      return double(now.tv_sec) + 1e-9 * double(now.tv_nsec);
    }

    /** Counts the CPU time during its life as time in messages. */
    struct InMessage
    {
      InMessage() : begin(processor_time()) { ++messages; }
      ~InMessage() { waited += processor_time() - begin; }
      const double begin;
    };

#ifdef VOUSSOIR_WITH_MPI
    int screen = STDERR_FILENO; ///< stderr, for messages of this rank only

    template <class T> MPI_Datatype type_of();
    template <> MPI_Datatype        type_of<double>()
    {
      return MPI_DOUBLE;
    }
    template <> MPI_Datatype type_of<float>()
    {
      return MPI_FLOAT;
    }
    template <> MPI_Datatype type_of<unsigned int>()
    {
      return MPI_UNSIGNED;
    }

    template <class T> void gather_any(T *data, const std::vector<std::size_t> &begin)
    {
      if (n_ranks == 1)
        return;
      std::vector<int> n(n_ranks), first(n_ranks);
      for (unsigned int r = 0; r < n_ranks; ++r)
      {
        first[r] = static_cast<int>(begin[r]);
        n[r] = static_cast<int>(begin[r + 1] - begin[r]);
      }
      const InMessage now;
      MPI_Allgatherv(MPI_IN_PLACE, 0, MPI_DATATYPE_NULL, data, n.data(), first.data(), type_of<T>(),
                     MPI_COMM_WORLD);
    }

    template <class T> void broadcast_any(T *data, const std::size_t n, const unsigned int root)
    {
      if (n_ranks == 1)
        return;
      constexpr std::size_t most = 1u << 30; // values per message
      for (std::size_t i = 0; i < n; i += most)
      {
        const InMessage now;
        MPI_Bcast(data + i, static_cast<int>(std::min(most, n - i)), type_of<T>(), root, MPI_COMM_WORLD);
      }
    }

    /** Sets the number of threads to this rank's part of the cores of its machine, unless
     * OMP_NUM_THREADS is set. */
    void share_cores()
    {
#ifdef _OPENMP
      if (std::getenv("OMP_NUM_THREADS") != nullptr)
        return;
      MPI_Comm machine;
      MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &machine);
      int n_on_machine = 1;
      MPI_Comm_size(machine, &n_on_machine);
      MPI_Comm_free(&machine);
      // mpirun may have bound this rank to some of the cores already.
      const int n_cores = static_cast<int>(std::thread::hardware_concurrency());
      omp_set_num_threads(std::max(1, std::min(omp_get_num_procs(), n_cores / n_on_machine)));
#endif
    }

    void any_of(unsigned int &bits)
    {
      const InMessage now;
      MPI_Allreduce(MPI_IN_PLACE, &bits, 1, MPI_UNSIGNED, MPI_BOR, MPI_COMM_WORLD);
    }
#else
    // There is one rank: start() refuses more.
    template <class T> void gather_any(T *, const std::vector<std::size_t> &) {}
    template <class T> void broadcast_any(T *, std::size_t, unsigned int) {}
    void                    any_of(unsigned int &) {}
#endif
  } // namespace

  unsigned int Ranks::rank()
  {
    return this_rank;
  }

  unsigned int Ranks::size()
  {
    return n_ranks;
  }

  std::size_t Ranks::n_messages()
  {
    return messages;
  }

  double Ranks::work()
  {
    return processor_time() - waited;
  }

  std::vector<double> Ranks::of_all(const double value)
  {
    std::vector<double>      result(n_ranks, value);
    std::vector<std::size_t> begin(n_ranks + 1);
    std::iota(begin.begin(), begin.end(), 0);
    gather(result.data(), begin);
    return result;
  }

  void Ranks::gather(double *data, const std::vector<std::size_t> &begin)
  {
    gather_any(data, begin);
  }

  void Ranks::gather(float *data, const std::vector<std::size_t> &begin)
  {
    gather_any(data, begin);
  }

  void Ranks::gather(float *a, float *b, const std::vector<std::size_t> &begin)
  {
    if (n_ranks == 1)
      return;
    std::vector<float>       both(2 * begin.back());
    std::vector<std::size_t> parts(begin);
    for (std::size_t &i : parts)
      i *= 2;
    const auto part = [&](const unsigned int r, const bool second)
    { return both.data() + begin[r] + begin[second ? r + 1 : r]; };
    const std::size_t first = begin[this_rank], n = begin[this_rank + 1] - first;
    std::copy_n(a + first, n, part(this_rank, false));
    std::copy_n(b + first, n, part(this_rank, true));
    gather_any(both.data(), parts);
    for (unsigned int r = 0; r < n_ranks; ++r)
    {
      std::copy_n(part(r, false), begin[r + 1] - begin[r], a + begin[r]);
      std::copy_n(part(r, true), begin[r + 1] - begin[r], b + begin[r]);
    }
  }

  void Ranks::gather(unsigned int *data, const std::vector<std::size_t> &begin)
  {
    gather_any(data, begin);
  }

  void Ranks::broadcast(double *data, const std::size_t n, const unsigned int root)
  {
    broadcast_any(data, n, root);
  }

  void Ranks::broadcast(float *data, const std::size_t n, const unsigned int root)
  {
    broadcast_any(data, n, root);
  }

  unsigned int Ranks::any(unsigned int bits)
  {
    if (n_ranks > 1)
      any_of(bits);
    return bits;
  }

  unsigned int Ranks::first_different(const std::string &text)
  {
    const std::vector<double> digest = of_all(static_cast<unsigned int>(std::hash<std::string>()(text)));
    return std::find_if(digest.begin(), digest.end(), [&](const double d) { return d != digest[0]; }) -
           digest.begin();
  }

  void Ranks::on_first(const std::function<void()> &action)
  {
    std::exception_ptr failure;
    if (is_first())
      try
      {
        action();
      }
      catch (...)
      {
        failure = std::current_exception();
      }
    const bool failed = any(failure ? 1 : 0) != 0;
    if (failure)
      std::rethrow_exception(failure);
    if (failed)
      throw FailedElsewhere();
  }

#ifdef VOUSSOIR_WITH_MPI
  void Ranks::start(const unsigned int n)
  {
    if (n == 1)
      return;
    int provided, rank, size;
    MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided);
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    MPI_Comm_size(MPI_COMM_WORLD, &size);
    if (size != static_cast<int>(n))
    {
      MPI_Finalize();
      throw InputError(
          "The launcher started " + std::to_string(n) + " processes, but MPI reports " +
          std::to_string(size) +
          ". Use the mpirun of the MPI library that the program was built with. With srun, add --mpi=pmix.");
    }
    this_rank = rank;
    n_ranks = size;
    share_cores();
    if (rank > 0)
    {
      screen = dup(STDERR_FILENO);
      if (const int nothing = open("/dev/null", O_WRONLY); nothing >= 0)
      {
        dup2(nothing, STDOUT_FILENO);
        dup2(nothing, STDERR_FILENO);
        close(nothing);
      }
    }
  }

  int Ranks::finish(const int status, const std::string &message)
  {
    if (n_ranks == 1)
      return status;
    MPI_Request request;
    MPI_Ibarrier(MPI_COMM_WORLD, &request);
    constexpr double patience = 20.; // [s] for ranks that reach the same error later
    const auto       begin = std::chrono::steady_clock::now();
    for (int all_here = 0; true;)
    {
      MPI_Test(&request, &all_here, MPI_STATUS_IGNORE);
      if (all_here)
        break;
      std::this_thread::sleep_for(std::chrono::milliseconds(5)); // rank 0 may still draw figures
      const std::chrono::duration<double> waited = std::chrono::steady_clock::now() - begin;
      if (status != 0 && waited.count() > patience)
      {
        if (this_rank > 0 && !message.empty())
          dprintf(screen, "%s (rank %u)\n", message.c_str(), this_rank);
        MPI_Abort(MPI_COMM_WORLD, status);
      }
    }
    int largest = status;
    MPI_Allreduce(MPI_IN_PLACE, &largest, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD);
    MPI_Finalize();
    return largest;
  }

  void Ranks::exchange(float *data, const std::vector<Transfer> &list)
  {
    const bool concerned = std::any_of(
        list.begin(), list.end(), [](const Transfer &t) { return t.from == this_rank || t.to == this_rank; });
    if (!concerned)
      return;
    const InMessage          now;
    std::vector<MPI_Request> requests;
    for (const Transfer &t : list)
      if (t.from == this_rank || t.to == this_rank)
      {
        requests.emplace_back();
        if (t.from == this_rank)
          MPI_Isend(data + t.first, static_cast<int>(t.n), MPI_FLOAT, t.to, 0, MPI_COMM_WORLD,
                    &requests.back());
        else
          MPI_Irecv(data + t.first, static_cast<int>(t.n), MPI_FLOAT, t.from, 0, MPI_COMM_WORLD,
                    &requests.back());
      }
    MPI_Waitall(static_cast<int>(requests.size()), requests.data(), MPI_STATUSES_IGNORE);
  }

  void Ranks::exchange(const std::vector<Message> &list)
  {
    if (list.empty())
      return;
    const InMessage          now;
    std::vector<MPI_Request> requests;
    for (const Message &m : list)
    {
      if (m.n_in > 0)
      {
        requests.emplace_back();
        MPI_Irecv(m.in, static_cast<int>(m.n_in), MPI_DOUBLE, m.rank, 1, MPI_COMM_WORLD, &requests.back());
      }
      if (m.n_out > 0)
      {
        requests.emplace_back();
        MPI_Isend(m.out, static_cast<int>(m.n_out), MPI_DOUBLE, m.rank, 1, MPI_COMM_WORLD, &requests.back());
      }
    }
    MPI_Waitall(static_cast<int>(requests.size()), requests.data(), MPI_STATUSES_IGNORE);
  }
#else
  void Ranks::start(const unsigned int n)
  {
    if (n != 1)
      throw InputError("This program was built without MPI, but the launcher started " + std::to_string(n) +
                       " processes. Start one process, or build with VOUSSOIR_WITH_MPI=ON.");
  }

  int Ranks::finish(const int status, const std::string &)
  {
    return status;
  }

  void Ranks::exchange(float *, const std::vector<Transfer> &) {}
  void Ranks::exchange(const std::vector<Message> &) {}
#endif

  Shares::Shares(const std::vector<double> &weight)
  {
    const unsigned int n = Ranks::size();
    if (n == 1)
      return;
    const double total = std::accumulate(weight.begin(), weight.end(), 0.);
    double       before = 0.;
    for (const double w : weight)
    {
      owners.push_back(std::min<unsigned int>(n - 1, total > 0. ? n * (before + .5 * w) / total : 0.));
      before += w;
    }
    *this = of_owners(owners);
  }

  Shares Shares::of_owners(const std::vector<unsigned int> &owner)
  {
    Shares result;
    if (Ranks::size() == 1)
      return result;
    result.owners = owner;
    for (unsigned int r = 0; r <= Ranks::size(); ++r)
      result.first.push_back(std::lower_bound(owner.begin(), owner.end(), r) - owner.begin());
    return result;
  }
} // namespace Voussoir
