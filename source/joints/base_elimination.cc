// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/blas.h>
#include <voussoir/joints/base_elimination.h>

#include <algorithm>
#include <numeric>

namespace Voussoir
{
  namespace
  {
    unsigned int place_in(const std::vector<unsigned int> &sorted, const unsigned int value)
    {
      return std::lower_bound(sorted.begin(), sorted.end(), value) - sorted.begin();
    }
  } // namespace

  BaseElimination::BaseElimination(const Structure &structure, Nodes given,
                                   const std::vector<unsigned int> &group)
      : structure(structure), nodes(std::move(given)), group(group), begin(1, 0), first(1, 0)
  {
    for (const unsigned int g : group)
    {
      begin.resize(std::max<std::size_t>(begin.size(), g + 2), begin.back());
      begin.back() += 3;
    }
    for (const Body &body : structure.bodies)
    {
      first.push_back(place_in(nodes.node, body.first_node + body.n_nodes()));
      for (unsigned int i = first[first.size() - 2]; i < first.back(); ++i)
        interface.push_back(place_in(body.interface, nodes.node[i] - body.first_node));
    }
    std::vector<std::vector<unsigned int>> more(
        nodes.node.size()); // couplings between the base nodes of a body
    for (unsigned int b = 0; b + 1 < first.size(); ++b)
      for (unsigned int i = first[b]; i < first[b + 1]; ++i)
      {
        more[i].resize(first[b + 1] - first[b]);
        std::iota(more[i].begin(), more[i].end(), first[b]);
      }
    H.bodies.resize(1);
    H.bodies[0].stiffness = std::move(nodes.compliance); // on massless rock the matrix is dense
    H.bodies[0].stiffness.extend(std::move(more));
    H.mass.resize(nodes.node.size());
  }

  void BaseElimination::add_body(const unsigned int b, const std::vector<double> &F)
  {
    const Body       &body = structure.bodies[b];
    const std::size_t m = 3 * body.interface.size();
    const auto        flexibility = [&](const unsigned int p, const unsigned int q)
    {
      Matrix3 f;
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = 0; j < 3; ++j)
          f[3 * i + j] = F[(3 * std::size_t(q) + j) * m + 3 * p + i];
      return f;
    };
    for (unsigned int i = first[b]; i < first[b + 1]; ++i)
      for (unsigned int k = first[b]; k < first[b + 1]; ++k)
        H.bodies[0].stiffness.add(i, k, flexibility(interface[i], interface[k]));
    for (unsigned int p = 0; p < structure.pairs.size() && n_base_nodes(b) > 0; ++p)
    {
      const Pair &pair = structure.pairs[p];
      for (unsigned int side = 0; side < 2; ++side)
      {
        const unsigned int node = side == 0 ? pair.node_1 : pair.node_2;
        if (node < body.first_node || node >= body.first_node + body.n_nodes()) // also if it is the ground
          continue;
        const std::size_t    rows = n_rows(group[p]), row = 3 * p - begin[group[p]];
        std::vector<double> &block = B[{group[p], b}];
        block.resize(rows * 3 * n_base_nodes(b), 0.);
        for (unsigned int k = 0; k < n_base_nodes(b); ++k)
        {
          const Matrix3 f =
              flexibility(place_in(body.interface, node - body.first_node), interface[first[b] + k]);
          for (unsigned int j = 0; j < 3; ++j)
            for (unsigned int i = 0; i < 3; ++i)
              block[(3 * k + j) * rows + row + i] +=
                  (side == 0 ? -1. : 1.) * dot(pair.frame[i], Vector3{{f[j], f[3 + j], f[6 + j]}});
        }
      }
    }
  }

  void BaseElimination::factorise()
  {
    H.bodies[0].stiffness.symmetrise();
    factor.emplace_back(H, H.bodies[0], StepOperator());
    H = Structure(); // releases memory
  }

  void BaseElimination::solve(Unknowns &x) const
  {
    factor[0].solve(x.data(), x.data());
  }

  void BaseElimination::take_from(const InterfaceValues &values, Unknowns &x) const
  {
    x.resize(n());
    for (unsigned int b = 0; b + 1 < first.size(); ++b)
      for (unsigned int i = first[b]; i < first[b + 1]; ++i)
        std::copy_n(values.of_body(b) + 3 * interface[i], 3, x.begin() + 3 * std::size_t(i));
  }

  void BaseElimination::add_to(InterfaceValues &values, const Unknowns &x) const
  {
    for (unsigned int b = 0; b + 1 < first.size(); ++b)
      for (unsigned int i = first[b]; i < first[b + 1]; ++i)
        for (unsigned int c = 0; c < 3; ++c)
          values.of_body(b)[3 * interface[i] + c] += x[3 * std::size_t(i) + c];
  }

  void BaseElimination::add_gaps(const double factor, const Unknowns &f, double *gap) const
  {
    const int    stride = 1;
    const double one = 1.;
    for (const auto &block : B)
    {
      const int rows = n_rows(block.first.first), columns = 3 * n_base_nodes(block.first.second);
      dgemv_("N", &rows, &columns, &factor, block.second.data(), &rows,
             f.data() + 3 * std::size_t(first[block.first.second]), &stride, &one,
             gap + begin[block.first.first], &stride);
    }
  }

  void BaseElimination::take_gaps(const double *f, Unknowns &x) const
  {
    const int    stride = 1;
    const double one = 1.;
    x.assign(n(), 0.);
    for (const auto &block : B)
    {
      const int rows = n_rows(block.first.first), columns = 3 * n_base_nodes(block.first.second);
      dgemv_("T", &rows, &columns, &one, block.second.data(), &rows, f + begin[block.first.first], &stride,
             &one, x.data() + 3 * std::size_t(first[block.first.second]), &stride);
    }
  }

  void BaseElimination::subtract(const double *f, double *gap) const
  {
    Unknowns x;
    take_gaps(f, x);
    solve(x);
    add_gaps(-1., x, gap);
  }

  /** Returns the columns of H^-1 for the base nodes of a body. */
  std::vector<double> BaseElimination::inverse_columns(const unsigned int body) const
  {
    std::vector<double> result;
    for (unsigned int k = 3 * first[body]; k < 3 * first[body + 1]; ++k)
    {
      Unknowns x(n(), 0.);
      x[k] = 1.;
      solve(x);
      result.insert(result.end(), x.begin(), x.end());
    }
    return result;
  }

  std::vector<double> BaseElimination::times_transposed(const std::vector<double> &columns,
                                                        const Key                 &key) const
  {
    const int           rows = n(), n_columns = n_rows(key.first), m = 3 * n_base_nodes(key.second);
    const double        one = 1., zero = 0.;
    std::vector<double> Y(std::size_t(rows) * n_columns);
    dgemm_("N", "T", &rows, &n_columns, &m, &one, columns.data(), &rows, B.at(key).data(), &n_columns, &zero,
           Y.data(), &rows);
    return Y;
  }

  std::vector<double> BaseElimination::product(const Key &key, const std::vector<double> &Y,
                                               const unsigned int n_columns) const
  {
    const int    rows = n_rows(key.first), columns = n_columns, m = 3 * n_base_nodes(key.second), all = n();
    const double one = 1., zero = 0.;
    std::vector<double> result(std::size_t(rows) * columns);
    dgemm_("N", "N", &rows, &columns, &m, &one, B.at(key).data(), &rows,
           Y.data() + 3 * std::size_t(first[key.second]), &all, &zero, result.data(), &rows);
    return result;
  }

  double BaseElimination::memory() const
  {
    double bytes = factor.empty() ? 0. : factor[0].memory();
    for (const auto &block : B)
      bytes += 8. * block.second.size();
    return bytes;
  }
} // namespace Voussoir
