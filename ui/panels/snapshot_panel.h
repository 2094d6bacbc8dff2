#pragma once

#include <QCheckBox>
#include <QComboBox>
#include <QPushButton>
#include <QSpinBox>

#include "viewer/plan/options.h"

namespace volumen {

/// What a snapshot is to be.
struct SnapshotRequest {
  QString path;
  QSize size;
  Quality quality = Quality::high;
  bool transparent = false;
};

/// A picture of the view as PNG, at any size.
class SnapshotPanel : public QWidget {
  Q_OBJECT
 public:
  explicit SnapshotPanel(QWidget* parent = nullptr);

  /// The size that "as in the view" gives.
  void setViewSize(QSize pixels);
  /// The file name offered first.
  void setName(const QString& name) { name_ = name; }
  /// Asks where to save; then tells saveRequested().
  void askWhere();

 Q_SIGNALS:
  void saveRequested(const volumen::SnapshotRequest& request);

 private:
  QSpinBox *width_, *height_;
  QComboBox* quality_;
  QCheckBox* transparent_;
  QSize viewSize_{512, 512};
  QString name_;
  bool sizeChosen_ = false;
};

}  // namespace volumen
