// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_recorders_h
#define voussoir_recorders_h

#include <voussoir/base/output_file.h>
#include <voussoir/dam/dam_geometry.h>
#include <voussoir/dynamics/integrator.h>
#include <voussoir/joints/joint_reach.h>
#include <voussoir/output/face_stresses.h>
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
    std::vector<std::string>         columns; ///< names of the columns
    std::vector<std::vector<double>> rows;    ///< rows with one value per column

    /** Writes the table as CSV. @p file: file name. Throws WriteError. */
    void write(const std::string &file) const;

    template <class Archive> void serialize(Archive &archive, unsigned int) { archive &columns &rows; }
  };

  /** CSV file of a table that grows during the run. If the run is killed, the file has the rows so far. */
  class TableFile
  {
  public:
    /** Creates the file with the present rows of @p table. @p name: file name. Throws WriteError. */
    void open(const std::string &name, const Table &table);

    /** Appends the rows of @p table that are not in the file yet. Throws WriteError. */
    void append(const Table &table);

  private:
    std::unique_ptr<OutputFile> file;
    std::size_t                 n_written = 0;
  };

  /** Openings and slips of the joints relative to the grouted state: over time at the crest, and the largest
   * values at all pairs. */
  class JointRecorder
  {
  public:
    /** Prepares the records. Both arguments must outlive the recorder. */
    JointRecorder(const Structure &structure, const DamGeometry &geometry);

    /** Largest openings and slips of one joint at the upstream and the downstream end of its crest. */
    struct Largest
    {
      double opening_upstream = 0., opening_downstream = 0.; ///< largest openings [m]
      double slip_upstream = 0., slip_downstream = 0.;       ///< largest slips [m]
      double time = 0.;                                      ///< time of the largest opening [s]

      /** Returns the larger opening of both ends [m]. */
      double                        opening() const { return std::max(opening_upstream, opening_downstream); }
      template <class Archive> void serialize(Archive &archive, unsigned int)
      {
        archive &opening_upstream &opening_downstream &slip_upstream &slip_downstream &time;
      }
    };

    /** Adds openings, slips and pressures at the present time of @p integrator to the results. */
    void record(const Integrator &integrator);

    /** Returns the table of joints.csv: largest openings and slips of each joint. */
    Table maxima() const;

    /** Returns the table of joint_pressures.csv: largest and mean contact pressures of each joint. */
    Table pressures() const;

    /** Returns the largest contact pressure over time at each node of the model [Pa]; 0 outside of joints. */
    std::vector<float> largest_pressure(const SolidModel &model) const;

    Table       history; ///< rows of joint_history.csv
    Extreme     opening; ///< largest opening of all pairs [m]
    Extreme     slip;    ///< largest slip of all pairs [m]
    JointReach  reach;   ///< movement relative to the element width; the caller sets it before record()
    JointPoints points;  ///< values at all pairs and waterstops; the caller sets it before record()
    KeyForces   keys;    ///< shear forces of the keys; the caller sets it before record()
    std::vector<Largest> largest; ///< largest values of each joint at the crest

    template <class Archive> void serialize(Archive &archive, unsigned int)
    {
      archive &history &opening &slip &reach &points &keys &largest;
      archive &pressure &time_of_pressure                  &sum_of_means;
    }

  private:
    std::array<double, 4> at_crest(const Integrator &integrator, std::size_t joint) const;
    void                  record_pressures(const DynamicState &state);

    const Structure    &structure;
    const DamGeometry  &geometry;
    std::vector<double> pressure, time_of_pressure; ///< largest of each pair [Pa], [s]
    std::vector<double> sum_of_means; ///< mean pressure of each joint, summed over history.rows [Pa]
  };

  /** Returns the contact pressure of a pair, the normal force divided by the tributary area [Pa]. Compression
   * is positive. @p pair: index of the pair. */
  double joint_pressure(const Structure &structure, const DynamicState &state, unsigned int pair);

  /** Largest and smallest principal stresses of each node over time. */
  class EnvelopeRecorder
  {
  public:
    /** Prepares the records.
     * @param recovery computes the stresses; must outlive the recorder
     * @param initial stresses to add to those of the displacements, such as self-weight, one per node [Pa] */
    EnvelopeRecorder(const StressRecovery &recovery, std::vector<Stress> initial);

    /** Records the state whose stresses update the extremes of this rank's nodes. The stresses of several states
     * are computed together, at the latest by gather().
     * @param time present time [s]
     * @param u StaticState::elastic(), three values per free node [m]
     * @param tractions known tractions, as in StressRecovery::apply() */
    void record(double time, const Unknowns &u, const std::vector<Vector3> &tractions);

    /** Updates the principal stresses of a node.
     * @param time present time [s]
     * @param interval Overstress::begin() [s]
     * @param stress its present stress, with the initial one [Pa] */
    void update(std::size_t node, double time, double interval, const Stress &stress);

    /** Completes the extremes, and gathers those of all nodes on every rank. All ranks must call it before they
     * read or archive the extremes. */
    void gather();

    /** Returns an extreme of the nodes on a surface [Pa]; NaN if there are no nodes.
     * @param model mesh of the dam
     * @param surface number of the surface; 0: all nodes
     * @param largest true: largest maximum principal stress; false: smallest minimum principal stress */
    Extreme extreme(const SolidModel &model, int surface, bool largest) const;

    std::vector<float> maximum, minimum;                 ///< extremes of each node over time [Pa]
    std::vector<float> time_of_maximum, time_of_minimum; ///< times of the extremes [s]
    Overstress         overstress; ///< durations of overstress; the caller sets it before record()
    FaceEnvelope       faces; ///< extremes in the directions of the faces; the caller sets it before record()

    template <class Archive> void serialize(Archive &archive, unsigned int)
    {
      if (Archive::is_saving::value)
        evaluate();
      times.clear(); // a loaded archive replaces recorded states
      archive &maximum &minimum &time_of_maximum &time_of_minimum &overstress &faces;
    }

  private:
    void evaluate(); ///< of all recorded states

    const StressRecovery    &recovery;
    std::vector<Stress>      initial;
    std::vector<std::size_t> begin;                         ///< first node of each rank
    std::vector<float>       displacements, face_tractions; ///< see StressView; since the last evaluate()
    std::vector<double>      times;                         ///< of these states [s]
  };

  /** Writer of results on the mesh: VTU files for ParaView, and the developed faces for the figures. */
  class FieldWriter
  {
  public:
    /** Prepares the writer. @p model must outlive the writer. */
    explicit FieldWriter(const SolidModel &model);

    /** Field with one value per node of the model. */
    struct NodalField
    {
      std::string        name;   ///< name in the file
      std::vector<float> values; ///< one value per node of the model
    };

    /** Writes a VTU file.
     * @param file file name
     * @param u displacements, three values per free node [m]; empty: none
     * @param fields other fields
     *
     * Throws WriteError. */
    void write_vtu(const std::string &file, const Unknowns &u, const std::vector<NodalField> &fields) const;

    /** Writes nodes and quadrilaterals of the upstream and downstream faces to faces.csv and faces_cells.csv.
     * @param directory output directory
     * @param geometry geometry of the dam, for the developed positions
     * @param fields columns of faces.csv after the positions
     *
     * Throws WriteError. */
    void write_faces(const std::string &directory, const DamGeometry &geometry,
                     const std::vector<NodalField> &fields) const;

  private:
    const SolidModel &model;
  };
} // namespace Voussoir

#endif
