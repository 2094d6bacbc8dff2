#include "tests/unit/index/index_folder.h"

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>

#include <algorithm>
#include <filesystem>
#include <sstream>

namespace volumen::tests {

std::string IndexFolder::data(const std::string& name) const {
  return dir_.filePath(QStringLiteral("data")).toStdString() + (name.empty() ? "" : "/" + name);
}

std::string IndexFolder::index() const { return dir_.filePath(QStringLiteral("index")).toStdString(); }

void IndexFolder::add(const MadeFile& file) const {
  const std::string path = data(file.name);
  std::filesystem::create_directories(std::filesystem::path(path).parent_path());
  DicomPicture picture = sliceAt(file.slice, file.slice);
  picture.seriesUid = file.series;
  picture.edit = [&](DcmDataset& data) {
    data.putAndInsertString(DCM_SpecificCharacterSet, "ISO_IR 192");
    data.putAndInsertString(DCM_PatientName, file.patient.c_str());
    data.putAndInsertString(DCM_StudyInstanceUID, file.study.c_str());
    data.putAndInsertString(DCM_StudyDate, file.date.c_str());
    data.putAndInsertString(DCM_StudyDescription, file.studyDescription.c_str());
    data.putAndInsertString(DCM_SOPInstanceUID,
                            (file.series + "." + std::to_string(1000 + file.slice)).c_str());
    data.putAndInsertString(DCM_PatientBirthDate, "19700102");
    data.putAndInsertString(DCM_AccessionNumber, "A77");
    data.putAndInsertString(DCM_InstitutionName, file.institution.c_str());
  };
  writeDicom(path, picture);
}

Index IndexFolder::open() const {
  Result<Index> opened = Index::open(index());
  if (!opened) qFatal("%s", opened.message().c_str());
  return std::move(*opened);
}

ImportReport IndexFolder::import(const std::string& part) const {
  Index index = open();
  Result<ImportReport> report = index.import({data(part)});
  if (!report) qFatal("%s", report.message().c_str());
  return *report;
}

namespace {
template <class T>
T valueOr(Result<T> result) {
  return result ? std::move(*result) : T();
}
}  // namespace

std::vector<IndexedStudy> studiesIn(const Index& index, const StudyQuery& query) {
  return valueOr(index.studies(query));
}

std::vector<IndexedSeries> seriesIn(const Index& index, std::int64_t study) {
  return valueOr(index.series(study));
}

std::vector<std::string> filesIn(const Index& index, std::int64_t study, std::int64_t series) {
  return valueOr(index.files(study, series));
}

std::string contentsOf(const Index& index) {
  std::vector<std::string> all;
  for (const IndexedStudy& s : studiesIn(index)) {
    std::ostringstream out;
    out << s.patientName << '|' << s.patientId << '|' << s.birthDate << '|' << s.sex << '|' << s.studyUid
        << '|' << s.date << '|' << s.description << '|' << s.accessionNumber << '|' << s.institution << '|'
        << s.modalities << '|' << s.series << '|' << s.images << '|' << s.warnings << '|' << s.offline
        << '\n';
    std::vector<std::string> lines;
    for (const IndexedSeries& series : seriesIn(index, s.id)) {
      std::ostringstream line;
      line << "  " << series.seriesUid << '|' << series.number << '|' << series.modality << '|'
           << series.description << '|' << series.label << '|' << series.images << '|' << series.frames << '|'
           << series.isVolume << '|' << series.offline << '\n';
      for (const std::string& warning : series.warnings) line << "    ! " << warning << '\n';
      for (const std::string& file : filesIn(index, s.id, series.id)) line << "    " << file << '\n';
      lines.push_back(line.str());
    }
    std::ranges::sort(lines);
    for (const std::string& line : lines) out << line;
    all.push_back(out.str());
  }
  std::ranges::sort(all);
  std::string text;
  for (const std::string& study : all) text += study;
  return text;
}

}  // namespace volumen::tests
