// SPDX-License-Identifier: GPL-3.0-or-later
// The seam of the artificial boundary: its table is what scenes, help and messages know, and a region takes
// one that is in no table.

#include "box.h"
#include "column.h"

#include <voussoir/base/entries.h>
#include <voussoir/base/error.h>
#include <voussoir/foundation/foundation_parameters.h>
#include <voussoir/rock/boundary_table.h>

#include <set>

namespace
{
  using namespace Boxes;
  using Columns::below;

  void check(const std::string &what, const bool good)
  {
    Columns::report(what, 0., "-", good);
  }

  /** Sets the boundary of a scene; false if it is refused. */
  bool accepts(const std::string &name)
  {
    Entries              prm;
    FoundationParameters p;
    p.add_parameters(prm);
    try
    {
      prm.parse_input_from_string("subsection Foundation\nset Boundary = " + name + "\nend\n");
    }
    catch (const std::exception &)
    {
      return false;
    }
    return p.boundary == name;
  }

  void table()
  {
    std::set<std::string> names;
    const std::string     help = boundary_help();
    for (const BoundaryRow &row : boundary_table())
    {
      check(row.name + " is made, and has a name and a meaning of its own",
            row.make() != nullptr && !row.doc.empty() && names.insert(row.name).second);
      check("  scenes take it, help names it",
            accepts(row.name) && help.find(row.name + " (" + row.doc + ")") != std::string::npos);
      const std::string others = " " + other_boundaries(row.name) + " ";
      check("  advice is two others", others.find(" or ") != std::string::npos &&
                                          others.find(" " + row.name + " ") == std::string::npos);
    }
    check("the default is one of them", names.count(RockRegionParameters().boundary) == 1);
    check("scenes take no other", !accepts("mtf7") && !accepts("mtf"));
    std::string message;
    try
    {
      make_boundary("mtf7");
    }
    catch (const InputError &error)
    {
      message = error.what();
    }
    check("the message names all", message.find("\"mtf7\"") != std::string::npos &&
                                       message.find(boundary_names(", ")) != std::string::npos);
    check("what they need of the mesh", make_boundary("mtf1")->n_layers() == 6 &&
                                            make_boundary("mtf4")->n_layers() == 9 &&
                                            make_boundary("viscous")->n_layers() == 0);
  }

  /** A boundary of nobody's table: its nodes stand. */
  class Standing : public ArtificialBoundary
  {
  public:
    void attach(const RockModel &model, const Vector3 &, double) override
    {
      for (const BoundaryLine &line : model.lines)
        node.push_back(line.nodes[0]);
    }
    const std::vector<unsigned int> &nodes() const override { return node; }
    const std::vector<unsigned int> &free_field_nodes() const override { return node; }
    void                             advance(const RegionStep &step) override
    {
      for (const unsigned int i : node)
        std::fill_n(step.w.begin() + 3 * std::size_t(i), 3, 0.);
      steps[0] += 1.;
    }
    std::vector<std::vector<double> *> state() override { return {&steps}; }

  private:
    std::vector<unsigned int> node;
    std::vector<double>       steps = {0.};
  };

  void stranger()
  {
    constexpr unsigned int n = 6;
    RockRegionParameters   p;
    p.rock.materials[rock] = unit_rock();
    p.rock.nodal_everywhere = true;
    p.dt = .3;
    p.boundary = "fixed";
    const RockModel model =
        make_rock_model(box({n, n, n}, {"x-", "x+", "y-", "y+", "z-"},
                            [](const double i, const double j, const double k) -> Vector3 {
                              return {{i, j, k}};
                            }),
                        p.rock);
    const auto fixed = make_region(model, p);
    p.boundary_maker = [] { return std::make_unique<Standing>(); };
    const auto region = make_region(model, p);
    double     difference = 0., largest = 0.;
    for (ExplicitRegion *r : {fixed.get(), region.get()})
    {
      r->keep_energy();
      r->force.assign(3 * model.points.size(), 0.);
    }
    const std::size_t pushed = 3 * (n * (n + 1) * (n + 1) + n / 2 * (n + 1) + n / 2) + 2;
    for (unsigned int step = 0; step < 200; ++step)
    {
      for (ExplicitRegion *r : {fixed.get(), region.get()})
      {
        r->force[pushed] = step < 10 ? -1. : 0.;
        r->advance();
      }
      for (std::size_t i = 0; i < 3 * model.points.size(); ++i)
      {
        largest = std::max(largest, std::abs(fixed->displacement()[i]));
        difference = std::max(difference, std::abs(fixed->displacement()[i] - region->displacement()[i]));
      }
    }
    Columns::above("largest displacement of a box that was pushed", largest, .01);
    below("  fixed boundary - one of no table, whose nodes stand", difference, 1e-300);
    below("  energy account", region->energy().balance() / region->energy().external, 1e-10);
    double counted = 0.;
    for (const auto *array : region->state())
      if (array->size() == 1 && array->front() == 200.)
        counted += 1.;
    check("  its memory is part of the region's state", counted == 2.); // with the region's clock
  }
} // namespace

int main()
{
  return Columns::run_all({table, stranger});
}
