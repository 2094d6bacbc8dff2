#include "io/dicom/suv.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "io/dicom/header.h"
#include "io/dicom/moments.h"
#include "io/dicom/pet_facts.h"
#include "io/study/series.h"

namespace volumen::dicom {
namespace {

constexpr std::uint32_t tagUnits = 0x00541001, tagSuvType = 0x00541006, tagDecayCorrection = 0x00541102,
                        tagWeight = 0x00101030, tagSize = 0x00101020, tagSex = 0x00100040,
                        tagTracer = 0x00540016, tagDose = 0x00181074, tagHalfLife = 0x00181075,
                        tagInjectionDateTime = 0x00181078, tagInjectionTime = 0x00181072,
                        tagCorrected = 0x00280051, tagSeriesDate = 0x00080021, tagSeriesTime = 0x00080031,
                        tagDecayedTo = 0x00189701, tagAttenuation = 0x00189759, tagDecay = 0x00189758;

Error missing(const char* name, std::uint32_t tag) {
  return Error{std::string(name) + " " + tagText(tag) + " is missing"};
}

Error wrong(const char* name, std::uint32_t tag, const std::string& value) {
  return Error{std::string(name) + " " + tagText(tag) + " is " + value};
}

/// Parses a number between `least` and `most`, above 0. A value of 0 counts as missing.
Result<double> positive(const std::string& text, const char* name, std::uint32_t tag, const char* unit,
                        double least, double most) {
  const auto value = parseNumber(text);
  if (text.empty() || value == 0.0) return missing(name, tag);
  if (!value || *value < least || *value > most) return wrong(name, tag, text + unit);
  return *value;
}

/// Returns the start of the scan, to which values are corrected. It is the series time unless that is after
/// the first picture, as in derived series. Else it is GE's private time, else the time of the first picture.
Result<double> scanStart(const PetFacts& facts, const std::optional<double>& earliest) {
  const auto ofSeries = moment(facts.seriesDate, facts.seriesTime);
  if (ofSeries && (!earliest || *ofSeries <= *earliest)) return *ofSeries;
  const DateTime ge = partsOf(facts.geScanStart);
  if (const auto began = moment(ge.date, ge.time)) return *began;
  if (earliest) return *earliest;
  if (facts.seriesTime.empty()) return missing("SeriesTime", tagSeriesTime);
  if (!timeSeconds(facts.seriesTime)) return wrong("SeriesTime", tagSeriesTime, facts.seriesTime);
  if (facts.seriesDate.empty()) return missing("SeriesDate", tagSeriesDate);
  return wrong("SeriesDate", tagSeriesDate, facts.seriesDate);
}

/// Returns the seconds from an injection of unknown day to the scan start. Midnight may lie between them.
Result<double> secondsOfDay(const PetFacts& facts, double scan) {
  constexpr double day = 86400;
  if (facts.injectionTime.empty()) return missing("RadiopharmaceuticalStartTime", tagInjectionTime);
  const auto ofDay = timeSeconds(facts.injectionTime);
  if (!ofDay) return wrong("RadiopharmaceuticalStartTime", tagInjectionTime, facts.injectionTime);
  const double seconds = std::fmod(scan, day) - *ofDay;
  return seconds < -day / 2 ? seconds + day : seconds;
}

/// Returns the moment to which values are decay corrected, with its time zone.
Result<double> correctedTo(const PetFacts& facts, const std::optional<double>& earliest, std::string& zone) {
  zone = facts.zone;
  if (!facts.decayCorrection.empty()) return scanStart(facts, earliest);
  const DateTime said = partsOf(facts.decayedTo);
  const auto at = moment(said.date, said.time);
  if (!at) return wrong("DecayCorrectionDateTime", tagDecayedTo, facts.decayedTo);
  if (!said.zone.empty()) zone = said.zone;
  return *at;
}

/// Returns the seconds from the injection to the moment of decay correction.
Result<double> decaySeconds(const PetFacts& facts, const std::optional<double>& earliest) {
  std::string zone;
  const Result<double> scan = correctedTo(facts, earliest, zone);
  if (!scan) return scan.error();
  const DateTime injection = partsOf(facts.injectionDateTime);
  const auto injected = moment(injection.date, injection.time);
  double seconds = 0;
  if (injected) {
    seconds = *scan - *injected;
    if (!injection.zone.empty() && injection.zone != zone) {
      const auto there = zoneSeconds(injection.zone), here = zoneSeconds(zone);
      if (!there || !here)
        return Error{"RadiopharmaceuticalStartDateTime (0018,1078) has a time zone of its own"};
      seconds += *there - *here;
    }
  } else {
    const Result<double> found = secondsOfDay(facts, *scan);
    if (!found) return found.error();
    seconds = *found;
  }
  if (seconds < 0) return Error{"its scan begins before the injection"};
  return seconds;
}

/// Returns the dose remaining at the moment of decay correction, Bq.
Result<double> remainingDose(const PetFacts& facts, const std::optional<double>& earliest) {
  constexpr double leastBq = 1e5, mostBq = 1e12;  // a lower number was given in MBq
  constexpr double mostHalfLives = 20;            // leaves a millionth, so one of the two is in another unit
  if (facts.injections == 0) return missing("RadiopharmaceuticalInformationSequence", tagTracer);
  if (facts.injections > 1)
    return wrong("RadiopharmaceuticalInformationSequence", tagTracer,
                 "of " + std::to_string(facts.injections) + " injections");
  const auto total = positive(facts.dose, "RadionuclideTotalDose", tagDose, " Bq", leastBq, mostBq);
  if (!total) return total.error();
  if (facts.decayCorrection == "ADMIN") return *total;
  const bool isSaid = !facts.decayCorrection.empty() || !facts.decayedTo.empty();
  if (!isSaid && facts.isEnhanced) return missing("DecayCorrectionDateTime", tagDecayedTo);
  if (!isSaid) return missing("DecayCorrection", tagDecayCorrection);
  if (!facts.decayCorrection.empty() && facts.decayCorrection != "START")
    return wrong("DecayCorrection", tagDecayCorrection, facts.decayCorrection);
  const auto halfLife = positive(facts.halfLife, "RadionuclideHalfLife", tagHalfLife, " s", 1, 1e10);
  if (!halfLife) return halfLife.error();
  const auto seconds = decaySeconds(facts, earliest);
  if (!seconds) return seconds.error();
  if (*seconds > mostHalfLives * *halfLife)
    return Error{"its scan begins " + std::to_string(std::llround(*seconds / *halfLife)) +
                 " half-lives after the injection"};
  return *total * std::exp2(-*seconds / *halfLife);
}

/// Returns the lean body mass in kg (from kg and m) by James (1976), DICOM's LBMJAMES128, or by Janmahasatian
/// et al. (2005).
Result<double> leanMass(const std::string& sex, double weight, double size, bool james) {
  const bool female = sex == "F";
  if (sex.empty()) return missing("PatientSex", tagSex);
  if (!female && sex != "M") return wrong("PatientSex", tagSex, plain(sex));
  const double index = weight / (size * size);
  const double lean = !james   ? 9270 * weight / (female ? 8780 + 244 * index : 6680 + 216 * index)
                      : female ? 1.07 * weight - 148e-4 * weight * index
                               : 1.10 * weight - 128e-4 * weight * index;
  if (!(lean > 0)) return Error{"the lean body mass of this weight and size is not defined"};
  return lean;
}

enum Kind : std::size_t { bodyWeight, leanBodyMass, bodySurface, kinds };

/// The divisors of the uptake for each Kind: g, g, cm^2, or why one is unknown.
using Norms = std::vector<Result<double>>;

Norms normsOf(const PetFacts& facts, const std::string& sex, bool james) {
  const auto weight = positive(facts.weight, "PatientWeight", tagWeight, " kg", 0.001, 700);
  const auto size = positive(facts.size, "PatientSize", tagSize, " m", 0.05, 2.8);
  if (!weight) return Norms(kinds, weight);
  if (!size) return {*weight * 1000, size.error(), size.error()};
  const auto lean = leanMass(sex, *weight, *size, james);
  // Du Bois and Du Bois (1916): m^2 of kg and cm.
  const double surface = 0.007184 * std::pow(*weight, 0.425) * std::pow(*size * 100, 0.725);
  return {*weight * 1000, lean ? Result<double>(*lean * 1000) : lean, surface * 1e4};
}

/// The unit that values reach by multiplication with `factor`.
struct Known {
  std::optional<Kind> kind;  ///< empty: Bq/ml for each Bq of the remaining dose
  double factor = 1;
  bool james = true;     ///< formula of the lean body mass
  std::string unstated;  ///< why the kind cannot be converted to others
};

Result<Known> knownOfDose(const PetFacts& facts, double toBqml, const std::optional<double>& earliest) {
  const auto dose = remainingDose(facts, earliest);
  if (!dose) return dose.error();
  return Known{{}, toBqml / *dose, true, {}};
}

/// Uses the factors that Philips gives for counts.
Result<Known> knownOfCounts(const PetFacts& facts, const std::optional<double>& earliest) {
  if (facts.decayCorrection == "NONE")
    return wrong("DecayCorrection", tagDecayCorrection, facts.decayCorrection);
  const auto suv = parseNumber(facts.philipsSuvFactor), bq = parseNumber(facts.philipsBqFactor);
  if (suv && *suv > 0) return Known{bodyWeight, *suv, true, {}};
  if (bq && *bq > 0) return knownOfDose(facts, *bq, earliest);
  return wrong("Units", tagUnits, "CNTS");
}

/// Handles values that are already an SUV.
Result<Known> knownOfSuv(const PetFacts& facts) {
  const std::string& type = facts.suvType;
  if (facts.units == "CM2ML" && (type.empty() || type == "BSA")) return Known{bodySurface, 1, true, {}};
  const bool grams = facts.units == "GML";
  if (grams && (type.empty() || type == "BW")) return Known{bodyWeight, 1, true, {}};
  if (!grams || !type.starts_with("LBM")) return wrong("SUVType", tagSuvType, type);
  const bool stated = type == "LBMJAMES128" || type == "LBMJANMA";
  const std::string why = wrong("SUVType", tagSuvType, type).message;
  return Known{leanBodyMass, 1, type != "LBMJANMA", stated ? std::string() : why};
}

/// Returns an Error if values are not corrected for attenuation and decay.
Status corrections(const PetFacts& facts) {
  struct Correction {
    bool done;
    const char *term, *attribute;
    std::uint32_t tag;
  };
  for (const Correction& c :
       {Correction{facts.attenuationCorrected, "ATTN", "AttenuationCorrected", tagAttenuation},
        Correction{facts.decayCorrected, "DECY", "DecayCorrected", tagDecay}})
    if (!c.done)
      return facts.isEnhanced ? Error{std::string(c.attribute) + " " + tagText(c.tag) + " is not YES"}
                              : Error{"CorrectedImage " + tagText(tagCorrected) + " does not name " + c.term};
  return {};
}

Result<Known> knownOfUnits(const PetFacts& facts, const std::optional<double>& earliest) {
  if (facts.units.empty() && facts.isEnhanced)
    return Error{"no Real World Value Mapping gives the unit of its values"};
  if (facts.units.empty()) return missing("Units", tagUnits);
  if (facts.units == "GML" || facts.units == "CM2ML") return knownOfSuv(facts);
  if (facts.units != "BQML" && facts.units != "CNTS") return wrong("Units", tagUnits, facts.units);
  if (Status s = corrections(facts); !s) return s.error();
  return facts.units == "BQML" ? knownOfDose(facts, 1, earliest) : knownOfCounts(facts, earliest);
}

/// Uses a mapping of the file to an SUV.
Result<Known> knownOfMapping(const PetFacts& facts) {
  PetFacts mapped = facts;
  mapped.units = facts.mappedType == "BSA" ? "CM2ML" : "GML";
  mapped.suvType = facts.mappedType;
  auto known = knownOfSuv(mapped);
  if (known) known->factor = facts.mappedFactor;
  return known;
}

/// Returns the factors to each SUV. A wrong weight is reported before all else.
SuvFactors factorsBy(const Result<Known>& known, const PetFacts& facts, const std::string& sex) {
  SuvFactors out;
  if (!known) {
    out.why = known.message();
    return out;
  }
  Norms norms = normsOf(facts, sex, known->james);
  if (known->kind && !known->unstated.empty()) norms[*known->kind] = Error{known->unstated};
  std::optional<double>* const to[] = {&out.bodyWeight, &out.leanBodyMass, &out.bodySurface};
  const auto without = [&](const Result<double>& norm) {
    if (out.why.empty()) out.why = norm.message();
  };
  for (std::size_t n = 0; n < kinds; ++n) {
    const Result<double> from = known->kind ? norms[*known->kind] : Result<double>(1.0);
    if (known->kind == n)
      *to[n] = known->factor;
    else if (!from)
      without(from);
    else if (!norms[n])
      without(norms[n]);
    else
      *to[n] = known->factor * *norms[n] / *from;
  }
  return out;
}

/// Returns the factors from units, dose and times, else from a mapping of the file to an SUV.
SuvFactors factorsOf(const PetFacts& facts, const std::string& sex, const std::optional<double>& earliest) {
  const SuvFactors out = factorsBy(knownOfUnits(facts, earliest), facts, sex);
  if (out.bodyWeight || !(facts.mappedFactor > 0 && std::isfinite(facts.mappedFactor))) return out;
  const SuvFactors mapped = factorsBy(knownOfMapping(facts), facts, sex);
  return mapped.bodyWeight || mapped.leanBodyMass || mapped.bodySurface ? mapped : out;
}

/// Returns the key of a series. It has three parts, as patients and studies may share a UID by mistake.
std::array<std::string, 3> seriesOf(const SeriesIdentity& s) {
  return {s.patientId, s.studyUid, s.seriesUid};
}

/// Returns the facts that all files of a volume share, in one spelling.
PetFacts withoutPlace(PetFacts facts) {
  facts.acquisitionDate.clear(), facts.acquisitionTime.clear();
  facts.mappedFactor = 0;  // rounded in each file
  for (std::string* number : {&facts.weight, &facts.size, &facts.dose, &facts.halfLife,
                              &facts.philipsSuvFactor, &facts.philipsBqFactor})
    *number = numberAsOne(*number);
  for (std::string* time : {&facts.injectionTime, &facts.seriesTime}) *time = timeAsOne(*time);
  for (std::string* moment : {&facts.injectionDateTime, &facts.geScanStart, &facts.decayedTo})
    *moment = momentAsOne(*moment);
  facts.seriesDate = dateOrTime(facts.seriesDate);
  return facts;
}

}  // namespace

void addSuvFactors(std::span<const FileHeader> files, std::vector<Series>& volumes) {
  std::map<std::string, const FileHeader*> byPath;
  std::map<std::array<std::string, 3>, std::optional<double>> earliest;  // empty if one gives no time
  for (const FileHeader& file : files) {
    if (!file.pet) continue;
    byPath[file.path] = &file;
    const auto acquired = moment(file.pet->acquisitionDate, file.pet->acquisitionTime);
    const auto [known, isNew] = earliest.emplace(seriesOf(file), acquired);
    if (!isNew) known->second = std::min(known->second, acquired);
  }
  for (Series& volume : volumes) {
    const auto first = volume.files.empty() ? byPath.end() : byPath.find(volume.files[0]);
    if (first == byPath.end()) continue;
    const FileHeader& file = *first->second;
    const PetFacts facts = withoutPlace(*file.pet);
    const bool alike = std::ranges::all_of(volume.files, [&](const std::string& path) {
      const auto other = byPath.find(path);
      return other != byPath.end() && withoutPlace(*other->second->pet) == facts;
    });
    if (!alike) {
      volume.suv.why = "its files differ in units, weight, dose or times";
      continue;
    }
    PetFacts used = *file.pet;
    for (const std::string& path : volume.files)
      if (!isOneFactor(byPath.at(path)->pet->mappedFactor, used.mappedFactor)) used.mappedFactor = 0;
    volume.suv = factorsOf(used, file.patientSex, earliest.at(seriesOf(file)));
  }
}

}  // namespace volumen::dicom
