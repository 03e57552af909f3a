// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_fclib_io_h
#define voussoir_fclib_io_h

#include <voussoir/joints/friction_problem.h>

namespace Voussoir
{
  /** Throws InputError if the program was built without FCLib (VOUSSOIR_WITH_FCLIB=OFF). */
  void require_fclib();

  /** Reads the problem "fclib_local" of an FCLib file (Acary et al.): three-dimensional, without bilateral
   * part, W as triplets, by rows or by columns. The file is read in a child process, see run_guarded().
   * Throws InputError with the file name and the defect. */
  FrictionProblem read_fclib(const std::string &file);

  /** Writes a problem, with its initial guess if it has one, to a new FCLib file. Throws InputError if the file
   * exists, and WriteError if it cannot be written. */
  void write_fclib(const std::string &file, const FrictionProblem &problem);
} // namespace Voussoir

#endif
