// SPDX-License-Identifier: GPL-3.0-or-later
#include "fclib_io.h"

#include <voussoir/base/error.h>

#ifdef VOUSSOIR_WITH_FCLIB
#include "problem_file.h"

#include <voussoir/base/guarded.h>
#include <voussoir/base/output_file.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <hdf5.h>
#include <map>

extern "C"
{
#include <fclib.h>
}

namespace Voussoir
{
  namespace
  {
    /** Checks of a file before libfclib reads it, since libfclib ends the program if an entry is missing. */
    class Inspector
    {
    public:
      explicit Inspector(const std::string &file) : file(file)
      {
        H5Eset_auto(H5E_DEFAULT, nullptr, nullptr);
        if (H5Fis_hdf5(file.c_str()) <= 0)
          refuse(
              file,
              "this is not an HDF5 file. `voussoir-contact` reads FCLib files, and the files of Contact/Write problems.");
        handle = H5Fopen(file.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
        if (handle < 0)
          refuse(file, "the HDF5 file cannot be opened; it may be damaged.");
      }
      ~Inspector() { H5Fclose(handle); }

      bool has(const std::string &path) const
      {
        for (std::size_t end = path.find('/', 1);; end = path.find('/', end + 1))
        {
          if (H5Lexists(handle, path.substr(0, end).c_str(), H5P_DEFAULT) <= 0)
            return false;
          if (end == std::string::npos)
            return true;
        }
      }

      /** Returns the number of entries of a data set of integers or reals. */
      long long size(const std::string &path, const bool integers) const
      {
        if (!has(path))
          refuse(file, "the entry " + path + " is missing.");
        const hid_t data = H5Dopen2(handle, path.c_str(), H5P_DEFAULT);
        if (data < 0)
          refuse(file, "the entry " + path + " is not a data set.");
        const hid_t space = H5Dget_space(data), type = H5Dget_type(data);
        const auto  n = H5Sget_simple_extent_npoints(space);
        const bool  right = H5Tget_class(type) == (integers ? H5T_INTEGER : H5T_FLOAT);
        H5Tclose(type);
        H5Sclose(space);
        H5Dclose(data);
        if (!right)
          refuse(file, "the entry " + path + " must hold " + (integers ? "integers." : "real numbers."));
        return n;
      }

      int integer(const std::string &path) const
      {
        if (size(path, true) != 1)
          refuse(file, "the entry " + path + " must be one number.");
        int         value = 0;
        const hid_t data = H5Dopen2(handle, path.c_str(), H5P_DEFAULT);
        H5Dread(data, H5T_NATIVE_INT, H5S_ALL, H5S_ALL, H5P_DEFAULT, &value);
        H5Dclose(data);
        return value;
      }

    private:
      const std::string file;
      hid_t             handle;
    };

    void inspect(const std::string &file)
    {
      const Inspector in(file);
      if (!in.has("/fclib_local"))
        refuse(file, in.has("/fclib_global")
                         ? "this is a global problem. `voussoir-contact` solves local problems "
                           "(\"fclib_local\"). Condense it first: W = H^T M^-1 H, q = H^T M^-1 f + w."
                         : "the file has no problem \"fclib_local\".");
      const std::string W = "/fclib_local/W/", vectors = "/fclib_local/vectors/";
      if (const int dimension = in.integer("/fclib_local/spacedim"); dimension != 3)
        refuse(file, "the problem has " + std::to_string(dimension) + " dimensions; it must have 3.");
      if (in.has("/fclib_local/V") || in.has("/fclib_local/R"))
        refuse(file, "the problem has a bilateral part (V, R), which Voussoir does not solve.");
      const long long m = in.integer(W + "m"), n = in.integer(W + "n"), nzmax = in.integer(W + "nzmax"),
                      nz = in.integer(W + "nz");
      if (m < 3 || m != n || m % 3 != 0)
        refuse(file, "W is " + std::to_string(m) + " by " + std::to_string(n) +
                         "; it must be square, with three rows per contact.");
      if (nz < -2 || nz > nzmax)
        refuse(file, "W/nz must be -2 (by rows), -1 (by columns) or the number of triplets.");
      // libfclib reads whole data sets into arrays of these sizes.
      const auto fits =
          [&](const char *name, const bool integers, const long long least, const long long most)
      {
        const long long size = in.size(W + name, integers);
        if (size < least || size > most)
          refuse(file, "W/" + std::string(name) + " has " + std::to_string(size) + " entries; " +
                           (nz < 0 && name[0] == 'p' ? "with " + std::to_string(m) + " rows it must have "
                                                     : "by W/nzmax and W/nz it must have ") +
                           std::to_string(most) + ".");
      };
      fits("p", true, nz >= 0 ? nz : m + 1, nz >= 0 ? nz : m + 1);
      fits("i", true, nz >= 0 ? nz : nzmax, nz >= 0 ? nz : nzmax);
      fits("x", false, nz >= 0 ? nz : nzmax, nzmax);
      if (in.size(vectors + "q", false) != m)
        refuse(file, "vectors/q must have " + std::to_string(m) + " entries, one per row of W.");
      if (in.size(vectors + "mu", false) != m / 3)
        refuse(file, "vectors/mu must have " + std::to_string(m / 3) + " entries, one per contact.");
      if (in.has(W + "conditioning")) // then libfclib also requires these
      {
        in.size(W + "conditioning", false);
        in.size(W + "determinant", false);
        in.integer(W + "rank");
      }
    }

    BlockSparseMatrix blocks(const std::string &file, const fclib_matrix &W)
    {
      const unsigned int                           n = W.m / 3;
      std::vector<std::map<unsigned int, Matrix3>> rows(n);
      const auto add = [&](const int row, const int column, const double value)
      {
        if (row < 0 || column < 0 || row >= W.m || column >= W.n)
          refuse(file, "W has an entry at row " + std::to_string(row) + ", column " + std::to_string(column) +
                           ", outside the matrix.");
        if (!std::isfinite(value))
          refuse(file, "W has an entry that is not a finite number, in row " + std::to_string(row) + ".");
        rows[row / 3].try_emplace(column / 3, Matrix3{}).first->second[3 * (row % 3) + column % 3] += value;
      };
      if (W.nz >= 0) // triplets: rows are in i in all files, although the header states p
        for (int k = 0; k < W.nz; ++k)
          add(W.i[k], W.p[k], W.x[k]);
      else
        for (int line = 0; line < W.m; ++line)
        {
          if (W.p[0] != 0 || W.p[line + 1] < W.p[line] || W.p[line + 1] > W.nzmax)
            refuse(file, "the pointers W/p do not ascend from 0 to W/nzmax.");
          for (int k = W.p[line]; k < W.p[line + 1]; ++k)
            W.nz == -2 ? add(line, W.i[k], W.x[k]) : add(W.i[k], line, W.x[k]);
        }
      return matrix_of(std::move(rows));
    }

    /** Reads the file in this process. The libraries may crash. */
    FrictionProblem read_unguarded(const std::string &file)
    {
      inspect(file);
      std::unique_ptr<fclib_local, void (*)(fclib_local *)> problem(fclib_read_local(file.c_str()),
                                                                    [](fclib_local *p)
                                                                    {
                                                                      fclib_delete_local(p);
                                                                      free(p);
                                                                    });
      if (!problem)
        refuse(file, "libfclib cannot read the problem. The file is damaged; write it again.");
      FrictionProblem result;
      result.W = blocks(file, *problem->W);
      result.q.assign(problem->q, problem->q + problem->W->m);
      result.mu.assign(problem->mu, problem->mu + problem->W->m / 3);
      if (problem->info && problem->info->title)
        result.title = problem->info->title;
      check_problem(file, result);
      return result;
    }
  } // namespace

  FrictionProblem read_fclib(const std::string &file)
  {
    FrictionProblem problem;
    run_guarded(
        "The FCLib file " + file + " cannot be read",
        limits_for_file(double(std::filesystem::file_size(file))), [&] { problem = read_unguarded(file); },
        [&](PipeWriter &pipe)
        {
          pipe.put(problem.W.start);
          pipe.put(problem.W.column);
          pipe.put(problem.W.value);
          pipe.put(problem.q);
          pipe.put(problem.mu);
          pipe.put(problem.title);
        },
        [&](PipeReader &pipe)
        {
          pipe.get(problem.W.start);
          pipe.get(problem.W.column);
          pipe.get(problem.W.value);
          pipe.get(problem.q);
          pipe.get(problem.mu);
          pipe.get(problem.title);
        });
    return problem;
  }

  void write_fclib(const std::string &file, const FrictionProblem &problem)
  {
    if (std::filesystem::exists(file))
      refuse(file, "the file already exists. Remove it, or choose another name.");
    std::vector<int>    start(1, 0), column;
    std::vector<double> value;
    for (unsigned int i = 0; i < problem.W.n_rows(); ++i)
      for (unsigned int c = 0; c < 3; ++c)
      {
        for (std::size_t k = problem.W.start[i]; k < problem.W.start[i + 1]; ++k)
          for (unsigned int j = 0; j < 3; ++j)
          {
            column.push_back(3 * problem.W.column[k] + j);
            value.push_back(problem.W.value[k][3 * c + j]);
          }
        start.push_back(static_cast<int>(column.size()));
      }
    std::string  title = problem.title, description = "gap = W force + q", math_info;
    fclib_info   info{title.data(), description.data(), math_info.data()};
    fclib_matrix W{};
    W.nzmax = static_cast<int>(value.size());
    W.m = W.n = static_cast<int>(problem.q.size());
    W.p = start.data();
    W.i = column.data();
    W.x = value.data();
    W.nz = -2;
    fclib_local local{};
    local.W = &W;
    local.q = const_cast<double *>(problem.q.data());
    local.mu = const_cast<double *>(problem.mu.data());
    local.spacedim = 3;
    local.info = &info;
    OutputFile(file).check(); // libfclib ends the program if it cannot create the file
    std::remove(file.c_str());
    if (fclib_write_local(&local, file.c_str()) != 1)
      throw WriteError("The contact problem cannot be written to " + file + ".");
    if (problem.guess.empty())
      return;
    Unknowns gap(problem.q.size());
    problem.W.multiply(problem.guess.data(), gap.data());
    for (std::size_t k = 0; k < gap.size(); ++k)
      gap[k] += problem.q[k];
    fclib_solution guess{};
    guess.r = const_cast<double *>(problem.guess.data());
    guess.u = gap.data();
    if (fclib_write_guesses(1, &guess, file.c_str()) != 1)
      throw WriteError("The initial guess cannot be written to " + file + ".");
  }

  void require_fclib() {}
} // namespace Voussoir

#else

namespace Voussoir
{
  void require_fclib()
  {
    throw InputError(
        "This program was built without FCLib, so it reads only the files of Contact/Write problems. "
        "Install libfclib and HDF5, and build with -DVOUSSOIR_WITH_FCLIB=ON.");
  }

  FrictionProblem read_fclib(const std::string &)
  {
    require_fclib();
    return {};
  }

  void write_fclib(const std::string &, const FrictionProblem &)
  {
    require_fclib();
  }
} // namespace Voussoir
#endif
