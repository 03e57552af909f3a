// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_contact_result_h
#define voussoir_contact_result_h

namespace Voussoir
{
  /** What a solution took, in the order in which the solver tries. */
  enum class ContactPath : unsigned char
  {
    newton,      ///< Newton's method alone, or nothing at all
    sweeps,      ///< it stalled; Gauss-Seidel sweeps settled the states
    proximal,    ///< it stalled again: proximal point method
    smaller_step ///< that failed, too: the time step was halved
  };

  const char *name(ContactPath path); ///< as in the enumeration

  struct ContactResult
  {
    bool         converged = false;
    double       residual = 0.; ///< natural map over forces, load or gap, the largest: see ContactSolver
    double       residual_over_load = 0.; ///< the same over the load
    unsigned int iterations = 0;          ///< Newton steps
    unsigned int krylov = 0;              ///< iterations of the linear solver
    unsigned int factorisations = 0;      ///< of joints
    unsigned int sweeps = 0;              ///< Gauss-Seidel sweeps
    ContactPath  path = ContactPath::newton;
    double       force_over_load = 0.; ///< sizes, in forces; where no solution exists it grows without bound

    /** Add the iterations, factorisations and sweeps of another solution. */
    void add_work(const ContactResult &other);

    /** This and another solution together: their work, the worse residual and the longer path; converged if
     *  both are. */
    ContactResult &operator+=(const ContactResult &other);
  };
} // namespace Voussoir

#endif
