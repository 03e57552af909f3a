// SPDX-License-Identifier: GPL-3.0-or-later
// Dams from tables of arcs: against closed formulas, against arch210, and bad tables.

#include "mesh_testing.h"

#include <voussoir/mesh/arch_table.h>
#include <voussoir/mesh/boundary_lines.h>
#include <voussoir/mesh/centre_line.h>
#include <voussoir/mesh/mesh_joints.h>
#include <voussoir/mesh/mesh_source.h>
#include <voussoir/mesh/monotone_cubic.h>

#include <cstdio>
#include <functional>
#include <sstream>

using namespace MeshTesting;

namespace
{
  constexpr double pi = 3.14159265358979324, degree = pi / 180;

  const std::string circular =
      "elevation,upstream_x,upstream_radius,thickness,downstream_radius,right_angle,left_angle\n";

  MeshParameters dam_of(const std::string &text, const std::string &kind = "circular")
  {
    write_text("table.csv", text);
    MeshParameters p;
    p.source = "arcs";
    p.arcs.table = "table.csv";
    p.arcs.kind = kind;
    return p;
  }

  /** A shape of the table with corners of round numbers, 120 m high, another one on each bank. */
  const std::string leaning =
      circular + "285,-2,74,22,50,22,20\n345,-8,112,15,95,43,40\n405,0,150,6,144,51,48\n";

  /** Slopes 1 and 1/2 on steps 1 and 2: (3 + 6) / (5/1 + 4/(1/2)) at the middle; by three points at the ends. */
  void test_monotone_cubic()
  {
    const MonotoneCubic curve({0, 1, 3}, {0, 1, 2});
    const double        h = 1e-6;
    expect_within((curve(h) - curve(0)) / h, 7. / 6, 1e-5, "slope at the start");
    expect_within((curve(1 + h) - curve(1 - h)) / (2 * h), 9. / 13, 1e-5, "slope at the middle");
    expect_within((curve(3) - curve(3 - h)) / h, 1. / 6, 1e-5, "slope at the end");
    for (const auto &[x, y] : {std::pair{0., 0.}, {1., 1.}, {3., 2.}})
      expect_within(curve(x), y, 1e-14, "a point");
    const MonotoneCubic peak({0, 1, 2}, {0, 1, 0}), line({2, 5}, {1, 7});
    for (unsigned int i = 0; i <= 100; ++i)
      expect(peak(.02 * i) <= 1 + 1e-14, "a value above the points");
    expect_within(line(3.5), 4, 1e-14, "two points");
    // Values that hardly rise and then steeply: at the end the slope is at most three times that of the last piece.
    const MonotoneCubic steep({0, 1, 2}, {0, 10, 11});
    expect_within((steep(2) - steep(2 - h)) / h, 0., 1e-5, "slope at a steep end");
  }

  /** Part of a ring, 30 and 40 degrees, on a flat base. */
  void test_ring()
  {
    MeshParameters p = dam_of(circular + "0,0,100,20,80,30,40\n60,0,100,20,80,30,40\n");
    p.arcs.grid.n_joints = 3;
    p.arcs.grid.elements_along = 121;
    p.arcs.grid.elements_up = 2;
    const HexMesh mesh = make_mesh(p, ".");
    expect(mesh.cells.size() == 124 * 2 * 2, "elements along: a multiple of four monoliths");
    expect_close(volume(mesh), 70 * degree / 2 * (100. * 100 - 80. * 80) * 60, 1e-4, "volume of the ring");
    expect_close(crest_length(mesh), 70 * degree * 90, 1e-4, "crest of the ring");
    // Joints divide the centre line of the crest into four parts. Their planes contain its radii.
    const auto joints = open_joints(mesh);
    for (unsigned int j = 1; j <= 3; ++j)
    {
      const double angle = (-30 + 70. * j / 4) * degree;
      const auto  &node = mesh.nodes[(31 * j * 3 + 2) * 3 + 1];
      expect_within(node[0], 100 - 90 * std::cos(angle), 1e-4, "x of a joint");
      expect_within(node[1], 90 * std::sin(angle), 1e-4, "y of a joint");
      for (unsigned int n = 31 * j * 9; n < (31 * j + 1) * 9; ++n)
        expect_within((mesh.nodes[n][0] - 100) * std::sin(angle) + mesh.nodes[n][1] * std::cos(angle), 0,
                      1e-4, "a node beside the plane of its joint");
    }
  }

  /** Columns lie in vertical planes normal to the crest; abutments are where the table has them. */
  void test_leaning_arcs()
  {
    MeshParameters p = dam_of(leaning);
    p.arcs.grid.n_joints = 5;
    p.arcs.grid.elements_along = 24;
    p.arcs.grid.elements_up = 6;
    p.arcs.grid.elements_through = 2;
    p.arcs.grid.equal_rows = true; // numbers of nodes by column and row
    const HexMesh mesh = make_mesh(p, ".");
    const auto    shape = p.arcs.shape(".");
    const double  x_crest = 150; // centre of the crest
    unsigned int  n_abutments = 0;
    for (unsigned int i = 0; i <= 24; ++i)
    {
      const auto node = [&](const unsigned int k, const unsigned int l)
      { return mesh.nodes[(i * 7 + k) * 3 + l]; };
      const auto crest = node(6, 1);
      for (unsigned int k = 0; k <= 6; ++k)
        for (unsigned int l = 0; l <= 2; ++l)
        {
          const auto at = node(k, l);
          expect_within((at[0] - crest[0]) * crest[1] + (at[1] - crest[1]) * (x_crest - crest[0]), 0,
                        1e-5 * 150, "a node beside the plane of its column");
          // The node is on its face: at the distance of the radius from the centre of the arc.
          const double        z = at[2];
          const MonotoneCubic R({285, 345, 405}, {74, 112, 150}), x({285, 345, 405}, {-2, -8, 0});
          if (l == 0)
            expect_close(std::hypot(at[0] - x(z) - R(z), at[1]), R(z), 1e-12, "the upstream face");
        }
      // A base node above the floor and below the smallest height is at the abutment of the table.
      const auto foot = node(0, 0);
      if (foot[2] < 285.001 || foot[2] > 399.999)
        continue;
      const MonotoneCubic R({285, 345, 405}, {74, 112, 150}), x({285, 345, 405}, {-2, -8, 0}),
          right({285, 345, 405}, {22, 43, 51}), left({285, 345, 405}, {20, 40, 48});
      const double angle = std::atan2(foot[1], x(foot[2]) + R(foot[2]) - foot[0]);
      expect_within(angle / degree, angle < 0 ? -right(foot[2]) : left(foot[2]), 1e-8, "the abutment");
      ++n_abutments;
    }
    expect(n_abutments > 8, "abutments of the table");
    expect(smallest_jacobian(mesh) > 0, "negative Jacobian");
    expect_within(bounding_box(mesh).first[2], 285, 1e-12, "the floor");
  }

  /** arch210 as a table of parabolic arcs at 43 elevations. */
  void test_parabolic()
  {
    std::ostringstream table;
    table.precision(15);
    table << "# arch210\nleft_width,elevation,upstream_x,thickness,right_radius,left_radius,right_thickness,"
             "left_thickness,right_width\n";
    for (unsigned int i = 0; i <= 42; ++i)
    {
      // The width rises like z^0.577: more arcs near the floor.
      const double z = 210 * std::pow(i / 42., 3), zeta = (210 - z) / 210;
      const double thickness = 10 + zeta * (86 + zeta * (-66 + zeta * 22));
      const double abutment = thickness * (1 + zeta * (0.60 - zeta * 0.42));
      const double radius = 115 + (250.760 - 115) * z / 210,
                   width = 50 + (267.032 - 50) * std::pow(z / 210, 0.577);
      table << width << "," << z << "," << zeta * (-62.0 + zeta * (35.7 + zeta * 12.3)) << "," << thickness
            << "," << radius << "," << radius << "," << abutment << "," << abutment << "," << width << "\n";
    }
    MeshParameters p = dam_of(table.str(), "parabolic");
    static_cast<ArchGrid &>(p.arcs.grid) = p.arch210;
    const HexMesh mesh = make_mesh(p, "."), expected = make_arch210(p.arch210);
    double        largest = 0;
    for (unsigned int n = 0; n < mesh.nodes.size(); ++n)
      for (unsigned int d = 0; d < 3; ++d)
        largest = std::max(largest, std::abs(mesh.nodes[n][d] - expected.nodes[n][d]));
    std::printf("  largest difference from arch210: %.1e m\n", largest);
    expect(largest < 0.02, "arch210 from a table");
  }

  /** Ellipses with equal semi-axes and circles with equal radii are circles. */
  void test_centre_lines()
  {
    const CentreLine circle{CentreLine::Kind::ellipse, 90, 90};
    CentreLine       three{CentreLine::Kind::three_centred, 90};
    three.angle = .3;
    three.side_radius = 90;
    for (const double angle : {.1, .5, 1.2})
      for (const CentreLine &line : {circle, three})
      {
        const auto place = line.at(90 * std::sin(angle));
        expect_close(place.x, 90 * (1 - std::cos(angle)), 1e-13, "x of a circle");
        expect_close(place.slope, std::tan(angle), 1e-13, "slope of a circle");
        expect_close(place.length, 90 * angle, 1e-13, "length of a circle");
      }
    // All lines: slope and length by differences, also on the straight continuation.
    three.side_radius = 200;
    for (const CentreLine &line :
         {CentreLine{CentreLine::Kind::parabola, 90}, CentreLine{CentreLine::Kind::ellipse, 90, 120},
          CentreLine{CentreLine::Kind::ellipse, 90, 60}, three})
      for (const double y : {10., 26., 28., 58., 119., 220.})
      {
        const double h = 1e-4;
        const auto   here = line.at(y), before = line.at(y - h), after = line.at(y + h);
        expect_close((after.x - before.x) / (2 * h), here.slope, 1e-4, "slope");
        expect_close((after.length - before.length) / (2 * h), std::hypot(1, here.slope), 1e-4, "length");
      }
    // Length of an ellipse with the semi-axes 120 along y and 160 along x, from the crown to y = 120: a quarter of its
    // circumference, by Ramanujan's second formula (relative error below 1e-9 here).
    const CentreLine tall{CentreLine::Kind::ellipse, 90, 120};
    const double     b = 160, h = std::pow((b - 120) / (b + 120), 2);
    const double     quarter = pi / 4 * (b + 120) * (1 + 3 * h / (10 + std::sqrt(4 - 3 * h)));
    const double     last = tall.at(118).length; // before the continuation
    expect(last < quarter && last > 0.8 * quarter, "a quarter of an ellipse");
  }

  /** The same ring by its centre line, elliptical and three-centred, and by points of its faces. */
  void test_kinds()
  {
    std::ostringstream elliptical, three, points;
    elliptical << "elevation,upstream_x,thickness,right_radius,left_radius,right_semi_axis,left_semi_axis,"
                  "right_thickness,left_thickness,right_width,left_width\n";
    three << "elevation,upstream_x,thickness,radius,right_central_angle,left_central_angle,right_radius,"
             "left_radius,right_thickness,left_thickness,right_width,left_width\n";
    points << "elevation,face,x,y\n";
    elliptical.precision(15);
    three.precision(15);
    points.precision(15);
    const double right = 90 * std::sin(30 * degree), left = 90 * std::sin(40 * degree);
    for (const double z : {0., 60.})
    {
      elliptical << z << ",0,20,90,90,90,90,20,20," << right << "," << left << "\n";
      three << z << ",0,20,90,12,15,90,90,20,20," << right << "," << left << "\n";
      for (const double radius : {100., 80.})
        for (double angle = -30; angle <= 40; angle += 2.5)
          points << z << "," << (radius == 100 ? "upstream" : "downstream") << ","
                 << 100 - radius * std::cos(angle * degree) << "," << radius * std::sin(angle * degree)
                 << "\n";
    }
    const auto mesh_of = [](const std::string &text, const std::string &kind)
    {
      MeshParameters p = dam_of(text, kind);
      p.arcs.grid.n_joints = 3;
      p.arcs.grid.elements_up = 3;
      return make_mesh(p, ".");
    };
    const HexMesh ring = mesh_of(circular + "0,0,100,20,80,30,40\n60,0,100,20,80,30,40\n", "circular");
    for (const auto &[text, kind, tolerance] : {std::tuple{elliptical.str(), "elliptical", 1e-4},
                                                {three.str(), "three-centred", 1e-4},
                                                {points.str(), "points", 0.02}})
    {
      const HexMesh mesh = mesh_of(text, kind);
      double        largest = 0;
      for (unsigned int n = 0; n < mesh.nodes.size(); ++n)
        for (unsigned int d = 0; d < 3; ++d)
          largest = std::max(largest, std::abs(mesh.nodes[n][d] - ring.nodes[n][d]));
      std::printf("  %s: largest difference from the ring %.1e m\n", kind, largest);
      expect(largest < tolerance, std::string(kind) + " ring");
    }
  }

  void test_chainages_and_rows()
  {
    MeshParameters p = dam_of(circular + "0,0,100,20,80,30,40\n60,0,100,20,80,30,40\n");
    p.arcs.grid.joint_places = {20, 30, 80};
    p.arcs.grid.rows = {0.1, 0.5};
    const HexMesh mesh = make_mesh(p, ".");
    // 40 elements on 109.96 m: 8 up to the first joint, 4, 19 and 11.
    expect(n_monoliths(mesh) == 4 && mesh.cells.size() == 42 * 3 * 2,
           "cells of monoliths of different widths");
    for (const auto &[column, chainage] : {std::pair{8, 20.}, {12, 30.}, {31, 80.}})
    {
      const double angle = chainage / 90 - 30 * degree;
      const auto  &node = mesh.nodes[(column * 4 + 3) * 3 + 1];
      expect_within(node[1], 90 * std::sin(angle), 1e-4, "a joint at its chainage");
    }
    for (const auto &[row, z] : {std::pair{0, 0.}, {1, 6.}, {2, 30.}, {3, 60.}})
      expect_within(mesh.nodes[row * 3][2], z, 1e-12, "a row of elements");
    const auto bad = [&](const std::function<void(ArchGrid &)> &spoil, const std::string &entry)
    {
      MeshParameters q = p;
      spoil(q.arcs.grid);
      expect_error([&] { make_mesh(q, "."); }, {"\"Mesh/Arcs/" + entry + "\""});
    };
    bad([](ArchGrid &grid) { grid.joint_places = {20, 20}; }, "Joint chainages");
    bad([](ArchGrid &grid) { grid.joint_places = {120}; }, "Joint chainages");
    bad([](ArchGrid &grid) { grid.rows = {0.5, 0.4}; }, "Rows");
    bad([](ArchGrid &grid) { grid.rows = {1}; }, "Rows");
    bad([](ArchGrid &grid) { grid.lift_joints = 1; }, "Lift joints"); // with rows
    bad([](ArchGrid &grid) { grid.smallest_height = 0; }, "Smallest height");
    bad([](ArchGrid &grid) { grid.smallest_height = 40; }, "Smallest height");
    bad([](ArchGrid &grid) { grid.elements_along = 0; }, "Elements along");
  }

  /** Rock around a dam with different banks: a box with regular layers, cut at the extents; the layers upstream are
   * the prism over the polygon of the valley. */
  void test_rock()
  {
    MeshParameters p = dam_of(leaning);
    p.arcs.grid.n_joints = 3;
    p.arcs.grid.elements_along = 12;
    p.arcs.grid.elements_up = 4;
    p.arcs_rock.enabled = true;
    const HexMesh mesh = make_mesh(p, ".");
    const auto    box = bounding_box(mesh);
    const auto    quality = mesh_quality(mesh, true);
    std::printf("  %zu cells, scaled Jacobian %.3f\n", mesh.cells.size(), quality.smallest_scaled_jacobian);
    expect(smallest_jacobian(mesh) > 0 && quality.smallest_scaled_jacobian > 0.2, "distorted rock");
    boundary_lines(mesh, 6, "arcs");
    const double height = 120;
    expect_within(box.first[2], 285 - height, 1e-9, "depth");
    double foot[2] = {0, 0};
    for (const auto &face : mesh.faces)
      if (face.surface == PhysicalId::base)
        for (const unsigned int node : face.nodes)
          for (const unsigned int bank : {0, 1})
            foot[bank] = std::max(foot[bank], (bank == 0 ? -1 : 1) * mesh.nodes[node][1]);
    expect_within(-box.first[1], foot[0] + height, 1e-9, "right extent");
    expect_within(box.second[1], foot[1] + height, 1e-9, "left extent");

    const auto valley = arch_valley(*p.arcs.shape("."), p.arcs.grid);
    double     polygon = (box.second[1] - box.first[1]) * (400 - box.first[2]);
    for (std::size_t c = 1; c < valley.size(); ++c)
      polygon -= (400 - 0.5 * (valley[c][1] + valley[c - 1][1])) * (valley[c][0] - valley[c - 1][0]);
    HexMesh      layers = mesh;
    const double h = std::min(height * 22 / 210, height / 12);
    layers.cells.clear();
    for (const auto &cell : mesh.cells)
      if (!is_monolith(cell.volume) && centre(mesh, cell.nodes)[0] < box.first[0] + 6 * h)
        layers.cells.push_back(cell);
    expect_close(volume(layers), polygon * 6 * h, 1e-10, "volume of the layers upstream");

    // A dam with exchanged banks has the mirrored mesh.
    MeshParameters q = p;
    write_text("mirrored.csv",
               circular + "285,-2,74,22,50,20,22\n345,-8,112,15,95,40,43\n405,0,150,6,144,48,51\n");
    q.arcs.table = "mirrored.csv";
    const auto moments = [](const HexMesh &of)
    {
      std::array<double, 3> sums{}; // of y, of y^3, of x y
      for (const auto &node : of.nodes)
        for (unsigned int k = 0; k < 3; ++k)
          sums[k] += k == 0 ? node[1] : k == 1 ? std::pow(node[1], 3) : node[0] * node[1];
      return sums;
    };
    const auto here = moments(mesh), mirrored = moments(make_mesh(q, "."));
    for (unsigned int k = 0; k < 3; ++k)
      expect_close(-mirrored[k], here[k], 1e-6, "the mirrored mesh, moment " + std::to_string(k));

    p.arcs_rock.sides = 10;
    expect_error([&] { make_mesh(p, "."); }, {"\"Mesh/Arcs/Rock/Sides\"", "50 m"});
  }

  void test_bad_tables()
  {
    const std::string ring = "0,0,100,20,80,30,40\n60,0,100,20,80,30,40";
    const auto        bad = [](const std::string &text, const std::vector<std::string> &parts,
                        const std::string &kind = "circular")
    { expect_error([&] { make_mesh(dam_of(text, kind), "."); }, parts); };
    bad(circular + "0,0,100,20,80,30,40\n", {"table.csv", "two arcs"});
    bad(circular + "0,0,100,20,80,30,40\n60,a,100,20,80,30,40\n", {"line 3, upstream_x: \"a\""});
    bad(circular + ring + ",7\n", {"line 3: 8 values for 7"});
    bad(circular + ring.substr(0, ring.size() - 3) + "\n", {"line 3: 6 values for 7"});
    bad(circular + "0,0,100,20,80,30,40\n60,1e300,100,20,80,30,40\n", {"line 3, upstream_x: \"1e300\""});
    bad(circular + "0,0,100,20,80,30,40\n60,nan,100,20,80,30,40\n", {"\"nan\""});
    bad(circular + "0,0,100,20,80,.5,.7\n60,0,100,20,80,.5,.7\n", {"radians"});
    bad(circular + "0,0,100,20,80,30,40\n60,0,100,20,80,30,88\n", {"left_angle", "85 degrees"});
    bad(circular + "0,0,100,20,80,30,40\n60,0,10,20,80,30,40\n", {"thicker"});
    bad(circular + "0,0,100,-20,80,30,40\n60,0,100,20,80,30,40\n",
        {"thickness must be positive", "elevation 0 m"});
    bad(circular + "0,0,100,20,80,30,40\n60,0,100,20,80,20,40\n", {"open upwards", "right bank"});
    bad(circular + "0,0,100,20,20,60,60\n60,0,100,20,20,60,60\n", {"meet"});
    bad(circular + ring + "\n60,0,100,20,80,30,40\n", {"two arcs have the elevation 60 m"});
    bad("elevation;thickness\n0;3\n", {"separated by commas", "Mesh/Arcs/Kind"});
    bad("elevation,thickness\n1,2\n", {"upstream_x is missing"});
    bad("elevation,elevation,thickness\n1,2\n", {"elevation is there twice"});
    bad("", {"empty"});
    bad("elevation,face,x,y\n0,middle,1,2\n", {"upstream or downstream"}, "points");
    bad("elevation,face,x,y\n0,upstream,1,-2\n5,upstream,1,2\n", {"at least four"}, "points");
    bad("elevation,upstream_x,thickness,right_radius,left_radius,right_semi_axis,left_semi_axis,right_thickness,"
        "left_thickness,right_width,left_width\n0,0,9,90,90,90,90,9,9,40,95\n9,0,9,90,90,90,90,9,9,40,95\n",
        {"left_width", "80 degrees"}, "elliptical");
    MeshParameters p;
    p.source = "arcs";
    expect_error([&] { p.check(); }, {"\"Mesh/Arcs/Table\" is empty"});
    p.arcs.table = "no_such_table.csv";
    expect_error([&] { make_mesh(p, "."); }, {"no_such_table.csv", "cannot be read"});
  }
} // namespace

int main()
{
  return run({{"monotone cubic", test_monotone_cubic},
              {"ring", test_ring},
              {"leaning arcs", test_leaning_arcs},
              {"parabolic", test_parabolic},
              {"centre lines", test_centre_lines},
              {"kinds", test_kinds},
              {"chainages and rows", test_chainages_and_rows},
              {"rock", test_rock},
              {"bad tables", test_bad_tables}});
}
