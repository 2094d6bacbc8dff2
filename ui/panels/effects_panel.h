#pragma once

#include <QTextBrowser>

#include "viewer/plan/plan.h"
#include "viewer/render/render.h"

namespace volumen {

/// What the plan of the picture on screen switches on and off, why, and what each cost; above it, what of the
/// scene was asked for and is not in the picture.
class EffectsPanel : public QTextBrowser {
  Q_OBJECT
 public:
  explicit EffectsPanel(QWidget* parent = nullptr);
  void showPlan(const Plan& plan, const RenderStats& stats);
  /// Lines; empty: all is.
  void showNotDrawn(const QString& text);

 private:
  void showAll();

  QString plan_, notDrawn_;  // HTML
};

}  // namespace volumen
