// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/error.h>
#include <voussoir/rock/arrival.h>
#include <voussoir/rock/boundary_table.h>
#include <voussoir/rock/oblique_section.h>
#include <voussoir/rock/rock_region.h>
#include <voussoir/rock/section_nodes.h>
#include <voussoir/rock/zone_forces.h>

#include <algorithm>
#include <cmath>

namespace Voussoir
{
  std::unique_ptr<ArtificialBoundary> make_boundary(const RockRegionParameters &parameters)
  {
    return parameters.boundary_maker ? parameters.boundary_maker() : make_boundary(parameters.boundary);
  }

  std::unique_ptr<ExplicitRegion> make_region(const RockModel &model, const RockRegionParameters &parameters,
                                              RockSplit split)
  {
    auto region =
        std::make_unique<ExplicitRegion>(make_operator(model), model.mass, parameters.damping, parameters.dt);
    auto boundary = make_boundary(parameters);
    boundary->attach(model, parameters.rock.centre, parameters.dt);
    region->set_boundary(std::move(boundary));
    if (!split.is_trivial())
    {
      RockOperator part = make_operator(model, split);
      region->split_up(std::move(split), std::move(part));
    }
    return region;
  }

  namespace
  {
    void add_points(FreeField &field, const ArtificialBoundary &boundary, const RockModel &model)
    {
      if (boundary.nodes_per_line() > 0)
        field.add_lines(model, boundary.nodes_per_line());
      else
        field.add_nodes(model, boundary.free_field_nodes());
    }
  } // namespace

  RockRegionParameters of_sections(const RockRegionParameters &parameters)
  {
    RockRegionParameters result = parameters;
    result.rock.layers_at_dam = 0;
    if (!make_boundary(parameters)->absorbs())
    {
      result.boundary = RockRegionParameters().boundary;
      result.boundary_maker = nullptr;
    }
    return result;
  }

  namespace
  {
    /** Returns the nodes that a process integrates, and their neighbours. */
    std::vector<bool> stepped_or_near(const RockModel &model, const RockSplit &split, const unsigned int rank)
    {
      std::vector<bool> result(model.points.size());
      for (unsigned int i = 0; i < result.size(); ++i)
        result[i] = split.is_stepped(i, rank);
      for (const NodalCell &cell : model.nodal_cells)
        for (unsigned int v = 0; v < 8; ++v)
          for (unsigned int w = 0; w < 8 && split.is_stepped(cell.nodes[v], rank); ++w)
            if (w != (v ^ 7u)) // the ends of a diagonal are not coupled
              result[cell.nodes[w]] = true;
      const BlockSparseMatrix &K = model.stiffness;
      for (unsigned int i = 0; i < result.size(); ++i)
        for (std::size_t k = K.start[i];
             k < K.start[i + 1] && model.in_other_cell[i] && split.is_stepped(i, rank); ++k)
          result[K.column[k]] = true;
      return result;
    }

    /** Returns the distribution of a section. A process integrates the section at the nodes of @p model that
     * it integrates, and at their neighbours. */
    RockSplit split_of_section(const RockModel &slice, const unsigned int direction, const RockModel &model,
                               const RockSplit &split)
    {
      if (split.is_trivial())
        return RockSplit();
      RockSplit                                       result(slice.points.size());
      const SectionNodes                              nodes(slice, direction, model);
      std::vector<std::optional<SectionNodes::Place>> on_slice; // per node of the model
      for (const Vector3 &p : model.points)
        on_slice.push_back(nodes.find(p));
      for (unsigned int r = 0; r < Ranks::size(); ++r)
      {
        const std::vector<bool>   near = stepped_or_near(model, split, r);
        std::vector<unsigned int> seen;
        for (unsigned int i = 0; i < on_slice.size(); ++i)
          for (unsigned int j = 0; near[i] && on_slice[i] && j < 4; ++j)
            if (on_slice[i]->weight[j] != 0.)
              seen.push_back(on_slice[i]->node[j]);
        result.step(seen, r);
      }
      return result;
    }
  } // namespace

  namespace
  {
    double height(const HexMesh &mesh)
    {
      const auto box = bounding_box(mesh);
      return box.second[2] - box.first[2];
    }

    /** Waves with one slowness along the valley. */
    struct WaveGroup
    {
      double    p; ///< [s/m]
      Incidence incidence;
    };

    std::vector<WaveGroup> groups_of(const Incidence &incidence)
    {
      std::vector<WaveGroup> groups;
      if (incidence.is_vertical())
        return {{0., incidence}};
      for (const PlaneWave &wave : incidence.waves)
      {
        const double q = wave.slowness(*incidence.half_space), exact = q * std::cos(wave.azimuth);
        const double p = std::abs(exact) > 1e-9 * q ? exact : 0.; // across the valley
        auto         group =
            std::find_if(groups.begin(), groups.end(),
                         [p](const WaveGroup &g) { return std::abs(g.p - p) <= 1e-12 * std::abs(p); });
        if (group == groups.end())
          group = groups.insert(group, {p, {{}, incidence.centre, incidence.half_space}});
        group->incidence.waves.push_back(wave);
      }
      return groups;
    }

    /** Returns smallest and largest x of the model [m]. */
    std::array<double, 2> length_of(const RockModel &model)
    {
      std::array<double, 2> result = {{model.points[0][0], model.points[0][0]}};
      for (const Vector3 &point : model.points)
        result = {{std::min(result[0], point[0]), std::max(result[1], point[0])}};
      return result;
    }

    /** Returns the motion of a section under waves with the slowness @p p along the valley. */
    std::unique_ptr<SectionMotion> oblique_section(const WideSection &wide, const RockModel &slice,
                                                   const RockModel &inner, RockRegionParameters plane,
                                                   const double p, const RockModel &model,
                                                   const IncidentWave &wave, const unsigned int n_steps)
    {
      if (make_boundary(plane)->nodes_per_line() == 0)
      {
        plane.boundary = RockRegionParameters().boundary;
        plane.boundary_maker = nullptr;
      }
      plane.damping.stiffness = std::max(plane.damping.stiffness,
                                         ObliqueSection::least_damping(plane.rock.materials, p) * plane.dt);
      const std::array<double, 2> reach = length_of(model);
      const unsigned int ahead = ObliqueSection::steps_ahead(p, plane.incidence.centre[0], reach, plane.dt);
      auto strip = std::make_unique<ZoneStrip>(wide, slice, inner, 0, plane, wave, n_steps + ahead);
      return std::make_unique<ObliqueSection>(wide, slice, std::move(strip), make_boundary(plane), plane, p,
                                              reach);
    }

    /** Adds the section through one side of the model to @p field. */
    void add_section(FreeField &field, const HexMesh &section, const RockModel &model,
                     const RockRegionParameters &parameters, const IncidentWave &wave,
                     const unsigned int n_steps, const RockSplit &split)
    {
      RockRegionParameters plane = of_sections(parameters);
      plane.rock.centre[0] = section.nodes[0][0]; // the section has its own source point
      const std::string usual = RockRegionParameters().boundary;
      const RockModel   inner = make_rock_model(section, plane.rock, tie_layer(section, 0));
      const WideSection wide =
          widened(section, 0, parameters.width_of_zone * height(section),
                  std::max(make_boundary(plane)->n_layers(), make_boundary(usual)->n_layers()) + 1);
      plane.rock.nodal_layers += wide.n_layers;
      RockModel slice = make_rock_model(wide.mesh, plane.rock, tie_layer(wide.mesh, 0));
      for (BoundaryLine &line : slice.lines)
        line.distance *= 2.; // plane waves spread as r^(-1/2), those of a source in space as 1/r
      std::vector<std::unique_ptr<SectionMotion>> motions;
      for (const WaveGroup &group : groups_of(parameters.incidence))
      {
        plane.incidence = group.incidence;
        if (group.p == 0.)
        {
          auto strip = std::make_unique<ZoneStrip>(wide, slice, inner, 0, plane, wave, n_steps);
          motions.push_back(std::make_unique<StraightSection>(
              make_region(slice, plane, split_of_section(slice, 0, model, split)),
              std::make_unique<ZoneForces>(std::move(strip), plane)));
        }
        else
          motions.push_back(oblique_section(wide, slice, inner, plane, group.p, model, wave, n_steps));
      }
      field.add_section(slice, model, std::move(motions), 0);
    }
  } // namespace

  void check_waves(const RockModel &model, const RockRegionParameters &parameters)
  {
    const bool has_sections =
        parameters.free_field == "sections" &&
        std::any_of(model.faces.begin(), model.faces.end(),
                    [](const BoundaryFace &face) { return std::abs(face.normal[0]) > .7; });
    for (const RockColumn &column : model.columns)
      if (const double z = entrance(column), other = entrance(model.columns.front());
          parameters.damping.has_quality() && std::abs(z - other) > 1e-6 * (column.z.back() - z))
        throw InputError(
            "\"Foundation/Quality factor\" requires rock with a level bottom, but the waves enter at the heights " +
            std::to_string(z) + " and " + std::to_string(other) +
            " m. Use a mesh whose bottom is at one height, or set \"Foundation/Quality factor\" to 0.");
    for (const PlaneWave &wave : parameters.incidence.waves)
    {
      const Material half_space = half_space_of(model);
      for (const RockColumn &column : model.columns)
        check_incidence(wave, column.material, half_space);
      for (const auto &material : parameters.rock.materials)
        if (has_sections)
          check_incidence_along(wave, {material.second}, half_space);
    }
  }

  std::unique_ptr<FreeField> make_free_field(const RockModel &model, const RockRegionParameters &given,
                                             const IncidentWave &wave, const unsigned int n_steps,
                                             const RockSplit &split)
  {
    check_waves(model, given);
    RockRegionParameters parameters = given;
    if (!parameters.incidence.is_vertical())
      parameters.incidence.half_space = half_space_of(model);
    auto field = std::make_unique<FreeField>(model, parameters.damping, parameters.dt, n_steps, wave,
                                             parameters.incidence);
    if (parameters.free_field == "sections")
      for (const int sense : {-1, 1})
      {
        const HexMesh section = extruded_section(model, 0, sense);
        if (!section.cells.empty())
          add_section(*field, section, model, parameters, wave, n_steps, split);
      }
    else if (parameters.free_field != "columns")
      throw InputError("There is no free field \"" + parameters.free_field +
                       "\". Set \"Foundation/Free field\" to columns or sections.");
    return field;
  }

  void shake(ExplicitRegion &region, const RockModel &model, const RockRegionParameters &parameters,
             const IncidentWave &wave, const unsigned int n_steps)
  {
    auto field = make_free_field(model, parameters, wave, n_steps, region.parts());
    add_points(*field, *region.artificial_boundary(), model);
    if (region.is_split())
      field->split_up(region.artificial_boundary()->kept_points());
    region.set_free_field(std::move(field));
  }
} // namespace Voussoir
