// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/contact/key_law.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <voussoir/base/error.h>

namespace Voussoir
{
  namespace
  {
    constexpr double pi = 3.141592653589793;

    /** The flanks of a trapezoidal key that restrains slip in direction @p d (1 or 2): phi = g sin a -/+ d
     *  cos a + c >= 0 (reference: dams, 8.2). */
    void add_flanks(const unsigned int d, const KeyParameters &keys, const double friction,
                    std::vector<ContactSurface> &surfaces)
    {
      const double a = keys.flank_angle * pi / 180.;
      // Exactly rectangular keys: cos(90 deg) and the like are not zero in round numbers.
      const double s = keys.flank_angle == 0. ? 0. : std::sin(a),
                   c = keys.flank_angle == 0. ? 1. : std::cos(a);
      for (const double sign : {1., -1.})
      {
        ContactSurface flank;
        flank.axes = {};
        flank.axes[0] = s, flank.axes[d] = -sign * c;
        flank.axes[3] = c, flank.axes[3 + d] = sign * s;
        flank.axes[6 + 3 - d] = 1.;
        flank.clearance = keys.clearance;
        flank.friction = friction;
        surfaces.push_back(flank);
      }
    }

    /** What a seat remembers: three values per flank. */
    struct SeatMemory
    {
      double passed_by;   ///< how far the flank was passed by while the key was out [m]
      double friction[2]; ///< stress along the flank [Pa]
    };

    class KSM : public SurfacesLaw
    {
    public:
      KSM(std::vector<ContactSurface> surfaces, const KeyParameters &keys)
          : SurfacesLaw(std::move(surfaces)), height(keys.height), seat(keys.seat_compliance)
      {
      }

      /** Keys out of their seats at the start of the step (opening >= height) hold nothing; when they are
       *  out of line, too, the joint cannot close but on their crests. A flank that was passed by while the
       *  key was out is taken as it lies. */
      PresentSurfaces present(const PairPast &past) const override
      {
        PresentSurfaces result{{surfaces[0]}, {1}, past.start};
        if (is_out(past.start))
        {
          for (std::size_t k = 1; k < surfaces.size(); ++k)
            if (surfaces[k].distance({{height, past.start[1], past.start[2]}}) < 0.)
              result.surfaces[0].clearance = -height;
          return result;
        }
        if (seat == 0.)
          free_of_round_off(result.start);
        for (std::size_t k = 1; k < surfaces.size(); ++k)
        {
          ContactSurface flank = surfaces[k];
          if (seat == 0.)
            flank.clearance = std::max(flank.clearance, -(flank.axes * result.start)[0]);
          else
          {
            const SeatMemory memory = at(past.memory, k);
            flank.compliance = seat / past.area;
            flank.clearance += memory.passed_by;
            flank.rest = {{0., memory.friction[0] * past.area, memory.friction[1] * past.area}};
          }
          result.surfaces.push_back(flank);
          result.bits.push_back(static_cast<unsigned char>(1u << k));
        }
        return result;
      }

      unsigned int n_memory() const override { return seat > 0. ? 3 * n_beside() : 0; }

      void commit(const Vector3 &, const Vector3 &gap, const PairPast &past, double *memory) const override
      {
        if (seat == 0.)
          return;
        const PresentSurfaces now = present(past);
        const bool            out = is_out(gap);
        for (std::size_t k = 1; k < surfaces.size(); ++k)
        {
          const double  behind = std::max(0., -surfaces[k].distance(gap));
          double       *mine = memory + 3 * (k - 1);
          const bool    carries = !out && k < now.surfaces.size();
          const Vector3 force = carries ? now.surfaces[k].seat_force(gap, now.start) : Vector3{};
          mine[0] = carries ? std::min(mine[0], behind) : behind;
          mine[1] = force[1] / past.area;
          mine[2] = force[2] / past.area;
        }
      }

      /** That of the seats. */
      double bond_energy(const Vector3 &gap, const double area, const double *memory) const override
      {
        double energy = 0.;
        for (std::size_t k = 1; k < surfaces.size() && seat > 0. && !is_out(gap); ++k)
        {
          const SeatMemory mine = at(memory, k);
          const double     pressed = std::max(0., -(surfaces[k].distance(gap) + mine.passed_by) / seat);
          if (pressed > 0.)
            energy += .5 * seat * area *
                      (pressed * pressed + mine.friction[0] * mine.friction[0] +
                       mine.friction[1] * mine.friction[1]);
        }
        return energy;
      }

    private:
      bool is_out(const Vector3 &gap) const { return gap[0] >= height * (1. - 1e-9); }

      static SeatMemory at(const double *memory, const std::size_t flank)
      {
        if (!memory)
          return {};
        const double *mine = memory + 3 * (flank - 1);
        return {mine[0], {mine[1], mine[2]}};
      }

      /** A start within round-off of a surface is moved onto it: otherwise the direction of friction would
       *  hang on a slip of 1e-14 m before the flank stops it. */
      void free_of_round_off(Vector3 &start) const
      {
        const double round_off = 1e-9 * height;
        if (std::abs(start[0]) <= round_off)
          start[0] = 0.;
        for (std::size_t k = 1; k < surfaces.size(); ++k)
        {
          const Vector3      normal = {{surfaces[k].axes[0], surfaces[k].axes[1], surfaces[k].axes[2]}};
          const unsigned int d = normal[1] != 0. ? 1 : 2; // of the slip that it restrains
          const double       phi = dot(normal, start) + surfaces[k].clearance;
          if (std::abs(phi) <= round_off)
            start[d] -= phi / normal[d];
        }
      }

      const double height;
      const double seat; ///< compliance of the flanks [m/Pa]
    };
  } // namespace

  std::unique_ptr<JointLaw> make_key_law(const LawParameters &parameters)
  {
    const KeyParameters &keys = parameters.keys;
    if (parameters.equations != Equations::alart_curnier)
      throw InputError(
          "Joints/Equations: the law KSM has the equations \"alart-curnier\" only, since a pair with "
          "keys touches on several surfaces at once.");
    if (!(keys.flank_angle >= 0. && keys.flank_angle < 90.))
      throw InputError("Joints/Keys/Flank angle must be at least 0 and less than 90 degrees.");
    if (!(keys.height >= 0. && std::isfinite(keys.height)) ||
        !(keys.clearance >= 0. && std::isfinite(keys.clearance)))
      throw InputError("Joints/Keys/Height and Joints/Keys/Clearance must be finite and at least 0 m.");
    if (!((keys.friction >= 0. && keys.friction <= 10.) || keys.friction == -1.)) // beyond, flanks only wedge
      throw InputError(
          "Joints/Keys/Friction must be at least 0 and at most 10, or -1: the friction of the faces.");
    const double                flank_friction = keys.friction < 0. ? parameters.friction : keys.friction;
    std::vector<ContactSurface> surfaces(1,
                                         {{{1., 0., 0., 0., 1., 0., 0., 0., 1.}}, 0., parameters.friction});
    if (keys.height > 0. && keys.direction != "vertical")
      add_flanks(1, keys, flank_friction, surfaces);
    if (keys.height > 0. && keys.direction != "radial")
      add_flanks(2, keys, flank_friction, surfaces);
    return std::make_unique<KSM>(std::move(surfaces), keys);
  }
} // namespace Voussoir
