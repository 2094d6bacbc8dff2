#include "io/export/study_object.h"

#include <QDateTime>
#include <algorithm>
#include <charconv>
#include <map>
#include <set>

#include "io/dicom/data_set.h"
#include "io/export/dicom_uid.h"
#include "io/files/same_bytes.h"
#include "io/study/study.h"

namespace volumen {

namespace {

constexpr int highestNumber = 0x7fffffff;  // the largest value of VR IS

int seriesNumberOf(const SeriesIdentity& series) {
  int number = 0;
  const std::string& text = series.seriesNumber;
  std::from_chars(text.data(), text.data() + text.size(), number);
  return number;
}

// Returns the number above all others. If the highest is taken, returns the largest free one.
int freeNumber(const std::set<int>& taken) {
  int number = taken.empty() ? 0 : std::max(*taken.rbegin(), 0);
  if (number < highestNumber) return number + 1;
  while (taken.contains(number)) --number;
  return number;
}

Series onlySlices(const Series& series, std::span<const std::size_t> slices) {
  Series only;
  only.path = series.path;
  for (const std::size_t n : slices) {
    only.files.push_back(series.files.at(n));
    only.frames.push_back(series.frames.at(n));
  }
  return only;
}

ObjectTags datedNow(ObjectTags tags) {
  const QDateTime now = QDateTime::currentDateTime();
  if (tags.date.empty()) tags.date = now.toString(QStringLiteral("yyyyMMdd")).toStdString();
  if (tags.time.empty()) tags.time = now.toString(QStringLiteral("HHmmss")).toStdString();
  return tags;
}

// Converts the texts of elements from UTF-8 to a character set. Returns false if the set does not hold one
// of them.
bool convertTo(const std::string& characterSet, DicomElements& elements) {
  for (DicomElement& e : elements) {
    auto converted = dicom::fromUtf8(e.value, characterSet);
    if (!converted) return false;
    e.value = std::move(*converted);
  }
  return true;
}

}  // namespace

int nextSeriesNumber(const Study& study, const std::string& studyUid) {
  std::set<int> taken;
  const auto addAll = [&](const auto& all) {
    for (const SeriesIdentity& one : all)
      if (one.studyUid == studyUid) taken.insert(seriesNumberOf(one));
  };
  addAll(study.volumes);
  addAll(study.images);
  addAll(study.derived);
  return freeNumber(taken);
}

Error sameInstance(const std::string& a, const std::string& b) {
  return Error{
      a + " and " + b +
      " have the same SOPInstanceUID and are no copies of each other, so that a new object cannot tell "
      "them apart: leave one of them out."};
}

Status checkNames(const Series& series, std::span<const std::size_t> slices) {
  if (series.seriesUid.empty())
    return Error{series.files.front() +
                 " names no series (SeriesInstanceUID), which the new object would refer to."};
  std::set<std::string> named;
  for (const std::size_t n : slices) named.insert(series.sopInstanceUids[n]);
  std::map<std::string, std::string> fileOf;
  FileCopies copies;
  for (std::size_t n = 0; n < series.files.size(); ++n) {
    const std::string& uid = series.sopInstanceUids[n];
    if (!named.empty() && !named.contains(uid)) continue;
    if (uid.empty())
      return Error{series.files[n] + " has no SOPInstanceUID, by which a new object names its pictures."};
    const auto [known, isNew] = fileOf.emplace(uid, series.files[n]);
    if (!isNew && !copies.areAlike(known->second, series.files[n]))
      return sameInstance(known->second, series.files[n]);
  }
  return {};
}

Result<StudyObject> StudyObject::of(const Series& series, const ObjectTags& tags, const Progress& progress,
                                    const CancelToken& cancel, std::span<const std::size_t> slices) {
  if (series.format != "DICOM" || series.curved || series.files.empty())
    return Error{series.id +
                 " comes from no DICOM files: an object in its study must name them. Import its "
                 "DICOM files, or write a picture or .nrrd."};
  if (series.studyUid.empty())
    return Error{series.id + " names no study (StudyInstanceUID), which the new object would belong to."};
  auto source = readDicomSource(slices.empty() ? series : onlySlices(series, slices), progress, cancel);
  if (!source) return source.error();
  return StudyObject(series, datedNow(tags), std::move(*source), !slices.empty());
}

StudyObject::StudyObject(const Series& series, ObjectTags tags, DicomSource source, bool areChosen)
    : source_(std::move(source)), tags_(std::move(tags)), studyUid_(series.studyUid), areChosen_(areChosen) {
  if (tags_.seriesNumber <= 0) tags_.seriesNumber = freeNumber({seriesNumberOf(series)});
}

DicomElements StudyObject::elements(const char* sopClassUid, const char* modality) const {
  DicomElements all = equipmentModule();
  append(all, {{0x00080016, sopClassUid},
               {0x00080018, randomUid()},
               {0x00080021, tags_.date},
               {0x00080031, tags_.time},
               {0x00080060, modality},
               {0x0008103e, inOneLine(tags_.description)},
               {0x0020000e, randomUid()},
               {0x00200011, std::to_string(tags_.seriesNumber)}});
  return all;
}

void StudyObject::put(const char* sopClassUid, const char* modality, const DicomElements& own,
                      DcmItem& into) const {
  DicomElements made = elements(sopClassUid, modality);
  append(made, own);
  const DicomSourceFile& file = source_.file(0);
  putInStudy(file.ofStudy, file.characterSet, studyUid_, made, into);
}

std::vector<SourcePicture> StudyObject::pictures() const {
  std::vector<SourcePicture> all;
  std::set<std::pair<std::size_t, std::size_t>> known;
  for (const DicomSource::Slice& slice : source_.slices) {
    const DicomSourceFile& file = source_.files[slice.file];
    const bool isNamed = areChosen_ && file.isMultiFrame();
    if (!file.sopInstanceUid.empty() && known.emplace(slice.file, isNamed ? slice.frame : 0).second)
      all.push_back({file.sopClassUid, file.sopInstanceUid, isNamed ? int(slice.frame) + 1 : 0});
  }
  return all;
}

std::vector<SourcePicture> picturesOf(const DicomSource& source, std::span<const int> slices) {
  std::vector<SourcePicture> all;
  for (const int n : slices) {
    const DicomSourceFile& file = source.file(n);
    const int frame = file.isMultiFrame() ? int(source.slices[std::size_t(n)].frame) + 1 : 0;
    const bool isKnown =
        !all.empty() && all.back().sopInstanceUid == file.sopInstanceUid && all.back().frame == frame;
    if (!isKnown && !file.sopInstanceUid.empty())
      all.push_back({file.sopClassUid, file.sopInstanceUid, frame});  // a mosaic holds many slices
  }
  return all;
}

void putInStudy(const DicomElements& ofStudy, const std::string& characterSet, const std::string& studyUid,
                const DicomElements& made, DcmItem& into) {
  // Some elements of patient and study are required (types 1 and 2) even if the source lacks them.
  put(patientModule({}), into);
  put(studyModule({}, studyUid), into);
  DicomElements converted = made, study = ofStudy;
  const bool isHeld = convertTo(characterSet, converted);
  if (!isHeld)
    for (DicomElement& e : study) e.value = dicom::toUtf8(e.value, characterSet);
  put(study, into);
  put(isHeld ? converted : made, into);
  const std::string set = isHeld ? characterSet : "ISO_IR 192";
  if (!set.empty()) put(DicomElements{{0x00080005, set}}, into);
}

std::string firstCharacters(const std::string& text, std::size_t most) {
  std::string first;
  std::size_t characters = 0;
  for (const char c : text) {
    characters += (static_cast<unsigned char>(c) & 0xc0) != 0x80;
    if (characters > most) break;
    const bool endsLine = c == '\n' || c == '\r';
    first += (static_cast<unsigned char>(c) < 0x20 && !endsLine) || c == 0x7f ? ' ' : c;
  }
  return first;
}

DicomElements references(std::uint32_t sequence, std::span<const SourcePicture> pictures, int depth) {
  if (pictures.empty()) return {};
  DicomElements all = {{sequence, {}, 0, depth}};
  for (const SourcePicture& picture : pictures) {
    append(all, {{dicomItem, {}, 0, depth + 1},
                 {0x00081150, picture.sopClassUid, 0, depth + 1},
                 {0x00081155, picture.sopInstanceUid, 0, depth + 1}});
    if (picture.frame > 0) all.push_back({0x00081160, std::to_string(picture.frame), 0, depth + 1});
  }
  return all;
}

}  // namespace volumen
