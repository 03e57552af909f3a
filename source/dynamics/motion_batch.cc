// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/lanes.h>
#include <voussoir/base/simd.h>
#include <voussoir/dynamics/motion_batch.h>
#include <voussoir/joints/pairs.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace Voussoir
{
  namespace
  {
    namespace BatchKernels
    {
#define VOUSSOIR_KERNEL <dynamics/motion_batch_kernel.h>
#include <voussoir/base/for_lanes.h>
#undef VOUSSOIR_KERNEL
    } // namespace BatchKernels

    /** Returns the kind of a joint law, or throws an internal error; see BatchModel::why_not(). */
    BatchPair::Kind kind_of(const JointLaw &law)
    {
      if (law.flat_friction() >= 0.)
        return BatchPair::friction;
      const Matrix3 one = {{1., 0., 0., 0., 1., 0., 0., 0., 1.}};
      return law.solve(one, {{1., 0., 0.}}, {})[0] < 0. ? BatchPair::tied : BatchPair::no_slip;
    }
  } // namespace

  std::string BatchModel::why_not(const Structure &structure, const JointLaws &laws)
  {
    if (structure.damping.mass != 0. || structure.damping.stiffness != 0.)
      return "the damping is not uniform";
    if (structure.has_zones())
      return "zones have damping ratios of their own";
    if (structure.damping.c.size() > BatchView::most_terms)
      return "the damping has more than " + std::to_string(BatchView::most_terms) + " terms";
    if (!clusters_of(structure.pairs).empty())
      return "joints cross";
    for (const JointLaw *law : laws.of_pair)
      if (law->n_memory() > 0 || law->surfaces_law() != nullptr || law->elastic_law() != nullptr ||
          (law->flat_friction() < 0. && !law->is_tangentially_tied()))
        return "the law of a joint is not FJA, FJB or tied";
    return "";
  }

  BatchModel::BatchModel(const Structure &structure, const JointLaws &laws, const double dt,
                         const unsigned int n_steps, const Start &start)
      : structure(structure), dt(dt), n_steps(n_steps), u_static(start.u), closed(start.closed), sizes()
  {
    const double   h = dt / n_steps;
    const Damping &damping = structure.damping;
    sizes.n_nodes = structure.n_nodes();
    sizes.n_bodies = structure.bodies.size();
    sizes.n_pairs = structure.pairs.size();
    sizes.n_terms = damping.c.size();
    sizes.h = h;
    double jolt = h;
    for (unsigned int k = 0; k < sizes.n_terms; ++k)
    {
      sizes.weight[k] = damping.c[k];
      sizes.decay[k] = std::exp(-h / damping.tau[k]);
      sizes.growth[k] = -damping.tau[k] * std::expm1(-h / damping.tau[k]);
      jolt += damping.c[k] * -damping.tau[k] * std::expm1(-h / damping.tau[k]);
    }
    sizes.jolt = jolt;
    add_stiffness();
    add_nodes(start);
    std::vector<Matrix3> inverse_masses;
    for (const Matrix3 &mass : structure.mass)
      inverse_masses.push_back(inverse(mass));
    for (std::size_t p = 0; p < structure.pairs.size(); ++p)
      add_pair(structure.pairs[p], *laws.of_pair[p], inverse_masses);
  }

  void BatchModel::add_stiffness()
  {
    const double modulus = structure.damping.modulus;
    row.push_back(0);
    for (const Body &of_body : structure.bodies)
    {
      body.push_back(of_body.first_node);
      const BlockSparseMatrix &K = of_body.stiffness;
      for (unsigned int i = 0; i < of_body.n_nodes(); ++i)
      {
        for (std::size_t k = K.start[i]; k < K.start[i + 1]; ++k)
          if (K.column[k] >= i)
          {
            std::vector<float> &to = K.column[k] == i ? diagonal : block;
            for (const double x : K.value[k])
              to.push_back(modulus * x);
            if (K.column[k] > i)
              column.push_back(of_body.first_node + K.column[k]);
          }
        row.push_back(column.size());
      }
    }
    body.push_back(structure.n_nodes());
  }

  void BatchModel::add_nodes(const Start &start)
  {
    Unknowns Ku;
    structure.multiply_stiffness(u_static, Ku);
    for (std::size_t k = 0; k < Ku.size(); ++k)
      static_strain += .5 * u_static[k] * Ku[k];
    for (std::size_t i = 0; i < structure.n_nodes(); ++i)
    {
      const Matrix3 by_force = inverse(structure.mass[i]);
      double        off = 0.;
      for (unsigned int c = 0; c < 9; ++c)
      {
        inverse_mass.push_back(by_force[c]);
        off += c % 4 == 0 ? 0. : std::abs(by_force[c]);
        of_ground.push_back(start.inertia[c % 3][3 * i + c / 3]);
      }
      is_full.push_back(off > 0.);
      for (unsigned int c = 0; c < 3; ++c)
        residual.push_back(start.load[3 * i + c] - Ku[3 * i + c]);
    }
  }

  void BatchModel::add_pair(const Pair &pair, const JointLaw &law, const std::vector<Matrix3> &inverse_masses)
  {
    BatchPair          result = {};
    const double       h = sizes.h;
    const unsigned int nodes[2] = {pair.node_1, pair.node_2};
    const auto         by_force = [&](const Vector3 &force, const unsigned int side)
    {
      Vector3 change = inverse_masses[nodes[side]] * force;
      for (double &x : change)
        x *= side == 0 ? -h : h;
      return change;
    };
    const auto of_pair = [&](const Vector3 &a, const Vector3 &b)
    {
      double sum = 0.;
      for (const unsigned int side : {0, 1})
        if (nodes[side] != rigid_ground)
          sum += h * dot(a, by_force(b, side)) * (side == 0 ? -1. : 1.);
      return sum;
    };
    const Vector3 &n = pair.frame[0], &a = pair.frame[1], &b = pair.frame[2];
    const double   angle = .5 * std::atan2(2. * of_pair(a, b), of_pair(a, a) - of_pair(b, b));
    Vector3        axes[3] = {n, {}, {}};
    result.cosine = std::cos(angle), result.sine = std::sin(angle);
    for (unsigned int c = 0; c < 3; ++c)
    {
      axes[1][c] = std::cos(angle) * a[c] + std::sin(angle) * b[c];
      axes[2][c] = -std::sin(angle) * a[c] + std::cos(angle) * b[c];
    }
    Matrix3       H;
    const Vector3 jump = structure.jump(pair, u_static), reference = get(closed, pairs.size());
    const Vector3 slip = jump - reference;
    for (unsigned int i = 0; i < 3; ++i)
    {
      for (unsigned int c = 0; c < 3; ++c)
      {
        result.frame[3 * i + c] = axes[i][c];
        H[3 * i + c] = of_pair(axes[i], axes[c]);
      }
      result.gap[i] = i == 0 ? slip[0] : slip[1] * dot(axes[i], a) + slip[2] * dot(axes[i], b);
      for (const unsigned int side : {0, 1})
        for (unsigned int c = 0; nodes[side] != rigid_ground && c < 3; ++c)
          result.impulse[side][3 * c + i] = by_force(axes[i], side)[c];
    }
    const Matrix3 K = inverse(H);
    result.kind = kind_of(law);
    result.friction_of = std::max(0., law.flat_friction());
    for (const unsigned int side : {0, 1})
    {
      result.node[side] = nodes[side] == rigid_ground ? -1 : static_cast<int>(nodes[side]);
      if (nodes[side] != rigid_ground)
        nodes_of_pairs.push_back(nodes[side]);
    }
    result.H_nn = H[0], result.H_1n = H[3], result.H_2n = H[6], result.H_11 = H[4], result.H_22 = H[8];
    const double values[6] = {K[0], K[1], K[2], K[4], K[5], K[8]};
    std::copy(values, values + 6, result.inverse);
    result.is_coupled = std::abs(H[3]) + std::abs(H[6]) + std::abs(H[4] - H[8]) > 1e-9 * H[0];
    pairs.push_back(result);
  }

  BatchView BatchModel::view() const
  {
    BatchView result = sizes;
    result.body = body.data();
    result.row = row.data();
    result.column = column.data();
    result.block = block.data();
    result.diagonal = diagonal.data();
    result.inverse_mass = inverse_mass.data();
    result.is_full = is_full.data();
    result.residual = residual.data();
    result.of_ground = of_ground.data();
    result.pairs = pairs.data();
    return result;
  }

  MotionBatch::MotionBatch(const BatchModel &model, const std::vector<Vector3> &ground)
      : model(model), view(model.view()), lanes(n_lanes()), u(3 * view.n_nodes * lanes), v(u), w(u), f(u),
        d(view.n_terms * 3 * view.n_nodes * lanes), gap(3 * view.n_pairs * lanes), moved(gap), impulse(gap)
  {
    for (std::size_t q = 0; q < view.n_pairs; ++q)
      for (unsigned int c = 0; c < 3; ++c)
        for (unsigned int lane = 0; lane < lanes; ++lane)
          gap[(3 * q + c) * lanes + lane] = view.pairs[q].gap[c];
    const double half = .5 * model.dt / model.n_steps;
    // As Leapfrog::start(): the velocity begins in the middle of a step before the start.
    for (std::size_t k = 0; k < 3 * view.n_nodes; ++k)
      for (std::size_t lane = 0; lane < ground.size(); ++lane)
        for (unsigned int c = 0; c < 9; ++c)
          v[k * lanes + lane] -=
              half * view.inverse_mass[3 * k + c / 3] * view.of_ground[9 * (k / 3) + c] * ground[lane][c % 3];
  }

  void MotionBatch::advance(const std::vector<Vector3> &before, const std::vector<Vector3> &after)
  {
    using namespace BatchKernels;
    const auto kernel = VOUSSOIR_FOR_LANES(advance_any);
    BatchState state = {u.data(),   v.data(),     w.data(),       f.data(), d.data(),
                        gap.data(), moved.data(), impulse.data(), works,    {}};
    std::fill(impulse.begin(), impulse.end(), 0.f);
    for (unsigned int k = 0; k < model.n_steps; ++k)
    {
      const double share = double(k) / model.n_steps;
      for (unsigned int lane = 0; lane < lanes; ++lane)
        for (unsigned int c = 0; c < 3; ++c)
          state.ground[c * lanes + lane] = (1. - share) * before[lane][c] + share * after[lane][c];
      kernel(view, state);
    }
    now += model.dt;
  }

  void MotionBatch::read(const unsigned int lane, DynamicState &state,
                         const std::vector<unsigned int> *only) const
  {
    const auto read_component = [&](const std::size_t k)
    {
      state.u[k] = model.u_static[k] + u[k * lanes + lane];
      state.v[k] = v[k * lanes + lane];
    };
    state.u.resize(model.u_static.size());
    state.v.resize(state.u.size());
    if (only != nullptr)
      for (const unsigned int node : *only)
        for (unsigned int c = 0; c < 3; ++c)
          read_component(3 * std::size_t(node) + c);
    for (std::size_t k = 0; only == nullptr && k < state.u.size(); ++k)
      read_component(k);
    state.force.resize(3 * view.n_pairs);
    for (std::size_t q = 0; q < view.n_pairs; ++q)
    {
      const BatchPair &pair = view.pairs[q];
      double           f[3];
      for (unsigned int i = 0; i < 3; ++i)
        f[i] = impulse[(3 * q + i) * lanes + lane] / model.n_steps;
      set(state.force, q,
          {{f[0], pair.cosine * f[1] - pair.sine * f[2], pair.sine * f[1] + pair.cosine * f[2]}});
    }
    state.time = now;
    state.energy.input = works[0][lane];
    state.energy.strain = model.static_strain + works[1][lane];
    state.energy.impact = works[2][lane];
    state.energy.friction = works[3][lane];
  }

  void MotionBatch::find_joint_forces(float *force) const
  {
    const float share = 1.f / model.n_steps;
    for (std::size_t q = 0; q < view.n_pairs; ++q, force += 3 * lanes)
    {
      const float *f = impulse.data() + 3 * lanes * q, c = share * view.pairs[q].cosine,
                  s = share * view.pairs[q].sine;
      for (unsigned int lane = 0; lane < lanes; ++lane)
      {
        force[lane] = share * f[lane];
        force[lanes + lane] = c * f[lanes + lane] - s * f[2 * lanes + lane];
        force[2 * lanes + lane] = s * f[lanes + lane] + c * f[2 * lanes + lane];
      }
    }
  }

  double MotionBatch::kinetic_energy(const unsigned int lane) const
  {
    double sum = 0.;
    for (std::size_t i = 0; i < view.n_nodes; ++i)
    {
      Vector3 velocity;
      for (unsigned int c = 0; c < 3; ++c)
        velocity[c] = v[(3 * i + c) * lanes + lane];
      sum += .5 * dot(velocity, model.structure.mass[i] * velocity);
    }
    return sum;
  }

  LaneIntegrator::LaneIntegrator(const MotionBatch &batch, const BatchModel &model, const JointLaws &laws,
                                 const Unknowns &force, const unsigned int lane)
      : Integrator(model.structure, laws), batch(batch), model(model), lane(lane),
        states(model.structure.pairs.size(), PairState::open)
  {
    reference = model.closed;
    impulse.assign(3 * states.size(), 0.);
    batch.read(lane, now);
    now.force = force;
    first = now.energy;
  }

  void LaneIntegrator::read()
  {
    batch.read(lane, now, &model.nodes_of_pairs);
    read_forces();
  }

  void LaneIntegrator::read_all()
  {
    batch.read(lane, now);
    now.energy.kinetic = batch.kinetic_energy(lane);
    update_largest();
    read_forces();
  }

  void LaneIntegrator::read_forces()
  {
    for (std::size_t k = 0; k < impulse.size(); ++k)
      impulse[k] = model.dt * now.force[k];
    for (std::size_t p = 0; p < states.size(); ++p)
      states[p] = now.force[3 * p] > 0. ? PairState::stick : PairState::open;
  }

  ContactResult LaneIntegrator::advance(const Unknowns &, const Vector3 &)
  {
    throw std::logic_error("MotionBatch advances all lanes.");
  }
} // namespace Voussoir
