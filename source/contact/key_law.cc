// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/entries.h>
#include <voussoir/base/error.h>
#include <voussoir/base/number_text.h>
#include <voussoir/contact/key_law.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace Voussoir
{
  namespace
  {
    /** Adds the flanks of a trapezoidal key that restrains slip in direction @p d (1 or 2): phi = g sin a -/+
     *  d cos a + c >= 0 (doc/method.md, Joint laws). */
    void add_flanks(const unsigned int d, const KeyParameters &keys, const double friction,
                    std::vector<ContactSurface> &surfaces)
    {
      const double a = keys.flank_angle * M_PI / 180.;
      // For rectangular keys sin and cos are exact, without round-off.
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

    /** Law KSM: a flat face and the flanks of trapezoidal shear keys. */
    class KSM : public SurfacesLaw
    {
    public:
      KSM(std::vector<ContactSurface> surfaces, const KeyParameters &keys)
          : SurfacesLaw(std::move(surfaces)), height(keys.height), seat(keys.seat_compliance)
      {
      }

      /** Returns the surfaces for the step. A key in its socket at the start of the step has the face and its flanks. A
       * key that is out of the socket (opening >= height) and misaligned has its crest. A key that is out and aligned
       * has the face only. If the step then passes through a flank, the step is repeated with the flanks. If the
       * repeated step ends on the extension of a flank, it is repeated with the crest: see utilisation(). */
      PresentSurfaces present(const PairHistory &history) const override
      {
        PresentSurfaces result{{surfaces[0]}, {1}, history.start};
        const Contact   contact = contact_of(history);
        if (contact == Contact::crest)
          result.surfaces[0].clearance = -height;
        if (contact == Contact::face || contact == Contact::crest)
          return result;
        if (seat == 0.)
          free_of_round_off(result.start);
        for (std::size_t k = 1; k < surfaces.size(); ++k)
        {
          ContactSurface flank = surfaces[k];
          if (seat == 0.)
            flank.clearance = std::max(flank.clearance, -(flank.axes * result.start)[0]);
          else
          {
            const double *friction = friction_of(history.memory, k);
            flank.compliance = seat / history.area;
            flank.rest = {{0., friction[0] * history.area, friction[1] * history.area}};
          }
          result.surfaces.push_back(flank);
          result.bits.push_back(static_cast<unsigned char>(1u << k));
        }
        return result;
      }

      /** Returns the number of history variables: events of the step; with elastic flank contact also two friction
       * stresses per flank [Pa], and the largest compression of the flanks when the key left its socket [m]. */
      unsigned int n_memory() const override
      {
        return n_secondary() == 0 ? 0 : 1 + (seat > 0. ? 2 * n_secondary() + 1 : 0);
      }

      bool   needs_mean_force() const override { return seat > 0.; }
      double flank_compliance() const override { return seat; }

      /** Returns 2 if the step passes through a flank or beyond its end and requires the next event, else 0. */
      double utilisation(const Vector3 &, const Vector3 &gap, const PairHistory &history) const override
      {
        if (!is_out(history.start))
          return 0.;
        const Contact contact = contact_of(history);
        return (contact == Contact::face && !is_out(gap) && depth(gap) > round_off * height) ||
                       (contact == Contact::flanks && is_out(gap) && is_out_of_line(gap, history))
                   ? 2.
                   : 0.;
      }

      void apply_event(double *memory, const JointEvent event) const override
      {
        if (event == JointEvent::limit)
          ++memory[0];
      }

      Vector3 solve(const Matrix3 &H, const Vector3 &b, const PairHistory &history) const override
      {
        if (is_clear(b) && contact_of(history) == Contact::flanks)
          return {};
        return SurfacesLaw::solve(H, b, history);
      }

      void commit(const Vector3 &, const Vector3 &gap, const PairHistory &history,
                  double *memory) const override
      {
        if (n_secondary() == 0 || (is_clear(gap) && std::all_of(memory, memory + n_memory(),
                                                                [](const double x) { return x == 0.; })))
          return;
        const PresentSurfaces now = present(history);
        const double          left_with = compression_of(history);
        memory[0] = 0.;
        if (seat > 0.)
          memory[2 * n_secondary() + 1] =
              !is_out(gap) ? 0. : (is_out(history.start) ? left_with : depth_at_exit(history.start, gap));
        for (std::size_t k = 1; k < surfaces.size() && seat > 0.; ++k)
        {
          const bool    carries = !is_out(gap) && k < now.surfaces.size();
          const Vector3 force = carries ? now.surfaces[k].seat_force(gap, now.start) : Vector3{};
          memory[2 * k - 1] = force[1] / history.area;
          memory[2 * k] = force[2] / history.area;
        }
      }

      /** Returns the elastic energy of the flank contact [J]. */
      double bond_energy(const Vector3 &gap, const double area, const double *memory) const override
      {
        double energy = 0.;
        for (std::size_t k = 1; k < surfaces.size() && seat > 0. && !is_out(gap); ++k)
        {
          const double *friction = friction_of(memory, k);
          const double  pressed = std::max(0., -surfaces[k].distance(gap) / seat);
          if (pressed > 0.)
            energy += .5 * seat * area *
                      (pressed * pressed + friction[0] * friction[0] + friction[1] * friction[1]);
        }
        return energy;
      }

    private:
      enum class Contact
      {
        face,
        flanks, ///< flanks and face
        crest
      };

      /** Returns true if the key is out of its socket. The tolerance exceeds the solver's error in the
       * opening, so that a key on its crest stays there. */
      bool is_out(const Vector3 &gap) const { return gap[0] >= height * (1. - 1e-6); }

      /** Returns true if a key in its socket touches neither face nor flank. */
      bool is_clear(const Vector3 &gap) const { return gap[0] > 0. && !is_out(gap) && depth(gap) < 0.; }

      /** Returns the largest penetration of a flank [m]. Negative: distance to the nearest flank. */
      double depth(const Vector3 &gap) const
      {
        double result = -std::numeric_limits<double>::infinity();
        for (std::size_t k = 1; k < surfaces.size(); ++k)
          result = std::max(result, -surfaces[k].distance(gap));
        return result;
      }

      /** Returns the penetration at the ends of the flanks [m]. Positive: the key is above a crest. */
      double depth_at_end(const Vector3 &gap) const { return depth({{height, gap[1], gap[2]}}); }

      /** Returns the penetration of the flanks where a step from @p start in the socket to @p end outside of
       * it reaches the height [m]. The path of the step is straight. */
      double depth_at_exit(const Vector3 &start, const Vector3 &end) const
      {
        const double rise = end[0] - start[0];
        const double s = rise > 0. ? std::min(1., std::max(0., (height - start[0]) / rise)) : 1.;
        return depth_at_end({{0., start[1] + s * (end[1] - start[1]), start[2] + s * (end[2] - start[2])}});
      }

      /** Returns true if a key out of its socket is above a crest. The tolerance is round-off and the
       *  compression of the flank when the key left its socket. */
      bool is_out_of_line(const Vector3 &gap, const PairHistory &history) const
      {
        return depth_at_end(gap) > round_off * height + compression_of(history);
      }

      /** Returns the compression of a flank when the key left its socket [m]. */
      double compression_of(const PairHistory &history) const
      {
        return seat > 0. && n_secondary() > 0 && history.memory
                   ? std::max(0., history.memory[2 * n_secondary() + 1])
                   : 0.;
      }

      /** Returns the possible contact in the step from history.start, after the events so far. */
      Contact contact_of(const PairHistory &history) const
      {
        if (!is_out(history.start))
          return Contact::flanks;
        if (is_out_of_line(history.start, history))
          return Contact::crest;
        const double events = history.memory && n_secondary() > 0 ? history.memory[0] : 0.;
        return events == 0. ? Contact::face : events == 1. ? Contact::flanks : Contact::crest;
      }

      /** Returns the two friction stresses of a flank with elastic contact [Pa]. */
      static const double *friction_of(const double *memory, const std::size_t flank)
      {
        static const double none[2] = {0., 0.};
        return memory ? memory + 2 * flank - 1 : none;
      }

      /** Moves a start within round-off of a surface onto the surface. Otherwise a slip of 1e-14 m before the
       *  flank contact would determine the direction of friction. */
      void free_of_round_off(Vector3 &start) const
      {
        const double small = round_off * height;
        if (std::abs(start[0]) <= small)
          start[0] = 0.;
        for (std::size_t k = 1; k < surfaces.size(); ++k)
        {
          const Vector3      normal = {{surfaces[k].axes[0], surfaces[k].axes[1], surfaces[k].axes[2]}};
          const unsigned int d = normal[1] != 0. ? 1 : 2; // direction of the restrained slip
          const double       phi = dot(normal, start) + surfaces[k].clearance;
          if (std::abs(phi) <= small)
            start[d] -= phi / normal[d];
        }
      }

      static constexpr double round_off = 1e-9; ///< of a gap over the height [-]

      const double height;
      const double seat; ///< compliance of the flanks [m/Pa]
    };
  } // namespace

  std::unique_ptr<JointLaw> make_key_law(const LawParameters &parameters)
  {
    const KeyParameters &keys = parameters.keys;
    if (parameters.equations != Equations::alart_curnier)
      throw InputError(
          "The joint model KSM supports alart-curnier only, because a pair with keys has several "
          "contact surfaces. Set \"Joints/Equations\" to alart-curnier.");
    if (!(keys.flank_angle >= 0. && keys.flank_angle < 90.))
      throw InputError(
          "Entry \"Joints/Keys/Flank angle\" must be at least 0 and less than 90 degrees, but it "
          "is " +
          number_text(keys.flank_angle) + " degrees.");
    if (!(keys.height >= 0. && std::isfinite(keys.height)) ||
        !(keys.clearance >= 0. && std::isfinite(keys.clearance)))
      throw InputError("Entries \"Joints/Keys/Height\" (" + number_text(keys.height) +
                       " m) and \"Joints/Keys/Clearance\" (" + number_text(keys.clearance) +
                       " m) must be finite and at least 0 m.");
    if (!((keys.friction >= 0. && keys.friction <= 10.) ||
          keys.friction == -1.)) // larger values lock all flanks
      throw InputError(
          "Entry \"Joints/Keys/Friction\" must be at least 0 and at most 10, or -1 for the friction "
          "of the faces, but it is " +
          number_text(keys.friction) + ".");
    const double                flank_friction = keys.friction < 0. ? parameters.friction : keys.friction;
    std::vector<ContactSurface> surfaces(1,
                                         {{{1., 0., 0., 0., 1., 0., 0., 0., 1.}}, 0., parameters.friction});
    if (keys.height > 0. && keys.direction != "vertical")
      add_flanks(1, keys, flank_friction, surfaces);
    if (keys.height > 0. && keys.direction != "radial")
      add_flanks(2, keys, flank_friction, surfaces);
    return std::make_unique<KSM>(std::move(surfaces), keys);
  }

  /** Returns a warning about keys for which Coulomb's law has two solutions (doc/keys.md), or "". */
  std::string key_law_warning(const LawParameters &parameters)
  {
    const KeyParameters &keys = parameters.keys;
    const double         face = parameters.friction, flank = keys.friction < 0. ? face : keys.friction,
                 degree = std::acos(-1.) / 180., needed = 90. - keys.flank_angle + std::atan(flank) / degree;
    if (keys.height == 0. || needed >= 90. || face <= std::tan(needed * degree))
      return "";
    std::ostringstream text;
    text
        << "Joints/Friction is " << face << ", but must be at most " << std::tan(needed * degree)
        << " with flanks of " << keys.flank_angle << " degrees and flank friction " << flank
        << " (Joints/Keys). Above this value Coulomb's law has two solutions (doc/keys.md): a key stops at its "
           "flank, or slides up the flank. The result of the run may be either of them. Set "
           "Joints/Keys/Friction = -1, the friction of the faces, or reduce the flank angle.";
    return text.str();
  }

  void KeyParameters::add_parameters(Entries &prm)
  {
    using namespace dealii::Patterns;
    prm.enter_subsection("Keys");
    prm.add_parameter("Height", height,
                      "Height of the shear keys [m]. A joint with a larger opening slips freely.",
                      {.005, 2., true}, Double(0.));
    prm.add_parameter("Clearance", clearance, "Clearance normal to each flank of a key [m].", {0., .1},
                      Double(0.));
    prm.add_parameter("Flank angle", flank_angle,
                      "Angle between the flanks and the normal of the joint [degrees]. 0: rectangular keys.",
                      {10., 80., true}, Double(0., 89.));
    prm.add_parameter("Direction", direction, "Direction of the slip that the keys restrain.",
                      Selection("radial|vertical|both"));
    prm.add_parameter("Friction", friction,
                      "Coefficient of friction of the flanks [-]. -1: that of the faces (Joints/Friction).",
                      {-1., 2.}, Double(-1.));
    prm.add_parameter("Seat compliance", seat_compliance,
                      "Compliance of the flank contact of the keys, per area of the joint [m/Pa]. -1: 20 "
                      "Height/E with Young's modulus E of the concrete, the result of meshed keys "
                      "(doc/keys.md). 0: rigid.",
                      Double(-1., 1e-6));
    prm.leave_subsection();
  }
} // namespace Voussoir
