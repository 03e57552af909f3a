// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_incident_field_h
#define voussoir_incident_field_h

#include <voussoir/base/ranks.h>
#include <voussoir/base/tensor3.h>

namespace Voussoir
{
  /** A motion that enters a region through its artificial boundary, in lock-step with the region: at points
   * whose order the boundary gives. */
  class IncidentField
  {
  public:
    virtual ~IncidentField() = default;

    /** To the next time step. */
    void advance()
    {
      std::vector<Ranks::Message> messages;
      begin_step(messages);
      Ranks::exchange(messages);
      end_step();
    }

    /** The same in two parts, between which the @p messages that it adds are to be exchanged. */
    virtual void begin_step(std::vector<Ranks::Message> &messages) = 0;
    virtual void end_step() = 0;

    /** Displacement of the points now, three values each [m]. */
    virtual void evaluate(Unknowns &u) const = 0;

    virtual std::vector<std::vector<double> *> state() = 0;

    /** With several ranks, by all: state() is the whole one after that. */
    virtual void collect() {}
  };
} // namespace Voussoir

#endif
