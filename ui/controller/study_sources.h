#pragma once

#include <functional>
#include <memory>

#include "ui/controller/study_source.h"
#include "ui/document/jobs.h"

namespace volumen {

using StudySourceList = std::vector<std::unique_ptr<StudySource>>;
/// Makes the available sources in the order in which they are offered. `indexFolder` is the folder of the
/// index.
using MakeStudySources = std::function<StudySourceList(const std::string& indexFolder, Jobs& jobs)>;

/// Makes all sources of this program.
StudySourceList makeStudySources(const std::string& indexFolder, Jobs& jobs);

/// The sources of studies; one of them is listed.
class StudySources : public QObject {
  Q_OBJECT
 public:
  /// `all` has at least one source; the first is listed.
  explicit StudySources(StudySourceList all) : all_(std::move(all)) {}

  const StudySourceList& all() const { return all_; }
  /// Returns the listed source.
  StudySource& current() const { return *all_[current_]; }
  /// Returns the first source that supports imports, or null.
  StudySource* importer() const;
  /// Lists source `n` of all().
  void choose(std::size_t n);

 Q_SIGNALS:
  /// Another source is listed.
  void chosen();

 private:
  StudySourceList all_;
  std::size_t current_ = 0;
};

}  // namespace volumen
