// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_incident_field_h
#define voussoir_incident_field_h

#include <voussoir/base/ranks.h>
#include <voussoir/base/tensor3.h>

namespace Voussoir
{
  /** Motion that enters a region through its artificial boundary. It advances in step with the region. The
   * boundary defines the points and their order. */
  class IncidentField
  {
  public:
    virtual ~IncidentField() = default;

    /** Advances the field by one time step. */
    void advance()
    {
      std::vector<Ranks::Message> messages;
      begin_step(messages);
      Ranks::exchange(messages);
      end_step();
    }

    /** Begins the step of advance(). The caller must exchange the appended @p messages before end_step(). */
    virtual void begin_step(std::vector<Ranks::Message> &messages) = 0;
    /** Completes the step of begin_step(). */
    virtual void end_step() = 0;

    /** Stores the current displacement of the points in @p u, three values each [m]. */
    virtual void evaluate(Unknowns &u) const = 0;

    /** Returns all state variables, for checkpoints. */
    virtual std::vector<std::vector<double> *> state() = 0;

    /** Gathers the whole field in the arrays of state() on the first process. All processes must call it. */
    virtual void gather_on_root() {}
  };
} // namespace Voussoir

#endif
