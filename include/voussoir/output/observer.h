// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_observer_h
#define voussoir_observer_h

#include <string>

namespace boost::archive
{
  class binary_iarchive;
  class binary_oarchive;
} // namespace boost::archive

namespace Voussoir
{
  class Log;

  /** Part of the results of a run: it reads the run's state after each step and keeps what it needs.
   *
   *  The time loop calls, in this order: start() or load() on all ranks, open() on the first; then per step
   *  follow() on all ranks, record() and flush() on the first; at the end gather_on_root() on all ranks, and
   *  write_tables(), finish() and report() on the first. open(), flush(), write_tables() and finish() throw
   *  WriteError. */
  class Observer
  {
  public:
    virtual ~Observer() = default;

    /** Reads the static state, unless the run is resumed. All ranks. */
    virtual void start() {}

    /** Reads the state after a step. All ranks. */
    virtual void follow() {}

    /** Adds the present time to the results in memory. First rank; at the start, too. */
    virtual void record() {}

    /** Appends to the files what record() added. First rank. */
    virtual void flush() {}

    /** Sends to the first rank what the others have. All ranks; before save(), write_tables(), finish(). */
    virtual void gather_on_root() {}

    /** Creates the files that grow with the run, with the rows so far. First rank. */
    virtual void open(const std::string & /*directory*/) {}

    /** Writes the tables so far, also when a run is stopped. First rank. */
    virtual void write_tables(const std::string & /*directory*/) {}

    /** Writes what exists at the end only, with warnings about it. First rank. */
    virtual void finish(const std::string & /*directory*/, Log & /*log*/) {}

    /** Prints the results that matter most. First rank. */
    virtual void report(Log & /*log*/) const {}

    /** Writes the state of the observer to a checkpoint, or restores it. */
    virtual void save(boost::archive::binary_oarchive & /*archive*/) const {}
    virtual void load(boost::archive::binary_iarchive & /*archive*/) {}
  };
} // namespace Voussoir

#endif
