// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/error.h>
#include <voussoir/base/internal_error.h>
#include <voussoir/base/log.h>
#include <voussoir/base/number_text.h>
#include <voussoir/motion/ground_motion.h>
#include <voussoir/water/acoustic_water.h>
#include <voussoir/water/water_size.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace Voussoir
{
  namespace
  {
    enum Record ///< AcousticWater::record
    {
      steps,
      energy,
      radiated,
      absorbed,
      work_of_dam,
      work_of_ground,
      largest,
      n_records
    };

    constexpr double noticeable_mass_factor = 1.02;

    /** Returns a size with three digits [m]. */
    double rounded(const double h)
    {
      const double unit = std::pow(10., std::floor(std::log10(h)) - 2.);
      return std::round(h / unit) * unit;
    }

    WaterMesh channel(const SolidModel &dam, const double level, const WaterProperties &properties)
    {
      return make_channel(WaterSection(wet_quads(dam), level, properties.h, properties.is_slice), properties);
    }

    /** Throws InputError for water elements that are too large, with a size that works, if there is one. */
    [[noreturn]] void advise(const CoarseWater &error, const SolidModel &dam, const double level,
                             WaterProperties properties)
    {
      const double coarse = properties.h;
      for (unsigned int k = 0; k < 30; ++k)
        try
        {
          properties.h = rounded(.9 * properties.h);
          WaterCoupling(dam, channel(dam, level, properties), level, properties.h);
          throw InputError(error.what() +
                           (" Set \"Reservoir/Element size\" to " + number_text(properties.h)) + ".");
        }
        catch (const CoarseWater &)
        {
        }
      throw InputError(
          error.what() + (" No size between " + number_text(properties.h) + " and " + number_text(coarse)) +
          " m works either. Use a water mesh of your own, or set \"Reservoir/Model\" to Westergaard.");
    }

    /** Returns the mesh of the channel or of the file. Throws InputError if there is none. */
    WaterMesh water_mesh_of(const SolidModel &dam, const double level, const HexMesh *volumes,
                            WaterProperties &properties)
    {
      if (volumes != nullptr)
        return read_volumes(*volumes, wet_quads(dam), level, properties);
      try
      {
        WaterMesh mesh = channel(dam, level, properties);
        WaterCoupling(dam, mesh, level, properties.h); // throws CoarseWater
        return mesh;
      }
      catch (const CoarseWater &error)
      {
        advise(error, dam, level, properties);
      }
    }

    double depth_below(const std::vector<WetQuad> &faces, const double level)
    {
      double low = level;
      for (const WetQuad &face : faces)
        for (const Vector3 &corner : face.corners)
          low = std::min(low, corner[2]);
      return level - low;
    }

    WaterProperties complete(WaterProperties properties, const double depth)
    {
      if (!(depth > 0.))
        throw InputError("Mesh of the water: the water level is not above the lowest point of the upstream "
                         "face. Correct Reservoir/Water level.");
      properties.depth = depth;
      if (properties.length == 0.)
        properties.length = 2. * depth;
      if (properties.h == 0.)
        properties.h = depth / 16.;
      if (properties.length < depth)
        throw InputError("Reservoir/Length is " + number_text(properties.length) +
                         " m, shorter than the depth of " + number_text(depth) +
                         " m. Set at least one depth, or 0 for two depths.");
      return properties;
    }

    /** Throws InputError if the volumes of a mesh file do not touch the whole wet face. */
    void check_cover(const WaterCoupling &coupling, const WaterMesh &water_mesh)
    {
      Vector3 wet{};
      for (const Vector3 &part : coupling.area)
        add(wet, part);
      if (norm(wet - water_mesh.wet_area) > .05 * norm(wet))
        throw InputError("Mesh of the water: the volume \"water\" of the mesh file touches " +
                         number_text(std::round(norm(water_mesh.wet_area))) +
                         " m2 of the upstream face of the dam, whose part below the water level has " +
                         number_text(std::round(norm(wet))) +
                         " m2 (both along their mean normal). Mesh the water at the whole wet face.");
    }

    /** Sets Body::reaction: @p factor A A^T, with a factor for each water node: rho^2 / (dt D). */
    void set_reaction(const WaterCoupling &coupling, const std::vector<double> &factor, Structure &structure)
    {
      const auto &shares = coupling.shares;
      const auto  for_pairs = [&](const auto &action)
      {
        for (std::size_t first = 0, end; first < shares.size(); first = end)
        {
          for (end = first; end < shares.size() && shares[end].water == shares[first].water;)
            ++end;
          for (std::size_t i = first; i < end; ++i)
            for (std::size_t j = first; j < end; ++j)
              if (shares[i].wet != rigid_ground && shares[j].wet != rigid_ground)
                action(shares[i], shares[j]);
        }
      };
      std::vector<std::set<std::pair<unsigned int, unsigned int>>> pairs(structure.bodies.size());
      for_pairs(
          [&](const WaterCoupling::Share &a, const WaterCoupling::Share &b)
          {
            const unsigned int body = structure.body_of(coupling.dam_nodes[a.wet]),
                               first = structure.bodies[body].first_node;
            pairs[body].insert({coupling.dam_nodes[a.wet] - first, coupling.dam_nodes[b.wet] - first});
          });
      for (std::size_t b = 0; b < pairs.size(); ++b)
      {
        std::vector<std::vector<unsigned int>> columns(structure.bodies[b].n_nodes());
        for (const auto &[row, column] : pairs[b])
          columns[row].push_back(column);
        structure.bodies[b].stiffness.extend(std::move(columns));
        structure.bodies[b].reaction.assign(structure.bodies[b].stiffness.value.size(), Matrix3{});
        for (const auto &pair : pairs[b])
          if (pair.first == pair.second)
            structure.bodies[b].reacting.push_back(pair.first);
      }
      for_pairs(
          [&](const WaterCoupling::Share &a, const WaterCoupling::Share &b)
          {
            Body              &body = structure.bodies[structure.body_of(coupling.dam_nodes[a.wet])];
            const unsigned int row = coupling.dam_nodes[a.wet] - body.first_node,
                               column = coupling.dam_nodes[b.wet] - body.first_node;
            const auto from = body.stiffness.column.begin() + body.stiffness.start[row];
            const auto at =
                std::lower_bound(from, body.stiffness.column.begin() + body.stiffness.start[row + 1], column);
            Matrix3 &block = body.reaction[at - body.stiffness.column.begin()];
            for (unsigned int c = 0; c < 3; ++c)
              for (unsigned int d = 0; d < 3; ++d)
                block[3 * c + d] += factor[a.water] * a.area[c] * b.area[d];
          });
    }
  } // namespace

  AcousticWater::AcousticWater(const SolidModel &dam, Structure &structure, Foundation &foundation,
                               const WaterProperties &given, const double level, const HexMesh *volumes)
      : level(level), dam(dam), structure(structure), foundation(foundation),
        properties(complete(given, depth_below(wet_quads(dam), level))),
        water_mesh(water_mesh_of(dam, level, volumes, properties)),
        coupling(dam, water_mesh, level, properties.h), far_mesh(water_mesh.far_channel())
  {
    if (volumes != nullptr)
      check_cover(coupling, water_mesh);
  }

  /** Returns the words on larger elements, with a size for which the present time step is small enough. */
  std::string AcousticWater::larger_elements() const
  {
    if (water_mesh.of_file)
      return ", or use larger elements in the volumes \"water\" of the mesh file";
    WaterProperties larger = properties;
    larger.h *= std::max(1., .8 * std::sqrt(model->mass_factor / largest_mass_factor)); // near the right size
    for (larger.h *= 1.1; larger.h < .5 * properties.depth; larger.h *= 1.1)
      try
      {
        larger.h = rounded(larger.h);
        const WaterMesh mesh = channel(dam, level, larger);
        if (WaterModel(mesh, larger, dt).mass_factor <= largest_mass_factor &&
            !WaterCoupling(dam, mesh, level, larger.h).shares.empty())
          return ", or \"Reservoir/Element size\" to " + number_text(larger.h);
      }
      catch (const CoarseWater &)
      {
      }
    return "";
  }

  void AcousticWater::prepare(const double time_step, const unsigned int steps_per_sample,
                              const unsigned int n)
  {
    is_explicit = n > 0;
    n_steps = std::max(n, 1u);
    dt = time_step / n_steps;
    model = std::make_unique<WaterModel>(water_mesh, properties, dt);
    far = std::make_unique<WaterModel>(far_mesh, properties, dt);
    if (model->mass_factor <= largest_mass_factor)
      return;
    const double factor = model->mass_factor;
    unsigned int more = 2;
    while (WaterModel(water_mesh, properties, dt / more).mass_factor > largest_mass_factor)
      more *= 2;
    throw InputError("Compressible water: the time step of " + number_text(dt) +
                     " s is above the critical time step of the water, " + number_text(model->critical_step) +
                     " s. It would need " + number_text(std::round(100. * factor) / 100.) +
                     " times the mass of the water (limit 1.3). Set \"Dynamics/Steps per sample\" to " +
                     std::to_string(more * steps_per_sample) + larger_elements() + ".");
  }

  void AcousticWater::report(Log &log, const std::vector<double> &depths) const
  {
    log.line("Water     level %g m; %u nodes, elements of %.3g m, %.3g m3", level, model->n_nodes(),
             properties.h, model->volume);
    if (water_mesh.of_file)
      log.line(
          "          volumes of the mesh file: %u nodes at the dam, %zu faces at bed and banks, %zu at the end; %s",
          water_mesh.n_wet(), water_mesh.bed.size(), water_mesh.end.size(),
          *std::max_element(water_mesh.layer.begin(), water_mesh.layer.end()) > 0.
              ? "damping layer before the end"
              : "no damping layer");
    if (dt == 0.)
      return;
    log.line("          compressible; critical time step %.3g s; mass increased by the factor %.3f",
             model->critical_step, model->mass_factor);
    if (properties.reflection > .9 && properties.length < 5.99 * properties.depth && !water_mesh.of_file)
      log.line(
          "warning: near the first frequency of the channel its end reflects, up to 24 %% of the force. Set "
          "Reservoir/Length to %g m, or Reservoir/Reflection to at most 0.9.",
          std::ceil(6. * properties.depth));
    for (const double depth : depths)
    {
      const Vector3 at = point_at(depth).place;
      log.line("          pressure_%s at (%.2f, %.2f, %.2f) m", number_text(depth).c_str(), at[0], at[1],
               at[2]);
    }
    if (!foundation.moves_base())
      log.line(
          "          bed and banks move with the free field of the rock; the water does not act on the rock "
          "upstream of the dam");
    if (model->mass_factor > noticeable_mass_factor)
      log.line(
          "warning: the mass of the water is increased by %.1f %% for the time step of %g s. Frequencies change "
          "by up to a third of this. Increase Dynamics/Steps per sample, or the size of the water elements.",
          100. * (model->mass_factor - 1.), dt);
  }

  void AcousticWater::start(const GroundMotion &motion, const TimeGrid &grid, const Unknowns &u)
  {
    ensure(model && dt == grid.dt / n_steps, "AcousticWater::prepare() comes before start().");
    const std::size_t  n = model->n_nodes();
    const GroundMotion fine = motion.refined(n_steps);
    for (const auto &v : fine.integrated().velocity)
      ground_velocity.push_back({{v[0], v[1], v[2]}});
    for (std::size_t i = 0; i < n; ++i)
    {
      D.push_back(model->mass[i] / dt + .5 * (model->bed_damping[i] + model->end_damping[i]));
      inverse.push_back(model->at_surface[i] ? 0. : 1. / D.back());
    }
    pi.assign(n, 0.);
    phi = before = K_phi = pi;
    mean.assign(coupling.area.size(), 0.);
    for (std::size_t i = 0; i < far->n_nodes(); ++i)
      far_inverse.push_back(far->at_surface[i] ? 0. : 1. / (far->mass[i] / dt + .5 * far->bed_damping[i]));
    far_pi.assign(far->n_nodes(), 0.);
    far_phi = far_mean = far_pi;
    const std::vector<Vector3> &places = water_mesh.places;
    bed_velocity.assign(places.size(), Vector3{});
    valley = foundation.valley(places);
    steps_of_valley = is_explicit ? 1 : grid.substeps;
    valley_place.assign(valley ? 3 * places.size() : 0, 0.);
    valley_velocity = valley_place;
    if (!motion.stations.empty())
      banks = std::make_unique<BaseMotion>(fine, places);
    for (const unsigned int node : coupling.dam_nodes)
      for (unsigned int c = 0; c < 3; ++c)
        u_wet.push_back(u[3 * std::size_t(node) + c]);
    record.assign(n_records, 0.);
    std::vector<double> factor;
    for (const double x : inverse)
      factor.push_back(properties.density * properties.density * x / dt);
    if (!is_explicit)
      set_reaction(coupling, factor, structure);
  }

  /** Computes the mean velocities of bed and banks in the step. */
  void AcousticWater::find_bed_velocity()
  {
    const std::size_t step = record[steps], last = ground_velocity.size() - 1;
    Vector3           v_g;
    for (unsigned int c = 0; c < 3; ++c)
      v_g[c] = .5 * (ground_velocity[std::min(step, last)][c] + ground_velocity[std::min(step + 1, last)][c]);
    base_velocity = foundation.moves_base() ? v_g : Vector3{};
    std::fill(bed_velocity.begin(), bed_velocity.end(), v_g);
    if (banks)
    {
      const Unknowns now = banks->displacement(step * dt), then = banks->displacement((step + 1) * dt);
      for (std::size_t k = 0; k < now.size(); ++k)
        bed_velocity[k / 3][k % 3] += (then[k] - now[k]) / dt;
    }
    if (!valley)
      return;
    const Unknowns place = valley->advance(steps_of_valley);
    const double   lead = valley->lead();
    for (std::size_t k = 0; k < place.size(); ++k)
    {
      const double velocity = (place[k] - valley_place[k]) / dt; // interpolated linearly
      bed_velocity[k / 3][k % 3] = velocity - lead / dt * (velocity - valley_velocity[k]);
      valley_velocity[k] = velocity;
    }
    valley_place = place;
  }

  /** Computes pi at the end of the step for a dam at rest. */
  void AcousticWater::predict()
  {
    find_bed_velocity();
    const double rho = properties.density;
    far->multiply(far_phi, K_phi);
    for (std::size_t i = 0; i < far_pi.size(); ++i)
    {
      const double C = far->bed_damping[i],
                   pi = ((far->mass[i] / dt - .5 * C) * far_pi[i] - K_phi[i] +
                         rho * dot(far->ground[i], bed_velocity[far_mesh.column[i]])) *
                        far_inverse[i];
      far_mean[i] = .5 * (far_pi[i] + pi);
      far_pi[i] = pi;
      far_phi[i] += dt * pi;
    }
    model->multiply(phi, K_phi);
    before = pi;
#pragma omp parallel for schedule(static)
    for (int i = 0; i < static_cast<int>(pi.size()); ++i)
    {
      const double C = model->bed_damping[i] + model->end_damping[i];
      double       source = dot(model->ground[i], bed_velocity[water_mesh.column[i]]);
      if (i < static_cast<int>(coupling.area.size()))
        source += dot(coupling.area[i], base_velocity);
      pi[i] = ((model->mass[i] / dt - .5 * C) * pi[i] - K_phi[i] + rho * source +
               model->end_damping[i] * far_mean[water_mesh.far[i]]) *
              inverse[i];
    }
  }

  void AcousticWater::add_forces(Unknowns &load) const
  {
    const double rho = properties.density;
    for (const WaterCoupling::Share &share : coupling.shares)
      for (unsigned int c = 0; c < 3 && share.wet != rigid_ground; ++c)
        load[3 * std::size_t(coupling.dam_nodes[share.wet]) + c] -= rho * share.area[c] * pi[share.water];
  }

  void AcousticWater::advance(Unknowns &load)
  {
    const Stopwatch watch;
    if (is_explicit)
      return mean.assign(mean.size(), 0.);
    predict();
    add_forces(load);
    watch_total += watch.seconds();
  }

  void AcousticWater::update_from_dam(const DynamicState &state)
  {
    const Stopwatch watch;
    if (is_explicit)
      return;
    correct(state.u);
    for (std::size_t i = 0; i < mean.size(); ++i)
      mean[i] = .5 * (pi[i] + before[i]);
    watch_total += watch.seconds();
  }

  void AcousticWater::advance(const Unknowns &u, const Unknowns &)
  {
    const Stopwatch watch;
    for (std::size_t i = 0; i < mean.size(); ++i)
      mean[i] += pi[i] / n_steps;
    predict();
    correct(u);
    watch_total += watch.seconds();
  }

  /** Adds the effect of the dam's displacement @p u_end at the end of the step to pi. Advances phi and the works. */
  void AcousticWater::correct(const Unknowns &u_end)
  {
    const double        rho = properties.density;
    std::vector<double> source(coupling.area.size(), 0.); // volume that the dam displaces [m^3]
    std::vector<double> change;
    for (std::size_t k = 0; k < coupling.dam_nodes.size(); ++k)
      for (unsigned int c = 0; c < 3; ++c)
      {
        const double u = u_end[3 * std::size_t(coupling.dam_nodes[k]) + c];
        change.push_back(u - u_wet[3 * k + c]);
        u_wet[3 * k + c] = u;
      }
    for (const WaterCoupling::Share &share : coupling.shares)
      for (unsigned int c = 0; c < 3 && share.wet != rigid_ground; ++c)
        source[share.water] += share.area[c] * change[3 * share.wet + c];
    for (std::size_t i = 0; i < source.size(); ++i)
      pi[i] += rho * source[i] * inverse[i] / dt;

    double stored = 0.;
    for (std::size_t i = 0; i < pi.size(); ++i)
    {
      const double half = .5 * (pi[i] + before[i]);
      phi[i] += dt * pi[i];
      stored += .5 * model->mass[i] * pi[i] * pi[i] + .5 * K_phi[i] * phi[i];
      record[radiated] += dt * half * model->end_damping[i] * (half - far_mean[water_mesh.far[i]]);
      record[absorbed] += dt * half * model->bed_damping[i] * half;
      if (i < source.size())
        record[work_of_dam] += rho * half * source[i];
      record[work_of_ground] += dt * rho * half * dot(model->ground[i], bed_velocity[water_mesh.column[i]]);
      if (i < source.size())
        record[work_of_ground] += dt * rho * half * dot(coupling.area[i], base_velocity);
    }
    record[energy] = stored;
    record[largest] = std::max({record[largest], stored, std::abs(record[radiated]), record[absorbed],
                                std::abs(record[work_of_dam]), std::abs(record[work_of_ground])});
    record[steps] += 1.;
  }

  std::vector<std::pair<std::string, double>> AcousticWater::energies() const
  {
    if (record.empty())
      return {};
    return {{"water", record[energy]},
            {"water_radiated", record[radiated]},
            {"water_absorbed", record[absorbed]},
            {"water_from_dam", record[work_of_dam]},
            {"water_from_ground", record[work_of_ground]}};
  }

  double AcousticWater::balance_error() const
  {
    if (record.empty() || record[largest] == 0.)
      return 0.;
    return std::abs(record[energy] + record[radiated] + record[absorbed] - record[work_of_dam] -
                    record[work_of_ground]) /
           record[largest];
  }

  void AcousticWater::report_balance(Log &log) const
  {
    if (!record.empty())
      log.line("          error of the energy balance of the water %.1e (same limit)", balance_error());
  }

  std::vector<std::vector<double> *> AcousticWater::state()
  {
    if (record.empty())
      return {};
    std::vector<std::vector<double> *> arrays;
    arrays = {&pi, &phi, &u_wet, &record};
    arrays.insert(arrays.end(), {&far_pi, &far_phi, &valley_place, &valley_velocity});
    if (valley)
      for (std::vector<double> *array : valley->state())
        arrays.push_back(array);
    return arrays;
  }

  double AcousticWater::static_pressure(const unsigned int node) const
  {
    return properties.density * gravity * (level - water_mesh.points[node][2]);
  }

  std::vector<double> AcousticWater::pressure() const
  {
    std::vector<double> result;
    for (std::size_t i = 0; i < water_mesh.n_wet(); ++i)
      result.push_back(pi.empty() ? 0. : -properties.density * pi[i]);
    return result;
  }

  PressurePoint AcousticWater::point_at(const double depth) const
  {
    if (depth > properties.depth)
      throw InputError("Output/Pressure depths contains " + number_text(depth) +
                       " m, but the depth of the reservoir is " + number_text(properties.depth) +
                       " m. Reduce it.");
    return pressure_point(water_mesh, level - depth);
  }

  std::vector<double> AcousticWater::at_dam(const std::vector<double> &values) const
  {
    std::vector<double> result(dam.n_nodes(), 0.);
    for (unsigned int i = 0; i < dam.n_nodes() && !values.empty(); ++i)
      if (const unsigned int water = coupling.nearest[i]; water != rigid_ground)
        result[i] = values[water];
    return result;
  }

  std::vector<Vector3> AcousticWater::mean_force() const
  {
    std::vector<Vector3> result(dam.n_nodes(), Vector3{});
    for (const WaterCoupling::Share &share : coupling.shares)
      for (unsigned int c = 0; c < 3 && !pi.empty(); ++c)
        result[share.node][c] -= properties.density * share.area[c] * mean[share.water];
    return result;
  }
} // namespace Voussoir
