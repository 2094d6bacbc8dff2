#pragma once

#include <QToolButton>

#include "ui/tools/tool.h"

namespace volumen {

/// A button for a tool on a page of segments. SegmentsPanel::setToolActions() gives it the tool's action.
class ToolButton : public QToolButton {
  Q_OBJECT
 public:
  ToolButton(const QString& name, const char* nameOfTool) : tool(toolNamed(nameOfTool)) {
    setObjectName(name);
    setToolButtonStyle(Qt::ToolButtonTextOnly);
  }

  const Tool& tool;
};

}  // namespace volumen
