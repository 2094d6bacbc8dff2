#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/command.h"
#include "app/index_option.h"
#include "app/study_lines.h"
#include "app/usage.h"

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
  Json out = seriesJson(s), files = Json::array();
  for (const std::string& file : s.files) files.push_back(pathForJson(file));
  out["files"] = files;
  return out;
}

Json toJson(const Listed& listed, bool withSeries) {
  Json out = studyJson(listed.study);
  if (!withSeries) return out;
  out["series"] = Json::array();
  for (const ListedSeries& series : listed.series) out["series"].push_back(toJson(series));
  return out;
}

std::string textOf(const std::vector<Listed>& all, bool withSeries) {
  TextTable table = withSeries ? seriesTable() : studyTable();
  for (const Listed& listed : all) {
    if (!withSeries) addTo(table, listed.study);
    for (const ListedSeries& series : listed.series) addTo(table, listed.study, series);
  }
  return table.text();
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
    std::cout << textOf(*all, options.series);
  }
  return exitDone;
}

}  // namespace

std::function<int()> makeList(CLI::App& app, const CancelToken&) {
  auto options = std::make_shared<ListOptions>();
  app.add_option("WORDS", options->words,
                 "Only studies that have all of these in name, ID, date (also today, yesterday), modality or "
                 "description")
      ->type_name("");
  auto* studies = app.add_flag("--studies", options->studies, "One line a study (the default)");
  app.add_flag("--series", options->series, "One line a series")->excludes(studies);
  addIndex(app, options->index);
  app.add_flag("--json", options->json, "Write one JSON object to stdout");
  addExamples(app, {"volumen list smith ct", "volumen list --series --json"});
  return [options] { return run(*options); };
}

}  // namespace volumen
