#pragma once

#include <QCheckBox>
#include <QComboBox>
#include <QPushButton>
#include <QSpinBox>

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
  /// Returns the request for a snapshot as chosen.
  SnapshotRequest chosen(const SnapshotSeen& seen) const;
  /// Returns the number of pictures of a turntable.
  int turntablePictures() const { return pictures_->value(); }
  /// Returns the suffix of the chosen file format: "png" or "jpg".
  QString suffix() const;

 Q_SIGNALS:
  void saveWanted();
  void copyWanted();
  void turntableWanted();

 private:
  QLayout* annotations();
  std::optional<Background> background() const;

  QSpinBox *width_, *height_, *pictures_;
  QComboBox *quality_, *format_, *background_;
  ColourButton* colour_;
  QCheckBox *letters_, *scaleBar_, *patient_, *warnings_;
  QSize viewSize_{512, 512};
  bool sizeChosen_ = false;
};

}  // namespace volumen
