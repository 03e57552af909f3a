// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_problem_file_h
#define voussoir_problem_file_h

#include <voussoir/joints/friction_problem.h>

#include <map>

namespace Voussoir
{
  /** Reads a problem in FCLib's format, or as Contact/Write problems writes it. Throws InputError with the file
   * name and the defect. */
  FrictionProblem read_problem(const std::string &file);

  /** Returns a matrix with these blocks, and with zero blocks where the diagonal is missing. @p rows: column and
   * block of each row. */
  BlockSparseMatrix matrix_of(std::vector<std::map<unsigned int, Matrix3>> rows);

  /** Throws InputError if a number is not finite, a coefficient of friction is negative, or a diagonal of W is not
   * positive. */
  void check_problem(const std::string &file, const FrictionProblem &problem);

  /** Throws InputError with the file name and the defect. */
  [[noreturn]] void refuse(const std::string &file, const std::string &what);
} // namespace Voussoir

#endif
