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

    /** Adds the results of the present time to the tables in memory. First rank; also at the start. */
    virtual void record() {}

    /** Appends the rows that record() added to the files. First rank. */
    virtual void flush() {}

    /** Sends the results of all ranks to the first rank. Called on all ranks before save(), write_tables()
     *  and finish(). */
    virtual void gather_on_root() {}

    /** Creates the files that grow during the run, with the rows so far. First rank. */
    virtual void open(const std::string & /*directory*/) {}

    /** Writes the tables so far, also when the run is interrupted. First rank. */
    virtual void write_tables(const std::string & /*directory*/) {}

    /** Writes the results that exist only at the end of a run, and warnings about them. First rank. */
    virtual void finish(const std::string & /*directory*/, Log & /*log*/) {}

    /** Prints the main results. First rank. */
    virtual void report(Log & /*log*/) const {}

    /** Writes the state of the observer to a checkpoint. */
    virtual void save(boost::archive::binary_oarchive & /*archive*/) const {}

    /** Restores the state of the observer from a checkpoint. */
    virtual void load(boost::archive::binary_iarchive & /*archive*/) {}
  };
} // namespace Voussoir

#endif
