// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_dam_facts_h
#define voussoir_dam_facts_h

#include <voussoir/solid/zones.h>

namespace Voussoir
{
  /** What only log, summary and report tell about a dam. */
  struct DamFacts
  {
    std::vector<Zone>        concrete_zones;    ///< zones of the monoliths
    std::vector<Zone>        rock_zones;        ///< zones of the rock; empty for a rigid foundation
    std::string              groups;            ///< table of the mesh groups: group_table()
    std::string              ungrouped;         ///< faces_without_group()
    std::vector<std::string> warnings;          ///< of the mesh, see mesh_warnings(), and of the reservoir
    std::string              remark;            ///< HexMesh::remark
    std::size_t              n_cells = 0;       ///< number of concrete elements
    unsigned int             n_monoliths = 0;   ///< number of monoliths
    double                   volume = 0.;       ///< of the concrete [m^3]
    double                   crest_length = 0.; ///< see Voussoir::crest_length() [m]
    std::vector<double> frequencies; ///< first of the tied dam with its water [Hz]; only for uniform damping
    double      critical_step = 0.; ///< critical step of the dam for the explicit scheme [s]; 0: not computed
    std::string critical_place;     ///< place with the largest motion in the highest mode
    double      added_mass = 0.;    ///< total for motion along x [kg]; 0 without water
  };
} // namespace Voussoir

#endif
