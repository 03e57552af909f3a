// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/error.h>
#include <voussoir/base/number_text.h>
#include <voussoir/contact/cohesive_law.h>
#include <voussoir/contact/fja_law.h>
#include <voussoir/contact/pair_conditions.h>
#include <voussoir/contact/tied_law.h>

#include <algorithm>
#include <cmath>

namespace Voussoir
{
  namespace
  {
    /** Linear softening of a cracked bond: tensile force by opening. */
    class Softening
    {
    public:
      /** @param peak strength [N]
       * @param end opening at which the bond is lost [m]
       * @param largest largest opening so far [m] */
      Softening(const double peak, const double end, const double largest)
          : peak(peak), end(end), largest(largest)
      {
      }

      /** Returns the tensile force [N]. If the pair is closed, it is the force at the start of opening. */
      double tension(const double opening) const
      {
        const double w = std::max(opening, 0.);
        return w >= end || largest >= end ? 0. : w >= largest ? peak * (1. - w / end) : stiffness() * w;
      }

      /** Returns the derivative of tension() [N/m]; 0 where the force is constant. */
      double slope(const double opening) const
      {
        return opening < 0. || opening >= end || largest >= end ? 0.
               : opening >= largest                             ? -peak / end
                                                                : stiffness();
      }

      /** Returns the exact integral of the tensile force [J]. */
      double work(const double from, const double to) const
      {
        double       sum = 0., last = std::min(from, to);
        const double high = std::max(from, to);
        for (const double kink : {0., largest, end, high})
          if (const double next = std::min(kink, high); next > last)
          {
            sum += (next - last) * tension(.5 * (last + next));
            last = next;
          }
        return from < to ? sum : -sum;
      }

      /** Returns the dissipated energy [J]. */
      double lost() const { return .5 * peak * std::min(largest, end); }

    private:
      double stiffness() const { return peak * (1. - largest / end) / largest; }

      const double peak, end, largest;
    };

    class Cohesive : public JointLaw
    {
    public:
      explicit Cohesive(const LawParameters &parameters)
          : strength(parameters.strength),
            end(strength > 0. ? 2. * parameters.fracture_energy / strength : 0.),
            face(make_fja_law(parameters.friction)), tie(make_tied_law(parameters))
      {
      }

      unsigned int n_memory() const override { return 2; }
      bool         needs_mean_force() const override { return true; }

      void evaluate(const Vector3 &force, const Vector3 &gap, const PairHistory &history, const double rho,
                    PairEquations &e) const override
      {
        if (is_bonded(history.memory))
        {
          tie->evaluate(force, gap, history, rho, e);
          e.active = face_bit | bond_bit;
          return;
        }
        double        slope;
        const Vector3 contact = without_tension(force, gap[0], history, slope);
        face->evaluate(contact, gap, history, rho, e);
        for (unsigned int i = 0; i < 3; ++i)
          e.d_gap[3 * i] += e.d_force[3 * i] * slope;
        if (e.active && strength > 0. && history.memory[condition] == cracked &&
            history.memory[largest] == 0.)
          e.active |= bond_bit; // no opening yet: an impact must not return the tension of this step
      }

      Vector3 error(const Vector3 &force, const Vector3 &gap, const PairHistory &history,
                    const double rho) const override
      {
        if (is_bonded(history.memory))
          return tie->error(force, gap, history, rho);
        double slope;
        return face->error(without_tension(force, gap[0], history, slope), gap, history, rho);
      }

      Vector3 solve(const Matrix3 &H, const Vector3 &b, const PairHistory &history) const override
      {
        if (is_bonded(history.memory))
          return tie->solve(H, b, history);
        double     slope;
        const auto tension = [&](const double opening)
        { return without_tension({}, opening, history, slope)[0]; };
        const double at_contact = tension(0.); // mean tension of a step that ends closed
        if (b[0] < H[0] * at_contact)
        {
          Vector3 force = face->solve(
              H, {{b[0] - H[0] * at_contact, b[1] - H[3] * at_contact, b[2] - H[6] * at_contact}}, history);
          force[0] -= at_contact;
          return force;
        }
        double low = 0., high = b[0]; // bounds of the opening b - H tension
        for (unsigned int i = 0; i < 100 && high - low > 1e-15 * high; ++i)
        {
          const double middle = .5 * (low + high);
          (middle + H[0] * tension(middle) < b[0] ? low : high) = middle;
        }
        return {{-tension(high), 0., 0.}};
      }

      Vector3 solve_impulse(const Matrix3 &H, const Vector3 &v, const PairHistory &history,
                            const unsigned char active) const override
      {
        return (active & bond_bit ? tie : face)->solve_impulse(H, v, history, active);
      }

      Vector3 stop_normal(const Matrix3 &H, const Vector3 &v, const Vector3 &applied,
                          const unsigned char active) const override
      {
        if (!(active & bond_bit))
          return face->stop_normal(H, v, applied, active);
        Vector3 held = applied;
        add(held, tie->solve_impulse(H, v, {}, active));
        return held;
      }

      double utilisation(const Vector3 &force, const Vector3 &, const PairHistory &history) const override
      {
        return is_bonded(history.memory) ? -force[0] / (strength * history.area) : 0.;
      }

      void apply_event(double *memory, const JointEvent event) const override
      {
        memory[condition] = end > 0. && event == JointEvent::limit ? cracked : lost;
      }

      void commit(const Vector3 &force, const Vector3 &gap, const PairHistory &history,
                  double *memory) const override
      {
        if (memory[condition] != cracked)
          return;
        if (memory[largest] == 0. && gap[0] <= nothing * end)
        {
          if (length(gap[1] - history.start[1], gap[2] - history.start[2]) > nothing * end)
            memory[condition] = lost; // it slipped
          else if (-force[0] < (1. - nothing) * strength * history.area)
            memory[condition] = bonded; // unloaded by other cracks before it moved
          return;
        }
        memory[largest] = std::max(memory[largest], gap[0]);
        if (memory[largest] >= end)
          memory[condition] = lost;
      }

      /** Returns the friction of the face if the strength is 0: the law is then FJA, also on edges. */
      double flat_friction() const override { return strength == 0. ? face->flat_friction() : -1.; }

      double bond_energy(const Vector3 &gap, const double area, const double *memory) const override
      {
        if (is_bonded(memory))
          return 0.;
        const Softening law(strength * area, end, memory[largest]);
        return law.lost() + (memory[condition] == lost ? 0. : law.work(0., std::max(gap[0], 0.)));
      }

    private:
      enum Memory
      {
        condition,
        largest
      };
      static constexpr double        bonded = 0., cracked = 1., lost = 2.; ///< values of the condition
      static constexpr double        nothing = 1e-8; ///< times end; smaller openings and slips are round-off
      static constexpr unsigned char face_bit = 1, bond_bit = 2; ///< of PairEquations::active

      bool is_bonded(const double *memory) const { return strength > 0. && memory[condition] == bonded; }

      /** Returns the contact force: @p force without the tension of a step that ends at @p opening. @p slope
       * receives the derivative of that tension [N/m]. */
      Vector3 without_tension(Vector3 force, const double opening, const PairHistory &history,
                              double &slope) const
      {
        slope = 0.;
        if (strength == 0. || history.memory[condition] == lost)
          return force;
        const Softening law(strength * history.area, end, history.memory[largest]);
        const double    before = std::max(history.start[0], 0.), moved = opening - before;
        if (!history.is_mean)
        {
          force[0] += law.tension(opening);
          slope = law.slope(opening);
        }
        else if (std::abs(moved) <= 1e-12 * end)
        {
          force[0] += law.tension(.5 * (before + opening));
          slope = .5 * law.slope(.5 * (before + opening));
        }
        else
        {
          const double mean = law.work(before, opening) / moved;
          force[0] += mean;
          slope = (law.tension(opening) - mean) / moved;
        }
        return force;
      }

      const double                    strength, end; ///< [Pa], opening at which the bond is lost [m]
      const std::unique_ptr<JointLaw> face, tie;
    };
  } // namespace

  std::unique_ptr<JointLaw> make_cohesive_law(const LawParameters &parameters)
  {
    if (parameters.equations != Equations::alart_curnier)
      throw InputError("The joint model cohesive supports alart-curnier only. Set \"Joints/Equations\" to "
                       "alart-curnier.");
    if (!(parameters.strength >= 0.))
      throw InputError("Entry \"Joints/Strength\" must be at least 0 Pa, but it is " +
                       number_text(parameters.strength) + " Pa.");
    if (!(parameters.fracture_energy >= 0. && std::isfinite(parameters.fracture_energy)))
      throw InputError("Entry \"Joints/Fracture energy\" must be finite and at least 0 N/m, but it is " +
                       number_text(parameters.fracture_energy) + " N/m.");
    return std::make_unique<Cohesive>(parameters);
  }

  std::string cohesive_law_warning(const LawParameters &parameters)
  {
    return parameters.strength != 0.
               ? ""
               : "Joints/Strength is 0, so the joint model cohesive is equal to FJA. Set the tensile "
                 "strength of the bond, such as 1 MPa, or set Joints/Model to FJA.";
  }
} // namespace Voussoir
