// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_block_observer_h
#define voussoir_block_observer_h

#include <voussoir/dam/base_force.h>
#include <voussoir/output/observer.h>
#include <voussoir/output/recorders.h>
#include <voussoir/output/run_state.h>

namespace Voussoir
{
  /** Forces of the foundation on the bases of the monoliths over time (blocks.csv), and the safety against sliding. */
  class BlockObserver : public Observer
  {
  public:
    /** @p run: state after the static state; must outlive the observer. */
    explicit BlockObserver(const RunState &run);
    void follow() override;
    void record() override;
    void report(Log &log) const override;
    void flush() override { file.append(history); }
    void open(const std::string &directory) override { file.open(directory + "/blocks.csv", history); }
    void write_tables(const std::string &) override { flush(); }
    void save(boost::archive::binary_oarchive &archive) const override;
    void load(boost::archive::binary_iarchive &archive) override;

    /** Returns true if the input file has a strength of the base (Limits/Base friction or cohesion), which the
     * safety against sliding requires. */
    bool has_safety() const { return friction > 0. || cohesion > 0.; }

    /** Returns the smallest safety against sliding over time of all monoliths [-]. Its position is the centroid
     * of the base of the monolith. */
    Extreme least_safety() const;

    /** Returns area and extremes of the base of each monolith: "blocks" of summary.json. */
    Json json() const;

  private:
    double safety_of(std::size_t b) const; ///< safety against sliding in the last follow() [-]

    struct Extremes ///< over time, of one monolith
    {
      Extreme                       compression, least_compression, shear, safety;
      template <class Archive> void serialize(Archive &archive, unsigned int)
      {
        archive &compression &least_compression &shear &safety;
      }
    };
    const RunState       &run;
    const double          friction, cohesion; ///< of the base [-], [Pa]
    const BaseForces      forces;
    std::vector<double>   more; ///< uplift in the last step without that of the static state, per base [N]
    std::vector<Wrench>   now;  ///< per base
    std::vector<Extremes> extremes; ///< per base
    Table                 history;
    TableFile             file;
  };
} // namespace Voussoir

#endif
