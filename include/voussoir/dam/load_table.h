// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_load_table_h
#define voussoir_load_table_h

#include <voussoir/dam/idle_entries.h>
#include <voussoir/dam/tractions.h>
#include <voussoir/solid/solid_model.h>

namespace Voussoir
{
  /** Where static loads act. */
  struct LoadSite
  {
    const SolidModel            &model;
    const Structure             &structure;
    const std::vector<Material> &materials;
  };

  /** One static load of a dam. */
  struct StaticLoad
  {
    std::string         name;
    bool                is_raised; ///< in the increments of the water; or there from the first
    double              factor;    ///< of the combination, in force and stress [-]
    Unknowns            force;     ///< on the free nodes [N]
    std::vector<Stress> stress;    ///< that comes to the recovered one, per node of the model [Pa]; or empty

    Vector3 resultant() const; ///< [N]
  };

  /** A static load that a scene can have. */
  struct LoadRow
  {
    const char  *name;           ///< in combinations
    unsigned int order;          ///< in the sum of the loads, and of their subsections of "Loads"
    bool (*acts)(const Scene &); ///< whatever the combination says

    /** Its subsection of "Loads"; null: it has none. */
    void (*declare)(LoadParameters &, Entries &) = nullptr;

    const char *help = "";             ///< what the help of combinations adds to the name
    const char *defined_by = nullptr;  ///< entries of "Loads" without which it does not act
    bool        is_raised = true;      ///< see StaticLoad
    bool        is_reversible = false; ///< are negative factors plausible?
    bool        is_by_gravity = false; ///< does it depend on "Statics/Gravity"?

    /** Its surface, which must not be above the dam [m], the entry, and what is wrong with one above the
     * reservoir; null: none. */
    double (*level)(const Scene &) = nullptr;
    const char *level_entry = nullptr, *above_reservoir = nullptr;

    /** Adds its force and stress without factor; null: it is its traction, or none of the whole dam. */
    void (*add)(const Scene &, const LoadSite &, StaticLoad &load) = nullptr;

    /** Returns the traction that it puts on a surface, times a factor, at the height z of a face whose
     * outward normal is given [Pa]; null: none. */
    Vector3 (*traction)(const Scene &, double factor, double z, const Vector3 &normal) = nullptr;
    int surface = 0;

    std::vector<IdleEntries> idle = {}; ///< of its entries
  };

  const std::vector<LoadRow> &load_table(); ///< in the order of help texts and messages

  /** The static loads that a scene asks for, with the factors of its combination. */
  std::vector<StaticLoad> static_loads(const Scene &scene, const LoadSite &site);

  /** What all loads put on the faces, with the factors of the combination; the water that moves along with
   * the dam is not in it [Pa]. @p scene must outlive the result. */
  KnownTraction known_traction(const Scene &scene);
} // namespace Voussoir

#endif
