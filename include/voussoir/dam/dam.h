// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_dam_h
#define voussoir_dam_h

#include <voussoir/dam/dam_geometry.h>
#include <voussoir/dam/load_table.h>
#include <voussoir/dam/scene.h>
#include <voussoir/foundation/foundation.h>
#include <voussoir/joints/joint_system.h>
#include <voussoir/solid/solid_model.h>
#include <voussoir/solid/stress.h>
#include <voussoir/water/acoustic_water.h>

#include <set>

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
    bool has_base_joints() const { return has_open_bases; }

    /** Returns true if a base or lift joint is not tied, so that only joints hold some blocks. */
    bool has_loose_blocks() const { return has_open_bases || has_open_lifts; }

    /** Returns true if the lowest base nodes are fixed. */
    bool base_is_held() const { return lowest_base.empty(); }

    /** Returns the mean displacement x, y, z of the lowest base nodes, within 1 mm of the lowest height [m].
     * It is zero if these nodes are fixed. @p u: displacement, three values per free node [m]. */
    Vector3 base_motion(const Unknowns &u) const;

    /** Returns true if concrete or rock has other moduli in the static state than in the earthquake. */
    bool has_sustained_moduli() const;

    /** Returns the indices in #joints of the joints with this number, name or kind. Throws InputError if there are
     * none; @p what is the beginning of the message. */
    std::vector<std::size_t> joints_named(const std::string &key, const std::string &what) const;

    /** Returns true if the joint of a pair is cast, not grouted: a base or lift joint. */
    bool is_cast(const Pair &pair) const { return !joints[pair.joint].is_contraction(); }

    /** Returns true if a pair is tied, by the model of its joint or by the foundation. */
    bool is_tied(std::size_t pair) const;

    /** Returns the structure of the static state: #structure with the sustained moduli. */
    Structure sustained_structure() const;

    const Scene          &scene;          ///< input file
    std::vector<Material> materials;      ///< of the concrete, one per entry of HexMesh::zones
    std::vector<Material> sustained;      ///< the same materials with the moduli of the static state
    std::vector<Zone>     concrete_zones; ///< zones of the monoliths
    std::vector<Zone>     rock_zones;     ///< zones of the rock; empty for a rigid foundation
    std::string           groups;         ///< table of the mesh groups: group_table()
    std::string           ungrouped;      ///< faces_without_group()

    std::vector<std::string> mesh_warnings;     ///< see Voussoir::mesh_warnings()
    std::size_t              n_cells = 0;       ///< number of concrete elements
    unsigned int             n_monoliths = 0;   ///< number of monoliths
    unsigned int             n_joints = 0;      ///< number of contraction joints, also if they are tied
    std::vector<Joint>       joints;            ///< all joints, by number
    std::vector<std::string> joint_models;      ///< names of the laws of #joints
    std::vector<double>      initial_gaps;      ///< of #joints [m]
    double                   volume = 0.;       ///< of the concrete [m^3]
    double                   crest_length = 0.; ///< see Voussoir::crest_length() [m]
    double                   size = 0.;         ///< diagonal of the bounding box of the concrete [m]

    std::unique_ptr<SolidModel> model;     ///< finite element mesh, and numbers of the free nodes
    Structure                   structure; ///< stiffness, mass and pairs of the free nodes

    /** Laws of all pairs. JointLaws::of_joint has the law of each joint, then the law of tied pairs at the
     * base. */
    JointLaws laws;

    std::unique_ptr<DamGeometry>   geometry;      ///< crest, crown and upper ends of the joints
    std::unique_ptr<Foundation>    foundation;    ///< foundation under the base
    std::unique_ptr<AcousticWater> water;         ///< compressible water, or null
    std::shared_ptr<const HexMesh> water_volumes; ///< HexMesh::water
    std::vector<Neighbour *>       neighbours; ///< in the order of their calls; the first is the foundation
    std::vector<StaticLoad>        loads;      ///< active static loads, with the factors of their combination

    /** Inertia loads per unit base acceleration in x, y and z: minus the mass matrix, with added mass and
     * without rock, times the unit vector. Three values per free node [N s^2/m]. */
    std::array<Unknowns, 3> inertia;

    double added_mass = 0.; ///< total hydrodynamic added mass for motion along x [kg]; 0 without water

    /** Stress at zero displacement, by staged self-weight and initial strains. One value per node of the
     * model, also of fixed nodes [Pa]. */
    std::vector<Stress> initial_stress;

    /** Displacement of the crown under staged self-weight, x, y, z [m]. It precedes grouting and is not
     * included in other displacements. */
    Vector3 self_weight_crown = {{0., 0., 0.}};

    /** Force on each node of the model under staged self-weight, three values per node: of the foundation, and of the
     * other block at lift joints; zero elsewhere. Empty without staged self-weight [N]. */
    Unknowns staged_reaction;

    bool has_water = false; ///< true: water pressure on the upstream face, from the reservoir
    bool tied = false;      ///< true: all joints are tied, without pairs

  private:
    HexMesh open_monoliths(const HexMesh &mesh, const std::string &source, bool tie_all);

    void choose_laws(bool tie_all);
    void assemble(const HexMesh &opened, const std::string &source);
    void tie_base(bool tie_all);
    void open_base_joints();
    void cross_joints();
    void find_weight_on_joints();

    Unknowns uplift_at_base() const;
    void     remove_base_pairs(std::vector<Pair> &pairs) const;

    std::set<unsigned int> nodes_of_base() const; ///< equation numbers
    void                   add_loads();
    void                   check_water_level();
    void                   stage_self_weight();
    void                   find_staged_reaction(double weight, const Unknowns &u);
    void                   find_lowest_base();

    std::set<std::string>
        merged_lifts; ///< keys of all joints, if lifts were merged because all lift joints are tied

    bool has_open_bases = false, has_open_lifts = false; ///< joints that are not tied

    std::vector<unsigned int> lowest_base; ///< free nodes at the lowest height of the base
    Unknowns weight_on_joints; ///< of base and lift joints: staged weight per free node [N], or empty
  };
} // namespace Voussoir

#endif
