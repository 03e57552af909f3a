// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_contact_surfaces_h
#define voussoir_contact_surfaces_h

#include <voussoir/contact/joint_law.h>

#include <vector>

namespace Voussoir
{
  /** One flat surface on which the two sides of a pair can touch. */
  struct ContactSurface
  {
    Matrix3 axes;           ///< rows: normal from side 1 to side 2, two tangents; in the frame of the pair
    double  clearance = 0.; ///< opening of the surface when the joint is closed [m]
    double  friction = 0.;  ///< [-]
    int     key = 0;        ///< of a flank: its key; one of the two flanks of a key carries force at a time

    /** How far the sides are apart here at a gap of the pair [m]. */
    double distance(const Vector3 &gap) const { return (axes * gap)[0] + clearance; }
  };

  /** Alart and Curnier's equations of all surfaces of one pair, in the forces r, each in the axes of its
   *  surface; gap = H sum of forces + b. */
  struct SurfaceEquations
  {
    SurfaceEquations(std::vector<ContactSurface> surfaces, const Matrix3 &H, const Vector3 &b,
                     const Vector3 &start);

    Vector3 force(const std::vector<Vector3> &r) const; ///< the sum, in the frame of the pair [N]
    Vector3 gap(const std::vector<Vector3> &r) const;   ///< [m]

    /** The norm of the equations [N]. */
    double evaluate(const std::vector<Vector3> &r);

    /** Solves J x = right-hand sides (@p columns of them, in @p x) with the equations as last evaluated.
     *  Where the surfaces hold more than three displacements J is singular, so each gets a very small
     *  compliance. False: it is singular all the same. */
    bool solve(std::vector<double> &x, int columns) const;

    /** d (sum of forces)/d b at the equations as last evaluated. */
    Matrix3 derivative() const;

    std::vector<ContactSurface> surfaces;
    Matrix3                     H;
    Vector3                     b, start;
    double                      rho;       ///< [N/m]
    std::vector<PairEquations>  equations; ///< per surface
  };

  /** Forces of those surfaces of a pair that may carry together. */
  struct SurfaceSolution
  {
    std::vector<std::size_t> which;  ///< numbers of these surfaces
    SurfaceEquations         system; ///< of these
    std::vector<Vector3>     r;      ///< their forces
  };

  /** Solves gap = H sum_k Q_k^T r_k + b with Coulomb's law between r_k and Q_k gap on each surface.
   *  Gauss-Seidel over the surfaces, finished by Newton's method. The forces r_k are not unique where the
   *  surfaces are more than the pair's three displacements; their sum is.
   *
   *  One flank of each key carries at a time: the limit of a clearance that vanishes. Without this rule the
   *  flanks of a tight key could press against each other, and against friction, by any amount.
   *  @p last_first: the order of the sweeps, which decides where there are several solutions. */
  SurfaceSolution find_surface_forces(const std::vector<ContactSurface> &surfaces, const Matrix3 &H,
                                      const Vector3 &b, const Vector3 &start, bool last_first = false);

  /** The same: the sum of the forces, in the frame of the pair. */
  Vector3 solve_surfaces(const std::vector<ContactSurface> &surfaces, const Matrix3 &H, const Vector3 &b,
                         const Vector3 &start);
} // namespace Voussoir

#endif
