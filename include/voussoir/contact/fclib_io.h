// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_fclib_io_h
#define voussoir_fclib_io_h

#include <voussoir/base/node_matrix.h>

#include <string>

namespace Voussoir
{
  /** A frictional contact problem gap = W force + q with Coulomb's law, in components (n, t1, t2). */
  struct FrictionProblem
  {
    BlockSparseMatrix   W;  ///< [m/N] or whatever the units
    Unknowns            q;  ///< 3 per contact
    std::vector<double> mu; ///< per contact [-]
    std::string         title;
  };

  /** Reads an "fclib_local" problem, 3-D, without bilateral part (FCLib, Acary et al.; W in triplets, by rows
   * or by columns). Throws InputError, naming the file and what is wrong with it. */
  FrictionProblem read_fclib(const std::string &file);

  /** Writes the problem; @p guess: initial forces and gaps, may be empty. Throws InputError if the file is
   * there or cannot be written. */
  void write_fclib(const std::string &file, const FrictionProblem &problem, const Unknowns &guess_force,
                   const Unknowns &guess_gap);
} // namespace Voussoir

#endif
