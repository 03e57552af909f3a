// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/error.h>
#include <voussoir/foundation/massless_rock.h>
#include <voussoir/foundation/massless_support.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace Voussoir
{
  namespace
  {
    class MasslessRock : public Foundation, public StepNeighbour
    {
    public:
      explicit MasslessRock(const FoundationSite &site)
          : parameters(site.parameters), mesh(site.mesh), source(site.source),
            incompatible_modes(site.incompatible_modes), one_body(site.one_body)
      {
      }

      Base base() const override { return one_body ? Base::merged : Base::coupled; }
      bool uses_rock() const override { return true; }

      void add_stiffness(const SolidModel &dam, Structure &structure) override
      {
        rock = condense_rock(parameters, mesh, dam, incompatible_modes, source);
        dam_nodes = DamNodes(rock.base_nodes);
        std::map<unsigned int, Vector3> place;
        for (unsigned int i = 0; i < dam.n_nodes(); ++i)
          place[dam.equation[i]] = dam.points[i];
        for (const unsigned int node : dam_nodes.node)
          places.push_back(place.at(node));
        damping = structure.damping.stiffness;
        if (!one_body)
        {
          spring = static_spring();
          return;
        }
        for (const BaseNode &base_node : rock.base_nodes)
          if (base_node.nodes.size() != 1)
            throw InputError("mesh " + source +
                             ": two nodes of one monolith have the same position on the dam's base, " +
                             dam.place_of(base_node.nodes[0]) + ". Merge these nodes in the mesh.");
        if (parameters.coupling == "common step")
          of_dam = structure.bodies[0].stiffness;
        add_rock(1., structure);
      }

      void add_sustained_stiffness(const double ratio, Structure &structure) const override
      {
        if (const double more = parameters.sustained_ratio() - ratio; one_body && more != 0.)
          add_rock(more, structure);
      }

      void report(Log &log, const TimeGrid &) const override
      {
        log.line("Rock      massless: %s", in_words(parameters.rock).c_str());
      }

      void check_stations(const GroundMotion &motion) const override { BaseMotion::check(motion, places); }

      /** Springs that make the stiffness matrix of a monolith regular. static_base() subtracts them from the
       * rock, which must remain positive definite. Their stiffness is half of the upper bound. */
      Unknowns static_springs(const Structure &structure) const override
      {
        if (one_body)
          return {};
        Unknowns springs(3 * std::size_t(structure.n_nodes()), 0.);
        for (const unsigned int node : dam_nodes.node)
          for (unsigned int c = 0; c < 3; ++c)
            springs[3 * std::size_t(node) + c] = parameters.sustained_ratio() * spring;
        return springs;
      }

      std::unique_ptr<BaseElimination::Nodes> static_base(Structure &structure) const override
      {
        if (one_body)
          return nullptr;
        dam_nodes.mark(structure);
        std::vector<double> springs;
        for (const BaseNode &base_node : rock.base_nodes)
          springs.push_back(spring * base_node.nodes.size());
        BlockSparseMatrix C = rock.compliance(springs);
        for (Matrix3 &block : C.value)
          for (double &x : block)
            x /= parameters.sustained_ratio();
        return std::make_unique<BaseElimination::Nodes>(
            BaseElimination::Nodes{dam_nodes.node, dam_nodes.matrix(C)});
      }

      void start(const GroundMotion &motion, const TimeGrid &steps, const Unknowns &u) override
      {
        grid = steps;
        if (!motion.stations.empty())
          base_motion = std::make_unique<BaseMotion>(motion, places);
        at_rest = u;
        offset.clear();
        for (const unsigned int node : dam_nodes.node)
          for (unsigned int c = 0; parameters.sustained_ratio() != 1. && c < 3; ++c)
            offset.push_back((1. - parameters.sustained_ratio()) * u[3 * std::size_t(node) + c]);
      }

      /** Adds the forces by different motions of the banks. With a support they are part of its prediction. */
      void advance(Unknowns &load) override
      {
        if (!one_body || !base_motion)
          return;
        const double            time = grid.dt * ++steps_done[0];
        const Unknowns          u = base_motion->displacement(time), v = base_motion->velocity(time);
        const BlockSparseMatrix S = dam_nodes.matrix(rock.matrix());
        for (unsigned int i = 0; i < S.n_rows(); ++i)
          for (std::size_t k = S.start[i]; k < S.start[i + 1]; ++k)
          {
            const std::size_t j = 3 * std::size_t(S.column[k]);
            const Vector3 force = S.value[k] * Vector3{{u[j] + damping * v[j], u[j + 1] + damping * v[j + 1],
                                                        u[j + 2] + damping * v[j + 2]}};
            for (unsigned int c = 0; c < 3; ++c)
              load[3 * std::size_t(dam_nodes.node[i]) + c] += force[c];
          }
      }

      Support *support(Structure &structure) override
      {
        if (one_body)
          return nullptr;
        dam_nodes.mark(structure);
        supported = std::make_unique<MasslessSupport>(rock, dam_nodes, structure.damping.stiffness, grid.dt,
                                                      offset, base_motion.get());
        supported->start_account(at_rest);
        at_rest.clear();
        return supported.get();
      }

      StepNeighbour *step_neighbour(Structure &structure) override
      {
        structure.bodies[0].stiffness = std::move(of_dam);
        S = dam_nodes.matrix(rock.matrix());
        Unknowns u;
        gather(at_rest, u);
        account.assign(u.size() + 1, 0.);
        S.multiply(u.data(), account.data());
        for (std::size_t k = 0; k < u.size(); ++k)
          strain_of_start += .5 * account[k] * u[k];
        return this;
      }

      void add_forces(Unknowns &load) const override
      {
        for (std::size_t i = 0; i < dam_nodes.node.size(); ++i)
          for (unsigned int c = 0; c < 3; ++c)
            load[3 * std::size_t(dam_nodes.node[i]) + c] -= account[3 * i + c];
      }

      /** The strain energy of the middle of a step is u(k) S u(k + 1) / 2, as that of the dam. */
      void advance(const Unknowns &displacement, const Unknowns &) override
      {
        Unknowns u;
        gather(displacement, u);
        double &strain = account.back();
        strain = -strain_of_start;
        for (std::size_t k = 0; k < u.size(); ++k)
          strain += .5 * account[k] * u[k];
        S.multiply(u.data(), account.data());
      }

      double strain() const override { return account.back(); }

      std::vector<std::pair<std::string, double>> energies() const override
      {
        return supported ? supported->energies() : std::vector<std::pair<std::string, double>>();
      }

      double strain_at_start() const override
      {
        return supported ? supported->strain_at_start() : strain_of_start;
      }

      double balance_error() const override { return supported ? supported->balance_error() : 0.; }

      void report_balance(Log &log) const override
      {
        if (supported)
          log.line("          error of the energy balance of the rock %.1e (same limit)", balance_error());
      }

      std::vector<std::vector<double> *> state() override
      {
        if (one_body)
          return {&steps_done, &account};
        return supported ? std::vector<std::vector<double> *>{&supported->account}
                         : std::vector<std::vector<double> *>();
      }

    private:
      /** Adds @p factor times the rock to the body of the dam. */
      void add_rock(const double factor, Structure &structure) const
      {
        BlockSparseMatrix of_rock = dam_nodes.matrix(rock.matrix());
        for (Matrix3 &block : of_rock.value)
          for (double &x : block)
            x *= factor;
        BlockSparseMatrix                     &K = structure.bodies[0].stiffness;
        const std::vector<unsigned int>       &nodes = dam_nodes.node;
        std::vector<std::vector<unsigned int>> more(K.n_rows());
        for (const unsigned int row : nodes)
          more[row] = nodes;
        K.extend(std::move(more));
        for (unsigned int i = 0; i < of_rock.n_rows(); ++i)
          for (std::size_t k = of_rock.start[i]; k < of_rock.start[i + 1]; ++k)
            K.add(nodes[i], nodes[of_rock.column[k]], of_rock.value[k]);
        K.symmetrise();
      }

      void gather(const Unknowns &u, Unknowns &of_base) const
      {
        of_base.clear();
        for (const unsigned int node : dam_nodes.node)
          of_base.insert(of_base.end(), u.begin() + 3 * std::size_t(node),
                         u.begin() + 3 * std::size_t(node) + 3);
      }

      double static_spring() const
      {
        const BlockSparseMatrix C = rock.compliance(std::vector<double>(rock.base_nodes.size(), 0.));
        double                  softest = 0.; // upper bound of the compliance [m/N]
        for (unsigned int i = 0; i < C.n_rows(); ++i)
          for (unsigned int c = 0; c < 3; ++c)
          {
            double sum = 0.;
            for (std::size_t k = C.start[i]; k < C.start[i + 1]; ++k)
              for (unsigned int d = 0; d < 3; ++d)
                sum += std::abs(C.value[k][3 * c + d]);
            softest = std::max(softest, sum);
          }
        std::size_t most = 1;
        for (const BaseNode &base_node : rock.base_nodes)
          most = std::max(most, base_node.nodes.size());
        return .5 / (softest * most);
      }

      const FoundationParameters  parameters;
      const HexMesh               mesh;
      const std::string           source;
      const bool                  incompatible_modes, one_body;
      CondensedRock               rock;
      DamNodes                    dam_nodes;
      TimeGrid                    grid;
      Unknowns                    at_rest;
      Unknowns                    offset;            ///< MasslessSupport::offset [m]
      double                      spring = 0.;       ///< at the base nodes in the static state [N/m]
      std::vector<Vector3>        places;            ///< of the dam nodes on the rock [m]
      double                      damping = 0.;      ///< stiffness-proportional [s]
      std::unique_ptr<BaseMotion> base_motion;       ///< or null: the banks have the ground motion
      std::vector<double>         steps_done = {0.}; ///< for base_motion of one body
      // For the explicit scheme:
      BlockSparseMatrix   of_dam, S;            ///< of the dam without the rock, and of the base nodes [N/m]
      std::vector<double> account;              ///< forces S u [N], and strain() [J]
      double              strain_of_start = 0.; ///< of the rock [J]
      std::unique_ptr<MasslessSupport> supported;
    };
  } // namespace

  std::unique_ptr<Foundation> make_massless_rock(const FoundationSite &site)
  {
    return std::make_unique<MasslessRock>(site);
  }
} // namespace Voussoir
