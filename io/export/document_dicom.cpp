#include "io/export/document_dicom.h"

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>

#include <QDateTime>
#include <algorithm>

#include "io/export/dicom_file.h"
#include "io/export/dicom_modules.h"
#include "io/export/dicom_source.h"
#include "io/export/dicom_uid.h"
#include "io/export/study_object.h"
#include "io/files/same_bytes.h"
#include "io/study/study.h"

namespace volumen {

namespace {

constexpr std::uint32_t instanceReferences = 0x00081199, instanceUid = 0x00081155;

// An instance that the study lists.
struct StudyInstance {
  std::string path;
  const SeriesIdentity* of = nullptr;
  bool isDerived = false, isImage = true;
  std::vector<std::string> otherPaths{};  // paths of other pictures with the same UID
};

std::map<std::string, StudyInstance> knownInstances(const Study& study) {
  std::map<std::string, StudyInstance> all;
  const auto add = [&](const std::string& uid, const std::string& path, const SeriesIdentity& of) {
    const auto [known, isNew] = all.emplace(uid, StudyInstance{path, &of});
    if (!isNew && known->second.path != path) known->second.otherPaths.push_back(path);
  };
  for (const Series& series : study.volumes)
    for (std::size_t n = 0; n < series.sopInstanceUids.size(); ++n)
      add(series.sopInstanceUids[n], series.files[n], series);
  for (const Image& image : study.images) add(image.sopInstanceUid, image.path, image);
  for (const DerivedObject& object : study.derived)
    all.emplace(object.sopInstanceUid,
                StudyInstance{object.path, &object, true, object.kind == DerivedKind::segmentation});
  return all;
}

// Sets patient and study, and the attributes of the pictures that only their headers have.
Status addHeaders(const std::vector<std::string>& paths, DocumentSource& source, const Progress& progress,
                  const CancelToken& cancel) {
  Series files;
  files.files = paths;
  files.path = paths.front();
  files.frames.assign(paths.size(), 0);
  const Result<DicomSource> read = readDicomSource(files, progress, cancel);
  if (!read) return read.error();
  const DicomSourceFile& first = read->files.front();
  source.study = first.ofStudy;
  source.characterSet = first.characterSet;
  for (const DicomSourceFile& file : read->files) {
    DocumentPicture& picture = source.pictures[file.sopInstanceUid];
    picture.sopClassUid = file.sopClassUid;
    picture.frames = file.frameCount;
  }
  return {};
}

// Adds the UIDs of all objects that the item and those below it reference, each once.
void addReferences(const ContentItem& item, std::vector<std::string>& uids) {
  for (const DicomElement& e : item.value)
    if (e.tag == instanceUid && std::ranges::find(uids, e.value) == uids.end()) uids.push_back(e.value);
  for (const ContentItem& below : item.content) addReferences(below, uids);
}

DicomElements evidenceOf(const ContentItem& content, const DocumentSource& source) {
  std::vector<std::string> uids;
  addReferences(content, uids);
  if (uids.empty()) return {};
  std::map<std::string, DicomElements> ofSeries;
  for (const std::string& uid : uids) {
    const DocumentPicture& picture = source.pictures.at(uid);
    append(ofSeries[picture.seriesUid],
           {{dicomItem, {}, 0, 3}, {0x00081150, picture.sopClassUid, 0, 3}, {instanceUid, uid, 0, 3}});
  }
  DicomElements all = {
      {0x0040a375, {}}, {dicomItem, {}, 0, 1}, {0x0020000d, source.studyUid, 0, 1}, {0x00081115, {}, 0, 1}};
  for (const auto& [uid, references] : ofSeries) {
    append(all, {{dicomItem, {}, 0, 2}, {0x0020000e, uid, 0, 2}, {instanceReferences, {}, 0, 2}});
    append(all, references);
  }
  return all;
}

DicomElements seriesElements(const Document& document, const DocumentSource& source) {
  const QDateTime now = QDateTime::currentDateTime();
  const std::string date = now.toString(QStringLiteral("yyyyMMdd")).toStdString();
  const std::string time = now.toString(QStringLiteral("HHmmss")).toStdString();
  return {{0x00080016, document.sopClassUid},
          {0x00080018, randomUid()},
          {0x00080021, date},
          {0x00080023, date},
          {0x00080031, time},
          {0x00080033, time},
          {0x00080060, document.modality},
          {0x0008103e, inOneLine(document.description)},
          {0x00081111, {}},
          {0x0020000e, randomUid()},
          {0x00200011, std::to_string(source.seriesNumber)},
          {0x00200013, "1"}};
}

}  // namespace

Result<DocumentSource> readDocumentSource(const Study& study, std::span<const std::string> sopInstanceUids,
                                          const Progress& progress, const CancelToken& cancel) {
  const std::map<std::string, StudyInstance> known = knownInstances(study);
  DocumentSource source;
  std::vector<std::string> paths;
  FileCopies copies;
  for (const std::string& uid : sopInstanceUids) {
    const auto found = known.find(uid);
    if (found == known.end()) return Error{"No image here has the SOPInstanceUID " + uid + "."};
    const StudyInstance& instance = found->second;
    if (uid.empty())
      return Error{instance.path + " has no SOPInstanceUID, by which a document names its images."};
    for (const std::string& other : instance.otherPaths)
      if (!copies.areAlike(instance.path, other)) return sameInstance(instance.path, other);
    if (source.studyUid.empty()) source.studyUid = instance.of->studyUid;
    if (instance.of->studyUid.empty() || instance.of->seriesUid.empty())
      return Error{instance.path + ": it does not say which study and series it belongs to."};
    if (instance.of->studyUid != source.studyUid)
      return Error{instance.path + ": it is of another study than the first image; write one file a study."};
    source.pictures[uid] = {instance.of->sopClassUid, uid, instance.of->seriesUid, 0, instance.isImage};
    if (!instance.isDerived) paths.push_back(instance.path);
  }
  if (paths.empty()) return Error{"A document must refer to at least one image."};
  if (Status s = addHeaders(paths, source, progress, cancel); !s) return s.error();
  source.seriesNumber = nextSeriesNumber(study, source.studyUid);
  return source;
}

Status checkPicture(const ReferencedPicture& picture, const DocumentSource& source) {
  const auto found = source.pictures.find(picture.sopInstanceUid);
  if (found == source.pictures.end())
    return Error{"it refers to an image that is not here: " + picture.sopInstanceUid};
  const int frames = found->second.frames;
  for (const int frame : picture.frames)
    if (frame < 0 || (frames > 0 && frame >= frames))
      return Error{"image " + picture.sopInstanceUid + " has no frame " + std::to_string(frame + 1)};
  return {};
}

ContentItem pictureItem(const char* relationship, const Code& name, const ReferencedPicture& picture,
                        const DocumentSource& source) {
  const DocumentPicture& known = source.pictures.at(picture.sopInstanceUid);
  const auto numbers = [](const std::vector<int>& of, int first) {
    std::string text;
    for (const int n : of) text += (text.empty() ? "" : "\\") + std::to_string(n + first);
    return text;
  };
  ContentItem item{relationship, known.isImage ? "IMAGE" : "COMPOSITE", name};
  item.value = {{instanceReferences, {}},
                {dicomItem, {}, 0, 1},
                {0x00081150, known.sopClassUid, 0, 1},
                {instanceUid, picture.sopInstanceUid, 0, 1}};
  if (known.frames != 1 && !picture.frames.empty())
    item.value.push_back({0x00081160, numbers(picture.frames, 1), 0, 1});
  if (!picture.segments.empty()) item.value.push_back({0x0062000b, numbers(picture.segments, 0), 0, 1});
  return item;
}

Status writeDocument(const Document& document, const DocumentSource& source, const std::string& path) {
  DicomElements made = seriesElements(document, source);
  append(made, enhancedEquipmentModule());
  append(made, document.more);
  append(made, evidenceOf(document.content, source));
  append(made, elementsOf(document.content));
  DcmFileFormat file;
  putInStudy(source.study, source.characterSet, source.studyUid, made, *file.getDataset());
  return writeNewDicom(file, path, {});
}

}  // namespace volumen
