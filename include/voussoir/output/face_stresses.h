// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_face_stresses_h
#define voussoir_face_stresses_h

#include <voussoir/solid/stress.h>

#include <string>
#include <utility>

namespace Voussoir
{
  /** Returns the directions of the stresses on a face. */
  NodeOnFace directions_at(const NodeFace &face);

  /** Normal stresses in fixed directions at the nodes of the upstream and the downstream face: arch,
   * cantilever and vertical stress, as in USACE EM 1110-2-2201 (Arch Dam Design, 1994, chapters 6 and 7).
   * Let n be the outward unit normal of the face and z the upward unit vector.
   *
   * - arch direction: horizontal tangent of the face, a = z x n / |z x n|; stress a . sigma a;
   * - cantilever direction: tangent of the face normal to a, upward, c = n x a; stress c . sigma c;
   * - vertical stress: z . sigma z.
   *
   * The normal of a node is the mean over the element faces around it, weighted by its shape function. Only
   * element faces of the same surface and monolith contribute. If n is vertical, a is the y axis. */
  class FaceDirections
  {
  public:
    static constexpr unsigned int n_stresses = NodeOnFace::n_stresses;

    /** Returns "arch", "cantilever" or "vertical". */
    static const char *name(unsigned int k);

    FaceDirections() = default;

    /** Computes the directions at all nodes of both faces. */
    explicit FaceDirections(const SolidModel &model);

    std::vector<NodeOnFace>  nodes; ///< sorted by node
    std::vector<std::size_t> first; ///< index of the first entry of each node of the model
  };

  /** Largest and smallest arch, cantilever and vertical stresses of both faces over time. */
  class FaceEnvelope
  {
  public:
    FaceEnvelope() = default; ///< inactive: no nodes

    /** Prepares the records of all nodes of both faces. */
    explicit FaceEnvelope(const SolidModel &model);

    /** Updates the extremes of a node.
     * @param time present time [s]
     * @param stress present stress [Pa] */
    void record(std::size_t node, double time, const Stress &stress);

    /** Lets @p view refer to face nodes and extremes. */
    void show(StressView &view) const;

    /** Takes the extremes and times of a column of StressView. */
    void take(const std::vector<float> &extremes, const std::vector<float> &times, std::size_t n_columns,
              std::size_t column);

    /** Exchanges the extremes of all ranks. Rank r owns the nodes begin[r] to begin[r + 1] of the model. */
    void gather(std::vector<std::size_t> begin);

    /** Returns an extreme [Pa] and its time [s].
     * @param i index into directions.nodes
     * @param k number of the stress, see FaceDirections::name()
     * @param largest true: largest value over time; false: smallest */
    std::pair<float, float> extreme(const std::size_t i, const unsigned int k, const bool largest) const
    {
      return {extremes[index(i, k, largest)], times[index(i, k, largest)]};
    }

    /** Returns a field on the model: extremes at the nodes of both faces, and 0 at the other nodes [Pa]. */
    std::vector<float> field(std::size_t n_nodes, unsigned int k, bool largest) const;

    /** Returns the name of an extreme in output files, such as "arch_stress_max". */
    static std::string name(unsigned int k, bool largest);

    FaceDirections directions; ///< nodes of both faces

    template <class Archive> void serialize(Archive &archive, unsigned int) { archive &extremes &times; }

  private:
    static constexpr unsigned int n_extremes = 2 * FaceDirections::n_stresses;

    /** Returns the index of an extreme in extremes and times. @p i: index into directions.nodes. */
    static std::size_t index(const std::size_t i, const unsigned int k, const bool largest)
    {
      return n_extremes * i + 2 * k + (largest ? 0 : 1);
    }
    std::vector<float> extremes; ///< n_extremes values per node of directions [Pa]
    std::vector<float> times;    ///< times of the extremes [s]
  };
} // namespace Voussoir

#endif
