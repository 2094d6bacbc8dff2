#pragma once

#include <QStringList>
#include <string>
#include <vector>

#include "io/study/progress.h"
#include "ui/workspace/workspace.h"
#include "viewer/volume/cancel.h"

namespace volumen {

/// Beside a session file lie the labels of its segments, each map in a file SESSION.CHECKSUM.seg.nrrd that
/// other programs read, too. A map that did not change is not written again. Of what is kept again and again
/// (Autosave) a map that follows another one is SESSION.CHECKSUM.labels, what of that one changed.

enum class LabelFiles { whole, changes };

/// Writes those that are not there yet. The Error names the file.
Status writeSegmentMaps(const std::string& session, const Workspace& workspace,
                        LabelFiles how = LabelFiles::whole);

/// Lets go of the maps that later changes of a session were to be told from, where the workspace has the maps
/// no more; returns their checksums.
std::vector<std::string> releasedBases(const std::string& session, const Workspace& workspace);
/// Lets go of all of them: the session is not written any more.
void forgetLabelChanges(const std::string& session);

/// With maps that are only named, as if they had not been read.
Workspace withLabelsApart(Workspace workspace);

/// With the maps that lie beside the session file; a map whose file is not there, or does not hold what it
/// held, stays missing, and `problems` gets a sentence.
Workspace withSegmentMaps(Workspace workspace, const std::string& session, QStringList& problems,
                          const Progress& progress, const CancelToken& cancel);

/// The files of a session beside it, whether it names them or not.
QStringList segmentFilesOf(const QString& session);

/// The checksums of the maps that a session file names; none where it cannot be read.
std::vector<std::string> segmentMapsNamedBy(const std::string& session);

/// Removes the files of these maps that neither the workspace nor another session in the folder holds.
void removeSegmentMaps(const std::string& session, const std::vector<std::string>& checksums,
                       const Workspace& workspace);

}  // namespace volumen
