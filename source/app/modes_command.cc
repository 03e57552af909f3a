// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/app/memory_need.h>
#include <voussoir/app/modes_command.h>
#include <voussoir/app/modes_damping.h>
#include <voussoir/app/spectrum_analysis.h>
#include <voussoir/base/error.h>
#include <voussoir/dam/dam.h>
#include <voussoir/dynamics/modes.h>
#include <voussoir/output/figures.h>
#include <voussoir/output/recorders.h>
#include <voussoir/water/water_modes.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <optional>

namespace Voussoir
{
  namespace
  {
    unsigned int count_of(const std::string &text)
    {
      unsigned int count = 0;
      if (text.find_first_not_of("0123456789") != std::string::npos ||
          std::sscanf(text.c_str(), "%u", &count) != 1 || count == 0)
        throw InputError("--count must be a positive number, not \"" + text + "\".");
      return count;
    }

    void make_directory(const std::string &directory)
    {
      std::error_code error;
      std::filesystem::create_directories(directory, error);
      if (error)
        throw InputError("The directory " + directory + " cannot be created: " + error.message() +
                         ". Choose another one with --output.");
    }

    /** Returns the modes of the dam, with its added mass, incompressible or compressible water. @p radiation: receives
     * the damping ratios by compressible water [-]. */
    std::vector<NaturalMode> modes_of(const Dam &dam, const unsigned int count,
                                      std::vector<double> &radiation)
    {
      if (!dam.water)
        return natural_modes(dam.structure, count);
      const WaterModel water = dam.water->model_for(0.);
      const bool       is_compressible = dam.scene.reservoir.is_acoustic();
      auto             modes = natural_modes(dam.structure, is_compressible ? count + 4 : count, 1000,
                                             [&](const Unknowns &x, Unknowns &y)
                                             { dam.water->with_dam().add_incompressible_mass(water, x, y); });
      if (is_compressible)
        radiation = make_compressible(*dam.water, water, modes, count);
      std::string missing;
      for (std::size_t k = 0; k < radiation.size(); ++k)
        if (std::isnan(radiation[k]))
          missing += (missing.empty() ? "" : ", ") + std::to_string(k + 1);
      if (!missing.empty())
        std::cerr
            << "voussoir: warning: these modes were not found with compressible water, and have the frequencies "
               "with incompressible water: "
            << missing
            << ". Above the first frequency of the reservoir dam and water have common modes. Reduce --count.\n";
      return modes;
    }

    /** Returns the table of modes.csv. Participation factors are for modes with unit modal mass. */
    Table table_of(const std::vector<NaturalMode> &modes, const std::vector<double> &radiation,
                   const Structure &structure)
    {
      Table table;
      table.columns = {"mode",
                       "frequency",
                       "participation_x",
                       "participation_y",
                       "participation_z",
                       "effective_mass_x",
                       "effective_mass_y",
                       "effective_mass_z",
                       "share_x",
                       "share_y",
                       "share_z"};
      if (!radiation.empty())
        table.columns.push_back("radiation_damping");
      for (std::size_t k = 0; k < modes.size(); ++k)
      {
        const Vector3 factor = modes[k].participation(structure), share = modes[k].mass_share(structure);
        std::vector<double> row = {double(k + 1), modes[k].frequency};
        row.insert(row.end(), factor.begin(), factor.end());
        for (unsigned int d = 0; d < 3; ++d)
          row.push_back(factor[d] * factor[d]);
        row.insert(row.end(), share.begin(), share.end());
        if (!radiation.empty())
          row.push_back(radiation[k]);
        table.rows.push_back(row);
      }
      return table;
    }

    /** Returns the mode shape as displacements, scaled to a maximum of 1 m. */
    void write_shape(const Dam &dam, const NaturalMode &mode, const std::string &file)
    {
      double largest = 0.;
      for (std::size_t k = 0; k + 2 < mode.shape.size(); k += 3)
        largest = std::max(largest, std::hypot(mode.shape[k], mode.shape[k + 1], mode.shape[k + 2]));
      Unknowns u = mode.shape;
      for (double &x : u)
        x /= largest;
      FieldWriter(*dam.model).write_vtu(file, u, {});
    }

    void write_modes(const Dam &dam, const std::vector<NaturalMode> &modes, const Table &table,
                     const std::string &directory)
    {
      table.write(directory + "/modes.csv");
      for (std::size_t k = 0; k < modes.size(); ++k)
      {
        char name[40];
        std::snprintf(name, sizeof(name), "/mode-%03zu.vtu", k + 1);
        write_shape(dam, modes[k], directory + name);
      }
      const std::string error = draw_figures_of(directory, directory + "/figures.log");
      if (!error.empty())
        std::cerr << "voussoir: warning: the mode shapes could not be drawn: " << error << ".\n";
    }

    void print_masses(const Table &table)
    {
      std::printf("\nEffective mass [%%]\nmode       x       y       z\n");
      for (const auto &row : table.rows)
        std::printf("%4.0f  %6.2f  %6.2f  %6.2f\n", row[0], 100. * row[8], 100. * row[9], 100. * row[10]);
      std::fflush(stdout);
    }

    /** Highest monolith between open joints on a rigid base, with Westergaard's added mass in place of meshed water. */
    struct FreeMonolith
    {
      std::string         name;
      std::vector<double> frequency, ratio; ///< of its first modes [Hz], [-]
    };

    /** Returns the free-standing monolith, without modes if the dam has no contraction joints, or lift joints that divide
     * its monoliths. @p first_frequency: for Dam::set_damping() [Hz]. */
    FreeMonolith free_monolith(Scene scene, const std::vector<Joint> &joints, const double first_frequency)
    {
      FreeMonolith result;
      const auto   has = [&](const std::string &kind)
      {
        return std::any_of(joints.begin(), joints.end(),
                           [&](const Joint &joint) { return joint.kind() == kind; });
      };
      const auto is_tied = [&](const Joint &joint)
      { return joint.kind() == "contraction" && scene.joints.model_of(joint) == "tied"; };
      if (!has("contraction") || has("lift") || std::any_of(joints.begin(), joints.end(), is_tied) ||
          (scene.mesh.source == "file" && scene.foundation.model != "rigid"))
        return result;
      scene.foundation.model = "rigid";
      if (has("base"))
        scene.joints.overrides["base"] = "tied";
      scene.joints.gaps.clear();
      scene.statics.stages.clear();
      scene.statics.self_weight = "none";
      if (scene.reservoir.is_meshed())
        scene.reservoir.model = "Westergaard";
      Dam dam(scene);
      dam.set_damping(first_frequency);
      const Structure                       &all = dam.structure;
      std::vector<std::pair<double, double>> range(all.bodies.size(), {1e300, -1e300});
      for (unsigned int i = 0; i < dam.model->n_nodes(); ++i)
        if (const unsigned int node = dam.model->equation[i]; node != rigid_ground)
        {
          auto &[low, high] = range[all.body_of(node)];
          low = std::min(low, dam.model->points[i][2]);
          high = std::max(high, dam.model->points[i][2]);
        }
      const auto higher = [](const auto &a, const auto &b)
      { return a.second - a.first < b.second - b.first; };
      Structure one;
      one.bodies = {all.bodies[std::max_element(range.begin(), range.end(), higher) - range.begin()]};
      Body &body = one.bodies[0];
      one.mass.assign(all.mass.begin() + body.first_node,
                      all.mass.begin() + body.first_node + body.n_nodes());
      body.first_node = 0;
      one.plane_strain = all.plane_strain;
      one.damping = all.damping;
      one.collect_interfaces();
      result.name = body.name();
      for (const NaturalMode &mode : natural_modes(one, 3))
      {
        result.frequency.push_back(mode.frequency);
        result.ratio.push_back(one.damping.of_mode(2. * M_PI * mode.frequency, mode.scale(one)).first);
      }
      return result;
    }

    /** Returns a warning if the first mode of the free-standing monolith has more than twice or less than half of the
     * ratio, or an empty string. */
    std::string warning_of(const FreeMonolith &monolith, const DampingParameters &damping)
    {
      const double ratio = damping.ratio;
      if (monolith.ratio.empty() || damping.mass_coefficient >= 0. ||
          (monolith.ratio[0] <= 2. * ratio && monolith.ratio[0] >= .5 * ratio))
        return "";
      std::ostringstream text;
      text.precision(3);
      text << monolith.name << " between open joints has a damping ratio of " << 100. * monolith.ratio[0]
           << " % in its first mode (" << monolith.frequency[0] << " Hz), \"Damping/Ratio\" is "
           << 100. * ratio << " %. Openings depend on it: "
           << (!damping.zones.empty() ? "compare the ratios of \"Damping/Zones\"."
               : damping.is_uniform()
                   ? "reduce \"Damping/Band begin\"."
                   : "change \"Damping/Frequency 1\", or set \"Damping/Model\" to uniform.");
      return text.str();
    }

    /** Returns the rows of the table as objects, with the names of the columns as keys, and the damping ratios. */
    Json json_of(const Dam &dam, const Table &table, const ModesDamping &damping,
                 const std::vector<double> &radiation, const FreeMonolith &monolith)
    {
      std::vector<Json> modes(table.rows.size());
      for (std::size_t k = 0; k < modes.size(); ++k)
        for (std::size_t i = 0; i < table.columns.size(); ++i)
          modes[k].add(table.columns[i], table.rows[k][i]);
      for (std::size_t k = 0; k < modes.size(); ++k)
        modes[k].add("damping",
                     damping.ratio(k) + (radiation.empty() || std::isnan(radiation[k]) ? 0. : radiation[k]));
      std::vector<Warning> warnings;
      for (const std::string &warning : dam.facts.warnings)
        warnings.push_back({Warning::Kind::physics, warning, ""});
      warnings.insert(warnings.end(), dam.scene.warnings.begin(), dam.scene.warnings.end());
      for (const std::string &warning : {damping.warning(), warning_of(monolith, dam.scene.damping)})
        if (!warning.empty())
          warnings.push_back({Warning::Kind::physics, warning, ""});
      Json json;
      json.add("scene", dam.scene.name)
          .add_list("free_mass", free_mass(dam.structure))
          .add("modes", modes)
          .add("warnings", warnings);
      if (!monolith.frequency.empty())
        json.add("free_monolith", Json()
                                      .add("name", monolith.name)
                                      .add_list("frequencies", monolith.frequency)
                                      .add_list("damping", monolith.ratio));
      return json;
    }
    void print_table(const std::vector<NaturalMode> &modes, const std::vector<double> &radiation,
                     const ModesDamping &damping, const FreeMonolith &monolith)
    {
      std::printf("mode  frequency [Hz]  damping [%%]%s\n",
                  radiation.empty() ? "" : "  of it by the water [%]");
      for (std::size_t i = 0; i < modes.size(); ++i)
      {
        const double of_water = radiation.empty() || std::isnan(radiation[i]) ? 0. : radiation[i];
        std::printf("%4zu  %10.5f  %16.3f", i + 1, modes[i].frequency, 100. * (damping.ratio(i) + of_water));
        if (!radiation.empty() && std::isnan(radiation[i]))
          std::printf("  %20s", "not found");
        else if (!radiation.empty())
          std::printf("  %20.3f", 100. * of_water);
        std::printf("\n");
      }
      std::printf("Damping   %s\n", damping.in_words().c_str());
      for (std::size_t i = 0; i < monolith.frequency.size(); ++i)
        std::printf("%s%.4g Hz (%.2f %%)%s",
                    i == 0 ? ("Free      " + monolith.name + " between open joints: ").c_str() : ", ",
                    monolith.frequency[i], 100. * monolith.ratio[i],
                    i + 1 == monolith.frequency.size() ? "\n" : "");
    }
  } // namespace

  std::vector<double> first_frequencies(Scene scene)
  {
    if (scene.foundation.model == "rock") // the same mesh, whose end walls are free
    {
      scene.foundation.model = "rigid";
      scene.foundation.ignores_rock = true;
    }
    if (scene.reservoir.is_meshed())
      scene.reservoir.model = "incompressible";
    scene.is_for_modes = true;
    const Dam           dam(scene, true);
    std::vector<double> result, radiation;
    for (const NaturalMode &mode : modes_of(dam, 3, radiation))
      result.push_back(mode.frequency);
    return result;
  }

  void print_modes(const Scene &scene, const std::string &count_text, const std::string &directory,
                   const std::string &spectrum_choice, const bool json)
  {
    const unsigned int count = count_of(count_text);
    if (json && !spectrum_choice.empty())
      throw InputError("--json does not print the results of --spectrum. Leave out --json, and read "
                       "response_spectrum.csv in the directory of --output.");
    if (scene.foundation.model == "rock")
      throw InputError(
          "`voussoir modes` requires a rigid base or massless rock, because rock with mass "
          "radiates energy. Use --set Foundation/Model=massless or --set Foundation/Model=rigid.");
    if (scene.reservoir.is_meshed() && !spectrum_choice.empty())
      throw InputError("--spectrum has no " + scene.reservoir.model +
                       " water. Use --set Reservoir/Model=Westergaard.");
    if (!spectrum_choice.empty() && scene.damping.is_uniform() && !scene.damping.zones.empty())
      throw InputError("--spectrum has one damping ratio for all modes. Remove the entry \"Damping/Zones\".");
    std::optional<ChosenSpectrum> spectrum;
    if (!spectrum_choice.empty())
      spectrum = choose_spectrum(scene, spectrum_choice);
    if (!directory.empty())
      make_directory(directory);
    Log quiet(true);
    check_water_size(scene, 0., quiet);
    Dam dam(scene, true);
    for (const std::string &warning : dam.facts.warnings)
      std::cerr << "voussoir: warning: " << warning << "\n";
    std::vector<double> radiation;
    if (dam.water)
      std::cerr << "voussoir: warning: effective masses are those of the concrete, without the water.\n";
    const std::vector<NaturalMode> modes = modes_of(dam, count, radiation);
    const Table                    table = table_of(modes, radiation, dam.structure);
    dam.set_damping(modes[0].frequency);
    const ModesDamping damping(scene.damping, modes, dam.structure);
    const FreeMonolith monolith = free_monolith(scene, dam.layout.joints, modes[0].frequency);
    if (json)
      std::printf("%s\n", json_of(dam, table, damping, radiation, monolith).text().c_str());
    else
    {
      print_table(modes, radiation, damping, monolith);
      if (!directory.empty())
        print_masses(table);
    }
    std::fflush(stdout);
    for (const std::string &warning : {damping.warning(), warning_of(monolith, scene.damping)})
      if (!warning.empty())
        std::cerr << "voussoir: warning: " << warning << "\n";
    if (spectrum)
      print_spectrum_analysis(dam, modes, *spectrum, directory);
    if (!directory.empty())
      write_modes(dam, modes, table, directory);
    if (!directory.empty() && !json)
      std::printf("Results   %s\n", directory.c_str());
  }
} // namespace Voussoir
