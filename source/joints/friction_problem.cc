// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/joints/friction_problem.h>

#include <voussoir/contact/surfaces_law.h>
#include <voussoir/joints/pair_groups.h>

#include <algorithm>

namespace Voussoir
{
  FrictionProblem friction_problem(const InterfaceOperator &W, const PairLaws &laws,
                                   const std::vector<PairHistory> &history, const Unknowns &b)
  {
    FrictionProblem problem;
    problem.title = "joints of a dam, gap = W force + q [m, N]";
    std::vector<std::pair<unsigned int, Matrix3>> axes;
    std::vector<double>                           compliance;
    const auto add_surface = [&](const unsigned int pair, const ContactSurface &surface, const Vector3 &start)
    {
      axes.push_back({pair, surface.axes});
      compliance.push_back(surface.compliance);
      problem.mu.push_back(surface.friction);
      const Vector3 q = surface.movement(get(b, pair), start, {});
      problem.q.insert(problem.q.end(), q.begin(), q.end());
    };
    const Matrix3 one = {{1., 0., 0., 0., 1., 0., 0., 0., 1.}};
    for (unsigned int p = 0; p < laws.of_pair.size(); ++p)
      if (const SurfacesLaw *law = laws.of_pair[p]->surfaces_law())
      {
        const PresentSurfaces present = law->present(history[p]);
        for (const ContactSurface &surface : present.surfaces)
          add_surface(p, surface, present.start);
      }
      else
        add_surface(p, {one, 0., laws.of_pair[p]->flat_friction()}, history[p].start);
    problem.W = sparse_matrix(W);
    if (std::none_of(laws.of_pair.begin(), laws.of_pair.end(),
                     [](const JointLaw *law) { return law->surfaces_law(); }))
      return problem;
    problem.W = sparse_matrix(problem.W, axes);
    for (unsigned int s = 0; s < axes.size(); ++s)
    {
      const double c = compliance[s];
      problem.W.add(s, s, {{c, 0., 0., 0., c, 0., 0., 0., c}});
    }
    return problem;
  }
} // namespace Voussoir
