#include "ui/controller/study_sources.h"

#include <algorithm>
#include <utility>

#include "ui/controller/index_service.h"

namespace volumen {

namespace {

using Make = std::unique_ptr<StudySource> (*)(const std::string& indexFolder, Jobs& jobs);

constexpr Make sources[] = {
    [](const std::string& indexFolder, Jobs& jobs) -> std::unique_ptr<StudySource> {
      return std::make_unique<IndexService>(indexFolder, jobs);
    },
};

}  // namespace

StudySourceList makeStudySources(const std::string& indexFolder, Jobs& jobs) {
  StudySourceList all;
  for (const Make make : sources) all.push_back(make(indexFolder, jobs));
  return all;
}

StudySource* StudySources::importer() const {
  const auto first = std::ranges::find_if(all_, [](const auto& source) { return source->canImport(); });
  return first == all_.end() ? nullptr : first->get();
}

void StudySources::choose(std::size_t n) {
  if (std::exchange(current_, n) != n) Q_EMIT chosen();
}

}  // namespace volumen
