// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/app/memory_need.h>
#include <voussoir/base/ranks.h>
#include <voussoir/dam/dam.h>
#include <voussoir/joints/body_factor.h>
#include <voussoir/mesh/mesh_joints.h>
#include <voussoir/mesh/mesh_source.h>

#include <omp.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <new>
#include <numeric>
#include <set>

namespace Voussoir
{
  namespace
  {
    constexpr double block = 9 * 8. + 4.; // of a sparse matrix: 3 x 3 numbers and a column [bytes]

    // Measured, see tests/program_memory.py [bytes].
    constexpr double program = 178e6, per_cell = 700., per_node = 700., per_rock_node = 2100.;

    /** Factors of what there is with elements of degree 2: nodes, blocks, entries of the factors, and squares
     * of what lies on surfaces. */
    struct Growth
    {
      double nodes, blocks, entries, surface;
    };
    Growth growth_of(const unsigned int degree)
    {
      return degree == 2 ? Growth{8., 19., 32., 16.} : Growth{1., 1., 1., 1.};
    }

    bool is_rock(const HexMesh::Cell &cell)
    {
      return !is_monolith(cell.volume);
    }

    std::vector<bool> nodes_on(const HexMesh &mesh, const std::function<bool(int)> &surface)
    {
      std::vector<bool> result(mesh.nodes.size(), false);
      for (const HexMesh::Face &face : mesh.faces)
        for (const unsigned int node : face.nodes)
          result[node] = result[node] || surface(face.surface);
      return result;
    }

    std::vector<bool> nodes_on(const HexMesh &mesh, const int id)
    {
      return nodes_on(mesh, [&](const int surface) { return surface == id; });
    }

    /** Neighbours of the nodes of some cells, and which nodes are in pairs. */
    struct Graph
    {
      std::vector<std::vector<unsigned int>> neighbours;
      std::vector<bool>                      is_interface;
      double n_blocks = 0., n_feet = 0.; ///< feet: interface nodes of the base
    };

    /** Returns the graph of the cells that @p counts, without the nodes that are @p held. */
    Graph graph_of(const HexMesh &mesh, const std::function<bool(const HexMesh::Cell &)> &counts,
                   const std::vector<bool> &held, const std::vector<bool> &in_pair,
                   const std::vector<bool> &on_base)
    {
      Graph                     graph;
      constexpr unsigned int    none = static_cast<unsigned int>(-1);
      std::vector<unsigned int> number(mesh.nodes.size(), none);
      for (const HexMesh::Cell &cell : mesh.cells)
        for (unsigned int v = 0; v < 8 && counts(cell); ++v)
          if (const unsigned int node = cell.nodes[v]; !held[node] && number[node] == none)
          {
            number[node] = graph.neighbours.size();
            graph.neighbours.emplace_back();
            graph.is_interface.push_back(in_pair[node]);
            graph.n_feet += in_pair[node] && on_base[node];
          }
      for (const HexMesh::Cell &cell : mesh.cells)
        for (unsigned int v = 0; v < 8 && counts(cell); ++v)
          if (const unsigned int i = number[cell.nodes[v]]; i != none)
            for (const unsigned int node : cell.nodes)
              if (number[node] != none)
                graph.neighbours[i].push_back(number[node]);
      for (auto &row : graph.neighbours)
      {
        std::sort(row.begin(), row.end());
        row.erase(std::unique(row.begin(), row.end()), row.end());
        graph.n_blocks += row.size();
      }
      return graph;
    }

    /** Entries of factors and joint operators of one size of steps [8 bytes]. */
    struct Factors
    {
      double entries = 0., dense = 0.,
             kept = 0.; ///< of the factors; flexibilities of interfaces before and after W
      double operators = 0., diagonal = 0.; ///< of W, and of its blocks of single joints
      double feet = 0.;                     ///< of the elimination of feet
      double share = 1.;                    ///< largest share of a rank, of all but the feet
    };

    /** Adds the joint operator. @p held: nodes without unknowns. */
    void add_operator(const HexMesh &opened, const std::vector<Joint> &joints, const std::vector<bool> &held,
                      const double growth, Factors &factors)
    {
      std::vector<double> m; // unknowns of each joint: three per node on its side 1
      for (const Joint &joint : joints)
      {
        const std::vector<bool> on_side = nodes_on(opened, PhysicalId::joint_side_1 + joint.number);
        m.push_back(0.);
        for (std::size_t i = 0; i < held.size(); ++i)
          m.back() += on_side[i] && !held[i] ? 3. : 0.;
      }
      for (std::size_t j = 0; j < joints.size(); ++j)
      {
        factors.diagonal += growth * m[j] * m[j];
        for (std::size_t k = j; k < joints.size(); ++k)
        {
          const Joint &a = joints[j], &b = joints[k];
          if (a.monolith_1 == b.monolith_1 || a.monolith_1 == b.monolith_2 || a.monolith_2 == b.monolith_1 ||
              a.monolith_2 == b.monolith_2)
            factors.operators += growth * m[j] * m[k];
        }
      }
    }

    /** Returns the largest sum of @p of_body of a rank, divided by the sum of all. */
    double largest_share(const std::vector<double> &of_body)
    {
      const Shares        shares(of_body);
      std::vector<double> of_rank(Ranks::size(), 0.);
      for (unsigned int b = 0; b < of_body.size(); ++b)
        of_rank[shares.are_trivial() ? 0 : shares.owner(b)] += of_body[b];
      const double sum = std::accumulate(of_body.begin(), of_body.end(), 0.);
      return sum > 0. ? *std::max_element(of_rank.begin(), of_rank.end()) / sum : 1.;
    }

    /** Returns the memory of the dam's matrices [bytes], and its factors in @p factors. */
    double of_dam(const Scene &scene, const HexMesh &mesh, Factors &factors)
    {
      const FoundationParameters &p = scene.foundation;
      const HexMesh               opened = open_joints(monoliths_only(mesh));
      const std::vector<Joint>    joints = joints_of(opened);
      const bool                  tied =
          std::all_of(joints.begin(), joints.end(),
                      [&](const Joint &joint) { return scene.joints.model_of(joint.number) == "tied"; });
      const HexMesh           dam = tied ? close_joints(opened) : opened;
      const bool              massless = p.model == "massless", one_body = Dam::is_one_body(scene, tied);
      const bool              led = (p.model == "rock" && p.has_own_steps()) || (massless && !one_body);
      const std::vector<bool> on_base = nodes_on(dam, PhysicalId::base),
                              held = p.model == "rigid" ? on_base : std::vector<bool>(on_base.size(), false),
                              in_pair = nodes_on(
                                  dam, [&](const int surface)
                                  { return is_joint_side(surface) || (led && surface == PhysicalId::base); });
      std::set<int> volumes;
      for (const HexMesh::Cell &cell : dam.cells)
        volumes.insert(tied || (massless && one_body) ? 1 : cell.volume);
      const Growth        growth = growth_of(scene.elements.degree);
      const bool          single = scene.has_single_factors() && !led;
      double              bytes = per_cell * dam.cells.size(), largest_factor = 0.;
      std::vector<double> of_body; // distributed over the ranks
      for (const int volume : volumes)
      {
        const Graph graph = graph_of(
            dam, [&](const HexMesh::Cell &cell) { return volumes.size() == 1 || cell.volume == volume; },
            held, in_pair, on_base);
        const FactorSize size = factor_size(graph.neighbours, graph.is_interface, single);
        const double     entries = growth.entries * size.entries;
        factors.entries += entries;
        largest_factor = std::max(largest_factor, entries);
        factors.dense += growth.surface * size.interface;
        factors.kept += growth.surface * size.kept;
        of_body.push_back(entries + growth.surface * (size.kept + 2. * size.interface));
        if (led)
        {
          const double m = std::count(graph.is_interface.begin(), graph.is_interface.end(), true);
          factors.feet += 9. * graph.n_feet * (graph.n_feet + m);
        }
        // Stiffness, a second matrix, and stresses.
        bytes +=
            2. * block * growth.blocks * graph.n_blocks + per_node * growth.nodes * graph.neighbours.size();
      }
      if (single) // each thread computes one factor in double precision at a time
        factors.entries += largest_factor * std::min<std::size_t>(of_body.size(), omp_get_max_threads());
      factors.share = largest_share(of_body);
      if (massless && led) // couples all feet: their elimination and its factor
        factors.feet += 18. * std::pow(std::count(on_base.begin(), on_base.end(), true), 2);
      if (!tied)
        add_operator(dam, joints, led ? on_base : held, growth.surface, factors);
      if (led && !tied)
        factors.feet += factors.operators; // a second operator during the elimination of the feet
      return bytes;
    }

    /** Returns the memory of massless rock during its condensation: stiffness, factor, dense matrices of the
     * base [bytes]. */
    double of_massless_rock(const HexMesh &mesh, const unsigned int degree)
    {
      const std::vector<bool> base = nodes_on(mesh, PhysicalId::base);
      const Graph      rock = graph_of(mesh, is_rock, nodes_on(mesh, PhysicalId::artificial), base, base);
      const FactorSize size = factor_size(rock.neighbours, rock.is_interface, false);
      const Growth     growth = growth_of(degree);
      return growth.blocks * block * rock.n_blocks +
             8. * (growth.entries * size.leading + growth.surface * 3. * size.interface);
    }

    /** Returns the memory of rock with mass [bytes]: its stiffness and, at the peak, the static state, whose
     * coarse levels are on the first rank. @p others: memory of each other rank. */
    double of_rock(const Scene &scene, const HexMesh &mesh, double &others)
    {
      const std::vector<bool> no(mesh.nodes.size(), false);
      const Graph             rock = graph_of(mesh, is_rock, no, no, no);
      double                  n_blocks = rock.n_blocks;
      if (scene.foundation.nodal_everywhere) // does not couple the ends of a cell's diagonals
        n_blocks -= 8. * std::count_if(mesh.cells.begin(), mesh.cells.end(), is_rock);
      const double part = 1. / Ranks::size(), matrix = block * n_blocks; // kept of it: see make_rock_part()
      const bool   is_shared = scene.foundation.nodal_everywhere && scene.foundation.layers_at_dam <= 10;
      const double kept = is_shared ? std::min(1., part + .13) : 1.;
      const double all = per_rock_node * rock.neighbours.size() - (1. - kept) * matrix;
      others = all + .1 * matrix;
      return all + (.15 + .4 * part) * matrix;
    }
  } // namespace

  MemoryNeed memory_need(const Scene &scene, const HexMesh &mesh)
  {
    Factors      factors;
    MemoryNeed   need;
    const double dam = of_dam(scene, mesh, factors);
    // Of the operator also single precision; inverses and LU factors of the joints' blocks in that, too.
    need.halved_step =
        factors.share *
            (8. * factors.entries + std::max(8. * factors.dense, 8. * factors.kept + 12. * factors.operators +
                                                                     8. * factors.diagonal)) +
        8. * factors.feet;
    need.run = need.of_others = program + dam + need.halved_step * (scene.error_estimate ? 2. : 1.);
    if (scene.foundation.model == "rock")
    {
      double others = 0.;
      need.run += of_rock(scene, mesh, others);
      need.of_others += others;
    }
    else if (scene.foundation.model == "massless") // before the dam has factors
      need.run = need.of_others =
          std::max(need.run, program + dam + of_massless_rock(mesh, scene.elements.degree));
    return need;
  }

  std::string in_words(const MemoryNeed &need)
  {
    constexpr double gib = 1024. * 1024. * 1024.;
    char             others[60] = "", text[200];
    if (Ranks::size() > 1)
      std::snprintf(others, sizeof(others), " for the first rank, %.2f GiB for each other one",
                    need.of_others / gib);
    std::snprintf(text, sizeof(text), "about %.2f GiB%s, and %.2f GiB more for each halving of a step",
                  need.run / gib, others, need.halved_step / gib);
    return text;
  }

  std::string not_enough_memory(const Scene &scene)
  {
    try
    {
      return "There is not enough memory: this scene needs " +
             in_words(memory_need(scene, make_mesh(scene.mesh, scene.directory))) +
             ". Use fewer elements, or a machine that has as much.";
    }
    catch (const std::bad_alloc &)
    {
      return "There is not enough memory, not even for the mesh. Use fewer elements.";
    }
  }
} // namespace Voussoir
