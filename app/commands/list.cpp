#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/command.h"
#include "app/index_option.h"
#include "app/text_table.h"
#include "app/usage.h"
#include "io/study/iso_date.h"

namespace volumen {

namespace {

using Json = nlohmann::ordered_json;

struct ListOptions {
  std::vector<std::string> words;
  std::string index;
  bool studies = false, series = false, json = false;
};

// A series, with its files if they were requested.
struct ListedSeries : IndexedSeries {
  std::vector<std::string> files;
};

// A study, with its series if they were requested.
struct Listed {
  IndexedStudy study;
  std::vector<ListedSeries> series;
};

Json toJson(const ListedSeries& s) {
  Json files = Json::array();
  for (const std::string& file : s.files) files.push_back(pathForJson(file));
  return {{"seriesUid", s.seriesUid},
          {"number", s.number},
          {"modality", s.modality},
          {"description", s.description},
          {"date", isoDate(s.date)},
          {"time", s.time},
          {"label", s.label},
          {"images", s.images},
          {"frames", s.frames},
          {"isVolume", s.isVolume},
          {"offline", s.offline},
          {"warnings", s.warnings},
          {"files", files}};
}

Json toJson(const Listed& listed, bool withSeries) {
  const IndexedStudy& s = listed.study;
  Json out{
      {"number", s.id},
      {"patient", {{"name", s.patientName}, {"id", s.patientId}, {"birthDate", isoDate(s.birthDate)}, {"sex", s.sex}}},
      {"studyUid", s.studyUid},
      {"date", isoDate(s.date)},
      {"time", s.time},
      {"description", s.description},
      {"accessionNumber", s.accessionNumber},
      {"institution", s.institution},
      {"modalities", s.modalities},
      {"seriesCount", s.series},
      {"images", s.images},
      {"warningCount", s.warnings},
      {"offline", s.offline},
      {"importedAt", s.importedAt},
      {"openedAt", s.openedAt}};
  if (!withSeries) return out;
  out["series"] = Json::array();
  for (const ListedSeries& series : listed.series) out["series"].push_back(toJson(series));
  return out;
}

std::string dateOf(const std::string& dicom) { return printable(isoDate(dicom)); }

std::string marks(int warnings, bool offline) {
  std::string text = warnings == 0   ? ""
                     : warnings == 1 ? "1 warning"
                                     : std::to_string(warnings) + " warnings";
  if (offline) text += text.empty() ? "offline" : ", offline";
  return text;
}

TextTable studyTable(const std::vector<Listed>& all) {
  TextTable table({"No.", "Patient", "ID", "Date", "Modality", "Description", "Series", "Images", ""});
  for (const Listed& listed : all) {
    const IndexedStudy& s = listed.study;
    table.add({std::to_string(s.id), printable(s.patientName), printable(s.patientId), dateOf(s.date),
               printable(s.modalities), printable(s.description), std::to_string(s.series),
               std::to_string(s.images), marks(s.warnings, s.offline)});
  }
  return table;
}

TextTable seriesTable(const std::vector<Listed>& all) {
  TextTable table({"No.", "Patient", "Date", "Series", "Modality", "Description", "Images", "Frames", ""});
  for (const Listed& listed : all)
    for (const ListedSeries& s : listed.series) {
      const std::string label = s.label.empty() ? "" : " (" + printable(s.label) + ")";
      table.add({std::to_string(listed.study.id), printable(listed.study.patientName),
                 dateOf(listed.study.date), printable(s.number), printable(s.modality),
                 printable(s.description) + label, std::to_string(s.images), std::to_string(s.frames),
                 marks(int(s.warnings.size()), s.offline)});
    }
  return table;
}

Result<std::vector<Listed>> find(const Index& index, const ListOptions& options) {
  std::string words;
  for (const std::string& word : options.words) words += word + " ";
  const Result<std::vector<IndexedStudy>> studies = index.studies({.words = words});
  if (!studies) return studies.error();
  std::vector<Listed> all;
  for (const IndexedStudy& study : *studies) {
    Listed listed{study, {}};
    if (options.series) {
      Result<std::vector<IndexedSeries>> series = index.series(study.id);
      if (!series) return series.error();
      for (IndexedSeries& s : *series) {
        Result<std::vector<std::string>> files = index.files(study.id, s.id);
        if (!files) return files.error();
        listed.series.push_back({std::move(s), std::move(*files)});
      }
    }
    all.push_back(std::move(listed));
  }
  return all;
}

// A script that reads only the JSON must not see an index without studies.
int failed(const std::string& sentence, const ListOptions& options) {
  if (options.json) std::cout << jsonText({{"studies", Json::array()}, {"problem", sentence}});
  return fail(sentence);
}

int run(const ListOptions& options) {
  const Result<Index> index = openExistingIndex(options.index);
  if (!index) return failed(index.message(), options);
  const Result<std::vector<Listed>> all = find(*index, options);
  if (!all) return failed(all.message(), options);
  if (options.json) {
    Json studies = Json::array();
    for (const Listed& listed : *all) studies.push_back(toJson(listed, options.series));
    std::cout << jsonText({{"studies", studies}});
  } else if (all->empty()) {
    std::cerr << (options.words.empty() ? "The index is empty: `volumen import PATH` fills it.\n"
                                        : "No study has all of these words.\n");
  } else {
    std::cout << (options.series ? seriesTable(*all) : studyTable(*all)).text();
  }
  return exitDone;
}

}  // namespace

std::function<int()> makeList(CLI::App& app, const CancelToken&) {
  auto options = std::make_shared<ListOptions>();
  app.add_option("WORDS", options->words,
                 "Only studies that have all of these in name, ID, date, modality or description")
      ->type_name("");
  auto* studies = app.add_flag("--studies", options->studies, "One line a study (the default)");
  app.add_flag("--series", options->series, "One line a series")->excludes(studies);
  addIndex(app, options->index);
  app.add_flag("--json", options->json, "Write one JSON object to stdout");
  addExamples(app, {"volumen list smith ct", "volumen list --series --json"});
  return [options] { return run(*options); };
}

}  // namespace volumen
