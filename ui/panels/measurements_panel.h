#pragma once

#include <QCheckBox>
#include <QLabel>
#include <QToolButton>
#include <QTreeWidget>

#include "ui/derivations/measured_numbers.h"
#include "ui/workspace/measurement_text.h"

namespace volumen {

/// Lists all measurements with name, numbers and series, to show, rename, delete, copy, save and open them.
class MeasurementsPanel : public QWidget {
  Q_OBJECT
 public:
  MeasurementsPanel(Session& session, MeasuredNumbers& measurer, QWidget* parent = nullptr);

 Q_SIGNALS:
  /// Requests to show a measurement.
  void jumpRequested(int measurement);
  void saved(const QString& path);
  void failed(const QString& sentence);

 private:
  void makeLayout();
  QToolButton* menuButton(const char* name, const QString& text);
  void fillMenus();
  void showAll();
  void showRow(QTreeWidgetItem* item, const Measurement& measurement);
  void deleteSelected();
  int selectedId() const;
  std::vector<MeasuredRow> rows();
  void rename(QTreeWidgetItem* item);
  void copy(const QString& text);
  SeriesKey seriesInFocus() const;
  void askWhere(const QString& title, const QString& suffix, const std::function<QString()>& text);
  QString shapesText() const;
  void askWhatToOpen();
  void openShapes(const QString& path);

  Session& session_;
  MeasuredNumbers& measurer_;
  QLabel* empty_;
  QTreeWidget* list_;
  QCheckBox* shown_;
  QToolButton *rename_, *delete_, *deleteAll_, *copy_, *save_, *open_;
  std::vector<MeasuredPtr> held_;  // keeps what rows() refers to
};

}  // namespace volumen
