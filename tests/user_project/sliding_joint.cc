// SPDX-License-Identifier: GPL-3.0-or-later
// A joint with friction 0.8 under 1000 N of compression: pushed sideways it slides with 800 N.
#include <voussoir/contact/law_table.h>

#include <iostream>

int main()
{
  const auto law =
      Voussoir::make_joint_law("FJA", Voussoir::LawParameters(.8, Voussoir::Equations::alart_curnier));
  const Voussoir::Matrix3 softness = {{1e-9, 0., 0., 0., 1e-9, 0., 0., 0., 1e-9}}; // [m/N]
  const Voussoir::Vector3 force = law->solve(softness, {{-1e-6, 2e-6, 0.}}, {});
  std::cout << "normal " << force[0] << " N, tangential " << force[1] << " N\n";
}
