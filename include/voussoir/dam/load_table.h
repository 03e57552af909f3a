// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_load_table_h
#define voussoir_load_table_h

#include <voussoir/base/names.h>
#include <voussoir/dam/scene.h>
#include <voussoir/dam/tractions.h>
#include <voussoir/solid/solid_model.h>

namespace Voussoir
{
  /** Entries without effect under a condition. */
  struct IdleEntries
  {
    const char *reason;           ///< condition, for the message
    bool (*holds)(const Scene &); ///< condition
    EntryNames entries;           ///< entries without effect
    EntryNames exceptions = {};   ///< those among @p entries with an effect
  };

  /** Model on which static loads act. */
  struct LoadSite
  {
    const SolidModel            &model;
    const Structure             &structure;
    const std::vector<Material> &materials; ///< of the concrete, by zone
  };

  /** One static load of a dam. */
  struct StaticLoad
  {
    std::string         name;
    bool                is_raised; ///< true: applied in the water increments; false: constant
    double              factor;    ///< of the load combination, included in force and stress [-]
    Unknowns            force;     ///< three values per free node [N]
    std::vector<Stress> stress;    ///< initial stress per node of the model [Pa], or empty

    Vector3 on_fixed{}; ///< resultant of a pressure on fixed nodes, without elements of force [N]

    /** Returns the sum of all forces, with those of a pressure on fixed nodes [N]. */
    Vector3 resultant() const;
  };

  constexpr const char *uplift_load = "uplift at the base"; ///< name of the load on base joints

  /** Static load of an input file. */
  struct LoadRow
  {
    const char  *name;           ///< name in load combinations
    unsigned int order;          ///< order in the sum of the loads, and of their subsections of "Loads"
    bool (*acts)(const Scene &); ///< true if the input file defines the load, in any combination

    /** Declares the subsection of "Loads"; null: no subsection. */
    void (*declare)(LoadParameters &, Entries &) = nullptr;

    const char *help = "";             ///< addition to the name in the help of combinations
    const char *defined_by = nullptr;  ///< entries of "Loads" that define the load; null: none
    bool        is_raised = true;      ///< see StaticLoad
    bool        is_reversible = false; ///< true: negative factors are plausible
    bool        is_by_gravity = false; ///< true: the load depends on "Statics/Gravity"

    /** Returns true if the load acts before the static loads, in staged_weight(); null: never. */
    bool (*is_staged)(const Scene &) = nullptr;

    /** Returns the level of the load [m], which must not be above the dam; null: no level. */
    double (*level)(const Scene &) = nullptr;
    const char *level_entry = nullptr;     ///< entry of the level
    const char *above_reservoir = nullptr; ///< warning if the level is above the reservoir; null: none

    /** Adds force and stress without the load factor; null: the force follows from the traction, if any. */
    void (*add)(const Scene &, const LoadSite &, StaticLoad &load) = nullptr;

    /** Returns the traction on the surface times a factor [Pa], at the height z [m] of a face with the given
     * outward normal; null: no traction. */
    Vector3 (*traction)(const Scene &, double factor, double z, const Vector3 &normal) = nullptr;
    int surface = 0; ///< surface of the traction

    std::vector<IdleEntries> idle = {}; ///< entries of the load without effect
  };

  /** Returns the table of all static loads, in the order of help texts and messages. */
  const std::vector<LoadRow> &load_table();

  /** Returns the active static loads of an input file, with the factors of its load combination. */
  std::vector<StaticLoad> static_loads(const Scene &scene, const LoadSite &site);

  /** Returns the tractions of all active loads on the faces [Pa], with the factors of the load combination and
   * without the hydrodynamic added mass. @p scene must outlive the result. */
  KnownTraction known_traction(const Scene &scene);
} // namespace Voussoir

#endif
