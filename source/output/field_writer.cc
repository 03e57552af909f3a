// SPDX-License-Identifier: GPL-3.0-or-later
#include <deal.II/fe/fe_system.h>
#include <deal.II/lac/vector.h>
#include <deal.II/numerics/data_out.h>

#include <voussoir/base/error.h>
#include <voussoir/output/recorders.h>
#include <voussoir/output/vtu_flags.h>
#include <voussoir/solid/face_quads.h>
#include <voussoir/solid/solid_grid.h>
#include <voussoir/solid/solid_model.h>

#include <map>

namespace Voussoir
{
  using namespace dealii;

  FieldWriter::FieldWriter(const SolidModel &model) : model(model) {}

  void FieldWriter::write_vtu(const std::string &file, const Unknowns &u,
                              const std::vector<NodalField> &fields) const
  {
    const FESystem<3>          system(model.grid->fe, 3);
    Vector<float>              monolith(model.grid->triangulation.n_active_cells());
    DoFHandler<3>              vector_handler(model.grid->triangulation);
    Vector<float>              displacement;
    std::vector<Vector<float>> scalars;
    DataOut<3>                 data_out; // declared last, because it refers to the others
    data_out.attach_triangulation(model.grid->triangulation); // before any data
    scalars.reserve(fields.size());
    for (const NodalField &field : fields)
    {
      scalars.emplace_back(field.values.begin(), field.values.end());
      data_out.add_data_vector(model.grid->dof_handler, scalars.back(), field.name);
    }
    for (const auto &cell : model.grid->triangulation.active_cell_iterators())
      monolith[cell->active_cell_index()] = static_cast<float>(monolith_of(cell->material_id()));
    data_out.add_data_vector(monolith, "monolith", DataOut<3>::type_cell_data);
    if (!u.empty())
    {
      vector_handler.distribute_dofs(system);
      displacement.reinit(vector_handler.n_dofs());
      std::vector<types::global_dof_index> dofs(system.n_dofs_per_cell()),
          nodes(model.grid->fe.n_dofs_per_cell());
      auto cell = vector_handler.begin_active();
      for (const auto &scalar_cell : model.grid->dof_handler.active_cell_iterators())
      {
        cell->get_dof_indices(dofs);
        scalar_cell->get_dof_indices(nodes);
        for (unsigned int i = 0; i < dofs.size(); ++i)
        {
          const auto         component = system.system_to_component_index(i);
          const unsigned int e = model.equation[nodes[component.second]];
          displacement[dofs[i]] = e == rigid_ground ? 0. : u[3 * e + component.first];
        }
        ++cell;
      }
      data_out.add_data_vector(vector_handler, displacement, std::vector<std::string>(3, "displacement"),
                               std::vector<DataComponentInterpretation::DataComponentInterpretation>(
                                   3, DataComponentInterpretation::component_is_part_of_vector));
    }
    data_out.build_patches(model.degree);
    data_out.set_flags(vtu_flags());
    OutputFile out(file);
    try
    {
      data_out.write_vtu(out);
    }
    catch (const ExceptionBase &) // thrown by deal.II
    {
      throw WriteError::of(file);
    }
    out.check();
  }

  void FieldWriter::write_faces(const std::string &directory, const DamGeometry &geometry,
                                const std::vector<NodalField> &fields) const
  {
    OutputFile nodes(directory + "/faces.csv"), quads(directory + "/faces_cells.csv");
    nodes.precision(8);
    nodes << "face,monolith,x,y,z,s";
    for (const NodalField &field : fields)
      nodes << ',' << field.name;
    nodes << '\n';
    quads << "face,monolith,n0,n1,n2,n3\n";
    unsigned int n_lines = 0;
    for (const int surface : {PhysicalId::upstream, PhysicalId::downstream})
    {
      const std::string                    name = surface == PhysicalId::upstream ? "upstream" : "downstream";
      std::map<unsigned int, unsigned int> line_of;
      for (const FaceQuad &quad : face_quads(model, surface))
      {
        for (const unsigned int i : quad.nodes)
          if (line_of.emplace(i, n_lines).second)
          {
            ++n_lines;
            const Vector3 &p = model.points[i];
            nodes << name << ',' << monolith_of(quad.block) << ',' << p[0] << ',' << p[1] << ',' << p[2]
                  << ',' << geometry.arc_length(p);
            for (const NodalField &field : fields)
              nodes << ',' << field.values[i];
            nodes << '\n';
          }
        quads << name << ',' << monolith_of(quad.block);
        for (const unsigned int i : quad.nodes)
          quads << ',' << line_of[i];
        quads << '\n';
      }
    }
    nodes.check();
    quads.check();
  }
} // namespace Voussoir
