// SPDX-License-Identifier: GPL-3.0-or-later
#include "problem_file.h"
#include "fclib_io.h"

#include <voussoir/base/error.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

namespace Voussoir
{
  namespace
  {
    /** Reads the next number, after comments. */
    template <typename Number> Number next(const std::string &file, std::istream &in)
    {
      while ((in >> std::ws).peek() == '#')
      {
        std::string comment;
        std::getline(in, comment);
      }
      Number number{};
      if (!(in >> number))
        refuse(file, "a number is missing, or not a finite number. The file is damaged; write it again.");
      return number;
    }

    FrictionProblem read_text(const std::string &file)
    {
      std::ifstream   in(file);
      FrictionProblem problem;
      std::getline(in, problem.title);
      problem.title.erase(0, 2); // "# "
      const auto n = next<unsigned long long>(file, in), n_blocks = next<unsigned long long>(file, in);
      // A contact has 7 numbers, a block 11, each with a blank.
      if (const auto size = std::filesystem::file_size(file); n == 0 || n > size / 14 || n_blocks > size / 22)
        refuse(file, "the numbers of contacts and blocks do not agree with the size of the file.");
      for (unsigned int i = 0; i < n; ++i)
      {
        for (unsigned int c = 0; c < 3; ++c)
          problem.q.push_back(next<double>(file, in));
        problem.mu.push_back(next<double>(file, in));
        for (unsigned int c = 0; c < 3; ++c)
          problem.guess.push_back(next<double>(file, in));
      }
      std::vector<std::map<unsigned int, Matrix3>> rows(n);
      for (unsigned int k = 0; k < n_blocks; ++k)
      {
        const auto i = next<unsigned long long>(file, in), j = next<unsigned long long>(file, in);
        if (i >= n || j >= n)
          refuse(file, "W has a block at row " + std::to_string(i) + ", column " + std::to_string(j) +
                           ", outside the matrix.");
        for (double &x : rows[i][static_cast<unsigned int>(j)])
          x = next<double>(file, in);
      }
      problem.W = matrix_of(rows);
      check_problem(file, problem);
      return problem;
    }
  } // namespace

  void refuse(const std::string &file, const std::string &what)
  {
    throw InputError(file + ": " + what);
  }

  FrictionProblem read_problem(const std::string &file)
  {
    std::error_code error;
    if (!std::filesystem::is_regular_file(file, error))
      refuse(file, "there is no such file.");
    return std::ifstream(file).peek() == '#' ? read_text(file) : read_fclib(file);
  }

  BlockSparseMatrix matrix_of(std::vector<std::map<unsigned int, Matrix3>> rows)
  {
    std::vector<std::vector<unsigned int>> columns(rows.size());
    for (unsigned int i = 0; i < rows.size(); ++i)
    {
      rows[i].try_emplace(i, Matrix3{});
      for (const auto &entry : rows[i])
        columns[i].push_back(entry.first);
    }
    BlockSparseMatrix result(columns);
    for (unsigned int i = 0; i < rows.size(); ++i)
      for (const auto &entry : rows[i])
        result.add(i, entry.first, entry.second);
    return result;
  }

  void check_problem(const std::string &file, const FrictionProblem &problem)
  {
    for (const double x : problem.q)
      if (!std::isfinite(x))
        refuse(file, "vectors/q has an entry that is not a finite number.");
    for (std::size_t i = 0; i < problem.mu.size(); ++i)
    {
      if (!(problem.mu[i] >= 0.) || !std::isfinite(problem.mu[i]))
        refuse(file, "the coefficient of friction of contact " + std::to_string(i) + " must be at least 0.");
      const auto     begin = problem.W.column.begin();
      const Matrix3 &H =
          problem.W
              .value[std::lower_bound(begin + problem.W.start[i], begin + problem.W.start[i + 1], i) - begin];
      if (!(H[0] > 0.) || (problem.mu[i] > 0. && !(H[4] > 0. && H[8] > 0.)))
        refuse(file, "the diagonal of W is not positive at contact " + std::to_string(i) + ".");
    }
  }
} // namespace Voussoir
