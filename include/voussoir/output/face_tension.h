// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_face_tension_h
#define voussoir_face_tension_h

#include <voussoir/output/recorders.h>

#include <map>

namespace Voussoir
{
  /** Evaluation of stress envelopes: extremes away from the base, where elastic stresses are singular, and
   * areas with a maximum principal stress above a strength. A node is near the base if its distance to a base
   * node is less than a tenth of the height of the dam. */
  class FaceTension
  {
  public:
    /** Computes the nodal areas of the faces, and finds the nodes near the base. */
    explicit FaceTension(const SolidModel &model);

    /** Returns true if a node is near the base. */
    bool is_near_base(const unsigned int node) const { return near_base[node]; }

    /** Returns the largest maximum on a face away from the base [Pa], or NaN if there is no such node. */
    Extreme largest_away_from_base(const EnvelopeRecorder &envelope, const SolidModel &model,
                                   int surface) const;

    /** Returns the smallest minimum of all nodes away from the base [Pa], or NaN if there is no such node. */
    Extreme smallest_away_from_base(const EnvelopeRecorder &envelope, const SolidModel &model) const;

    /** Returns the root mean square of the difference of two envelopes away from the base, weighted by area
     * [Pa]. It includes the nodes where @p a has at least half of its maximum. It is 0 without tension, and
     * NaN without the face. */
    double difference(const EnvelopeRecorder &a, const EnvelopeRecorder &b, int surface) const;

    /** Returns the largest maximum on both faces away from the base, at least 0 [Pa]. */
    double headline(const EnvelopeRecorder &envelope) const;

    /** Part of the area of a face. */
    struct Part
    {
      double area = 0., whole = 0.; ///< area of the part and of the face [m^2]
      double share() const { return whole > 0. ? area / whole : 0.; }
    };
    /** Returns the nodal area of a face with a maximum above @p strength [Pa]. */
    Part above(const EnvelopeRecorder &envelope, int surface, double strength) const;

  private:
    struct FaceNode
    {
      unsigned int node;
      double       area; ///< [m^2]
    };
    std::map<int, std::vector<FaceNode>> faces;     ///< nodes by surface
    std::vector<bool>                    near_base; ///< per node of the model
  };
} // namespace Voussoir

#endif
