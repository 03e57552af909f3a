// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_ground_column_h
#define voussoir_ground_column_h

#include <voussoir/rock/incident_wave.h>
#include <voussoir/rock/rock_damping.h>

#include <vector>

namespace Voussoir
{
  /** Settings that all columns of ground share. */
  struct ColumnRun
  {
    RockDamping  damping;
    double       dt;      ///< time step [s]
    unsigned int n_steps; ///< largest number of steps of the run
    IncidentWave wave;
    double       lowest; ///< height at which the waves enter the lowest column [m]
  };

  /** Motion of horizontally layered ground in a column of nodes. It advances in step with the rock. */
  class GroundColumn
  {
  public:
    virtual ~GroundColumn() = default;

    /** Advances the column by one time step. */
    virtual void advance() = 0;

    /** Returns the displacement at the current time [m].
     * @param level index of the node, from below; -1: one cell below the lowest node
     * @param place x and y count if the waves are oblique [m]
     * @param later time after the current one, from -1 to 1 steps [s]; only for oblique waves */
    virtual Vector3 displacement(int level, const Vector3 &place, double later) const = 0;

    /** Returns the values of a step that another process requires, which calls received() when it has them.
     * */
    virtual std::vector<double> &motion() = 0;
    virtual void                 received() {}

    /** Returns all state variables, for checkpoints. */
    virtual std::vector<std::vector<double> *> state() = 0;
  };
} // namespace Voussoir

#endif
