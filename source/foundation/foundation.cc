#include <deal.II/base/parameter_handler.h>

#include <voussoir/base/error.h>
#include <voussoir/base/log.h>
#include <voussoir/foundation/foundation.h>
#include <voussoir/motion/ground_motion.h>
#include <voussoir/rock/boundary_table.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace Voussoir
{
  void FoundationParameters::add_parameters(dealii::ParameterHandler &prm)
  {
    using namespace dealii::Patterns;
    prm.enter_subsection("Foundation");
    prm.add_parameter("Model", model,
                      "rigid (the base moves as the ground motion says), rock (the rock of the mesh, "
                      "explicit, the earthquake "
                      "from below) or massless (its stiffness only, on a rigid ground that moves as the "
                      "ground motion says).",
                      Selection("rigid|rock|massless"));
    prm.add_parameter("Young's modulus", rock.young, "Modulus of elasticity of the rock [Pa].", Double(1.));
    prm.add_parameter("Poisson's ratio", rock.poisson, "Poisson's ratio of the rock [-].", Double(0., .45));
    prm.add_parameter("Density", rock.density, "Density of the rock [kg/m^3].", Double(1e-3));
    prm.add_parameter("Zones", zones,
                      "Materials of zones of the rock, as \"NAME: E nu rho, NAME: E nu rho\", modulus of "
                      "elasticity, Poisson's ratio and density, in Pa and kg/m^3 or with units; NAME is that "
                      "of the volumes \"rock NAME\" of the mesh.",
                      Map(Anything(), Anything()));
    prm.add_parameter("Mass damping", mass_damping, "Rayleigh damping of the rock: factor of the mass [1/s].",
                      Double(0., 1e3));
    prm.add_parameter(
        "Stiffness damping", stiffness_damping,
        "Rayleigh damping of the rock: factor of the stiffness [s]. It lowers the critical time step.",
        Double(0., 1.));
    prm.add_parameter("Boundary", boundary, "Artificial boundary: " + boundary_help() + ".",
                      Selection(boundary_names("|")));
    prm.add_parameter(
        "Free field", free_field,
        "Motion without the dam at the artificial boundary: sections (slices of the mesh where it cuts "
        "the valley) or columns (layers, with the local height of the ground).",
        Selection("sections|columns"));
    prm.add_parameter(
        "Nodal quadrature everywhere", nodal_everywhere,
        "Integrate all rock elements at their nodes, which is fastest and what free field by sections "
        "needs to be exact; else only the layers at the boundary.");
    prm.add_parameter("Nodal layers", nodal_layers, "Layers of nodal quadrature at the artificial boundary.",
                      Integer(0));
    prm.add_parameter("Substeps", substeps,
                      "Explicit steps of the rock in each step of the dam. More than one make the base "
                      "heavier: see doc/rock.md for the error.",
                      Integer(1, 100));
    prm.leave_subsection();
  }

  namespace
  {
    using Key = std::array<long long, 3>;

    template <class Point> Key key_of(const Point &p)
    {
      return {{std::llround(1e4 * p[0]), std::llround(1e4 * p[1]), std::llround(1e4 * p[2])}};
    }

    /** Conjugate gradients with the inverse diagonal blocks, the marked nodes fixed. */
    void conjugate_gradients(const BlockSparseMatrix &K, const std::vector<bool> &fixed, const Unknowns &b,
                             Unknowns &x, const double tolerance)
    {
      const int            n_nodes = static_cast<int>(K.n_rows());
      std::vector<Matrix3> diagonal(n_nodes);
      for (int i = 0; i < n_nodes; ++i)
        for (std::size_t k = K.start[i]; k < K.start[i + 1]; ++k)
          if (static_cast<int>(K.column[k]) == i)
            diagonal[i] = inverse(K.value[k]);
      const auto free_part = [&](Unknowns &y)
      {
        for (int i = 0; i < n_nodes; ++i)
          if (fixed[i])
            y[3 * i] = y[3 * i + 1] = y[3 * i + 2] = 0.;
      };
      const auto product = [](const Unknowns &y, const Unknowns &z)
      {
        double    sum = 0.;
        const int n = static_cast<int>(y.size());
#pragma omp parallel for simd reduction(+ : sum)
        for (int i = 0; i < n; ++i)
          sum += y[i] * z[i];
        return sum;
      };
      const int n = 3 * n_nodes;
      Unknowns  r(n), z(n), p(n), Kp(n);
      K.multiply(x.data(), Kp.data());
      for (int i = 0; i < n; ++i)
        r[i] = b[i] - Kp[i];
      free_part(r);
      double                 rz = 0.;
      const double           target = tolerance * std::sqrt(product(b, b));
      constexpr unsigned int most = 5000;
      for (unsigned int k = 0; std::sqrt(product(r, r)) > target; ++k)
      {
        if (k == most)
          throw ComputationError("The static state of the rock did not converge in " + std::to_string(most) +
                                 " steps: its elements may be badly shaped (see voussoir mesh).");
#pragma omp parallel for
        for (int i = 0; i < n_nodes; ++i)
        {
          const Vector3 y = diagonal[i] * Vector3{{r[3 * i], r[3 * i + 1], r[3 * i + 2]}};
          std::copy(y.begin(), y.end(), z.begin() + 3 * i);
        }
        const double rz_new = product(r, z), beta = k == 0 ? 0. : rz_new / rz;
        rz = rz_new;
#pragma omp parallel for simd
        for (int i = 0; i < n; ++i)
          p[i] = z[i] + beta * p[i];
        K.multiply(p.data(), Kp.data());
        free_part(Kp);
        const double alpha = rz / product(p, Kp);
#pragma omp parallel for simd
        for (int i = 0; i < n; ++i)
        {
          x[i] += alpha * p[i];
          r[i] -= alpha * Kp[i];
        }
      }
    }
  } // namespace

  RockRegionParameters region_parameters(const FoundationParameters &p, const std::array<double, 3> &centre,
                                         const double dt)
  {
    RockRegionParameters result;
    result.rock.materials = p.materials_by_volume();
    result.rock.nodal_everywhere = p.nodal_everywhere;
    result.rock.nodal_layers = p.nodal_layers;
    result.rock.centre = centre;
    result.damping.mass = p.mass_damping;
    result.damping.stiffness = p.stiffness_damping;
    result.dt = dt;
    result.boundary = p.boundary;
    result.free_field = p.free_field;
    return result;
  }

  std::vector<Foot> find_feet(const SolidModel &dam, const std::vector<std::array<double, 3>> &points,
                              const std::string &source)
  {
    std::map<Key, std::vector<unsigned int>> base;
    for (unsigned int i = 0; i < dam.n_nodes(); ++i)
      if (dam.on_surface(i, PhysicalId::base))
        base[key_of(dam.points[i])].push_back(dam.equation[i]);
    std::vector<Foot> feet;
    for (unsigned int i = 0; i < points.size(); ++i)
      if (const auto found = base.find(key_of(points[i])); found != base.end())
      {
        std::vector<unsigned int> &nodes = found->second;
        std::sort(nodes.begin(), nodes.end());
        nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
        feet.push_back({i, nodes});
      }
    if (feet.size() != base.size())
      throw InputError(source + ": the dam's base and the rock must share their nodes; " +
                       std::to_string(base.size() - feet.size()) + " nodes of the base are not in the rock.");
    return feet;
  }

  Foundation::Foundation(const FoundationParameters &parameters, const HexMesh &mesh, const SolidModel &dam,
                         const std::string &source)
      : parameters(parameters), mesh(parameters.volumes_by_material(mesh))
  {
    check_boundary_layers(parameters, this->mesh, source);
    unsigned int count = 0;
    for (unsigned int i = 0; i < dam.n_nodes(); ++i)
      if (dam.on_surface(i, PhysicalId::base))
      {
        for (unsigned int c = 0; c < 3; ++c)
          centre[c] += dam.points[i][c];
        ++count;
      }
    for (double &c : centre)
      c /= count;
    model = make_rock_model(this->mesh, region_parameters(parameters, centre, 0.).rock);
    foot = find_feet(dam, model.points, source);
    RayleighDamping damping;
    damping.mass = parameters.mass_damping;
    damping.stiffness = parameters.stiffness_damping;
    dt_critical = Voussoir::critical_time_step(largest_frequency(model.stiffness, model.mass), damping);
  }

  void Foundation::add_mass(Structure &structure) const
  {
    for (const Foot &f : foot)
      for (const unsigned int node : f.nodes)
        for (unsigned int c = 0; c < 3; ++c)
          structure.mass[node][4 * c] += model.mass[f.rock] / f.nodes.size();
  }

  Unknowns Foundation::static_springs(const Structure &structure) const
  {
    Unknowns springs(3 * structure.n_nodes(), 0.);
    double   largest = 0.;
    for (const Body &body : structure.bodies)
      for (const Foot &f : foot)
        for (const unsigned int node : f.nodes)
          if (node >= body.first_node && node < body.first_node + body.n_nodes())
          {
            const unsigned int i = node - body.first_node;
            for (std::size_t k = body.stiffness.start[i]; k < body.stiffness.start[i + 1]; ++k)
              if (body.stiffness.column[k] == i)
                largest = std::max(largest, body.stiffness.value[k][0]);
          }
    for (const Foot &f : foot)
      for (const unsigned int node : f.nodes)
        for (unsigned int c = 0; c < 3; ++c)
          springs[3 * node + c] = 10. * largest;
    return springs;
  }

  void Foundation::settle(const Unknowns &r, Unknowns &u_base)
  {
    std::vector<bool> fixed(n_nodes(), false);
    for (const BoundaryFace &face : model.faces)
      for (const unsigned int node : face.nodes)
        fixed[node] = true;
    Unknowns b(3 * std::size_t(n_nodes()), 0.);
    for (const Foot &f : foot)
      for (const unsigned int node : f.nodes)
        for (unsigned int c = 0; c < 3; ++c)
          b[3 * f.rock + c] += r[3 * node + c];
    rock_static.resize(b.size(), 0.);
    conjugate_gradients(model.stiffness, fixed, b, rock_static, 1e-11);
    u_base.resize(3 * foot.size());
    for (std::size_t i = 0; i < foot.size(); ++i)
      for (unsigned int c = 0; c < 3; ++c)
        u_base[3 * i + c] = rock_static[3 * foot[i].rock + c];
  }

  double Foundation::add_interface_mass(Structure &structure, const double time_step) const
  {
    if (parameters.substeps == 1)
      return 0.;
    std::vector<bool> is_foot(n_nodes(), false);
    for (const Foot &f : foot)
      is_foot[f.rock] = true;
    const BlockSparseMatrix &K = model.stiffness;
    double                   sum = 0.;
    for (const Foot &f : foot)
      for (unsigned int c = 0; c < 3; ++c)
      {
        double bound = 0.; // Gershgorin's
        for (std::size_t k = K.start[f.rock]; k < K.start[f.rock + 1]; ++k)
          for (unsigned int d = 0; is_foot[K.column[k]] && d < 3; ++d)
            bound += std::abs(K.value[k][3 * c + d]);
        const double added = .5 * time_step * time_step * bound;
        for (const unsigned int node : f.nodes)
          structure.mass[node][4 * c] += added / f.nodes.size();
        sum += added / 3.;
      }
    return sum;
  }

  void Foundation::start(const GroundMotion &outcrop, const double time_step, const unsigned int n_steps,
                         const Unknowns &u)
  {
    dt = time_step;
    const unsigned int         m = parameters.substeps;
    const RockRegionParameters p = region_parameters(parameters, centre, dt / m);
    region = make_region(model, p);
    if (n_steps > 0) // else without an earthquake
      shake(*region, mesh, model, p, incident_wave(outcrop), m * n_steps + 2);
    std::vector<unsigned int> nodes;
    for (const Foot &f : foot)
      nodes.push_back(f.rock);
    region->set_prescribed(nodes);
    region->keep_energy();
    const std::size_t n = 3 * foot.size();
    rest.assign(n, 0.);
    for (std::size_t i = 0; i < foot.size(); ++i)
      for (const unsigned int node : foot[i].nodes)
        for (unsigned int c = 0; c < 3; ++c)
          rest[3 * i + c] += u[3 * node + c] / foot[i].nodes.size();
    v.assign(n, 0.);
    a = u_feet = u_predicted = v_predicted = force = force_before = v;
  }

  void Foundation::advance(Unknowns &load)
  {
    const Stopwatch    watch;
    const unsigned int m = parameters.substeps;
    const std::size_t  n = 3 * foot.size();
    const Unknowns     u_before = u_predicted, v_before = v_predicted;
    for (std::size_t i = 0; i < foot.size(); ++i)
      for (unsigned int c = 0; c < 3; ++c)
      {
        const std::size_t k = 3 * i + c;
        u_predicted[k] = u_feet[k] + dt * v[k] + .25 * dt * dt * a[k];
        v_predicted[k] = v[k] + .5 * dt * a[k];
      }
    Unknowns        u(n), v_now(n);
    const Unknowns *taken = nullptr;
    for (unsigned int j = 1; j <= m; ++j)
    {
      const double part = double(j) / m;
      for (std::size_t k = 0; k < n; ++k)
      {
        u[k] = u_before[k] + part * (u_predicted[k] - u_before[k]);
        v_now[k] = v_before[k] + part * (v_predicted[k] - v_before[k]);
      }
      taken = &region->advance(u, v_now);
    }
    force_before.swap(force);
    for (std::size_t i = 0; i < foot.size(); ++i)
      for (unsigned int c = 0; c < 3; ++c)
      {
        // The damping of the rock's mass at the base is the dam's.
        const std::size_t k = 3 * i + c;
        force[k] = parameters.mass_damping * model.mass[foot[i].rock] * v_predicted[k] - (*taken)[k];
        for (const unsigned int node : foot[i].nodes)
          load[3 * node + c] += force[k] / foot[i].nodes.size();
      }
    seconds += watch.seconds();
  }

  void Foundation::follow(const DynamicState &state)
  {
    for (std::size_t i = 0; i < foot.size(); ++i)
      for (unsigned int c = 0; c < 3; ++c)
      {
        const std::size_t k = 3 * i + c;
        const double      part = 1. / foot[i].nodes.size();
        double            u_new = 0., v_new = 0.;
        for (const unsigned int node : foot[i].nodes)
        {
          u_new += part * state.u[3 * node + c];
          v_new += part * state.v[3 * node + c];
        }
        u_new -= rest[k];
        work[0] += .5 * (force_before[k] + force[k]) * (u_new - u_feet[k]);
        u_feet[k] = u_new;
        a[k] = 2. / dt * (v_new - v[k]) - a[k];
        v[k] = v_new;
      }
  }

  Vector3 Foundation::base_velocity() const
  {
    Vector3 result{};
    for (std::size_t i = 0; i < foot.size(); ++i)
      for (unsigned int c = 0; c < 3; ++c)
        result[c] += v_predicted[3 * i + c] / foot.size();
    return result;
  }

  std::vector<std::vector<double> *> Foundation::state()
  {
    std::vector<std::vector<double> *> arrays = region->state();
    for (Unknowns *array : {&rest, &u_feet, &v, &a, &u_predicted, &v_predicted, &force, &work})
      arrays.push_back(array);
    return arrays;
  }
} // namespace Voussoir
