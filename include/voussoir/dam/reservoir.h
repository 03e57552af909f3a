// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_reservoir_h
#define voussoir_reservoir_h

#include <voussoir/solid/structure.h>

#include <string>

namespace Voussoir
{
  class Entries;
  struct ModelChoices;

  class SolidModel;

  /** Parameters of the subsection "Reservoir". */
  struct ReservoirParameters
  {
    double      level = 195.;               ///< height z of the water surface [m]
    double      density = 1000.;            ///< 0: empty reservoir [kg/m^3]
    std::string model = "Westergaard";      ///< row of the table of models: water_model_names()
    std::string added_mass = "Westergaard"; ///< old entry for the model Westergaard
    std::string table;                      ///< file of the model "added mass table"
    std::string directory = ".";            ///< of the input file
    std::string depth = "global";           ///< global or local
    double      factor = 1.;                ///< of the added mass [-]
    double      sound_speed = 1440.;        ///< [m/s]
    double      reflection = 1.;            ///< of bed and banks [-]
    double      length = 0.;                ///< of the channel without damping [m]; 0: two depths
    double      element_size = 0.;          ///< [m]; 0: a sixteenth of the depth

    /** Declares the entries of the subsection. */
    void add_parameters(Entries &prm);

    /** Returns the model, also of older scenes with the entry "Added mass". */
    const std::string &kind() const { return model == "Westergaard" ? added_mass : model; }

    /** Returns the model of the added mass for the log, with its factor. */
    std::string name_of_mass() const;

    /** Returns true if the water is compressible. */
    bool is_acoustic() const { return model == "acoustic" && density > 0.; }

    /** Returns true if the water has a mesh. */
    bool is_meshed() const { return (model == "acoustic" || model == "incompressible") && density > 0.; }

    /** Adds the changes of the water. */
    void add_choices(ModelChoices &choices) const;
  };

  /** Adds the added mass of the model to structure.mass and structure.added_mass.
   *
   * Westergaard: per area of the surface "upstream" it is 7/8 rho sqrt(H h) n n^T. h is the depth below the water
   * level. H is the depth of the reservoir, global at its deepest point, or local in the same vertical section
   * (Kuo 1982). The mass of this model and of a table is integrated over the submerged part and lumped to the nodes
   * by the shape functions. Westergaard-nodal: the formula at the nodes times their areas.
   *
   * Returns the total for motion along x, with that of fixed nodes [kg]. Throws InputError for a
   * wrong table. */
  double add_added_mass(const SolidModel &model, const ReservoirParameters &reservoir, Structure &structure);

  /** Returns a warning if the total of an added mass table is implausible against Westergaard's formula, or "". */
  std::string added_mass_warning(const SolidModel &model, const ReservoirParameters &reservoir);

  /** Returns the added mass per area of the surface "upstream" per node of the model [kg/m^2], or empty. */
  std::vector<double> added_mass_per_area(const SolidModel &model, const ReservoirParameters &reservoir);

  /** Returns the models as a selection of ParameterHandler: "none|Westergaard|...". */
  std::string water_model_names();

  /** Returns the help texts of the models. */
  std::string water_model_docs();
} // namespace Voussoir

#endif
