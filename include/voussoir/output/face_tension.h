// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_face_tension_h
#define voussoir_face_tension_h

#include <voussoir/output/recorders.h>

#include <map>

namespace Voussoir
{
  /** Stresses of the envelope away from the base, where the stress of an elastic dam is singular, and the
   * area of the upstream and downstream faces where the tension is above a strength. Near the base: nearer to
   * a node of it than a tenth of the dam's height. */
  class FaceTension
  {
  public:
    explicit FaceTension(const SolidModel &model);

    bool is_near_base(const unsigned int node) const { return near_base[node]; }

    /** The largest maximum on a face; its value is not a number where no node of the face is away from the
     * base. */
    Extreme largest_away_from_base(const EnvelopeRecorder &envelope, const SolidModel &model,
                                   int surface) const;

    /** The smallest minimum of all nodes of the dam that are away from the base, not a number without any. */
    Extreme smallest_away_from_base(const EnvelopeRecorder &envelope, const SolidModel &model) const;

    /** Root of the mean square, by area, of the differences of two envelopes away from the base, where @p a
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
    };
    std::map<int, std::vector<FaceNode>> faces;
    std::vector<bool>                    near_base; ///< per node of the model
  };
} // namespace Voussoir

#endif
