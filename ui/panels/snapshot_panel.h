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

/// Pictures of the 3D view at any size: to a file, to the clipboard, or a series all around.
class SnapshotPanel : public QWidget {
  Q_OBJECT
 public:
  explicit SnapshotPanel(QWidget* parent = nullptr);

  /// Sets the size for "Match view size".
  void setViewSize(QSize pixels);
  /// Sets the function that returns the visible scene. It returns nothing, after reporting why, if there is
  /// none.
  void setSeen(std::function<std::optional<SnapshotSeen>()> seen) { seen_ = std::move(seen); }
  /// Asks for a file, then emits requested().
  void askWhere();
  /// Requests the snapshot as chosen for the clipboard.
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
