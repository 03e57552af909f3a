// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/error.h>
#include <voussoir/base/names.h>
#include <voussoir/rock/boundary_table.h>
#include <voussoir/rock/fixed_boundary.h>
#include <voussoir/rock/transmitting_boundary.h>
#include <voussoir/rock/viscous_boundary.h>

namespace Voussoir
{
  namespace
  {
    using Boundary = std::unique_ptr<ArtificialBoundary>;

    template <TransmittingFormula (*formula)()> Boundary transmitting()
    {
      return std::make_unique<TransmittingBoundary>(formula());
    }

    Boundary viscous_spring()
    {
      return std::make_unique<ViscousBoundary>(4. / 3., 2. / 3.);
    }

    Boundary viscous()
    {
      return std::make_unique<ViscousBoundary>(0., 0.);
    }

    Boundary fixed()
    {
      return std::make_unique<FixedBoundary>();
    }
  } // namespace

  const std::vector<BoundaryRow> &boundary_table()
  {
    static const std::vector<BoundaryRow> table = {
        {"mtf1", "Multi-Transmitting Formula of order 1", transmitting<mtf1>},
        {"mtf2", "order 2", transmitting<mtf2>},
        {"mtf3", "order 3", transmitting<mtf3>},
        {"mtf4", "order 4", transmitting<mtf4>},
        {"mtf2-plain", "order 2 with one wave speed and without geometric spreading: drifts",
         transmitting<mtf2_plain>},
        {"viscous-spring", "dashpots and springs", viscous_spring},
        {"viscous", "dashpots of Lysmer", viscous},
        {"fixed", "moves with the free field, and reflects the waves of the dam", fixed}};
    return table;
  }

  std::string boundary_names(const std::string &between)
  {
    return names_of(boundary_table(), between);
  }

  std::string boundary_help()
  {
    return listed(boundary_table(), [](const BoundaryRow &row) { return row.name + " (" + row.doc + ")"; });
  }

  std::unique_ptr<ArtificialBoundary> make_boundary(const std::string &name)
  {
    for (const BoundaryRow &row : boundary_table())
      if (row.name == name)
        return row.make();
    throw InputError("There is no artificial boundary \"" + name +
                     "\". Set \"Foundation/Boundary\" to one of " + boundary_names(", ") + ".");
  }

  std::string other_boundaries(const std::string &name)
  {
    std::string  text;
    unsigned int n = 0;
    for (const std::string well_tried : {"mtf2", "viscous-spring", "mtf3"})
      if (well_tried != name && n++ < 2)
        text += (text.empty() ? "" : " or ") + well_tried;
    return text;
  }
} // namespace Voussoir
