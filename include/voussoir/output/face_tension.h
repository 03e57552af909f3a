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
    /** Computes the nodal areas of the upstream and the downstream face, and finds the nodes near the base. */
    explicit FaceTension(const SolidModel &model);

    /** Returns true if a node of the model is near the base. */
    bool is_near_base(const unsigned int node) const { return near_base[node]; }

    /** Returns the largest maximum principal stress on a face away from the base [Pa]; NaN if there is no such
     * node. @p surface: PhysicalId::upstream or downstream. */
    Extreme largest_away_from_base(const EnvelopeRecorder &envelope, const SolidModel &model,
                                   int surface) const;

    /** Returns the smallest minimum principal stress of all nodes away from the base [Pa]; NaN if there is no
     * such node. */
    Extreme smallest_away_from_base(const EnvelopeRecorder &envelope, const SolidModel &model) const;

    /** Returns an extreme arch, cantilever or vertical stress on a face away from the base [Pa]; NaN if there is
     * no such node.
     * @param envelope stresses of both faces
     * @param model mesh of the dam
     * @param surface PhysicalId::upstream or downstream
     * @param k number of the stress, see FaceDirections::name()
     * @param largest true: largest value; false: smallest value */
    Extreme extreme_away_from_base(const FaceEnvelope &envelope, const SolidModel &model, int surface,
                                   unsigned int k, bool largest) const;

    /** Returns the largest maximum principal stress on both faces away from the base, at least 0 [Pa]: the
     * tension in the progress lines. */
    double headline(const EnvelopeRecorder &envelope) const;

    /** Part of the area of a face. */
    struct Part
    {
      double area = 0.;  ///< area of the part [m^2]
      double whole = 0.; ///< area of the face [m^2]

      /** Returns area divided by whole [-]. */
      double share() const { return whole > 0. ? area / whole : 0.; }
    };
    /** Returns the part of a face whose maximum principal stress exceeds @p strength [Pa] at any time. */
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
