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
  /** What loads put on a face at the height z, whose outward normal is given [Pa]. */
  using KnownTraction = std::function<Vector3(int surface, double z, const Vector3 &normal)>;

  /** Of all nodes over a step of @p dt, from their velocities before and after it, and that of the base that
   * they count from, at both times [m/s^2]. */
  Unknowns mean_acceleration(const Unknowns &v_before, const Unknowns &v, double dt,
                             const Vector3 &ground_before, const Vector3 &ground);

  /** The tractions on the faces of a dam, at their nodes: the known ones of static loads on the faces
   * upstream and downstream, that of the water that moves with the dam, the forces of the pairs over their
   * areas at the joints with the pressure of water in them, none on all other faces. Tied joints are no
   * faces; where planes of a joint meet at an edge the share of each is not known. */
  class Tractions
  {
  public:
    /** @p initial: stresses that come to those of the displacements, one per node of the model, or empty:
     * their part is taken away, so that it is the sum that has the tractions [Pa]. @p joint_water: pressure
     * of the water in each pair [Pa], or empty. @p water_mass: of the water that moves with the dam, per
     * area, one per node of the model [kg/m^2], or empty: added_mass_per_area(). */
    Tractions(const SolidModel &model, const Structure &structure, const KnownTraction &known,
              const std::vector<Stress> &initial = {}, std::vector<double> joint_water = {},
              const std::vector<double> &water_mass = {});

    std::vector<NodeFace> faces; ///< those whose tractions are known, ascending in their nodes

    /** One for each of the faces, with the forces of the pairs @p force, 3 per pair [N], and @p acceleration
     * of the free nodes, that of the base included, 3 per node [m/s^2], or empty: none; result [Pa]. */
    const std::vector<Vector3> &at(const Unknowns &force, const Unknowns &acceleration = {});

  private:
    struct Edge
    {
      unsigned int joint, other; ///< faces
    };
    void add_moving_water(const Unknowns &acceleration);
    void meet(const Edge &edge);

    const Structure          &structure;
    JointTractions            joints;
    std::vector<Edge>         edges; ///< where a joint and another face meet
    std::vector<unsigned int> pair;  ///< of each face; rigid_ground: none
    std::vector<double>       joint_water;
    std::vector<Vector3>      known;      ///< of the static loads
    std::vector<double>       water_mass; ///< on each face [kg/m^2]
    std::vector<unsigned int> free_node;  ///< of each face
    std::vector<Vector3>      traction;
    std::vector<Vector3>      initial; ///< of the initial stresses
    std::vector<Vector3>      result;
  };
} // namespace Voussoir

#endif
