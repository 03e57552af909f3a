// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_fclib_io_h
#define voussoir_fclib_io_h

#include <voussoir/base/node_matrix.h>

#include <string>

namespace Voussoir
{
  /** Frictional contact problem gap = W force + q with Coulomb's law. Components are (n, t1, t2). */
  struct FrictionProblem
  {
    BlockSparseMatrix   W;  ///< [m/N], or other consistent units
    Unknowns            q;  ///< gap without forces, three values per contact
    std::vector<double> mu; ///< coefficient of friction of each contact [-]
    std::string         title;
  };

  /** Throws InputError if the program was built without FCLib (VOUSSOIR_WITH_FCLIB=OFF). */
  void require_fclib();

  /** Reads the problem "fclib_local" of an FCLib file (Acary et al.): three-dimensional, without bilateral
   * part, W as triplets, by rows or by columns. The file is read in a child process, see run_guarded().
   * Throws InputError with the file name and the defect. */
  FrictionProblem read_fclib(const std::string &file);

  /** Writes a problem to a new FCLib file.
   * @param file name of the file
   * @param problem W, q, coefficients of friction and title
   * @param guess_force initial guess of the forces; empty: none
   * @param guess_gap gaps of the initial guess
   *
   * Throws InputError if the file exists, and WriteError if it cannot be written. */
  void write_fclib(const std::string &file, const FrictionProblem &problem, const Unknowns &guess_force,
                   const Unknowns &guess_gap);
} // namespace Voussoir

#endif
