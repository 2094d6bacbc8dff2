#pragma once

#include <QStringList>
#include <string>
#include <vector>

#include "io/study/progress.h"
#include "ui/workspace/workspace.h"
#include "viewer/volume/cancel.h"

namespace volumen {

/// The labels of segments lie beside their session file. Each map is a file SESSION.CHECKSUM.seg.nrrd that
/// other programs can read. Unchanged maps are not written again. Autosave (Autosave) writes later versions
/// of a map as SESSION.CHECKSUM.labels, which holds only the changes.

enum class LabelFiles { whole, changes };

/// Writes the maps that are not on disk yet. The Error names the file.
Status writeSegmentMaps(const std::string& session, const Workspace& workspace,
                        LabelFiles how = LabelFiles::whole);

/// Releases the base maps of later changes that are no longer in the workspace. Returns their checksums.
std::vector<std::string> releasedBases(const std::string& session, const Workspace& workspace);
/// Releases all base maps, because the session is no longer written.
void forgetLabelChanges(const std::string& session);

/// Returns the workspace with maps that are only named, as if unread.
Workspace withLabelsApart(Workspace workspace);

/// Returns the workspace with the maps beside the session file. Maps with a missing or changed file stay
/// missing, and `problems` gets a sentence.
Workspace withSegmentMaps(Workspace workspace, const std::string& session, QStringList& problems,
                          const Progress& progress, const CancelToken& cancel);

/// Returns the files of a session beside it, whether it names them or not.
QStringList segmentFilesOf(const QString& session);

/// Returns the checksums of the maps a session file names; empty if it cannot be read.
std::vector<std::string> segmentMapsNamedBy(const std::string& session);

/// Removes the files of these maps unless the workspace or another session in the folder uses them.
void removeSegmentMaps(const std::string& session, const std::vector<std::string>& checksums,
                       const Workspace& workspace);

}  // namespace volumen
