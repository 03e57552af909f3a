// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/joints/friction_problem.h>

#include <voussoir/base/output_file.h>
#include <voussoir/contact/surfaces_law.h>

#include <algorithm>
#include <iomanip>

namespace Voussoir
{
  namespace
  {
    /** Returns the operator as one sparse matrix, joint after joint. */
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

    /** Returns W between surfaces of pairs. @p surfaces: a pair and the matrix of its surface axes (rows) for
     * each surface, in the order of the pairs. */
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
  } // namespace

  FrictionProblem friction_problem(const InterfaceOperator &W, const PairLaws &laws,
                                   const std::vector<PairHistory> &history, const Unknowns &b)
  {
    FrictionProblem problem;
    problem.title = "joints of a dam, gap = W force + q [m, N]";
    std::vector<std::pair<unsigned int, Matrix3>> axes;
    std::vector<double>                           compliance;
    const auto add_surface = [&](const unsigned int pair, const ContactSurface &surface, const Vector3 &start)
    {
      axes.push_back({pair, surface.axes});
      compliance.push_back(surface.compliance);
      problem.mu.push_back(surface.friction);
      const Vector3 q = surface.movement(get(b, pair), start, {});
      problem.q.insert(problem.q.end(), q.begin(), q.end());
    };
    const Matrix3 one = {{1., 0., 0., 0., 1., 0., 0., 0., 1.}};
    for (unsigned int p = 0; p < laws.of_pair.size(); ++p)
      if (const SurfacesLaw *law = laws.of_pair[p]->surfaces_law())
      {
        const PresentSurfaces present = law->present(history[p]);
        for (const ContactSurface &surface : present.surfaces)
          add_surface(p, surface, present.start);
      }
      else
        add_surface(p, {one, 0., laws.of_pair[p]->flat_friction()}, history[p].start);
    problem.W = sparse_matrix(sparse_matrix(W), axes);
    for (unsigned int s = 0; s < axes.size(); ++s)
    {
      const double c = compliance[s];
      problem.W.add(s, s, {{c, 0., 0., 0., c, 0., 0., 0., c}});
    }
    return problem;
  }

  void write_friction_problem(const std::string &file, const FrictionProblem &problem)
  {
    OutputFile out(file);
    out << std::setprecision(17) << "# " << problem.title << '\n'
        << problem.W.n_rows() << ' ' << problem.W.column.size()
        << "\n# contacts: q, coefficient of friction, initial guess of the force\n";
    for (unsigned int i = 0; i < problem.W.n_rows(); ++i)
    {
      for (unsigned int c = 0; c < 3; ++c)
        out << problem.q[3 * i + c] << ' ';
      out << problem.mu[i];
      for (unsigned int c = 0; c < 3; ++c)
        out << ' ' << problem.guess[3 * i + c];
      out << '\n';
    }
    out << "# blocks of W: two contacts, from 0, and 3 x 3 entries by rows\n";
    for (unsigned int i = 0; i < problem.W.n_rows(); ++i)
      for (std::size_t k = problem.W.start[i]; k < problem.W.start[i + 1]; ++k)
      {
        out << i << ' ' << problem.W.column[k];
        for (const double x : problem.W.value[k])
          out << ' ' << x;
        out << '\n';
      }
    out.check();
  }
} // namespace Voussoir
