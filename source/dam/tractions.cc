// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/dam/tractions.h>
#include <voussoir/solid/solid_model.h>

#include <cmath>
#include <map>

namespace Voussoir
{
  namespace
  {
    Vector3 times(const Stress &s, const Vector3 &n) // xx yy zz xy yz zx
    {
      return {{s[0] * n[0] + s[3] * n[1] + s[5] * n[2], s[3] * n[0] + s[1] * n[1] + s[4] * n[2],
               s[5] * n[0] + s[4] * n[1] + s[2] * n[2]}};
    }

    Matrix3 square_of(const Vector3 &v) // v v^T
    {
      return Voussoir::times(Matrix3{{v[0], 0., 0., v[1], 0., 0., v[2], 0., 0.}},
                             Matrix3{{v[0], v[1], v[2]}});
    }
  } // namespace

  Unknowns mean_acceleration(const Unknowns &v_before, const Unknowns &v, const double dt,
                             const Vector3 &ground_before, const Vector3 &ground, const double weight)
  {
    Unknowns a(v.size());
    for (std::size_t k = 0; k < v.size(); ++k)
      a[k] = (v[k] - v_before[k]) / dt + (1. - weight) * ground_before[k % 3] + weight * ground[k % 3];
    return a;
  }

  Tractions::Tractions(const SolidModel &model, const Structure &structure,
                       const KnownTraction &known_traction, const std::vector<Stress> &initial_stress,
                       std::vector<double> water, const std::vector<double> &moving_water)
      : structure(structure), joints(model, structure), joint_water(std::move(water))
  {
    joint_water.resize(structure.pairs.size(), 0.);
    std::map<std::pair<int, unsigned int>, unsigned int> pair_at; // surface and free node
    for (unsigned int p = 0; p < structure.pairs.size(); ++p)
      if (const Pair &q = structure.pairs[p]; q.planes.empty())
      {
        pair_at[{PhysicalId::joint_side_1 + q.joint + 1, q.node_1}] = p;
        pair_at[{PhysicalId::joint_side_2 + q.joint + 1, q.node_2}] = p;
      }
    for (const NodeFace &face : faces_at_nodes(model))
    {
      Vector3 pressed{};
      if (is_joint_side(face.surface))
      {
        const auto found = pair_at.find({face.surface, model.equation[face.node]});
        if (found == pair_at.end())
          continue;
        pair.push_back(found->second);
      }
      else
      {
        pair.push_back(rigid_ground);
        pressed = known_traction(face.surface, model.points[face.node][2], face.normal);
      }
      faces.push_back(face);
      known.push_back(pressed);
      if (face.surface == PhysicalId::upstream && !moving_water.empty() && moving_water[face.node] > 0. &&
          model.equation[face.node] != rigid_ground)
        wet_faces.push_back({static_cast<unsigned int>(faces.size() - 1), model.equation[face.node],
                             moving_water[face.node]});
      initial.push_back(initial_stress.empty() ? Vector3{} : times(initial_stress[face.node], face.normal));
    }
    for (unsigned int f = 0; f < faces.size(); ++f)
    {
      const Vector3    &n = faces[f].normal;
      const std::size_t first = edges.size();
      Matrix3           gram = square_of(n);
      for (const unsigned int other : {f - 4, f - 3, f - 2, f - 1, f + 1, f + 2, f + 3, f + 4})
        if (pair[f] != rigid_ground && other < faces.size() && faces[other].node == faces[f].node &&
            pair[other] == rigid_ground && std::abs(dot(n, faces[other].normal)) < .9)
        {
          const Vector3 d = cross(cross(n, faces[other].normal), n); // in the plane of the joint
          gram = sum(gram, 1., square_of(d));
          edges.push_back({f, other, d});
        }
      if (const double t = gram[0] + gram[4] + gram[8] - 1.;
          determinant(gram) < .02 * t * t) // one edge, or nearly parallel ones
        gram = {{t, 0., 0., 0., t, 0., 0., 0., t}};
      for (std::size_t e = first; e < edges.size(); ++e)
        edges[e].gain = inverse(gram) * edges[e].gain;
    }
  }

  std::vector<Vector3> Tractions::at(const Unknowns &force, const Unknowns &acceleration,
                                     const std::vector<double> &pressure) const
  {
    std::vector<Vector3> traction = known;
    const auto           press = [&](const std::size_t f, const double by)
    {
      for (unsigned int c = 0; c < 3; ++c)
        traction[f][c] -= by * faces[f].normal[c];
    };
    for (std::size_t f = 0; f < faces.size() && !pressure.empty(); ++f)
      if (faces[f].surface == PhysicalId::upstream)
        press(f, pressure[faces[f].node]);
    for (const WetFace &wet : wet_faces)
      if (!acceleration.empty())
        press(wet.face, wet.mass * dot(get(acceleration, wet.free_node), faces[wet.face].normal));
    add_joints<double>([&](const std::size_t k) { return force[k]; }, traction);
    return traction;
  }

  void Tractions::at(const unsigned int n_motions, const float *force, const float *acceleration,
                     float *result) const
  {
    constexpr unsigned int              n = 4;
    typedef float                       Numbers __attribute__((vector_size(4 * n)));
    typedef Numbers                     AnyNumbers __attribute__((aligned(4), may_alias));
    std::vector<std::array<Numbers, 3>> traction(faces.size());
    for (unsigned int first = 0; first < n_motions; first += n)
    {
      const auto load = [&](const float *from, const std::size_t k) -> Numbers
      { return *reinterpret_cast<const AnyNumbers *>(from + n_motions * k + first); };
      for (std::size_t f = 0; f < faces.size(); ++f)
        for (unsigned int c = 0; c < 3; ++c)
          traction[f][c] = Numbers{} + static_cast<float>(known[f][c]);
      for (std::size_t w = 0; acceleration != nullptr && w < wet_faces.size(); ++w)
      {
        const std::size_t f = wet_faces[w].face;
        const Numbers     pressure = static_cast<float>(wet_faces[w].mass) * load(acceleration, w);
        for (unsigned int c = 0; c < 3; ++c)
          traction[f][c] -= pressure * static_cast<float>(faces[f].normal[c]);
      }
      add_joints<float>([&](const std::size_t k) { return load(force, k); }, traction);
      for (std::size_t k = 0; k < 3 * faces.size(); ++k)
        *reinterpret_cast<AnyNumbers *>(result + n_motions * k + first) = traction[k / 3][k % 3];
    }
  }

  template <class Scalar, class Force, class T>
  void Tractions::add_joints(const Force &force, std::vector<std::array<T, 3>> &traction) const
  {
    std::vector<std::array<T, 3>> of_pair;
    joints.find<Scalar>(force, of_pair);
    for (std::size_t f = 0; f < faces.size(); ++f)
      if (pair[f] != rigid_ground)
      {
        const auto      &frame = structure.pairs[pair[f]].frame;
        std::array<T, 3> t = of_pair[pair[f]];
        t[0] += static_cast<Scalar>(joint_water[pair[f]]);
        const Scalar side = faces[f].surface > PhysicalId::joint_side_2 ? 1. : -1.;
        for (unsigned int c = 0; c < 3; ++c)
          traction[f][c] =
              side * (Scalar(frame[0][c]) * t[0] + Scalar(frame[1][c]) * t[1] + Scalar(frame[2][c]) * t[2]);
      }
    std::array<T, 3> before{};
    for (std::size_t e = 0; e < edges.size(); ++e)
    {
      const auto &[joint, other, gain] = edges[e];
      if (e == 0 || edges[e - 1].joint != joint)
        before = traction[joint];
      T miss = {};
      for (unsigned int c = 0; c < 3; ++c)
        miss +=
            Scalar(faces[joint].normal[c]) * traction[other][c] - Scalar(faces[other].normal[c]) * before[c];
      for (unsigned int c = 0; c < 3; ++c)
        traction[joint][c] += miss * static_cast<Scalar>(gain[c]);
    }
    for (std::size_t f = 0; f < traction.size(); ++f)
      for (unsigned int c = 0; c < 3; ++c)
        traction[f][c] -= static_cast<Scalar>(initial[f][c]);
  }
} // namespace Voussoir
