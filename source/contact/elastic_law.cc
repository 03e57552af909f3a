// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/error.h>
#include <voussoir/base/number_text.h>
#include <voussoir/contact/elastic_law.h>
#include <voussoir/contact/tied_law.h>

#include <algorithm>
#include <cmath>
#include <tuple>

namespace Voussoir
{
  namespace
  {
    constexpr unsigned char adhesion_bit = 4; // of PairEquations::active

    double inverse_of(const double stiffness)
    {
      return stiffness > 0. ? 1. / stiffness : 0.;
    }
  } // namespace

  /** Force, gap and history of the law of the face. */
  struct ElasticLaw::OfFace
  {
    OfFace(const ElasticLaw &law, const Vector3 &given_force, const Vector3 &given_gap,
           const PairHistory &given)
        : force(given_force), gap(given_gap), history(given)
    {
      const Vector3 D = law.compliance(given.area);
      if (law.is_bonded(given))
        force[0] += law.tension * given.area;
      for (unsigned int i = 0; i < 3; ++i)
      {
        gap[i] += D[i] * given_force[i];
        history.start[i] += D[i] * given.area * given.memory[stress + i];
      }
      history.memory += n_own;
    }
    Vector3     force, gap;
    PairHistory history;
  };

  ElasticLaw::ElasticLaw(std::unique_ptr<JointLaw> given, const LawParameters &p)
      : face(std::move(given)), tie(make_tied_law(p)), flexibility{{inverse_of(p.normal_stiffness),
                                                                    inverse_of(p.tangential_stiffness),
                                                                    inverse_of(p.tangential_stiffness)}},
        tension(p.adhesion > 0. ? p.adhesion / p.friction : 0.)
  {
  }

  Vector3 ElasticLaw::compliance(const double area) const
  {
    return {{flexibility[0] / area, flexibility[1] / area, flexibility[2] / area}};
  }

  /** Returns the scaling factor of the pair with its compliance [N/m]. */
  double ElasticLaw::softened(const double rho, const PairHistory &history) const
  {
    return 1. / (1. / rho + std::max(flexibility[0], flexibility[1]) / history.area);
  }

  void ElasticLaw::evaluate(const Vector3 &force, const Vector3 &gap, const PairHistory &history,
                            const double rho, PairEquations &e) const
  {
    const OfFace  of_face(*this, force, gap, history);
    const Vector3 D = compliance(history.area);
    face->evaluate(of_face.force, of_face.gap, of_face.history, softened(rho, history), e);
    for (unsigned int i = 0; i < 3; ++i)
      for (unsigned int j = 0; j < 3; ++j)
        e.d_force[3 * i + j] += e.d_gap[3 * i + j] * D[j];
    if (is_bonded(history) && e.state == PairState::stick)
      e.active |= adhesion_bit;
  }

  Vector3 ElasticLaw::error(const Vector3 &force, const Vector3 &gap, const PairHistory &history,
                            const double rho) const
  {
    const OfFace of_face(*this, force, gap, history);
    return face->error(of_face.force, of_face.gap, of_face.history, softened(rho, history));
  }

  Vector3 ElasticLaw::solve(const Matrix3 &H, const Vector3 &b, const PairHistory &history) const
  {
    const OfFace  of_face(*this, {}, b, history);
    const Vector3 D = compliance(history.area);
    Matrix3       soft = H;
    for (unsigned int i = 0; i < 3; ++i)
      soft[4 * i] += D[i];
    const double held = of_face.force[0]; // the shift of the friction cone
    Vector3 force = face->solve(soft, {{b[0] - soft[0] * held, b[1] - soft[3] * held, b[2] - soft[6] * held}},
                                of_face.history);
    force[0] -= held;
    return force;
  }

  Vector3 ElasticLaw::solve_impulse(const Matrix3 &H, const Vector3 &v, const PairHistory &history,
                                    const unsigned char active) const
  {
    return active & adhesion_bit ? tie->solve_impulse(H, v, history, active)
                                 : face->solve_impulse(H, v, OfFace(*this, {}, {}, history).history, active);
  }

  Vector3 ElasticLaw::stop_normal(const Matrix3 &H, const Vector3 &v, const Vector3 &applied,
                                  const unsigned char active) const
  {
    if (!(active & adhesion_bit))
      return face->stop_normal(H, v, applied, active);
    Vector3 held = applied;
    add(held, tie->solve_impulse(H, v, {}, active));
    return held;
  }

  /** Returns 2 if a bonded pair opens. */
  double ElasticLaw::utilisation(const Vector3 &force, const Vector3 &gap, const PairHistory &history) const
  {
    const OfFace of_face(*this, force, gap, history);
    if (is_bonded(history))
      return of_face.gap[0] > 0. && of_face.force[0] < 1e-9 * tension * history.area ? 2. : 0.;
    return face->utilisation(of_face.force, of_face.gap, of_face.history);
  }

  void ElasticLaw::apply_event(double *memory, const JointEvent event) const
  {
    if (tension > 0.)
      memory[lost] = 1.;
    else
      face->apply_event(memory + n_own, event);
  }

  void ElasticLaw::commit(const Vector3 &force, const Vector3 &gap, const PairHistory &history,
                          double *memory) const
  {
    const OfFace of_face(*this, force, gap, history);
    face->commit(of_face.force, of_face.gap, of_face.history, memory + n_own);
    for (unsigned int i = 0; i < 3; ++i)
      memory[stress + i] = force[i] / history.area;
  }

  double ElasticLaw::bond_energy(const Vector3 &gap, const double area, const double *memory) const
  {
    Vector3 of_face = gap;
    for (unsigned int i = 0; i < 3; ++i)
      of_face[i] += flexibility[i] * memory[stress + i];
    return face->bond_energy(of_face, area, memory + n_own);
  }

  double ElasticLaw::stored_energy(const double area, const double *memory) const
  {
    double energy = 0.;
    for (unsigned int i = 0; i < 3; ++i)
      energy += .5 * flexibility[i] * area * memory[stress + i] * memory[stress + i];
    return energy;
  }

  /** Returns the elastic energy that a step adds along n, a or b [J]. @p row: 0, 1 or 2. */
  double ElasticLaw::change_of_row(const unsigned int row, const Vector3 &force,
                                   const PairHistory &history) const
  {
    const double before = history.memory[stress + row] * history.area;
    return .5 * compliance(history.area)[row] * (force[row] * force[row] - before * before);
  }

  double ElasticLaw::stored_change(const Vector3 &force, const PairHistory &history) const
  {
    return change_of_row(0, force, history) - friction_correction(force, history);
  }

  double ElasticLaw::friction_correction(const Vector3 &force, const PairHistory &history) const
  {
    return -change_of_row(1, force, history) - change_of_row(2, force, history);
  }

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
    if (p.adhesion > 0. && !(p.friction > 0.))
      throw InputError(
          "Entry \"Joints/Adhesion\" requires friction, because the tension is limited to adhesion "
          "over friction. Set \"Joints/Friction\" above 0.");
    return std::make_unique<ElasticLaw>(std::move(face), p);
  }
} // namespace Voussoir
