#pragma once

#include <QLabel>
#include <QSlider>
#include <QTreeWidget>

#include "ui/controller/derived_objects.h"
#include "ui/workspace/session.h"

namespace volumen {

/// Structure sets and segmentations, each with its regions: which of them flat views show.
class RegionsPanel : public QWidget {
  Q_OBJECT
 public:
  RegionsPanel(Session& session, DerivedObjects& derived, QWidget* parent = nullptr);

 Q_SIGNALS:
  /// The middle of a region is to be seen.
  void placeChosen(const std::string& frameOfReferenceUid, glm::dvec3 pPatient);
  /// Segments of these objects are to be edited.
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

/// How a structure set or a segmentation is shown at first.
RegionsLook firstLook(const DerivedObject& object);

}  // namespace volumen
