#include "io/dicom/units.h"

#include <algorithm>
#include <utility>

#include "io/dicom/slice_place.h"

namespace volumen::dicom {
namespace {

constexpr std::uint32_t rescaleType = 0x00281054, doseUnits = 0x30040002, doseGridScaling = 0x3004000e;

using Names = std::pair<std::string_view, const char*>;

template <std::size_t n>
std::string nameIn(const Names (&names)[n], const std::string& code) {
  const auto it = std::ranges::find(names, std::string_view(code), &Names::first);
  return it == std::end(names) ? code : it->second;
}

// PS3.3 C.8.9.1.1.3; of CNTS, NONE and PROPCNTS numbers are only comparable with each other.
std::string unitOfPet(const std::string& units) {
  static constexpr Names names[] = {{"BQML", "Bq/ml"},
                                    {"GML", "SUV"},
                                    {"CM2ML", "SUV"},
                                    {"CNTS", ""},
                                    {"NONE", ""},
                                    {"PROPCNTS", ""},
                                    {"CPS", "counts/s"},
                                    {"PROPCPS", "counts/s"},
                                    {"CM2", "cm2"},
                                    {"PCNT", "%"},
                                    {"MGMINML", "mg/min/ml"},
                                    {"UMOLMINML", "umol/min/ml"},
                                    {"MLMING", "ml/min/g"},
                                    {"MLG", "ml/g"},
                                    {"1CM", "1/cm"},
                                    {"UMOLML", "umol/ml"},
                                    {"MLMINML", "ml/min/ml"},
                                    {"MLML", "ml/ml"},
                                    {"STDDEV", "SD"}};
  return nameIn(names, units);
}

std::string unitOfDose(const DataSet& data, FileHeader& header) {
  const std::string units = data.utf8(doseUnits, data.root());
  if (!data.has(doseGridScaling, data.root())) return {};
  if (units == "GY") return "Gy";
  if (units != "RELATIVE") return units;
  warnOnce(header, "its doses are relative to a value that it does not give (DoseUnits RELATIVE)");
  return "relative";
}

}  // namespace

std::string unitOfRescaleType(const std::string& type) {
  static constexpr Names names[] = {{"US", ""},         {"UNSPECIFIED", ""}, {"NONE", ""}, {"NORMALIZED", ""},
                                    {"normalized", ""}, {"1", ""},           {"PCT", "%"}, {"MGML", "mg/ml"},
                                    {"OD", "OD/1000"},  {"BQML", "Bq/ml"}};
  return nameIn(names, type);
}

std::string unitOfMapping(const DataSet& data, DataSet::Scope mapping) {
  const auto codes = data.items(0x004008ea, mapping);
  if (codes.empty()) return {};
  const std::string scheme = data.text(0x00080102, codes[0]), code = data.utf8(0x00080100, codes[0]);
  if (!scheme.empty() && scheme != "UCUM") return data.utf8(0x00080104, codes[0]);
  if (code == "[hnsf'U]") return "HU";
  if (code.find("{SUV") != std::string::npos) return "SUV";
  return code == "1" || code.starts_with('{') ? std::string() : code;
}

std::string unitOfRescaled(const DataSet& data, const FrameScopes& at, FileHeader& header) {
  if (data.has(0x00283000, data.root())) return {};  // a Modality LUT: these are the values before it
  if (data.has(doseUnits, data.root())) return unitOfDose(data, header);
  const std::string type = data.utf8(rescaleType, at.of(pixelValueTransformation)),
                    units = data.text(0x00541001, data.root());
  if (header.modality == "PT" && !units.empty()) return unitOfPet(units);
  // CT means HU where it does not say otherwise.
  return header.modality == "CT" && type.empty() ? "HU" : unitOfRescaleType(type);
}

}  // namespace volumen::dicom
