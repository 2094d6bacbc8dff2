#pragma once

#include <QStringList>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "io/study/progress.h"
#include "ui/controller/segment_files.h"
#include "ui/workspace/hand_work.h"
#include "ui/workspace/links.h"
#include "viewer/volume/cancel.h"

namespace volumen {

struct Study;

/// A session as read, with its series found again.
struct OpenedSession {
  Workspace workspace;
  std::string savedAs;  ///< the session file that an autosave file belongs to; empty if there is none yet
  std::vector<std::pair<std::string, std::shared_ptr<const Study>>> studies;  ///< by path
  /// A sentence for each series or object that is missing, changed or incomplete.
  QStringList problems;
  bool segmentsAreWhole = true;  ///< whether all labels and their recorded steps were read
  /// The content of file `savedAs`; empty if it cannot be read. Labels are shared with `workspace` if they
  /// are equal.
  std::optional<Workspace> saved;
  HandWork exported;  ///< segments that also have a file of their own, where an autosave file says so
};

/// Reads a session file and searches for its series, presentation states, structure sets and segmentations.
/// It looks at the same place relative to the file first, then at the old path. Views of missing or changed
/// series stay empty and keep their state. The labels of segments are read too (segment_files.h). The Error
/// names the file.
Result<OpenedSession> openSession(const std::string& path, const Progress& progress = {},
                                  const CancelToken& cancel = {});

/// Returns how the frames of reference of two series are linked in a session file; empty if they are not. Its
/// series are not searched for. The Error names the file.
Result<std::optional<FrameRelation>> relationInSession(const std::string& path, const std::string& from,
                                                       const std::string& to);

/// Writes a session file, and the labels of segments beside it. The Error names the file.
Status saveSession(const std::string& path, const Workspace& workspace);
/// Writes an autosave file: it also names its session file, the patients it shows and the segments that are
/// in `saved`, and holds only changes of labels.
Status keepSession(const std::string& path, const Workspace& workspace, const std::string& savedAs,
                   const HandWork& saved = {});

}  // namespace volumen
