// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/names.h>
#include <voussoir/base/number_text.h>
#include <voussoir/base/units.h>
#include <voussoir/motion/record_formats.h>

#include <algorithm>
#include <cctype>
#include <cmath>

namespace Voussoir
{
  namespace
  {
    constexpr const char *advice = " Give the file with the accelerations.";

    void add_channel(MotionRecord &record, const std::string &direction, std::vector<double> values)
    {
      record.channels.emplace_back();
      record.channels.back().set_direction(direction);
      record.channels.back().values = std::move(values);
    }

    /** Returns the unit_name() of a unit of acceleration. Throws InputError for other units, by name. */
    std::string unit_of(const RecordText &text, const std::size_t line, const std::string &unit)
    {
      std::string word = trimmed(unit);
      word.resize(std::min(word.size(), word.find_first_of(" .,;(\t"))); // G. FILTER POINTS: ...
      const std::string name = unit_name(lower_case(word), "acceleration");
      if (name.empty())
        text.fail(line, "the unit '" + word + "' is no unit of acceleration." + advice);
      return name;
    }

    /** Throws InputError if one of the first @p end lines names velocities, displacements or spectra. */
    void check_quantity(const RecordText &text, const std::size_t end)
    {
      for (const char *quantity : {"velocity", "displacement", "spectr"})
        if (const std::size_t line = text.find(quantity, 0, end); line < std::min(end, text.lines.size()))
          text.fail(line, "this is not a record of acceleration ('" + std::string(quantity) + "')." + advice);
    }

    /** Returns the width of a number in a format of Fortran: 10 for (8f10.6), 8(1pe10.4e1) and (10I8); or 0. */
    std::size_t fortran_width(const std::string &line)
    {
      for (std::size_t k = std::min(line.rfind('('), line.size()); k + 1 < line.size(); ++k)
        if (std::string("fFeEiIgG").find(line[k]) != std::string::npos && std::isdigit(line[k + 1] & 0x7f))
          return leading_number(line.substr(k + 1));
      return 0;
    }

    MotionRecord read_knet(const RecordText &text)
    {
      MotionRecord      record;
      const std::string scale = text.value("scale factor"),
                        direction = text.value("dir."); // 3920(gal)/6182761
      const std::size_t open = scale.find('('), close = scale.find(")/");
      const double      numerator = leading_number(scale), frequency = text.positive("sampling freq(hz)"),
                   factor = close < scale.size() ? numerator / leading_number(scale.substr(close + 2)) : NAN;
      if (open > close || !(factor > 0.))
        text.fail(text.find("scale factor"),
                  "expected a scale factor as 3920(gal)/6182761. Download the file again.");
      record.dt = 1. / frequency;
      if (const std::size_t line = text.find("record time"); line < text.lines.size())
        record.clock = trimmed(text.lines[line].substr(std::string("record time").size()));
      record.unit = unit_of(text, text.find("scale factor"), scale.substr(open + 1, close - open - 1));
      std::size_t         line = std::min<std::size_t>(text.find("memo."), 16) + 1;
      std::vector<double> values =
          text.numbers(line, std::round(text.positive("duration time(s)") * frequency), 0, true);
      double mean = 0.;
      for (const double value : values)
        mean += value / values.size();
      for (double &value : values)
        value = factor * (value - mean);
      record.notes = "mean of " + number_text(factor * mean) + " gal subtracted";
      const int number = direction.size() == 1 ? direction[0] - '0' : 0; // of KiK-net
      if (number < 1 || number > 6)
        add_channel(record, direction, std::move(values));
      else
      {
        add_channel(record, std::string("NSEWUD").substr((number - 1) % 3 * 2, 2), std::move(values));
        record.channels[0].name += number <= 3 ? '1' : '2';
        record.notes += number <= 3 ? ", sensor in the borehole" : ", sensor at the surface";
      }
      return record;
    }

    MotionRecord read_esm(const RecordText &text)
    {
      MotionRecord record;
      std::size_t  line = 0;
      for (std::size_t k = 0; k < std::min<std::size_t>(text.lines.size(), 100); ++k)
        if (text.lines[k].find(':') != std::string::npos)
          line = k + 1;
      check_quantity(text, line);
      record.dt = text.positive("sampling_interval_s:");
      record.clock = text.value("date_time_first_sample_yyyymmdd_hhmmss:").substr(0, 15);
      record.unit = unit_of(text, 0, text.value("units:"));
      add_channel(record, text.value("stream:"), text.numbers(line, text.positive("ndata:"), 0, true));
      for (const char *key :
           {"processing:", "baseline_correction:", "low_cut_frequency_hz:", "high_cut_frequency_hz:"})
        if (const std::string value = text.value(key); !value.empty())
          record.notes += (record.notes.empty() ? "" : ", ") + std::string(key) + " " + value;
      return record;
    }

    MotionRecord read_afad(const RecordText &text)
    {
      MotionRecord record;
      record.dt = text.positive("sampling interval");
      record.unit = "cm/s^2";
      record.notes = "not corrected";
      std::size_t              line = text.find("sampling interval") + 1;
      std::vector<std::string> names, words;
      for (; line < text.lines.size(); ++line, names = words.empty() ? names : words)
        if (words = words_of(text.lines[line]);
            !words.empty() && std::all_of(words.begin(), words.end(), is_number))
          break;
      names.resize(3);
      for (const std::string &name : names)
        if (add_channel(record, name, {}); record.channels.back().axis == '?')
          text.fail(line, "expected three directions above the numbers, such as N-S E-W U-D. Correct them.");
      const std::vector<double> all = text.numbers(line, 3 * text.positive("number of data"), 12, true);
      for (std::size_t k = 0; k < all.size(); ++k)
        record.channels[k % 3].values.push_back(all[k]);
      return record;
    }

    MotionRecord read_smc(const RecordText &text)
    {
      MotionRecord record;
      check_quantity(text, 1);
      std::size_t               line = 11;
      const std::vector<double> integers = text.numbers(line, 48, 10), reals = text.numbers(line, 50, 15);
      if (!(reals[1] > 0. && reals[1] < 1e5 && integers[15] >= 0. && integers[15] < 1e8))
        text.fail(12, "expected the number of comments as integer 16, and the sampling rate as real "
                      "number 2. Download the file again.");
      record.dt = 1. / reals[1];
      record.unit = "cm/s^2";
      record.notes = text.find("uncorrected", 0, 1) == 0 ? "not corrected" : "corrected";
      line += integers[15];
      const std::string direction = integers[12] == 0.     ? "up"
                                    : integers[12] == 180. ? "down"
                                                           : number_text(integers[13]);
      add_channel(record, direction, text.numbers(line, integers[16], 10, true));
      return record;
    }

    /** Reads the values of a channel after a line that begins with their number and ends with their format. @p line:
     * this line, then the first one after the values. */
    void add_block(const RecordText &text, std::size_t &line, const std::string &direction, const double dt,
                   const std::string &unit, MotionRecord &record)
    {
      const std::string name = unit_of(text, line, unit), header = text.lines[line];
      const double      n = leading_number(header);
      if (!(dt > 0.) || (record.dt > 0. && (dt != record.dt || name != record.unit)))
        text.fail(line, "the channel has " + number_text(n) + " values, steps of " + number_text(dt) +
                            " s, unit " + name + ". Step and unit must be valid and equal in all channels.");
      record.dt = dt;
      record.unit = name;
      add_channel(record, direction, text.numbers(++line, n, fortran_width(header)));
    }

    MotionRecord read_cosmos(const RecordText &text)
    {
      MotionRecord      record;
      const std::size_t n = text.lines.size();
      std::size_t       line = 0;
      while ((line = text.find("integer-header values follow", line, n)) < n)
      {
        std::size_t       real = text.find("real-header values follow", line, n);
        const std::size_t data = text.find(" pts,", real, n);
        if (data == n || lower_case(text.lines[data]).find("units=") == std::string::npos)
          text.fail(line, "the header of the channel is not complete. Download the file again.");
        const std::size_t width[] = {fortran_width(text.lines[line]), fortran_width(text.lines[real])};
        const std::vector<double> integers = text.numbers(++line, 100, width[0]),
                                  reals = text.numbers(++real, 100, width[1]);
        const std::string words = lower_case(text.lines[data]), unit = words.substr(words.find("units=") + 6);
        line = data + 1;
        if (words.find("accel") == std::string::npos)
          continue;
        const double azimuth = integers[53], dt = 1e-3 * reals[61], n_values = leading_number(words),
                     seconds = leading_number(words.substr(words.find("approx") + 6));
        if (std::abs(seconds - dt * n_values) > 1. + .02 * seconds)
          text.fail(data, "the values last about " + number_text(seconds) +
                              " s, but real number 62 states steps of " + number_text(reals[61]) +
                              " ms. Correct the header.");
        add_block(text, line = data,
                  azimuth == 400.   ? "up"
                  : azimuth == 401. ? "down"
                                    : number_text(azimuth),
                  dt, unit, record);
        record.notes = integers[0] == 1. ? "V1, not corrected" : "V" + number_text(integers[0]);
      }
      if (record.channels.empty())
        check_quantity(text, n);
      return record;
    }

    constexpr const char *csmip_line = "points of accel data equally spaced at";

    MotionRecord read_csmip(const RecordText &text)
    {
      MotionRecord      record;
      const std::size_t n = text.lines.size();
      for (std::size_t line, begin = 0; (line = text.find(csmip_line, begin, n)) < n; begin = line)
      {
        const std::string words = lower_case(text.lines[line]), unit = words.substr(words.rfind(" in ") + 4);
        const std::size_t at = text.find("chan ", begin, line); // Chan  1:  90 Deg
        const std::string after = at < line ? text.lines[at] + ": ? " : ":? ";
        add_block(text, line, words_of(after.substr(after.find(':') + 1))[0],
                  leading_number(words.substr(words.find(" at") + 3)), unit, record);
      }
      record.notes = "V2, corrected";
      return record;
    }

    MotionRecord read_at2(const RecordText &text)
    {
      MotionRecord record;
      std::size_t  line = text.find("npts", 0, 8); // the header, usually the fourth line
      check_quantity(text, line);
      record.unit = "g";
      std::string direction;
      for (std::size_t k = 0; k < line; ++k)
        if (const auto units = lower_case(text.lines[k]).find("units of "); units != std::string::npos)
          record.unit = unit_of(text, k, text.lines[k].substr(units + 9));
        else if (const auto comma = text.lines[k].rfind(','); comma != std::string::npos)
          direction = text.lines[k].substr(comma + 1); // EL CENTRO ARRAY 6, 230
      std::vector<double> numbers;                     // "4000 .01 NPTS, DT" or "NPTS= 4000, DT= .0050SEC"
      for (const std::string &word : words_of(text.lines[line]))
        if (const double number = leading_number(word); std::isfinite(number))
          numbers.push_back(number);
      if (numbers.size() < 2 || !(numbers[1] > 0.))
        text.fail(line, "expected the number of points NPTS and the time step DT, both positive.");
      record.dt = numbers[1];
      add_channel(record, direction, text.numbers(++line, numbers[0], 15, true));
      return record;
    }

    const RecordFormat formats[] = {
        {"K-NET or KiK-net", "NIED, kyoshin.bosai.go.jp/kyoshin/man/knetform.html",
         [](const RecordText &t) { return t.has("sampling freq") && t.has("scale factor"); }, read_knet},
        {"ESM or AFAD (header KEY: value)", "DYNA format 1.2, esm-db.eu",
         [](const RecordText &t) { return t.has("sampling_interval_s:"); }, read_esm},
        {"AFAD (three columns)", "National Strong-Motion Network of Turkey, tadas.afad.gov.tr",
         [](const RecordText &t) { return t.has("strong ground motion records of turk"); }, read_afad},
        {"SMC", "USGS, National Strong-Motion Project, nsmp.wr.usgs.gov/smcfmt.html",
         [](const RecordText &t)
         { return t.lines.size() > 1 && t.lines[1][0] == '*' && !is_number(t.lines[0]); },
         read_smc},
        {"COSMOS", "COSMOS format 1.20, strongmotioncenter.org/vdc/cosmos_format_1_20.pdf",
         [](const RecordText &t) { return t.has("integer-header values follow"); }, read_cosmos},
        {"CSMIP V2", "California Strong Motion Instrumentation Program, strongmotioncenter.org",
         [](const RecordText &t) { return t.has(csmip_line); }, read_csmip},
        {"PEER AT2", "ngawest2.berkeley.edu",
         [](const RecordText &t) { return t.find("npts", 0, 8) < t.lines.size(); }, read_at2}};
  } // namespace

  void MotionChannel::set_direction(const std::string &text)
  {
    constexpr const char *names[] = {" x ",
                                     " y ",
                                     " z ud up ver vert vertical ",
                                     " du dn dwn down ",
                                     " n ns sn north ",
                                     " e ew we east ",
                                     " s south ",
                                     " w west "};
    std::string           word;
    for (const unsigned char c : text)
      if (std::isalnum(c))
        word += c;
    name = word;
    word = lower_case(word);
    const double number = leading_number(word);
    if (const std::size_t digits = word.find_first_not_of("0123456789"); number >= 0. && number <= 360.)
      if (digits == std::string::npos || word.compare(digits, 3, "deg") == 0)
      {
        axis = 'h', azimuth = number, name = name.substr(0, digits);
        return;
      }
    if (word.size() == 3 && word.find_first_of("nlgh", 1) == 1 && word.find_first_of("enz", 2) == 2)
      word.erase(0, 2); // HNE, HGN, HLZ
    for (unsigned int i = 0; i < 8; ++i)
      if (!word.empty() && std::string(names[i]).find(" " + word + " ") != std::string::npos)
        axis = "xyzzhhhh"[i], azimuth = i < 4 ? 0. : 90. * (i - 4), sign = i == 3 ? -1. : 1.;
  }

  double MotionRecord::duration() const
  {
    return dt * (channels.at(0).values.size() - 1);
  }

  const RecordFormat *record_format_of(const RecordText &text)
  {
    const auto format = std::find_if(std::begin(formats), std::end(formats),
                                     [&](const RecordFormat &row) { return row.is(text); });
    return format == std::end(formats) ? nullptr : format;
  }

  std::string record_format_names()
  {
    return names_of(formats, ", ");
  }
} // namespace Voussoir
