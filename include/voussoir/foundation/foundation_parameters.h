#ifndef voussoir_foundation_parameters_h
#define voussoir_foundation_parameters_h

#include <voussoir/solid/material.h>

#include <string>

namespace dealii
{
  class ParameterHandler;
}

namespace Voussoir
{
  /** Subsection "Foundation". */
  struct FoundationParameters
  {
    std::string  model = "rigid"; ///< or rock, massless
    Material     rock{15e9, .25, 2700.};
    double       mass_damping = 0., stiffness_damping = 2e-5; ///< Rayleigh [1/s], [s]
    std::string  boundary = "mtf3", free_field = "sections";
    bool         nodal_everywhere = true;
    unsigned int nodal_layers = 6;
    unsigned int substeps = 1; ///< of the rock in each step of the dam

    void add_parameters(dealii::ParameterHandler &prm);
  };
} // namespace Voussoir

#endif
