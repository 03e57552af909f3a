// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/error.h>
#include <voussoir/rock/transmitting_boundary.h>

#include <algorithm>
#include <cstdio>
#include <limits>

namespace Voussoir
{
  namespace
  {
    double smallest_spacing(const std::vector<double> &position)
    {
      double spacing = std::numeric_limits<double>::max();
      for (std::size_t k = 1; k < position.size(); ++k)
        spacing = std::min(spacing, position[k] - position[k - 1]);
      return spacing;
    }

    void check_line(const BoundaryLine &line, const TransmittingFormula &formula,
                    const std::vector<double> &courant)
    {
      char text[400];
      if (line.nodes.size() < formula.n_nodes() || line.position.size() < formula.n_nodes())
      {
        std::snprintf(
            text, sizeof(text),
            "A transmitting boundary of order %u requires %u nodes on each grid line that is normal to the "
            "artificial boundary, but a line has %zu nodes only. Use more layers of rock elements along the "
            "boundary, or a lower order (\"Foundation/Boundary\").",
            formula.order(), formula.n_nodes(), line.nodes.size());
        throw InputError(text);
      }
      if (courant.empty())
        return;
      const double dx = smallest_spacing(line.position),
                   step = *std::max_element(courant.begin(), courant.end());
      if (step > dx * (1. + 1e-12))
      {
        std::snprintf(
            text, sizeof(text),
            "The transmitting boundary is unstable: its fastest wave travels %g m in a time step of the rock, "
            "more than the node spacing of %g m (ratio %.3g). Use a smaller time step "
            "(\"Dynamics/Steps per sample\" or \"Foundation/Substeps\").",
            step, dx, step / dx);
        throw InputError(text);
      }
    }

    std::string number(const double x)
    {
      char text[20];
      std::snprintf(text, sizeof(text), "%.3g", x);
      return text;
    }

    /** Returns true if cells have Gauss points: in that case the layers at the dam have them. */
    bool has_gauss_points(const RockParameters &rock)
    {
      return !rock.nodal_everywhere || rock.layers_at_dam > 0;
    }

    /** Throws InputError for Gauss points at a transmitting boundary, which are unstable
     * (tests/boundary_stability.cc). */
    void check_quadrature(const RockRegionParameters &p, const unsigned int layers)
    {
      const double damping = .2 * p.dt;
      if (has_gauss_points(p.rock) && p.rock.nodal_layers < layers && p.damping.stiffness < .99 * damping)
        throw InputError("Gauss points within " + std::to_string(layers) +
                         " layers of the transmitting boundary " + p.boundary +
                         " make it unstable. Set \"Foundation/Nodal layers\" to at least " +
                         std::to_string(layers) + " (now " + std::to_string(p.rock.nodal_layers) +
                         "), \"Foundation/Nodal quadrature everywhere\" to true, or "
                         "\"Foundation/Stiffness damping\" to at least " +
                         number(damping) + " s (0.2 times the rock time step).");
    }
  } // namespace

  TransmittingBoundary::TransmittingBoundary(TransmittingFormula given)
      : formula(std::move(given)), n_points(formula.n_nodes())
  {
  }

  unsigned int TransmittingBoundary::n_layers() const
  {
    constexpr unsigned int usual = 6;
    return formula.order() > 3 ? formula.n_nodes() : usual; // measured: tests/boundary_stability.cc
  }

  void TransmittingBoundary::check(const RockRegionParameters &parameters) const
  {
    check_quadrature(parameters, n_layers());
  }

  std::string TransmittingBoundary::warning(const RockRegionParameters &p) const
  {
    // Stable boxes of 12 cells need n_layers() layers, or a stiffness damping of 0.2 dt without layers.
    constexpr double enough_damping = .2;
    std::string      text;
    if (has_gauss_points(p.rock) && p.rock.nodal_layers < n_layers() &&
        p.damping.stiffness < enough_damping * p.dt)
      text = "the transmitting boundary will be unstable. Set \"Foundation/Nodal layers\" to at least " +
             std::to_string(n_layers()) + ", or \"Foundation/Stiffness damping\" to at least " +
             number(enough_damping * p.dt) + " s, 0.2 time steps of the rock";
    if (text.empty() && formula.order() > 2 && !p.rock.nodal_everywhere)
      text =
          "a transmitting boundary of order 3 or 4 becomes unstable in large rock regions with Gauss "
          "points. Set \"Foundation/Nodal quadrature everywhere\" to true, or \"Foundation/Boundary\" to mtf2";
    const auto rigid = [](const TransmittingFactor &factor)
    { return factor.gamma_p <= 0. && factor.gamma_s <= 0.; };
    if (formula.order() > 1 && std::all_of(formula.factors.begin(), formula.factors.end(), rigid))
      text +=
          std::string(text.empty() ? "" : "; ") + "the transmitting boundary " + p.boundary +
          " will drift, because it has no term for geometric spreading. Set \"Foundation/Boundary\" to mtf2";
    return text;
  }

  double TransmittingBoundary::largest_step(const RockModel &model) const
  {
    double step = std::numeric_limits<double>::infinity();
    for (const BoundaryLine &line : model.lines)
      for (const TransmittingFactor &f : formula.factors)
        step = std::min(step, smallest_spacing(line.position) / (f.p * line.c_p + f.s * line.c_s));
    return step;
  }

  void TransmittingBoundary::attach(const RockModel &model, const Vector3 &, const double dt)
  {
    double nearest = std::numeric_limits<double>::max();
    for (const BoundaryLine &line : model.lines)
      nearest = std::min(nearest, line.distance);
    for (const BoundaryLine &line : model.lines)
    {
      const double        r = formula.uniform_distance ? nearest : line.distance;
      std::vector<double> courant, gamma;
      for (const TransmittingFactor &f : formula.factors)
      {
        courant.push_back((f.p * line.c_p + f.s * line.c_s) * dt);
        const double spreading = (f.gamma_p * line.c_p + f.gamma_s * line.c_s) * dt;
        gamma.push_back(spreading > 0. ? spreading / r : 0.);
      }
      check_line(line, formula, courant);
      boundary_node.push_back(line.nodes[0]);
      node.insert(node.end(), line.nodes.begin(), line.nodes.begin() + n_points);
      const std::vector<double> position(line.position.begin(), line.position.begin() + n_points);
      for (const auto &row : transmitting_weights(courant, gamma, position, formula.interpolation))
        weights.insert(weights.end(), row.begin(), row.end());
    }
    kept = all_of(boundary_node.size());
    history.assign(formula.order(), Unknowns(3 * node.size(), 0.));
  }

  template <unsigned int known> void TransmittingBoundary::move_nodes(const RegionStep &step)
  {
    const Unknowns &u = step.u, &free_field = step.field, &next_free_field = step.field_next;
    if (!history.empty())
      std::rotate(history.begin(), history.end() - 1, history.end());
    const bool         incident = !free_field.empty();
    const int          lines = static_cast<int>(kept.size());
    const unsigned int n = known == 0 ? n_points : known;
    constexpr int      ahead = 4; // distance of the prefetch [lines]
#pragma omp parallel for schedule(static)
    for (int l = 0; l < lines; ++l)
    {
      const unsigned int  line = kept[l];
      const std::size_t   first = std::size_t(line) * n;
      const unsigned int *soon = node.data() + n * std::size_t(kept[std::min(l + ahead, lines - 1)]);
      for (unsigned int k = 0; k < n; ++k)
        __builtin_prefetch(u.data() + 3 * std::size_t(soon[k]));
      double       *latest = history.empty() ? nullptr : history.front().data() + 3 * first;
      const double *field = incident ? free_field.data() + 3 * first : nullptr;
      for (unsigned int k = 0; latest != nullptr && k < n; ++k)
        for (unsigned int c = 0; c < 3; ++c)
          latest[3 * k + c] = u[3 * std::size_t(node[first + k]) + c] - (incident ? field[3 * k + c] : 0.);
      const double *w = weights.data() + first * history.size();
      Vector3       sum{};
      for (const Unknowns &scattered : history)
        for (unsigned int k = 0; k < n; ++k, ++w)
          for (unsigned int c = 0; c < 3; ++c)
            sum[c] += *w * scattered[3 * (first + k) + c];
      for (unsigned int c = 0; c < 3; ++c)
      {
        const std::size_t k = 3 * std::size_t(boundary_node[line]) + c;
        const double      next = sum[c] + (incident ? next_free_field[3 * first + c] : 0.);
        step.w[k] = (next - u[k]) / step.dt;
      }
    }
  }

  void TransmittingBoundary::advance(const RegionStep &step)
  {
    if (n_points == 7) // number of points of the default, mtf3
      move_nodes<7>(step);
    else
      move_nodes<0>(step);
    if (!step.K_u.empty())
      add_work_of_motion(step, boundary_node, kept, step.w_before, gone_through_boundary, -1.);
  }

  std::vector<unsigned int> TransmittingBoundary::kept_points() const
  {
    std::vector<unsigned int> result;
    for (const unsigned int line : kept)
      for (unsigned int k = 0; k < n_points; ++k)
        result.push_back(line * n_points + k);
    return result;
  }

  std::vector<unsigned int> TransmittingBoundary::nodes_of_points() const
  {
    std::vector<unsigned int> result;
    for (const unsigned int i : boundary_node)
      result.insert(result.end(), n_points, i);
    return result;
  }

  void TransmittingBoundary::check_prescribed(const std::vector<unsigned int> &prescribed) const
  {
    check_apart(node, prescribed, n_points);
  }

  std::vector<std::vector<double> *> TransmittingBoundary::state()
  {
    std::vector<std::vector<double> *> arrays;
    for (Unknowns &scattered : history)
      arrays.push_back(&scattered);
    return arrays;
  }
} // namespace Voussoir
