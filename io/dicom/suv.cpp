#include "io/suv.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "io/dicom/data_set.h"
#include "io/dicom/header.h"
#include "io/dicom/parallel.h"
#include "io/worker/batches.h"
#include "io/worker/study_fields.h"

namespace volumen {
namespace {

using dicom::DataSet;
using dicom::InspectedFile;

DataSet dataOf(const InspectedFile& file) { return {file.scanned.head, file.scanned.dataSet.elements}; }

std::optional<double> digits(const std::string& text, std::size_t at, std::size_t count) {
  if (text.size() < at + count) return {};
  const std::string part = text.substr(at, count);
  if (part.find_first_not_of("0123456789") != std::string::npos) return {};
  return dicom::parseNumber(part);
}

/// Seconds since 1970 of a DA ("20260314"); nothing where it is none.
std::optional<double> dateSeconds(const std::string& written) {
  const std::string text = dicom::dateOrTime(written);
  const auto year = digits(text, 0, 4), month = digits(text, 4, 2), day = digits(text, 6, 2);
  if (!year || !month || !day) return {};
  using namespace std::chrono;
  const year_month_day date{std::chrono::year(int(*year)), std::chrono::month(unsigned(*month)),
                            std::chrono::day(unsigned(*day))};
  if (!date.ok()) return {};
  return double(sys_days(date).time_since_epoch().count()) * 86400;
}

/// Seconds since midnight of a TM ("101112.5"); nothing where it is none.
std::optional<double> timeSeconds(const std::string& written) {
  const std::string text = dicom::dateOrTime(written);
  const auto part = [&](std::size_t at) { return text.size() <= at ? 0 : digits(text, at, 2); };
  const auto hours = digits(text, 0, 2), minutes = part(2), seconds = part(4);
  if (!hours || !minutes || !seconds) return {};
  const double fraction =
      text.size() > 7 && text[6] == '.' ? dicom::parseNumber("0" + text.substr(6)).value_or(0) : 0;
  return *hours * 3600 + *minutes * 60 + *seconds + fraction;
}

std::optional<double> moment(const DataSet& data, std::uint32_t dateTag, std::uint32_t timeTag) {
  const auto date = dateSeconds(data.text(dateTag, data.root()));
  const auto time = timeSeconds(data.text(timeTag, data.root()));
  if (!date || !time) return {};
  return *date + *time;
}

Error missing(const char* name, std::uint32_t tag) {
  return Error{std::string(name) + " " + dicom::tagText(tag) + " is missing"};
}

/// A number above 0, or the sentence that it is missing.
Result<double> positive(const DataSet& data, DataSet::Scope scope, const char* name, std::uint32_t tag) {
  const auto value = data.number(tag, scope);
  if (!value || !(*value > 0)) return missing(name, tag);
  return *value;
}

/// When the earliest picture of the series was acquired; nothing where one does not say.
std::optional<double> earliestAcquisition(const Series& series) {
  std::vector<std::string> files = series.files;
  files.erase(std::unique(files.begin(), files.end()), files.end());
  std::vector<std::optional<double>> times(files.size());
  dicom::forEachParallel(files.size(), "", {}, {}, [&](std::size_t n) {
    const InspectedFile file = dicom::inspectFile(files[n]);
    times[n] = moment(dataOf(file), 0x00080022, 0x00080032);
    worker::finishStep();
  });
  return *std::min_element(times.begin(), times.end());  // nothing counts as the least
}

/// When the scan began, which the values are corrected to: the time of the series, unless it is later than
/// the first picture.
Result<double> scanStart(const DataSet& data, const Series& series) {
  const auto ofSeries = moment(data, 0x00080021, 0x00080031), acquired = earliestAcquisition(series);
  if (ofSeries && acquired) return std::min(*ofSeries, *acquired);
  if (ofSeries) return *ofSeries;
  if (acquired) return *acquired;
  return missing("SeriesTime", 0x00080031);
}

/// Seconds from the injection to the start of the scan.
Result<double> decaySeconds(const DataSet& data, DataSet::Scope dose, const Series& series) {
  constexpr double day = 86400;
  const Result<double> scan = scanStart(data, series);
  if (!scan) return scan.error();
  const std::string dateTime = data.text(0x00181078, dose);
  const std::size_t zone = dateTime.find_first_of("+-");
  if (zone != std::string::npos && dateTime.substr(zone) != data.text(0x00080201, data.root()))
    return Error{"RadiopharmaceuticalStartDateTime (0018,1078) has a time zone of its own"};
  const std::string local = dateTime.substr(0, zone);
  const auto date = dateSeconds(local),
             time = timeSeconds(local.substr(std::min<std::size_t>(8, local.size())));
  double seconds = 0;
  if (date && time) {
    seconds = *scan - *date - *time;
  } else {
    const auto ofDay = timeSeconds(data.text(0x00181072, dose));
    if (!ofDay) return missing("RadiopharmaceuticalStartTime", 0x00181072);
    seconds = std::fmod(*scan, day) - *ofDay;
    if (seconds < 0) seconds += day;  // over midnight
  }
  if (seconds < 0) return Error{"its scan begins before the injection"};
  return seconds;
}

/// How much is left of the dose at the time that the values are corrected to.
Result<double> remainingDose(const DataSet& data, DataSet::Scope dose, const Series& series) {
  const auto total = positive(data, dose, "RadionuclideTotalDose", 0x00181074);
  if (!total) return total.error();
  const std::string correction = data.text(0x00541102, data.root());
  if (correction == "ADMIN") return *total;
  if (correction.empty()) return missing("DecayCorrection", 0x00541102);
  if (correction != "START") return Error{"DecayCorrection (0054,1102) is " + dicom::toUtf8(correction, {})};
  const auto halfLife = positive(data, dose, "RadionuclideHalfLife", 0x00181075);
  if (!halfLife) return halfLife.error();
  const auto seconds = decaySeconds(data, dose, series);
  if (!seconds) return seconds.error();
  return *total * std::exp2(-*seconds / *halfLife);
}

Result<double> factorOfBqml(const DataSet& data, const Series& series) {
  const auto corrected = data.values(0x00280051, data.root());
  for (const char* needed : {"ATTN", "DECY"})
    if (std::find(corrected.begin(), corrected.end(), needed) == corrected.end())
      return Error{std::string("CorrectedImage (0028,0051) does not name ") + needed};
  const auto weight = positive(data, data.root(), "PatientWeight", 0x00101030);
  if (!weight) return weight.error();
  const auto items = data.items(0x00540016, data.root());
  if (items.empty()) return missing("RadiopharmaceuticalInformationSequence", 0x00540016);
  const auto dose = remainingDose(data, items[0], series);
  if (!dose) return dose.error();
  return *weight * 1000 / *dose;
}

/// Counts of Philips come with a factor of their own.
Result<double> factorOfCounts(const DataSet& data) {
  constexpr std::uint32_t creator = 0x70530010, factor = 0x70531000;
  if (data.text(creator, data.root()) != "Philips PET Private Group")
    return Error{"Units (0054,1001) is CNTS"};
  return positive(data, data.root(), "the factor from counts to SUV", factor);
}

Result<double> factorOf(const DataSet& data, const Series& series) {
  const std::string units = data.text(0x00541001, data.root()), type = data.text(0x00541006, data.root());
  if (units.empty()) return missing("Units", 0x00541001);
  if (units == "BQML") return factorOfBqml(data, series);
  if (units == "CNTS") return factorOfCounts(data);
  if (units == "GML" && (type.empty() || type == "BW")) return 1.0;
  if (units == "GML") return Error{"SUVType (0054,1006) is " + dicom::toUtf8(type, {})};
  return Error{"Units (0054,1001) is " + dicom::toUtf8(units, {})};
}

Result<double> suvFactorHere(const Series& series) {
  const InspectedFile file = dicom::inspectFile(series.files[0]);
  const Result<double> factor = factorOf(dataOf(file), series);
  if (!factor) return Error{series.path + ": no SUV: " + factor.message() + "."};
  return factor;
}

}  // namespace

Result<double> suvFactor(const Series& series) {
  if (series.modality != "PT" || series.files.empty())
    return Error{series.path + ": no SUV: it is no PET series."};
  const CancelToken never;
  worker::Request request = worker::headersOf(series.files, never);
  worker::Failure failure{};
  const Result<double> factor = worker::isolated<suvFactorHere>(request, failure, series);
  if (failure != worker::Failure::none) return Error{series.path + ": no SUV: " + factor.message() + "."};
  return factor;
}

}  // namespace volumen
