#include "io/deidentify/rewrite_data_set.h"

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dcdicent.h>
#include <dcmtk/dcmdata/dcdict.h>

#include <algorithm>
#include <map>
#include <optional>

#include "io/deidentify/dates.h"
#include "io/deidentify/descriptor_words.h"
#include "io/deidentify/identifying_texts.h"
#include "io/deidentify/safe_private.h"
#include "io/deidentify/statement.h"
#include "io/dicom/data_set.h"

namespace volumen {

namespace {

using dicom::DataSet;
using dicom::Element;
using dicom::Encoding;
using dicom::vrOf;

constexpr std::uint32_t imageType = 0x00080008, patientName = 0x00100010, patientId = 0x00100020,
                        studyId = 0x00200010, studyUid = 0x0020000d, contentSequence = 0x0040a730,
                        personCodes = 0x00401101;
constexpr std::uint16_t sequenceVr = vrOf('S', 'Q'), unknownVr = vrOf('U', 'N');
constexpr std::uint16_t codeVr = vrOf('C', 'S'), uidVr = vrOf('U', 'I');
constexpr const char* dummyText = "DEIDENTIFIED";

// Returns the VR of a standard attribute in DCMTK's dictionary; 0 if the attribute is unknown.
std::uint16_t vrInDictionary(std::uint32_t tag) {
  const DcmDataDictionary& dictionary = dcmDataDict.rdlock();
  const DcmDictEntry* entry =
      dictionary.findEntry(DcmTagKey(Uint16(tag >> 16), Uint16(tag & 0xffff)), nullptr);
  const char* const name = entry ? entry->getVR().getValidVRName() : nullptr;
  const std::uint16_t vr = name ? vrOf(name[0], name[1]) : std::uint16_t(0);
  dcmDataDict.rdunlock();
  return vr;
}

// Returns a dummy value without meaning (PS3.15 E.1.1, action D).
std::string dummyOf(std::uint16_t vr) {
  switch (vr) {
    case vrOf('D', 'A'):
      return "19000101";
    case vrOf('D', 'T'):
      return "19000101000000";
    case vrOf('T', 'M'):
      return "000000";
    case vrOf('A', 'S'):
      return "000Y";
    case vrOf('D', 'S'):
    case vrOf('I', 'S'):
      return "0";
    case vrOf('U', 'R'):
      return "urn:deidentified";
    case vrOf('O', 'B'):
    case vrOf('U', 'N'):
      return std::string(2, '\0');
    default:
      return dummyText;
  }
}

// Returns the ImageType of an image whose pixels were changed.
std::string derivedType(const std::string& type) {
  return type.empty() ? "DERIVED\\PRIMARY" : "DERIVED" + type.substr(std::min(type.find('\\'), type.size()));
}

bool isTextVr(std::uint16_t vr) {
  constexpr std::uint16_t texts[] = {vrOf('L', 'O'), vrOf('S', 'H'), vrOf('S', 'T'), vrOf('L', 'T'),
                                     vrOf('U', 'T'), vrOf('U', 'C'), vrOf('P', 'N'), vrOf('A', 'E'),
                                     vrOf('U', 'R'), vrOf('U', 'N')};
  return std::ranges::find(texts, vr) != std::end(texts);
}

// Returns true if programs need value `n` of a code to read the object: character set, kind of image,
// modality, photometric interpretation, kind of a content item.
bool isOfFormat(std::uint32_t tag, int n) {
  constexpr std::uint32_t codes[] = {0x00080005, 0x00080060, 0x00280004, 0x0040a010, 0x0040a040, 0x0040a050};
  return (tag == imageType && n < 2) || std::ranges::find(codes, tag) != std::end(codes);
}

bool isDateVr(std::uint16_t vr) { return vr == vrOf('D', 'A') || vr == vrOf('D', 'T'); }

class Rewrite {
 public:
  Rewrite(const ScannedDataSet& data, const Rewriting& how, const Pseudonyms& pseudonyms, FileParts& parts)
      : bytes_(data.bytes),
        elements_(data.elements),
        data_(data.bytes, data.elements),
        retained_(how.retained),
        isFaceless_(how.isFaceless),
        profile_(how.retained),
        pseudonyms_(pseudonyms),
        identifying_(data_, profile_),
        statement_(statementElements(how)),
        parts_(parts),
        isClassic_(isClassicImage(data_.text(0x00080016, data_.root()))) {}

  Status operator()(Encoding encoding) {
    addScope(data_.root(), encoding, {.isRoot = true});
    addStatementBefore(0xffffffff, encoding);
    return problem_;
  }

 private:
  struct Place {
    bool isRoot = false;
    bool isInContent = false;  // inside a content item of a structured report
  };

  void addScope(DataSet::Scope scope, Encoding encoding, Place place) {
    const auto privates =
        retained_.privates ? safePrivateElements(data_, scope) : std::map<std::uint32_t, std::uint16_t>();
    for (std::uint32_t n = scope.begin; n < scope.end; n = elements_[n].end) {
      const Element& e = elements_[n];
      if (place.isRoot) addStatementBefore(e.tag, encoding);
      const bool isPrivate = e.tag >> 16 & 1, isGroupLength = (e.tag & 0xffff) == 0;
      if (isGroupLength || (place.isRoot && isOfStatement(e.tag))) continue;
      if (isPrivate) {
        if (const auto safe = privates.find(n); safe != privates.end())
          addPrivate(e, safe->second, scope, encoding);
      } else {
        addElement(n, scope, encoding, place);
      }
    }
  }

  // Bytes whose VR the file does not say may be text.
  void addPrivate(const Element& e, std::uint16_t listed, DataSet::Scope scope, Encoding encoding) {
    const bool isCreator = (e.tag & 0xffff) <= 0xff;
    if (isCreator) return copy(e, encoding);
    const std::uint16_t vr = vrOfPrivate(e, listed);
    const bool isText = vr == codeVr || isTextVr(vr),
               isDecimal = vr == vrOf('D', 'S') || vr == vrOf('I', 'S');
    if (!isText && !isDecimal && vr != e.vr && identifying_.isIn(data_.utf8(e.tag, scope))) return;
    addValue(e, vr, scope, encoding, ProfileAction::keep);
  }

  void addElement(std::uint32_t n, DataSet::Scope scope, Encoding encoding, Place place) {
    const Element& e = elements_[n];
    const std::uint16_t known = vrInDictionary(e.tag), listed = profile_.vrOf(e.tag);
    if (known == 0 && listed == 0) return;
    const std::uint16_t vr = e.vr && e.vr != unknownVr ? e.vr : listed ? listed : known;
    const ProfileAction action = profile_.actionOf(e.tag, isClassic_ && place.isRoot, vr);
    // Overlays are removed. Their other attributes are invalid without their pixels.
    const bool isOverlay = e.tag >> 24 == 0x60;
    if (action == ProfileAction::remove || isOverlay) return;
    const bool isSequence = e.end > n + 1 || vr == sequenceVr || e.length == dicom::undefinedLength;
    // A sequence cannot be cleaned if its items were not scanned one by one.
    const bool isOpaque =
        e.end == n + 1 && e.length > 0 && e.length != dicom::undefinedLength && vr == sequenceVr;
    if (isOpaque) return;
    if (isSequence) return addSequence(n, encoding, action, place);
    if (place.isInContent && addedAsContent(e, vr, encoding)) return;
    addValue(e, vr, scope, encoding, action);
  }

  void addSequence(std::uint32_t n, Encoding encoding, ProfileAction action, Place place) {
    const Element& e = elements_[n];
    const std::uint16_t vr = e.vr == unknownVr ? unknownVr : sequenceVr;
    if (action == ProfileAction::empty || e.end == n + 1) return parts_.addHeader(encoding, e.tag, vr, 0);
    if (e.tag == personCodes) return addDummyCode(e.tag, vr, encoding);
    const Encoding inside = vr == unknownVr ? Encoding{false, false} : encoding;
    constexpr auto undefined = std::uint32_t(dicom::undefinedLength);
    parts_.addHeader(encoding, e.tag, vr, undefined);
    for (std::uint32_t item = n + 1; item < e.end; item = elements_[item].end) {
      parts_.addHeader(inside, dicom::itemTag, 0, undefined);
      const bool isContent = place.isInContent || e.tag == contentSequence;
      addScope({item + 1, elements_[item].end}, inside, {.isRoot = false, .isInContent = isContent});
      parts_.addHeader(inside, dicom::itemEndTag, 0, 0);
    }
    parts_.addHeader(inside, dicom::sequenceEndTag, 0, 0);
  }

  // The code of a person may be a number that identifies the person.
  void addDummyCode(std::uint32_t tag, std::uint16_t vr, Encoding encoding) {
    const Encoding inside = vr == unknownVr ? Encoding{false, false} : encoding;
    constexpr auto undefined = std::uint32_t(dicom::undefinedLength);
    parts_.addHeader(encoding, tag, vr, undefined);
    parts_.addHeader(inside, dicom::itemTag, 0, undefined);
    parts_.addElement(inside, 0x00080100, vrOf('S', 'H'), dummyText);
    parts_.addElement(inside, 0x00080102, vrOf('S', 'H'), "99VOLUMEN");
    parts_.addElement(inside, 0x00080104, vrOf('L', 'O'), dummyText);
    parts_.addHeader(inside, dicom::itemEndTag, 0, 0);
    parts_.addHeader(inside, dicom::sequenceEndTag, 0, 0);
  }

  // Texts of structured reports may hold names. Codes, numbers and references stay (option 113104).
  bool addedAsContent(const Element& e, std::uint16_t vr, Encoding encoding) {
    constexpr std::uint32_t textValue = 0x0040a160;
    if (e.tag != textValue || e.length == 0) return false;
    parts_.addElement(encoding, e.tag, vr, dummyText);
    return true;
  }

  void addValue(const Element& e, std::uint16_t vr, DataSet::Scope scope, Encoding encoding,
                ProfileAction action) {
    const bool isMoved = retained_.shiftDays != 0 && isDateVr(vr) && action == ProfileAction::keep;
    if (isFaceless_ && e.tag == imageType)
      return put(e, vr, encoding, derivedType(codesWithoutNames(e, scope)));
    if (e.length == 0) return copy(e, encoding);
    switch (isMoved ? ProfileAction::shift : action) {
      case ProfileAction::keep:
        if (vr == codeVr && identifying_.isIn(data_.utf8(e.tag, scope)))
          return put(e, vr, encoding, codesWithoutNames(e, scope));
        if (vr == vrOf('P', 'N') || (isTextVr(vr) && identifying_.isIn(data_.utf8(e.tag, scope))))
          return put(e, vr, encoding, dummyOf(vr));
        return copy(e, encoding);
      case ProfileAction::empty:
        return put(e, vr, encoding, pseudonymOf(e.tag));
      case ProfileAction::dummy: {
        if (vr == uidVr) return addNewUid(e, vr, scope, encoding);
        const std::string name = pseudonymOf(e.tag);
        return put(e, vr, encoding, !name.empty() ? name : dummyOf(vr));
      }
      case ProfileAction::newUid:
        return addNewUid(e, vr, scope, encoding);
      case ProfileAction::shift:
        return addShifted(e, vr, scope, encoding);
      case ProfileAction::clean:
        return put(e, vr, encoding, wordsOf(data_.utf8(e.tag, scope)));
      case ProfileAction::remove:
        return;
    }
  }

  void addNewUid(const Element& e, std::uint16_t vr, DataSet::Scope scope, Encoding encoding) {
    put(e, vr, encoding, each(e, scope, [&](const std::string& uid) { return pseudonyms_.uid(uid); }));
  }

  // Returns all values of a code. Those that hold a name are replaced by a dummy, and all of them are if they
  // spell a name only together. Values of the format stay.
  std::string codesWithoutNames(const Element& e, DataSet::Scope scope) const {
    const std::string characters = data_.text(0x00080005, data_.root());
    const auto hasName = [&](const std::string& text) {
      return identifying_.isIn(dicom::toUtf8(text, characters));
    };
    std::string left;  // of those that may go
    const auto without = [&](const auto& goes) {
      int n = 0;
      return each(e, scope, [&](const std::string& code) {
        if (isOfFormat(e.tag, n++)) return code;
        const std::string now = goes(code) ? std::string(dummyText) : code;
        left += "\\" + now;
        return now;
      });
    };
    const std::string codes = without(hasName);
    return hasName(left) ? without([](const std::string& code) { return !code.empty(); }) : codes;
  }

  std::string wordsOf(const std::string& description) const {
    const std::string words = knownWordsOf(description);
    return identifying_.isIn(words) ? std::string() : words;
  }

  void addShifted(const Element& e, std::uint16_t vr, DataSet::Scope scope, Encoding encoding) {
    if (!isDateVr(vr)) return copy(e, encoding);
    put(e, vr, encoding, each(e, scope, [&](const std::string& date) {
          return movedDate(date, retained_.shiftDays).value_or(std::string());
        }));
  }

  // Returns a pseudonym for the patient's name, the patient ID or the study ID, by which lists still tell
  // patients and studies apart. The result is empty for other attributes.
  std::string pseudonymOf(std::uint32_t tag) const {
    const auto text = [&](std::uint32_t of) { return data_.utf8(of, data_.root()); };
    if (tag == studyId) return pseudonyms_.name(text(studyUid));
    if (tag != patientName && tag != patientId) return {};
    const std::string id = text(patientId), name = text(patientName);
    return pseudonyms_.name(!id.empty() ? id : !name.empty() ? name : text(studyUid));
  }

  template <class Change>
  std::string each(const Element& e, DataSet::Scope scope, const Change& change) const {
    std::string all;
    const std::vector<std::string> values = data_.values(e.tag, scope);
    for (std::size_t n = 0; n < values.size(); ++n) all += (n ? "\\" : "") + change(values[n]);
    return all;
  }

  void put(const Element& e, std::uint16_t vr, Encoding encoding, const std::string& value) {
    constexpr std::size_t mostOfShort = 0xfffe;
    if (encoding.explicitVr && !dicom::hasLongLength(vr) && value.size() > mostOfShort)
      problem_ = Error{"the new value of " + dicom::tagText(e.tag) + " is too long"};
    else
      parts_.addElement(encoding, e.tag, vr, value);
  }

  // Copies an element together with its header.
  void copy(const Element& e, Encoding encoding) {
    const auto headerIs = [&](std::uint64_t size) {
      const std::uint64_t at = e.offset - size;
      const auto half = [&](std::uint64_t offset) {
        return std::uint32_t(dicom::numberAt<std::uint16_t>(bytes_, offset, encoding.bigEndian));
      };
      return e.offset >= size && (half(at) << 16 | half(at + 2)) == e.tag;
    };
    constexpr std::uint64_t shortHeader = 8, longHeader = 12;
    const bool isLong = encoding.explicitVr && (e.vr ? dicom::hasLongLength(e.vr) : !headerIs(shortHeader));
    const std::uint64_t header = isLong ? longHeader : shortHeader;
    parts_.copy(e.offset - header, header + e.length);
  }

  bool isOfStatement(std::uint32_t tag) const {
    return std::ranges::any_of(statement_, [&](const StatementElement& s) { return s.tag == tag; });
  }

  void addStatementBefore(std::uint32_t tag, Encoding encoding) {
    for (; stated_ < statement_.size() && statement_[stated_].tag < tag; ++stated_)
      addStatement(statement_[stated_], encoding, parts_);
  }

  const dicom::Bytes bytes_;
  const std::vector<Element>& elements_;
  const DataSet data_;
  const Retained& retained_;
  const bool isFaceless_;
  const ConfidentialityProfile profile_;
  const Pseudonyms& pseudonyms_;
  const IdentifyingTexts identifying_;
  const std::vector<StatementElement> statement_;
  std::size_t stated_ = 0;
  FileParts& parts_;
  const bool isClassic_;
  Status problem_;
};

}  // namespace

Status rewriteDataSet(const ScannedDataSet& data, const Rewriting& how, const Pseudonyms& pseudonyms,
                      FileParts& parts) {
  return Rewrite(data, how, pseudonyms, parts)(data.encoding);
}

}  // namespace volumen
