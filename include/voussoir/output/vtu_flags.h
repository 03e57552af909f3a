// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_vtu_flags_h
#define voussoir_vtu_flags_h

#include <deal.II/base/data_out_base.h>

namespace Voussoir
{
  /** Returns the settings of .vtu files. With the fast compression the end of a run takes half of the time,
   * and the files are a tenth larger. */
  inline dealii::DataOutBase::VtkFlags vtu_flags()
  {
    dealii::DataOutBase::VtkFlags flags;
    flags.compression_level =
        decltype(flags.compression_level)::best_speed; // an enumeration of deal.II, by version
    return flags;
  }
} // namespace Voussoir

#endif
