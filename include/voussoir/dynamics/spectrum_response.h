// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_spectrum_response_h
#define voussoir_spectrum_response_h

#include <voussoir/dynamics/modes.h>

namespace Voussoir
{
  /** Returns the correlation coefficient of two modes for the complete quadratic combination (CQC) [-], with
   * r = f_2/f_1:
   *
   *     rho = 8 sqrt(z_1 z_2) (z_1 + r z_2) r^1.5 / ((1 - r^2)^2 + 4 z_1 z_2 r (1 + r^2) + 4 (z_1^2 + z_2^2) r^2)
   *
   * Wilson, Der Kiureghian and Bayo, "A replacement for the SRSS method in seismic analysis", Earthquake
   * Engineering and Structural Dynamics 9, 1981.
   * @param f_1, f_2 natural frequencies [Hz]
   * @param z_1, z_2 damping ratios [-] */
  double cqc_coefficient(double f_1, double z_1, double f_2, double z_2);

  /** Response spectrum analysis (US NRC Regulatory Guide 1.92, revision 3, 2012, with the method of Gupta 1990).
   *
   * A stiff mode follows the ground motion without delay with a share of its response, Mode::rigid_share. The mass
   * that the modes do not represent follows the peak ground acceleration. The sum of both, with signs, is the rigid
   * part. The response to each direction of the ground motion is the square root of the sum of squares of the rigid
   * part and the complete quadratic combination of the modes without their rigid shares. The response to all
   * directions is the square root of the sum of squares.
   *
   * Every linear result is combined with combine(). A result that is not linear in the displacements, such as a
   * principal stress, has no such combination: the signs of the combined values and their simultaneity are
   * lost. */
  class SpectrumResponse
  {
  public:
    /** Mode and its spectral accelerations. */
    struct Mode
    {
      NaturalMode mode;
      double      damping;      ///< damping ratio [-]
      Vector3     acceleration; ///< S_a of the ground motion along x, y, z [m/s^2]
      Vector3 rigid_share{};    ///< correlation with the ground motion, for each of these motions, 0 to 1 [-]
    };

    /** State of the structure: for a unit amplitude of a mode, or for the rigid part of a direction. */
    struct Part
    {
      Unknowns displacement; ///< u, three values per node
      Unknowns acceleration; ///< absolute acceleration a, with K u = -M a
    };

    /** Computes the parts: the modes, then the rigid part of each direction.
     * @param structure structure without pairs
     * @param modes modes of the combination; may be empty
     * @param peak peak ground accelerations along x, y, z [m/s^2] */
    SpectrumResponse(const Structure &structure, const std::vector<Mode> &modes, const Vector3 &peak);

    const std::vector<Part> &parts() const { return all; }

    /** Returns the combined maximum of a result. @p of_parts: its values for each of the parts(). */
    double combine(const std::vector<double> &of_parts) const;

  private:
    std::vector<Part>   all;
    std::vector<double> weight; ///< matrix of the quadratic form, row by row
  };

  /** Returns the forces of the structure on its supports along x, y, z for the state of a part. They are the
   * inertia forces of its free nodes, with added mass [N per unit amplitude]. */
  Vector3 support_force(const Structure &structure, const SpectrumResponse::Part &part);
} // namespace Voussoir

#endif
