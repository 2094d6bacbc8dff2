#pragma once

#include <QTextBrowser>

#include "viewer/plan/plan.h"
#include "viewer/render/render.h"

namespace volumen {

/// What the plan of the picture on screen switches on and off, why, and what each cost.
class EffectsPanel : public QTextBrowser {
  Q_OBJECT
 public:
  explicit EffectsPanel(QWidget* parent = nullptr);
  void showPlan(const Plan& plan, const RenderStats& stats);
};

}  // namespace volumen
