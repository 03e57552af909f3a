// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_load_parameters_h
#define voussoir_load_parameters_h

#include <voussoir/base/tensor3.h>
#include <voussoir/dam/load_names.h>

#include <map>
#include <string>
#include <vector>

namespace Voussoir
{
  /** Temperatures of the faces, linear between them, against that at which the joints were closed. */
  struct TemperatureParameters
  {
    double      upstream = 0., downstream = 0.; ///< of the faces [degC]
    double      grouting = 0.;                  ///< at which the dam is free of stress [degC]
    double      expansion = 1e-5;               ///< coefficient of thermal expansion [1/K]
    std::string table;                          ///< file: day, (elevation), upstream, downstream; or empty
    double      day = 0.;                       ///< of the table

    void add_parameters(Entries &prm);
    bool acts() const { return !table.empty() || upstream != grouting || downstream != grouting; }
  };

  constexpr double no_level = -1e4; ///< there is no such water or sediment [m]

  /** Water on the surface "downstream". */
  struct TailWaterParameters
  {
    double level = no_level, density = 1000.; ///< [m], [kg/m^3]
    void   add_parameters(Entries &prm);
    bool   acts() const { return level > no_level && density > 0.; }
  };

  /** Sediment on the surface "upstream". */
  struct SiltParameters
  {
    double level = no_level, density = 900.; ///< [m], submerged [kg/m^3]
    double friction_angle = 30.,
           coefficient = -1.; ///< [degrees]; of earth pressure, -1: Rankine's active one
    void   add_parameters(Entries &prm);
    double pressure_coefficient() const; ///< the one that holds [-]
    bool   acts() const { return level > no_level && density > 0.; }
  };

  /** Water in joints that are open, and under the base. */
  struct UpliftParameters
  {
    bool        joints = false, base = false;
    std::string below_closed_part = "none", in_earthquake = "unchanged"; ///< rules by name
    double      drain_position = .1, drain_efficiency = 0.; ///< of the thickness from upstream [-], [-]
    void        add_parameters(Entries &prm);
    bool        acts() const { return joints || base; }
  };

  /** A force at a place, see add_point_force(). */
  struct PointLoad
  {
    Vector3 place, force; ///< [m], [N]
  };

  /** A force at a place, along a direction, with the values of a file. */
  struct ForceHistory
  {
    std::string name;
    Vector3     place, direction; ///< [m], [-]
    std::string file;             ///< time [s] and force [N]
  };

  /** Subsection "Loads": those besides water and weight, and combinations of all by name. */
  struct LoadParameters
  {
    TemperatureParameters              temperature;
    TailWaterParameters                tail_water;
    SiltParameters                     silt;
    UpliftParameters                   uplift;
    std::map<std::string, std::string> concentrated;            ///< name -> "x y z Fx Fy Fz" [m], [N]
    std::string                        force_history;           ///< "NAME: POINT; DIRECTION; FILE; NAME: ..."
    std::string                        crest_line;              ///< "qx qy qz" [N/m], or empty
    std::string                        crest_edge = "upstream"; ///< or downstream
    std::string                        combination;             ///< chosen one; empty: all loads once
    std::map<std::string, std::string> combinations = {{"usual", static_load_names()},
                                                       {"extreme", static_load_names() + ", earthquake"}};

    void add_parameters(Entries &prm);
    void check() const; ///< throws InputError for entries that cannot be read

    /** Returns the factor of a load in the chosen combination [-]; 1 if no combination is chosen, 0 if the
     * combination does not contain the load.
     * @param load name of static_load_names(), or "earthquake" */
    double factor(const std::string &load) const;

    std::map<std::string, PointLoad> point_loads() const;     ///< throws InputError for malformed ones
    std::vector<ForceHistory>        force_histories() const; ///< throws InputError for malformed ones
    Vector3                          line_load() const;       ///< on the crest's edge [N/m]
  };

  /** A step of the static history, see StaticPath. */
  struct StaticStage
  {
    enum class Kind
    {
      fill,  ///< the reservoir to this level [m]
      grout, ///< the joints up to this height [m]
      day,   ///< the temperature of this day of the table
      cut    ///< the material of a joint, with this width [m]
    } kind;
    double      value;
    double      pressure = 0.; ///< of the fluid grout [Pa]
    std::string joint = "";    ///< number, name or kind of the joints that are cut
  };

  /** "grout 140 at 0.5 MPa, fill 100, day 90, cut 5 by 10 mm" in this order. Throws InputError for anything else. */
  std::vector<StaticStage> static_stages(const std::string &text);
} // namespace Voussoir

#endif
