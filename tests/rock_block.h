// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_tests_rock_block_h
#define voussoir_tests_rock_block_h

#include "column.h"

#include <voussoir/foundation/subcycled_rock.h>
#include <voussoir/joints/pairs.h>
#include <voussoir/mesh/mesh_joints.h>
#include <voussoir/motion/motion.h>

#include <set>

/** A block that is the dam on a box of rock, of one material: implicit dam on explicit rock as the program
 * runs it, and one implicit body of the same elements. */
namespace Blocks
{
  using namespace Voussoir;

  constexpr double cell = 10.;             ///< [m]
  constexpr int    half_dam = 1;           ///< cells from the middle, along x and y
  constexpr int    dam_height = 3;         ///< cells
  const Material   rock{15e9, .25, 2700.}; // c_p = 2582 m/s, c_s = 1491 m/s; critical time step about 3 ms

  /** Acceleration of the mass at the dam's top for which the force on it is enough [m/s^2]: with a net
   * impulse, so that a boundary which drifts shows it. */
  inline double pulse(const double t, const double length)
  {
    return t < length ? std::pow(std::sin(Columns::pi * t / length), 2) : 0.;
  }

  /** Rock below z = 0, a block that is the dam on it. A first place of 0 in x or y is a plane of symmetry. */
  struct Ground
  {
    std::vector<double> x, y, z; ///< places of the grid planes; z of the rock only, ascending to 0

    bool is_plane_of_symmetry(const unsigned int direction) const
    {
      return (direction == 0 ? x : y).front() == 0.;
    }
  };

  /** Dam and rock, or the dam alone: of one monolith, or of two that meet at x = 0. */
  inline HexMesh make_mesh(const Ground &ground, const bool with_rock, const bool cut)
  {
    std::vector<double> z = ground.z;
    for (int k = 1; k <= dam_height; ++k)
      z.push_back(k * cell);
    const std::array<std::size_t, 3> n = {{ground.x.size() - 1, ground.y.size() - 1, z.size() - 1}};
    const std::size_t                n_rock = ground.z.size() - 1;
    const auto                       in_dam = [&](const std::vector<double> &p, const std::size_t i)
    { return std::abs(.5 * (p[i] + p[i + 1])) < half_dam * cell; };
    HexMesh                                            mesh;
    std::map<std::array<std::size_t, 3>, unsigned int> number;
    const auto node = [&](const std::size_t i, const std::size_t j, const std::size_t k)
    {
      const auto [entry, is_new] = number.try_emplace({{i, j, k}}, mesh.nodes.size());
      if (is_new)
        mesh.nodes.push_back({{ground.x[i], ground.y[j], z[k]}});
      return entry->second;
    };
    for (std::size_t k = with_rock ? 0 : n_rock; k < n[2]; ++k)
      for (std::size_t j = 0; j < n[1]; ++j)
        for (std::size_t i = 0; i < n[0]; ++i)
        {
          const bool is_rock = k < n_rock, at_dam = in_dam(ground.x, i) && in_dam(ground.y, j);
          if (!is_rock && !at_dam)
            continue;
          HexMesh::Cell c{{}, is_rock ? PhysicalId::first_rock : cut && ground.x[i] >= 0. ? 2 : 1};
          for (unsigned int v = 0; v < 8; ++v)
            c.nodes[v] = node(i + (v % 4 == 1 || v % 4 == 2), j + (v % 4 > 1), k + (v > 3));
          mesh.cells.push_back(c);
          const auto add = [&](const bool is_there, const unsigned int face, const int surface)
          {
            if (!is_there)
              return;
            HexMesh::Face f{{}, surface};
            for (unsigned int v = 0; v < 4; ++v)
              f.nodes[v] = c.nodes[hex_faces[face][v]];
            mesh.faces.push_back(f);
          };
          add(k == n_rock, 0, PhysicalId::base);
          add(k + 1 == n_rock && !at_dam, 1, PhysicalId::free_surface);
          add(is_rock && k == 0, 0, PhysicalId::artificial);
          add(is_rock && j == 0 && !ground.is_plane_of_symmetry(1), 2, PhysicalId::artificial);
          add(is_rock && i + 1 == n[0], 3, PhysicalId::artificial);
          add(is_rock && j + 1 == n[1], 4, PhysicalId::artificial);
          add(is_rock && i == 0 && !ground.is_plane_of_symmetry(0), 5, PhysicalId::artificial);
        }
    check_mesh(mesh, "test");
    return mesh;
  }

  /** The whole box with @p n cells of rock beside and below the dam. */
  inline Ground box(const int n)
  {
    Ground ground;
    for (int i = -n - half_dam; i <= n + half_dam; ++i)
      ground.x.push_back(i * cell);
    ground.y = ground.x;
    for (int k = -n; k <= 0; ++k)
      ground.z.push_back(k * cell);
    return ground;
  }

  /** A quarter: the same cells, then cells each larger by @p growth than the last one, to the distance @p
   * far. */
  inline Ground quarter(const int n, const double growth = 1., const double far = 0.)
  {
    const auto places = [&](const int equal)
    {
      std::vector<double> p;
      for (int i = 0; i <= equal; ++i)
        p.push_back(i * cell);
      for (double h = cell * growth; p.back() < far; h *= growth)
        p.push_back(p.back() + h);
      return p;
    };
    Ground ground;
    ground.x = ground.y = places(n + half_dam);
    ground.z = places(n);
    std::reverse(ground.z.begin(), ground.z.end());
    for (double &z : ground.z)
      z = -z;
    return ground;
  }

  /** Of a corner of the dam: displacements at top and foot, step by step from t = 0 [m]. */
  struct History
  {
    std::vector<Vector3> top, foot;
  };

  struct Dam
  {
    SolidModel   model;
    Structure    structure;
    JointLaws    laws;
    unsigned int top = 0, foot = 0; ///< equations

    Dam(const HexMesh &mesh, const double stiffness_damping, const bool led = false,
        const std::string &law = "tied")
        : model(mesh, 1)
    {
      model.free_base();
      structure = assemble_structure(model, {rock}, true);
      structure.damping.stiffness = stiffness_damping;
      structure.n_joints = model.n_bodies() - 1;
      for (const Pair &pair : find_pairs(model, structure.n_joints))
        if (!led || pair.place[2] > .5 * cell)
          structure.pairs.push_back(pair);
      structure.collect_interfaces();
      laws = Columns::make_laws(structure, law, .6);
      const auto corner = [&](const double z)
      {
        for (unsigned int i = 0; i < model.n_nodes(); ++i)
          if (distance_between(model.points[i], {{half_dam * cell, half_dam * cell, z}}) < 1e-6)
            return model.equation[i];
        throw std::runtime_error("the dam has no such corner");
      };
      top = corner(dam_height * cell);
      foot = corner(0.);
    }

    /** Load per unit of the pulse [N]. */
    Unknowns load(const Vector3 &direction) const
    {
      Unknowns f(3 * structure.n_nodes(), 0.);
      for (unsigned int i = 0; i < model.n_nodes(); ++i)
        if (model.points[i][2] > (dam_height - .5) * cell)
          for (unsigned int c = 0; c < 3; ++c)
            f[3 * model.equation[i] + c] = structure.mass[model.equation[i]][0] * direction[c];
      return f;
    }
  };

  /** Steps @p newmark; @p before and @p after each of its steps something else may happen. */
  inline History run(Newmark &newmark, const Dam &dam, const Unknowns &unit, const double dt,
                     const double duration, const double pulse_length,
                     const std::function<void(Unknowns &)> &before = nullptr,
                     const std::function<void()>           &after = nullptr)
  {
    History    h;
    const auto see = [&](const unsigned int node)
    {
      const Unknowns &u = newmark.state().u;
      return Vector3{{u[3 * node], u[3 * node + 1], u[3 * node + 2]}};
    };
    const Unknowns zero(unit.size(), 0.), no_jump(3 * newmark.joint_system().states().size(), 0.);
    newmark.start(zero, zero, no_jump, zero, no_jump);
    const unsigned int n_steps = std::lround(duration / dt);
    for (unsigned int i = 0;; ++i)
    {
      h.top.push_back(see(dam.top));
      h.foot.push_back(see(dam.foot));
      if (i == n_steps)
        return h;
      Unknowns     load = unit;
      const double p = pulse((i + 1) * dt, pulse_length);
      for (double &f : load)
        f *= p;
      if (before)
        before(load);
      newmark.advance(load);
      if (after)
        after();
    }
  }

  struct Case
  {
    std::string  boundary = "fixed";
    double       dt = .001, duration = .3; ///< [s]
    Vector3      direction = {{1., .5, .7}};
    double       stiffness_damping = 0.;
    double       quality = 0.; ///< quality factor of the rock
    unsigned int substeps = 1;
    std::string  coupling = "partition";
    double       pulse_length = .1; ///< [s]
    std::string  law = "tied";      ///< of the joint of two monoliths
    unsigned int layers_at_dam = 0; ///< none in implicit runs
  };

  /** Sees the dam and its foundation after each step. */
  using Watch = std::function<void(const Newmark &newmark, ExplicitRock &rock)>;

  /** Dam implicit, rock explicit: what the program does. @p cut: two monoliths with a tied joint. */
  inline History partitioned(const Ground &ground, const Case &c, const bool cut = false,
                             const Watch             &watch = nullptr,
                             const ContactParameters &contact = Columns::tight())
  {
    const HexMesh        block = make_mesh(ground, false, cut);
    FoundationParameters p;
    p.rock = rock;
    p.stiffness_damping = c.stiffness_damping;
    p.quality = c.quality;
    p.boundary = c.boundary;
    p.substeps = c.substeps;
    p.coupling = c.coupling;
    p.layers_at_dam = c.layers_at_dam;
    p.free_field = "columns"; // no earthquake: the box has too few layers for sections beside "fixed"
    const HexMesh  both = make_mesh(ground, true, cut);
    const auto     made = make_explicit_rock({p, both, "test"});
    auto          &foundation = dynamic_cast<ExplicitRock &>(*made);
    Dam            dam(cut ? open_joints(block) : block, c.stiffness_damping,
            foundation.base() == Foundation::Base::coupled, c.law);
    const Unknowns unit = dam.load(c.direction);
    foundation.add_stiffness(dam.model, dam.structure);
    foundation.add_mass(dam.structure);
    const TimeGrid grid{c.dt, c.substeps, 0};
    foundation.start({}, grid, Unknowns(unit.size(), 0.));
    Newmark newmark(dam.structure, dam.laws, contact, c.dt, ImpactRule::mean_force,
                    foundation.support(dam.structure));
    return run(
        newmark, dam, unit, c.dt, c.duration, c.pulse_length,
        [&](Unknowns &load) { foundation.advance(load); },
        [&]
        {
          foundation.update_from_dam(newmark.state());
          if (watch)
            watch(newmark, foundation);
        });
  }

  /** Dam and rock as one implicit body, of the same elements and lumped masses; artificial boundary fixed. */
  inline History implicit(const Ground &ground, const Case &c)
  {
    const Dam      dam(make_mesh(ground, false, false), c.stiffness_damping);
    RockParameters p;
    p.materials[PhysicalId::first_rock] = rock;
    p.nodal_everywhere = true;
    const RockModel model = make_rock_model(make_mesh(ground, true, false), p);

    // One numbering: the dam's, then the rock's free nodes.
    std::map<std::array<long, 3>, unsigned int> base;
    const auto                                  key = [](const auto &x) -> std::array<long, 3> {
      return {{std::lround(1e3 * x[0]), std::lround(1e3 * x[1]), std::lround(1e3 * x[2])}};
    };
    Structure            all = dam.structure;
    std::vector<Vector3> points(all.n_nodes());
    for (unsigned int i = 0; i < dam.model.n_nodes(); ++i)
    {
      const auto &x = dam.model.points[i];
      points[dam.model.equation[i]] = {{x[0], x[1], x[2]}};
      base[key(x)] = dam.model.equation[i];
    }
    std::set<unsigned int> fixed;
    for (const BoundaryFace &face : model.faces)
      fixed.insert(face.nodes.begin(), face.nodes.end());
    std::vector<unsigned int> number(model.points.size(), rigid_ground);
    for (unsigned int i = 0; i < number.size(); ++i)
      if (fixed.count(i) == 0)
      {
        if (const auto found = base.find(key(model.points[i])); found != base.end())
          number[i] = found->second;
        else
        {
          number[i] = points.size();
          points.push_back(model.points[i]);
          all.mass.push_back({});
          all.added_mass.push_back({});
        }
        for (unsigned int d = 0; d < 3; ++d)
          all.mass[number[i]][4 * d] += model.mass[i];
      }
    std::vector<std::vector<unsigned int>> columns(points.size());
    std::vector<unsigned int>              own(dam.structure.n_nodes());
    for (unsigned int i = 0; i < own.size(); ++i)
      own[i] = i;
    // A displacement normal to a plane of symmetry, or along one of antisymmetry, is zero.
    const bool along_x = c.direction[0] != 0.;
    const auto held = [&](const unsigned int i, const unsigned int d)
    {
      return (ground.is_plane_of_symmetry(0) && points[i][0] == 0. && (d == 0) != along_x) ||
             (ground.is_plane_of_symmetry(1) && points[i][1] == 0. && d == 1);
    };
    const auto each = [&](const auto &what)
    {
      const auto of = [&](const BlockSparseMatrix &K, const std::vector<unsigned int> &numbers)
      {
        for (unsigned int row = 0; row < K.n_rows(); ++row)
          for (std::size_t k = K.start[row]; k < K.start[row + 1]; ++k)
            if (numbers[row] != rigid_ground && numbers[K.column[k]] != rigid_ground)
              what(numbers[row], numbers[K.column[k]], K.value[k]);
      };
      of(dam.structure.bodies[0].stiffness, own);
      of(model.stiffness, number);
    };
    each([&](const unsigned int row, const unsigned int column, const Matrix3 &)
         { columns[row].push_back(column); });
    for (auto &row : columns)
    {
      std::sort(row.begin(), row.end());
      row.erase(std::unique(row.begin(), row.end()), row.end());
    }
    BlockSparseMatrix K(columns);
    each(
        [&](const unsigned int row, const unsigned int column, Matrix3 block)
        {
          for (unsigned int a = 0; a < 3; ++a)
            for (unsigned int b = 0; b < 3; ++b)
              if ((held(row, a) || held(column, b)) && (row != column || a != b))
                block[3 * a + b] = 0.;
          K.add(row, column, block);
        });
    all.bodies[0].stiffness = K;

    Unknowns unit = dam.load(c.direction);
    unit.resize(3 * points.size(), 0.);
    for (unsigned int i = 0; i < points.size(); ++i)
      for (unsigned int d = 0; d < 3; ++d)
        if (held(i, d))
          unit[3 * i + d] = 0.;
    Newmark newmark(all, dam.laws, Columns::tight(), c.dt, ImpactRule::mean_force);
    return run(newmark, dam, unit, c.dt, c.duration, c.pulse_length);
  }

  inline double peak(const std::vector<Vector3> &u)
  {
    double largest = 0.;
    for (const Vector3 &x : u)
      largest = std::max(largest, std::sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]));
    return largest;
  }

  /** Largest difference over the peak; @p fine may have more steps. NaN gives NaN. */
  inline double difference(const std::vector<Vector3> &u, const std::vector<Vector3> &fine)
  {
    const std::size_t    ratio = (fine.size() - 1) / (u.size() - 1);
    std::vector<Vector3> d = u;
    for (std::size_t i = 0; i < u.size(); ++i)
      for (unsigned int c = 0; c < 3; ++c)
      {
        d[i][c] -= fine[ratio * i][c];
        if (!(std::abs(d[i][c]) < 1e100))
          return NAN;
      }
    return peak(d) / peak(fine);
  }
} // namespace Blocks

#endif
