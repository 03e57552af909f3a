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

#include <optional>
#include <set>

namespace Voussoir
{
  /** The dam of a scene, ready to compute: mesh, structure, joints, loads. Displacements count from the
   * grouted state, in which the monoliths carry their own weight; that weight's stress is kept apart and
   * added to all others. */
  class Dam
  {
  public:
    /** @p tie_all: the monolithic dam, whatever the joint models say (for natural frequencies). */
    explicit Dam(const Scene &scene, bool tie_all = false);

    /** Must monoliths on massless rock be one body (FoundationSite::one_body)? @p tied: are all joints? */
    static bool is_one_body(const Scene &scene, bool tied);

    bool base_is_held() const { return lowest_base.empty(); } ///< does the dam stand on rigid ground?

    /** Mean displacement of the lowest part of the base, zero where it is held [m]. */
    Vector3 base_motion(const Unknowns &u) const;

    const Scene          &scene;
    std::vector<Material> materials;                  ///< of the concrete, by zone of the mesh
    std::vector<Zone>     concrete_zones, rock_zones; ///< those that the mesh has
    std::string           groups;                     ///< table of the mesh's groups: group_table()
    std::string           ungrouped;                  ///< faces_without_group()

    std::vector<std::string> mesh_warnings; ///< a sentence for each limit of the mesh that the scene exceeds
    std::size_t              n_cells = 0;
    unsigned int             n_monoliths = 0, n_joints = 0;
    double volume = 0., crest_length = 0., size = 0.; ///< [m^3], [m], diagonal of the bounding box [m]
    std::unique_ptr<SolidModel>  model;
    Structure                    structure;
    JointLaws                    laws;
    std::unique_ptr<DamGeometry> geometry;
    std::unique_ptr<Foundation>  foundation;
    std::vector<StaticLoad>      loads;
    std::array<Unknowns, 3>      inertia;         ///< load per unit base acceleration
    double                       added_mass = 0.; ///< for motion along x [kg]
    std::vector<Stress>          initial_stress;  ///< of staged weight and temperature, per node of the model
    Vector3                      self_weight_crown = {{0., 0., 0.}}; ///< displacement of the crown by it [m]
    bool                         has_water = false; ///< does the water reach the upstream face?
    bool                         tied = false;      ///< all joints: there are no pairs

  private:
    HexMesh open_monoliths(const HexMesh &mesh, const std::string &source);
    void    choose_laws(bool tie_all);
    void    assemble(const HexMesh &opened);
    void    tie_feet();
    void    remove_feet(std::vector<Pair> &pairs) const;

    std::set<unsigned int> nodes_of_base() const; ///< their equations
    void                   add_loads();
    void                   check_water_level();
    void                   stage_self_weight();
    void                   find_lowest_base();

    std::vector<unsigned int> lowest_base; ///< free nodes there
  };
} // namespace Voussoir

#endif
