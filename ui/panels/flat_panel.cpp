#include "ui/panels/flat_panel.h"

#include <QHBoxLayout>
#include <QMenu>
#include <QSignalBlocker>
#include <QVBoxLayout>
#include <cmath>

#include "results/text/series_text.h"
#include "results/text/text.h"
#include "ui/panels/flat_menus.h"
#include "ui/panels/slab_menu.h"
#include "ui/tools/tool.h"
#include "ui/widgets/plain_text.h"
#include "ui/workspace/view_window.h"

namespace volumen {

namespace {

constexpr int overlayNameWidth = 150;  // logical pixels; the tool tip has the whole name

QVBoxLayout* columnOf(QWidget* part) {
  auto* column = new QVBoxLayout(part);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(4);
  return column;
}

// Makes a part of the panel with a title.
QWidget* partOf(const QString& title) {
  auto* part = new QWidget;
  auto* heading = plainLabel(title);
  QFont bold = heading->font();
  bold.setBold(true);
  heading->setFont(bold);
  columnOf(part)->addWidget(heading);
  return part;
}

QComboBox* comboOf(const char* name, const QString& accessible) {
  auto* box = new QComboBox;
  box->setObjectName(QLatin1String(name));
  box->setAccessibleName(accessible);
  box->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  box->setMinimumContentsLength(12);
  return box;
}

void addColourMaps(QComboBox* box) {
  for (const ColourMap map : colourMaps()) box->addItem(colourMapText(map));
}

int indexOfMap(ColourMap map) {
  const auto maps = colourMaps();
  return int(std::ranges::find(maps, map) - maps.begin());
}

QLabel* sentence(const char* name, const QString& text) {
  auto* label = plainLabel(text);
  label->setObjectName(QLatin1String(name));
  label->setWordWrap(true);
  label->setEnabled(false);
  return label;
}

QLayout* labelledRow(const QString& label, QWidget* field) {
  auto* row = new QHBoxLayout;
  row->setSpacing(8);
  auto* caption = plainLabel(label);
  caption->setBuddy(field);
  row->addWidget(caption);
  row->addWidget(field, 1);
  return row;
}

QStringList textsIn(const QComboBox* box) {
  QStringList texts;
  for (int n = 0; n < box->count(); ++n) texts << box->itemText(n);
  return texts;
}

}  // namespace

FlatPanel::FlatPanel(Session& session, FlatInFocus focus, QMenu* overlays, QWidget* parent)
    : QWidget(parent), session_(session), focus_(std::move(focus)) {
  window_ = makeWindow();
  colours_ = makeColours();
  overlay_ = makeOverlay(overlays);
  slab_ = makeSlab();
  facts_ = plainLabel();
  facts_->setObjectName(QStringLiteral("flatFacts"));
  facts_->setWordWrap(true);
  facts_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  QWidget* series = partOf(tr("Series"));
  series->layout()->addWidget(facts_);
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(8, 8, 8, 8);
  column->setSpacing(10);
  noSlab_ = sentence("noSlab", tr("Frames are shown as acquired: slabs and overlays need slices."));
  for (QWidget* part : std::initializer_list<QWidget*>{window_, colours_, overlay_, slab_, noSlab_, series})
    column->addWidget(part);
  column->addStretch();
  followSession();
}

QWidget* FlatPanel::makeWindow() {
  choice_ = comboOf("flatWindowChoice", tr("Window"));
  values_ = new ValueFields(QStringLiteral("flat"), true);
  inverted_ = new QCheckBox(tr("Inverted"));
  inverted_->setObjectName(QStringLiteral("flatInverted"));
  inverted_->setToolTip(toolTipOf(tr("Bright where it would be dark (I)")));
  noWindow_ = sentence("noWindow", tr("Colours are shown as they are: there is no window to set."));
  QWidget* part = partOf(tr("Window"));
  for (QWidget* each : std::initializer_list<QWidget*>{choice_, values_, inverted_, noWindow_})
    part->layout()->addWidget(each);
  connect(choice_, &QComboBox::activated, this, [this](int n) {
    session_.endGesture();
    focus_.chooseWindow(n);
    session_.endGesture();
  });
  connect(values_, &ValueFields::edited, this, &FlatPanel::setWindow);
  connect(values_, &ValueFields::gestureFinished, &session_, &Session::endGesture);
  connect(inverted_, &QCheckBox::clicked, this, [this] { focus_.invert(); });
  return part;
}

QWidget* FlatPanel::makeColours() {
  colourMap_ = comboOf("flatColours", tr("Colour map"));
  addColourMaps(colourMap_);
  interpolated_ = new QCheckBox(interpolationText(ViewKind::axial));
  interpolated_->setObjectName(QStringLiteral("flatInterpolated"));
  QWidget* part = partOf(tr("Colours and pixels"));
  part->layout()->addWidget(colourMap_);
  part->layout()->addWidget(interpolated_);
  connect(colourMap_, &QComboBox::activated, this, [this](int n) {
    if (!shown_) return;
    session_.endGesture();
    session_.change(tr("Colour map"), [&](Workspace& w) {
      w.series.edit(w.view(shown_->view).series).colours = colourMaps()[std::size_t(n)];
    });
  });
  connect(interpolated_, &QCheckBox::clicked, this, [this](bool on) { setInterpolated(session_, on); });
  return part;
}

QWidget* FlatPanel::makeOverlay(QMenu* overlays) {
  overlayName_ = new QToolButton;
  overlayName_->setObjectName(QStringLiteral("overlayButton"));
  overlayName_->setAccessibleName(tr("Series over this one"));
  overlayName_->setPopupMode(QToolButton::InstantPopup);
  overlayName_->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
  overlayName_->setMenu(overlays);
  overlayColours_ = comboOf("overlayColours", tr("Colours of the overlay"));
  addColourMaps(overlayColours_);
  overlayValues_ = new ValueFields(QStringLiteral("overlay"), false);
  opacity_ =
      new NumberRow(tr("Opacity"), {.low = 0, .high = 100, .decimals = 0, .suffix = QStringLiteral(" %")});
  opacity_->setObjectName(QStringLiteral("overlayOpacityRow"));
  overlayParts_ = new QWidget;
  QVBoxLayout* parts = columnOf(overlayParts_);
  for (QWidget* each : std::initializer_list<QWidget*>{overlayColours_, overlayValues_, opacity_})
    parts->addWidget(each);
  QWidget* part = partOf(tr("Overlay"));
  part->layout()->addWidget(overlayName_);
  part->layout()->addWidget(overlayParts_);
  connect(overlayColours_, &QComboBox::activated, this, [this](int n) {
    session_.endGesture();
    editLooks(tr("Overlay colours"),
              [map = colourMaps()[std::size_t(n)]](FlatLook& look) { look.overlayColours = map; });
  });
  connect(overlayValues_, &ValueFields::edited, this, &FlatPanel::setOverlayWindow);
  connect(overlayValues_, &ValueFields::gestureFinished, &session_, &Session::endGesture);
  connect(opacity_, &NumberRow::valueEdited, this, [this](double percent) {
    const QString what = tr("Overlay opacity");
    editLooks(
        what, [percent](FlatLook& look) { look.overlayOpacity = percent / 100; }, what);
  });
  connect(opacity_, &NumberRow::gestureFinished, &session_, &Session::endGesture);
  return part;
}

QWidget* FlatPanel::makeSlab() {
  slabMm_ = new QDoubleSpinBox;
  slabMm_->setObjectName(QStringLiteral("flatSlab"));
  slabMm_->setAccessibleName(tr("Thickness of the slab"));
  slabMm_->setRange(0, thickestMm);
  slabMm_->setDecimals(1);
  slabMm_->setSuffix(tr(" mm"));
  slabMm_->setKeyboardTracking(false);
  slabMm_->setMinimumWidth(64);
  slabMode_ = comboOf("flatSlabMode", tr("Mode of the slab"));
  for (const SlabModeRow& row : slabModes()) slabMode_->addItem(row.text);
  QWidget* part = partOf(tr("Slab"));
  auto* column = static_cast<QVBoxLayout*>(part->layout());
  column->addLayout(labelledRow(tr("Thickness"), slabMm_));
  column->addWidget(slabMode_);
  connect(slabMm_, &QDoubleSpinBox::valueChanged, this, [this](double mm) {
    if (shown_) editFlat(session_, shown_->view, tr("Slab"), [mm](FlatLook& look) { look.slabMm = mm; });
  });
  connect(slabMm_, &QDoubleSpinBox::editingFinished, &session_, &Session::endGesture);
  connect(slabMode_, &QComboBox::activated, this, [this](int n) {
    if (shown_) chooseSlabMode(session_, shown_->view, slabModes()[std::size_t(n)].mode);
  });
  return part;
}

void FlatPanel::followSession() {
  connect(
      &session_, &Session::workspaceChanged, this, [this](const Workspace& before, const Workspace& after) {
        const LoadedSeriesPtr last = shown_ ? shown_->series : nullptr;
        const bool came =
            shown_ && !showsFrames(after.view(shown_->view).kind) && session_.seriesOf(shown_->view) != last;
        if (came || showsOther(before, after) || before.series != after.series) refresh();
      });
  connect(&session_, &Session::preferencesChanged, this, &FlatPanel::refresh);
  refresh();
}

void FlatPanel::showEvent(QShowEvent* event) {
  QWidget::showEvent(event);
  refresh();
}

void FlatPanel::setWatched(bool watched) {
  isWatched_ = watched;
  refresh();
}

void FlatPanel::refresh() {
  if (!isWatched_ || !isVisible()) return;  // skips work while a clip plays unseen
  shown_ = focus_.shown();
  setEnabled(shown_ && shown_->series);
  if (!shown_ || !shown_->series) return;
  const Series& series = *seriesIn(session_.workspace(), shown_->view);
  const LoadedSeriesPtr held = session_.seriesOf(shown_->view);
  facts_->setText(factsOf(series, held ? held->warnings : series.warnings).join(QLatin1Char('\n')));
  showWindow(*shown_);
  showOverlay(*shown_);
  showSlab(*shown_);
}

void FlatPanel::showWindow(const FlatShown& shown) {
  const ViewState& view = session_.workspace().view(shown.view);
  const bool any = shown.window.has_value();
  for (QWidget* part : std::initializer_list<QWidget*>{choice_, values_, inverted_, colourMap_})
    part->setVisible(any);
  noWindow_->setVisible(!any);
  interpolated_->setText(interpolationText(view.kind));
  interpolated_->setChecked(!flatLookOf(view).nearest);
  if (!any) return;
  if (textsIn(choice_) != shown.windows) {
    choice_->clear();
    choice_->addItems(shown.windows);
  }
  choice_->setCurrentIndex(shown.chosen);
  choice_->setPlaceholderText(tr("as set"));
  values_->setWindow(*shown.window, shown.series->series);
  inverted_->setChecked(flatLookOf(view).inverted);
  colourMap_->setCurrentIndex(indexOfMap(session_.workspace().series.at(view.series).colours));
}

void FlatPanel::showOverlay(const FlatShown& shown) {
  const Workspace& workspace = session_.workspace();
  overlay_->setVisible(showsSlices(workspace.view(shown.view).kind));
  const FlatLook look = flatLookOf(workspace.view(shown.view));
  const auto over = workspace.series.find(look.overlay);
  const bool any = over != workspace.series.end();
  const QString name = any ? seriesText(*over->second.series) : tr("None");
  overlayName_->setText(overlayName_->fontMetrics()
                            .elidedText(name, Qt::ElideMiddle, overlayNameWidth)
                            .replace(QLatin1Char('&'), QStringLiteral("&&")));
  overlayName_->setToolTip(toolTipOf(name));
  overlayParts_->setVisible(any);
  // An existing overlay comes first, so that all its controls are visible without scrolling.
  auto* column = static_cast<QVBoxLayout*>(layout());
  if (const int place = any ? 0 : 2; column->indexOf(overlay_) != place) {
    column->removeWidget(overlay_);
    column->insertWidget(place, overlay_);
  }
  if (!any) return;
  overlayColours_->setCurrentIndex(indexOfMap(look.overlayColours));
  opacity_->setValue(100 * look.overlayOpacity);
  const LoadedSeriesPtr loaded = session_.seriesNamed(look.overlay);
  overlayValues_->setEnabled(loaded != nullptr);
  if (loaded) overlayValues_->setWindow(overlayWindow(over->second, *loaded), loaded->series);
}

void FlatPanel::showSlab(const FlatShown& shown) {
  const ViewState& view = session_.workspace().view(shown.view);
  slab_->setVisible(showsSlices(view.kind));
  noSlab_->setVisible(!showsSlices(view.kind));
  const FlatLook look = flatLookOf(view);
  const QSignalBlocker quiet(slabMm_);
  slabMm_->setValue(look.slabMm);
  const std::vector<SlabModeRow> modes = slabModes();
  slabMode_->setCurrentIndex(
      int(std::ranges::find(modes, look.slabMode, &SlabModeRow::mode) - modes.begin()));
}

void FlatPanel::setWindow(WindowEnds ends) {
  if (!shown_) return;
  const QString what = tr("Window");
  session_.change(
      what, [&](Workspace& w) { volumen::setWindow(w, shown_->view, windowBetween(ends)); }, what);
}

void FlatPanel::setOverlayWindow(WindowEnds ends) {
  const SeriesKey over = shown_ ? flatLookOf(session_.workspace().view(shown_->view)).overlay : SeriesKey();
  const LoadedSeriesPtr loaded = session_.seriesNamed(over);
  if (!loaded) return;
  const QString what = tr("Window");
  session_.change(
      what,
      [&](Workspace& w) {
        SeriesState& state = w.series.edit(over);
        state.window = windowOfOverlay(windowBetween(ends), state, *loaded);
      },
      what);
}

void FlatPanel::editLooks(const QString& text, const std::function<void(FlatLook&)>& change,
                          const QString& mergeKey) {
  if (shown_) session_.change(text, withFlatLooks(session_.workspace(), shown_->view, change), mergeKey);
}

}  // namespace volumen
