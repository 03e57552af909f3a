// SPDX-License-Identifier: GPL-3.0-or-later
// Zones of a mesh: names, files, open joints, sections, and the materials that cells, nodes and rock get.

#include "mesh_testing.h"

#include <deal.II/base/exceptions.h>

#include <voussoir/base/error.h>
#include <voussoir/foundation/foundation_parameters.h>
#include <voussoir/mesh/gmsh_io.h>
#include <voussoir/mesh/mesh_groups.h>
#include <voussoir/mesh/mesh_joints.h>
#include <voussoir/rock/sections.h>
#include <voussoir/solid/solid_model.h>
#include <voussoir/solid/stress.h>

#include <map>

namespace
{
  using namespace MeshTesting;

  void names()
  {
    for (const auto &name : {std::array<std::string, 2>{"monolith 3", ""},
                             {"Monolith_3-Heel", "heel"},
                             {"monolith3 Heel 2", "heel 2"},
                             {"rock", ""},
                             {"rock 1000", ""},
                             {"rock 12345", ""},
                             {"Rock_weak layer", "weak layer"},
                             {"rock 2", "2"},
                             {"foundation heel", ""}})
      expect(zone_of(name[0]) == name[1], "the zone of " + name[0] + ": " + zone_of(name[0]));
    expect(physical_id(3, "monolith 3 heel") == 3 && physical_id(3, "monolith 3 4") == -1 &&
               physical_id(3, "monolith heel") == -1 && physical_id(3, "rock heel") == PhysicalId::first_rock,
           "volumes with zones");
    expect(zone_name("Weak_layer2") == "weak layer 2", "spelling");
  }

  /** Four monoliths in a row, the outer two of two cells each; zones alternate. */
  HexMesh zoned_bar()
  {
    HexMesh                           mesh = bar(6);
    constexpr int                     volume[6] = {1, 1, 2, 3, 4, 4};
    const std::array<const char *, 6> zone = {"", "heel", "heel", "", "crown 2", "heel"};
    for (unsigned int c = 0; c < 6; ++c)
    {
      mesh.cells[c].volume = volume[c];
      mesh.cells[c].zone = zone_index(mesh, zone[c]);
    }
    return mesh;
  }

  /** By the cells' places: MSH 2.2 has them group by group. */
  void expect_same_zones(const HexMesh &a, const HexMesh &b, const std::string &what)
  {
    std::map<Point, std::pair<std::string, int>> of_place;
    const auto                                   of = [](const HexMesh &mesh, const HexMesh::Cell &cell)
    { return std::make_pair(mesh.zones.at(cell.zone), std::min<int>(cell.volume, PhysicalId::first_rock)); };
    for (const auto &cell : a.cells)
      of_place[rounded(centre(a, cell.nodes))] = of(a, cell);
    expect(a.cells.size() == b.cells.size() && of_place.size() == a.cells.size(), what + ": cells");
    for (const auto &cell : b.cells)
      expect(of_place.at(rounded(centre(b, cell.nodes))) == of(b, cell),
             what + ": zone and volume of the cell at " + place(centre(b, cell.nodes)));
  }

  /** Rock of two zones in one volume, and cells without zone. */
  HexMesh zoned_rock()
  {
    HexMesh mesh = Grids::box({3, 3, 4}, {"x-", "x+", "y-", "y+", "z-"},
                              [](const double i, const double j, const double k) -> Vector3 {
                                return {{i, j, k}};
                              });
    for (auto &cell : mesh.cells)
    {
      const auto middle = centre(mesh, cell.nodes);
      cell.zone = zone_index(mesh, middle[2] > 3. ? "weak layer" : middle[1] > 2. ? "fault" : "");
    }
    return mesh;
  }

  void files()
  {
    for (const double version : {4.1, 2.2})
      for (const HexMesh &mesh : {zoned_bar(), zoned_rock()})
      {
        write_gmsh(mesh, "zones.msh", version);
        const HexMesh once = read_gmsh("zones.msh");
        expect_same_zones(mesh, once, "written and read");
        write_gmsh(once, "zones.msh", version);
        const HexMesh twice = read_gmsh("zones.msh");
        expect_same_zones(mesh, twice, "and again");
        expect(group_table(once) == group_table(twice), group_table(twice));
      }
    write_gmsh(zoned_bar(), "zones.msh");
    const std::string table = group_table(read_gmsh("zones.msh"));
    for (const char *part :
         {"monolith 1 heel ... monolith 2 heel  ->  monolith 1 to monolith 2, zone heel  2 hexahedra",
          "monolith 4 heel", "->  monolith 4, zone heel", "monolith 4, zone crown 2"})
      expect(table.find(part) != std::string::npos, part + (" is not in\n" + table));
  }

  /** Steps between input and element matrices that copy cells. */
  void copies()
  {
    const HexMesh mesh = zoned_bar(), opened = open_joints(mesh);
    expect(joints_of(opened).size() == 3, "joints between monoliths only, not between zones");
    expect_same_zones(mesh, opened, "opened");
    expect_same_zones(mesh, close_joints(opened), "closed");
    HexMesh        rock = zoned_rock(); // a volume for each zone, as FoundationParameters makes them
    RockParameters parameters;
    for (auto &cell : rock.cells)
    {
      cell.volume = PhysicalId::first_rock + cell.zone;
      parameters.materials[cell.volume].density = 1. + cell.zone;
    }
    const HexMesh section = extruded_section(make_rock_model(rock, parameters), 0, 1);
    expect(section.cells.size() == 12, "a section of 3 x 4 cells");
    for (const auto &cell : section.cells)
    {
      const auto middle = centre(section, cell.nodes);
      expect(rock.zones.at(cell.volume - PhysicalId::first_rock) == (middle[2] > 3.   ? "weak layer"
                                                                     : middle[1] > 2. ? "fault"
                                                                                      : ""),
             "rocks of a section");
    }
  }

  Material material(const double young, const double density)
  {
    Material m;
    m.young = young;
    m.poisson = 0.;
    m.density = density;
    return m;
  }

  /** A bar along y, stretched: the mass of each zone, the stress of each, and at interfaces of the stiffest.
   */
  void solid()
  {
    HexMesh mesh = bar(4);
    mesh.faces.clear();
    for (unsigned int c = 0; c < 4; ++c)
    {
      mesh.cells[c].volume = 1;
      mesh.cells[c].zone = zone_index(mesh, c == 1 ? "soft" : c == 2 ? "stiff" : "");
    }
    const SolidModel model(mesh, 1);
    expect(model.zone == std::vector<unsigned int>({0, 1, 2, 0}), "zones of the cells");
    const std::vector<Material> materials = {material(10., 1.), material(3., 2.), material(70., 5.)};
    expect_error<dealii::ExceptionBase>(
        [&] {
          assemble_structure(model, {materials[0], materials[1]}, true);
        },
        {"2", "3"});
    const Structure structure = assemble_structure(model, materials, true);
    double          mass = 0.;
    for (const Matrix3 &m : structure.mass)
      mass += m[0];
    expect_close(mass, 1. + 2. + 5. + 1., 1e-13, "mass");
    Unknowns u(3 * structure.n_nodes(), 0.), force;
    for (unsigned int i = 0; i < model.n_nodes(); ++i)
      u[3 * model.equation[i] + 1] = .001 * model.points[i][1];
    structure.multiply_stiffness(u, force);
    std::vector<Stress> stress;
    StressRecovery(model, materials, true).apply(u, {}, stress);
    const double expected[5] = {10., 10., 70., 70., 10.}, // of the nodes at y = 0, 1, ...
        of_layer[5] = {-10., 7., -67., 60., 10.};         // their forces
    double sum[5] = {};
    for (unsigned int i = 0; i < model.n_nodes(); ++i)
    {
      const unsigned int y = std::lround(model.points[i][1]);
      sum[y] += force[3 * model.equation[i] + 1];
      expect_close(stress[i][1], .001 * expected[y], 1e-6, "stress at y = " + std::to_string(y));
    }
    for (unsigned int y = 0; y < 5; ++y)
      expect_close(sum[y], .001 * of_layer[y], 1e-12, "forces at y = " + std::to_string(y));
  }

  void entries()
  {
    const auto m =
        zone_materials({{"Heel", "24 GPa 0.2 2.4 t/m^3"}, {"crown-2", "1e9 0 2300 kg / m^3"}}, "Z");
    expect(m.size() == 2 && m.at("heel").young == 24e9 && m.at("heel").poisson == .2 &&
               m.at("heel").density == 2400. && m.at("crown 2").young == 1e9 &&
               m.at("crown 2").density == 2300.,
           "materials of an entry");
    for (const auto &bad : {std::array<std::string, 2>{"24e9 .2", "three values"},
                            {"24e9 .2 2400 1", "three values"},
                            {"", "three values"},
                            {"0 .2 2400", "positive"},
                            {"inf .2 2400", "positive"},
                            {"24 kg .2 2400", "kg"},
                            {"24e9 .5 2400", "from 0 to 0.499"},
                            {"24e9 -.1 2400", "from 0 to 0.499"},
                            {"24e9 nan 2400", "from 0 to 0.499"},
                            {"24e9 .2 -2400", "positive"},
                            {"24e9 .2 nan", "positive"},
                            {"24e9 x .2 2400", "24e9 x"}})
      expect_error(
          [&] {
            zone_materials({{"heel", bad[0]}}, "Concrete/Zones");
          },
          {"Concrete/Zones", "heel", bad[1]});
    expect_error([&] { zone_materials({{"a b", "1 0 1"}, {"A-b", "1 0 1"}}, "Z"); }, {"twice"});
    expect_error(
        [&] {
          zones_of(zoned_bar(), false, Material(), {{"heal", Material()}}, "Concrete/Zones");
        },
        {"Concrete/Zones", "\"heal\"", "Did you mean \"heel\"?"});
    expect_error(
        [&] {
          zones_of(zoned_bar(), true, Material(), {{"heel", Material()}}, "Foundation/Zones");
        },
        {"rock", "no zones"});
    const auto zones =
        zones_of(zoned_bar(), false, Material(), {{"heel", material(1., 1.)}}, "Concrete/Zones");
    expect(zones.size() == 3 && zones[0].name.empty() && zones[1].name == "heel" && zones[1].listed &&
               zones[1].material.young == 1. && zones[2].name == "crown 2" && !zones[2].listed &&
               zones[2].material.young == Material().young,
           "zones of the mesh");
    expect_close(zones[1].volume, 3., 1e-13, "volume of a zone");
  }

  /** Rock has one volume for each material, whatever volumes the mesh has. */
  void rock()
  {
    FoundationParameters p;
    p.zones = {{"weak layer", "1e9 .3 2000"}, {"fault", "1 GPa 0.3 2000"}};
    const HexMesh alike = p.volumes_by_material(zoned_rock());
    for (const auto &cell : alike.cells)
      expect(cell.volume == PhysicalId::first_rock + (cell.zone == 0 ? 0 : 1), "two zones of one material");
    p.zones["weak layer"] = "1e9 .3 2100";
    const HexMesh mesh = p.volumes_by_material(zoned_rock());
    const auto    materials = p.materials_by_volume();
    expect(materials.size() == 3, "three materials");
    for (const auto &cell : mesh.cells)
    {
      const std::string &zone = mesh.zones[cell.zone];
      const double       density = zone.empty() ? 2700. : zone == "fault" ? 2000. : 2100.;
      expect(materials.at(cell.volume).density == density, "the material of a volume");
    }
  }
} // namespace

int main()
{
  return run({{"names", names},
              {"files", files},
              {"copies", copies},
              {"solid", solid},
              {"entries", entries},
              {"rock", rock}});
}
