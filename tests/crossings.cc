// SPDX-License-Identifier: GPL-3.0-or-later
// Joints that cross: one copy of a node per block, redundant conditions of the pairs, impacts of four blocks that share
// an edge, and the preconditioner with clusters of pairs.

#include "blocks.h"

#include <voussoir/dynamics/impact.h>
#include <voussoir/mesh/mesh_joints.h>

#include <random>

using namespace Columns;

namespace
{
  /** A wall of monoliths of lifts; each block has n x n x n elements of random shape. */
  HexMesh wall(const unsigned int n, const unsigned int monoliths, const unsigned int lifts)
  {
    std::mt19937 engine(3);
    const auto   noise = [&](const unsigned int k)
    { return k % n == 0 ? 0. : .2 * (engine() / 4294967296. - .5); };
    const Grids::Brick brick{{n, monoliths * n, lifts * n}};
    HexMesh            mesh = brick.mesh(
        [&](const unsigned int i, const unsigned int j, const unsigned int k) {
          return Vector3{{3. * i + noise(i), 3. * j + noise(j), 3. * k + noise(k)}};
        },
        [&](unsigned int, const unsigned int j, const unsigned int k)
        { return static_cast<int>(1 + j / n + k / n * PhysicalId::per_lift); });
    for (unsigned int c = 0; c < n * monoliths * n; ++c)
    {
      HexMesh::Face face{{}, PhysicalId::base};
      for (unsigned int v = 0; v < 4; ++v)
        face.nodes[v] = mesh.cells[c].nodes[hex_faces[0][v]];
      mesh.faces.push_back(face);
    }
    return open_joints(mesh);
  }

  struct Blocks
  {
    Blocks(const HexMesh &mesh, const double friction, const bool compliant)
        : opened(mesh), joints(joints_of(opened)), model(opened, 1),
          structure(assemble_structure(model, {Material()}, true))
    {
      structure.n_joints = joints.size();
      structure.pairs = find_pairs(model, joints.size());
      structure.clusters = clusters_of(structure.pairs);
      structure.collect_interfaces();
      LawParameters parameters(friction);
      for (std::size_t j = 0; j < joints.size(); ++j)
        laws.of_joint.push_back(make_joint_law("FJA", parameters));
      parameters.normal_stiffness = parameters.tangential_stiffness = 5. * Material().young / 3.;
      for (std::size_t j = 0; j < joints.size() && compliant; ++j)
        laws.of_crossings.push_back(make_joint_law("FJA", parameters));
      laws.assign(structure);
      StepOperator step;
      step.mass = 4. / (.01 * .01);
      step.share = 2.;
      system = std::make_unique<JointSystem>(structure, laws, tight(), step);
    }

    double kinetic(const Unknowns &v) const
    {
      double sum = 0.;
      for (unsigned int i = 0; i < structure.n_nodes(); ++i)
        sum += .5 * dot(get(v, i), structure.mass[i] * get(v, i));
      return sum;
    }

    const HexMesh                opened;
    const std::vector<Joint>     joints;
    SolidModel                   model;
    Structure                    structure;
    JointLaws                    laws;
    std::unique_ptr<JointSystem> system;
  };

  void graph()
  {
    const Blocks blocks(wall(2, 2, 2), .5, false);
    std::string  names;
    for (const Joint &joint : blocks.joints)
      names += joint.name() + ", ";
    report("joints: " + names, blocks.joints.size(), "4",
           names == "joint 1, lift 1.1, joint 1.2, lift 2.1, ");
    report("clusters along the edge", blocks.structure.clusters.size(), "3",
           blocks.structure.clusters.size() == 3);
    bool four = true;
    for (const auto &cluster : blocks.structure.clusters)
      four = four && cluster.size() == 4;
    report("four pairs each", four, "true", four);
    double up = 0.;
    for (const Pair &pair : blocks.structure.pairs)
      if (blocks.joints[pair.joint].is_lift())
        up = std::max(up, std::abs(pair.frame[0][2] - 1.));
    below("normals of lift joints point upwards", up, 1e-12);
    HexMesh closed = close_joints(blocks.opened);
    report("nodes after closing", closed.nodes.size(), "75", closed.nodes.size() == 75);
  }

  /** Velocities after an impact of closed pairs satisfy Coulomb's law together, and never gain energy. */
  void impacts()
  {
    std::mt19937 engine(11);
    const auto   random = [&] { return engine() / 2147483648. - 1.; };
    unsigned int n_clusters = 0, n_exact = 0;
    double       gain = 0., of_single = 0.;
    for (unsigned int run = 0; run < 100; ++run)
    {
      Blocks         blocks(wall(2, 2, 2), 2. * run / 99., false);
      const Unknowns zero(3 * blocks.structure.pairs.size(), 0.);
      Unknowns       overlap = zero, force = zero, gap, u, memory, v(3 * blocks.structure.n_nodes());
      for (std::size_t p = 0; p < blocks.structure.pairs.size(); ++p)
        overlap[3 * p] = -1e-4;
      blocks.system->solve(Unknowns(v.size(), 0.), overlap, zero, memory, force, gap, u);
      for (double &x : v)
        x = random();
      const double before = blocks.kinetic(v);
      Unknowns     impulse = zero;
      Impact(blocks.structure, blocks.laws, ImpactRule::mean_force)
          .correct_velocity(*blocks.system, blocks.laws.histories(zero, true, memory), .01, zero, v, impulse);
      gain = std::max(gain, blocks.kinetic(v) / before - 1.);
      const auto error = [&](const unsigned int p)
      {
        const Vector3 r = get(impulse, p), jump = blocks.structure.jump(blocks.structure.pairs[p], v);
        return norm(blocks.laws.of_pair[p]->error(r, jump, PairHistory(), 1e4)) / 1e4;
      };
      std::vector<bool> in_cluster(blocks.structure.pairs.size(), false);
      for (const auto &cluster : blocks.structure.clusters)
      {
        double worst = 0.;
        for (const unsigned int p : cluster)
        {
          worst = std::max(worst, error(p));
          in_cluster[p] = true;
        }
        ++n_clusters;
        n_exact += worst < 1e-6;
      }
      for (unsigned int p = 0; p < in_cluster.size(); ++p)
        if (!in_cluster[p] && blocks.system->states()[p] != PairState::open)
          of_single = std::max(of_single, error(p));
    }
    report("clusters of four blocks that satisfy Coulomb's law after the impact", n_exact,
           "98 % of " + text(n_clusters), n_exact >= .98 * n_clusters);
    below("largest error of pairs that share no node", of_single, 1e-10);
    below("largest gain of kinetic energy", gain, 1e-12);
  }

  /** Joint forces with the compliance of crossings: few iterations, and the same result for any first guess. */
  void solver()
  {
    Blocks         blocks(wall(2, 6, 4), .6, true);
    const Unknowns zero(3 * blocks.structure.pairs.size(), 0.);
    std::mt19937   engine(5);
    ContactResult  sum;
    double         difference = 0.;
    for (unsigned int run = 0; run < 20; ++run)
    {
      Unknowns load(3 * blocks.structure.n_nodes()), offset = zero, force = zero, gap, u,
                                                     memory = blocks.laws.initial_memory();
      for (std::size_t k = 0; k < load.size(); ++k)
        load[k] = 1e6 * (engine() / 2147483648. - 1.);
      for (std::size_t p = 0; p < blocks.structure.pairs.size(); ++p)
        offset[3 * p] = 2e-5 * (engine() / 2147483648. - 1.2);
      const ContactResult result = blocks.system->solve(load, offset, zero, memory, force, gap, u);
      report("run " + text(run) + " converges", result.residual, "1e-13", result.converged);
      sum += result;
      Unknowns other = force, v;
      for (double &f : other)
        f += 1e5 * (engine() / 2147483648. - 1.);
      blocks.system->solve(load, offset, zero, memory, other, gap, v);
      for (std::size_t k = 0; k < u.size(); ++k)
        difference = std::max(difference, std::abs(u[k] - v[k]) / largest(u));
    }
    below("difference of displacements for another first guess", difference, 1e-8);
    below("GMRES iterations per Newton step", double(sum.krylov) / sum.iterations, 7.5);
  }
} // namespace

namespace
{
  /** The sequence of the pairs of a cluster, on which iterations depend, is that of their inclination. */
  void sequence()
  {
    Structure structure = Blocks(wall(2, 3, 2), .5, false).structure;
    std::reverse(structure.pairs.begin(), structure.pairs.end());
    unsigned int wrong = 0, n = 0;
    for (const auto &cluster : PairClusters(structure).clusters)
      for (std::size_t i = 0; i + 1 < cluster.pairs.size(); ++i, ++n)
        wrong += std::abs(structure.pairs[cluster.pairs[i]].frame[0][2]) >
                 std::abs(structure.pairs[cluster.pairs[i + 1]].frame[0][2]) + 1e-5;
    report("clusters of reversed pairs: neighbours in another sequence, of " + std::to_string(n), wrong, "0",
           n > 0 && wrong == 0);
  }
} // namespace

int main()
{
  return run_all({graph, impacts, solver, sequence});
}
