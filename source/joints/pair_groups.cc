// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/joints/pair_groups.h>

#include <algorithm>
#include <map>

namespace Voussoir
{
  PairGroups find_groups(const BlockSparseMatrix &W)
  {
    std::map<std::vector<unsigned int>, std::vector<unsigned int>> groups; // columns -> rows
    for (unsigned int i = 0; i < W.n_rows(); ++i)
      groups[std::vector<unsigned int>(W.column.begin() + W.start[i], W.column.begin() + W.start[i + 1])]
          .push_back(i);
    PairGroups result;
    for (const auto &group : groups)
    {
      result.size.push_back(static_cast<unsigned int>(group.second.size()));
      result.order.insert(result.order.end(), group.second.begin(), group.second.end());
    }
    return result;
  }

  BlockSparseMatrix sparse_matrix(const BlockSparseMatrix                             &W,
                                  const std::vector<std::pair<unsigned int, Matrix3>> &surfaces)
  {
    std::vector<std::vector<unsigned int>> of_pair(W.n_rows());
    for (unsigned int s = 0; s < surfaces.size(); ++s)
      of_pair[surfaces[s].first].push_back(s);
    std::vector<std::vector<unsigned int>> columns(surfaces.size());
    for (unsigned int s = 0; s < surfaces.size(); ++s)
      for (std::size_t k = W.start[surfaces[s].first]; k < W.start[surfaces[s].first + 1]; ++k)
        columns[s].insert(columns[s].end(), of_pair[W.column[k]].begin(), of_pair[W.column[k]].end());
    BlockSparseMatrix result(columns);
    for (unsigned int s = 0; s < surfaces.size(); ++s)
      for (std::size_t k = W.start[surfaces[s].first]; k < W.start[surfaces[s].first + 1]; ++k)
        for (const unsigned int t : of_pair[W.column[k]])
        {
          const Matrix3 &a = surfaces[s].second, &c = surfaces[t].second;
          Matrix3        block;
          for (unsigned int j = 0; j < 3; ++j)
          {
            const Vector3 column = a * (W.value[k] * Vector3{{c[3 * j], c[3 * j + 1], c[3 * j + 2]}});
            for (unsigned int i = 0; i < 3; ++i)
              block[3 * i + j] = column[i];
          }
          result.add(s, t, block);
        }
    return result;
  }

  InterfaceOperator make_interface_operator(const BlockSparseMatrix &W, const PairGroups &groups)
  {
    InterfaceOperator         result(groups.size);
    std::vector<unsigned int> place(W.n_rows()), group(W.n_rows()); // per pair of W
    for (unsigned int g = 0, next = 0; g < groups.size.size(); ++g)
    {
      result.block(g, g);
      for (unsigned int i = 0; i < groups.size[g]; ++i, ++next)
      {
        place[groups.order[next]] = next;
        group[groups.order[next]] = g;
      }
    }
    for (unsigned int i = 0; i < W.n_rows(); ++i)
      for (std::size_t k = W.start[i]; k < W.start[i + 1]; ++k)
      {
        const unsigned int j = W.column[k];
        if (group[i] > group[j])
          continue;
        std::vector<double> &block = result.block(group[i], group[j]);
        const std::size_t    rows = result.size(group[i]), row = 3 * place[i] - result.begin(group[i]),
                          column = 3 * place[j] - result.begin(group[j]);
        for (unsigned int r = 0; r < 3; ++r)
          for (unsigned int c = 0; c < 3; ++c)
            block[(column + c) * rows + row + r] = W.value[k][3 * r + c];
      }
    result.finish();
    return result;
  }

  BlockSparseMatrix sparse_matrix(const InterfaceOperator &W)
  {
    std::vector<std::vector<unsigned int>> columns(W.n_pairs());
    const auto                             for_each_block = [&](const auto &action)
    {
      for (unsigned int j = 0; j < W.n_groups(); ++j)
        for (unsigned int k = j; k < W.n_groups(); ++k)
          if (const std::vector<double> *block = W.find_block(j, k))
            for (unsigned int p = 0; p < W.size(j) / 3; ++p)
              for (unsigned int q = 0; q < W.size(k) / 3; ++q)
                action(j, k, p, q, *block);
    };
    for_each_block(
        [&](const unsigned int j, const unsigned int k, const unsigned int p, const unsigned int q,
            const auto &)
        {
          columns[W.begin(j) / 3 + p].push_back(W.begin(k) / 3 + q);
          if (j != k)
            columns[W.begin(k) / 3 + q].push_back(W.begin(j) / 3 + p);
        });
    for (auto &list : columns)
      std::sort(list.begin(), list.end());
    BlockSparseMatrix result(columns);
    for_each_block(
        [&](const unsigned int j, const unsigned int k, const unsigned int p, const unsigned int q,
            const auto &block)
        {
          Matrix3           a, transpose;
          const std::size_t rows = W.size(j);
          for (unsigned int r = 0; r < 3; ++r)
            for (unsigned int c = 0; c < 3; ++c)
              a[3 * r + c] = transpose[3 * c + r] = block[(3 * q + c) * rows + 3 * p + r];
          result.add(W.begin(j) / 3 + p, W.begin(k) / 3 + q, a);
          if (j != k)
            result.add(W.begin(k) / 3 + q, W.begin(j) / 3 + p, transpose);
        });
    return result;
  }
} // namespace Voussoir
