// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/foundation/region_parameters.h>
#include <voussoir/rock/artificial_boundary.h>
#include <voussoir/rock/boundary_table.h>

#include <algorithm>

namespace Voussoir
{
  RockRegionParameters region_parameters(const FoundationParameters &p, const std::array<double, 3> &centre,
                                         const double dt)
  {
    RockRegionParameters result;
    result.rock.materials = p.materials_by_volume();
    result.rock.nodal_everywhere = p.nodal_everywhere;
    result.rock.nodal_layers = p.nodal_layers;
    if (p.nodal_everywhere) // the boundary requires layers without "Layers at the dam"
      result.rock.nodal_layers = std::max(p.nodal_layers, make_boundary(p.boundary)->n_layers());
    result.rock.layers_at_dam = p.layers_at_dam;
    result.rock.plane_strain = p.plane_strain;
    result.rock.centre = centre;
    result.damping.mass = p.mass_damping;
    result.damping.stiffness = p.stiffness_damping;
    result.damping.quality = p.quality;
    result.dt = dt;
    result.boundary = p.boundary;
    result.free_field = p.free_field;
    result.incidence = {read_incidence(p.incidence), centre};
    return result;
  }
} // namespace Voussoir
