#pragma once

#include <QLabel>
#include <QSlider>
#include <QToolButton>
#include <QTreeWidget>

#include "ui/controller/segment_editing.h"
#include "ui/derivations/segment_numbers.h"
#include "ui/widgets/colour_button.h"

namespace volumen {

/// The segments of the series in view, with visibility, lock, colour, name, volume in ml, and map if there
/// are several. Adds, copies, moves and removes them. Tools and steps change the segment of the current row,
/// in its map.
class SegmentList : public QWidget {
  Q_OBJECT
 public:
  SegmentList(SegmentEditing& editing, const SegmentNumbers& numbers, QWidget* parent = nullptr);

  void showSegments();

 protected:
  void resizeEvent(QResizeEvent*) override { showRoom(); }

 private:
  void makeLayout();
  void connectButtons();
  void showRoom();
  void showRow(QTreeWidgetItem* item, const SegmentMap& map, const Segment& segment);
  void showButtons();
  QString amountText(const SegmentMap& map, int number) const;
  void showMaps(bool areSeveral);
  void showMenu(QPoint at);
  void itemChanged(QTreeWidgetItem* item, int column);
  void showSegment(bool isOn, const SegmentMap& map, const Segment& segment);
  void edit(const QString& text, int map, int number, const std::function<void(Segment&)>& change);
  void editCurrent(const QString& text, const std::function<void(Segment&)>& change, const QString& mergeKey);
  void choose(const QTreeWidgetItem* item);
  void add();
  void duplicate();
  void remove();

  SegmentEditing& editing_;
  Session& session_;
  const SegmentNumbers& numbers_;
  QTreeWidget* list_;
  QLabel* worked_;  // names the current map if there are several
  QToolButton *add_, *duplicate_, *remove_;
  ColourButton* colour_;
  QSlider* opacity_;
};

}  // namespace volumen
