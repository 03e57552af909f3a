// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_wedge_observer_h
#define voussoir_wedge_observer_h

#include <voussoir/base/log.h>
#include <voussoir/dam/rock_wedge.h>
#include <voussoir/output/observer.h>
#include <voussoir/output/recorders.h>
#include <voussoir/output/run_state.h>

namespace Voussoir
{
  /** Sliding safety of the rock wedges under the abutments over time (wedges.csv).
   *
   * The force on a wedge is the force of the dam on its part of the base, the weight, and the inertia force -m a. The
   * acceleration a is the mean absolute acceleration over the last step of the base nodes on the wedge, weighted by
   * their area: the wedge moves with the dam's base, on every foundation. The uplift on the planes is constant. */
  class WedgeObserver : public Observer
  {
  public:
    /** Finds the parts of the base, and computes the static state. @p run: state after the static state; must outlive
     * the observer. */
    explicit WedgeObserver(const RunState &run);
    void follow() override;
    void record() override;
    void report(Log &log) const override;
    void flush() override { file.append(history); }
    void open(const std::string &directory) override { file.open(directory + "/wedges.csv", history); }
    void write_tables(const std::string &) override { flush(); }
    void save(boost::archive::binary_oarchive &archive) const override;
    void load(boost::archive::binary_iarchive &archive) override;

    /** Returns the smallest safety of all wedges so far [-]. */
    double least_safety() const;

    /** Returns "wedges" of summary.json. */
    Json json() const;

  private:
    /** Forces and safety of a wedge at one time. */
    struct Result
    {
      double                        safety = 0.;    ///< [-]
      double                        time = 0.;      ///< [s]
      Vector3                       force{};        ///< of the dam on the rock [N]
      Vector3                       acceleration{}; ///< of the wedge [m/s^2]
      unsigned int                  mode = 0;       ///< WedgeState::mode()
      template <class Archive> void serialize(Archive &archive, unsigned int)
      {
        archive &safety &time &force &acceleration &mode;
      }
    };
    struct OfWedge
    {
      LoadedWedge wedge;
      BaseForces  forces;
      Result      now, at_start, least;
    };
    Vector3 acceleration_of(const BasePart &part) const;

    const RunState      &run;
    std::vector<OfWedge> wedges;
    Table                history;
    TableFile            file;
  };
} // namespace Voussoir

#endif
