// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/curve_file.h>
#include <voussoir/base/error.h>
#include <voussoir/base/number_text.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <locale>
#include <sstream>

namespace Voussoir
{
  namespace
  {
    /** Adds a line of the file to the curve. @p place: file and number of the line, for messages. */
    void add_line(const std::string &line, const std::string &place, const CurveWords &text, Curve &curve)
    {
      std::istringstream words(line);
      words.imbue(std::locale::classic());
      double      x = 0., y = 0.;
      std::string more;
      if (!(words >> x >> y) || words >> more)
        throw InputError(place + " is \"" + line + "\". Write two numbers: the " + text.x + " " + text.unit +
                         " and the " + text.y + ". Put # before other text.");
      if (!(x >= 0. && y >= 0.))
        throw InputError(place + " has a negative number. Both numbers are at least 0.");
      if (!curve.x.empty() && !(x > curve.x.back()))
        throw InputError(place + ": the " + text.all_x + " must ascend, but " + number_text(x) + " follows " +
                         number_text(curve.x.back()) + ". Sort the lines by " + text.x + ".");
      curve.x.push_back(x);
      curve.y.push_back(y);
    }
  } // namespace

  std::ifstream open_text(const std::string &file, const std::string &message)
  {
    std::error_code error;
    std::ifstream   in;
    if (std::filesystem::is_regular_file(file, error))
      in.open(file);
    if (!in.is_open())
      throw InputError(message);
    char mark[3] = "";
    if (!in.read(mark, 3) || std::string(mark, 3) != "\xEF\xBB\xBF")
    {
      in.clear();
      in.seekg(0);
    }
    return in;
  }

  double Curve::at(const double at) const
  {
    const std::size_t i = std::lower_bound(x.begin(), x.end(), at) - x.begin();
    if (i == x.size() || i == 0)
      return i == 0 ? y.front() : y.back();
    return y[i - 1] + (at - x[i - 1]) / (x[i] - x[i - 1]) * (y[i] - y[i - 1]);
  }

  Curve read_curve(const std::string &file, const CurveWords &words)
  {
    const std::string name = words.curve + file;
    std::ifstream in = open_text(file, name + " cannot be read. " + words.without_file + " The columns are " +
                                           words.x + " " + words.unit + ", " + words.y + ".");
    Curve         curve;
    std::string   line;
    for (unsigned int number = 1; std::getline(in, line); ++number)
    {
      line = line.substr(0, line.find('#'));
      std::replace_if(
          line.begin(), line.end(), [](const char c) { return c == ',' || c == ';' || c == '\r'; }, ' ');
      std::string first;
      if (!(std::istringstream(line) >> first) ||
          (curve.x.empty() && std::isalpha(static_cast<unsigned char>(first[0]))))
        continue; // empty line or headings
      add_line(line, name + ", line " + std::to_string(number), words, curve);
    }
    if (curve.x.size() < 2)
      throw InputError(name + " has fewer than two " + words.all_x + ". Write one line per " + words.x +
                       ": " + words.x + " " + words.unit + ", " + words.y + ".");
    return curve;
  }
} // namespace Voussoir
