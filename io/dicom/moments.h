#pragma once

#include <optional>
#include <string>

namespace volumen::dicom {

/// Seconds since 1970 of a DA ("20260314"); nothing where it is none.
std::optional<double> dateSeconds(const std::string& written);

/// Seconds since midnight of a TM ("101112.5"); nothing where it is none.
std::optional<double> timeSeconds(const std::string& written);

/// Seconds since 1970 of both.
std::optional<double> moment(const std::string& date, const std::string& time);

/// Seconds of a zone as a DT writes it, "+0130".
std::optional<double> zoneSeconds(const std::string& text);

/// Date and time of a DT, and the zone behind them.
struct DateTime {
  std::string date, time, zone;
};
DateTime partsOf(const std::string& text);

/// A number, a TM or a DT in one spelling: "70.0" is 70, "110000.000" is 110000. What is none stays.
std::string numberAsOne(const std::string& text);
std::string timeAsOne(const std::string& text);
std::string momentAsOne(const std::string& text);

}  // namespace volumen::dicom
