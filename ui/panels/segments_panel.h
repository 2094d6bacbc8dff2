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

/// The segments of the series in view: their list, the numbers of the current one, and below pages: what
/// makes segments of the curve, what paints the current one in slices, what grows, what changes it. All that
/// takes time is asked for.
class SegmentsPanel : public QWidget {
  Q_OBJECT
 public:
  explicit SegmentsPanel(Session& session, QWidget* parent = nullptr);

  /// Shows the segments that the series in view has, and asks for their numbers.
  void showSegments();
  /// What measureRequested() came to.
  void showMeasured(const SegmentNumbers& numbers);
  /// Its actions: the one that removes the table, the tool of connected parts, those that paint, the export.
  void setTableAction(QAction* action) { range_->setTableAction(action); }
  void setPartAction(QAction* action) { range_->setPartAction(action); }
  void setPaintActions(QAction* brush, QAction* outline, QAction* cut) {
    paint_->setToolActions(brush, outline, cut);
  }
  void setExportAction(QAction* action);
  /// Those behind the built-in recipes.
  void setRecipeActions(const QList<QAction*>& actions);
  const SegmentRange& range() const { return *range_; }
  SegmentRange& rangePage() { return *range_; }
  const SegmentPaintPage& painting() const { return *paint_; }
  SegmentGrowPage& growPage() { return *growth_; }

 Q_SIGNALS:
  void workWanted(const volumen::SegmentWork& work);
  /// A sentence on what work came to.
  void told(const QString& sentence);
  void numbersWanted();
  void recipeChosen(const volumen::Recipe& recipe);
  /// What of, without the numbers.
  void measureRequested(const volumen::SegmentNumbers& wanted);
  /// What of which volume is looked at; none: nothing.
  void previewChanged(const std::optional<volumen::VolumeRange>& range);

 private:
  void makeLayout();
  QToolButton* pageButton(const char* name, const QString& text, QWidget* page);
  void showPage(QWidget* page);
  void fillRecipes();
  void showIn3d();
  void askForNumbers();
  void showResult();

  Session& session_;
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
  std::optional<SegmentNumbers> asked_;    // the last: what of
  std::optional<SegmentNumbers> numbers_;  // of what is shown
};

}  // namespace volumen
