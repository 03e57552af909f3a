// SPDX-License-Identifier: GPL-3.0-or-later
// Limit equilibrium of rock wedges against closed forms and against an enumeration by the classical formulas, and
// the file of the wedges. Part of base_forces.cc.

#ifndef voussoir_tests_wedges_h
#define voussoir_tests_wedges_h

#include <voussoir/dam/rock_wedge.h>
#include <voussoir/dam/scene.h>

#include "testing.h"

#include <random>

namespace Wedges
{
  using namespace Voussoir;
  using namespace Testing;

  inline Vector3 combined(const double a, const Vector3 &x, const double b, const Vector3 &y)
  {
    return {{a * x[0] + b * y[0], a * x[1] + b * y[1], a * x[2] + b * y[2]}};
  }

  inline Vector3 crossed(const Vector3 &a, const Vector3 &b)
  {
    return {{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]}};
  }

  inline Vector3 unit(const Vector3 &x)
  {
    return combined(1. / norm(x), x, 0., x);
  }

  inline WedgePlane plane(const Vector3 &normal, const double friction, const double cohesion = 0.,
                          const double area = 1., const double uplift = 0.)
  {
    WedgePlane result;
    result.normal = normal;
    result.friction = friction;
    result.cohesion = cohesion;
    result.area = area;
    result.uplift = uplift;
    return result;
  }

  /** Block on an incline: F = (c A + (W cos(dip) - U) tan(phi))/(W sin(dip)). A plane behind the block opens. */
  inline void incline()
  {
    const double W = 7e6, A = 40.;
    for (const double dip : {10., 35., 60., 89.})
      for (const double azimuth : {0., 75., 200.})
        for (const double uplift : {0., 2e4})
        {
          const Vector3 normal = normal_of(dip, azimuth);
          const double  sine = std::sin(dip * pi / 180.), cosine = std::cos(dip * pi / 180.);
          const double  N = W * cosine - uplift * A, F = (3e5 * A + std::max(0., N) * .7) / (W * sine);
          const auto    bottom = plane(normal, .7, 3e5, A, uplift);
          for (const bool with_back : {false, true})
          {
            std::vector<WedgePlane> planes = {bottom};
            if (with_back)
              planes.push_back(plane(normal_of(90., azimuth), .5, 1e6, 30.));
            const WedgeState state = wedge_equilibrium(planes, {{0., 0., -W}});
            if (N < 0.) // the block lifts off
            {
              expect(state.mode() == 0 && state.safety == 0., "lifts at a dip of " + text(dip));
              continue;
            }
            expect(state.mode() == 1, "slides on the incline");
            expect_close(state.safety, F, 1e-12, "safety at a dip of " + text(dip));
            expect_close(state.normal_force[0], N, 1e-10, "compression");
            expect_within(state.driving[2], -W * sine * sine, 1e-9 * W, "driving force down the incline");
          }
        }
    const WedgeState dry = wedge_equilibrium({plane(normal_of(30., 0.), .6)}, {{0., 0., -W}});
    expect_close(dry.safety, .6 / std::tan(pi / 6.), 1e-12, "tan(phi)/tan(dip)");
    const std::vector<WedgePlane> flat = {plane({{0., 0., 1.}}, .6, 0., A, 2e5)};
    expect(wedge_equilibrium(flat, {{0., 0., -7.9e6}}).mode() == 0, "uplift 8 MN lifts 7.9 MN");
    expect(wedge_equilibrium(flat, {{1e3, 0., -8.1e6}}).mode() == 1, "uplift 8 MN does not lift 8.1 MN");
    expect(std::isinf(wedge_equilibrium(flat, {{0., 0., -8.1e6}}).safety), "no driving force");
    expect(wedge_equilibrium(flat, {}).safety == 0., "uplift alone lifts");
    expect(std::isinf(wedge_equilibrium({plane({{0., 0., 1.}}, .6)}, {}).safety), "no force at all");
  }

  /** Planes of a wedge with the line of intersection in the direction of x, descending by psi. In the section normal
   * to the line the planes include the angle xi, and their bisector rises by beta from the horizontal. */
  inline std::vector<WedgePlane> valley(const double psi, const double beta, const double xi,
                                        const double friction)
  {
    const Vector3 across{{0., 1., 0.}}, up{{std::sin(psi), 0., std::cos(psi)}};
    const double  a = beta - .5 * xi, b = beta + .5 * xi;
    return {plane(combined(-std::sin(a), across, std::cos(a), up), friction),
            plane(combined(std::sin(b), across, -std::cos(b), up), friction)};
  }

  /** Hoek and Bray, Rock Slope Engineering (1981): F = sin(beta)/sin(xi/2) tan(phi)/tan(psi), friction alone. */
  inline void line_of_intersection()
  {
    for (const double psi : {.3, .7, 1.2})
      for (const double beta : {.5 * pi, 1.4, 1.8})
        for (const double xi : {.8, 1.5, 2.4})
        {
          std::vector<WedgePlane> planes = valley(psi, beta, xi, .65);
          const Vector3           weight{{0., 0., -3e6}};
          const WedgeState        state = wedge_equilibrium(planes, weight);
          expect(state.mode() == 12, "slides along the line");
          const double F = std::sin(beta) / std::sin(.5 * xi) * .65 / std::tan(psi);
          expect_close(state.safety, F, 1e-12, "Hoek and Bray");
          const Vector3 line{{std::cos(psi), 0., -std::sin(psi)}};
          expect_within(norm(combined(1., state.driving, -3e6 * std::sin(psi), line)), 0., 1e-12 * 3e6,
                        "driving force along the line");
          planes.push_back(plane({{-1., 0., 0.}}, .5)); // in front of the wedge: nothing can move
          const WedgeState fixed = wedge_equilibrium(planes, weight);
          expect(fixed.mode() == 123 && std::isinf(fixed.safety), "three planes in contact");
          planes[2].normal = {{1., 0., 0.}}; // behind the wedge: the plane opens
          const WedgeState released = wedge_equilibrium(planes, weight);
          expect(released.mode() == 12 && std::abs(released.safety / F - 1.) < 1e-12,
                 "the release plane opens");
          planes[2].uplift = 6e6; // water behind, which also pushes along the line
          expect(wedge_equilibrium(planes, weight).safety < F, "water behind the wedge reduces the safety");
        }
  }

  /** Random wedge with @p n planes, friction, cohesion and uplift. */
  inline std::vector<WedgePlane> random_planes(std::mt19937 &random, const unsigned int n)
  {
    std::uniform_real_distribution<double> any(-1., 1.), positive(0., 1.);
    std::vector<WedgePlane>                planes;
    do
    {
      planes.clear();
      for (unsigned int i = 0; i < n; ++i)
        planes.push_back(plane(unit({{any(random), any(random), any(random)}}), positive(random),
                               positive(random), .1 + positive(random), .3 * positive(random)));
    } while (independence(planes) < .05);
    return planes;
  }

  /** Admissible modes by Londe's formulas for one plane and for the line of two planes. R: total force. */
  inline std::vector<std::pair<unsigned int, double>> admissible(const std::vector<WedgePlane> &planes,
                                                                 const Vector3                 &R)
  {
    std::vector<std::pair<unsigned int, double>> found; // mode and safety
    const unsigned int                           n = planes.size();
    const auto opens = [&](const Vector3 &S, const unsigned int i, const unsigned int j)
    {
      for (unsigned int k = 0; k < n; ++k)
        if (k != i && k != j && dot(S, planes[k].normal) < 0.)
          return false;
      return true;
    };
    if (opens(R, n, n))
      found.push_back({0, 0.});
    for (unsigned int i = 0; i < n; ++i)
    {
      const WedgePlane &p = planes[i];
      const Vector3     S = crossed(p.normal, crossed(R, p.normal));
      const double      N = -dot(R, p.normal);
      if (N > 0. && opens(S, i, i))
        found.push_back({i + 1, (p.friction * N + p.cohesion * p.area) / norm(S)});
      for (unsigned int j = i + 1; j < n; ++j)
      {
        const WedgePlane &q = planes[j];
        const Vector3     line = unit(crossed(p.normal, q.normal));
        const Vector3     S_ij = combined(dot(R, line), line, 0., line);
        const Vector3     of_p = crossed(q.normal, line), of_q = crossed(p.normal, line);
        const double N_p = -dot(R, of_p) / dot(p.normal, of_p), N_q = -dot(R, of_q) / dot(q.normal, of_q);
        if (N_p > 0. && N_q > 0. && opens(S_ij, i, j))
          found.push_back({10 * (i + 1) + j + 1,
                           (p.friction * N_p + p.cohesion * p.area + q.friction * N_q + q.cohesion * q.area) /
                               norm(S_ij)});
      }
    }
    if (n == 3)
    {
      const Vector3 edges[3] = {crossed(planes[1].normal, planes[2].normal),
                                crossed(planes[2].normal, planes[0].normal),
                                crossed(planes[0].normal, planes[1].normal)};
      bool          all = true;
      for (unsigned int i = 0; i < 3; ++i)
        all = all && -dot(R, edges[i]) / dot(planes[i].normal, edges[i]) > 0.;
      if (all)
        found.push_back({123, std::numeric_limits<double>::infinity()});
    }
    return found;
  }

  /** Random wedges: exactly one mode is admissible, and it is the computed one with its safety. The driving force is
   * the projection of the total force on the allowed directions. A rotation about z changes nothing. */
  inline void enumeration()
  {
    std::mt19937                           random(7);
    std::uniform_real_distribution<double> any(-1., 1.);
    std::map<unsigned int, unsigned int>   count;
    double                                 worst = 0., worst_turned = 0., imbalance = 0.;
    for (unsigned int k = 0; k < 3000; ++k)
    {
      std::vector<WedgePlane> planes = random_planes(random, 1 + k % 3);
      Vector3                 force{{any(random), any(random), any(random)}}, R = force;
      for (const WedgePlane &one : planes)
        R = combined(1., R, one.uplift * one.area, one.normal);
      const WedgeState state = wedge_equilibrium(planes, force);
      const auto       modes = admissible(planes, R);
      expect(modes.size() == 1, "one admissible mode, not " + std::to_string(modes.size()));
      expect(modes[0].first == state.mode(), "the same mode");
      ++count[state.mode()];
      const auto difference = [](const double a, const double b)
      { return std::isinf(a) && std::isinf(b) ? 0. : std::abs(a - b) / std::max(1., std::abs(b)); };
      worst = std::max(worst, difference(state.safety, modes[0].second));
      Vector3 balance = combined(1., R, -1., state.driving);
      for (unsigned int i = 0; i < planes.size(); ++i)
      {
        balance = combined(1., balance, state.normal_force[i], planes[i].normal);
        expect(state.normal_force[i] >= 0., "compression");
        expect(dot(state.driving, planes[i].normal) > -1e-12, "no motion into the rock mass");
        if (state.contact[i])
          imbalance = std::max(imbalance, std::abs(dot(state.driving, planes[i].normal)));
      }
      imbalance = std::max(imbalance, norm(balance));
      for (unsigned int d = 0; d < 20; ++d) // no allowed direction is closer to R
      {
        const Vector3 s = unit({{any(random), any(random), any(random)}});
        bool          allowed = true;
        for (const WedgePlane &one : planes)
          allowed = allowed && dot(s, one.normal) >= 0.;
        expect(!allowed || dot(combined(1., R, -1., state.driving), s) < 1e-12, "projection");
      }
      const double a = 3. * any(random), c = std::cos(a), s = std::sin(a);
      const auto   turned = [&](const Vector3 &x) {
        return Vector3{{c * x[0] - s * x[1], s * x[0] + c * x[1], x[2]}};
      };
      for (WedgePlane &one : planes)
        one.normal = turned(one.normal);
      const WedgeState other = wedge_equilibrium(planes, turned(force));
      expect(other.mode() == state.mode(), "the mode of the turned wedge");
      worst_turned = std::max(worst_turned, difference(other.safety, state.safety));
    }
    for (const unsigned int mode : {0, 1, 2, 3, 12, 13, 23, 123})
      above("cases of mode " + std::to_string(mode), count[mode], 20);
    below("safety against the classical formulas", worst, 1e-11);
    below("safety of the turned wedge", worst_turned, 1e-11);
    below("balance of forces", imbalance, 1e-12);
  }

  constexpr const char *head =
      "wedge, plane, x [m], y [m], z [m], dip [deg], dip direction [deg], area [m2], "
      "friction [-], cohesion [Pa], uplift [Pa], volume [m3], density [kg/m3]\n";

  inline std::vector<RockWedge> read(const std::string &text)
  {
    Scene scene;
    scene.directory = ".";
    scene.limits.wedges = "wedges_of_test.csv";
    write_text(scene.limits.wedges, text);
    return rock_wedges(scene);
  }

  /** The file: orientations, units, and what is refused. */
  inline void files()
  {
    const std::string bottom = "left,bottom,1,2,3,30,90,500,0.7,1e5,2e4,9000,2600\n",
                      side = "left,side,4,5,6,90,-45,200,0.6,0,0,,\n";
    const auto wedges = read("\xEF\xBB\xBF# comment\n" + std::string(head) + bottom + "\n" + side +
                             "right,bottom,0,0,0,150,180,1,0,0,0,1,1000\n");
    expect(wedges.size() == 2 && wedges[0].planes.size() == 2 && wedges[1].planes.size() == 1, "two wedges");
    expect_close(wedges[0].mass(), 9000. * 2600., 1e-14, "mass");
    const auto near = [](const Vector3 &a, const Vector3 &b) { return norm(a - b) < 1e-14; };
    expect(near(wedges[0].planes[0].normal, {{0., .5, std::sqrt(.75)}}), "falls to the left bank");
    expect(near(wedges[0].planes[1].normal, {{std::sqrt(.5), -std::sqrt(.5), 0.}}), "vertical plane");
    expect(near(wedges[1].planes[0].normal, {{-.5, 0., -std::sqrt(.75)}}), "overhanging plane");
    expect(wedges[0].contains({{5., 5., 3.}}) && !wedges[0].contains({{5., 5., 1.}}) &&
               !wedges[0].contains({{3., 5., 9.}}),
           "sides of the planes");
    const auto by_normal = read("wedge;plane;nx;ny;nz;x;y;z;area;friction;cohesion;uplift;volume;density\n"
                                "a;b;0;0;-2;1;2;3;4;5;6;7;8;9\n");
    expect(near(by_normal[0].planes[0].normal, {{0., 0., -1.}}) && by_normal[0].planes[0].uplift == 7.,
           "normals, semicolons");
    const auto refused = [&](const std::string &what, const std::string &file, const std::string &words) {
      throws(what, [&] { read(file); }, {words, "Limits/Wedges"});
    };
    const std::string start = head;
    refused("parallel planes", start + bottom + "left,roof,1,2,9,150,-90,1,0,0,0,,\n", "parallel");
    refused("planes parallel to a line",
            start + bottom + "left,a,0,0,0,60,90,1,0,0,0,,\nleft,b,0,0,0,60,-90,1,0,0,0,,\n", "to one line");
    refused("negative area", start + "left,bottom,1,2,3,30,90,-500,0.7,1e5,2e4,9000,2600\n", "\"area\"");
    refused("friction in degrees", start + "left,bottom,1,2,3,30,90,5,35,1e5,2e4,9000,2600\n", "tan(phi)");
    refused("negative uplift", start + "left,bottom,1,2,3,30,90,5,1,1e5,-1,9000,2600\n", "at least 0");
    refused("dip above 180", start + "left,bottom,1,2,3,190,90,5,1,1e5,1,9000,2600\n", "from 0 to 180");
    refused("no number", start + "left,bottom,1,2,3,3 0,90,5,1,1e5,1,9000,2600\n", "line 2");
    refused("empty cell", start + "left,bottom,1,2,,30,90,5,1,1e5,1,9000,2600\n", "is empty");
    refused("two volumes", start + bottom + "left,side,4,5,6,90,-45,200,0.6,0,0,8000,\n", "volume 8000");
    refused("decimal comma", start + "left,bottom,1,2,3,30,90,5,0,7,1e5,1,9000,2600\n", "14 columns");
    refused(
        "comma in a name",
        "wedge;plane;nx;ny;nz;x;y;z;area;friction;cohesion;uplift;volume;density\na,b;c;0;0;1;1;2;3;4;5;6;7;8;9\n",
        "a comma");
    refused("plane twice", start + bottom + bottom, "two planes");
    refused("fourth plane",
            start + bottom + side + "left,c,0,0,0,80,200,1,0,0,0,,\nleft,d,0,0,0,9,9,1,0,0,0,,\n", "fourth");
    refused("one wedge with two names", start + "L" + bottom.substr(4) + "l" + side.substr(4),
            "but for capitals");
    refused("another unit", "wedge,plane,cohesion [MPa]\n", "[MPa]");
    refused("unknown column", "wedge,plane,cohesoin\n", "Did you mean \"cohesion\"");
    refused("missing column", "wedge,plane,x,y,z,dip,dip direction,area,friction,cohesion,uplift,volume\n",
            "\"density\" is missing");
    refused("dip alone", "wedge,plane,x,y,z,dip,area,friction,cohesion,uplift,volume,density\n",
            "orientation");
    refused(
        "zero normal",
        "wedge,plane,nx,ny,nz,x,y,z,area,friction,cohesion,uplift,volume,density\na,b,0,0,0,1,2,3,4,5,6,7,8,9\n",
        "normal of plane \"b\" is zero");
    refused("no line", start, "no wedge");
    Scene missing;
    missing.limits.wedges = "not_there.csv";
    throws("no file", [&] { rock_wedges(missing); }, {"cannot be read"});
  }
} // namespace Wedges

#endif
