// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_foundation_parameters_h
#define voussoir_foundation_parameters_h

#include <algorithm>
#include <voussoir/mesh/mesh.h>
#include <voussoir/solid/zones.h>

#include <string>

namespace Voussoir
{
  class Entries;
  struct ModelChoices;

  /** Parameters of the subsection "Foundation" of the input file. */
  struct FoundationParameters
  {
    std::string  model = "rigid";                             ///< rigid, rock or massless
    Material     rock{15e9, .25, 2700.};                      ///< of rock without an entry in @p zones
    double       sustained = 0.;                              ///< sustained modulus [Pa]; 0: rock.young
    ZoneEntry    zones;                                       ///< materials of named rock volumes
    double       mass_damping = 0., stiffness_damping = 2e-5; ///< Rayleigh damping [1/s], [s]
    double       quality = 0.;                                ///< quality factor [-]; 0: none
    std::string  boundary = "mtf3", free_field = "sections";  ///< see boundary_table.h; sections or columns
    std::string  incidence = "vertical";                      ///< see read_incidence()
    bool         nodal_everywhere = true;                     ///< nodal quadrature, except at the dam
    unsigned int nodal_layers = 6;     ///< element layers of nodal quadrature at the artificial boundary
    unsigned int layers_at_dam = 3;    ///< element layers with the dam's quadrature at the base
    bool         ignores_rock = false; ///< the mesh has rock that the model does not use
    unsigned int substeps = 0; ///< rock time steps per time step of the dam; 0: from the critical time step
    std::string  coupling = "auto";    ///< auto, mean traction or partition; Dam: common step
    bool         plane_strain = false; ///< no displacements along y; set by Dam

    static constexpr double largest_poisson = .45; ///< upper limit of Poisson's ratio of rock [-]

    /** Returns the number of rock time steps per time step of the dam; 1 before Simulation has set it. */
    unsigned int n_substeps() const { return std::max(1u, substeps); }

    /** Returns the ratio of sustained and Young's modulus, for all zones of the rock [-]. */
    double sustained_ratio() const { return sustained > 0. ? sustained / rock.young : 1.; }

    /** Returns true if the rock is subcycled with a constant force per time step of the dam (SubcycledRock).
     * */
    bool is_subcycled() const { return coupling == "mean traction" || (coupling == "auto" && substeps > 1); }

    /** Declares the entries of the subsection. */
    void add_parameters(Entries &prm);

    /** Adds the changes of the foundation. */
    void add_choices(ModelChoices &choices) const;

    /** Returns the materials of the zones by name. Throws the InputErrors of Voussoir::zone_materials(). */
    std::map<std::string, Material> zone_materials() const;

    /** Returns the materials of the rock volumes in the mesh of volumes_by_material(), by volume id. Throws
     * the same errors. */
    std::map<int, Material> materials_by_volume() const;

    /** Returns a copy of @p mesh with one rock volume per material. Monoliths are unchanged. Throws the same
     * errors. */
    HexMesh volumes_by_material(const HexMesh &mesh) const;

  private:
    void add_materials(Entries &prm);

    /** Returns the volume id of a zone. Zones of equal material have the same id. */
    int volume_of(const std::string &zone) const;
  };

  // From the rows of foundation_table.cc.

  /** Returns the names of all foundations as a selection of ParameterHandler: "rigid|rock|massless". */
  std::string foundation_names();

  /** Returns the help texts of all foundations, for the entry "Foundation/Model". */
  std::string foundation_docs();

  /** Returns whether the foundation uses the entry, such as "Foundation/Density". */
  bool foundation_reads(const std::string &model, const std::string &entry);
} // namespace Voussoir

#endif
