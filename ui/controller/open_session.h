#pragma once

#include <QStringList>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "io/study/progress.h"
#include "ui/controller/segment_files.h"
#include "ui/workspace/workspace.h"
#include "viewer/volume/cancel.h"

namespace volumen {

struct Study;

/// A session that was read, with its series found again.
struct OpenedSession {
  Workspace workspace;
  std::string savedAs;  ///< of what was kept on the way: the session file it belongs to; empty: none yet
  std::vector<std::pair<std::string, std::shared_ptr<const Study>>> studies;  ///< by path
  /// A sentence for each series or object that is missing, has changed or is not whole.
  QStringList problems;
  bool segmentsAreWhole = true;  ///< the labels of all, and how they were made, were read
  /// What the file `savedAs` holds; none: it cannot be read. Labels are those of `workspace` where they are
  /// the same.
  std::optional<Workspace> saved;
};

/// Reads a session file and looks for its series, and for the presentation states, structure sets and
/// segmentations that it shows: beside it as they lay then, else at their old place. Where a series is
/// missing, or is not what it was, its views stay empty and keep their state. The labels of segments are
/// read, too (segment_files.h). The Error names the file.
Result<OpenedSession> openSession(const std::string& path, const Progress& progress = {},
                                  const CancelToken& cancel = {});

/// Writes a session file, and the labels of segments beside it. The Error names the file.
Status saveSession(const std::string& path, const Workspace& workspace);
/// The same of what is kept on the way: it says which session file it belongs to and whose pictures it shows,
/// and of labels what changed.
Status keepSession(const std::string& path, const Workspace& workspace, const std::string& savedAs);

}  // namespace volumen
