#pragma once

#include <QString>

#include "ui/workspace/links.h"

namespace volumen {

/// Returns how a view follows the one in focus, for a corner line: "not linked", "linked by hand, +12 mm"
/// (along its plane's normal). Empty if they share a frame of reference.
QString linkText(const Workspace& workspace, ViewId view);

/// Returns a sentence: whether the views on screen follow the one in focus, and if not, why.
QString linkSentence(const Workspace& workspace);

/// Returns why two series cannot be overlaid. Empty if they can: they share a frame of reference, or theirs
/// are linked.
QString whyNotOverlaid(const Workspace& workspace, const Series& under, const Series& over);

}  // namespace volumen
