#pragma once

#include <QCheckBox>
#include <QComboBox>
#include <QPushButton>
#include <QSpinBox>
#include <functional>

#include "ui/workspace/snapshot_request.h"

class QVBoxLayout;

namespace volumen {

class ColourButton;

/// A picture of the view at any size: to a file, to the clipboard, or all around.
class SnapshotPanel : public QWidget {
  Q_OBJECT
 public:
  explicit SnapshotPanel(QWidget* parent = nullptr);

  /// The size that "Match view size" gives.
  void setViewSize(QSize pixels);
  /// Who says what is seen; null: nothing, which is told there.
  void setSeen(std::function<std::optional<SnapshotSeen>()> seen) { seen_ = std::move(seen); }
  /// Asks where to save; then tells requested().
  void askWhere();
  /// The snapshot as chosen, for the clipboard.
  void copy();

 Q_SIGNALS:
  void requested(const volumen::SnapshotRequest& request);

 private:
  void addSize(QVBoxLayout* column);
  void addKind(QVBoxLayout* column);
  void addBackground(QVBoxLayout* column);
  void addAnnotations(QVBoxLayout* column);
  void addButtons(QVBoxLayout* column);
  void askForFolder();
  QString name(const SnapshotSeen& seen) const;
  SnapshotRequest chosen(const SnapshotSeen& seen, const QString& path) const;
  std::optional<Background> background() const;
  QString suffix() const;

  QSpinBox *width_, *height_, *pictures_;
  QComboBox *quality_, *format_, *background_;
  ColourButton* colour_;
  QCheckBox *letters_, *scaleBar_, *patient_, *warnings_;
  QSize viewSize_{512, 512};
  std::function<std::optional<SnapshotSeen>()> seen_;
  bool sizeChosen_ = false;
};

}  // namespace volumen
