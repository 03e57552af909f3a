// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/error.h>
#include <voussoir/base/names.h>
#include <voussoir/base/tensor3.h>
#include <voussoir/contact/elastic_law.h>
#include <voussoir/contact/fja_law.h>
#include <voussoir/dam/joint_water.h>
#include <voussoir/dam/static_path.h>
#include <voussoir/dam/static_state.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <sstream>

namespace Voussoir
{
  namespace
  {
    constexpr double path_tolerance =
        5e-3; // change of the displacements by halved increments, of the largest one
    constexpr unsigned int most_increments = 64; // of a stage
    constexpr unsigned int most_failures = 4;    // halvings in a row without convergence

    constexpr double stiffest =
        4e10; // Young's modulus of concrete [Pa]; larger ones are those of rigid blocks

    /** Returns true if dam and rock are solved in turn, with base joints between them. */
    bool alternates_with_rock(const Dam &dam)
    {
      return dam.has_base_joints() && dam.scene.foundation.model == "rock";
    }

    /** Returns the parameters of the contact solver in the static state. The forces of base joints determine the
     * displacements of rock with mass, and their errors those of the iterations between dam and rock. */
    ContactParameters in_statics(const Dam &dam, ContactParameters parameters)
    {
      if (alternates_with_rock(dam))
        parameters.tolerance *= .01;
      return parameters;
    }

    double norm_1(const Unknowns &x)
    {
      double sum = 0.;
      for (const double value : x)
        sum += std::abs(value);
      return sum;
    }

    /** Returns the largest length of a nodal vector of u - v. An empty v is zero. */
    double largest_difference(const Unknowns &u, const Unknowns &v)
    {
      double largest = 0.;
      for (std::size_t i = 0; i < u.size() / 3; ++i)
        largest = std::max(largest, norm(v.empty() ? get(u, i) : get(u, i) - get(v, i)));
      return largest;
    }

    /** Returns the bodies whose sum of forces is at least a tenth of the largest one. */
    std::vector<const Body *> moving_bodies(const Structure &structure, const Unknowns &force)
    {
      std::vector<double> sums;
      for (const Body &body : structure.bodies)
      {
        const auto begin = force.begin() + 3 * std::size_t(body.first_node);
        sums.push_back(norm_1({begin, begin + 3 * std::size_t(body.n_nodes())}));
      }
      const double              largest = *std::max_element(sums.begin(), sums.end());
      std::vector<const Body *> result;
      for (std::size_t b = 0; b < sums.size(); ++b)
        if (sums[b] >= .1 * largest)
          result.push_back(&structure.bodies[b]);
      return result;
    }

    std::string names_of(const std::vector<const Body *> &bodies)
    {
      return listed(bodies, [](const Body *body) { return body->name(); });
    }

    /** Returns a sentence about the slopes of the base joints of bodies, if they exceed the angle of friction. */
    std::string slopes_of_base(const Dam &dam, const std::vector<const Body *> &bodies)
    {
      constexpr double degree = 180. / 3.14159265358979;
      const double     holds = degree * std::atan(dam.scene.joints.law(dam.scene.concrete.young).friction);
      double           steepest = 0.;
      for (const Body *body : bodies)
      {
        Vector3 normal{};
        for (const Pair &pair : dam.structure.pairs)
          if (dam.layout.joints[pair.joint].is_base() && pair.node_2 >= body->first_node &&
              pair.node_2 < body->first_node + body->n_nodes())
            for (unsigned int c = 0; c < 3; ++c)
              normal[c] += pair.area * pair.frame[0][c];
        if (norm(normal) == 0.) // no base joint
          continue;
        steepest = std::max(steepest, degree * std::acos(normal[2] / norm(normal)));
      }
      std::ostringstream text;
      text.precision(3);
      if (steepest > holds)
        text << " The base of these blocks slopes by up to " << steepest
             << " degrees; the angle of friction is " << holds << " degrees.";
      return text.str();
    }

    /** Computes the steps of the static load history. */
    class StaticHistory
    {
    public:
      StaticHistory(Dam &dam, const ContactParameters &parameters, Log &log,
                    const std::function<void()> &stop_if_asked)
          : dam(dam), alternates(alternates_with_rock(dam)), parameters(in_statics(dam, parameters)),
            log(log), stop_if_asked(stop_if_asked),
            sustained(dam.has_sustained_moduli() ? dam.sustained_structure() : Structure()),
            structure(dam.has_sustained_moduli() ? sustained : dam.structure),
            springs(dam.foundation->static_springs(structure)), base(dam.foundation->static_base(structure)),
            path(dam)
      {
        const Scene &scene = dam.scene;
        if (dam.has_loose_blocks())
          least_proximal = 1e-3 * (proximal = .3 * std::min(scene.concrete.young, stiffest) /
                                              (scene.concrete.density * dam.size * dam.size));
        state.force.assign(3 * dam.structure.pairs.size(), 0.);
        state.closed = gap = state.force;
        state.removed.assign(dam.structure.pairs.size(), 0.);
        state.u.assign(3 * dam.structure.n_nodes(), 0.);
        state.memory = dam.layout.laws.initial_memory();
        state.contact.converged = true;
        for (std::size_t j = 0; j < dam.layout.joints.size(); ++j)
          ungrouted.of_joint.push_back(make_fja_law(0.));
        ungrouted.assign(dam.structure);
        for (std::size_t p = 0; p < dam.structure.pairs.size(); ++p)
          widen(p, dam.layout.gaps[dam.structure.pairs[p].joint]);
        if (scene.loads.uplift.joints && scene.loads.factor("uplift") != 0. && scene.reservoir.density > 0.)
          water = std::make_unique<JointWater>(joint_water(dam));
      }

      StaticState solve()
      {
        for (; stage < path.n_parts(); ++stage)
        {
          if (stage == 0 || path.part(stage).grouted > path.grouted_before(stage))
            grout();
          if (dam.has_loose_blocks() && path.n_parts() > 1 && !path.is_weight_alone(stage))
            refine();
          else if (advance(path.increments(stage)))
          {
            report();
            if (path.is_weight_alone(stage))
              judge_weight();
          }
          else
            throw_failure();
        }
        --stage;
        if (water)
          state.joint_water = water->pressures([&](const double z) { return water_pressure(1., z); });
        state.pairs = system->states();
        state.n_open = n_of(PairState::open);
        if (dam.has_sustained_moduli())
          add_modulus_force();
        return state;
      }

    private:
      /** Values that a repeated stage starts from. */
      struct Snapshot
      {
        StaticState                 state;
        Unknowns                    gap;
        std::unique_ptr<JointWater> water;
      };

      std::unique_ptr<JointWater> copy_of(const std::unique_ptr<JointWater> &w) const
      {
        return w ? std::make_unique<JointWater>(*w) : nullptr;
      }

      /** Solves a stage in @p n equal increments. Returns false, with the reason in #failure, if one fails. */
      bool advance(const unsigned int n)
      {
        for (unsigned int i = 0; i < n; ++i)
        {
          stop_if_asked();
          for (std::size_t p = 0; p < dam.structure.pairs.size(); ++p)
            widen(p, path.cut_width(stage, dam.structure.pairs[p].joint) / n);
          const ContactResult result = solve_step(i, n);
          if (!result.converged)
          {
            state.contact.add_work(result);
            return false;
          }
          state.contact += result;
          record(double(i + 1) / n);
        }
        return true;
      }

      /** Solves a stage with increments that are halved until they converge and, if the state depends on them, until
       * the displacements at its end change by less than a tolerance. The state is that of the finer increments. */
      void refine()
      {
        const Snapshot     start{state, gap, copy_of(water)};
        Unknowns           coarse;       // displacements with half of the increments, or empty
        unsigned int       failures = 0; // in a row
        const unsigned int most = std::max(most_increments, 2 * path.increments(stage));
        for (unsigned int n = path.increments(stage);; n *= 2)
        {
          const ContactResult work = state.contact;
          state = start.state;
          state.contact = work;
          gap = start.gap;
          water = copy_of(start.water);
          const bool converged = advance(n), is_last = 2 * n > most;
          failures = converged ? 0 : failures + 1;
          if (!converged && (is_last || failures == most_failures))
            throw_failure();
          if (converged && !path.depends_on_increments())
            return report();
          const double change = converged && !coarse.empty() ? largest_difference(state.u, coarse) : INFINITY,
                       limit = path_tolerance * largest_difference(state.u, {});
          coarse = converged ? state.u : Unknowns();
          if (change > limit && !(converged && is_last))
            continue;
          std::ostringstream text;
          text.precision(2);
          text << n << " increments: with " << n / 2 << " the displacements differ by " << 1e3 * change
               << " mm (limit " << 1e3 * limit << " mm)";
          report("; " + text.str());
          if (change > limit)
            log.line(
                "warning: stage \"%s\" of the static state depends on the load increments. After %s. Divide the "
                "stage into smaller ones (Statics/Stages), or check the friction of base and lift joints "
                "(Joints/Friction).",
                path.part(stage).name.c_str(), text.str().c_str());
          return;
        }
      }

      double water_pressure(const double share, const double z) const
      {
        return dam.scene.loads.factor("uplift") * path.water_pressure(stage, share, z);
      }

      unsigned int n_of(const PairState wanted) const
      {
        return std::count(system->states().begin(), system->states().end(), wanted);
      }

      void add_modulus_force()
      {
        Unknowns of_statics;
        dam.structure.multiply_stiffness(state.u, state.modulus_force);
        structure.multiply_stiffness(state.u, of_statics);
        for (std::size_t k = 0; k < of_statics.size(); ++k)
          state.modulus_force[k] -= of_statics[k];
        state.modulus_share = 1. - dam.scene.sustained_ratio();
      }

      /** Moves the faces of a pair apart by removing the material or the grout between them. */
      void widen(const std::size_t p, const double width)
      {
        if (width == 0. || dam.is_tied(p))
          return;
        state.closed[3 * p] -= width;
        state.removed[p] += width;
        gap[3 * p] += width;
        dam.layout.laws.lose_bond(p, state.memory);
      }

      /** Grouts the pairs before a stage: their gap is zero in the current state. The grout that sets carries the force
       * of the contact and of the fluid grout. */
      void grout()
      {
        grouted = path.part(stage).grouted;
        for (std::size_t p = 0; p < dam.structure.pairs.size(); ++p)
        {
          const Pair &pair = dam.structure.pairs[p];
          if (pair.place[2] <= path.grouted_before(stage) || pair.place[2] > grouted ||
              dam.layout.is_cast(pair))
            continue;
          if (stage > 0)
            state.force[3 * p] += path.grout_pressure(stage - 1, 1., p) * pair.area;
          Vector3 now{};
          if (const ElasticLaw *law = dam.layout.laws.of_pair[p]->elastic_law())
            now[0] = -law->compliance(pair.area)[0] * state.force[3 * p];
          set(state.closed, p, dam.structure.jump(pair, state.u) - now);
          set(gap, p, now);
          dam.layout.laws.restore_bond(p, state.memory);
        }
        make_system();
      }

      void make_system()
      {
        ContactParameters of_system = parameters;
        of_system.write_problems = parameters.write_problems && grouted == INFINITY;
        StepOperator operation;
        operation.proximal = proximal;
        system = std::make_unique<JointSystem>(structure, laws_up_to(grouted, dam, ungrouted), of_system,
                                               operation, springs, base.get());
      }

      /** Solves with the load f, and with base joints by iterations: (K + eps M) u = f + eps M u_k, where u_k is the
       * displacement of the previous iteration. They end when the force eps M (u - u_k) is negligible, or no longer
       * falls. If it falls slowly, eps is reduced. @p negligible: relative to the sum of all nodal loads. */
      ContactResult iterate(const Unknowns &load, const Unknowns &offset, const Unknowns &start,
                            const Unknowns &committed, const double negligible)
      {
        constexpr unsigned int most = 100;     // iterations
        constexpr double       allowed = 1e-7; // of the sum of all nodal loads
        ContactResult          total;
        double                 before = INFINITY;
        system->set_tolerance(std::clamp(1e-2 * negligible, parameters.tolerance, 1e-6));
        for (unsigned int k = 0;; ++k)
        {
          stop_if_asked();
          state.memory = committed; // crack events of previous iterations are discarded
          const Unknowns last = state.u;
          Unknowns       raised = load;
          add_proximal(last, raised);
          const ContactResult result =
              system->solve(raised, offset, start, state.memory, state.force, gap, state.u);
          if (proximal == 0.)
            return result;
          total += result;
          total.converged = result.converged;
          if (!result.converged)
            return total;
          Unknowns moved = state.u, held(load.size(), 0.);
          for (std::size_t k = 0; k < moved.size(); ++k)
            moved[k] -= last[k];
          add_proximal(moved, held);
          const double sum = norm_1(held), of_load = norm_1(load);
          if (sum <= negligible * of_load || (sum > .5 * before && sum <= allowed * of_load))
            return total;
          const bool is_slow = sum > .5 * before && k > 2;
          if (is_slow && proximal > 1.5 * least_proximal)
          {
            proximal *= .1;
            make_system();
          }
          else if ((is_slow && sum > .9 * before) || k == most)
          {
            failure = without_equilibrium(held);
            total.converged = false;
            return total;
          }
          before = sum;
        }
      }

      /** Throws InputError, or prints a warning, if the weight alone moves blocks far along their base. */
      void judge_weight() const
      {
        constexpr double          most = 1e-3, warn = 1e-4; // of the size of the dam
        double                    largest = 0.;
        std::vector<double>       of_body(structure.bodies.size(), 0.);
        std::vector<const Body *> moving;
        for (std::size_t p = 0; p < structure.pairs.size(); ++p)
          if (const Pair &pair = structure.pairs[p]; dam.layout.joints[pair.joint].is_base())
          {
            double &moved = of_body[structure.body_of(pair.node_2)];
            moved = std::max(moved, norm(structure.jump(pair, state.u)));
            largest = std::max(largest, moved);
          }
        if (largest < warn * dam.size)
          return;
        for (std::size_t b = 0; b < of_body.size(); ++b)
          if (of_body[b] >= .1 * largest)
            moving.push_back(&structure.bodies[b]);
        std::ostringstream text;
        text.precision(3);
        text << names_of(moving) << (moving.size() == 1 ? " moves" : " move") << " by up to " << largest
             << " m along the base" << under_weight(moving);
        if (largest > most * dam.size)
          throw InputError("The static state is impossible: " + text.str());
        log.line("warning: %s", text.str().c_str());
      }

      /** Returns the end of a message about blocks that slide under the weight alone: the reason, and what to do. */
      std::string under_weight(const std::vector<const Body *> &moving) const
      {
        const bool has_lifts = grouted < INFINITY;
        return " under the weight alone, with " +
               std::string(!has_lifts             ? "all joints closed"
                           : grouted == -INFINITY ? "joints that are not grouted (free-standing)"
                                                  : "the joints that are grouted before the first load") +
               "." + slopes_of_base(dam, moving) +
               (has_lifts
                    ? " Begin \"Statics/Stages\" with grout up to the height of these monoliths, or remove the lifts "
                      "and set \"Statics/Self-weight\" = monolithic (the weight of the finished dam), or check"
                    : " Check") +
               " the friction (\"Joints/Friction\"), or bond the base or lift joints (\"Joints/Overrides\" = base: tied, "
               "lift: tied).";
      }

      /** Returns the message for the forces that hold the moving blocks. */
      std::string without_equilibrium(const Unknowns &force) const
      {
        const std::vector<const Body *> moving = moving_bodies(structure, force);
        const std::string               text = "The static state has no equilibrium: " + names_of(moving) +
                                 (moving.size() == 1 ? " moves" : " move") + " without limit on the joints";
        if (path.is_weight_alone(stage))
          return text + under_weight(moving);
        return text +
               (grouted < INFINITY
                    ? ", in stage \"" + path.part(stage).name +
                          "\", before all joints are grouted. Grout the joints before this stage"
                    : std::string(". Check the friction (\"Joints/Friction\"), the water level and the "
                                  "uplift")) +
               ", or bond the base or lift joints (\"Joints/Overrides\" = base: tied, lift: tied).";
      }

      /** Adds eps M u to @p load. */
      void add_proximal(const Unknowns &u, Unknowns &load) const
      {
        for (unsigned int i = 0; proximal > 0. && i < structure.n_nodes(); ++i)
        {
          const Vector3 Mu = structure.mass[i] * get(u, i);
          for (unsigned int c = 0; c < 3; ++c)
            load[3 * i + c] += proximal * Mu[c];
        }
      }

      /** Solves increment @p i of @p n of a stage, repeatedly until water spreads to no further pair. */
      ContactResult solve_step(const unsigned int i, const unsigned int n)
      {
        const double   share = double(i + 1) / n;
        const Unknowns start = gap; // slip is relative to the previous step
        Unknowns       offset = state.closed;
        for (double &x : offset)
          x = -x;
        const Unknowns committed = state.memory;
        Unknowns       last(path.load(stage, 1.).size(), 0.);
        double         negligible = alternates ? .1 : 1e-11;
        const auto     solve =
            [&](const Unknowns &load) // at first as exact as the rock, whose changes of the load fall
        {
          for (std::size_t k = 0; k < last.size(); ++k)
            last[k] -= load[k];
          negligible = std::max(1e-11, std::min(.2 * negligible, .1 * norm_1(last) / norm_1(load)));
          last = load;
          return iterate(load, offset, start, committed, negligible);
        };
        const auto pressure = [&](const double z) // no pressure in joints before grouting
        { return z > path.part(stage).grouted ? 0. : water_pressure(share, z); };
        ContactResult total;
        total.converged = true;
        failure.clear();
        do
        {
          state.load = path.load(stage, share);
          if (water)
            water->add_forces(pressure, state.load);
          const ContactResult result =
              dam.foundation->solve_static(solve, springs, state.u, state.load, failure, log);
          total += result;
          if (!result.converged)
          {
            if (failure.empty())
              failure = not_converged(i, n, result);
            return total;
          }
        } while (water && water->spread(system->states(), pressure));
        system->commit(start, state.force, gap, state.memory);
        return total;
      }

      std::string not_converged(const unsigned int i, const unsigned int n, const ContactResult &result) const
      {
        std::ostringstream message;
        message << "The static state did not converge in ";
        if (path.n_parts() > 1)
          message << "stage \"" << path.part(stage).name << "\", ";
        message << "step " << i + 1 << " of " << n << "." << largest_error(dam.structure, result)
                << " The residual is " << result.residual << " of the joint forces and "
                << result.residual_over_load << " of the load (limit " << parameters.tolerance
                << ", from \"Contact/Tolerance\"), after " << result.iterations << " Newton steps. ";
        const double share = std::max(result.residual, result.residual_over_load) / parameters.tolerance;
        const unsigned int p = result.worst_pair;
        const int          joint = p < dam.structure.pairs.size() ? int(dam.structure.pairs[p].joint) : -1;
        if (joint >= 0 && !dam.layout.joints[joint].is_contraction() &&
            dam.layout.laws.of_joint[joint]->surfaces_law() != nullptr)
          message
              << "The law of this joint has keys, which may not have a unique state between blocks that move. Set "
                 "it to FJA in \"Joints/Overrides\".";
        else if (result.iterations == 0 || share < 1e3) // near the round-off, or no step is possible
          message << "More increments or iterations will not help. Set \"Contact/Tolerance\" to "
                  << dam.scene.contact.tolerance * std::pow(10., std::ceil(std::log10(share))) << ".";
        else
          message << (path.is_weight_alone(stage)    ? "Bond the base or lift joints (\"Joints/Overrides\")"
                      : path.depends_on_increments() ? "The increments were halved already. Divide the stage"
                                                     : "Increase \"Statics/Water increments\"")
                  << ", or increase \"Contact/Maximum iterations\".";
        return message.str();
      }

      [[noreturn]] void throw_failure() const
      {
        if (path.is_weight_alone(stage) && failure.find("did not converge") == std::string::npos)
          throw InputError(failure);
        throw ComputationError(failure);
      }

      /** Adds a row to the steps, at a share of a stage. */
      void record(const double share)
      {
        const StaticPart  &part = path.part(stage);
        const unsigned int crown = dam.model->equation[dam.geometry->crown];
        if (crown != rigid_ground)
          state.crown = Vector3{{state.u[3 * crown], state.u[3 * crown + 1], state.u[3 * crown + 2]}} -
                        dam.base_motion(state.u);
        StaticStep step{path.number(stage),
                        share,
                        part.level,
                        state.crown,
                        n_of(PairState::open),
                        n_of(PairState::slip),
                        water ? water->n_wet() : 0};
        for (std::size_t p = 0; p < dam.structure.pairs.size(); ++p)
          if (const Pair &pair = dam.structure.pairs[p];
              pair.place[2] <= part.grouted || dam.layout.is_cast(pair))
            step.opening = std::max(step.opening, gap[3 * p]);
        state.steps.push_back(step);
      }

      /** Writes a line about the end of a stage to the log. @p increments: text about them, or empty. */
      void report(const std::string &increments = "") const
      {
        const StaticStep &step = state.steps.back();
        if (path.n_parts() > 1 || step.n_wet > 0)
          log.line("Stage     %s: crest %.1f mm downstream, %u pairs open, %u pairs under water pressure, "
                   "largest opening %.2f mm%s",
                   path.part(stage).name.c_str(), 1e3 * state.crown[0], step.n_open, step.n_wet,
                   1e3 * step.opening, increments.c_str());
      }

      const Dam                   &dam;
      const bool                   alternates; ///< see alternates_with_rock()
      const ContactParameters      parameters;
      Log                         &log;
      const std::function<void()> &stop_if_asked;
      Structure                    sustained; ///< or empty
      Structure                   &structure; ///< with the moduli of the static state
      const Unknowns               springs;

      const std::unique_ptr<BaseElimination::Nodes> base;

      double proximal = 0.;       ///< eps [1/s^2]; 0: the base holds all monoliths
      double least_proximal = 0.; ///< with a smaller eps the factors would be inaccurate [1/s^2]
      double grouted = -INFINITY; ///< height of the grouted joints [m]

      const StaticPath             path;
      JointLaws                    ungrouted; ///< contact without friction
      std::unique_ptr<JointWater>  water;
      std::unique_ptr<JointSystem> system;
      std::size_t                  stage = 0; ///< present one
      std::string                  failure;   ///< of the last step; empty: none
      Unknowns                     gap;       ///< of the pairs, 3 each [m]
      StaticState                  state;
    };

    /** Throws InputError for implausible displacements, see static_state(). */
    void check(const Dam &dam, const Unknowns &u, const Vector3 &crown)
    {
      constexpr double largest_share = .01;
      double           joint = 0.;
      Vector3          where{};
      for (const Pair &pair : dam.structure.pairs)
        if (const double moved = norm(dam.structure.jump(pair, u)); !(moved <= joint))
        {
          joint = moved;
          where = pair.place;
        }
      const double       crest = norm(crown), weight = norm(dam.staged.crown);
      std::ostringstream text;
      text.precision(4);
      double limit = largest_share;
      if (!(crest <= largest_share * dam.size))
        text << "its crest has a displacement of " << crest << " m relative to the base";
      else if (!(weight <= largest_share * dam.size))
        text << "its crest has a displacement of " << weight << " m under its own weight";
      else if (limit = largest_joint_share; !(joint <= limit * dam.size))
        text << "a joint has a displacement of " << joint << " m at " << place(where);
      else
        return;
      text << " (limit " << limit * dam.size << " m, " << 100. * limit << " % of the diagonal of the dam)";
      throw InputError(
          "The static state of the dam is impossible: " + text.str() +
          ", before any earthquake. Check \"Concrete/Young's modulus\" [Pa] and \"Concrete/Density\" "
          "[kg/m3], \"Mesh/Length unit\", \"Reservoir/Water level\" [m], \"Reservoir/Density\", "
          "\"Statics/Gravity\"" +
          std::string(dam.foundation->uses_rock() ? ", \"Foundation/Young's modulus\" [Pa]" : "") +
          ", and section Loads (temperatures, expansion, concentrated and line loads). "
          "voussoir SCENE.prm --validate prints the properties of the dam.");
    }
  } // namespace

  Unknowns StaticState::constant_load() const
  {
    Unknowns sum = load;
    for (std::size_t k = 0; k < modulus_force.size(); ++k)
      sum[k] += modulus_force[k];
    return sum;
  }

  Unknowns StaticState::elastic(const Unknowns &total) const
  {
    Unknowns result = total;
    for (std::size_t k = 0; modulus_share != 0. && k < result.size(); ++k)
      result[k] -= modulus_share * u[k];
    return result;
  }

  StaticState static_state(Dam &dam, const ContactParameters &parameters, Log &log,
                           const std::function<void()> &stop_if_asked)
  {
    const Stopwatch   watch;
    const StaticState state = StaticHistory(dam, parameters, log, stop_if_asked).solve();
    check(dam, state.u, state.crown);
    log.line(
        "Static    self-weight %s, then water: %u Newton steps, %u pair%s open, crest %.1f mm downstream%s "
        "(%.1f s)",
        dam.scene.loads.factor("weight") == 0. ? "none" : dam.scene.statics.self_weight.c_str(),
        state.contact.iterations, state.n_open, state.n_open == 1 ? "" : "s", 1e3 * state.crown[0],
        dam.base_is_held() ? "" : " of the base", watch.seconds());
    return state;
  }
} // namespace Voussoir
