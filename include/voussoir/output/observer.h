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

  /** Part of the results of a run. An observer reads the state of the run after each step.
   *
   *  The time loop calls the members in this order. At the start: start() or load() on all ranks, then open()
   *  on the first rank. In each step: follow() on all ranks, then record() and flush() on the first rank. At
   *  the end: gather_on_root() on all ranks, then write_tables(), finish() and report() on the first rank.
   *  open(), flush(), write_tables() and finish() throw WriteError. */
  class Observer
  {
  public:
    virtual ~Observer() = default;

    /** Reads the static state. All ranks; not called if the run is resumed. */
    virtual void start() {}

    /** Reads the state after a step. All ranks. */
    virtual void follow() {}

    /** Adds the results of the present time to the tables in memory. First rank; also at the start, if the
     *  run is not resumed. Throws ComputationError if the results are unusable (StabilityObserver). */
    virtual void record() {}

    /** Appends the rows that record() added since the last call to the files of open(). First rank. */
    virtual void flush() {}

    /** Sends the results of all ranks to the first rank. Called on all ranks before save(), write_tables()
     *  and finish(). After a ComputationError, write_tables() follows without this call. */
    virtual void gather_on_root() {}

    /** Creates the files that grow during the run in the existing output directory. Writes the rows so far,
     *  those of load() in a resumed run. First rank. */
    virtual void open(const std::string & /*directory*/) {}

    /** Writes the tables so far to the output directory, also when the run is interrupted or fails. May be
     *  called again. First rank. */
    virtual void write_tables(const std::string & /*directory*/) {}

    /** Writes the results that exist only at the end of a run to the output directory, and warnings about
     *  them to the log. Called once, after the last write_tables(). First rank. */
    virtual void finish(const std::string & /*directory*/, Log & /*log*/) {}

    /** Writes the main results to the log, after finish() of all observers. First rank. */
    virtual void report(Log & /*log*/) const {}

    /** Writes the state of the observer to a checkpoint. First rank, after gather_on_root(). */
    virtual void save(boost::archive::binary_oarchive & /*archive*/) const {}

    /** Restores the state of the observer from a checkpoint, in the order of save(). All ranks, instead of
     *  start(). */
    virtual void load(boost::archive::binary_iarchive & /*archive*/) {}
  };
} // namespace Voussoir

#endif
