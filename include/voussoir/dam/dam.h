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

#include <set>

namespace Voussoir
{
  /** Dam of an input file: mesh, structure, joints, foundation and static loads. Displacements are relative
   * to the grouted state, in which the monoliths carry their own weight. The stress of this weight is an
   * initial stress. */
  class Dam
  {
  public:
    /** Reads the mesh and assembles the dam. @p tie_all: all joints are tied, for natural frequencies. The @p
     * scene must outlive the object. Throws InputError if mesh and input file do not fit. */
    explicit Dam(const Scene &scene, bool tie_all = false);

    /** Returns FoundationSite::one_body. @p tied: all joints are tied. */
    static bool is_one_body(const Scene &scene, bool tied);

    /** Returns true if the base nodes are fixed. */
    bool base_is_held() const { return lowest_base.empty(); }

    /** Returns the mean displacement of the lowest base nodes [m], or zero if the base is fixed. */
    Vector3 base_motion(const Unknowns &u) const;

    const Scene          &scene;
    std::vector<Material> materials;                  ///< of the concrete, by zone of the mesh
    std::vector<Zone>     concrete_zones, rock_zones; ///< zones of the mesh
    std::string           groups;                     ///< table of the mesh groups: group_table()
    std::string           ungrouped;                  ///< faces_without_group()

    std::vector<std::string> mesh_warnings; ///< see Voussoir::mesh_warnings()
    std::size_t              n_cells = 0;
    unsigned int             n_monoliths = 0, n_joints = 0;
    double volume = 0., crest_length = 0., size = 0.; ///< [m^3], [m], diagonal of the bounding box [m]
    std::unique_ptr<SolidModel>  model;
    Structure                    structure;
    JointLaws                    laws;
    std::unique_ptr<DamGeometry> geometry;
    std::unique_ptr<Foundation>  foundation;
    std::vector<Neighbour *>     neighbours; ///< in the order of their calls; the first is the foundation
    std::vector<StaticLoad>      loads;
    std::array<Unknowns, 3>      inertia;         ///< load per unit base acceleration [N s^2/m]
    double                       added_mass = 0.; ///< for motion along x [kg]
    std::vector<Stress>          initial_stress;  ///< per node of the model [Pa]
    Vector3 self_weight_crown = {{0., 0., 0.}};   ///< crown displacement of staged weight [m]
    bool    has_water = false;                    ///< true: water on the upstream face
    bool    tied = false;                         ///< true: all joints are tied, without pairs

  private:
    HexMesh open_monoliths(const HexMesh &mesh, const std::string &source);
    void    choose_laws(bool tie_all);
    void    assemble(const HexMesh &opened, const std::string &source);
    void    tie_base();
    void    remove_base_pairs(std::vector<Pair> &pairs) const;

    std::set<unsigned int> nodes_of_base() const; ///< equation numbers
    void                   add_loads();
    void                   check_water_level();
    void                   stage_self_weight();
    void                   find_lowest_base();

    std::vector<unsigned int> lowest_base; ///< free nodes at the lowest height of the base
  };
} // namespace Voussoir

#endif
