#pragma once

#include <optional>
#include <string>

namespace volumen::dicom {

/// Returns the seconds since 1970 of a DA ("20260314"), or nothing if it is malformed.
std::optional<double> dateSeconds(const std::string& written);

/// Returns the seconds since midnight of a TM ("101112.5"), or nothing if it is malformed.
std::optional<double> timeSeconds(const std::string& written);

/// Returns the seconds since 1970 of a DA and a TM.
std::optional<double> moment(const std::string& date, const std::string& time);

/// Returns the seconds of a DT's zone, "+0130".
std::optional<double> zoneSeconds(const std::string& text);

/// The date, time and zone of a DT.
struct DateTime {
  std::string date, time, zone;
};
DateTime partsOf(const std::string& text);

/// Return a number, TM or DT in one spelling: "70.0" is 70, "110000.000" is 110000. Other text is unchanged.
std::string numberAsOne(const std::string& text);
std::string timeAsOne(const std::string& text);
std::string momentAsOne(const std::string& text);

}  // namespace volumen::dicom
