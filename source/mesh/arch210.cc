// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/entries.h>
#include <voussoir/base/error.h>
#include <voussoir/mesh/arch210.h>
#include <voussoir/mesh/centre_line.h>

#include <cmath>

namespace Voussoir
{
  namespace
  {
    constexpr double H = arch210_height;

    // Geometry at the height z, in metres.
    double crown_thickness(const double z)
    {
      const double zeta = (H - z) / H;
      return 10 + zeta * (86 + zeta * (-66 + zeta * 22));
    }
    double abutment_thickness(const double z)
    {
      const double zeta = (H - z) / H;
      return crown_thickness(z) * (1 + zeta * (0.60 - zeta * 0.42));
    }
    double crown_centre(const double z)
    {
      const double zeta = (H - z) / H;
      return zeta * (-62.0 + zeta * (35.7 + zeta * 12.3)) + crown_thickness(z) / 2;
    }
    double radius(const double z)
    {
      return 115 + (250.760 - 115) * z / H;
    }
    double half_width(const double z)
    {
      return 50 + (267.032 - 50) * std::pow(z / H, 0.577);
    }

    class Arch210 : public CentreLineShape
    {
      double  bottom() const override { return 0; }
      double  top() const override { return H; }
      HalfArc arc(Bank, const double z) const override
      {
        return {{CentreLine::Kind::parabola, radius(z)},
                crown_centre(z),
                crown_thickness(z),
                abutment_thickness(z),
                half_width(z)};
      }
    };
  } // namespace

  void Arch210Parameters::add_parameters(Entries &prm)
  {
    using namespace dealii::Patterns;
    prm.enter_subsection("Mesh");
    prm.enter_subsection("Arch210");
    prm.add_parameter("Joints", n_joints,
                      "Number of contraction joints [-], with equal spacing along the crest. The dam has one "
                      "monolith more. The paper of Hu, Zhang and Lin (2008) uses 5, 17 and 28.",
                      Integer(0, 60));
    ArchGrid::add_parameters(prm);
    prm.add_parameter("End wall height", end_wall_height,
                      "Depth of the abutment below the two ends of the crest [m], at the centre line. With a "
                      "longer crest, the height of the dam would decrease to zero.",
                      Double(0.01, 20));
    prm.leave_subsection();
    prm.leave_subsection();
  }

  void Arch210Parameters::check() const
  {
    if (n_joints > 60)
      throw InputError("Entry \"Mesh/Arch210/Joints\" is " + std::to_string(n_joints) + ". Choose 0 to 60.");
    if (end_wall_height == 0)
      throw InputError("Entry \"Mesh/Arch210/End wall height\" is 0 m. Choose a height above 0.");
    check_grid(arch210_shape(), *this, "Mesh/Arch210");
  }

  const ArchShape &arch210_shape()
  {
    static const Arch210 shape;
    return shape;
  }

  HexMesh make_arch210(const Arch210Parameters &parameters)
  {
    parameters.check();
    return make_arch(arch210_shape(), parameters).mesh;
  }

  double arch210_half_width(const double z)
  {
    return half_width(z);
  }
} // namespace Voussoir
