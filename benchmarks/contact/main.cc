// SPDX-License-Identifier: GPL-3.0-or-later
// The program voussoir-contact: the contact solver on problems of files.
#include "fclib_io.h"
#include "problem_file.h"
#include "solve_problem.h"

#include <voussoir/base/error.h>
#include <voussoir/base/log.h>
#include <voussoir/base/output_file.h>
#include <voussoir/base/version.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <ctime>
#include <filesystem>
#include <iomanip>
#include <iostream>
#include <map>
#include <omp.h>

extern "C" void openblas_set_num_threads(int);

namespace
{
  using namespace Voussoir;

  constexpr const char *help =
      "voussoir-contact FILE... [--tolerance X] [--solver NAME] [--max-seconds X] [--write-solutions DIR] "
      "[--write-fclib DIR]\n"
      "    Solves frictional contact problems in FCLib's format, or those of Contact/Write problems. Prints a JSON "
      "object per file, with CPU times.\n"
      "  --tolerance X               largest residual, by default 1e-12\n"
      "  --solver NAME               newton (default, with fallbacks), proximal, sweeps (Gauss-Seidel), paper\n"
      "  --max-seconds X             largest CPU time for each problem [s], by default 10\n"
      "  --write-solutions DIR       write the contact forces into this directory\n"
      "  --write-fclib DIR           write the problems into this directory, in FCLib's format\n"
      "All options accept \"=\".\n"
      "Exit status: 0 done; 1 the computation failed; 2 bad input.\n";

  /** Options of the program, as texts of the command line. */
  struct ContactOptions
  {
    std::string tolerance = "1e-12"; ///< largest relative residual [-]
    std::string solver = "newton";   ///< `newton`, `proximal`, `sweeps` or `paper`
    std::string max_seconds = "10";  ///< largest CPU time for each problem [s]
    std::string solutions;           ///< directory for the contact forces; empty: not written
    std::string problems;            ///< directory for the problems in FCLib's format; empty: not written
  };

  double positive_number(const std::string &option, const std::string &text)
  {
    char        *end = nullptr;
    const double value = std::strtod(text.c_str(), &end);
    if (text.empty() || *end != '\0' || !(value > 0.))
      throw InputError(option + " must be a positive number, not \"" + text + "\".");
    return value;
  }

  /** Sets the method of --solver. Returns its equations. */
  Equations choose_solver(const std::string &solver, ContactParameters &parameters)
  {
    if (solver == "paper")
      return equations_from_name(solver);
    if (solver != "newton" && solver != "proximal" && solver != "sweeps")
      throw InputError("There is no solver \"" + solver +
                       "\". The solvers are: newton, proximal, sweeps, paper.");
    parameters.method = solver;
    return Equations::alart_curnier;
  }

  ContactParameters parameters_of(const ContactOptions &options)
  {
    ContactParameters parameters;
    parameters.tolerance = positive_number("--tolerance", options.tolerance);
    if (!std::isfinite(parameters.tolerance))
      throw InputError("--tolerance must be a finite number, not \"" + options.tolerance + "\".");
    parameters.max_seconds = positive_number("--max-seconds", options.max_seconds);
    parameters.max_iterations = 1000000; // time is the limit
    return parameters;
  }

  /** Makes the directory of @p option for results of all files. Nothing is done without the option. */
  void make_directory(const std::string &option, const std::string &directory,
                      const std::vector<std::string> &files)
  {
    if (directory.empty())
      return;
    std::error_code error;
    std::filesystem::create_directories(directory, error);
    if (error || !std::filesystem::is_directory(directory, error))
      throw InputError(option + ": the directory " + directory +
                       " cannot be created. Choose another directory.");
    std::map<std::string, std::string> names; // file of each name; a file may be listed twice
    for (const std::string &file : files)
      if (names.try_emplace(std::filesystem::path(file).stem().string(), file).first->second != file)
        throw InputError(option + ": two of the files have the name " +
                         std::filesystem::path(file).stem().string() +
                         ", so their results would have the same name. Solve them separately.");
  }

  std::string path_in(const std::string &directory, const std::string &file, const std::string &extension)
  {
    return (std::filesystem::path(directory) / std::filesystem::path(file).stem()).string() + extension;
  }

  void write_solution(const std::string &directory, const std::string &file, const Unknowns &force)
  {
    OutputFile out(path_in(directory, file, ".txt"));
    out << std::setprecision(17);
    for (const double f : force)
      out << f << '\n';
    out.check();
  }

  /** Solves one problem and prints its result. */
  FrictionSolution solve_and_print(const std::string &file, const FrictionProblem &problem,
                                   const ContactParameters &parameters, const Equations equations)
  {
    const std::clock_t     start = std::clock();
    const FrictionSolution solution = solve_friction_problem(problem, parameters, equations);
    const double           seconds = double(std::clock() - start) / CLOCKS_PER_SEC;
    const ContactResult   &result = solution.result;
    const std::string      text = Json()
                                 .add("file", file)
                                 .add("contacts", problem.W.n_rows())
                                 .add_flag("converged", result.converged)
                                 .add("residual", result.residual)
                                 .add("residual_over_load", result.residual_over_load)
                                 .add("iterations", result.iterations)
                                 .add("seconds", seconds)
                                 .add("solver", solution.solver)
                                 .add("sweeps", result.sweeps)
                                 .line();
    std::cout << text << std::endl;
    return solution;
  }

  /** Solves the problems and prints one JSON object for each. A file that cannot be read is reported on stderr, and
   * the others are solved. Throws InputError for an invalid option, and at the end if a file cannot be read;
   * ComputationError at the end if a problem did not converge. */
  void run_contact(const std::vector<std::string> &files, const ContactOptions &options)
  {
    omp_set_num_threads(1); // small problems; CPU time is that of the solution
    if (files.empty())
      throw InputError("`voussoir-contact` requires FCLib files, or those of Contact/Write problems. "
                       "`voussoir-contact --help` shows the usage.");
    ContactParameters parameters = parameters_of(options);
    const Equations   equations = choose_solver(options.solver, parameters);
    make_directory("--write-solutions", options.solutions, files);
    make_directory("--write-fclib", options.problems, files);
    unsigned int failures = 0, unreadable = 0, unbounded = 0;
    for (const std::string &file : files)
    {
      FrictionProblem problem;
      try
      {
        problem = read_problem(file);
      }
      catch (const InputError &error)
      {
        if (files.size() == 1)
          throw;
        std::cerr << "voussoir: error: " << error.what() << std::endl;
        ++unreadable; // the others are solved
        continue;
      }
      if (!options.problems.empty())
        write_fclib(path_in(options.problems, file, ".hdf5"), problem);
      const FrictionSolution solution = solve_and_print(file, problem, parameters, equations);
      failures += !solution.result.converged;
      unbounded += !solution.result.converged && solution.result.force_over_load > 1e3;
      if (!options.solutions.empty())
        write_solution(options.solutions, file, solution.force);
    }
    const std::string not_converged =
        std::to_string(failures) + " of " + std::to_string(files.size() - unreadable) +
        " problems did not converge to " + options.tolerance + " within " + options.max_seconds +
        " s each (\"converged\": false). Increase --tolerance or --max-seconds." +
        (unbounded > 0 ? " In " + std::to_string(unbounded) +
                             " of them forces grow without bound: the problem probably has no solution."
                       : "");
    if (unreadable > 0)
      throw InputError(std::to_string(unreadable) + " of " + std::to_string(files.size()) +
                       " files cannot be read (see above). The others were solved." +
                       (failures > 0 ? " Of these, " + not_converged : ""));
    if (failures > 0)
      throw ComputationError(not_converged);
  }

  /** Reads the command line. Returns the files. */
  std::vector<std::string> read_words(const std::vector<std::string> &words, ContactOptions &options)
  {
    std::map<std::string, std::string *> values = {{"--tolerance", &options.tolerance},
                                                   {"--solver", &options.solver},
                                                   {"--max-seconds", &options.max_seconds},
                                                   {"--write-solutions", &options.solutions},
                                                   {"--write-fclib", &options.problems}};
    std::vector<std::string>             files;
    bool                                 options_end = false;
    for (std::size_t i = 0; i < words.size(); ++i)
    {
      if (options_end || words[i].size() < 2 || words[i][0] != '-')
      {
        files.push_back(words[i]);
        continue;
      }
      if (words[i] == "--")
      {
        options_end = true;
        continue;
      }
      const auto        equals = words[i].find('=');
      const std::string name = words[i].substr(0, equals);
      const auto        found = values.find(name);
      if (found == values.end())
        throw InputError("`voussoir-contact` has no option " + name +
                         ". `voussoir-contact --help` shows all options.");
      if (found->second == nullptr)
        throw InputError("The option " + name + " is given twice. Remove one.");
      const std::string value = equals != std::string::npos ? words[i].substr(equals + 1)
                                : i + 1 < words.size() && words[i + 1].rfind("--", 0) != 0 ? words[++i]
                                                                                           : "";
      if (value.empty())
        throw InputError("The option " + name + " needs a value. `voussoir-contact --help` shows the usage.");
      *found->second = value;
      found->second = nullptr;
    }
    return files;
  }

  void run(const std::vector<std::string> &words)
  {
    const auto has = [&](const std::string &word)
    { return std::find(words.begin(), words.end(), word) != words.end(); };
    ContactOptions options;
    if (has("--help") || has("-h"))
      std::cout << help;
    else if (has("--version"))
      std::cout << "voussoir-contact " << version() << " (" << revision() << ")\n";
    else
      run_contact(read_words(words, options), options);
    errno = 0;
    if (!std::cout.flush() && errno != EPIPE)
      throw WriteError(
          "Standard output cannot be written. Free disk space, or redirect the output to another file.");
  }
} // namespace

int main(int argc, char *argv[])
{
  openblas_set_num_threads(1);
  std::signal(SIGXFSZ, SIG_IGN); // a file size limit is reported by the write operation
  try
  {
    run({argv + 1, argv + argc});
    return 0;
  }
  catch (const InputError &error)
  {
    std::cerr << "voussoir: error: " << error.what() << std::endl;
    return 2;
  }
  catch (const ComputationError &error)
  {
    std::cerr << "voussoir: failed: " << error.what() << std::endl;
  }
  catch (const std::bad_alloc &)
  {
    std::cerr << "voussoir: failed: there is not enough memory." << std::endl;
  }
  catch (const std::exception &error)
  {
    std::cerr << "voussoir: internal error, please report it: " << error.what() << std::endl;
  }
  return 1;
}
