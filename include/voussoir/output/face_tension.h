// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_face_tension_h
#define voussoir_face_tension_h

#include <voussoir/output/recorders.h>

#include <map>

namespace Voussoir
{
  /** Tension of the envelope on the upstream and downstream faces: its largest value away from the foot,
   * where the stress of an elastic dam is singular, and the area where it is above a strength. The foot: what
   * is nearer to a node of the base than a tenth of the dam's height. */
  class FaceTension
  {
  public:
    explicit FaceTension(const SolidModel &model);

    /** Not a number where the face has no node away from the foot. */
    Extreme largest_above_foot(const EnvelopeRecorder &envelope, const SolidModel &model, int surface) const;

    /** Root of the mean square, by area, of the differences of two envelopes away from the foot, where @p a
     * has at least half of its largest tension there; 0 without tension, not a number without the face [Pa].
     */
    double difference(const EnvelopeRecorder &a, const EnvelopeRecorder &b, int surface) const;

    /** The larger one of both faces, 0 where there is none [Pa]. */
    double headline(const EnvelopeRecorder &envelope) const;

    struct Part
    {
      double area = 0., whole = 0.; ///< [m^2]
      double share() const { return whole > 0. ? area / whole : 0.; }
    };
    /** The part of a face whose nodes, by their shares of its area, have tension above @p strength [Pa]. */
    Part above(const EnvelopeRecorder &envelope, int surface, double strength) const;

  private:
    struct FaceNode
    {
      unsigned int node;
      double       area; ///< [m^2]
      bool         is_foot;
    };
    std::map<int, std::vector<FaceNode>> faces;
  };
} // namespace Voussoir

#endif
