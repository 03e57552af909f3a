// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/app/memory_need.h>
#include <voussoir/base/error.h>
#include <voussoir/base/number_text.h>
#include <voussoir/base/ranks.h>
#include <voussoir/dam/dam.h>
#include <voussoir/joints/body_factor.h>
#include <voussoir/mesh/mesh_joints.h>
#include <voussoir/water/water_size.h>

#include <omp.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <new>
#include <numeric>
#include <set>
#include <sstream>

namespace Voussoir
{
  namespace
  {
    constexpr unsigned int none = static_cast<unsigned int>(-1);
    constexpr double       block = 9 * 8. + 4.; // of a sparse matrix: 3 x 3 numbers and a column [bytes]

    // Measured, see tests/program_memory.py [bytes].
    constexpr double program = 178e6, per_cell = 700., per_node = 700., per_rock_node = 2100.,
                     per_coarse = 900.; // static state, per rock node on the first rank, with Trilinos

    constexpr double seconds_per_water_node = 1.2e-5, ///< of the mesh
        seconds_per_water_step = 3e-8;                ///< of a time step, per node

    /** Factors from elements of degree 1 to elements of the given degree: number of nodes, of blocks of the
     * stiffness matrix, of entries of matrix factors, and squared number of nodes on surfaces. */
    struct Growth
    {
      explicit Growth(const unsigned int degree)
      {
        if (degree == 2)
          nodes = 8., blocks = 19., entries = 32., surface = 16.;
      }
      double nodes = 1., blocks = 1., entries = 1., surface = 1.;
    };

    /** Graph of the nodes of some cells. */
    struct Graph
    {
      std::vector<std::vector<unsigned int>> neighbours;   ///< neighbours of each node, with the node
      std::vector<bool>                      is_interface; ///< true for a node in a pair
      std::vector<unsigned int>              place;        ///< number of each node in the mesh
      double                                 n_blocks() const
      {
        double sum = 0.;
        for (const auto &row : neighbours)
          sum += row.size();
        return sum;
      }
    };

    /** Returns the graph of the cells for which @p counts is true, without the fixed nodes @p held. */
    Graph graph_of(const HexMesh &mesh, const std::function<bool(const HexMesh::Cell &)> &counts,
                   const std::vector<bool> &held, const std::vector<bool> &in_pair)
    {
      Graph                     graph;
      std::vector<unsigned int> number(mesh.nodes.size(), none);
      for (const HexMesh::Cell &cell : mesh.cells)
        for (unsigned int v = 0; v < 8 && counts(cell); ++v)
          if (const unsigned int node = cell.nodes[v]; !held[node] && number[node] == none)
          {
            number[node] = graph.neighbours.size();
            graph.neighbours.emplace_back();
            graph.is_interface.push_back(in_pair[node]);
            graph.place.push_back(node);
          }
      for (const HexMesh::Cell &cell : mesh.cells)
        if (counts(cell))
          for (const unsigned int a : cell.nodes)
            for (const unsigned int b : cell.nodes)
              if (number[a] != none && number[b] != none)
              {
                auto &row = graph.neighbours[number[a]];
                if (std::find(row.begin(), row.end(), number[b]) == row.end())
                  row.push_back(number[b]);
              }
      for (auto &row : graph.neighbours)
        std::sort(row.begin(), row.end());
      return graph;
    }

    /** Massless rock makes all nodes of the base neighbours. */
    void couple(const std::vector<bool> &on_base, Graph &graph)
    {
      std::vector<unsigned int> base;
      for (unsigned int i = 0; i < graph.place.size(); ++i)
        if (on_base[graph.place[i]])
          base.push_back(i);
      for (const unsigned int i : base)
      {
        std::vector<unsigned int> &row = graph.neighbours[i];
        row.insert(row.end(), base.begin(), base.end());
        std::sort(row.begin(), row.end());
        row.erase(std::unique(row.begin(), row.end()), row.end());
      }
    }

    std::vector<bool> nodes_on(const HexMesh &mesh, const std::function<bool(int)> &surface)
    {
      std::vector<bool> result(mesh.nodes.size(), false);
      for (const HexMesh::Face &face : mesh.faces)
        for (const unsigned int node : face.nodes)
          result[node] = result[node] || surface(face.surface);
      return result;
    }

    bool is_rock(const HexMesh::Cell &cell)
    {
      return !is_monolith(cell.volume);
    }

    /** Factors and joint operators of one size of steps, and what belongs to them. */
    struct Factors
    {
      double entries = 0.;   ///< of the factors
      double dense = 0.;     ///< of the interfaces' flexibilities, until W is there
      double kept = 0.;      ///< of these afterwards
      double operators = 0.; ///< of W
      double diagonal = 0.;  ///< of W's own blocks of the joints
      double base = 0.;      ///< elimination of the base nodes on subcycled or massless rock
      double share = 1.;     ///< of all except base, the largest of a rank
    };

    /** Numbers of BaseElimination: flexibility of the base nodes, its factor, and coupling of base nodes and joints. */
    double of_base(const Graph &body, const std::vector<bool> &on_base)
    {
      double base = 0., joints = 0.;
      for (unsigned int i = 0; i < body.place.size(); ++i)
        (on_base[body.place[i]] ? base : joints) += body.is_interface[i];
      return 9. * base * (2. * base + joints);
    }

    /** Returns the entries of the dense matrix of massless rock, which couples all base nodes, and of its
     * factor. */
    double of_dense_base(const std::vector<bool> &on_base)
    {
      const double unknowns = 3. * std::count(on_base.begin(), on_base.end(), true);
      return 2. * unknowns * unknowns;
    }

    /** @p m: unknowns of each joint. */
    void add_operator(const std::vector<Joint> &joints, const std::vector<double> &m, Factors &factors)
    {
      for (std::size_t j = 0; j < joints.size(); ++j)
        for (std::size_t k = j; k < joints.size(); ++k)
        {
          const Joint &a = joints[j], &b = joints[k];
          if ((a.block_1 == b.block_1 && !a.is_base()) || a.block_1 == b.block_2 || a.block_2 == b.block_1 ||
              a.block_2 == b.block_2)
            factors.operators += m[j] * m[k];
          if (j == k)
            factors.diagonal += m[j] * m[k];
        }
    }

    /** Unknowns of each joint: three for each node on its side 1, or on side 2 of a base joint. */
    std::vector<double> joint_unknowns(const HexMesh &opened, const std::vector<Joint> &joints,
                                       const std::vector<bool> &held)
    {
      std::vector<double> m;
      for (const Joint &joint : joints)
      {
        std::set<unsigned int> nodes;
        for (const HexMesh::Face &face : opened.faces)
          if (face.surface ==
              (joint.is_base() ? PhysicalId::joint_side_2 : PhysicalId::joint_side_1) + joint.number)
            for (const unsigned int node : face.nodes)
              if (!held[node])
                nodes.insert(node);
        m.push_back(3. * nodes.size());
      }
      return m;
    }

    bool all_tied(const Scene &scene, const std::vector<Joint> &joints)
    {
      return std::all_of(joints.begin(), joints.end(),
                         [&](const Joint &joint) { return scene.joints.model_of(joint) == "tied"; });
    }

    /** Returns the largest sum of a rank divided by the sum of all ranks [-]. */
    double largest_share(const std::vector<double> &of_body)
    {
      const Shares        shares(of_body);
      std::vector<double> of_rank(Ranks::size(), 0.);
      for (unsigned int b = 0; b < of_body.size(); ++b)
        of_rank[shares.are_trivial() ? 0 : shares.owner(b)] += of_body[b];
      const double sum = std::accumulate(of_body.begin(), of_body.end(), 0.);
      return sum > 0. ? *std::max_element(of_rank.begin(), of_rank.end()) / sum : 1.;
    }

    /** Returns the estimated number of nodes of the water. @p h: receives the element size of a generated channel [m], or
     * 0. */
    double water_nodes(const ReservoirParameters &reservoir, const HexMesh &mesh, double &h)
    {
      h = 0.;
      if (mesh.water != nullptr)
        return mesh.water->nodes.size();
      double area = 0., bottom = reservoir.level; // of the section below the water level
      for (const HexMesh::Face &face : mesh.faces)
        if (face.surface == PhysicalId::upstream)
        {
          const auto  &x = mesh.nodes;
          const auto  &n = face.nodes;
          const double whole = .5 * std::abs((x[n[2]][1] - x[n[0]][1]) * (x[n[3]][2] - x[n[1]][2]) -
                                             (x[n[2]][2] - x[n[0]][2]) * (x[n[3]][1] - x[n[1]][1]));
          double       low = 1e300, high = -1e300;
          for (const unsigned int node : n)
          {
            low = std::min(low, x[node][2]);
            high = std::max(high, x[node][2]);
          }
          area += whole * std::clamp((reservoir.level - low) / std::max(high - low, 1e-9), 0., 1.);
          bottom = std::min(bottom, low);
        }
      const double depth = reservoir.level - bottom;
      if (!(depth > 0.))
        return 0.;
      h = reservoir.element_size > 0. ? reservoir.element_size : depth / 16.;
      return channel_nodes(area, depth, reservoir.length, h);
    }

    /** Acoustic water: its nodes, and the reaction in the stiffness of the bodies. @p n_blocks: of the stiffness. */
    double of_water(const ReservoirParameters &reservoir, const HexMesh &mesh, const double n_blocks)
    {
      double h;
      return bytes_per_water_node * water_nodes(reservoir, mesh, h) + block * n_blocks;
    }

    /** Returns the memory of the matrices of the dam [bytes]. @p factors: receives the memory of its factors. */
    double of_dam(const Scene &scene, const HexMesh &mesh, Factors &factors)
    {
      const HexMesh            opened = open_joints(monoliths_only(mesh));
      const std::vector<Joint> joints = joints_of(opened);
      const bool               tied = all_tied(scene, joints);
      const HexMesh            dam = tied ? close_joints(opened) : opened;
      const bool massless = scene.foundation.model == "massless", one_body = Dam::is_one_body(scene, tied);
      const std::vector<bool> on_base =
          nodes_on(dam, [](const int surface) { return surface == PhysicalId::base; });
      const std::vector<bool> held =
          scene.foundation.model == "rigid" ? on_base : std::vector<bool>(dam.nodes.size(), false);
      const bool coupled =
          (scene.foundation.model == "rock" && scene.foundation.is_subcycled()) || (massless && !one_body);
      const std::vector<bool> in_pair =
          nodes_on(dam, [&](const int surface)
                   { return is_joint_side(surface) || (coupled && surface == PhysicalId::base); });
      std::set<int> volumes;
      for (const HexMesh::Cell &cell : dam.cells)
        volumes.insert(tied || (massless && one_body) ? 1 : cell.volume);
      const Growth        growth(scene.elements.degree);
      double              n_nodes = 0., n_blocks = 0.;
      const bool          single = scene.has_single_factors() && !coupled;
      std::vector<double> of_body; // memory per body, distributed to the ranks
      double              largest_factor = 0.;
      for (const int volume : volumes)
      {
        Graph graph = graph_of(
            dam, [&](const HexMesh::Cell &cell) { return volumes.size() == 1 || cell.volume == volume; },
            held, in_pair);
        if (massless && one_body)
          couple(on_base, graph);
        FactorSize size = factor_size(graph.neighbours, graph.is_interface, single);
        if (scene.reservoir.is_acoustic())
          size.entries *= 1.2; // the water couples nodes of the upstream face
        factors.entries += growth.entries * size.entries;
        largest_factor = std::max(largest_factor, growth.entries * size.entries);
        factors.dense += growth.surface * size.interface;
        factors.kept += growth.surface * size.kept;
        of_body.push_back(growth.entries * size.entries + growth.surface * (size.kept + 2. * size.interface));
        if (coupled)
          factors.base += of_base(graph, on_base);
        n_nodes += growth.nodes * graph.neighbours.size();
        n_blocks += growth.blocks * graph.n_blocks();
      }
      if (single) // those in hand are made in double precision, one by each thread
        factors.entries += largest_factor * std::min<std::size_t>(of_body.size(), omp_get_max_threads());
      factors.share = largest_share(of_body);
      if (massless && coupled)
        factors.base += of_dense_base(on_base);
      if (!tied)
        add_operator(joints, joint_unknowns(dam, joints, coupled ? on_base : held), factors);
      factors.operators *= growth.surface;
      factors.diagonal *= growth.surface;
      if (coupled && !tied)
        factors.base += factors.operators; // a second one during the elimination
      const double water = scene.reservoir.is_acoustic() ? of_water(scene.reservoir, dam, n_blocks) : 0.;
      return 2. * block * n_blocks + per_cell * dam.cells.size() + per_node * n_nodes +
             water; // stiffness, stress
    }

    /** Massless rock, while it is condensed: its stiffness, its factor, and what is dense at the base. */
    double of_massless_rock(const HexMesh &mesh, const unsigned int degree)
    {
      const auto nodes = [&](const int id)
      { return nodes_on(mesh, [&](const int surface) { return surface == id; }); };
      const Graph      rock = graph_of(mesh, is_rock, nodes(PhysicalId::artificial), nodes(PhysicalId::base));
      const FactorSize size = factor_size(rock.neighbours, rock.is_interface, false);
      const Growth     growth(degree);
      return growth.blocks * block * rock.n_blocks() +
             8. * (growth.entries * size.leading + growth.surface * 3. * size.interface);
    }

    /** Rock with mass: its stiffness and, at the peak, the static state, of which the first rank has the
     * coarse levels; @p others receives that of each other rank. */
    double of_rock(const Scene &scene, const HexMesh &mesh, double &others)
    {
      const std::vector<bool> no(mesh.nodes.size(), false);
      const Graph             rock = graph_of(mesh, is_rock, no, no);
      double                  n_blocks = rock.n_blocks();
      if (scene.foundation.nodal_everywhere) // does not couple the ends of a cell's diagonals
        n_blocks -= 8. * std::count_if(mesh.cells.begin(), mesh.cells.end(), is_rock);
      const double part = 1. / Ranks::size(), matrix = block * n_blocks; // kept of it: see make_rock_part()
      constexpr unsigned int few = 10;                                   // layers, whose rows all ranks keep
      const bool       is_shared = scene.foundation.nodal_everywhere && scene.foundation.layers_at_dam <= few;
      const double     kept = is_shared ? std::min(1., part + .13) : 1.;
      constexpr double per_memory = 144.; // of a quality factor, per node
      const double     per_node = per_rock_node + (scene.foundation.quality > 0. ? per_memory : 0.);
      const double     all = per_node * rock.neighbours.size() - (1. - kept) * matrix;
      others = all + .1 * matrix;
      return all + (.15 + .4 * part) * matrix + per_coarse * rock.neighbours.size();
    }
  } // namespace

  MemoryNeed memory_need(const Scene &scene, const HexMesh &mesh)
  {
    Factors      factors;
    MemoryNeed   need;
    const double dam = of_dam(scene, mesh, factors);
    // The operator is also stored in single precision (at most four bytes), as are inverses and LU factors of the
    // joints' blocks.
    need.halved_step =
        factors.share *
            (8. * factors.entries + std::max(8. * factors.dense, 8. * factors.kept + 12. * factors.operators +
                                                                     8. * factors.diagonal)) +
        8. * factors.base;
    need.run = need.of_others = program + dam + need.halved_step;
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

  void check_water_size(const Scene &scene, const double dt, Log &log)
  {
    const ReservoirParameters &reservoir = scene.reservoir;
    double                     h = 0.;
    const double               n = reservoir.is_meshed() ? water_nodes(reservoir, scene.hex_mesh(), h) : 0.;
    if (h == 0.) // no generated channel
      return;
    constexpr double gib = 1024. * 1024. * 1024.;
    const double     memory = double(sysconf(_SC_PHYS_PAGES)) * sysconf(_SC_PAGESIZE),
                 bytes = n * bytes_per_water_node, step = h / (1.02 * reservoir.sound_speed),
                 factor = std::pow(dt / step, 2); // of the mass of cubes
    char size[120];
    std::snprintf(size, sizeof(size), "elements of %.3g m: about %.3g nodes, %.2g GiB", h, n, bytes / gib);
    if (bytes > memory)
      throw InputError(std::string("Mesh of the water: ") + size + ", more than the " +
                       number_text(std::floor(memory / gib)) +
                       " GiB of this computer. Increase Reservoir/Element size, or reduce Reservoir/Length. "
                       "The defaults are a sixteenth of the depth, and two depths.");
    if (n > 1e5 && reservoir.is_acoustic() && factor > 2. * largest_mass_factor)
    {
      const double       more = 1.1 * std::sqrt(factor / largest_mass_factor);
      std::ostringstream text;
      text.precision(3);
      text << "Compressible water: the time step of " << dt
           << " s is above the critical time step of the water, about " << step << " s (" << size
           << "). It would need about " << factor
           << " times the mass of the water (limit 1.3). Set \"Dynamics/Steps per sample\" to "
           << std::ceil(more) * scene.steps_per_sample << ", or \"Reservoir/Element size\" to " << more * h
           << ".";
      throw InputError(text.str());
    }
    if (n > 1e6)
      log.line("Water     %s; the mesh takes about %.0f s, a time step %.1g s", size,
               seconds_per_water_node * n, seconds_per_water_step * n);
  }

  std::string in_words(const MemoryNeed &need)
  {
    constexpr double gib = 1024. * 1024. * 1024.;
    char             others[60] = "", text[200];
    if (Ranks::size() > 1)
      std::snprintf(others, sizeof(others), " for the first rank, %.2f GiB for each other one",
                    need.of_others / gib);
    std::snprintf(text, sizeof(text),
                  "about %.2f GiB%s, and %.2f GiB more for each divided time step that the joints require",
                  need.run / gib, others, need.halved_step / gib);
    return text;
  }

  std::string not_enough_memory(const Scene &scene)
  {
    try
    {
      return "There is not enough memory: this scene needs " +
             in_words(memory_need(scene, scene.hex_mesh())) +
             ". Use fewer elements, or a computer with more memory.";
    }
    catch (const std::bad_alloc &)
    {
      return "There is not enough memory, not even for the mesh. Use fewer elements.";
    }
  }
} // namespace Voussoir
