#pragma once

#include <QAction>
#include <QComboBox>
#include <QImage>
#include <functional>

#include "results/pictures/own_presets.h"
#include "ui/workspace/session.h"

namespace volumen {

/// Lists presets with thumbnails, those of the series' modality first. Saves the look on screen as a preset
/// of the user, or deletes one.
class PresetBar : public QWidget {
  Q_OBJECT
 public:
  using Entries = std::function<std::vector<PresetEntry>()>;
  PresetBar(Session& session, Entries entries, QWidget* parent = nullptr);

  /// Returns the names in the order of the list.
  std::vector<std::string> names() const;
  void showThumbnail(const QString& name, const QImage& image);
  static constexpr int thumbnailEdge = 56;  ///< logical pixels

 Q_SIGNALS:
  void presetChosen(const QString& name);
  /// The list has other presets.
  void listChanged();
  void failed(const QString& sentence);

 private:
  void makeMenu();
  void fill();
  void add(const PresetEntry& entry);
  void showChosen();
  void askName();
  void save(const QString& name);
  void deleteOwn();
  bool isOwn(const QString& name) const;

  Session& session_;
  const Entries readEntries_;
  std::vector<PresetEntry> entries_;
  QComboBox* box_;
  QAction *save_, *delete_;
};

}  // namespace volumen
