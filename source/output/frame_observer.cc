// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/error.h>
#include <voussoir/output/frame_observer.h>
#include <voussoir/solid/solid_grid.h>
#include <voussoir/solid/solid_model.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>

namespace Voussoir
{
  namespace
  {
    constexpr double response_after_motion = 1.; ///< [s]

    template <class T> std::string bytes_of(const std::vector<T> &values)
    {
      return {reinterpret_cast<const char *>(values.data()), values.size() * sizeof(T)};
    }

    template <class T> std::string bytes_of(const T value)
    {
      return {reinterpret_cast<const char *>(&value), sizeof(T)};
    }
  } // namespace

  FrameSteps::FrameSteps(const GroundMotion &motion, const unsigned int n_frames, const double delay)
      : n_frames(n_frames)
  {
    const auto sums_within = [&motion](const double begin, const double end)
    {
      std::vector<double> sum = {0.};
      for (std::size_t k = 0; k < motion.acceleration.size(); ++k)
      {
        const auto &a = motion.acceleration[k];
        const bool  is_within =
            k * motion.dt >= begin - 0.5 * motion.dt && k * motion.dt <= end + 0.5 * motion.dt;
        sum.push_back(sum.back() + (is_within ? a[0] * a[0] + a[1] * a[1] + a[2] * a[2] : 0.));
      }
      return sum;
    };
    std::vector<double> sum = sums_within(0., motion.duration());
    if (motion.parts.size() > 1) // the strongest part of a sequence
    {
      sum = {0.};
      for (const MotionPart &part : motion.parts)
        if (const auto of_part = sums_within(part.begin, part.end); of_part.back() > sum.back())
          sum = of_part;
      if (sum.size() == 1)
        return;
    }
    const auto step_of = [&](const double part)
    { return std::lower_bound(sum.begin() + 1, sum.end() - 1, part * sum.back()) - (sum.begin() + 1); };
    if (n_frames < 2 || !(sum.back() > 0.))
      return;
    first = step_of(.05);
    last = step_of(.95) + std::lround(delay / motion.dt);
    interval =
        std::max(1u, (last - first + n_frames - 1) / (n_frames - 1)); // frames besides that of the start
  }

  bool FrameSteps::contains(const unsigned int step) const
  {
    return n_frames > 0 && (step == 0 || (n_frames > 1 && step >= std::max(1u, first) && step <= last &&
                                          (step - first) % interval == 0));
  }

  Quantized::Quantized(const std::vector<float> &values) : numbers(values.size())
  {
    float largest = 0.f;
    for (const float value : values)
      largest = std::max(largest, std::abs(value));
    if (!(largest > 0.f) || !std::isfinite(largest))
      return;
    unit = largest / 32767.f;
    for (std::size_t i = 0; i < values.size(); ++i)
      numbers[i] = static_cast<std::int16_t>(std::lround(32767. * values[i] / largest));
  }

  FrameObserver::FrameObserver(const RunState &run, StressObserver &stresses)
      : run(run), stresses(stresses),
        steps(run.motion, run.scene().output.frames, run.dam->foundation->delay() + response_after_motion)
  {
    const SolidModel                    &model = *run.dam->model;
    std::map<unsigned int, std::int32_t> index;
    for (const auto surface : model.grid->triangulation.get_boundary_ids())
      for (const FaceQuad &quad : face_quads(model, static_cast<int>(surface)))
      {
        quads.push_back(static_cast<std::int32_t>(surface));
        quads.push_back(static_cast<std::int32_t>(monolith_of(quad.block)));
        for (unsigned int k = 0; k < 4; ++k)
        {
          const unsigned int node = quad.nodes[quad.is_clockwise ? 3 - k : k];
          const auto         found = index.emplace(node, static_cast<std::int32_t>(nodes.size()));
          if (found.second)
            nodes.push_back(node);
          quads.push_back(found.first->second);
        }
      }
  }

  /** Returns displacements relative to the base, three values per node of the surface [m]. */
  std::vector<float> FrameObserver::displacements() const
  {
    std::vector<float> values;
    for (const unsigned int node : nodes)
      for (const double u : run.relative_to_base(node))
        values.push_back(static_cast<float>(u));
    return values;
  }

  /** Returns the maximum principal stress of each node of the surface [Pa]; 0 if stresses are not recorded. */
  std::vector<float> FrameObserver::stresses_now() const
  {
    std::vector<float> values(nodes.size(), 0.f);
    if (!stresses.is_recording())
      return values;
    const std::vector<Stress> all = stresses.now();
    for (std::size_t i = 0; i < nodes.size(); ++i)
      values[i] = static_cast<float>(principal_stresses(all[nodes[i]])[0]);
    return values;
  }

  /** Returns the opening of each node of the surface [m]; 0 outside of joints. */
  std::vector<float> FrameObserver::openings() const
  {
    const Structure   &structure = run.dam->structure;
    std::vector<float> of_node(structure.n_nodes(), 0.f), values(nodes.size(), 0.f);
    for (unsigned int p = 0; p < structure.pairs.size(); ++p)
      for (const unsigned int node : {structure.pairs[p].node_1, structure.pairs[p].node_2})
        if (node != rigid_ground)
          of_node[node] = static_cast<float>(run.integrator->opening_and_slip(p)[0]);
    for (std::size_t i = 0; i < nodes.size(); ++i)
      if (const unsigned int e = run.dam->model->equation[nodes[i]]; e != rigid_ground)
        values[i] = of_node[e];
    return values;
  }

  /** Returns the begin of the file, without frames: a line of JSON, positions [m] and quadrilaterals. */
  std::string FrameObserver::head() const
  {
    std::vector<float> points;
    for (const unsigned int node : nodes)
      for (unsigned int c = 0; c < 3; ++c)
        points.push_back(static_cast<float>(run.dam->model->points[node][c]));
    const std::string stress = stresses.is_recording() ? "true" : "false";
    return "{\"format\": \"voussoir frames 1\", \"nodes\": " + std::to_string(nodes.size()) +
           ", \"quads\": " + std::to_string(quads.size() / 6) + ", \"stress\": " + stress +
           (run.dam->water ? ", \"pressure\": true}\n" : "}\n") + bytes_of(points) + bytes_of(quads);
  }

  /** Returns the dynamic pressure of the water at each node of the surface [Pa]; 0 at dry nodes. */
  std::vector<float> FrameObserver::pressures() const
  {
    const std::vector<double> all = run.dam->water->at_dam(run.dam->water->pressure());
    std::vector<float>        values;
    for (const unsigned int node : nodes)
      values.push_back(static_cast<float>(all[node]));
    return values;
  }

  /** Returns the present state: time [s], three units, and numbers of displacement, stress and opening; with acoustic
   * water also unit and numbers of the pressure. */
  std::string FrameObserver::frame() const
  {
    const Quantized   u(displacements()), s(stresses_now()), d(openings());
    const std::string text = bytes_of(run.integrator->state().time) + bytes_of(u.unit) + bytes_of(s.unit) +
                             bytes_of(d.unit) + bytes_of(u.numbers) + bytes_of(s.numbers) +
                             bytes_of(d.numbers);
    if (!run.dam->water)
      return text;
    const Quantized p(pressures());
    return text + bytes_of(p.unit) + bytes_of(p.numbers);
  }

  void FrameObserver::flush()
  {
    if (!steps.contains(run.step))
      return;
    *file << frame();
    file->check();
    last_time = run.integrator->state().time;
  }

  /** Shortens the file of the previous process to the frames up to the present time. */
  void FrameObserver::keep_frames_so_far(const std::string &name, const std::string &head)
  {
    const bool    water = run.dam->water != nullptr;
    std::ifstream in(name, std::ios::binary);
    std::string   old(head.size(), ' '),
        text(sizeof(double) + (water ? 4 : 3) * sizeof(float) + (water ? 12 : 10) * nodes.size(), ' ');
    std::size_t size = 0;
    double      time = 0.;
    if (!in.read(&old[0], old.size()) || old != head)
      return;
    for (size = head.size(); in.read(&text[0], text.size()); size += text.size())
    {
      std::copy_n(text.data(), sizeof(time), reinterpret_cast<char *>(&time));
      if (!(time <= run.integrator->state().time))
        break;
      last_time = time;
    }
    std::error_code error;
    std::filesystem::resize_file(name, size, error);
    if (error)
      throw WriteError("The file " + name + " cannot be written: " + error.message() + ".");
  }

  void FrameObserver::open(const std::string &directory)
  {
    if (!steps.contains(0)) // Output/Frames is 0
    {
      std::error_code error; // an earlier part of a resumed run may have written frames
      std::filesystem::remove(directory + "/frames.bin", error);
      return;
    }
    const std::string name = directory + "/frames.bin", begin = head();
    if (is_resumed)
      keep_frames_so_far(name, begin);
    const bool continues = last_time >= 0.;
    file = std::make_unique<OutputFile>(name, std::ios::binary | (continues ? std::ios::app : std::ios::out));
    if (!continues)
      *file << begin;
    file->check();
    if (is_resumed && last_time != run.integrator->state().time)
      flush(); // the previous process could not write the frame, for example on a full disk
  }
} // namespace Voussoir
