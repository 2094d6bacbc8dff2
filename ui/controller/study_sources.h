#pragma once

#include <functional>
#include <memory>

#include "ui/controller/study_source.h"
#include "ui/document/jobs.h"

namespace volumen {

using StudySourceList = std::vector<std::unique_ptr<StudySource>>;
/// Makes the sources that there are, in the order in which they are offered; `indexFolder`: of the index.
using MakeStudySources = std::function<StudySourceList(const std::string& indexFolder, Jobs& jobs)>;

/// All that this program knows.
StudySourceList makeStudySources(const std::string& indexFolder, Jobs& jobs);

/// The sources of studies, one of which is listed.
class StudySources : public QObject {
  Q_OBJECT
 public:
  /// At least one; the first is listed.
  explicit StudySources(StudySourceList all) : all_(std::move(all)) {}

  const StudySourceList& all() const { return all_; }
  /// The one that is listed.
  StudySource& current() const { return *all_[current_]; }
  /// The first that studies can be imported into; null: there is none.
  StudySource* importer() const;
  /// Lists this one of all().
  void choose(std::size_t n);

 Q_SIGNALS:
  /// Another one is listed.
  void chosen();

 private:
  StudySourceList all_;
  std::size_t current_ = 0;
};

}  // namespace volumen
