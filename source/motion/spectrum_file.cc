// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/error.h>
#include <voussoir/base/number_text.h>
#include <voussoir/motion/spectrum_file.h>

namespace Voussoir
{
  double SpectrumTable::at(const double T) const
  {
    if (T > curve.x.back())
      throw InputError("The spectrum " + file + " ends at the period " + number_text(curve.x.back()) +
                       " s, but a mode has " + number_text(T) + " s. Extend the table.");
    return curve.at(T);
  }

  SpectrumTable read_spectrum(const std::string &file)
  {
    const SpectrumTable table{
        file, read_curve(file, {"The spectrum ", "period", "periods", "[s]", "acceleration [m/s^2]",
                                "Give --spectrum design, or the path of a table."})};
    if (table.curve.x.front() > SpectrumTable::rigid_period)
      throw InputError(
          "The spectrum " + file + " begins at the period " + number_text(table.curve.x.front()) +
          " s. Add a line with the period 0 and the peak ground acceleration, which acts on rigid "
          "parts of the dam.");
    return table;
  }
} // namespace Voussoir
