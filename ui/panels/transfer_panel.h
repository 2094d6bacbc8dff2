#pragma once

#include <QDoubleSpinBox>

#include "ui/session/session.h"
#include "ui/widgets/colour_button.h"
#include "ui/widgets/curve_editor.h"

namespace volumen {

/// Opacity and colour: the curve, and the selected point in numbers.
class TransferPanel : public QWidget {
  Q_OBJECT
 public:
  explicit TransferPanel(Session& session, QWidget* parent = nullptr);
  CurveEditor* editor() const { return editor_; }

 private:
  QWidget* makeScaleBox();
  void makeFields();
  void connectEditor();
  void connectFields();
  QDoubleSpinBox* addField(const QString& name, const QString& label, int decimals, double low, double high);
  void showPoint();
  void changePoint(const std::function<void(CurvePoint&)>& change, const QString& what);

  Session& session_;
  CurveEditor* editor_;
  QWidget* fields_;
  QDoubleSpinBox *value_, *opacity_, *halving_;
  ColourButton* colour_;
};

}  // namespace volumen
