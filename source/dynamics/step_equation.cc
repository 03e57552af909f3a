// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/parallel.h>
#include <voussoir/dynamics/step_equation.h>

namespace Voussoir
{
  StepOperator trapezoidal_rule(const Structure &structure, const double dt, const double share)
  {
    StepOperator A{4. / (dt * dt) + 2. / dt * structure.damping.mass, 1., share, 1.};
    (structure.has_zones() ? A.damped : A.stiffness) += structure.damping.more_stiffness(dt);
    return A;
  }

  Unknowns StepEquation::known_forces(const DynamicState &now, const StepLoad &step, const double c_m,
                                      const double c_k) const
  {
    Unknowns     rhs(step.load.size());
    const double dt = step.dt;
#pragma omp parallel for schedule(static)
    for (int i = 0; i < static_cast<int>(structure.n_nodes()); ++i)
    {
      Vector3 x;
      for (unsigned int c = 0; c < 3; ++c)
        x[c] = c_m * now.u[3 * i + c] + 4. / dt * now.v[3 * i + c] +
               structure.damping.mass * (now.base_velocity[c] + step.base_velocity[c]);
      const Vector3 Mx = structure.mass[i] * x;
      for (unsigned int c = 0; c < 3; ++c)
      {
        const std::size_t k = 3 * i + c;
        rhs[k] = step.load[k] + now.load[k] + Mx[c] + c_k * now.Ku[k];
      }
    }
    structure.damping.add_known_forces(dt, now.relaxation, now.Ku, rhs);
    if (share == 1.)
      add_joint_forces(now.force, rhs);
    return rhs;
  }

  void StepEquation::add_joint_forces(const Unknowns &force, Unknowns &nodal_force) const
  {
    for (std::size_t p = 0; p < structure.pairs.size(); ++p)
    {
      Vector3 f = get(force, p);
      for (double &x : f)
        x *= share;
      structure.add_pair_force(structure.pairs[p], f, nodal_force);
    }
  }

  namespace
  {
    /** Unknown: displacement at the end of the step. */
    class TotalEquation : public StepEquation
    {
    public:
      using StepEquation::StepEquation;

      void start(DynamicState &) const override {}

      ContactResult solve(JointSystem &system, const DynamicState &now, const StepLoad &step,
                          const Joints &joints) override
      {
        const double dt = step.dt;
        const double more = structure.damping.more_stiffness(dt);
        const auto  &damped = now.relaxation.Ku; // empty without zones
        Unknowns     rhs = known_forces(now, step, 4. / (dt * dt) + 2. / dt * structure.damping.mass,
                                        (damped.empty() ? more : 0.) - 1.);
        for (std::size_t k = 0; k < damped.size(); ++k)
          rhs[k] += more * damped[k];
        structure.add_reaction(1., now.u, rhs);
        return system.solve(rhs, joints.offset, joints.start, joints.memory, joints.force, joints.gap,
                            joints.u_new, &joints.base);
      }

      void carry(DynamicState &, double, const Unknowns &, const Unknowns &) const override {}
    };

    /** Unknown: increment to now.u, or to now.u plus the last increment. A now.u is subtracted from the
     * right-hand side, and the residual of the last step is added. */
    class IncrementEquation : public StepEquation
    {
    public:
      using StepEquation::StepEquation;

      void start(DynamicState &now) const override
      {
        now.carried.residual.assign(now.u.size(), 0.);
        now.carried.moved = now.carried.resisted = now.carried.residual;
      }

      ContactResult solve(JointSystem &system, const DynamicState &now, const StepLoad &step,
                          const Joints &joints) override
      {
        rhs = known_forces(now, step, 0., -2.);
        for (std::size_t k = 0; k < rhs.size(); ++k)
          rhs[k] += 2. / step.dt * now.carried.residual[k];
        Unknowns expected = rhs;
        add_joint_forces(joints.force, expected); // joint forces of the last step
        const bool goes_on = continues(now.carried, step.dt, expected);
        Unknowns   reduced = rhs, offset = joints.offset;
        for (std::size_t p = 0; p < structure.pairs.size(); ++p)
        {
          Vector3 jump = structure.jump(structure.pairs[p], now.u);
          add(jump, get(offset, p));
          set(offset, p, jump);
        }
        if (goes_on)
        {
          for (std::size_t k = 0; k < reduced.size(); ++k)
            reduced[k] -= now.carried.resisted[k];
          for (std::size_t p = 0; p < structure.pairs.size(); ++p)
          {
            Vector3 jump = structure.jump(structure.pairs[p], now.carried.moved);
            add(jump, get(offset, p));
            set(offset, p, jump);
          }
        }
        Unknowns           &u_new = joints.u_new;
        const ContactResult result =
            system.solve(reduced, offset, joints.start, joints.memory, joints.force, joints.gap, u_new);
        for (std::size_t k = 0; k < u_new.size(); ++k)
          u_new[k] += goes_on ? now.u[k] + now.carried.moved[k] : now.u[k];
        add_joint_forces(joints.force, rhs);
        return result;
      }

      void carry(DynamicState &now, const double dt, const Unknowns &u_new,
                 const Unknowns &Ku_new) const override
      {
        const StepOperator A = trapezoidal_rule(structure, dt, share);
        Carried           &carried = now.carried;
        carried.dt = dt;
#pragma omp parallel for schedule(static)
        for (int i = 0; i < static_cast<int>(structure.n_nodes()); ++i)
        {
          const Vector3 du = get(u_new, i) - get(now.u, i), Md = structure.mass[i] * du;
          set(carried.moved, i, du);
          for (unsigned int c = 0; c < 3; ++c)
          {
            const std::size_t k = 3 * i + c;
            carried.resisted[k] = A.stiffness * (Ku_new[k] - now.Ku[k]);
            carried.resisted[k] += A.mass * Md[c];
          }
        }
        structure.add_reaction(A.reaction, carried.moved, carried.resisted);
        const Unknowns damped = structure.damped_force(carried.moved);
        for (std::size_t k = 0; k < damped.size(); ++k)
          carried.resisted[k] += A.damped * damped[k];
        for (std::size_t k = 0; k < rhs.size(); ++k)
          carried.residual[k] = .5 * dt * (rhs[k] - carried.resisted[k]);
      }

    private:
      /** Returns true if the right-hand side @p forces is closer to that of the last increment than to zero. */
      static bool continues(const Carried &carried, const double dt, const Unknowns &forces)
      {
        if (carried.dt != dt)
          return false;
        const auto squares =
            sum_of_ranges<std::array<double, 2>>(forces.size(),
                                                 [&](const std::size_t begin, const std::size_t end)
                                                 {
                                                   double change = 0., whole = 0.;
                                                   for (std::size_t k = begin; k < end; ++k)
                                                   {
                                                     const double more = forces[k] - carried.resisted[k];
                                                     change += more * more;
                                                     whole += forces[k] * forces[k];
                                                   }
                                                   return std::array<double, 2>{{change, whole}};
                                                 });
        return squares[0] < squares[1];
      }

      Unknowns rhs; ///< right-hand side of the last solve(), with the joint forces of its solution [N]
    };
  } // namespace

  std::unique_ptr<StepEquation> step_equation(const Structure &structure, const double share,
                                              const bool single_factors)
  {
    if (single_factors)
      return std::make_unique<IncrementEquation>(structure, share);
    return std::make_unique<TotalEquation>(structure, share);
  }
} // namespace Voussoir
