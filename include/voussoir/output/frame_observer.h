// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_frame_observer_h
#define voussoir_frame_observer_h

#include <voussoir/output/observers.h>
#include <voussoir/solid/face_quads.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace Voussoir
{
  /** Steps whose state is a frame: the start, and steps at equal intervals in the strong part of the motion. */
  class FrameSteps
  {
  public:
    /** Chooses the steps. The strong part is from 5 % to 95 % of the Arias intensity (Trifunac and Brady 1975),
     * longer by @p delay.
     * @param motion ground motion; its samples are the steps
     * @param n_frames largest number of frames; 0: none
     * @param delay time from the motion to the end of the response, such as that of the waves in the rock [s] */
    FrameSteps(const GroundMotion &motion, unsigned int n_frames, double delay);

    /** Returns true if the state after @p step steps is a frame. */
    bool contains(unsigned int step) const;

  private:
    unsigned int n_frames, first = 0, last = 0, interval = 1; ///< [steps]
  };

  /** Values as 16-bit integers. */
  struct Quantized
  {
    /** Rounds @p values to multiples of a unit: the largest magnitude is 32767 units. */
    explicit Quantized(const std::vector<float> &values);

    float                     unit = 1.f; ///< value of 1, in the unit of the values
    std::vector<std::int16_t> numbers;    ///< the values in units
  };

  /** Displacements, stresses and openings at the surface of the dam over time (frames.bin), for the view of the
   *  report. The file grows during the run; a resumed run continues the file. */
  class FrameObserver : public Observer
  {
  public:
    /** Finds the surface. Both arguments must outlive the observer. */
    FrameObserver(const RunState &run, StressObserver &stresses);
    void flush() override;
    void open(const std::string &directory) override;
    void load(boost::archive::binary_iarchive &) override { is_resumed = true; }

  private:
    std::string        head() const;
    std::string        frame() const;
    std::vector<float> displacements() const;
    std::vector<float> stresses_now() const;
    std::vector<float> openings() const;
    std::vector<float> pressures() const;
    void               keep_frames_so_far(const std::string &name, const std::string &head);

    const RunState             &run;
    StressObserver             &stresses;
    const FrameSteps            steps;
    std::vector<unsigned int>   nodes; ///< nodes of the surface
    std::vector<std::int32_t>   quads; ///< boundary id, monolith, four indices into @p nodes
    bool                        is_resumed = false;
    double                      last_time = -1.; ///< of the last frame of the file [s]; -1: none
    std::unique_ptr<OutputFile> file;
  };
} // namespace Voussoir

#endif
