#include "io/dicom/units.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "io/dicom/greys.h"
#include "io/dicom/slice_place.h"

namespace volumen::dicom {
namespace {

constexpr std::uint32_t rescaleType = 0x00281054, doseUnits = 0x30040002, doseGridScaling = 0x3004000e,
                        measurementUnits = 0x004008ea, modalityLutSequence = 0x00283000,
                        realWorldValueMapping = 0x00409096;

using Names = std::pair<std::string_view, const char*>;

template <std::size_t n>
std::string nameIn(const Names (&names)[n], const std::string& code) {
  const auto it = std::ranges::find(names, std::string_view(code), &Names::first);
  return it == std::end(names) ? code : it->second;
}

// PS3.3 C.8.9.1.1.3. Numbers in CNTS, NONE and PROPCNTS are only comparable with each other.
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

/// Returns the UCUM code of a mapping's unit; empty if it is of another scheme or missing.
std::string codeOfMapping(const DataSet& data, DataSet::Scope mapping) {
  const auto codes = data.items(measurementUnits, mapping);
  if (codes.empty()) return {};
  const std::string scheme = data.text(0x00080102, codes[0]);
  return scheme.empty() || scheme == "UCUM" ? data.utf8(0x00080100, codes[0]) : std::string();
}

/// Returns the unit of a real world value mapping: its UCUM code, its usual name ("HU", "SUV"), or the
/// meaning of another code. Empty for numbers without unit.
std::string unitOfMapping(const DataSet& data, DataSet::Scope mapping) {
  const std::string code = codeOfMapping(data, mapping);
  const auto codes = data.items(measurementUnits, mapping);
  if (code.empty()) return codes.empty() ? std::string() : data.utf8(0x00080104, codes[0]);
  if (code == "[hnsf'U]") return "HU";
  if (code.find("{SUV") != std::string::npos) return "SUV";
  return code == "1" || code.starts_with('{') ? std::string() : code;
}

/// Returns the unit of a frame's values after the file's rescale; empty if not given.
std::string unitOfRescaled(const DataSet& data, const FrameScopes& at, const Slice& slice,
                           FileHeader& header) {
  if (data.has(modalityLutSequence, data.root())) return {};  // these are the values before the Modality LUT
  if (data.has(doseUnits, data.root())) return unitOfDose(data, header);
  const DataSet::Scope rescale = at.of(pixelValueTransformation);
  const std::string known = data.term(rescaleType, rescale, "RescaleType", {"HU"}),
                    type = known == "HU" ? known : data.utf8(rescaleType, rescale);
  if (header.pet && !header.pet->units.empty()) return unitOfPet(header.pet->units);
  // A rescaled CT is in HU unless it says otherwise (PS3.3 C.11.1.1.2).
  if (header.modality == "CT" && type.empty()) return slice.isRescaled ? "HU" : "";
  return unitOfRescaleType(type);
}

/// Tells that grey values have no rescale: those of a CT have no unit then, others keep the one they state.
void tellMissingRescale(const Slice& slice, FileHeader& header) {
  if (!header.format.isGrey()) return;
  if (!slice.unit.empty() && header.format.kind == PixelFormat::Kind::integer)
    warnOnce(header, "its RescaleSlope and RescaleIntercept are missing: 1 and 0 are taken");
  else if (slice.unit.empty() && header.modality == "CT")
    warnOnce(header, "it gives no rescale (RescaleSlope): its values are the stored ones, without unit");
}

/// The values of a real world value mapping (PS3.3 C.7.6.16.2.11).
struct RealWorldValues {
  double slope = 1, intercept = 0;
  std::string unit;
};

/// Returns whether a mapping is valid for all values of the stored bits. A mapping without a range is.
bool coversAll(const DataSet& data, DataSet::Scope mapping, const PixelFormat& format) {
  const auto stored = [&](std::uint32_t tag) -> std::optional<double> {
    const auto word = data.word(tag, mapping);
    if (!word) return {};
    return format.isSigned ? double(std::int16_t(*word)) : double(*word);
  };
  auto first = data.real(0x00409214, mapping), last = data.real(0x00409213, mapping);
  if (!first) first = stored(0x00409216);
  if (!last) last = stored(0x00409211);
  if (!first || !last) return true;
  if (format.kind != PixelFormat::Kind::integer) return false;
  const double count = std::exp2(format.bitsStored), lowest = format.isSigned ? -count / 2 : 0;
  return *first <= lowest && *last >= lowest + count - 1;
}

/// Returns the linear mapping of an item, if it has one.
std::optional<RealWorldValues> linearMapping(const DataSet& data, DataSet::Scope mapping) {
  const auto slope = data.real(0x00409225, mapping), intercept = data.real(0x00409224, mapping);
  constexpr double largest = 1e30;
  if (!slope || !intercept || *slope == 0) return {};
  if (!(std::abs(*slope) <= largest) || !(std::abs(*intercept) <= largest)) return {};
  return RealWorldValues{*slope, *intercept, unitOfMapping(data, mapping)};
}

/// Returns the first linear mapping that is valid for all stored values.
std::optional<RealWorldValues> readRealWorldValues(const DataSet& data, const FrameScopes& at,
                                                   const PixelFormat& format) {
  for (const DataSet::Scope item : at.itemsOf(realWorldValueMapping, data))
    if (const auto values = linearMapping(data, item); values && coversAll(data, item, format)) return values;
  return {};
}

/// Reads the factor from the values of a PET slice to the SUV of its first such mapping; 0 if slices differ.
void readSuvMapping(const DataSet& data, const std::vector<DataSet::Scope>& items, const Slice& slice,
                    FileHeader& header) {
  constexpr double rounding = 1e-3;  // fraction of a stored value
  PetFacts& pet = *header.pet;
  std::string type = "none";
  double factor = 0;
  for (const DataSet::Scope item : items) {
    const auto values = linearMapping(data, item);
    const std::string found = suvTypeOfCode(codeOfMapping(data, item));
    if (!values || found.empty() || !coversAll(data, item, header.format)) continue;
    type = found, factor = values->slope / slice.slope;
    const double off = values->intercept - factor * slice.intercept;
    if (std::abs(off) > rounding * std::abs(values->slope)) factor = 0;
    break;
  }
  if (pet.mappedType.empty())
    pet.mappedType = type, pet.mappedFactor = factor;
  else if (type != pet.mappedType || !isOneFactor(factor, pet.mappedFactor))
    pet.mappedFactor = 0;
}

}  // namespace

std::string unitOfRescaleType(const std::string& type) {
  static constexpr Names names[] = {{"US", ""},         {"UNSPECIFIED", ""}, {"NONE", ""}, {"NORMALIZED", ""},
                                    {"normalized", ""}, {"1", ""},           {"PCT", "%"}, {"MGML", "mg/ml"},
                                    {"OD", "OD/1000"},  {"BQML", "Bq/ml"}};
  return nameIn(names, type);
}

void readMeaning(const DataSet& data, const FrameScopes& at, Slice& slice, FileHeader& header) {
  const auto mapping = readRealWorldValues(data, at, header.format);
  const auto items = at.itemsOf(realWorldValueMapping, data);
  const auto isLinear = [&](DataSet::Scope item) { return linearMapping(data, item).has_value(); };
  const auto isTable = [&](DataSet::Scope item) { return data.has(0x00409212, item); };
  const DataSet::Scope rescale = at.of(pixelValueTransformation);
  slice.unit = unitOfRescaled(data, at, slice, header);
  if (data.has(0x00281053, rescale) || data.has(0x3004000e, rescale) ||
      data.has(modalityLutSequence, data.root())) {
    const bool same = mapping && mapping->slope == slice.slope && mapping->intercept == slice.intercept;
    if (same && slice.unit.empty()) slice.unit = mapping->unit;
  } else if (mapping) {
    slice.slope = mapping->slope, slice.intercept = mapping->intercept;
    slice.unit = mapping->unit;
    slice.isMapped = slice.slope != 1 || slice.intercept != 0;
    if (slice.isMapped) warnOnce(header, "its " + realWorldSentence);
  } else if (std::ranges::any_of(items, isLinear)) {
    warnOnce(header,
             "its Real World Value Mapping is not valid for all stored values and is not applied: values are "
             "the stored ones");
  } else if (std::ranges::any_of(items, isTable)) {
    warnOnce(header, "its Real World Value Mapping is a table and is not applied");
  } else {
    tellMissingRescale(slice, header);
  }
  if (header.pet) readSuvMapping(data, items, slice, header);
}

}  // namespace volumen::dicom
