// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/blas.h>
#include <voussoir/joints/condensed_body.h>
#include <voussoir/joints/packed_factor.h>

#include <utility>

namespace Voussoir
{
  namespace
  {
    /** Computes y = A x for a symmetric matrix. */
    void multiply(const std::vector<double> &A, const std::vector<double> &x, double *y)
    {
      const int    n = x.size(), stride = 1;
      const double one = 1., zero = 0.;
      if (n > 0)
        dsymv_("L", &n, &one, A.data(), &n, x.data(), &stride, &zero, y, &stride);
    }
  } // namespace

  CondensedBody::CondensedBody(const Structure &structure, const Body &body, const StepOperator &step,
                               const Unknowns &springs, const bool single)
  {
    const double       entry = single ? .5 : 1.; // in units of eight bytes
    BodyFactor         A(structure, body, step, springs);
    const unsigned int m = A.n_interface();
    A.analyse(BodyFactor::Order::any);
    const double free_entries = A.n_entries();
    free_order = m == 0;
    if (m > 0)
    {
      A.analyse(BodyFactor::Order::interface_last);
      A.factorise();
      flexibility = A.flexibility();
      free_order = prefer_free_order(entry * free_entries, entry * A.n_entries(), m);
      if (free_order)
        A.analyse(BodyFactor::Order::any);
    }
    if (free_order)
      A.factorise();
    factor = A.take_leading_columns(single);
    permutation = A.permutation();
    std::vector<unsigned int> row(A.n());
    for (unsigned int i = 0; i < row.size(); ++i)
      row[permutation[i]] = i;
    for (const unsigned int node : body.interface)
      for (unsigned int c = 0; c < 3; ++c)
        interface_row.push_back(row[3 * node + c]);
    x.resize(A.n());
    load.resize(m > 0 && free_order ? A.n() : 0);
    condensed_load.resize(free_order ? 0 : m);
  }

  CondensedBody::CondensedBody(CondensedBody &&) noexcept = default;
  CondensedBody::~CondensedBody() = default;

  void CondensedBody::apply_load(const double *b, double *u_G)
  {
    for (std::size_t i = 0; i < x.size(); ++i)
      x[i] = b[permutation[i]];
    if (interface_row.empty())
      return;
    if (free_order)
      load = x;
    factor->forward(x.data());
    if (free_order)
      factor->backward(x.data());
    for (std::size_t i = 0; i < interface_row.size(); ++i)
      (free_order ? u_G : condensed_load.data())[i] = x[interface_row[i]];
    if (!free_order)
      multiply(flexibility, condensed_load, u_G);
  }

  void CondensedBody::apply_joint_forces(const double *f, double *u)
  {
    if (free_order)
    {
      if (!interface_row.empty())
        x = load;
      for (std::size_t i = 0; i < interface_row.size(); ++i)
        x[interface_row[i]] += f[i];
      factor->forward(x.data());
    }
    else
    {
      std::vector<double> u_G(n_interface());
      for (std::size_t i = 0; i < u_G.size(); ++i)
        condensed_load[i] += f[i];
      multiply(flexibility, condensed_load, u_G.data());
      for (std::size_t i = 0; i < u_G.size(); ++i)
        x[interface_row[i]] = u_G[i];
    }
    factor->backward(x.data());
    for (std::size_t i = 0; i < x.size(); ++i)
      u[permutation[i]] = x[i];
  }

  void CondensedBody::solve(const double *b, double *u)
  {
    std::vector<double> u_G(n_interface());
    apply_load(b, u_G.data());
    if (interface_row.empty())
      factor->forward(x.data());
    for (std::size_t i = 0; i < u_G.size() && !free_order; ++i)
      x[interface_row[i]] = u_G[i];
    if (interface_row.empty() || !free_order)
      factor->backward(x.data());
    for (std::size_t i = 0; i < x.size(); ++i)
      u[permutation[i]] = x[i];
  }

  std::vector<double> CondensedBody::take_flexibility()
  {
    return free_order ? std::exchange(flexibility, {}) : flexibility;
  }

  double CondensedBody::memory() const
  {
    return factor->memory() + 8. * (flexibility.size() + x.size() + load.size() + condensed_load.size()) +
           4. * (permutation.size() + interface_row.size());
  }
} // namespace Voussoir
