#pragma once

#include <QComboBox>
#include <QDoubleSpinBox>

#include "ui/widgets/colour_button.h"
#include "ui/widgets/curve_editor.h"
#include "ui/workspace/session.h"

class QStackedWidget;

namespace volumen {

/// The rendering mode and how values are shown: the curve of opacity and colour with the numbers of its
/// selected point, or the window of a projection.
class TransferPanel : public QWidget {
  Q_OBJECT
 public:
  explicit TransferPanel(Session& session, QWidget* parent = nullptr);
  CurveEditor* editor() const { return editor_; }

 Q_SIGNALS:
  /// The user changed the curve of the scene here, by a step or a drag.
  void curvePulled();

 private:
  void makePages();
  void makeFields();
  void connectEditor();
  void connectMode();
  void showMode();
  void showCurve();
  void showPoint();
  void editWindow(const TransferFunction& curve, const QString& what);
  void changePoint(const std::function<void(CurvePoint&)>& change, const QString& what);

  Session& session_;
  CurveEditor* editor_;
  QWidget* fields_;
  QStackedWidget* pages_;  // numbers of the curve, or of the window
  QComboBox* mode_;
  QDoubleSpinBox *value_, *opacity_, *halving_;
  ColourButton* colour_;
};

}  // namespace volumen
