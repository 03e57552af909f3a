#include <voussoir/app/simulation.h>
#include <voussoir/base/error.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace Voussoir
{
  namespace
  {
    /** x += f - sum of g (dx + df), the coefficients g those that make f - sum of g df smallest. */
    void accelerate(std::vector<Unknowns> df, std::vector<Unknowns> dx, Unknowns f, Unknowns &x)
    {
      const auto dot_product = [](const Unknowns &a, const Unknowns &b)
      {
        double sum = 0.;
        for (std::size_t k = 0; k < a.size(); ++k)
          sum += a[k] * b[k];
        return sum;
      };
      for (std::size_t j = df.size(); j-- > 0;) // the newest first: Gram-Schmidt
      {
        const double before = dot_product(df[j], df[j]);
        for (std::size_t i = df.size(); i-- > j + 1;)
          if (const double square = dot_product(df[i], df[i]); square > 0.)
          {
            const double factor = dot_product(df[i], df[j]) / square;
            for (std::size_t k = 0; k < x.size(); ++k)
            {
              df[j][k] -= factor * df[i][k];
              dx[j][k] -= factor * dx[i][k];
            }
          }
        const double square = dot_product(df[j], df[j]);
        if (square <= 1e-20 * before)
        {
          std::fill(df[j].begin(), df[j].end(), 0.);
          continue;
        }
        const double factor = dot_product(df[j], f) / square;
        for (std::size_t k = 0; k < x.size(); ++k)
        {
          f[k] -= factor * df[j][k];
          x[k] -= factor * dx[j][k];
        }
      }
      for (std::size_t k = 0; k < x.size(); ++k)
        x[k] += f[k];
    }
  } // namespace

  void Simulation::find_static_state()
  {
    const Stopwatch   watch;
    const Structure  &structure = dam->structure;
    const std::size_t n_pairs = structure.pairs.size();
    Unknowns          springs;
    if (dam->foundation) // between dam and rock, for the static iteration only
    {
      springs = dam->foundation->static_springs(structure);
      dam->structure.dashpots = springs;
    }
    JointSystem system(structure, dam->laws, contact_parameters("static"), 0., 1., 1.);
    dam->structure.dashpots.clear();
    Unknowns gap(3 * n_pairs, 0.), start, offset(3 * n_pairs, 0.);
    statics.force.assign(3 * n_pairs, 0.);
    statics.u.assign(3 * structure.n_nodes(), 0.);
    ContactResult total;
    total.converged = true;
    for (unsigned int i = 1; i <= scene.statics.water_increments; ++i)
    {
      // slip is counted from the last increment
      stop_if_asked();
      start = gap;
      statics.load = dam->static_load(double(i) / scene.statics.water_increments);
      if (dam->foundation)
        settle(system, springs, start, gap);
      else
        statics.contact = system.solve(statics.load, offset, start, statics.force, gap, statics.u);
      total += statics.contact;
      if (!statics.contact.converged)
      {
        std::ostringstream message;
        message << "The static state did not converge in increment " << i
                << " of the water: relative residual " << statics.contact.residual << " after "
                << statics.contact.iterations
                << " Newton steps. More increments may help (entry \"Statics/Water increments\").";
        throw ComputationError(message.str());
      }
    }
    statics.contact = total;
    statics.pairs = system.states();
    pairs_at_start = statics.pairs;
    statics.n_open = std::count(statics.pairs.begin(), statics.pairs.end(), PairState::open);
    if (const unsigned int e = dam->model->equation[dam->geometry->crown]; e != rigid_ground)
      statics.crown = Vector3{{statics.u[3 * e], statics.u[3 * e + 1], statics.u[3 * e + 2]}} -
                      dam->base_motion(statics.u);
    check_static_state(*dam, statics.u, statics.crown);
    count.seconds_static = watch.seconds();
    log.line(
        "Static    self-weight %s, then water: %u Newton steps, %u pairs open, crest %.1f mm downstream%s "
        "(%.1f s)",
        scene.statics.self_weight.c_str(), total.iterations, statics.n_open, 1e3 * statics.crown[0],
        dam->base_is_held() ? "" : " of the base", count.seconds_static);
  }

  /** The static state of dam and rock: the rock gives way under the forces of the dam, the dam follows
   * through stiff springs with the force that they carried before, so that they are without force in the end.
   * Anderson's acceleration of the displacements of the base (Walker and Ni 2011). */
  void Simulation::settle(JointSystem &system, const Unknowns &springs, const Unknowns &start, Unknowns &gap)
  {
    Foundation           &rock = *dam->foundation;
    const std::size_t     n = 3 * rock.feet().size();
    const Unknowns        external = statics.load, offset(gap.size(), 0.);
    Unknowns              base(n, 0.), r(external.size(), 0.), settled;
    std::vector<Unknowns> df, dx; // differences of residuals and of bases
    Unknowns              last_f, last_base;
    double                error = 1.;
    ContactResult         total;
    unsigned int          round = 0;
    total.converged = true;
    for (; round < 60 && error > 1e-9; ++round)
    {
      stop_if_asked();
      Unknowns load = external;
      for (std::size_t i = 0; i < n / 3; ++i)
        for (const unsigned int node : rock.feet()[i].nodes)
          for (unsigned int c = 0; c < 3; ++c)
            load[3 * node + c] += springs[3 * node + c] * base[3 * i + c] - r[3 * node + c];
      statics.contact = system.solve(load, offset, start, statics.force, gap, statics.u);
      total += statics.contact;
      if (!statics.contact.converged)
        break;
      double slack = 0., size = 1e-300;
      for (std::size_t i = 0; i < n / 3; ++i)
        for (const unsigned int node : rock.feet()[i].nodes)
          for (unsigned int c = 0; c < 3; ++c)
          {
            const double difference = statics.u[3 * node + c] - base[3 * i + c];
            r[3 * node + c] += springs[3 * node + c] * difference;
            slack = std::max(slack, std::abs(difference));
          }
      rock.settle(r, std::max(1e-11, 1e-2 * error), settled, log);
      Unknowns f = settled;
      for (std::size_t k = 0; k < n; ++k)
      {
        f[k] -= base[k];
        slack = std::max(slack, std::abs(f[k]));
        size = std::max(size, std::abs(settled[k]));
      }
      error = slack / size;
      if (round > 0)
      {
        df.push_back(f);
        dx.push_back(base);
        for (std::size_t k = 0; k < n; ++k)
        {
          df.back()[k] -= last_f[k];
          dx.back()[k] -= last_base[k];
        }
        if (df.size() > 25)
        {
          df.erase(df.begin());
          dx.erase(dx.begin());
        }
      }
      last_f = f;
      last_base = base;
      accelerate(df, dx, f, base);
    }
    statics.contact = total;
    if (total.converged && error > 1e-9)
    {
      std::ostringstream message;
      message << "The static state of dam and rock did not converge: relative error " << error << " after "
              << round << " rounds.";
      throw ComputationError(message.str());
    }
    for (std::size_t k = 0; k < r.size(); ++k)
      statics.load[k] -= r[k];
    log.line("Rock      static state of dam and rock after %u rounds", round);
  }
} // namespace Voussoir
