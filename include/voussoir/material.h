#ifndef voussoir_material_h
#define voussoir_material_h

namespace Voussoir
{
  struct Material
  {
    double young = 21e9, poisson = .17, density = 2400.; ///< [Pa], [-], [kg/m^3]
  };
} // namespace Voussoir

#endif
