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
  /** Rows of numbers under named columns; written as CSV. */
  struct Table
  {
    std::vector<std::string>         columns;
    std::vector<std::vector<double>> rows;

    void write(const std::string &file) const; ///< throws WriteError

    template <class Archive> void serialize(Archive &archive, unsigned int) { archive &columns &rows; }
  };

  /** The file of a table that grows with the run, so that a run that is killed leaves what it had. */
  class TableFile
  {
  public:
    void open(const std::string &name, const Table &table); ///< with the rows so far; throws WriteError
    void append(const Table &table); ///< the rows that the file does not have yet; throws WriteError

  private:
    std::unique_ptr<OutputFile> file;
    std::size_t                 n_written = 0;
  };

  /** Openings and slips of the joints: at the crest over time, and the largest anywhere. Opening and slip are
   * counted from the grouted state. */
  class JointRecorder
  {
  public:
    JointRecorder(const Structure &structure, const DamGeometry &geometry);

    /** Of one joint at the crest over time, upstream and downstream [m]; when it was open most [s]. */
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

    void  record(const Newmark &newmark);
    Table maxima() const;    ///< joints.csv
    Table pressures() const; ///< joint_pressures.csv

    /** The largest pressure over time at the nodes of the joints, one per node of the model, 0 elsewhere
     * [Pa]. */
    std::vector<float> largest_pressure(const SolidModel &model) const;

    Table                history; ///< joint_history.csv
    Extreme              opening, slip;
    JointReach           reach;   ///< counts from when it is set
    JointPoints          points;  ///< the same
    KeyForces            keys;    ///< the same
    std::vector<Largest> largest; ///< per joint

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
    std::vector<double> sum_of_means;               ///< of each joint's mean pressure, over history.rows [Pa]
  };

  /** Normal force of a pair over its area, compression > 0 [Pa]. */
  double joint_pressure(const Structure &structure, const DynamicState &state, unsigned int pair);

  /** Largest and smallest principal stress of every node over time. */
  class EnvelopeRecorder
  {
  public:
    /** @p initial: stresses to add to those of the displacements (self-weight), one per node. */
    EnvelopeRecorder(const StressRecovery &recovery, std::vector<Stress> initial);

    /** @p tractions: as StressRecovery::apply(). */
    void record(double time, const Unknowns &u, const std::vector<Vector3> &tractions);

    /** With several ranks each records its share of the nodes; after this all have all. */
    void collect();

    /** The largest of the maxima (or the smallest of the minima) of the nodes on a surface, 0: of all nodes.
     */
    Extreme extreme(const SolidModel &model, int surface, bool largest) const;

    std::vector<float> maximum, minimum, time_of_maximum, time_of_minimum; ///< per node [Pa], [s]
    Overstress         overstress;                                         ///< counts from when it is set

    template <class Archive> void serialize(Archive &archive, unsigned int)
    {
      archive &maximum &minimum &time_of_maximum &time_of_minimum &overstress;
    }

  private:
    const StressRecovery    &recovery;
    std::vector<Stress>      initial, stress;
    std::vector<std::size_t> begin; ///< node of each rank
  };

  /** Writes results on the mesh: VTU files for ParaView, and the developed faces for the figures. */
  class FieldWriter
  {
  public:
    explicit FieldWriter(const SolidModel &model);

    struct NodalField
    {
      std::string        name;
      std::vector<float> values; ///< one per node
    };

    /** One VTU file. @p u: 3 per free node, or empty. */
    void write_vtu(const std::string &file, const Unknowns &u, const std::vector<NodalField> &fields) const;

    /** faces.csv and faces_cells.csv: the nodes and quadrilaterals of the upstream and downstream faces. */
    void write_faces(const std::string &directory, const DamGeometry &geometry,
                     const std::vector<float> &maximum, const std::vector<float> &minimum) const;

  private:
    const SolidModel &model;
  };
} // namespace Voussoir

#endif
