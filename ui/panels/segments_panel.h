#pragma once

#include <QCheckBox>
#include <QLabel>
#include <QPushButton>
#include <QStackedWidget>
#include <QToolButton>
#include <map>

#include "ui/panels/segment_grow_page.h"
#include "ui/panels/segment_list.h"
#include "ui/panels/segment_paint_page.h"
#include "ui/panels/segment_range.h"
#include "ui/panels/segment_steps_page.h"
#include "ui/panels/segment_tissue.h"
#include "ui/widgets/listed_entries.h"
#include "viewer/recipe/recipe.h"

namespace volumen {

struct Tool;

/// The segments of the series in view: the list and the numbers of the current one. Pages below make segments
/// from the curve, paint, grow and change them. Requests changes that take time.
class SegmentsPanel : public QWidget {
  Q_OBJECT
 public:
  /// `numbers` follow segmentNumbersRule().
  SegmentsPanel(SegmentEditing& editing, const SegmentNumbers& numbers, QWidget* parent = nullptr);

  /// Shows the segments of the series in view.
  void showSegments();
  /// Set actions of the panel: tools, table removal and export.
  void setToolActions(const std::map<const Tool*, QAction*>& actions);
  void setTableAction(QAction* action) { range_->setTableAction(action); }
  void setExportAction(QAction* action);
  /// Returns the menu of recipes, which lists the built-in ones before entries that others add.
  QMenu* recipeMenu() const { return recipes_->menu(); }

 Q_SIGNALS:
  void numbersWanted();
  void recipeChosen(const volumen::Recipe& recipe);
  /// The previewed range of a volume changed; empty ends the preview.
  void previewChanged(const std::optional<volumen::VolumeRange>& range);
  /// The axis of the curve is to show this range; empty for none.
  void rangeShown(const std::optional<volumen::ValueRange>& range);

 private:
  void makeLayout();
  QToolButton* pageButton(const char* name, const QString& text, QWidget* page);
  void showPage(QWidget* page);
  void fillRecipes();
  void showIn3d();
  void showResult();

  Session& session_;
  const SegmentNumbers& numbers_;
  SegmentList* list_;
  QLabel* result_;
  QCheckBox* in3d_;
  SegmentTissue* tissue_;
  QPushButton* export_;
  QToolButton* numbersButton_;
  QToolButton* recipes_;
  ListedEntries builtIn_;  // in the menu of recipes
  SegmentRange* range_;
  SegmentPaintPage* paint_;
  SegmentStepsPage* steps_;
  SegmentGrowPage* growth_;
  QStackedWidget* pages_;
};

}  // namespace volumen
