#pragma once

#include <QLabel>
#include <QSlider>
#include <QTreeWidget>

#include "ui/controller/derived_objects.h"
#include "ui/workspace/session.h"

namespace volumen {

/// Lists structure sets and segmentations with their regions, and chooses which ones flat views show.
class RegionsPanel : public QWidget {
  Q_OBJECT
 public:
  RegionsPanel(Session& session, DerivedObjects& derived, QWidget* parent = nullptr);

 Q_SIGNALS:
  /// Requests to show the middle of a region, a point in patient space (mm).
  void placeChosen(const std::string& frameOfReferenceUid, glm::dvec3 pPatient);
  /// Requests to edit the segments of these objects.
  void segmentsRequested(const QStringList& paths);

 private:
  void showAll();
  QTreeWidgetItem* addObject(const DerivedKey& key, const RegionsLook& look, bool shown);
  void addRegion(QTreeWidgetItem* parent, const RegionsLook& look, int number, const QString& text,
                 const QColor& colour);
  void addNote(QTreeWidgetItem* parent, const QString& sentence);
  void toggle(QTreeWidgetItem* item);
  void choose(QTreeWidgetItem* item);
  void showMenu(QPoint position);
  void setOpacity(int percent);

  Session& session_;
  DerivedObjects& derived_;
  QLabel* empty_;
  QTreeWidget* list_;
  QSlider* opacity_;
};

/// Returns the default look of a structure set or a segmentation.
RegionsLook firstLook(const DerivedObject& object);

}  // namespace volumen
