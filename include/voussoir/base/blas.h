// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_blas_h
#define voussoir_blas_h

/** @file
 * Functions of BLAS and LAPACK, column-major, with the Fortran interface (netlib.org/lapack). */
extern "C"
{
  void dgemm_(const char *, const char *, const int *, const int *, const int *, const double *,
              const double *, const int *, const double *, const int *, const double *, double *,
              const int *);
  void dgemv_(const char *, const int *, const int *, const double *, const double *, const int *,
              const double *, const int *, const double *, double *, const int *);
  void dpotrf_(const char *, const int *, double *, const int *, int *);
  void dpotri_(const char *, const int *, double *, const int *, int *);
  void dsymv_(const char *, const int *, const double *, const double *, const int *, const double *,
              const int *, const double *, double *, const int *);
  void dsyrk_(const char *, const char *, const int *, const int *, const double *, const double *,
              const int *, const double *, double *, const int *);
  void sgemm_(const char *, const char *, const int *, const int *, const int *, const float *, const float *,
              const int *, const float *, const int *, const float *, float *, const int *);
  void sgemv_(const char *, const int *, const int *, const float *, const float *, const int *,
              const float *, const int *, const float *, float *, const int *);
  void sgetrf_(const int *, const int *, float *, const int *, int *, int *);
  void sgetrs_(const char *, const int *, const int *, const float *, const int *, const int *, float *,
               const int *, int *);
}

#endif
