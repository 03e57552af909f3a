// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_dam_h
#define voussoir_dam_h

#include <voussoir/dam/dam_facts.h>
#include <voussoir/dam/dam_geometry.h>
#include <voussoir/dam/force_history.h>
#include <voussoir/dam/joint_layout.h>
#include <voussoir/dam/load_table.h>
#include <voussoir/dam/scene.h>
#include <voussoir/dam/staged_weight.h>
#include <voussoir/foundation/foundation.h>
#include <voussoir/joints/joint_system.h>
#include <voussoir/solid/solid_model.h>
#include <voussoir/solid/stress.h>
#include <voussoir/water/acoustic_water.h>

namespace Voussoir
{
  /** Dam of an input file: mesh, structure, joints, foundation and static loads. Displacements are relative
   * to the grouted state, in which the monoliths carry their own weight. The stress of this weight is an
   * initial stress. */
  class Dam
  {
  public:
    /** Reads the mesh and assembles the dam. Must be called by all ranks.
     * @param scene input file; must outlive the object
     * @param tie_all true: all joints are tied, for natural frequencies
     *
     * Throws InputError for an invalid mesh, or if mesh and input file do not fit. Throws ComputationError if
     * a stiffness matrix cannot be factorised. */
    explicit Dam(const Scene &scene, bool tie_all = false);

    /** Returns FoundationSite::one_body for the input file. @p tied: true if all joints are tied. */
    static bool is_one_body(const Scene &scene, bool tied);

    /** Returns true if any monolith stands on a base joint that is not tied. */
    bool has_base_joints() const { return layout.has_open_bases; }

    /** Returns true if only joints hold some blocks: a base or lift joint is not tied, or a body has no base node. */
    bool has_loose_blocks() const
    {
      return layout.has_open_bases || layout.has_open_lifts || has_free_bodies;
    }

    /** Returns true if the lowest base nodes are fixed. */
    bool base_is_held() const { return lowest_base.empty(); }

    /** Returns the mean displacement x, y, z of the lowest base nodes, within 1 mm of the lowest height [m].
     * It is zero if these nodes are fixed. @p u: displacement, three values per free node [m]. */
    Vector3 base_motion(const Unknowns &u) const;

    /** Returns the velocities of "Dynamics/Initial velocity", three values per free node [m/s]. Throws InputError for a
     * block that the mesh does not have. */
    Unknowns initial_velocity() const;

    /** Returns true if concrete or rock has other moduli in the static state than in the earthquake. */
    bool has_sustained_moduli() const;

    /** Returns true if a pair is tied, by the model of its joint or by the foundation. */
    bool is_tied(std::size_t pair) const;

    /** Returns the structure of the static state: #structure with the sustained moduli. */
    Structure sustained_structure() const;

    /** Sets the damping of the structure. @p first_frequency: as in DampingParameters::law() [Hz]. */
    void set_damping(double first_frequency);

    const Scene             &scene;      ///< input file
    std::vector<std::string> zone_names; ///< HexMesh::zones
    std::vector<Material>    materials;  ///< of the concrete, one per entry of HexMesh::zones
    std::vector<Material>    damped;     ///< the same materials for Body::damped
    std::vector<Material>    sustained;  ///< the same materials with the moduli of the static state

    DamFacts    facts;  ///< for log and reports
    JointLayout layout; ///< joints and their laws

    double size = 0.; ///< diagonal of the bounding box of the concrete [m]

    std::unique_ptr<SolidModel> model;     ///< finite element mesh, and numbers of the free nodes
    Structure                   structure; ///< stiffness, mass and pairs of the free nodes

    std::unique_ptr<DamGeometry>   geometry;      ///< crest, crown and upper ends of the joints
    std::unique_ptr<Foundation>    foundation;    ///< foundation under the base
    std::unique_ptr<AcousticWater> water;         ///< compressible water, or null
    std::shared_ptr<const HexMesh> water_volumes; ///< HexMesh::water
    std::vector<Neighbour *>       neighbours; ///< in the order of their calls; the first is the foundation
    std::vector<StaticLoad>        loads;      ///< active static loads, with the factors of their combination
    std::vector<ForceInTime>       forces;     ///< with the factor of the load combination

    /** Inertia loads per unit base acceleration in x, y and z: minus the mass matrix, with added mass and
     * without rock, times the unit vector. Three values per free node [N s^2/m]. */
    std::array<Unknowns, 3> inertia;

    /** Stress at zero displacement, by staged self-weight and initial strains. One value per node of the
     * model, also of fixed nodes [Pa]. */
    std::vector<Stress> initial_stress;

    StagedWeight staged; ///< state under staged self-weight

    bool has_free_bodies = false; ///< true: a body has no node on the base

    bool has_water = false; ///< true: water pressure on the upstream face, from the reservoir

  private:
    HexMesh open_monoliths(const HexMesh &mesh, const std::string &source);
    void    assemble(const HexMesh &opened, const std::string &source);
    void    open_base_joints();
    void    find_weight_on_joints();

    Unknowns uplift_at_base() const;
    void     remove_base_pairs(std::vector<Pair> &pairs) const;

    std::set<unsigned int> nodes_of_base() const; ///< equation numbers
    void                   add_loads();
    void                   check_water_level();
    void                   find_lowest_base();

    std::vector<unsigned int> lowest_base;   ///< free nodes at the lowest height of the base
    std::vector<double>       share_of_base; ///< their weights in base_motion(); each place counts once
    Unknowns weight_on_joints; ///< of base and lift joints: staged weight per free node [N], or empty
  };
} // namespace Voussoir

#endif
