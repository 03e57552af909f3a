// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/error.h>
#include <voussoir/base/names.h>
#include <voussoir/contact/law_table.h>
#include <voussoir/dam/joint_layout.h>
#include <voussoir/dynamics/impact.h>
#include <voussoir/joints/pairs.h>
#include <voussoir/mesh/footings.h>
#include <voussoir/mesh/mesh_joints.h>
#include <voussoir/solid/solid_model.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace Voussoir
{
  namespace
  {
    /** Throws InputError if there is no joint j between the monoliths j and j + 1. */
    void check_joint_numbers(const HexMesh &opened, const std::string &source)
    {
      std::set<int> numbers, monoliths;
      for (const Joint &joint : joints_of(opened))
        if (joint.is_contraction())
          numbers.insert(joint.contraction_number());
      for (const HexMesh::Cell &cell : opened.cells)
        monoliths.insert(monolith_of(cell.volume));
      const int n_joints = std::max(numbers.empty() ? 0 : *numbers.rbegin(),
                                    monoliths.size() > 1 ? *monoliths.rbegin() - 1 : 0);
      for (int j = 1; j <= n_joints; ++j)
        if (numbers.count(j) == 0)
          throw InputError("mesh " + source + ": joint " + std::to_string(j) + " has no faces: monoliths " +
                           std::to_string(j) + " and " + std::to_string(j + 1) +
                           " do not meet. Number the monoliths consecutively from the right bank to the "
                           "left. If they are, make their nodes on the joint coincide.");
    }

    /** Returns true if the entries for single joints have the same meaning in a dam without lifts. They may name lift
     * joints that are tied, but no part of another joint. */
    bool is_without_parts(const Scene &scene, const unsigned int n_joints)
    {
      const auto is_whole = [&](const std::string &key)
      {
        const bool is_number = std::isdigit(static_cast<unsigned char>(key[0])) && key.size() <= 4;
        return key == "contraction" || key == "base" || (is_number && std::stoul(key) <= n_joints);
      };
      const auto has_whole = [&](const auto &entry) { return is_whole(entry.first); };
      const auto is_tied_lift = [&](const auto &entry)
      { return has_whole(entry) || entry.first.compare(0, 4, "lift") == 0; };
      const auto is_no_cut_of_part = [&](const StaticStage &stage)
      { return stage.kind != StaticStage::Kind::cut || is_whole(stage.joint); };
      const std::vector<StaticStage> stages = static_stages(scene.statics.stages);
      return std::all_of(scene.joints.overrides.begin(), scene.joints.overrides.end(), is_tied_lift) &&
             std::all_of(scene.joints.gaps.begin(), scene.joints.gaps.end(), has_whole) &&
             std::all_of(scene.joints.clearances.begin(), scene.joints.clearances.end(), has_whole) &&
             std::all_of(stages.begin(), stages.end(), is_no_cut_of_part);
    }

    /** Returns the mesh without lifts if all lift joints are tied and the entries for single joints allow it.
     * @p merged_lifts: receives the keys of all joints in this case. */
    HexMesh merge_tied_lifts(HexMesh opened, const Scene &scene, const bool tie_all,
                             std::set<std::string> &merged_lifts)
    {
      const std::vector<Joint> all = joints_of(opened);
      std::set<std::string>    lifts;
      for (const Joint &joint : all)
      {
        if (joint.is_lift() && !tie_all && scene.joints.model_of(joint) != "tied")
          return opened;
        const std::vector<std::string> keys = joint.keys();
        lifts.insert(keys.begin(), keys.end());
      }
      if (std::none_of(all.begin(), all.end(),
                       [](const Joint &joint) { return joint.is_inside_monolith(); }) ||
          (!tie_all && !is_without_parts(scene, n_monoliths(opened) - 1)))
        return opened;
      merged_lifts = lifts;
      HexMesh whole = close_joints(opened);
      for (HexMesh::Cell &cell : whole.cells)
        cell.volume = monolith_of(cell.volume);
      return open_joints(whole);
    }

    /** Returns true if a base joint of the opened mesh is not tied. */
    bool has_open_base(const HexMesh &opened, const Scene &scene)
    {
      const std::vector<Joint> joints = joints_of(opened);
      return std::any_of(joints.begin(), joints.end(),
                         [&](const Joint &joint)
                         { return joint.is_base() && scene.joints.model_of(joint) != "tied"; });
    }

    /** Removes the pairs of contraction joints with shear keys at nodes of base joints: keys cannot cross joints. */
    void remove_keys_at_base(const std::vector<Joint> &joints, const std::vector<std::string> &models,
                             Structure &structure)
    {
      std::set<unsigned int> standing;
      for (const Pair &pair : structure.pairs)
        if (joints[pair.joint].is_base())
          standing.insert(pair.node_2);
      std::vector<Pair> &pairs = structure.pairs;
      pairs.erase(std::remove_if(pairs.begin(), pairs.end(),
                                 [&](const Pair &pair)
                                 {
                                   return joints[pair.joint].is_contraction() &&
                                          models[pair.joint] == "KSM" &&
                                          standing.count(pair.node_1) + standing.count(pair.node_2) > 0;
                                 }),
                  pairs.end());
    }

    /** Returns the laws of pairs that share nodes with other pairs, per joint. Where joints cross, their conditions are
     * redundant. The compliance of these laws makes the forces unique. It is that of a thin layer of concrete, and about
     * 3e-2 of the flexibility of the concrete around a pair in a step of 10 ms. */
    std::vector<std::unique_ptr<JointLaw>> laws_of_crossings(const Scene &scene, const Structure &structure,
                                                             const std::vector<std::string> &models,
                                                             const std::set<unsigned int>   &without_keys)
    {
      constexpr double          thickness = .2; // of the layer of concrete, in distances of the nodes
      std::vector<double>       area(models.size(), 0.);
      std::vector<unsigned int> n(models.size(), 0);
      for (const auto &cluster : structure.clusters)
        for (const unsigned int p : cluster)
        {
          area[structure.pairs[p].joint] += structure.pairs[p].area;
          ++n[structure.pairs[p].joint];
        }
      std::vector<std::unique_ptr<JointLaw>> laws;
      for (std::size_t j = 0; j < models.size() && !structure.clusters.empty(); ++j)
      {
        LawParameters parameters = scene.joints.law(scene.concrete.young);
        for (const auto &[entry, value] : {std::pair("Joints/Normal stiffness", &parameters.normal_stiffness),
                                           {"Joints/Tangential stiffness", &parameters.tangential_stiffness},
                                           {"Joints/Adhesion", &parameters.adhesion}})
          if (!joint_law_reads(models[j], entry))
            *value = 0.;
        const double added = scene.concrete.young / (thickness * std::sqrt(area[j] / std::max(1u, n[j])));
        for (double *stiffness : {&parameters.normal_stiffness, &parameters.tangential_stiffness})
          *stiffness = n[j] == 0          ? *stiffness
                       : *stiffness == 0. ? added
                                          : 1. / (1. / *stiffness + 1. / added);
        if (models[j] != "KSM")
          laws.push_back(make_joint_law(models[j], parameters, true));
        else // see JointLayout::cross()
          laws.push_back(without_keys.count(j) > 0 ? make_joint_law("FJA", parameters) : nullptr);
      }
      return laws;
    }
  } // namespace

  HexMesh JointLayout::open(const HexMesh &concrete, const std::string &source)
  {
    HexMesh opened = merge_tied_lifts(open_joints(concrete), scene, tie_all, merged_lifts);
    if (scene.foundation.model != "rigid" && !tie_all && has_open_base(opened, scene))
      opened = with_footings(opened);
    for (const Joint &joint : joints_of(opened))
    {
      for (int number = joints.size() + 1; number < joint.number; ++number)
        joints.push_back({number, number, number + 1}); // without faces
      joints.push_back(joint);
      if (joint.is_contraction())
        n_contraction = std::max<unsigned int>(n_contraction, joint.contraction_number());
    }
    check_joint_numbers(opened, source);
    choose_laws();
    return opened;
  }

  void JointLayout::choose_laws()
  {
    tied = true;
    for (const Joint &joint : joints)
    {
      models.push_back(tie_all ? "tied" : scene.joints.model_of(joint));
      gaps.push_back(tie_all ? 0. : scene.joints.gap_of(joint));
      const bool is_open = models.back() != "tied";
      if (joint.is_base() && models.back() == "KSM")
        throw InputError("Entry \"Joints/Model\" or \"Joints/Overrides\" has keys (KSM) in " + joint.name() +
                         ", but keys belong to contraction and lift joints. Set \"base: FJA\", or another "
                         "model, in \"Joints/Overrides\".");
      tied = tied && !is_open;
      has_open_bases = has_open_bases || (is_open && joint.is_base());
      has_open_lifts = has_open_lifts || (is_open && joint.is_lift());
      laws.of_joint.push_back(make_joint_law(models.back(), scene.joints.law(scene.concrete.young, &joint)));
      if (gaps.back() > 0. && !is_open)
        throw InputError("Entry \"Joints/Initial gaps\" has a gap of " + joint.name() +
                         ", but this joint is tied. Set another model (\"Joints/Model\" or "
                         "\"Joints/Overrides\"), or remove the gap.");
    }
    for (const auto &joint : scene.joints.overrides)
      named(joint.first, "Entry \"Joints/Overrides\" names ");
    for (const auto &joint : scene.joints.gaps)
      named(joint.first, "Entry \"Joints/Initial gaps\" names ");
    for (const auto &joint : scene.joints.clearances)
      for (const std::size_t j : named(joint.first, "Entry \"Joints/Keys/Clearances\" names "))
        if (!tie_all && models[j] != "KSM")
          throw InputError(
              "Entry \"Joints/Keys/Clearances\" names " + joints[j].name() + ", whose law " + models[j] +
              " has no keys. Set its model to KSM (\"Joints/Model\" or \"Joints/Overrides\"), or remove "
              "the clearance.");
  }

  std::vector<std::size_t> JointLayout::named(const std::string &key, const std::string &what) const
  {
    std::vector<std::size_t>           found;
    std::map<std::string, std::string> examples; // a name of each kind
    for (std::size_t j = 0; j < joints.size(); ++j)
    {
      const std::vector<std::string> keys = joints[j].keys();
      if (std::find(keys.begin(), keys.end(), key) != keys.end())
        found.push_back(j);
      examples[joints[j].kind()] = keys[joints[j].is_contraction()];
    }
    if (!found.empty() || key == "contraction" || merged_lifts.count(key) > 0)
      return found;
    const std::string text =
        listed(examples, [](const auto &example) { return example.second + ", " + example.first; });
    throw InputError(
        what +
        (std::isdigit(static_cast<unsigned char>(key[0])) ? "joint " + key : "the joint \"" + key + "\"") +
        ", but the dam has " + std::to_string(joints.size()) +
        " joints, and none with this number, name or kind (such as " + (text.empty() ? "contraction" : text) +
        "). Correct or remove it.");
  }

  bool JointLayout::has_parts() const
  {
    return std::any_of(joints.begin(), joints.end(),
                       [](const Joint &joint) { return joint.is_inside_monolith(); });
  }

  void JointLayout::tie_parts(SolidModel &model, const bool all) const
  {
    tie_joints(model, joints.size(),
               [&](const unsigned int j)
               { return joints[j].is_inside_monolith() && (all || models[j] == "tied"); });
  }

  std::set<int> JointLayout::open_bases() const
  {
    std::set<int> sides;
    for (std::size_t j = 0; j < joints.size(); ++j)
      if (joints[j].is_base() && models[j] != "tied")
        sides.insert(PhysicalId::joint_side_2 + joints[j].number);
    return sides;
  }

  /** Groups and sorts the pairs: the lift and base joints of monolith m belong to the contraction joint m - 1. */
  void JointLayout::group_by_monolith(Structure &structure) const
  {
    structure.group_of_joint.resize(joints.size());
    for (std::size_t j = 0; j < joints.size(); ++j)
      structure.group_of_joint[j] = joints[j].is_contraction() ? joints[j].contraction_number() - 1
                                                               : std::max(0, joints[j].monolith_2() - 2);
    std::stable_sort(structure.pairs.begin(), structure.pairs.end(),
                     [&](const Pair &a, const Pair &b) {
                       return std::make_pair(structure.group(a), a.joint) <
                              std::make_pair(structure.group(b), b.joint);
                     });
  }

  /** Finds the clusters of pairs where joints cross. Keys are left out where all blocks of a ring meet. */
  void JointLayout::cross(Structure &structure)
  {
    if (has_parts())
      group_by_monolith(structure);
    remove_keys_at_base(joints, models, structure);
    structure.clusters = clusters_of(structure.pairs);
    for (const auto &cluster : structure.clusters)
    {
      std::set<unsigned int> nodes;
      for (const unsigned int p : cluster)
        nodes.insert({structure.pairs[p].node_1, structure.pairs[p].node_2});
      for (const unsigned int p : cluster) // a ring of blocks: the conditions are redundant
        if (const unsigned int j = structure.pairs[p].joint;
            nodes.size() <= cluster.size() && models[j] == "KSM")
          without_keys.insert(j);
    }
  }

  /** Assigns the laws of the pairs. Pairs at the base are tied if the foundation requires it. */
  void JointLayout::assign_laws(const Structure &structure, const std::set<unsigned int> &tied_nodes)
  {
    if (!structure.clusters.empty() && impact_rule(scene.impact_rule) != ImpactRule::mean_force)
    {
      std::set<unsigned int> crossing;
      for (const unsigned int p : structure.clusters[0])
        crossing.insert(structure.pairs[p].joint);
      const std::string names = listed(crossing, [&](const unsigned int j) { return joints[j].name(); });
      throw InputError("Joints cross at " + place(structure.pairs[structure.clusters[0][0]].place) + " (" +
                       names + "), which requires \"Dynamics/Impact\" = mean-force, not " +
                       scene.impact_rule + ".");
    }
    laws.of_crossings = laws_of_crossings(scene, structure, models, without_keys);
    laws.assign(structure);
    if (laws.need_mean_force() && impact_rule(scene.impact_rule) != ImpactRule::mean_force)
      throw InputError("The joint models " + joint_laws_of_mean_force() +
                       " require \"Dynamics/Impact\" = mean-force, not " + scene.impact_rule + ".");
    laws.of_joint.push_back(make_joint_law("tied", LawParameters()));
    for (std::size_t p = 0; p < structure.pairs.size(); ++p)
      if (tied_nodes.count(structure.pairs[p].node_1) > 0 && tied_nodes.count(structure.pairs[p].node_2) > 0)
        laws.of_pair[p] = laws.of_joint.back().get();
    for (const JointLaw *law : laws.of_pair)
      if (scene.contact.write_problems && !tie_all && law->flat_friction() < 0. && !law->surfaces_law())
        throw InputError("\"Contact/Write problems\" requires Coulomb friction in all joints. Set "
                         "\"Joints/Model\" to FJA or KSM, or remove the entry.");
  }
} // namespace Voussoir
