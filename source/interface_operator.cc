#include <voussoir/interface_operator.h>
#include <voussoir/joint_jacobian.h>

#include <algorithm>

extern "C" void dgemv_(const char *, const int *, const int *, const double *, const double *, const int *,
                       const double *, const int *, const double *, double *, const int *);

namespace Voussoir
{
  InterfaceOperator::InterfaceOperator(const std::vector<unsigned int> &n_pairs)
      : offset(1, 0), coupled(n_pairs.size())
  {
    for (const unsigned int n : n_pairs)
      offset.push_back(offset.back() + 3 * n);
  }

  std::vector<double> &InterfaceOperator::block(const unsigned int j, const unsigned int k)
  {
    const auto inserted = blocks.try_emplace({j, k});
    if (inserted.second)
    {
      inserted.first->second.assign(std::size_t(size(j)) * size(k), 0.);
      if (j != k)
      {
        coupled[j].push_back(k);
        coupled[k].push_back(j);
        for (const unsigned int g : {j, k})
          std::sort(coupled[g].begin(), coupled[g].end());
      }
    }
    return inserted.first->second;
  }

  void InterfaceOperator::add_coupling(const unsigned int j, const unsigned int k, const double factor,
                                       const double *x, double *y) const
  {
    const auto found = blocks.find({std::min(j, k), std::max(j, k)});
    if (found == blocks.end() || found->second.empty())
      return;
    const int    rows = size(std::min(j, k)), columns = size(std::max(j, k)), stride = 1;
    const double one = 1.;
    dgemv_(j <= k ? "N" : "T", &rows, &columns, &factor, found->second.data(), &rows, x, &stride, &one, y,
           &stride);
  }

  void InterfaceOperator::multiply(const Unknowns &x, Unknowns &y) const
  {
    // A block of two joints serves both while it is in the cache; its two products are added up afterwards,
    // in the order of the blocks, so that the result does not depend on the number of threads.
    std::vector<const std::pair<const std::pair<unsigned int, unsigned int>, std::vector<double>> *> list;
    for (const auto &b : blocks)
      list.push_back(&b);
    std::vector<std::array<std::vector<double>, 2>> products(list.size());
#pragma omp parallel for schedule(dynamic)
    for (int i = 0; i < static_cast<int>(list.size()); ++i)
    {
      const unsigned int j = list[i]->first.first, k = list[i]->first.second;
      products[i][0].assign(size(j), 0.);
      add_coupling(j, k, 1., x.data() + offset[k], products[i][0].data());
      if (j != k)
      {
        products[i][1].assign(size(k), 0.);
        add_coupling(k, j, 1., x.data() + offset[j], products[i][1].data());
      }
    }
    y.assign(n(), 0.);
    for (std::size_t i = 0; i < list.size(); ++i)
      for (unsigned int side = 0; side < 2; ++side)
      {
        double *out = y.data() + offset[side == 0 ? list[i]->first.first : list[i]->first.second];
        for (const double p : products[i][side])
          *out++ += p;
      }
  }

  std::vector<std::vector<unsigned int>> InterfaceOperator::colours() const
  {
    std::vector<std::vector<unsigned int>> result;
    std::vector<unsigned int>              colour(n_groups(), 0);
    for (unsigned int g = 0; g < n_groups(); ++g)
    {
      std::vector<bool> taken(n_groups() + 1, false);
      for (const unsigned int k : coupled[g])
        if (k < g)
          taken[colour[k]] = true;
      colour[g] = std::find(taken.begin(), taken.end(), false) - taken.begin();
      result.resize(std::max<std::size_t>(result.size(), colour[g] + 1));
      result[colour[g]].push_back(g);
    }
    return result;
  }

  void InterfaceOperator::sweep(const PairSolver &solve_pair, Unknowns &force, Unknowns &gap) const
  {
    for (const auto &groups : colours())
    {
      std::vector<std::vector<double>> change(groups.size());
#pragma omp parallel for schedule(dynamic)
      for (int index = 0; index < static_cast<int>(groups.size()); ++index)
      {
        const unsigned int         j = groups[index], m = size(j);
        const std::vector<double> &w = block(j, j);
        change[index].assign(m, 0.);
        for (unsigned int i = 0; i < m; i += 3)
        {
          const unsigned int pair = (begin(j) + i) / 3;
          double            *f = &force[3 * pair], *d = &gap[begin(j)];
          const Matrix3      H = diagonal(pair);
          const Vector3      Hf = H * Vector3{{f[0], f[1], f[2]}};
          const Vector3 solution = solve_pair(pair, H, {{d[i] - Hf[0], d[i + 1] - Hf[1], d[i + 2] - Hf[2]}});
          for (unsigned int c = 0; c < 3; ++c)
          {
            const double delta = solution[c] - f[c];
            f[c] = solution[c];
            change[index][i + c] = delta;
            const double *column = w.data() + std::size_t(i + c) * m;
            if (delta != 0.)
              for (unsigned int row = 0; row < m; ++row)
                d[row] += delta * column[row];
          }
        }
      }
      for (std::size_t index = 0; index < groups.size(); ++index)
        for (const unsigned int k : coupled[groups[index]])
          add_coupling(k, groups[index], 1., change[index].data(), gap.data() + begin(k));
    }
  }

  std::unique_ptr<ContactJacobian> InterfaceOperator::make_jacobian() const
  {
    return std::make_unique<JointJacobian>(*this);
  }

  Matrix3 InterfaceOperator::diagonal(const unsigned int pair) const
  {
    const unsigned int group = std::upper_bound(offset.begin(), offset.end(), 3 * pair) - offset.begin() - 1;
    const std::vector<double> &b = blocks.at({group, group});
    const std::size_t          first = 3 * pair - offset[group], m = size(group);
    Matrix3                    result;
    for (unsigned int i = 0; i < 3; ++i)
      for (unsigned int j = 0; j < 3; ++j)
        result[3 * i + j] = b[(first + j) * m + first + i];
    return result;
  }

  double InterfaceOperator::memory() const
  {
    double bytes = 0;
    for (const auto &b : blocks)
      bytes += 8. * b.second.size();
    return bytes;
  }
} // namespace Voussoir
