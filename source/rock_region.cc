#include <voussoir/error.h>
#include <voussoir/rock_region.h>

namespace Voussoir
{
  namespace
  {
    bool is_transmitting(const RockRegionParameters &parameters)
    {
      return parameters.boundary.compare(0, 3, "mtf") == 0;
    }

    TransmittingFormula formula_of(const RockRegionParameters &parameters, const TransmittingFormula *given)
    {
      return given != nullptr ? *given : transmitting_formula(parameters.boundary);
    }
  } // namespace

  std::unique_ptr<ExplicitRegion> make_region(const RockModel &model, const RockRegionParameters &parameters,
                                              const TransmittingFormula *formula)
  {
    auto region =
        std::make_unique<ExplicitRegion>(model.stiffness, model.mass, parameters.damping, parameters.dt);
    const std::string &name = parameters.boundary;
    if (is_transmitting(parameters))
      region->set_boundary(TransmittingBoundary(formula_of(parameters, formula), model.lines, parameters.dt));
    else if (name == "viscous")
      region->set_boundary(viscous_boundary(model, parameters.rock.centre, 0., 0.));
    else if (name == "viscous-spring")
      region->set_boundary(viscous_boundary(model, parameters.rock.centre, 4. / 3., 2. / 3.));
    else if (name == "fixed")
      for (const BoundaryFace &face : model.faces)
        region->fix_nodes({face.nodes.begin(), face.nodes.end()});
    else
      throw InputError("there is no artificial boundary \"" + name +
                       "\"; use mtf1, mtf2, mtf3, mtf4, viscous-spring, viscous or fixed");
    return region;
  }

  namespace
  {
    void add_points(FreeField &field, const ExplicitRegion &region, const RockModel &model,
                    const RockRegionParameters &parameters, const TransmittingFormula *formula)
    {
      if (is_transmitting(parameters))
        field.add_lines(model, formula_of(parameters, formula).n_nodes());
      else
        field.add_nodes(model, region.free_field_nodes());
    }
  } // namespace

  std::unique_ptr<FreeField> make_free_field(const HexMesh &mesh, const RockModel &model,
                                             const RockRegionParameters &parameters, const IncidentWave &wave,
                                             const unsigned int n_steps, const TransmittingFormula *formula)
  {
    auto field = std::make_unique<FreeField>(model, parameters.damping, parameters.dt, n_steps, wave);
    if (parameters.free_field == "sections")
      for (const int sense : {-1, 1})
      {
        const HexMesh section = extruded_section(mesh, parameters.rock, 0, sense);
        if (section.cells.empty())
          continue;
        RockRegionParameters plane = parameters; // its waves come from its own middle
        plane.rock.centre[0] = section.nodes[0][0];
        RockModel slice = make_rock_model(section, plane.rock, tie_layer(section, 0));
        auto      motion = make_region(slice, plane, formula);
        shake(*motion, section, slice, plane, wave, n_steps, formula); // has no such faces itself
        field->add_section(std::move(slice), std::move(motion), 0);
      }
    else if (parameters.free_field != "columns")
      throw InputError("there is no free field \"" + parameters.free_field + "\"; use columns or sections");
    return field;
  }

  void shake(ExplicitRegion &region, const HexMesh &mesh, const RockModel &model,
             const RockRegionParameters &parameters, const IncidentWave &wave, const unsigned int n_steps,
             const TransmittingFormula *formula)
  {
    if (parameters.boundary == "fixed")
      throw InputError("an earthquake cannot come in through a fixed artificial boundary; use another one");
    auto field = make_free_field(mesh, model, parameters, wave, n_steps, formula);
    add_points(*field, region, model, parameters, formula);
    region.set_free_field(std::move(field));
  }
} // namespace Voussoir
