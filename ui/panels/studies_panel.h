#pragma once

#include <QLineEdit>
#include <QTreeWidget>
#include <memory>
#include <vector>

#include "io/study.h"

namespace volumen {

/// What was opened: patients, studies, series; "!" where there is a warning, its sentence in the tooltip. A
/// click asks for a series. What could not be read is named below with its reason.
class StudiesPanel : public QWidget {
  Q_OBJECT
 public:
  explicit StudiesPanel(QWidget* parent = nullptr);

  /// Adds what a path holds, instead of what it held when it was opened before.
  void addStudy(const QString& path, const std::shared_ptr<const Study>& study);
  /// Writes all again, after names were hidden or shown.
  void showNames();
  /// Marks the series on screen.
  void markShown(const Series& series);
  QTreeWidget* tree() const { return tree_; }

 Q_SIGNALS:
  void seriesChosen(const volumen::Series& series);

 private:
  QTreeWidgetItem* childNamed(QTreeWidgetItem* parent, const QString& key, const QString& text);
  void addSeries(const QString& path, const Series& series, std::size_t n);
  void addRefused(const QString& path, const Study& study);
  void removePath(const QString& path);
  void filter(const QString& text);

  QLineEdit* search_;
  QTreeWidget* tree_;
  std::vector<std::pair<QString, std::shared_ptr<const Study>>> studies_;
};

}  // namespace volumen
