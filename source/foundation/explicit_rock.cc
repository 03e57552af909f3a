// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/error.h>
#include <voussoir/base/internal_error.h>
#include <voussoir/foundation/explicit_rock.h>
#include <voussoir/foundation/foundation_check.h>
#include <voussoir/foundation/region_parameters.h>
#include <voussoir/foundation/rock_report.h>
#include <voussoir/motion/ground_motion.h>
#include <voussoir/rock/arrival.h>
#include <voussoir/rock/boundary_table.h>
#include <voussoir/rock/rock_part.h>
#include <voussoir/solid/critical_step.h>

#include <algorithm>
#include <cmath>
#include <limits>
#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace Voussoir
{
  namespace
  {
    /** Returns freed memory to the operating system, except for blocks between allocations that are in use. */
    void release_free_memory()
    {
#ifdef __GLIBC__
      malloc_trim(0);
#endif
    }

    /** Returns the CPU time of a time step at each node, relative to a node with nodal quadrature only.
     * @p near_base: nodes that RockPatch computes, too. */
    std::vector<double> work_of_nodes(const RockModel &model, const std::vector<unsigned int> &near_base)
    {
      constexpr double    of_row = 2.5, of_look_ahead = 1.5; // measured with benchmarks/ranks.py
      std::vector<double> result(model.points.size(), 1.);
      for (std::size_t i = 0; i < result.size(); ++i)
        if (model.in_other_cell[i])
          result[i] += of_row;
      for (const unsigned int i : near_base)
        result[i] += of_look_ahead;
      return result;
    }
  } // namespace

  ExplicitRock::ExplicitRock(const FoundationSite &site)
      : parameters(site.parameters), mesh(site.parameters.volumes_by_material(site.mesh)),
        source(site.source), generated_in(site.generated_in), incompatible_modes(site.incompatible_modes)
  {
    for (const PlaneWave &wave : read_incidence(parameters.incidence)) // reports errors before any work
      if (parameters.plane_strain && (wave.type == PlaneWave::SH || std::abs(std::sin(wave.azimuth)) > 1e-9))
        throw InputError(
            "With \"Mesh/Plane strain\", waves move in the plane x, z. Entry \"Foundation/Incidence\" "
            "allows P and SV waves with the azimuth 0 or 180 only. Correct it.");
    check_damping(region_parameters(parameters, {}, 0.));
    if (site.degree != 1)
      throw InputError("Foundation/Model = rock requires Elements/Degree = 1, not " +
                       std::to_string(site.degree) +
                       ", because dam and rock share their nodes. Set \"Elements/Degree\" to 1, or "
                       "\"Foundation/Model\" to massless.");
  }

  namespace
  {
    /** Returns the centre of the base at the height of its lowest node, where the waves arrive together [m]. */
    Vector3 lowest_base_place(const RockModel &model, const std::vector<BaseNode> &at_base,
                              const Vector3 &centre)
    {
      double lowest = std::numeric_limits<double>::max();
      for (const BaseNode &f : at_base)
        lowest = std::min(lowest, model.points[f.rock][2]);
      return {{centre[0], centre[1], lowest}};
    }

    /** Returns the mean position of the base nodes of the rock, each once however many monoliths stand on it [m]. */
    Vector3 centre_of(const std::vector<Vector3> &points, const std::vector<BaseNode> &at_base)
    {
      Vector3 sum{};
      for (const BaseNode &f : at_base)
        add(sum, points[f.rock]);
      return {{sum[0] / at_base.size(), sum[1] / at_base.size(), sum[2] / at_base.size()}};
    }

    /** Returns the travel times of the waves with motion in x, y and z to the lowest base node, those of
     * oblique waves with the largest delay [s]. */
    Vector3 times_to(const RockModel &model, const Vector3 &place, const Incidence &incidence)
    {
      if (incidence.is_vertical() || model.columns.empty())
        return travel_times(model, place[2]);
      double latest = 0.;
      for (const PlaneWave &wave : incidence.waves)
        latest = std::max(latest, wave.delay);
      const double time = latest + arrival_time(model, incidence, place);
      return {{time, time, time}};
    }
  } // namespace

  void ExplicitRock::add_stiffness(const SolidModel &dam, Structure &)
  {
    check_boundary_layers(parameters, mesh, source, generated_in);
    centre = centre_of(mesh.nodes, find_base_nodes(dam, mesh.nodes, source));
    const auto find = [&](const std::vector<Vector3> &points)
    {
      at_base = find_base_nodes(dam, points, source);
      return rock_nodes(at_base);
    };
    RockParameters rock = region_parameters(parameters, centre, 0.).rock;
    rock.incompatible_modes = incompatible_modes;
    model = make_rock_part(mesh, rock, find, parameters.n_substeps());
    for (BoundaryLine &line : model.lines)
      line.distance *= parameters.plane_strain ? 2. : 1.; // waves in a plane spread as r^(-1/2)
    static_state = std::make_unique<RockStaticState>(
        model, at_base, parameters.sustained_ratio(), !dam.on_footings.empty(),
        !make_boundary(parameters.boundary)->absorbs(), parameters.plane_strain);
    arrives = times_to(model, lowest_base_place(model, at_base, centre),
                       region_parameters(parameters, centre, 0.).incidence);
    mesh = HexMesh(); // no longer needed
    release_free_memory();
    dt_critical = Voussoir::critical_time_step(largest_frequency(make_operator(model), model.mass),
                                               region_parameters(parameters, centre, 0.).damping);
    dt_boundary = largest_boundary_step(parameters, model);
  }

  namespace
  {
    /** Returns the static state of the rock, which must exist. */
    RockStaticState &existing(const std::unique_ptr<RockStaticState> &state)
    {
      ensure(state != nullptr, "The static state requires add_stiffness() before and start() after.");
      return *state;
    }
  } // namespace

  Unknowns ExplicitRock::static_springs(const Structure &structure) const
  {
    return existing(static_state).springs(structure);
  }

  ContactResult ExplicitRock::solve_static(const DamSolve &solve, const Unknowns &springs, const Unknowns &u,
                                           Unknowns &load, std::string &failure, Log &log)
  {
    return existing(static_state).solve(solve, springs, u, load, failure, log);
  }

  /** P waves enter later than the slower S waves, so that all components of the ground motion arrive at the
   * lowest base node at the same time. */
  void ExplicitRock::make_rock(const GroundMotion &outcrop, const TimeGrid &steps, const double delay,
                               const std::vector<unsigned int> &near_base)
  {
    static_state.reset();
    release_free_memory();
    grid = steps;
    delay_of_region = delay;
    RockRegionParameters p = region_parameters(parameters, centre, grid.substep());
    p.incidence = timed(model, p.incidence, lowest_base_place(model, at_base, centre));
    RockSplit split(work_of_nodes(model, near_base));
    split.step_everywhere(rock_nodes(at_base));
    if (!split.is_trivial() && !near_base.empty())
    {
      std::vector<unsigned int> count(Ranks::size(), 0);
      for (const unsigned int i : near_base)
        ++count[split.owner(i)];
      predicting_rank = std::max_element(count.begin(), count.end()) - count.begin();
      split.step(near_base, predicting_rank);
    }
    region = make_region(model, p, std::move(split));
    const IncidentWave wave =
        [all = incident_wave(outcrop), y = parameters.plane_strain ? 0. : 1.](const double t)
    {
      const Vector3 u = all(t);
      return Vector3{{u[0], y * u[1], u[2]}};
    };
    const double wait = delay + arrives[0] - arrives[2];
    rising = [wave, delay, wait](const double t)
    {
      const Vector3 s = wave(t - delay), p = wave(t - wait);
      return Vector3{{s[0], s[1], p[2]}};
    };
    if (grid.n > 0) // 0: no earthquake
      shake(*region, model, p, rising, grid.n_substeps() + 2);
    model.stiffness = BlockSparseMatrix(); // frees memory; not used by the region
    region->keep_energy();
    balance = std::make_unique<RockBalance>(*region, base() == Base::coupled);
    rock_monitor = std::make_unique<RockMonitor>(parameters, model, *region, *balance);
  }

  namespace
  {
    class ValleyOnRock : public ValleyMotion
    {
    public:
      /** @p delay: shift of the incident waves relative to the time of the field [s]. */
      ValleyOnRock(std::unique_ptr<FreeField> field, const std::vector<Vector3> &places, const TimeGrid &grid,
                   const double delay)
          : field(std::move(field)), places(places), grid(grid), delay(delay)
      {
        if (delay > 0.) // else the field has the time of the dam
          this->field->advance();
      }

      Unknowns advance(const unsigned int n) override
      {
        for (unsigned int j = 0; j < n; ++j)
          field->advance();
        return field->upstream(places);
      }

      double lead() const override { return delay > 0. ? grid.substep() - delay : 0.; }

      std::vector<std::vector<double> *> state() override { return field->state(); }

    private:
      std::unique_ptr<FreeField> field;
      const std::vector<Vector3> places;
      const TimeGrid             grid;
      const double               delay;
    };
  } // namespace

  std::unique_ptr<ValleyMotion> ExplicitRock::valley(const std::vector<Vector3> &places)
  {
    RockRegionParameters p = region_parameters(parameters, centre, grid.substep());
    p.incidence = timed(model, p.incidence, lowest_base_place(model, at_base, centre));
    return std::make_unique<ValleyOnRock>(make_free_field(model, p, rising, grid.n_substeps() + 3), places,
                                          grid, delay_of_region);
  }

  void ExplicitRock::finish_step(const double time)
  {
    region->gather_energy();
    rock_monitor->gather_motion(static_cast<unsigned int>(std::lround(time / grid.dt)), grid.n);
    balance->update_largest();
  }

  void ExplicitRock::check(const TimeGrid &steps, const unsigned int steps_per_sample) const
  {
    check_rock_step(parameters, steps, steps_per_sample, dt_critical, dt_boundary);
    const RockRegionParameters region_at = region_parameters(parameters, centre, steps.substep());
    check_boundary(parameters, region_at, model, rock_nodes(at_base), dt_critical);
    check_waves(model, region_at);
  }

  void ExplicitRock::report(Log &log, const TimeGrid &steps) const
  {
    report_rock(parameters, model, steps, delay(), log);
    if (steps.substeps > 1)
      log.line(
          "          %u rock steps in each step of the dam; the critical time step of the rock is %.4g s",
          steps.substeps, dt_critical);
  }

  void ExplicitRock::add_to_summary(Json &summary, const TimeGrid &steps) const
  {
    const auto n_nodes = static_cast<unsigned int>(model.points.size());
    Json       json;
    json.add("nodes", n_nodes)
        .add("dofs", 3. * n_nodes)
        .add("boundary", parameters.boundary)
        .add("nodal_layers", region_parameters(parameters, {}, 0.).rock.nodal_layers)
        .add("elements_at_dam", model.n_cells_at_dam - model.n_nodal_at_dam)
        .add("arrival", arrives[0])
        .add("time_step", steps.substep())
        .add("critical_time_step", dt_critical);
    if (balance)
      json.add("transmitted_energy", balance->of_rock().transmitted)
          .add("energy_balance_error", balance->error());
    summary.add("rock", json);
  }

  std::vector<std::pair<std::string, double>> ExplicitRock::energies() const
  {
    return balance ? balance->columns() : std::vector<std::pair<std::string, double>>();
  }

  double ExplicitRock::balance_error() const
  {
    return balance ? balance->error() : 0.;
  }

  void ExplicitRock::report_balance(Log &log) const
  {
    if (balance)
      log.line("          error of the energy balance of the rock %.1e (same limit)", balance->error());
  }
} // namespace Voussoir
