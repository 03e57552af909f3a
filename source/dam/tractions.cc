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
      const bool is_wet = face.surface == PhysicalId::upstream && !moving_water.empty();
      water_mass.push_back(is_wet ? moving_water[face.node] : 0.);
      free_node.push_back(model.equation[face.node]);
      initial.push_back(initial_stress.empty() ? Vector3{} : times(initial_stress[face.node], face.normal));
    }
    for (unsigned int f = 0; f < faces.size(); ++f)
      for (const unsigned int other : {f - 2, f - 1, f + 1, f + 2})
        if (pair[f] != rigid_ground && other < faces.size() && faces[other].node == faces[f].node &&
            pair[other] == rigid_ground && std::abs(dot(faces[f].normal, faces[other].normal)) < .9)
          edges.push_back({f, other});
  }

  /** The pressure is the added mass times the acceleration normal to the face. */
  void Tractions::add_moving_water(const Unknowns &acceleration)
  {
    for (std::size_t f = 0; f < faces.size(); ++f)
      if (water_mass[f] > 0. && free_node[f] != rigid_ground)
      {
        const Vector3 &n = faces[f].normal;
        const double   pressure = water_mass[f] * dot(get(acceleration, free_node[f]), n);
        for (unsigned int c = 0; c < 3; ++c)
          traction[f][c] -= pressure * n[c];
      }
  }

  const std::vector<Vector3> &Tractions::at(const Unknowns &force, const Unknowns &acceleration,
                                            const std::vector<double> &pressure)
  {
    traction = known;
    for (std::size_t f = 0; f < faces.size() && !pressure.empty(); ++f)
      if (faces[f].surface == PhysicalId::upstream)
        for (unsigned int c = 0; c < 3; ++c)
          traction[f][c] -= pressure[faces[f].node] * faces[f].normal[c];
    if (!acceleration.empty())
      add_moving_water(acceleration);
    const std::vector<Vector3> &of_pair = joints.at(force);
    for (std::size_t f = 0; f < faces.size(); ++f)
      if (pair[f] != rigid_ground)
      {
        const auto &frame = structure.pairs[pair[f]].frame;
        Vector3     t = of_pair[pair[f]];
        t[0] += joint_water[pair[f]];
        const double side = faces[f].surface > PhysicalId::joint_side_2 ? 1. : -1.;
        for (unsigned int c = 0; c < 3; ++c)
          traction[f][c] = side * (frame[0][c] * t[0] + frame[1][c] * t[1] + frame[2][c] * t[2]);
      }
    constexpr unsigned int n_passes = 6; // at corners two nearly orthogonal edges of a joint meet
    for (unsigned int i = 0; i < n_passes; ++i)
      for (const Edge &edge : edges)
        meet(edge);
    result.resize(traction.size());
    for (std::size_t f = 0; f < traction.size(); ++f)
      result[f] = traction[f] - initial[f];
    return result;
  }

  /** Equal shear stresses at an edge, t_1 n_2 = t_2 n_1: changes the traction of the joint face. */
  void Tractions::meet(const Edge &edge)
  {
    const Vector3 &n = faces[edge.joint].normal, &m = faces[edge.other].normal;
    const double   miss = dot(traction[edge.other], n) - dot(traction[edge.joint], m), cosine = dot(n, m);
    for (unsigned int c = 0; c < 3; ++c)
      traction[edge.joint][c] += miss / (1. - cosine * cosine) * (m[c] - cosine * n[c]);
  }
} // namespace Voussoir
