// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/error.h>
#include <voussoir/base/number_text.h>
#include <voussoir/contact/elastic_law.h>
#include <voussoir/contact/tied_law.h>

#include <algorithm>
#include <cmath>

namespace Voussoir
{
  namespace
  {
    class Elastic : public JointLaw
    {
    public:
      Elastic(std::unique_ptr<JointLaw> face, const LawParameters &p)
          : face(std::move(face)), tie(make_tied_law(p)),
            flexibility{{p.normal_stiffness > 0. ? 1. / p.normal_stiffness : 0.,
                         p.tangential_stiffness > 0. ? 1. / p.tangential_stiffness : 0.,
                         p.tangential_stiffness > 0. ? 1. / p.tangential_stiffness : 0.}},
            tension(p.adhesion > 0. ? p.adhesion / p.friction : 0.)
      {
      }

      unsigned int n_memory() const override { return n_own + face->n_memory(); }
      bool         needs_mean_force() const override { return true; }
      bool         is_elastic() const override { return flexibility[0] > 0. || flexibility[1] > 0.; }
      Vector3      compliance(const double area) const override
      {
        return {{flexibility[0] / area, flexibility[1] / area, flexibility[2] / area}};
      }
      bool has_bond() const override { return tension > 0. || face->has_bond(); }
      bool is_tangentially_tied() const override { return face->is_tangentially_tied(); }

      void evaluate(const Vector3 &force, const Vector3 &gap, const PairHistory &history, const double rho,
                    PairEquations &e) const override
      {
        const OfFace of_face(*this, force, gap, history);
        face->evaluate(of_face.force, of_face.gap, of_face.history, softened(rho, history), e);
        for (unsigned int i = 0; i < 3; ++i)
          for (unsigned int j = 0; j < 3; ++j)
            e.d_force[3 * i + j] += e.d_gap[3 * i + j] * flexibility[j] / history.area;
        if (is_bonded(history) && e.state == PairState::stick)
          e.active |= adhesion_bit;
      }

      Vector3 error(const Vector3 &force, const Vector3 &gap, const PairHistory &history,
                    const double rho) const override
      {
        const OfFace of_face(*this, force, gap, history);
        return face->error(of_face.force, of_face.gap, of_face.history, softened(rho, history));
      }

      Vector3 solve(const Matrix3 &H, const Vector3 &b, const PairHistory &history) const override
      {
        const OfFace of_face(*this, {}, b, history);
        Matrix3      soft = H;
        for (unsigned int i = 0; i < 3; ++i)
          soft[4 * i] += flexibility[i] / history.area;
        const double held = of_face.force[0]; // the shift of the friction cone
        Vector3      force = face->solve(
                 soft, {{b[0] - soft[0] * held, b[1] - soft[3] * held, b[2] - soft[6] * held}}, of_face.history);
        force[0] -= held;
        return force;
      }

      Vector3 solve_impulse(const Matrix3 &H, const Vector3 &v, const PairHistory &history,
                            const unsigned char active) const override
      {
        return active & adhesion_bit
                   ? tie->solve_impulse(H, v, history, active)
                   : face->solve_impulse(H, v, OfFace(*this, {}, {}, history).history, active);
      }

      Vector3 stop_normal(const Matrix3 &H, const Vector3 &v, const Vector3 &applied,
                          const unsigned char active) const override
      {
        if (!(active & adhesion_bit))
          return face->stop_normal(H, v, applied, active);
        Vector3 held = applied;
        add(held, tie->solve_impulse(H, v, {}, active));
        return held;
      }

      /** Returns 2 if a bonded pair opens. */
      double utilisation(const Vector3 &force, const Vector3 &gap, const PairHistory &history) const override
      {
        const OfFace of_face(*this, force, gap, history);
        if (is_bonded(history))
          return of_face.gap[0] > 0. && of_face.force[0] < 1e-9 * tension * history.area ? 2. : 0.;
        return face->utilisation(of_face.force, of_face.gap, of_face.history);
      }

      void apply_event(double *memory) const override
      {
        if (tension > 0.)
          memory[lost] = 1.;
        else
          face->apply_event(memory + n_own);
      }

      void commit(const Vector3 &force, const Vector3 &gap, const PairHistory &history,
                  double *memory) const override
      {
        const OfFace of_face(*this, force, gap, history);
        face->commit(of_face.force, of_face.gap, of_face.history, memory + n_own);
        for (unsigned int i = 0; i < 3; ++i)
          memory[stress + i] = force[i] / history.area;
      }

      double bond_energy(const Vector3 &gap, const double area, const double *memory) const override
      {
        Vector3 of_face = gap;
        for (unsigned int i = 0; i < 3; ++i)
          of_face[i] += flexibility[i] * memory[stress + i];
        return face->bond_energy(of_face, area, memory + n_own);
      }

      double stored_energy(const Vector3 &, const double area, const double *memory) const override
      {
        double energy = 0.;
        for (unsigned int i = 0; i < 3; ++i)
          energy += .5 * flexibility[i] * area * memory[stress + i] * memory[stress + i];
        return energy;
      }

      double friction_correction(const Vector3     &force, const Vector3 &,
                                 const PairHistory &history) const override
      {
        double stored = 0.;
        for (unsigned int i = 1; i < 3; ++i)
        {
          const double before = history.memory[stress + i] * history.area;
          stored += .5 * flexibility[i] / history.area * (force[i] * force[i] - before * before);
        }
        return -stored;
      }

    private:
      enum Memory
      {
        lost,
        stress,
        n_own = stress + 3
      };
      static constexpr unsigned char adhesion_bit = 4; ///< of PairEquations::active

      /** Force, gap and history of the law of the face. */
      struct OfFace
      {
        OfFace(const Elastic &law, const Vector3 &force, const Vector3 &gap, const PairHistory &given)
            : force(force), gap(gap), history(given)
        {
          if (law.is_bonded(given))
            this->force[0] += law.tension * given.area;
          for (unsigned int i = 0; i < 3; ++i)
          {
            this->gap[i] += law.flexibility[i] * force[i] / given.area;
            history.start[i] += law.flexibility[i] * given.memory[stress + i];
          }
          history.memory += n_own;
        }
        Vector3     force, gap;
        PairHistory history;
      };

      bool is_bonded(const PairHistory &history) const { return tension > 0. && history.memory[lost] == 0.; }

      /** Returns the scaling factor of the pair with its compliance [N/m]. */
      double softened(const double rho, const PairHistory &history) const
      {
        return 1. / (1. / rho + std::max(flexibility[0], flexibility[1]) / history.area);
      }

      const std::unique_ptr<JointLaw> face, tie;
      const Vector3                   flexibility; ///< of unit area, along n, a, b [m/Pa]
      const double                    tension;     ///< limit while bonded [Pa]
    };
  } // namespace

  std::unique_ptr<JointLaw> make_elastic_law(std::unique_ptr<JointLaw> face, const LawParameters &p)
  {
    for (const auto &[name, value, unit] :
         {std::make_tuple("Normal stiffness", p.normal_stiffness, " Pa/m"),
          std::make_tuple("Tangential stiffness", p.tangential_stiffness, " Pa/m"),
          std::make_tuple("Adhesion", p.adhesion, " Pa")})
      if (!(value >= 0. && std::isfinite(value)))
        throw InputError("Entry \"Joints/" + std::string(name) +
                         "\" must be finite and at least 0, but it is " + number_text(value) + unit +
                         ". 0 means " + (p.adhesion == value ? "none." : "a rigid joint."));
    if (p.normal_stiffness == 0. && p.tangential_stiffness == 0. && p.adhesion == 0.)
      return face;
    if (p.equations != Equations::alart_curnier)
      throw InputError("Joints with a stiffness or an adhesion support alart-curnier only. Set "
                       "\"Joints/Equations\" to alart-curnier.");
    if (p.adhesion > 0. && face->has_bond())
      throw InputError(
          "The joint model cohesive has its own bond. Set \"Joints/Adhesion\" to 0, or the joint model "
          "to FJA.");
    if (p.adhesion > 0. && !(p.friction > 0.))
      throw InputError(
          "Entry \"Joints/Adhesion\" requires friction, because the tension is limited to adhesion "
          "over friction. Set \"Joints/Friction\" above 0.");
    return std::make_unique<Elastic>(std::move(face), p);
  }
} // namespace Voussoir
