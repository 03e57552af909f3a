// SPDX-License-Identifier: GPL-3.0-or-later
// Joints between distorted blocks: patch tests, and tied joints against no joints.

#include "blocks.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_values.h>
#include <voussoir/solid/solid_grid.h>

using namespace Columns;

namespace
{
  /** e3: constant stress through a joint between two distorted blocks, sticking or slipping uniformly. */
  void patch(const unsigned int degree, const bool modes, const double nu, const bool slips)
  {
    const SolidModel model(blocks(2, false), degree);
    Material         one, two;
    one.young = 2e10, two.young = 5e10, one.poisson = two.poisson = nu;
    const Structure structure = with_joints(model, {one, two}, modes);
    const double    lambda = one.young * nu / ((1. + nu) * (1. - 2. * nu)), G = one.young / (2. * (1. + nu));
    const Vector3   gradient = {{-1e-4, .4e-4, -.3e-4}}; // of u along x, in block 1
    const Vector3   traction = {{(lambda + 2. * G) * gradient[0], G * gradient[1], G * gradient[2]}};
    const double    mu = slips ? -std::hypot(traction[1], traction[2]) / traction[0] : .9;
    const Vector3   slip = {
          {0., slips ? 2e-6 * traction[1] / G * 1e4 : 0., slips ? 2e-6 * traction[2] / G * 1e4 : 0.}};

    // Tractions on the free faces keep the stress constant.
    Unknowns                                     load(3 * structure.n_nodes(), 0.), exact(load);
    dealii::FEFaceValues<3>                      values(model.grid->fe, dealii::QGauss<2>(degree + 1),
                                                        dealii::update_values | dealii::update_normal_vectors |
                                                            dealii::update_JxW_values);
    std::vector<dealii::types::global_dof_index> dofs(model.grid->fe.n_dofs_per_cell());
    for (const auto &cell : model.grid->dof_handler.active_cell_iterators())
      for (const unsigned int f : cell->face_indices())
        if (cell->face(f)->at_boundary() && cell->face(f)->boundary_id() == 0)
        {
          values.reinit(cell, f);
          cell->get_dof_indices(dofs);
          for (const unsigned int q : values.quadrature_point_indices())
          {
            const auto    outward = values.normal_vector(q);
            const Vector3 m = transposed(turn, {{outward[0], outward[1], outward[2]}});
            // stress = lambda tr I + G (g x' + x g'), in the axes of the blocks
            const Vector3 t =
                turn * Vector3{{lambda * gradient[0] * m[0] + G * (gradient[0] * m[0] + gradient[0] * m[0] +
                                                                   gradient[1] * m[1] + gradient[2] * m[2]),
                                lambda * gradient[0] * m[1] + G * gradient[1] * m[0],
                                lambda * gradient[0] * m[2] + G * gradient[2] * m[0]}};
            for (unsigned int i = 0; i < dofs.size(); ++i)
              if (const unsigned int e = model.equation[dofs[i]]; e != rigid_ground)
                for (unsigned int c = 0; c < 3; ++c)
                  load[3 * e + c] += t[c] * values.shape_value(i, q) * values.JxW(q);
          }
        }
    for (unsigned int i = 0; i < model.n_nodes(); ++i)
      if (model.equation[i] != rigid_ground)
      {
        const Vector3 x = transposed(turn, {{model.points[i][0], model.points[i][1], model.points[i][2]}});
        const double  s = model.body[i] == 0 ? x[0] : (x[0] - 2.) * one.young / two.young;
        const Vector3 u = turn * Vector3{{s * gradient[0], s * gradient[1], s * gradient[2]}};
        std::copy(u.begin(), u.end(), exact.begin() + 3 * model.equation[i]);
      }

    const std::size_t n = structure.pairs.size();
    Unknowns          offset(3 * n), force(3 * n, 0.), gap, u;
    double            area = 0., error_force = 0., error_gap = 0.;
    const Vector3     slip_turned = turn * slip, traction_turned = turn * traction;
    const auto        in_frame = [&](const Pair &pair, const Vector3 &v)
    {
      Vector3 result{};
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int d = 0; d < 3; ++d)
          result[i] += pair.frame[i][d] * v[d];
      return result;
    };
    for (std::size_t p = 0; p < n; ++p)
    {
      const Vector3 jump = structure.jump(structure.pairs[p], exact),
                    s = in_frame(structure.pairs[p], slip_turned);
      area += structure.pairs[p].area;
      for (unsigned int c = 0; c < 3; ++c)
        offset[3 * p + c] = s[c] - jump[c];
    }
    const JointLaws   laws = make_laws(structure, "FJA", mu);
    ContactParameters contact = tight();
    contact.tolerance = 1e-14; // a single pair may be ten times as far off as their norm
    JointSystem   system(structure, laws, contact, {});
    ContactResult result = system.solve(load, offset, Unknowns(offset.size(), 0.), force, gap, u);
    const double  scale = -traction[0] * 3. / n;
    for (std::size_t p = 0; p < n; ++p)
    {
      const Pair   &pair = structure.pairs[p];
      const Vector3 f = in_frame(pair, traction_turned), s = in_frame(pair, slip_turned);
      for (unsigned int c = 0; c < 3; ++c)
      {
        error_force = std::max(error_force, std::abs(force[3 * p + c] + f[c] * pair.area) / scale);
        error_gap = std::max(error_gap, std::abs(gap[3 * p + c] - s[c]) / 1e-4);
      }
    }
    Unknowns difference = u;
    for (std::size_t i = 0; i < u.size(); ++i)
      difference[i] -= exact[i];
    const std::string what = "e3 patch, degree " + text(degree) + (modes ? "" : " plain") +
                             ", nu = " + text(nu) + (slips ? ", slip: " : ": ");
    report(what + "Newton steps", result.iterations, "converged", result.residual < 1e-12);
    below(what + "area of the joint", area / 3. - 1., 1e-13);
    below(what + "joint forces", error_force, slips ? 1e-11 : 1e-12);
    below(what + "displacement", largest(difference) / largest(exact), 1e-12);
    below(what + "gap and slip", error_gap, 1e-12);

    for (std::size_t p = 0; p < n; ++p)
      offset[3 * p] = 1e-3;
    Unknowns free;
    result = system.solve(load, offset, Unknowns(offset.size(), 0.), force, gap, u);
    system.solve_free(load, free);
    for (std::size_t i = 0; i < u.size(); ++i)
      difference[i] = u[i] - free[i];
    const bool all_open = std::all_of(system.states().begin(), system.states().end(),
                                      [](const PairState s) { return s == PairState::open; });
    report(what + "pulled: force", largest(force), "0, all open", all_open && largest(force) == 0.);
    below(what + "pulled: displacement", largest(difference) / largest(free), 1e-14);
  }

  /** A smooth load, the same for all meshes; in two meshes of a joint only on side 1. */
  Unknowns smooth_load(const SolidModel &model, const double size)
  {
    Unknowns load(3 * model.first_equation.back(), 0.);
    for (unsigned int i = 0; i < model.n_nodes(); ++i)
      if (model.equation[i] != rigid_ground && !model.on_surface(i, PhysicalId::joint_side_2 + 1))
        for (unsigned int c = 0; c < 3; ++c)
          load[3 * model.equation[i] + c] =
              size * std::sin(1. + c + 2. * model.points[i][0] - model.points[i][1] + c * model.points[i][2]);
    return load;
  }

  void test_tied(const unsigned int degree)
  {
    const SolidModel two(blocks(2, false), degree), one(blocks(2, true), degree);
    const Structure  jointed = with_joints(two, {Material()}),
                    whole = assemble_structure(one, {Material()}, true);
    const JointLaws laws = make_laws(jointed, "tied", 0.), none;
    JointSystem     system(jointed, laws, tight(), {}), reference(whole, none, tight(), {});
    Unknowns        offset(3 * jointed.pairs.size(), 0.), force = offset, gap, u, v;
    const auto      result =
        system.solve(smooth_load(two, 1e6), offset, Unknowns(offset.size(), 0.), force, gap, u);
    reference.solve_free(smooth_load(one, 1e6), v);
    double       error = 0.;
    unsigned int matched = 0;
    for (unsigned int i = 0; i < two.n_nodes(); ++i)
      for (unsigned int k = 0; k < one.n_nodes(); ++k)
        if (two.equation[i] != rigid_ground && distance_between(two.points[i], one.points[k]) < 1e-6)
        {
          ++matched;
          for (unsigned int c = 0; c < 3; ++c)
            error = std::max(error, std::abs(u[3 * two.equation[i] + c] - v[3 * one.equation[k] + c]));
        }
    const std::string what = "tied joint, degree " + text(degree) + ": ";
    report(what + "nodes compared", matched, text(two.first_equation.back()),
           matched == two.first_equation.back() && result.converged);
    below(what + "displacement against one block", error / largest(v), 1e-11);

    SolidModel tied(blocks(2, false), degree);
    tie_joints(tied, 1);
    const Structure merged = assemble_structure(tied, {Material()}, true);
    JointSystem     plain(merged, none, tight(), {});
    plain.solve_free(smooth_load(tied, 1e6), v);
    error = 0.;
    for (unsigned int i = 0; i < two.n_nodes(); ++i) // the same nodes in the same order
      for (unsigned int c = 0; two.equation[i] != rigid_ground && c < 3; ++c)
        error = std::max(error, std::abs(u[3 * two.equation[i] + c] - v[3 * tied.equation[i] + c]));
    below(what + "displacement against merged nodes", error / largest(v), 1e-11);
  }

  void test_fjb()
  {
    const SolidModel model(blocks(2, false), 1);
    const Structure  structure = with_joints(model, {Material()});
    const JointLaws  laws = make_laws(structure, "FJB", 0.);
    JointSystem      system(structure, laws, tight(), {});
    const auto       n = structure.pairs.size();
    Unknowns         offset(3 * n, 0.), force = offset, gap, u;
    for (std::size_t p = 0; p < n; ++p)
      offset[3 * p] = 1e-2;
    system.solve(smooth_load(model, 1e6), offset, Unknowns(offset.size(), 0.), force, gap, u);
    double     normal = 0., tangential = 0., slip = 0.;
    const bool open = std::all_of(system.states().begin(), system.states().end(),
                                  [](const PairState s) { return s == PairState::open; });
    for (std::size_t p = 0; p < n; ++p)
    {
      const Vector3 jump = structure.jump(structure.pairs[p], u);
      normal = std::max(normal, std::abs(force[3 * p]));
      for (unsigned int c = 1; c < 3; ++c)
      {
        tangential = std::max(tangential, std::abs(force[3 * p + c]));
        slip = std::max(slip, std::abs(jump[c]));
      }
    }
    report("FJB, open: normal force", normal, "0, all open", open && normal == 0.);
    above("FJB, open: tangential force", tangential, 1e4);
    below("FJB, open: slip / displacement", slip / largest(u), 1e-12);
  }

  void test_patches()
  {
    for (const double nu : {0., .3})
    {
      patch(1, true, nu, false);
      patch(1, true, nu, true);
      patch(2, true, nu, false);
    }
    patch(1, false, .3, false);
  }

  void test_ties()
  {
    test_tied(1);
    test_tied(2);
    test_fjb();
  }
} // namespace

int main()
{
  return run_all({test_patches, test_ties});
}
