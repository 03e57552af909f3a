// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_contact_result_h
#define voussoir_contact_result_h

namespace Voussoir
{
  /** Stage of the contact solver that found the solution, in the order of use. */
  enum class ContactPath : unsigned char
  {
    newton,      ///< Newton's method alone, or the initial guess is a solution
    sweeps,      ///< Newton stalled; more Gauss-Seidel iterations, then Newton
    proximal,    ///< Newton stalled again: proximal point method
    smaller_step ///< the proximal point method failed, too: reduced time step
  };

  const char *name(ContactPath path); ///< returns the name of the enumerator

  /** Residual and effort of the solution of a contact problem. */
  struct ContactResult
  {
    bool         converged = false;
    double       residual = 0.;           ///< relative residual, see ContactSolver [-]
    double       residual_over_load = 0.; ///< error relative to the load |b|/w only [-]
    unsigned int iterations = 0;          ///< number of Newton steps
    unsigned int krylov = 0;              ///< number of iterations of the linear solver
    unsigned int factorisations = 0;      ///< number of factorisations of joints
    unsigned int sweeps = 0;              ///< number of Gauss-Seidel iterations
    ContactPath  path = ContactPath::newton;
    double force_over_load = 0.; ///< |force|/(|b|/w) [-]; a problem without a solution has very large values
    unsigned int worst_pair = static_cast<unsigned int>(-1); ///< pair with the largest error; -1: none

    /** Adds the numbers of iterations and factorisations of another solution. */
    void add_work(const ContactResult &other);

    /** Combines two solutions: sums of the numbers, the larger residual (or that of @p other if it failed) and
     * the later stage, and the worst pair of @p other. The result is converged if both solutions are. */
    ContactResult &operator+=(const ContactResult &other);
  };
} // namespace Voussoir

#endif
