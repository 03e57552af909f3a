#include <voussoir/base/error.h>
#include <voussoir/rock/rock_region.h>
#include <voussoir/rock/sections.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace Voussoir
{
  namespace
  {
    /** Does the boundary follow from a transmitting formula? A fixed one is that of order 0. */
    bool is_transmitting(const RockRegionParameters &parameters)
    {
      return parameters.boundary.compare(0, 3, "mtf") == 0 || parameters.boundary == "fixed";
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
      region->set_boundary(viscous_dashpots(model, parameters.rock.centre, 0., 0.));
    else if (name == "viscous-spring")
      region->set_boundary(viscous_dashpots(model, parameters.rock.centre, 4. / 3., 2. / 3.));
    else
      throw InputError("there is no artificial boundary \"" + name +
                       "\"; use mtf1, mtf2, mtf3, mtf4, mtf2-plain, viscous-spring, viscous or fixed");
    return region;
  }

  std::string stability_warning(const RockRegionParameters &p, const TransmittingFormula *formula)
  {
    // Needed: 6 layers without damping; without layers a stiffness damping of 0.2 dt (boxes of 12 cells).
    constexpr unsigned int enough_layers = 6;
    constexpr double       enough_damping = .2;
    if (!is_transmitting(p) || formula_of(p, formula).order() == 0)
      return "";
    std::string text;
    if (!p.rock.nodal_everywhere && p.rock.nodal_layers < enough_layers &&
        p.damping.stiffness < enough_damping * p.dt)
      text = "the transmitting boundary will be unstable: use nodal quadrature in 6 layers of rock at the "
             "artificial boundary, or stiffness-proportional damping of at least 0.2 time steps";
    const auto f = formula_of(p, formula);
    if (text.empty() && f.order() > 2 && !p.rock.nodal_everywhere)
      text = "a transmitting boundary of order 3 or 4 becomes unstable in large boxes of rock with Gauss "
             "points: "
             "use nodal quadrature everywhere, or mtf2";
    const auto rigid = [](const TransmittingFactor &factor)
    { return factor.gamma_p <= 0. && factor.gamma_s <= 0.; };
    if (f.order() > 1 && std::all_of(f.factors.begin(), f.factors.end(), rigid))
      text += std::string(text.empty() ? "" : "; ") +
              "the transmitting boundary will drift without its term of geometric spreading (gamma)";
    return text;
  }

  double noise_growth(const RockModel &model, const RockRegionParameters &parameters,
                      const unsigned int n_steps, const TransmittingFormula *formula)
  {
    const auto   region = make_region(model, parameters, formula);
    std::mt19937 engine(7);
    Unknowns     u(3 * std::size_t(region->n_nodes()), 0.), v = u;
    for (double &x : v)
      x = engine() / 2147483647.5 - 1.;
    for (const BoundaryLine &line : model.lines)
      std::fill_n(v.begin() + 3 * std::size_t(line.nodes[0]), 3, 0.);
    region->keep_energy();
    region->start(u, v);
    double early = 0.;
    for (unsigned int i = 1; i <= n_steps; ++i)
    {
      region->advance();
      if (i == n_steps / 10)
        early = region->energy().kinetic;
      if (!(region->energy().kinetic < 1e100))
        return HUGE_VAL;
    }
    return region->energy().kinetic / early;
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
        if (plane.boundary == "fixed") // the valley's own waves leave
          plane.boundary = RockRegionParameters().boundary;
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
    auto field = make_free_field(mesh, model, parameters, wave, n_steps, formula);
    add_points(*field, region, model, parameters, formula);
    region.set_free_field(std::move(field));
  }
} // namespace Voussoir
