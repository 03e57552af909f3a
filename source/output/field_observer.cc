// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/output/archive.h>
#include <voussoir/output/joint_surfaces.h>
#include <voussoir/output/observers.h>

#include <cmath>

namespace Voussoir
{
  namespace
  {
    std::string joints_file_of(const std::string &solution) // solution-NNNNN.vtu
    {
      return "joints" + solution.substr(8);
    }
  } // namespace

  void FieldObserver::flush()
  {
    if (run.is_due(run.scene().output.solution_interval.samples))
      write();
  }

  void FieldObserver::open(const std::string &path)
  {
    directory = path;
    if (is_resumed && (files.empty() || files.back().first != run.integrator->state().time))
      flush(); // the previous process could not write the file, for example on a full disk
  }

  void FieldObserver::add_stresses(std::vector<FieldWriter::NodalField> &fields) const
  {
    constexpr const char     *components[6] = {"xx", "yy", "zz", "xy", "yz", "zx"};
    const std::vector<Stress> s = stresses.now();
    fields = {{"max_principal", std::vector<float>(s.size())},
              {"min_principal", std::vector<float>(s.size())}};
    for (unsigned int c = 0; c < 6; ++c)
      fields.push_back({std::string("stress_") + components[c], std::vector<float>(s.size())});
    for (std::size_t i = 0; i < s.size(); ++i)
    {
      for (unsigned int c = 0; c < 6; ++c)
        fields[2 + c].values[i] = s[i][c];
      const auto p = principal_stresses(s[i]);
      fields[0].values[i] = p[0];
      fields[1].values[i] = p[1];
    }
    for (unsigned int k = 0; k < 2; ++k) // the vertical stress is stress_zz
    {
      fields.push_back({std::string(FaceDirections::name(k)) + "_stress", std::vector<float>(s.size(), 0.f)});
      for (const NodeOnFace &at : stresses.envelope.faces.directions.nodes)
        fields.back().values[at.node] = at.stresses(s[at.node])[k];
    }
  }

  /** Adds opening, slip, pressure and contact state (0 open, 1 stick, 2 slip) at the nodes of the joints. The
   * values elsewhere are 0, 0, 0 and -1, since deal.II would propagate NaN to the cells. */
  void FieldObserver::add_joints(std::vector<FieldWriter::NodalField> &fields) const
  {
    const Structure   &structure = run.dam->structure;
    const SolidModel  &model = *run.dam->model;
    std::vector<float> opening(structure.n_nodes(), 0.f), slip(opening), state(opening.size(), -1.f),
        pressure(opening);
    for (unsigned int p = 0; p < structure.pairs.size(); ++p)
    {
      const Vector3 d = run.integrator->opening_and_slip(p);
      for (const unsigned int node : {structure.pairs[p].node_1, structure.pairs[p].node_2})
        if (node != rigid_ground)
        {
          opening[node] = d[0];
          slip[node] = std::hypot(d[1], d[2]);
          pressure[node] = joint_pressure(structure, run.integrator->state(), p);
          state[node] = static_cast<float>(run.pairs()[p]);
        }
    }
    const std::pair<const char *, const std::vector<float> *> all[] = {
        {"opening", &opening}, {"slip", &slip}, {"joint_pressure", &pressure}, {"joint_state", &state}};
    for (const auto &field : all)
    {
      fields.push_back(
          {field.first, std::vector<float>(model.n_nodes(), field.second == &state ? -1.f : 0.f)});
      for (unsigned int i = 0; i < model.n_nodes(); ++i)
        if (model.equation[i] != rigid_ground)
          fields.back().values[i] = (*field.second)[model.equation[i]];
    }
  }

  void FieldObserver::write()
  {
    std::vector<FieldWriter::NodalField> fields;
    add_stresses(fields);
    add_joints(fields);
    if (const AcousticWater *water = run.dam->water.get())
    {
      const std::vector<double> pressure = water->at_dam(water->pressure());
      fields.push_back({"water_pressure", {pressure.begin(), pressure.end()}});
    }
    char name[40];
    std::snprintf(name, sizeof(name), "solution-%05u.vtu", run.step);
    const Dam &dam = *run.dam;
    FieldWriter(*dam.model).write_vtu(directory + "/" + name, run.integrator->state().u, fields);
    files.emplace_back(run.integrator->state().time, name);
    if (!dam.structure.pairs.empty())
      write_joint_surfaces(directory + "/" + joints_file_of(name), *dam.model, dam.structure, *run.integrator,
                           run.pairs());
    write_collection();
  }

  /** Writes solution.pvd, with the files of the dam and of the joints at all times so far. */
  void FieldObserver::write_collection() const
  {
    OutputFile pvd(directory + "/solution.pvd");
    const auto add = [&](const double time, const std::string &file, const int part)
    { pvd << "<DataSet timestep=\"" << time << "\" file=\"" << file << "\" part=\"" << part << "\"/>\n"; };
    pvd << "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n<Collection>\n";
    for (const auto &[time, file] : files)
    {
      add(time, file, 0);
      if (!run.dam->structure.pairs.empty())
        add(time, joints_file_of(file), 1);
    }
    pvd << "</Collection>\n</VTKFile>\n";
    pvd.check();
  }

  void FieldObserver::save(boost::archive::binary_oarchive &archive) const
  {
    archive << files;
  }

  void FieldObserver::load(boost::archive::binary_iarchive &archive)
  {
    archive >> files;
    is_resumed = true;
  }
} // namespace Voussoir
