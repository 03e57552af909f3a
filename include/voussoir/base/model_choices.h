// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_model_choices_h
#define voussoir_model_choices_h

#include <voussoir/base/number_text.h>

#include <map>
#include <string>
#include <vector>

namespace Voussoir
{
  /** Change of a scene. `voussoir needs` computes its effect on the results. */
  struct ModelChoice
  {
    std::string                        group;      ///< such as "water"
    std::string                        name;       ///< such as "empty reservoir"
    std::map<std::string, std::string> entries;    ///< values by "Section/Entry"
    bool                               is_simpler; ///< true: the changed model is simpler or cheaper
  };

  /** Changes of a scene, declared by the sections of the input file next to their entries. */
  struct ModelChoices
  {
    double       bottom = 0., top = 0.; ///< heights of the dam [m]
    unsigned int n_joints = 0;          ///< contraction joints
    double       time_step = 0.;        ///< of the dam [s]
    bool         has_rock = false;      ///< true: the mesh has rock, or can have it
    bool         has_base_joints = false;
    bool         has_lift_joints = false;

    std::vector<ModelChoice> list;

    /** Adds a change. */
    void add(const std::string &group, const std::string &name,
             const std::map<std::string, std::string> &entries, const bool is_simpler = false)
    {
      list.push_back({group, name, entries, is_simpler});
    }

    /** Adds a change of one number to @p value. */
    void add(const std::string &group, const std::string &name, const std::string &entry, const double value,
             const bool is_simpler = false)
    {
      add(group, name, {{entry, number_text(value)}}, is_simpler);
    }
  };
} // namespace Voussoir

#endif
