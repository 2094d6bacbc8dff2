#include "ui/panels/flat_panel.h"

#include <QMenu>
#include <QVBoxLayout>

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
constexpr int leastLetters = 12;       // of lists

// Makes a part of the panel with a title.
QWidget* partOf(const QString& title, std::vector<LayoutPart> parts) {
  auto* part = new QWidget;
  auto* heading = plainLabel(title);
  QFont bold = heading->font();
  bold.setBold(true);
  heading->setFont(bold);
  parts.insert(parts.begin(), heading);
  stack(part, parts);
  return part;
}

QComboBox* coloursField(const QString& name, const QString& label) {
  QStringList texts;
  for (const ColourMap map : colourMaps()) texts << colourMapText(map);
  return choiceField({name, label}, texts, leastLetters);
}

template <class Whole>
Lens<Whole, int> mapIndex(const Lens<Whole, ColourMap>& lens) {
  const auto maps = colourMaps();
  return among(lens, std::vector<ColourMap>(maps.begin(), maps.end()));
}

QLabel* greySentence(const QString& name, const QString& text) {
  QLabel* label = wrappedLabel(name, text);
  label->setEnabled(false);
  return label;
}

}  // namespace

FlatPanel::FlatPanel(Session& session, FlatInFocus focus, QMenu* overlays, QWidget* parent)
    : QWidget(parent), session_(session), focus_(std::move(focus)) {
  facts_ = wrappedLabel(QStringLiteral("flatFacts"));
  facts_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  noSlab_ = greySentence(QStringLiteral("noSlab"),
                         tr("Frames are shown as acquired: slabs and overlays need slices."));
  stack(this,
        {makeWindow(),
         makeColours(),
         makeOverlay(overlays),
         makeSlab(),
         noSlab_,
         partOf(tr("Series"), {facts_}),
         {}},
        8, 10);
  followSession();
}

Source<FlatLook> FlatPanel::looks(bool ofAllPlanes) {
  return {.edit =
              [this, ofAllPlanes](const QString& what, const auto& change) {
                if (shown_ && ofAllPlanes)
                  session_.change(what, withFlatLooks(session_.workspace(), shown_->view, change), what);
                else if (shown_)
                  editFlat(session_, shown_->view, what, change);
              },
          .done = [this] { session_.endGesture(); },
          .follow = [this](QObject*, const Follower<FlatLook>& show) { lookFollowers_.push_back(show); }};
}

QWidget* FlatPanel::makeWindow() {
  choice_ = choiceField({QStringLiteral("flatWindowChoice"), tr("Window")}, {}, leastLetters);
  values_ = new ValueFields(QStringLiteral("flat"), ValueFields::Which::all);
  inverted_ =
      flagField({QStringLiteral("flatInverted"), tr("Inverted"), tr("Bright where it would be dark (I)")});
  noWindow_ = greySentence(QStringLiteral("noWindow"),
                           tr("Colours are shown as they are: there is no window to set."));
  connect(choice_, &QComboBox::activated, this, [this](int n) {
    session_.endGesture();
    focus_.chooseWindow(n);
    session_.endGesture();
  });
  connect(values_, &ValueFields::edited, this, &FlatPanel::setWindow);
  connect(values_, &ValueFields::gestureFinished, &session_, &Session::endGesture);
  connect(inverted_, &QCheckBox::clicked, this, [this] { focus_.invert(); });
  return partOf(tr("Window"), {choice_, values_, inverted_, noWindow_});
}

QWidget* FlatPanel::makeColours() {
  const Source<SeriesState> series{
      .edit =
          [this](const QString& what, const auto& change) {
            if (shown_)
              session_.change(
                  what, [&](Workspace& w) { change(w.series.edit(w.view(shown_->view).series)); }, what);
          },
      .done = [this] { session_.endGesture(); },
      .follow = [this](QObject*, const Follower<SeriesState>& show) { seriesFollowers_.push_back(show); }};
  colourMap_ = series.bind(coloursField(QStringLiteral("flatColours"), tr("Colour map")), tr("Colour map"),
                           mapIndex(at(&SeriesState::colours)));
  interpolated_ =
      looks(true).bind(flagField({QStringLiteral("flatInterpolated"), interpolationText(ViewKind::axial)}),
                       tr("Interpolation"),
                       Lens<FlatLook, bool>{[](const FlatLook& look) { return !look.nearest; },
                                            [](FlatLook& look, bool on) { look.nearest = !on; }});
  return partOf(tr("Colours and pixels"), {colourMap_, interpolated_});
}

QWidget* FlatPanel::makeOverlay(QMenu* overlays) {
  overlayName_ = buttonOf(QStringLiteral("overlayButton"));
  overlayName_->setAccessibleName(tr("Series over this one"));
  overlayName_->setPopupMode(QToolButton::InstantPopup);
  overlayName_->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
  overlayName_->setMenu(overlays);
  overlayValues_ = new ValueFields(QStringLiteral("overlay"), ValueFields::Which::ends);
  auto* opacity =
      new NumberRow(tr("Opacity"), {.low = 0, .high = 100, .decimals = 0, .suffix = QStringLiteral(" %")});
  opacity->setObjectName(QStringLiteral("overlayOpacityRow"));
  overlayParts_ = new QWidget;
  stack(overlayParts_,
        {looks(true).bind(coloursField(QStringLiteral("overlayColours"), tr("Colours of the overlay")),
                          tr("Overlay colours"), mapIndex(at(&FlatLook::overlayColours))),
         overlayValues_,
         looks(true).bind(opacity, tr("Overlay opacity"), percent(at(&FlatLook::overlayOpacity)))});
  connect(overlayValues_, &ValueFields::edited, this, &FlatPanel::setOverlayWindow);
  connect(overlayValues_, &ValueFields::gestureFinished, &session_, &Session::endGesture);
  return overlay_ = partOf(tr("Overlay"), {overlayName_, overlayParts_});
}

QWidget* FlatPanel::makeSlab() {
  QStringList texts;
  std::vector<SlabMode> modes;
  for (const SlabModeRow& row : slabModes()) texts << row.text, modes.push_back(row.mode);
  const Lens<FlatLook, SlabMode> mode{[](const FlatLook& look) { return look.slabMode; }, setSlabMode};
  auto* mm = looks(false).bind(thicknessField(QStringLiteral("flatSlab")), tr("Slab"), at(&FlatLook::slabMm));
  auto* box = choiceField({QStringLiteral("flatSlabMode"), tr("Mode of the slab")}, texts, leastLetters);
  return slab_ = partOf(tr("Slab"), {lineOf({captionOf(tr("Thickness"), mm), {mm, 1}}, 8),
                                     looks(false).bind(box, tr("Slab"), among(mode, modes))});
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
  const ViewState& view = session_.workspace().view(shown_->view);
  slab_->setVisible(showsSlices(view.kind));
  noSlab_->setVisible(!showsSlices(view.kind));
  for (const auto& show : lookFollowers_) show(flatLookOf(view));
  for (const auto& show : seriesFollowers_) show(session_.workspace().series.at(view.series));
}

void FlatPanel::showWindow(const FlatShown& shown) {
  const ViewState& view = session_.workspace().view(shown.view);
  const bool any = shown.window.has_value();
  for (QWidget* part : std::initializer_list<QWidget*>{choice_, values_, inverted_, colourMap_})
    part->setVisible(any);
  noWindow_->setVisible(!any);
  interpolated_->setText(interpolationText(view.kind));
  if (!any) return;
  setItems(choice_, shown.windows);
  choice_->setCurrentIndex(shown.chosen);
  choice_->setPlaceholderText(tr("as set"));
  values_->setWindow(*shown.window, shown.series->series);
  inverted_->setChecked(flatLookOf(view).inverted);
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
  const LoadedSeriesPtr loaded = session_.seriesNamed(look.overlay);
  overlayValues_->setEnabled(loaded != nullptr);
  if (loaded) overlayValues_->setWindow(overlayWindow(over->second, *loaded), loaded->series);
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

}  // namespace volumen
