#pragma once

#include <QCheckBox>
#include <QLabel>
#include <QPushButton>
#include <QStackedWidget>
#include <QToolButton>

#include "ui/panels/segment_grow_page.h"
#include "ui/panels/segment_list.h"
#include "ui/panels/segment_paint_page.h"
#include "ui/panels/segment_range.h"
#include "ui/panels/segment_steps_page.h"
#include "ui/panels/segment_tissue.h"
#include "viewer/recipe/recipe.h"

namespace volumen {

/// The segments of the series in view: the list and the numbers of the current one. Pages below make segments
/// from the curve, paint, grow and change them. Requests changes that take time.
class SegmentsPanel : public QWidget {
  Q_OBJECT
 public:
  /// `numbers` follow segmentNumbersRule().
  SegmentsPanel(SegmentEditing& editing, const SegmentNumbers& numbers, QWidget* parent = nullptr);

  /// Shows the segments of the series in view.
  void showSegments();
  /// Set actions of the panel: tools by name, table removal and export.
  void setToolActions(const std::function<QAction*(const QString& name)>& find);
  void setTableAction(QAction* action) { range_->setTableAction(action); }
  void setExportAction(QAction* action);
  /// Sets the actions listed after the built-in recipes.
  void setRecipeActions(const QList<QAction*>& actions);

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
  QList<QAction*> recipeActions_;
  SegmentRange* range_;
  SegmentPaintPage* paint_;
  SegmentStepsPage* steps_;
  SegmentGrowPage* growth_;
  QStackedWidget* pages_;
};

}  // namespace volumen
