#include <voussoir/rock/viscous_boundary.h>

#include <map>

namespace Voussoir
{
  std::vector<Dashpot> viscous_dashpots(const RockModel &model, const std::array<double, 3> &centre,
                                        const double normal_spring, const double tangential_spring)
  {
    std::map<unsigned int, Dashpot> dashpots;
    for (const BoundaryFace &face : model.faces)
    {
      const Material &m = face.material;
      const double    c_p = p_wave_speed(m), c_s = s_wave_speed(m), shear = m.density * c_s * c_s;
      for (const unsigned int node : face.nodes)
      {
        Dashpot     &dashpot = dashpots.try_emplace(node, Dashpot{node, Matrix3{}, Matrix3{}}).first->second;
        const double r = norm(model.points[node] - centre);
        for (unsigned int a = 0; a < 3; ++a)
          for (unsigned int b = 0; b < 3; ++b)
          {
            const double normal = face.normal[a] * face.normal[b], tangential = (a == b ? 1. : 0.) - normal;
            dashpot.damping[3 * a + b] += m.density * (c_p * normal + c_s * tangential) * face.area / 4.;
            dashpot.stiffness[3 * a + b] +=
                shear / r * (normal_spring * normal + tangential_spring * tangential) * face.area / 4.;
          }
      }
    }
    std::vector<Dashpot> result;
    for (const auto &entry : dashpots)
      result.push_back(entry.second);
    return result;
  }
} // namespace Voussoir
