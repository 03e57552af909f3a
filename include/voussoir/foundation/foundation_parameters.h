// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_foundation_parameters_h
#define voussoir_foundation_parameters_h

#include <voussoir/mesh/mesh.h>
#include <voussoir/solid/zones.h>

#include <string>

namespace Voussoir
{
  class Entries;

  /** Subsection "Foundation". */
  struct FoundationParameters
  {
    std::string  model = "rigid";        ///< or rock, massless
    Material     rock{15e9, .25, 2700.}; ///< where no zone says otherwise
    ZoneEntry    zones;
    double       mass_damping = 0., stiffness_damping = 2e-5; ///< Rayleigh [1/s], [s]
    std::string  boundary = "mtf3", free_field = "sections";
    bool         nodal_everywhere = true;
    unsigned int nodal_layers = 6;
    unsigned int layers_at_dam = 3;
    unsigned int substeps = 1;      ///< of the rock in each step of the dam
    std::string  coupling = "auto"; ///< or mean traction, partition

    static constexpr double largest_poisson = .45; ///< of rock

    /** Does the rock make steps of its own, coupled by mean tractions? */
    bool has_own_steps() const { return coupling == "mean traction" || (coupling == "auto" && substeps > 1); }

    void add_parameters(Entries &prm);

    /** Of the zones, by name. Throws InputError as zone_materials(). */
    std::map<std::string, Material> zone_materials() const;

    /** Of the rock's volumes in the mesh of volumes_by_material(), by their ids. */
    std::map<int, Material> materials_by_volume() const;

    /** The mesh with one volume of rock for each material. */
    HexMesh volumes_by_material(const HexMesh &mesh) const;

  private:
    int volume_of(const std::string &zone) const;
  };
} // namespace Voussoir

#endif
