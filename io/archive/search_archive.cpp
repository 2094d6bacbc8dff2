#include "io/archive/search_archive.h"

#include <dcmtk/config/osconfig.h>

#include <QDate>
#include <algorithm>
#include <set>
#include <sstream>

#include "io/archive/data_sets.h"
#include "io/archive/protocol.h"
#include "io/archive/search_words.h"

namespace volumen {

namespace {

std::string today() { return QDate::currentDate().toString(QStringLiteral("yyyyMMdd")).toStdString(); }

DcmDataset dataSetOf(const StudyKeys& keys) {
  DcmDataset data = keysAt("STUDY");
  putKey(data, DCM_PatientName, keys.patientName);
  putKey(data, DCM_PatientID, keys.patientId);
  putKey(data, DCM_AccessionNumber, keys.accessionNumber);
  putKey(data, DCM_StudyDescription, keys.description);
  putKey(data, DCM_StudyDate, keys.dates);
  putKey(data, DCM_ModalitiesInStudy, keys.modality);
  askFor(data, {DCM_StudyInstanceUID, DCM_StudyTime, DCM_PatientBirthDate, DCM_PatientSex,
                DCM_InstitutionName, DCM_NumberOfStudyRelatedSeries, DCM_NumberOfStudyRelatedInstances});
  return data;
}

DcmDataset seriesKeysOf(const std::string& studyUid) {
  DcmDataset data = keysAt("SERIES", studyUid);
  askFor(data, {DCM_SeriesInstanceUID, DCM_SeriesNumber, DCM_Modality, DCM_SeriesDescription, DCM_SeriesDate,
                DCM_SeriesTime, DCM_NumberOfSeriesRelatedInstances});
  return data;
}

// Returns "CT\PT" as "CT, PT", sorted.
std::string listed(std::string modalities) {
  std::ranges::replace(modalities, '\\', ' ');
  std::istringstream words(modalities);
  std::set<std::string> sorted;
  for (std::string word; words >> word;) sorted.insert(word);
  std::string out;
  for (const std::string& modality : sorted) out += (out.empty() ? "" : ", ") + modality;
  return out;
}

IndexedStudy studyOf(const Answer& a) {
  IndexedStudy s;
  s.patientName = a.text(DCM_PatientName), s.patientId = a.text(DCM_PatientID);
  s.birthDate = a.date(DCM_PatientBirthDate), s.sex = a.text(DCM_PatientSex);
  s.studyUid = a.text(DCM_StudyInstanceUID);
  s.date = a.date(DCM_StudyDate), s.time = a.date(DCM_StudyTime);
  s.description = a.text(DCM_StudyDescription), s.accessionNumber = a.text(DCM_AccessionNumber);
  s.institution = a.text(DCM_InstitutionName);
  s.modalities = listed(a.text(DCM_ModalitiesInStudy));
  s.series = a.count(DCM_NumberOfStudyRelatedSeries), s.images = a.count(DCM_NumberOfStudyRelatedInstances);
  return s;
}

IndexedSeries seriesOf(const Answer& a) {
  IndexedSeries s;
  s.seriesUid = a.text(DCM_SeriesInstanceUID), s.number = a.text(DCM_SeriesNumber);
  s.modality = a.text(DCM_Modality), s.description = a.text(DCM_SeriesDescription);
  s.date = a.date(DCM_SeriesDate), s.time = a.date(DCM_SeriesTime);
  s.images = a.count(DCM_NumberOfSeriesRelatedInstances);
  s.frames = -1;
  return s;
}

// One search.
class Search {
 public:
  Search(ArchiveProtocol& protocol, const Archive& archive, const ArchiveQuery& query, const OnStudy& onStudy)
      : protocol_(protocol),
        archive_(archive),
        query_(query),
        words_(searchWords(query.words, today())),
        onStudy_(onStudy) {}

  Result<ArchiveAnswers> operator()() {
    for (const StudyKeys& keys : questionsFor(words_)) {
      // What matches everything is asked for only where nothing else helps.
      if (keys == StudyKeys() && !found_.empty()) continue;
      if (Status s = ask(keys); !s) return s.error();
      if (full_) break;
    }
    if (found_.empty() && !end_.early.empty()) return Error{end_.early};
    const bool asksModality =
        std::ranges::any_of(words_, [](const SearchWord& word) { return !word.modality.empty(); });
    for (ArchiveStudy& study : found_)
      if (query_.withSeries || (asksModality && study.study.modalities.empty()))
        if (Status s = complete(study); !s) return s.error();
    // A study whose modalities came late may lack one of the words.
    std::erase_if(found_, [&](const ArchiveStudy& s) {
      return !s.study.modalities.empty() && !hasAll(words_, s.study);
    });
    const auto time = [](const ArchiveStudy& s) { return s.study.date + s.study.time; };
    std::ranges::stable_sort(found_, std::greater(), time);
    for (std::size_t n = 0; n < found_.size(); ++n) found_[n].study.id = std::int64_t(n) + 1;
    if (full_) end_ = {notAll(), true};
    return ArchiveAnswers{std::move(found_), end_.early, !end_.early.empty() && !end_.isLimit};
  }

  // Returns the series of a study. Sets `end` to how their list ended.
  Result<std::vector<IndexedSeries>> seriesIn(const std::string& studyUid, SearchEnd& end) {
    DcmDataset data = seriesKeysOf(studyUid);
    std::vector<IndexedSeries> all;
    std::set<std::string> known;
    int answers = 0;
    const auto ended = protocol_.find(data, [&](DcmDataset& one) {
      const Answer answer(one, archive_.characterSet);
      IndexedSeries series = seriesOf(answer);
      const std::string of = answer.text(DCM_StudyInstanceUID);
      const bool isOther = !of.empty() && of != studyUid;
      if (!series.seriesUid.empty() && !isOther && known.insert(series.seriesUid).second)
        all.push_back(std::move(series));
      return ++answers < mostSeries;
    });
    if (!ended) return ended.error();
    end = *ended;
    return all;
  }

  // Asks for the series of a study, and for what they tell of it.
  Status complete(ArchiveStudy& study) {
    SearchEnd end;
    Result<std::vector<IndexedSeries>> series = seriesIn(study.study.studyUid, end);
    if (!series) return series.error();
    note(end);
    study.series = std::move(*series);
    std::string modalities;
    for (const IndexedSeries& one : study.series) modalities += one.modality + " ";
    if (study.study.modalities.empty()) study.study.modalities = listed(modalities);
    if (study.study.series < 0 && end.early.empty()) study.study.series = int(study.series.size());
    if (!query_.withSeries) study.series.clear();
    return {};
  }

 private:
  std::string notAll() const {
    return "The archive \"" + archive_.name +
           "\" may have more studies: only the first that it sent are listed. "
           "Add a word or a date.";
  }

  Status ask(const StudyKeys& keys) {
    DcmDataset data = dataSetOf(keys);
    const auto ended = protocol_.find(data, [&](DcmDataset& one) {
      // An archive that ignores a key sends everything, and a faulty one never ends.
      full_ = full_ || ++answers_ > 10 * std::int64_t(query_.limit) + 1000;
      add(studyOf(Answer(one, archive_.characterSet)));
      return !full_;
    });
    if (!ended) return ended.error();
    note(*ended);
    return {};
  }

  // A failure says more than a limit.
  void note(const SearchEnd& end) {
    if (!end.early.empty() && (end_.early.empty() || end_.isLimit)) end_ = end;
  }

  // Archives repeat studies, and may ignore a key.
  void add(const IndexedStudy& study) {
    if (study.studyUid.empty() || known_.count(study.studyUid)) return;
    IndexedStudy judged = study;
    // Archives need not tell the modalities of a study. Its series are asked for them later.
    if (judged.modalities.empty())
      for (const SearchWord& word : words_)
        if (!word.modality.empty())
          judged.modalities += (judged.modalities.empty() ? "" : ", ") + word.modality;
    if (!hasAll(words_, judged)) return;
    if (int(found_.size()) >= query_.limit) return void(full_ = true);
    known_.insert(study.studyUid);
    found_.push_back({study, {}});
    if (onStudy_ && judged.modalities == study.modalities) onStudy_(study);
  }

  static constexpr int mostSeries = 100000;  // of one study

  ArchiveProtocol& protocol_;
  const Archive& archive_;
  const ArchiveQuery& query_;
  const std::vector<SearchWord> words_;
  const OnStudy& onStudy_;
  std::vector<ArchiveStudy> found_;
  std::set<std::string> known_;
  std::int64_t answers_ = 0;
  bool full_ = false;
  SearchEnd end_;
};

}  // namespace

Status testArchive(const Archive& archive, const CancelToken& cancel) {
  return protocolOf(archive, cancel)->test();
}

Result<ArchiveAnswers> searchArchive(const Archive& archive, const ArchiveQuery& query,
                                     const OnStudy& onStudy, const CancelToken& cancel) {
  const auto protocol = protocolOf(archive, cancel);
  return Search(*protocol, archive, query, onStudy)();
}

Result<std::vector<IndexedStudy>> studiesOfArchivedPatient(const Archive& archive, const std::string& id,
                                                           const std::string& name,
                                                           const CancelToken& cancel) {
  const auto protocol = protocolOf(archive, cancel);
  const ArchiveQuery query{.words = id.empty() ? name : id};
  const OnStudy none;
  Search search(*protocol, archive, query, none);
  Result<ArchiveAnswers> answers = search();
  if (!answers) return answers.error();
  std::vector<IndexedStudy> studies;
  for (ArchiveStudy& one : answers->studies) {
    if (one.study.patientId != id || one.study.patientName != name) continue;
    if (one.study.modalities.empty())
      if (Status s = search.complete(one); !s) return s.error();
    studies.push_back(std::move(one.study));
  }
  return studies;
}

Result<std::vector<IndexedSeries>> seriesOfArchiveStudy(const Archive& archive, const std::string& studyUid,
                                                        const CancelToken& cancel) {
  const auto protocol = protocolOf(archive, cancel);
  SearchEnd end;
  auto series = Search(*protocol, archive, {}, {}).seriesIn(studyUid, end);
  if (series && series->empty() && !end.early.empty()) return Error{end.early};
  return series;
}

}  // namespace volumen
