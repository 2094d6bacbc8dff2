#include "io/dicom/pet_facts.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "io/dicom/frame_scopes.h"
#include "io/dicom/moments.h"
#include "io/dicom/separators.h"

namespace volumen::dicom {
namespace {

/// Returns the scopes to search: the data set, then the attributes that a conversion could not assign, of all
/// frames and of the first.
std::vector<DataSet::Scope> scopesOf(const DataSet& data) {
  constexpr std::uint32_t unassignedShared = 0x00209170, unassignedPerFrame = 0x00209171;
  std::vector<DataSet::Scope> scopes{data.root()};
  for (const auto& [groups, unassigned] : {std::pair(FrameScopes::sharedGroups, unassignedShared),
                                           std::pair(FrameScopes::perFrameGroups, unassignedPerFrame)})
    if (const auto frames = data.items(groups, data.root()); !frames.empty())
      if (const auto items = data.items(unassigned, frames[0]); !items.empty()) scopes.push_back(items[0]);
  return scopes;
}

/// Returns the first value that is not empty, as plain text.
std::string firstText(const DataSet& data, const std::vector<DataSet::Scope>& scopes, std::uint32_t tag) {
  for (const DataSet::Scope scope : scopes)
    if (std::string text = plain(data.text(tag, scope)); !text.empty()) return text;
  return {};
}

std::string privateText(const DataSet& data, const std::vector<DataSet::Scope>& scopes, std::uint32_t group,
                        const char* creator, std::uint32_t element) {
  for (const DataSet::Scope scope : scopes)
    if (const auto tag = data.privateTag(group, creator, element, scope))
      if (std::string text = plain(data.text(tag, scope)); !text.empty()) return text;
  return {};
}

/// Returns the first defined term that is not empty, as plain text.
std::string firstTerm(const DataSet& data, const std::vector<DataSet::Scope>& scopes, std::uint32_t tag,
                      const char* name, std::initializer_list<const char*> terms) {
  for (const DataSet::Scope scope : scopes)
    if (std::string text = plain(data.term(tag, scope, name, terms)); !text.empty()) return text;
  return {};
}

/// Returns the acquisition time of the earliest frame, DT.
std::string earliestFrame(const DataSet& data) {
  constexpr std::uint32_t frameAcquisitionDateTime = 0x00189074;
  std::string earliest;
  for (const DataSet::Scope frame : data.items(FrameScopes::perFrameGroups, data.root()))
    for (const DataSet::Scope content : data.items(frameContentGroup, frame))
      if (const std::string at = data.text(frameAcquisitionDateTime, content); !at.empty())
        earliest = earliest.empty() ? at : std::min(earliest, at);
  return plain(earliest);
}

/// Reads the attributes of the tracer.
void readInjection(const DataSet& data, const std::vector<DataSet::Scope>& scopes, PetFacts& facts) {
  constexpr std::uint32_t tracers = 0x00540016;
  for (const DataSet::Scope scope : scopes) {
    const auto items = data.items(tracers, scope);
    if (items.empty()) continue;
    facts.injections = int(std::min<std::size_t>(items.size(), 1000));
    for (const auto& [field, tag] :
         {std::pair(&facts.dose, 0x00181074u), std::pair(&facts.halfLife, 0x00181075u),
          std::pair(&facts.injectionDateTime, 0x00181078u), std::pair(&facts.injectionTime, 0x00181072u)})
      *field = plain(data.text(tag, items[0]));
    return;
  }
}

/// Classic PET names its corrections in one attribute, enhanced PET has one for each.
void readCorrections(const DataSet& data, const std::vector<DataSet::Scope>& scopes, PetFacts& facts) {
  constexpr std::uint32_t correctedImage = 0x00280051, attenuation = 0x00189759, decay = 0x00189758;
  std::vector<std::string> corrected;
  for (const DataSet::Scope scope : scopes)
    if (corrected.empty()) corrected = data.values(correctedImage, scope);
  const auto isDone = [&](const char* name, std::uint32_t tag) {
    return std::ranges::find(corrected, name) != corrected.end() || data.text(tag, data.root()) == "YES";
  };
  facts.attenuationCorrected = isDone("ATTN", attenuation);
  facts.decayCorrected = isDone("DECY", decay);
}

}  // namespace

std::string plain(std::string text) {
  text.resize(std::min<std::size_t>(text.size(), 64));
  for (char& c : text)
    if (c < ' ' || c > '~' || c == '<' || c == '>' || c == '&') c = '?';
  return text;
}

PetFacts readPetFacts(const DataSet& data) {
  const std::vector<DataSet::Scope> scopes = scopesOf(data);
  PetFacts facts;
  for (const auto& [field, tag] :
       {std::pair(&facts.suvType, 0x00541006u), std::pair(&facts.weight, 0x00101030u),
        std::pair(&facts.size, 0x00101020u), std::pair(&facts.zone, 0x00080201u),
        std::pair(&facts.decayedTo, 0x00189701u), std::pair(&facts.seriesDate, 0x00080021u),
        std::pair(&facts.seriesTime, 0x00080031u), std::pair(&facts.acquisitionDate, 0x00080022u),
        std::pair(&facts.acquisitionTime, 0x00080032u)})
    *field = firstText(data, scopes, tag);
  facts.units = firstTerm(data, scopes, 0x00541001, "Units", {"BQML", "GML", "CM2ML", "CNTS"});
  facts.decayCorrection = firstTerm(data, scopes, 0x00541102, "DecayCorrection", {"START", "ADMIN", "NONE"});
  facts.isEnhanced = FrameScopes::isEnhanced(data) && facts.decayCorrection.empty();
  if (facts.acquisitionDate.empty() && facts.acquisitionTime.empty()) {
    std::string text = firstText(data, scopes, 0x0008002a);
    if (text.empty()) text = earliestFrame(data);
    const DateTime acquired = partsOf(text);
    facts.acquisitionDate = acquired.date, facts.acquisitionTime = acquired.time;
  }
  readInjection(data, scopes, facts);
  readCorrections(data, scopes, facts);
  facts.geScanStart = privateText(data, scopes, 0x0009, "GEMS_PETD_01", 0x0d);
  facts.philipsSuvFactor = privateText(data, scopes, 0x7053, "Philips PET Private Group", 0x00);
  facts.philipsBqFactor = privateText(data, scopes, 0x7053, "Philips PET Private Group", 0x09);
  return facts;
}

bool isOneFactor(double a, double b) {
  constexpr double rounding = 1e-4;
  return a > 0 && b > 0 && std::abs(a - b) <= rounding * a;
}

std::string suvTypeOfCode(const std::string& code) {
  const auto has = [&](const char* what) { return code.find(what) != std::string::npos; };
  if (has("SUVbw")) return "BW";
  if (has("SUVbsa")) return "BSA";
  if (!has("SUVlbm")) return {};
  return has("James") ? "LBMJAMES128" : has("Janma") ? "LBMJANMA" : "LBM";
}

}  // namespace volumen::dicom
