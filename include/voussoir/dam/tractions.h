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

  /** The tractions on the faces of a dam, at their nodes: the known ones of static loads on the faces
   * upstream and downstream (that of the moving water is not in it), the forces of the pairs over their areas
   * at the joints with the pressure of water in them, none on all other faces. Tied joints are no faces;
   * where planes of a joint meet at an edge the share of each is not known. */
  class Tractions
  {
  public:
    /** @p initial: stresses that come to those of the displacements, one per node of the model, or empty:
     * their part is taken away, so that it is the sum that has the tractions [Pa]. @p joint_water: pressure
     * of the water in each pair [Pa], or empty. */
    Tractions(const SolidModel &model, const Structure &structure, const KnownTraction &known,
              const std::vector<Stress> &initial = {}, std::vector<double> joint_water = {});

    std::vector<NodeFace> faces; ///< those whose tractions are known, ascending in their nodes

    /** One for each of the faces, with the forces of the pairs @p force, 3 per pair [N]; result [Pa]. */
    const std::vector<Vector3> &at(const Unknowns &force);

  private:
    struct Edge
    {
      unsigned int joint, other; ///< faces
    };
    void meet(const Edge &edge);

    const Structure          &structure;
    JointTractions            joints;
    std::vector<Edge>         edges; ///< where a joint and another face meet
    std::vector<unsigned int> pair;  ///< of each face; rigid_ground: none
    std::vector<double>       joint_water;
    std::vector<Vector3>      traction; ///< those without pair stay
    std::vector<Vector3>      initial;  ///< of the initial stresses
    std::vector<Vector3>      result;
  };
} // namespace Voussoir

#endif
