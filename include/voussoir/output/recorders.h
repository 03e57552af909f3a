// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_recorders_h
#define voussoir_recorders_h

#include <voussoir/base/output_file.h>
#include <voussoir/dam/dam_geometry.h>
#include <voussoir/dynamics/newmark.h>
#include <voussoir/joints/joint_reach.h>
#include <voussoir/output/joint_points.h>
#include <voussoir/output/key_forces.h>
#include <voussoir/output/overstress.h>
#include <voussoir/solid/stress.h>

#include <algorithm>
#include <array>
#include <memory>
#include <string>

namespace Voussoir
{
  /** Table of numbers with named columns. */
  struct Table
  {
    std::vector<std::string>         columns;
    std::vector<std::vector<double>> rows;

    /** Writes the table as CSV. Throws WriteError. */
    void write(const std::string &file) const;

    template <class Archive> void serialize(Archive &archive, unsigned int) { archive &columns &rows; }
  };

  /** CSV file of a table that grows during the run. If the run is killed, the file has the rows so far. */
  class TableFile
  {
  public:
    /** Creates the file with the rows so far. Throws WriteError. */
    void open(const std::string &name, const Table &table);

    /** Appends the rows that are not in the file yet. Throws WriteError. */
    void append(const Table &table);

  private:
    std::unique_ptr<OutputFile> file;
    std::size_t                 n_written = 0;
  };

  /** Openings and slips of the joints, at the crest over time and the largest anywhere. Openings and slips
   * are relative to the grouted state. */
  class JointRecorder
  {
  public:
    /** Both arguments must outlive the recorder. */
    JointRecorder(const Structure &structure, const DamGeometry &geometry);

    /** Largest openings and slips of one joint at the crest [m], and the time of the largest opening [s]. */
    struct Largest
    {
      double opening_upstream = 0., opening_downstream = 0., slip_upstream = 0., slip_downstream = 0.,
             time = 0.;
      double                        opening() const { return std::max(opening_upstream, opening_downstream); }
      template <class Archive> void serialize(Archive &archive, unsigned int)
      {
        archive &opening_upstream &opening_downstream &slip_upstream &slip_downstream &time;
      }
    };

    /** Adds the present openings, slips and pressures to the results. */
    void record(const Newmark &newmark);

    /** Returns the largest openings and slips of each joint: joints.csv. */
    Table maxima() const;

    /** Returns the largest and mean contact pressures of each joint: joint_pressures.csv. */
    Table pressures() const;

    /** Returns the largest contact pressure over time at each node of the model [Pa], 0 outside of joints. */
    std::vector<float> largest_pressure(const SolidModel &model) const;

    Table                history;       ///< rows of joint_history.csv
    Extreme              opening, slip; ///< largest anywhere [m]
    JointReach           reach;         ///< records once it is set
    JointPoints          points;        ///< records once it is set
    KeyForces            keys;          ///< records once it is set
    std::vector<Largest> largest;       ///< per joint

    template <class Archive> void serialize(Archive &archive, unsigned int)
    {
      archive &history &opening &slip &reach &points &keys &largest;
      archive &pressure &time_of_pressure                  &sum_of_means;
    }

  private:
    std::array<double, 4> at_crest(const Newmark &newmark, std::size_t joint) const;
    void                  record_pressures(const DynamicState &state);

    const Structure    &structure;
    const DamGeometry  &geometry;
    std::vector<double> pressure, time_of_pressure; ///< largest of each pair [Pa], [s]
    std::vector<double> sum_of_means; ///< mean pressure of each joint, summed over history.rows [Pa]
  };

  /** Returns the contact pressure of a pair, the normal force per area, compression > 0 [Pa]. */
  double joint_pressure(const Structure &structure, const DynamicState &state, unsigned int pair);

  /** Largest and smallest principal stresses of each node over time. */
  class EnvelopeRecorder
  {
  public:
    /** @p initial: stresses to add to those of the displacements (self-weight), one per node. */
    EnvelopeRecorder(const StressRecovery &recovery, std::vector<Stress> initial);

    /** Computes the stresses of this rank's nodes and updates their extremes. @p time: time [s]. @p u:
     * displacements, 3 per node [m]. @p tractions: as in StressRecovery::apply(). */
    void record(double time, const Unknowns &u, const std::vector<Vector3> &tractions);

    /** Gathers the extremes of all nodes on every rank. All ranks: record() covers the nodes of one rank. */
    void gather_on_root();

    /** Returns the largest maximum, or the smallest minimum, of the nodes on a surface [Pa]. Surface 0: all
     * nodes. NaN: no nodes. */
    Extreme extreme(const SolidModel &model, int surface, bool largest) const;

    std::vector<float> maximum, minimum, time_of_maximum, time_of_minimum; ///< per node [Pa], [s]
    Overstress         overstress;                                         ///< records once it is set

    template <class Archive> void serialize(Archive &archive, unsigned int)
    {
      archive &maximum &minimum &time_of_maximum &time_of_minimum &overstress;
    }

  private:
    const StressRecovery    &recovery;
    std::vector<Stress>      initial, stress;
    std::vector<std::size_t> begin; ///< first node of each rank
  };

  /** Writer of results on the mesh: VTU files for ParaView, and the developed faces for the figures. */
  class FieldWriter
  {
  public:
    /** @p model must outlive the writer. */
    explicit FieldWriter(const SolidModel &model);

    /** Field with one value per node of the model. */
    struct NodalField
    {
      std::string        name;
      std::vector<float> values;
    };

    /** Writes a VTU file. @p u: displacements, 3 per free node [m], or empty. Throws WriteError. */
    void write_vtu(const std::string &file, const Unknowns &u, const std::vector<NodalField> &fields) const;

    /** Writes nodes and quadrilaterals of the upstream and downstream faces to faces.csv and
     * faces_cells.csv. @p maximum, @p minimum: principal stresses of the nodes [Pa]. Throws WriteError. */
    void write_faces(const std::string &directory, const DamGeometry &geometry,
                     const std::vector<float> &maximum, const std::vector<float> &minimum) const;

  private:
    const SolidModel &model;
  };
} // namespace Voussoir

#endif
