#include "io/dicom/moments.h"

#include <algorithm>
#include <chrono>

#include "io/dicom/data_set.h"
#include "io/dicom/separators.h"

namespace volumen::dicom {
namespace {

std::optional<double> digits(const std::string& text, std::size_t at, std::size_t count) {
  if (text.size() < at + count) return {};
  const std::string part = text.substr(at, count);
  if (part.find_first_not_of("0123456789") != std::string::npos) return {};
  return parseNumber(part);
}

}  // namespace

std::optional<double> dateSeconds(const std::string& written) {
  const std::string text = dateOrTime(written);
  const auto year = digits(text, 0, 4), month = digits(text, 4, 2), day = digits(text, 6, 2);
  if (!year || !month || !day) return {};
  using namespace std::chrono;
  const year_month_day date{std::chrono::year(int(*year)), std::chrono::month(unsigned(*month)),
                            std::chrono::day(unsigned(*day))};
  if (!date.ok()) return {};
  return double(sys_days(date).time_since_epoch().count()) * 86400;
}

std::optional<double> timeSeconds(const std::string& written) {
  const std::string text = dateOrTime(written);
  const auto part = [&](std::size_t at) { return text.size() <= at ? 0 : digits(text, at, 2); };
  const auto hours = digits(text, 0, 2), minutes = part(2), seconds = part(4);
  if (!hours || !minutes || !seconds || *hours > 23 || *minutes > 59 || *seconds > 60) return {};
  const double fraction =
      text.size() > 7 && text[6] == '.' ? parseNumber("0" + text.substr(6)).value_or(0) : 0;
  return *hours * 3600 + *minutes * 60 + *seconds + fraction;
}

std::optional<double> moment(const std::string& date, const std::string& time) {
  const auto day = dateSeconds(date), ofDay = timeSeconds(time);
  if (!day || !ofDay) return {};
  return *day + *ofDay;
}

std::optional<double> zoneSeconds(const std::string& text) {
  const auto hours = digits(text, 1, 2), minutes = digits(text, 3, 2);
  if (text.size() != 5 || !hours || !minutes || (text[0] != '+' && text[0] != '-')) return {};
  return (text[0] == '-' ? -60 : 60) * (*hours * 60 + *minutes);
}

DateTime partsOf(const std::string& text) {
  const std::size_t zone = std::min(text.find_first_of("+-"), text.size());
  const std::string local = text.substr(0, zone);
  const std::size_t day = std::min<std::size_t>(8, local.size());
  return {local.substr(0, day), local.substr(day), text.substr(zone)};
}

std::string numberAsOne(const std::string& text) {
  const auto number = parseNumber(text);
  return number ? realText(*number) : text;
}
std::string timeAsOne(const std::string& text) {
  const auto seconds = timeSeconds(text);
  return seconds ? realText(*seconds) : text;
}
std::string momentAsOne(const std::string& text) {
  const DateTime parts = partsOf(text);
  return parts.date + timeAsOne(parts.time) + parts.zone;
}

}  // namespace volumen::dicom
