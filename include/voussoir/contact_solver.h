#ifndef voussoir_contact_solver_h
#define voussoir_contact_solver_h

#include <voussoir/joint_law.h>

#include <map>
#include <vector>

namespace dealii
{
  class ParameterHandler;
}

namespace Voussoir
{
  /** The symmetric operator W of the joints, gap = W force + b, in dense blocks by group of pairs (a joint).
   *  Two groups are coupled where one body touches both, so along an arch W is block tridiagonal. */
  class InterfaceOperator
  {
  public:
    /** @p n_pairs: pairs in each group. */
    explicit InterfaceOperator(const std::vector<unsigned int> &n_pairs);

    /** The block of rows of group @p j and columns of group @p k >= j, column by column; made on first use.
     */
    std::vector<double>       &block(unsigned int j, unsigned int k);
    const std::vector<double> &block(unsigned int j, unsigned int k) const { return blocks.at({j, k}); }

    /** y = W x. */
    void multiply(const Unknowns &x, Unknowns &y) const;

    /** y_j += factor * W_jk x_k for one pair of groups. */
    void add_coupling(unsigned int j, unsigned int k, double factor, const double *x, double *y) const;

    Matrix3 diagonal(unsigned int pair) const;

    unsigned int n_groups() const { return static_cast<unsigned int>(offset.size() - 1); }
    unsigned int n() const { return offset.back(); } ///< unknowns: three per pair
    unsigned int begin(const unsigned int group) const { return offset[group]; }
    unsigned int size(const unsigned int group) const { return offset[group + 1] - offset[group]; }
    const std::vector<unsigned int> &neighbours(const unsigned int group) const { return coupled[group]; }
    double                           memory() const; ///< [bytes]

  private:
    std::vector<unsigned int>                                            offset;
    std::vector<std::vector<unsigned int>>                               coupled;
    std::map<std::pair<unsigned int, unsigned int>, std::vector<double>> blocks;
  };

  struct ContactParameters
  {
    double       tolerance = 1e-10;   ///< relative residual that is accepted
    unsigned int max_iterations = 60; ///< Newton steps
    unsigned int sweeps = 0;          ///< Gauss-Seidel sweeps before the first Newton step

    void add_parameters(dealii::ParameterHandler &prm);
    void check() const;
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
   *  Semismooth Newton with a nonmonotone line search (Grippo, Lampariello and Lucidi 1986). The linear
   * systems are solved by GMRES, preconditioned joint by joint: dense LU factors of the joints, in
   * Gauss-Seidel order by colour (neighbouring joints have different colours); only joints in which something
   * changed are factorised again. When Newton stalls, Gauss-Seidel sweeps with the exact solution of each
   * pair, then Newton again. */
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
    struct GroupFactor
    {
      std::vector<unsigned int> active; ///< rows of the group that are not trivial
      std::vector<double>       lu;
      std::vector<int>          pivots;
    };

    void         evaluate(const Unknowns &force, const Unknowns &gap);
    double       merit() const;
    double       relative_residual(const Unknowns &b, const Unknowns &force) const;
    unsigned int factorise();
    void         apply(unsigned int group, double *x) const;
    unsigned int solve_linear(double tolerance, Unknowns &step);
    void         couple(const Unknowns &z, Unknowns &v, unsigned int j, bool to_later) const;
    void         sweep(Unknowns &force, Unknowns &gap) const;

    const InterfaceOperator               &W;
    const std::vector<const JointLaw *>    law;
    const ContactParameters                parameters;
    std::vector<double>                    rho;
    std::vector<PairEquations>             equations, factorised;
    std::vector<PairState>                 state;
    std::vector<GroupFactor>               factors;
    std::vector<std::vector<unsigned int>> colours; ///< groups of each colour
    std::vector<unsigned int>              colour_of;
  };
} // namespace Voussoir

#endif
