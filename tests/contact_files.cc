// SPDX-License-Identifier: GPL-3.0-or-later
// FCLib files and texts of problems: written and read again, in all layouts of W; bad ones are refused.
// The bad files stay in DIRECTORY, where the test of the program finds them.
// Usage: contact_files DIRECTORY

#include "blocks.h"
#include "fclib_io.h"
#include "problem_file.h"

#include <voussoir/base/error.h>

#include <filesystem>
#include <fstream>
#include <hdf5.h>

using namespace Columns;

namespace
{
  std::string directory = "contact_files";

  const std::string text_file = "contact_files.txt";

  std::string file(const std::string &name)
  {
    return directory + "/" + name + ".hdf5";
  }

  /** Contacts in a row, each coupled with the next. */
  FrictionProblem sample(const unsigned int n)
  {
    std::vector<std::vector<unsigned int>> columns(n);
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = i > 0 ? i - 1 : 0; j < std::min(n, i + 2); ++j)
        columns[i].push_back(j);
    FrictionProblem p;
    p.W = BlockSparseMatrix(columns);
    for (unsigned int i = 0; i < n; ++i)
    {
      p.W.add(i, i, {{2., .1, .2, .1, 2.5, .3, .2, .3, 3.}});
      if (i + 1 < n)
      {
        p.W.add(i, i + 1, {{-.5, .1, .2, .3, -.4, .05, .15, .25, -.6}});
        p.W.add(i + 1, i, {{-.5, .3, .15, .1, -.4, .25, .2, .05, -.6}});
      }
      p.mu.push_back(.3 + .1 * i);
      for (unsigned int c = 0; c < 3; ++c)
        p.q.push_back(random_number() - (c == 0 ? .5 : 0.));
    }
    p.title = "a sample";
    return p;
  }

  void write_new(const std::string &name, const FrictionProblem &problem)
  {
    std::filesystem::remove(file(name));
    write_fclib(file(name), problem);
  }

  void remove_entry(const std::string &name, const std::string &path)
  {
    const hid_t h = H5Fopen(file(name).c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
    if (h < 0 || H5Ldelete(h, path.c_str(), H5P_DEFAULT) < 0)
      throw InputError("cannot remove " + path + " of " + name);
    H5Fclose(h);
  }

  template <class Number>
  void put(const std::string &name, const std::string &path, const std::vector<Number> &values)
  {
    const hid_t   h = H5Fopen(file(name).c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
    const hsize_t size = values.size();
    const hid_t   type = std::is_same<Number, int>::value ? H5T_NATIVE_INT : H5T_NATIVE_DOUBLE,
                space = H5Screate_simple(1, &size, nullptr);
    if (H5Lexists(h, path.c_str(), H5P_DEFAULT) > 0)
      H5Ldelete(h, path.c_str(), H5P_DEFAULT);
    const hid_t data = H5Dcreate2(h, path.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    if (data < 0 || H5Dwrite(data, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0)
      throw InputError("cannot write " + path + " of " + name);
    H5Dclose(data);
    H5Sclose(space);
    H5Fclose(h);
  }

  double difference(const FrictionProblem &a, const FrictionProblem &b)
  {
    if (a.W.start != b.W.start || a.W.column != b.W.column || a.mu != b.mu || a.q != b.q)
      return 1.;
    double worst = 0.;
    for (std::size_t k = 0; k < a.W.value.size(); ++k)
      for (unsigned int c = 0; c < 9; ++c)
        worst = std::max(worst, std::abs(a.W.value[k][c] - b.W.value[k][c]));
    return worst;
  }

  void test_round_trip()
  {
    const FrictionProblem p = sample(5);
    write_new("good", p);
    report("written and read again, by rows", difference(p, read_problem(file("good"))), "= 0",
           difference(p, read_problem(file("good"))) == 0. && read_problem(file("good")).title == p.title);
    const std::string with_guess = file("with_guess");
    std::filesystem::remove(with_guess);
    FrictionProblem guessed = p;
    for (unsigned int i = 0; i < 15; ++i)
      guessed.guess.push_back(1. / (3. + i));
    write_fclib(with_guess, guessed);
    report("with an initial guess", difference(p, read_problem(with_guess)), "= 0",
           difference(p, read_problem(with_guess)) == 0.);
    write_friction_problem(text_file, guessed);
    const FrictionProblem read = read_problem(text_file);
    report("written as text and read again", difference(p, read), "= 0",
           difference(p, read) == 0. && read.guess == guessed.guess && read.title == p.title);

    // The other layouts
    std::vector<int>    row, column, start(1, 0);
    std::vector<double> value;
    for (unsigned int j = 0; j < 15; ++j) // by columns
    {
      for (unsigned int i = 0; i < 5; ++i)
        for (std::size_t k = p.W.start[i]; k < p.W.start[i + 1]; ++k)
          if (p.W.column[k] == j / 3)
            for (unsigned int c = 0; c < 3; ++c)
            {
              row.push_back(3 * i + c);
              column.push_back(j);
              value.push_back(p.W.value[k][3 * c + j % 3]);
            }
      start.push_back(row.size());
    }
    const std::string W = "/fclib_local/W/";
    write_new("by_columns", p);
    put("by_columns", W + "p", start);
    put("by_columns", W + "i", row);
    put("by_columns", W + "x", value);
    put<int>("by_columns", W + "nz", {-1});
    below("by columns", difference(p, read_problem(file("by_columns"))), 1e-300);
    write_new("triplets", p);
    put("triplets", W + "p", column);
    put("triplets", W + "i", row);
    put("triplets", W + "x", value);
    put<int>("triplets", W + "nz", {int(value.size())});
    below("triplets", difference(p, read_problem(file("triplets"))), 1e-300);
    value[4] -= 3.; // what is given twice is added
    row.push_back(row[4]), column.push_back(column[4]), value.push_back(3.);
    put("triplets", W + "p", column);
    put("triplets", W + "i", row);
    put("triplets", W + "x", value);
    put<int>("triplets", W + "nz", {int(value.size())});
    put<int>("triplets", W + "nzmax", {int(value.size())});
    below("triplets, one of them given twice", difference(p, read_problem(file("triplets"))), 1e-14);
    // Titles are optional.
    write_new("no_info", p);
    remove_entry("no_info", "/fclib_local/info");
    below("without title", difference(p, read_problem(file("no_info"))), 1e-300);
    write_new("half_info", p);
    remove_entry("half_info", "/fclib_local/info/math_info");
    below("with a title, without the rest", difference(p, read_problem(file("half_info"))), 1e-300);
  }

  void refused(const std::string &name, const std::string &part)
  {
    std::string message = "read without complaint";
    bool        good = false;
    try
    {
      read_problem(file(name));
    }
    catch (const InputError &error)
    {
      message = error.what();
      good = message.find(part) != std::string::npos && message.find(name) != std::string::npos;
    }
    catch (const std::exception &error)
    {
      message = std::string("not an InputError: ") + error.what();
    }
    report("refused: " + name, 0., "\"" + part + "\"", good);
    std::printf("    %s\n", message.c_str());
  }

  void test_bad_files()
  {
    const FrictionProblem p = sample(3);
    const std::string     W = "/fclib_local/W/", vectors = "/fclib_local/vectors/";
    const double          nan = std::nan(""), inf = std::numeric_limits<double>::infinity();
    std::vector<double>   x;
    for (unsigned int i = 0; i < 3; ++i)
      for (unsigned int c = 0; c < 3; ++c)
        for (std::size_t k = p.W.start[i]; k < p.W.start[i + 1]; ++k)
          for (unsigned int j = 0; j < 3; ++j)
            x.push_back(p.W.value[k][3 * c + j]);
    std::vector<int> i_out, pointers;
    {
      const hid_t h = (write_new("index", p), H5Fopen(file("index").c_str(), H5F_ACC_RDONLY, H5P_DEFAULT));
      i_out.resize(x.size());
      pointers.resize(10);
      for (auto *list : {&i_out, &pointers})
      {
        const hid_t data = H5Dopen2(h, (W + (list == &i_out ? "i" : "p")).c_str(), H5P_DEFAULT);
        H5Dread(data, H5T_NATIVE_INT, H5S_ALL, H5S_ALL, H5P_DEFAULT, list->data());
        H5Dclose(data);
      }
      H5Fclose(h);
    }
    const auto ints = [&](const std::string &name, const std::string &path, const std::vector<int> &values,
                          const std::string &part)
    {
      write_new(name, p);
      put(name, path, values);
      refused(name, part);
    };
    const auto reals = [&](const std::string &name, const std::string &path,
                           const std::vector<double> &values, const std::string &part)
    {
      write_new(name, p);
      put(name, path, values);
      refused(name, part);
    };
    const auto without = [&](const std::string &name, const std::string &path)
    {
      write_new(name, p);
      remove_entry(name, path);
      refused(name, path);
    };
    refused("missing", "no such file");
    std::ofstream(file("text")) << "no data\n";
    refused("text", "not an HDF5 file");
    std::ofstream(file("empty"));
    refused("empty", "not an HDF5 file");
    write_new("cut", p);
    std::filesystem::resize_file(file("cut"), std::filesystem::file_size(file("cut")) / 2);
    refused("cut", "damaged");
    H5Fclose(H5Fcreate(file("nothing").c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT));
    refused("nothing", "fclib_local");

    ints("plane", "/fclib_local/spacedim", {2}, "2 dimensions");
    ints("no_rows", W + "m", {0}, "square");
    ints("rectangle", W + "n", {6}, "square");
    ints("layout", W + "nz", {-3}, "W/nz");
    ints("many_triplets", W + "nz", {int(x.size()) + 1}, "W/nz");
    ints("negative_size", W + "nzmax", {-4}, "W/");
    ints("size_too_small", W + "nzmax", {int(x.size()) - 1}, "W/");
    ints("size_too_large", W + "nzmax", {int(x.size()) + 1}, "W/");
    ints("two_sizes", W + "m", {9, 9}, "one number");
    // Five triplets, in arrays for more: libfclib reads them into memory for five.
    write_new("longer_triplets", p);
    put("longer_triplets", W + "p", i_out);
    put<int>("longer_triplets", W + "nz", {5});
    refused("longer_triplets", "W/p");
    auto longer = i_out;
    longer.resize(100000, 0);
    ints("columns_too_many", W + "i", longer, "W/i");
    auto many = pointers;
    many.resize(100000, pointers.back());
    ints("pointers_too_many", W + "p", many, "W/p");
    reals("values_too_many", W + "x", std::vector<double>(100000, 1.), "W/x");
    auto bad = i_out;
    bad[5] = 9;
    ints("index", W + "i", bad, "column 9");
    bad[5] = -1;
    ints("negative_index", W + "i", bad, "column -1");
    bad = pointers;
    bad[4] = bad[5] + 1;
    ints("pointers", W + "p", bad, "W/p");
    bad = pointers;
    bad.back() = int(x.size()) + 3;
    ints("pointer_beyond", W + "p", bad, "W/p");
    bad = pointers;
    bad.front() = 2;
    ints("pointer_first", W + "p", bad, "W/p");
    bad = pointers;
    bad.pop_back();
    ints("few_pointers", W + "p", bad, "W/p");
    reals("real_index", W + "i", x, "integers");
    ints("integer_value", W + "x", i_out, "real numbers");

    auto value = x;
    value[3] = nan;
    reals("nan_W", W + "x", value, "finite");
    value[3] = inf;
    reals("inf_W", W + "x", value, "finite");
    value = x;
    value[0] = -1.;
    reals("negative_diagonal", W + "x", value, "diagonal of W");
    value[0] = 0.;
    reals("zero_diagonal", W + "x", value, "diagonal of W");
    value = x;
    value[pointers[1] + 1] = -1.;
    reals("negative_tangential", W + "x", value, "diagonal of W");
    value = p.q;
    value[4] = nan;
    reals("nan_q", vectors + "q", value, "vectors/q");
    value[4] = -inf;
    reals("inf_q", vectors + "q", value, "vectors/q");
    value.pop_back();
    reals("short_q", vectors + "q", value, "9 entries");
    value.resize(12);
    reals("long_q", vectors + "q", value, "9 entries");
    reals("negative_mu", vectors + "mu", {.3, -.4, .5}, "friction");
    reals("nan_mu", vectors + "mu", {.3, nan, .5}, "friction");
    reals("short_mu", vectors + "mu", {.3, .5}, "3 entries");
    for (const std::string name : {"m", "n", "nzmax", "nz", "p", "i", "x"})
      without("no_W_" + name, W + name);
    without("no_q", vectors + "q");
    without("no_mu", vectors + "mu");
    without("no_spacedim", "/fclib_local/spacedim");
    write_new("half_matrix_info", p);
    put<double>("half_matrix_info", W + "conditioning", {1.});
    refused("half_matrix_info", W + "determinant");
    put<double>("half_matrix_info", W + "determinant", {1.});
    refused("half_matrix_info", W + "rank");
    put<int>("half_matrix_info", W + "rank", {9});
    report("W with a description", 0., "", read_problem(file("half_matrix_info")).q.size() == 9);
    {
      write_new("bilateral", p);
      const hid_t h = H5Fopen(file("bilateral").c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
      H5Gclose(H5Gcreate2(h, "/fclib_local/V", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
      H5Fclose(h);
      refused("bilateral", "bilateral");
    }
    {
      std::filesystem::remove(file("global"));
      const hid_t h = H5Fcreate(file("global").c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
      H5Gclose(H5Gcreate2(h, "/fclib_global", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
      H5Fclose(h);
      refused("global", "global problem");
    }
    // A data set where a group should be
    std::filesystem::remove(file("no_group"));
    H5Fclose(H5Fcreate(file("no_group").c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT));
    put<int>("no_group", "/fclib_local", {1});
    refused("no_group", "fclib_local");
    bool there = false;
    try
    {
      write_fclib(file("good"), p);
    }
    catch (const InputError &error)
    {
      there = std::string(error.what()).find("already exists") != std::string::npos;
    }
    report("a file that is there is not overwritten", 0., "", there);
  }

  /** Refuses the text of a problem with @p from replaced by @p to. */
  void refused_text(const std::string &from, const std::string &to, const std::string &part)
  {
    std::ifstream in(text_file);
    std::string   text((std::istreambuf_iterator<char>(in)), {});
    const auto    place = text.find(from);
    text = place == std::string::npos ? "" : text.replace(place, from.size(), to);
    const std::string bad = directory + "/bad.txt";
    std::ofstream(bad) << text;
    std::string message;
    try
    {
      read_problem(bad);
    }
    catch (const InputError &error)
    {
      message = error.what();
    }
    report("text with " + to + ": " + message, 0., "", message.find(part) != std::string::npos);
  }

  void test_bad_texts()
  {
    FrictionProblem p = sample(2);
    p.mu = {.25, .5};
    p.guess.assign(6, 0.);
    write_friction_problem(text_file, p);
    refused_text("2 4", "0 4", "do not agree");
    refused_text("2 4", "2 99999999999", "do not agree");
    refused_text("2 4", "-2 4", "do not agree");
    refused_text("2 4", "2 5", "a number is missing");
    refused_text(" 0.25 ", " -0.25 ", "friction");
    refused_text(" 0.25 ", " nan ", "not a finite number");
    refused_text(" 0.25 ", " 1e999 ", "not a finite number");
    refused_text("\n1 1 2 ", "\n1 2 2 ", "column 2, outside");
    refused_text("\n1 1 2 ", "\n1 1 -2 ", "diagonal of W");
    refused_text("\n1 1 2 ", "\n1 0 2 ", "diagonal of W"); // no block on the diagonal
  }
} // namespace

int main(int argc, char **argv)
{
  if (argc > 1)
    directory = argv[1];
  std::filesystem::create_directories(directory);
  return run_all({test_round_trip, test_bad_files, test_bad_texts});
}
