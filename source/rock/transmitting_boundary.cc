#include <voussoir/base/error.h>
#include <voussoir/rock/transmitting_boundary.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

namespace Voussoir
{
  namespace
  {
    using Interpolation = TransmittingFormula::Interpolation;

    /** Lagrange's weights of nodes first .. first + n - 1 at @p x. */
    std::vector<double> lagrange(const std::vector<double> &position, const unsigned int first,
                                 const unsigned int n, const double x)
    {
      std::vector<double> weight(n, 1.);
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = 0; j < n; ++j)
          if (i != j)
            weight[i] *= (x - position[first + j]) / (position[first + i] - position[first + j]);
      return weight;
    }

    /** The values interpolated at @p step inward of where the @p weights take them. */
    std::vector<double> shifted(const std::vector<double> &weights, const std::vector<double> &position,
                                const double step, const unsigned int n)
    {
      std::vector<double> result(position.size(), 0.);
      for (unsigned int k = 0; k < position.size(); ++k)
        if (weights[k] != 0.)
        {
          const unsigned int first = std::min<std::size_t>(k, position.size() - n);
          const auto         w = lagrange(position, first, n, position[k] + step);
          for (unsigned int i = 0; i < n; ++i)
            result[first + i] += weights[k] * w[i];
        }
      return result;
    }

    /** Interpolation at the distance @p x from the boundary with the three nodes about it. */
    std::vector<double> direct(const std::vector<double> &position, const double x)
    {
      unsigned int first = 0;
      while (first + 3 < position.size() && x > position[first + 2])
        ++first;
      std::vector<double> result(position.size(), 0.);
      const auto          w = lagrange(position, first, 3, x);
      std::copy(w.begin(), w.end(), result.begin() + first);
      return result;
    }

    double smallest_spacing(const std::vector<double> &position)
    {
      double spacing = std::numeric_limits<double>::max();
      for (std::size_t k = 1; k < position.size(); ++k)
        spacing = std::min(spacing, position[k] - position[k - 1]);
      return spacing;
    }

    void check(const BoundaryLine &line, const TransmittingFormula &formula,
               const std::vector<double> &courant)
    {
      char text[400];
      if (line.nodes.size() < formula.n_nodes() || line.position.size() < formula.n_nodes())
      {
        std::snprintf(
            text, sizeof(text),
            "a transmitting boundary of order %u needs %u nodes on each grid line that is normal to "
            "the artificial boundary, but there is a line of %zu; use more layers of rock, or a lower "
            "order",
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
            "the transmitting boundary is unstable: its fastest wave moves c dt = %g m in a time "
            "step, more than the spacing dx = %g m of the nodes (S = c dt/dx = %.3g, at most 1); use "
            "a smaller time step",
            step, dx, step / dx);
        throw InputError(text);
      }
    }
  } // namespace

  TransmittingFormula transmitting_formula(const std::string &name)
  {
    constexpr double    surface = .92, middle = 1.35; // Rayleigh waves; between S and P
    TransmittingFormula formula;
    if (name == "fixed")
      return formula;
    if (name == "mtf1")
      formula.factors = {{0., 1., 0., 1.}};
    else if (name == "mtf2")
      formula.factors = {{1., 0., 1., 0.}, {0., 1., 0., 1.6}};
    else if (name == "mtf2-plain")
      formula.factors = {{0., middle, 0., 0.}, {0., middle, 0., 0.}};
    else if (name == "mtf3")
      formula.factors = {{1., 0., 0., middle}, {0., 1., 0., middle}, {0., middle, 0., middle}};
    else if (name == "mtf4")
      formula.factors = {
          {1., 0., 0., middle}, {0., 1., 0., middle}, {0., surface, 0., middle}, {0., middle, 0., middle}};
    else
      throw InputError("there is no transmitting boundary \"" + name +
                       "\"; use mtf1, mtf2, mtf2-plain, mtf3 or mtf4");
    formula.uniform_distance = formula.order() > 2;
    return formula;
  }

  std::vector<std::vector<double>> transmitting_weights(const std::vector<double> &courant,
                                                        const std::vector<double> &gamma,
                                                        const std::vector<double> &position,
                                                        const Interpolation        rule)
  {
    const unsigned int               order = courant.size(), n = position.size();
    std::vector<std::vector<double>> weights(order, std::vector<double>(n, 0.));
    for (unsigned int subset = 1; subset < (1u << order); ++subset) // the terms of the product
    {
      std::vector<double> term(n, 0.);
      term[0] = 1.;
      double       distance = 0., factor = -1.;
      unsigned int steps = 0;
      for (unsigned int j = 0; j < order; ++j)
        if (subset & (1u << j))
        {
          if (rule != Interpolation::direct)
            term = shifted(term, position, courant[j], rule == Interpolation::linear ? 2 : 3);
          distance += courant[j];
          factor *= -1. / (1. + gamma[j]);
          ++steps;
        }
      if (rule == Interpolation::direct)
        term = direct(position, distance);
      for (unsigned int k = 0; k < n; ++k)
        weights[steps - 1][k] += factor * term[k];
    }
    return weights;
  }

  TransmittingBoundary::TransmittingBoundary(const TransmittingFormula       &formula,
                                             const std::vector<BoundaryLine> &lines, const double dt)
      : n_points(formula.n_nodes())
  {
    double nearest = std::numeric_limits<double>::max();
    for (const BoundaryLine &line : lines)
      nearest = std::min(nearest, line.distance);
    for (const BoundaryLine &line : lines)
    {
      const double        r = formula.uniform_distance ? nearest : line.distance;
      std::vector<double> courant, gamma;
      for (const TransmittingFactor &f : formula.factors)
      {
        courant.push_back((f.p * line.c_p + f.s * line.c_s) * dt);
        const double spreading = (f.gamma_p * line.c_p + f.gamma_s * line.c_s) * dt;
        gamma.push_back(spreading > 0. ? spreading / r : 0.);
      }
      check(line, formula, courant);
      node.insert(node.end(), line.nodes.begin(), line.nodes.begin() + n_points);
      const std::vector<double> position(line.position.begin(), line.position.begin() + n_points);
      for (const auto &row : transmitting_weights(courant, gamma, position, formula.interpolation))
        weights.insert(weights.end(), row.begin(), row.end());
    }
    history.assign(formula.order(), Unknowns(3 * node.size(), 0.));
    next.assign(3 * lines.size(), 0.);
  }

  const Unknowns &TransmittingBoundary::advance(const Unknowns &u, const Unknowns &free_field,
                                                const Unknowns &next_free_field)
  {
    if (!history.empty())
      std::rotate(history.begin(), history.end() - 1, history.end());
    const bool incident = !free_field.empty();
    const int  lines = n_lines();
#pragma omp parallel for schedule(static)
    for (int line = 0; line < lines; ++line)
    {
      const std::size_t first = std::size_t(line) * n_points;
      for (std::size_t i = first; !history.empty() && i < first + n_points; ++i)
        for (unsigned int c = 0; c < 3; ++c)
          history.front()[3 * i + c] =
              u[3 * std::size_t(node[i]) + c] - (incident ? free_field[3 * i + c] : 0.);
      const double *w = weights.data() + first * history.size();
      Vector3       sum{};
      for (const Unknowns &scattered : history)
        for (unsigned int k = 0; k < n_points; ++k, ++w)
          for (unsigned int c = 0; c < 3; ++c)
            sum[c] += *w * scattered[3 * (first + k) + c];
      for (unsigned int c = 0; c < 3; ++c)
        next[3 * line + c] = sum[c] + (incident ? next_free_field[3 * first + c] : 0.);
    }
    return next;
  }

  void check_distance(const TransmittingBoundary &boundary, const std::vector<unsigned int> &prescribed,
                      const unsigned int n_nodes)
  {
    std::vector<bool> is_prescribed(n_nodes, false);
    for (const unsigned int node : prescribed)
      is_prescribed[node] = true;
    for (const unsigned int node : boundary.nodes())
      if (is_prescribed[node])
        throw InputError(
            "the base of the dam is too near the artificial boundary of the rock: there must be " +
            std::to_string(boundary.nodes_per_line()) +
            " layers of rock cells between them for this transmitting boundary");
  }

  std::vector<std::vector<double> *> TransmittingBoundary::state()
  {
    std::vector<std::vector<double> *> arrays;
    for (Unknowns &scattered : history)
      arrays.push_back(&scattered);
    return arrays;
  }
} // namespace Voussoir
