// Helpers of the tests of the mesh module.

#ifndef voussoir_tests_mesh_testing_h
#define voussoir_tests_mesh_testing_h

#include <voussoir/base/error.h>
#include <voussoir/mesh/mesh.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <iostream>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace MeshTesting
{
  using namespace Voussoir;

  inline void expect(const bool condition, const std::string &what)
  {
    if (!condition)
      throw std::runtime_error(what);
  }

  inline void expect_close(const double value, const double expected, const double relative,
                           const std::string &what)
  {
    std::ostringstream text;
    text << what << " is " << value << ", expected " << expected;
    expect(std::abs(value - expected) <= relative * std::abs(expected), text.str());
  }

  /** @p action must throw an InputError whose text holds all of @p parts. */
  template <class Error = InputError>
  void expect_error(const std::function<void()> &action, const std::vector<std::string> &parts)
  {
    try
    {
      action();
    }
    catch (const Error &error)
    {
      for (const std::string &part : parts)
        expect(std::string(error.what()).find(part) != std::string::npos,
               "the message lacks '" + part + "': " + error.what());
      return;
    }
    throw std::runtime_error("no error; expected one with '" + parts[0] + "'");
  }

  inline double smallest_jacobian(const HexMesh &mesh)
  {
    double result = 1e300;
    for (const auto &cell : mesh.cells)
      result = std::min(result, min_jacobian(mesh, cell));
    return result;
  }

  /** A bar of unit cubes along y, one monolith each, fixed at the first one's bottom. */
  inline HexMesh bar(const unsigned int n)
  {
    HexMesh mesh;
    for (unsigned int j = 0; j <= n; ++j)
      for (const auto &p : {std::array<double, 2>{0, 0}, {1, 0}, {0, 1}, {1, 1}})
        mesh.nodes.push_back({p[0], double(j), p[1]});
    for (unsigned int j = 0; j < n; ++j)
    {
      const unsigned int a = 4 * j, b = a + 4;
      mesh.cells.push_back({{a, a + 1, b + 1, b, a + 2, a + 3, b + 3, b + 2}, int(j + 1)});
      mesh.faces.push_back({{a, a + 1, b + 1, b}, PhysicalId::base});
    }
    return mesh;
  }

  using Point = std::array<long, 3>; // rounded to about a micrometre

  inline Point rounded(const std::array<double, 3> &p)
  {
    const double scale = 0.7310587e6; // no decimal fraction is halfway between two integers
    return {std::lround(p[0] * scale), std::lround(p[1] * scale), std::lround(p[2] * scale)};
  }

  inline void expect_same(const HexMesh &a, const HexMesh &b)
  {
    expect(a.nodes.size() == b.nodes.size() && a.cells.size() == b.cells.size() &&
               a.faces.size() == b.faces.size(),
           "different numbers of nodes, cells or faces");
    for (unsigned int n = 0; n < a.nodes.size(); ++n)
      for (unsigned int d = 0; d < 3; ++d)
        expect(std::abs(a.nodes[n][d] - b.nodes[n][d]) <= 1e-15 * 300, "different coordinates");
    for (unsigned int c = 0; c < a.cells.size(); ++c)
      expect(a.cells[c].nodes == b.cells[c].nodes && a.cells[c].volume == b.cells[c].volume,
             "different cells");
    const auto sorted = [](const HexMesh &mesh)
    {
      std::multiset<std::pair<int, std::array<unsigned int, 4>>> faces;
      for (const auto &face : mesh.faces)
        faces.insert({face.surface, face.nodes});
      return faces;
    };
    expect(sorted(a) == sorted(b), "different faces");
    expect(a.names == b.names, "different names");
  }

  /** Runs the tests, prints "name: OK" or what failed; returns main's status. */
  inline int run(const std::vector<std::pair<std::string, std::function<void()>>> &tests)
  {
    bool failed = false;
    for (const auto &test : tests)
      try
      {
        test.second();
        std::cout << test.first << ": OK" << std::endl;
      }
      catch (const std::exception &error)
      {
        std::cout << test.first << ": FAILED: " << error.what() << std::endl;
        failed = true;
      }
    return failed ? 1 : 0;
  }
} // namespace MeshTesting

#endif
