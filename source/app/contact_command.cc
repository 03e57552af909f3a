// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/app/contact_command.h>
#include <voussoir/base/error.h>
#include <voussoir/base/log.h>
#include <voussoir/base/output_file.h>
#include <voussoir/contact/law_table.h>
#include <voussoir/contact/sparse_contact.h>
#include <voussoir/joints/pair_groups.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <filesystem>
#include <iomanip>
#include <iostream>
#include <map>
#include <omp.h>

namespace Voussoir
{
  namespace
  {
    /** Returns true if the problem is solved joint by joint: several groups of many pairs, symmetric W. */
    bool has_joints(const BlockSparseMatrix &W, const PairGroups &groups)
    {
      return groups.size.size() > 1 && W.n_rows() >= 8 * groups.size.size() && is_symmetric(W);
    }

    std::string path_name(const ContactParameters &parameters, const Equations equations,
                          const ContactPath path)
    {
      std::string name = equations == Equations::paper                ? "paper"
                         : equations == Equations::fischer_burmeister ? "fischer-burmeister"
                                                                      : parameters.method;
      if (parameters.method == "newton" && path >= ContactPath::sweeps)
        name += "+sweeps";
      if (parameters.method == "newton" && path >= ContactPath::proximal)
        name += "+proximal";
      return name;
    }

    double largest(const double x)
    {
      return std::abs(x);
    }
    double largest(const Matrix3 &block)
    {
      double result = 0.;
      for (const double x : block)
        result = std::max(result, std::abs(x));
      return result;
    }
    void scale(double &x, const int exponent)
    {
      x = std::ldexp(x, exponent);
    }
    void scale(Matrix3 &block, const int exponent)
    {
      for (double &x : block)
        scale(x, exponent);
    }

    /** Divides the values by a power of two. The largest value is then about 1, so that squares do not
     * overflow. Returns the exponent. */
    template <typename T> int normalise(std::vector<T> &values)
    {
      double size = 0.;
      for (const T &x : values)
        size = std::max(size, largest(x));
      int exponent = 0;
      if (size > 0. && std::isfinite(size))
        std::frexp(size, &exponent);
      for (T &x : values)
        scale(x, -exponent);
      return exponent;
    }

    double positive_number(const std::string &option, const std::string &text)
    {
      char        *end = nullptr;
      const double value = std::strtod(text.c_str(), &end);
      if (text.empty() || *end != '\0' || !(value > 0.))
        throw InputError(option + " must be a positive number, not \"" + text + "\".");
      return value;
    }
  } // namespace

  FrictionSolution solve_friction_problem(const FrictionProblem &problem, const ContactParameters &parameters,
                                          const Equations equations)
  {
    const unsigned int                          n = problem.W.n_rows();
    std::map<double, std::unique_ptr<JointLaw>> laws;
    std::vector<const JointLaw *>               law(n);
    for (const double mu : problem.mu)
      if (laws.find(mu) == laws.end())
        laws[mu] = make_joint_law("FJA", mu, equations);
    FrictionProblem  scaled = problem;
    const int        exponent_W = normalise(scaled.W.value), exponent_q = normalise(scaled.q);
    const PairGroups groups = find_groups(scaled.W);
    const bool       joints = has_joints(scaled.W, groups);
    const auto       old = [&](const unsigned int i) { return joints ? groups.order[i] : i; };
    for (unsigned int i = 0; i < n; ++i)
      law[i] = laws[problem.mu[old(i)]].get();

    std::unique_ptr<ContactOperator> W;
    if (joints)
      W = std::make_unique<InterfaceOperator>(make_interface_operator(scaled.W, groups));
    else
      W = std::make_unique<SparseContactOperator>(scaled.W);
    ContactSolver solver(*W, law, parameters);

    FrictionSolution solution;
    Unknowns         q(3 * n), force(3 * n, 0.), gap, start(3 * n, 0.);
    for (unsigned int k = 0; k < 3 * n; ++k)
      q[k] = scaled.q[3 * old(k / 3) + k % 3];
    solution.result = solver.solve(q, start, force, gap);
    solution.force.resize(3 * n);
    solution.gap.resize(3 * n);
    for (unsigned int k = 0; k < 3 * n; ++k)
    {
      solution.force[3 * old(k / 3) + k % 3] = std::ldexp(force[k], exponent_q - exponent_W);
      solution.gap[3 * old(k / 3) + k % 3] = std::ldexp(gap[k], exponent_q);
    }
    solution.result.converged =
        solution.result.converged && std::all_of(solution.force.begin(), solution.force.end(),
                                                 [](const double f) { return std::isfinite(f); });
    solution.solver = path_name(parameters, equations, solution.result.path);
    return solution;
  }

  namespace
  {
    /** Sets the method of --solver. Returns its equations. */
    Equations choose_solver(const std::string &solver, ContactParameters &parameters)
    {
      if (solver == "paper" || solver == "fischer-burmeister")
        return equations_from_name(solver);
      if (solver != "newton" && solver != "proximal" && solver != "sweeps")
        throw InputError("There is no solver \"" + solver +
                         "\". The solvers are: newton, proximal, sweeps, paper, fischer-burmeister.");
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

    void make_directory_of_solutions(const std::string &directory, const std::vector<std::string> &files)
    {
      std::error_code error;
      std::filesystem::create_directories(directory, error);
      if (error || !std::filesystem::is_directory(directory, error))
        throw InputError("--write-solutions: the directory " + directory +
                         " cannot be created. Choose another directory.");
      std::map<std::string, std::string> names; // file of each name; a file may be listed twice
      for (const std::string &file : files)
        if (names.try_emplace(std::filesystem::path(file).stem().string(), file).first->second != file)
          throw InputError("--write-solutions: two of the files have the name " +
                           std::filesystem::path(file).stem().string() +
                           ", so their solutions would have the same name. Solve them separately.");
    }

    void write_solution(const std::string &directory, const std::string &file, const Unknowns &force)
    {
      const auto name = std::filesystem::path(directory) / std::filesystem::path(file).stem();
      OutputFile out(name.string() + ".txt");
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
  } // namespace

  void run_contact(const std::vector<std::string> &files, const ContactOptions &options)
  {
    omp_set_num_threads(1); // small problems; CPU time is that of the solution
    if (files.empty())
      throw InputError("`voussoir contact` requires FCLib files. `voussoir --help` shows the usage.");
    require_fclib();
    ContactParameters parameters = parameters_of(options);
    const Equations   equations = choose_solver(options.solver, parameters);
    if (!options.solutions.empty())
      make_directory_of_solutions(options.solutions, files);
    unsigned int failures = 0, unreadable = 0, unbounded = 0;
    for (const std::string &file : files)
    {
      FrictionProblem problem;
      try
      {
        problem = read_fclib(file);
      }
      catch (const InputError &error)
      {
        if (files.size() == 1)
          throw;
        std::cerr << "voussoir: error: " << error.what() << std::endl;
        ++unreadable; // the others are solved
        continue;
      }
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
} // namespace Voussoir
