#include <algorithm>

#include "io/dicom/separators.h"
#include "io/study/iso_date.h"

namespace volumen::dicom {
namespace {

/// Returns the date before a time, "20260314"; empty if there is none.
std::string dayOf(const std::string& time) {
  return time.size() >= 14 && time.find('.') != 6 ? time.substr(0, 8) : std::string();
}

/// Returns the time of day, with the date if the times span several days.
std::string clockText(const std::vector<std::string>& times, std::size_t n) {
  const std::string day = dayOf(times[n]), of = times[n].substr(day.size());
  if (of.size() < 6) return times[n];
  const std::string clock = of.substr(0, 2) + ":" + of.substr(2, 2) + ":" + of.substr(4);
  const bool oneDay =
      std::ranges::all_of(times, [&](const std::string& other) { return dayOf(other) == day; });
  if (oneDay || day.empty()) return clock;
  return isoDate(day) + " " + clock;
}

std::vector<std::string> components(const std::string& text) {
  std::vector<std::string> all(1);
  for (const char c : text)
    if (c == '\\')
      all.emplace_back();
    else
      all.back() += c;
  return all;
}

/// Returns the components of "ORIGINAL\PRIMARY\M" that not all values share.
std::string differing(const std::vector<std::string>& values, std::size_t n) {
  std::string label;
  const std::vector<std::string> own = components(values[n]);
  for (std::size_t c = 0; c < own.size(); ++c) {
    const bool alike = std::ranges::all_of(values, [&](const std::string& value) {
      const std::vector<std::string> other = components(value);
      return c < other.size() && other[c] == own[c];
    });
    if (!alike && !own[c].empty()) label += (label.empty() ? "" : " ") + own[c];
  }
  return label;
}

std::string secondsText(const std::string& milliseconds) {
  const auto ms = parseNumber(milliseconds);
  return ms ? realText(*ms / 1000) : milliseconds;
}

}  // namespace

std::string wordsOf(const Separator& separator, const std::vector<std::string>& values, std::size_t n) {
  const std::string before = separator.before, &value = values[n];
  if (separator.words == Separator::Words::direction) return before + std::to_string(n + 1);
  if (value.empty()) return before + "not given";
  switch (separator.words) {
    case Separator::Words::imageType:
      return differing(values, n);
    case Separator::Words::clock:
      return clockText(values, n);
    case Separator::Words::seconds:
      return before + secondsText(value) + separator.after;
    default:
      return before + value + separator.after;
  }
}

}  // namespace volumen::dicom
