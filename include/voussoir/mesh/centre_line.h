// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_centre_line_h
#define voussoir_centre_line_h

#include <voussoir/mesh/arch_shape.h>

namespace Voussoir
{
  /** Centre line of half an arc in plan: x(y), with x(0) = 0 and a horizontal tangent at the crown. */
  struct CentreLine
  {
    enum class Kind
    {
      parabola,     ///< x = y^2 / (2 radius)
      ellipse,      ///< semi-axes: semi_axis along y, semi_axis^2 / radius along x
      three_centred ///< circle with radius up to angle, beyond it a circle with side_radius
    };

    Kind   kind;
    double radius;          ///< at the crown [m]
    double semi_axis = 0;   ///< of the ellipse, along y [m]
    double angle = 0;       ///< half of the central angle of the middle circle [rad]
    double side_radius = 0; ///< of the circle next to the abutment [m]

    /** Point of the centre line. */
    struct Place
    {
      double x;      ///< [m]
      double slope;  ///< dx/dy [-]
      double length; ///< from the crown [m]
    };

    /** Returns the place at @p y >= 0 [m]. Where an ellipse or a circle reaches 80 degrees from the crown, the
     * line continues straight. */
    Place at(double y) const;
  };

  /** Half of an arc at one height: centre line and thickness. The thickness increases from the crown to the
   * abutment with the square of the length of the centre line. */
  struct HalfArc
  {
    CentreLine line;
    double     crown;                          ///< x of the centre line at the crown [m]
    double     crown_thickness;                ///< [m]
    double     abutment_thickness;             ///< [m]
    double     width;                          ///< y of the centre line at the abutment [m]
    double     length = line.at(width).length; ///< of the centre line [m]

    /** Returns the point at y = @p y of the centre line, at the share @p w of the thickness: -1 upstream, 1
     * downstream. @p z is the height [m]. */
    std::array<double, 3> point(double y, double z, double w) const;
  };

  /** Dam whose arcs are given by centre lines and thicknesses. The parameter u is y of the centre line [m]. */
  class CentreLineShape : public ArchShape
  {
  public:
    /** Returns half an arc at the height @p z. */
    virtual HalfArc arc(Bank bank, double z) const = 0;

    std::array<double, 3> point(const Bank bank, const double u, const double z,
                                const double w) const override
    {
      return arc(bank, z).point(u, z, w);
    }
    double end(const Bank bank, const double z) const override { return arc(bank, z).width; }
    double reach(const Bank bank, double) const override { return 1.1 * arc(bank, top()).width; }
    double slope(const Bank bank, const double u) const override { return arc(bank, top()).line.at(u).slope; }
    double crest_length(const Bank bank, const double u) const override
    {
      return arc(bank, top()).line.at(u).length;
    }
  };
} // namespace Voussoir

#endif
