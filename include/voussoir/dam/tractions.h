// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_tractions_h
#define voussoir_tractions_h

#include <voussoir/joints/joint_tractions.h>
#include <voussoir/solid/node_faces.h>
#include <voussoir/solid/stress.h>
#include <voussoir/solid/structure.h>

#include <functional>

namespace Voussoir
{
  /** Returns the traction of the static loads on a face at the height z with the outward @p normal [Pa]. */
  using KnownTraction = std::function<Vector3(int surface, double z, const Vector3 &normal)>;

  /** Returns the mean absolute acceleration of all nodes in a step, three values per node [m/s^2].
   *
   * @param v_before, v relative velocities at the start and the end of the step [m/s]
   * @param dt length of the step [s]
   * @param ground_before, ground acceleration of the base at both times [m/s^2] */
  Unknowns mean_acceleration(const Unknowns &v_before, const Unknowns &v, double dt,
                             const Vector3 &ground_before, const Vector3 &ground, double weight = .5);

  /** Known tractions at the nodes of the faces of a dam:
   *  - static loads and hydrodynamic pressure of the added mass on the faces upstream and downstream,
   *  - pair forces divided by the pair areas, and the water pressure, on the joint faces,
   *  - zero on all other faces.
   *
   * At an edge of a joint face, its traction changes by the least shear that gives t_1 n_2 = t_2 n_1 there, in the
   * sense of least squares if edges meet at more than 20 degrees.
   *
   * Tied joints have no faces. Pairs on several planes are excluded: the shares are unknown. */
  class Tractions
  {
  public:
    /** Finds the faces with known tractions.
     *
     * @param model, structure mesh and pairs of the dam
     * @param known traction of the static loads
     * @param initial initial stress per node of the model [Pa], or empty. Its traction is subtracted, because
     * it is added to the recovered stress.
     * @param joint_water water pressure in each pair [Pa], or empty
     * @param water_mass added mass per area at each node of the model: added_mass_per_area(), or empty */
    Tractions(const SolidModel &model, const Structure &structure, const KnownTraction &known,
              const std::vector<Stress> &initial = {}, std::vector<double> joint_water = {},
              const std::vector<double> &water_mass = {});

    std::vector<NodeFace> faces; ///< faces with known tractions, by ascending node

    /** Returns the traction of each face [Pa].
     *
     * @param force joint forces, three values per pair [N]
     * @param acceleration absolute acceleration, three values per free node [m/s^2], or empty: none
     * @param pressure dynamic pressure of acoustic water on the upstream face at each node of the model [Pa], or
     * empty */
    std::vector<Vector3> at(const Unknowns &force, const Unknowns &acceleration = {},
                            const std::vector<double> &pressure = {}) const;

    /** at() of several motions, whose values are neighbours in memory.
     * @param n_motions a multiple of 4
     * @param force joint forces, three components per pair [N]
     * @param acceleration absolute acceleration along the normal of each of wet_faces [m/s^2]; null: none
     * @param result receives three components per face [Pa] */
    void at(unsigned int n_motions, const float *force, const float *acceleration, float *result) const;

    /** Face on which water moves with the dam. */
    struct WetFace
    {
      unsigned int face, free_node;
      double       mass; ///< added mass [kg/m^2]
    };
    std::vector<WetFace> wet_faces; ///< see water_mass

  private:
    struct Edge
    {
      unsigned int joint, other; ///< indices of the faces
      Vector3      gain;         ///< change of the joint's traction by the miss of t_1 n_2 = t_2 n_1
    };
    /** Adds joint forces, and subtracts the initial stresses. */
    template <class Scalar, class Force, class T>
    void add_joints(const Force &force, std::vector<std::array<T, 3>> &traction) const;

    const Structure          &structure;
    JointTractions            joints;
    std::vector<Edge>         edges; ///< common edges of a joint face and another face
    std::vector<unsigned int> pair;  ///< of each face; rigid_ground: no pair
    std::vector<double>       joint_water;
    std::vector<Vector3>      known;   ///< of the static loads
    std::vector<Vector3>      initial; ///< tractions of the initial stresses [Pa]
  };
} // namespace Voussoir

#endif
