#pragma once

#include <QString>

#include "ui/workspace/links.h"

namespace volumen {

/// How a view follows the one in focus, for a line in its corner: "not linked", "linked by hand, +12 mm"
/// (along the normal of its plane); empty where they share a frame of reference.
QString linkText(const Workspace& workspace, ViewId view);

/// Whether the views on screen follow the one in focus, and why not: a sentence.
QString linkSentence(const Workspace& workspace);

/// Why two series cannot lie over each other; empty where they can: in one frame of reference or in two that
/// are linked.
QString whyNotOverlaid(const Workspace& workspace, const Series& under, const Series& over);

}  // namespace volumen
