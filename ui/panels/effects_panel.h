#pragma once

#include <QTextBrowser>

#include "viewer/plan/plan.h"
#include "viewer/render/render.h"

namespace volumen {

/// Lists the effects that the plan of the picture switches on or off, with reasons and cost. Above it, lists
/// parts of the scene that are missing from the picture.
class EffectsPanel : public QTextBrowser {
  Q_OBJECT
 public:
  explicit EffectsPanel(QWidget* parent = nullptr);
  void showPlan(const Plan& plan, const RenderStats& stats);
  /// Shows one missing part per line of `text`. Empty if nothing is missing.
  void showNotDrawn(const QString& text);

 private:
  void showAll();

  QString plan_, notDrawn_;  // HTML
};

}  // namespace volumen
