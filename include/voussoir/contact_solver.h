#ifndef voussoir_contact_solver_h
#define voussoir_contact_solver_h

#include <voussoir/joint_jacobian.h>

namespace dealii
{
  class ParameterHandler;
}

namespace Voussoir
{
  struct ContactParameters
  {
    double       tolerance = 1e-10;   ///< relative residual that is accepted
    unsigned int max_iterations = 60; ///< Newton steps
    unsigned int sweeps = 2;          ///< Gauss-Seidel sweeps before the first Newton step

    void add_parameters(dealii::ParameterHandler &prm);
  };

  struct ContactResult
  {
    bool         converged = false;
    double       residual = 0.;      ///< |equations| / max(|force|, |rho b|), 2-norms
    unsigned int iterations = 0;     ///< Newton steps
    unsigned int krylov = 0;         ///< iterations of the linear solver
    unsigned int factorisations = 0; ///< of joints
    unsigned int sweeps = 0;         ///< Gauss-Seidel sweeps
  };

  /** Finds the forces at the pairs of all joints: gap = W force + b, with a joint law at each pair.
   *
   *  Semismooth Newton with a nonmonotone line search (Grippo, Lampariello and Lucidi 1986), its linear
   * systems solved by JointJacobian to the accuracy that Newton can use (Eisenstat and Walker 1996). A few
   * Gauss-Seidel sweeps with the exact solution of each pair settle the states before the first Newton step;
   * more follow when Newton stalls. */
  class ContactSolver
  {
  public:
    /** @p laws: one per pair; they and @p W must outlive the solver. */
    ContactSolver(const InterfaceOperator &W, std::vector<const JointLaw *> laws,
                  const ContactParameters &parameters);

    /** @p force: the initial guess, then the solution; @p gap: receives W force + b. All have three entries
     * per pair. */
    ContactResult solve(const Unknowns &b, Unknowns &force, Unknowns &gap);

    const std::vector<PairState> &states() const { return state; } ///< of the last solution

  private:
    void   evaluate(const Unknowns &force, const Unknowns &gap);
    double merit() const;
    double relative_residual(const Unknowns &b, const Unknowns &force) const;
    void   sweep(Unknowns &force, Unknowns &gap) const;

    const InterfaceOperator            &W;
    const std::vector<const JointLaw *> law;
    const ContactParameters             parameters;
    JointJacobian                       jacobian;
    std::vector<double>                 rho;
    std::vector<Matrix3>                pair_W; ///< diagonal blocks of W
    std::vector<PairEquations>          equations;
    std::vector<PairState>              state;
  };
} // namespace Voussoir

#endif
