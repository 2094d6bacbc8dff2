// Guards that all texts beside a picture match it. After each of 300 random acts (real wheel, mouse and key
// events, series, layouts, steps, undo), every text is compared with a new computation. The screen is
// compared with a repaint of the window.
#include <QLabel>
#include <QScreen>
#include <QSlider>
#include <QTemporaryDir>
#include <QTreeWidget>
#include <fstream>
#include <glm/geometric.hpp>
#include <random>

#include "results/series/time_points.h"
#include "results/text/series_text.h"
#include "results/text/text.h"
#include "tests/fixtures/fixtures.h"
#include "tests/fixtures/seeds.h"
#include "tests/ui/gestures.h"
#include "tests/ui/journey.h"
#include "tests/ui/test_series.h"
#include "tests/unit/suite.h"
#include "ui/derivations/measured_numbers.h"
#include "ui/overlays/view_overlays.h"
#include "ui/views/drawn_measurement.h"
#include "ui/views/view_grid.h"
#include "ui/widgets/plain_text.h"
#include "ui/workspace/flat_plane.h"
#include "ui/workspace/link_text.h"
#include "ui/workspace/time_points.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

// Returns a DICOM-like series of blocks of values in a grid along i, j and their normal.
LoadedSeriesPtr blocks(const char* name, glm::dvec3 i, glm::dvec3 j, glm::dvec3 spacing, const char* frame) {
  constexpr int n = 24;
  auto series = std::make_shared<LoadedSeries>(*ballSeries(n));
  VolumeParts parts;
  parts.geometry.size = {n, n + 2, n - 6};
  parts.geometry.patientFromVoxelStep =
      glm::dmat3(spacing.x * i, spacing.y * j, spacing.z * glm::cross(i, j));
  parts.geometry.origin =
      -(parts.geometry.patientFromVoxelStep * (glm::dvec3(parts.geometry.size - 1) / 2.0));
  std::vector<std::int16_t> values;
  for (int c = 0; c < parts.geometry.size.z; ++c)
    for (int b = 0; b < parts.geometry.size.y; ++b)
      for (int a = 0; a < parts.geometry.size.x; ++a)
        values.push_back(std::int16_t(a / 3 * 10 + b / 3 * 100 + c * 3));
  parts.values = std::move(values);
  std::vector<std::string> warnings;
  series->volume = *Volume::make(std::move(parts), warnings);
  series->series.acquired = series->volume->geometry();
  series->series.description = name;
  series->series.studyDate = "20260314";
  series->series.studyTime = "102231.5";
  series->series.patientSex = "F";
  series->series.patientAge = "045Y";
  series->series.frameOfReferenceUid = frame;
  series->series.warnings = {{std::string("What is to be known of ") + name + ".", WarningKind::other}};
  series->warnings = series->series.warnings;
  series->histogram.high = 1200;
  series->window = {500, 1000};
  for (int slice = 0; slice < parts.geometry.size.z; ++slice) {
    series->series.files.push_back("/nowhere/" + std::to_string(slice));
    series->series.frames.push_back(0);
    series->series.sopInstanceUids.push_back(std::string(name) + '.' + std::to_string(slice));
  }
  return series;
}

// Returns where pictures differ beyond the rounding of antialiased edges, which depends on the painted area
// (11 was seen). A different word differs by more than 100.
QRect differing(const QImage& a, const QImage& b) {
  constexpr int rounding = 24;
  QRect differ;
  for (int y = 0; y < a.height(); ++y)
    for (int x = 0; x < a.width(); ++x) {
      const QRgb p = a.pixel(x, y), q = b.pixel(x, y);
      if (std::abs(qRed(p) - qRed(q)) > rounding || std::abs(qGreen(p) - qGreen(q)) > rounding ||
          std::abs(qBlue(p) - qBlue(q)) > rounding)
        differ |= QRect(x, y, 1, 1);
    }
  return differ;
}

class Hand : public Journey {
 public:
  explicit Hand(unsigned seed) : chance_(seed) {
    const double c = std::cos(0.4), s = std::sin(0.4);
    all_ = {blocks("Straight", {1, 0, 0}, {0, 1, 0}, {1, 1, 2}, "A"),
            blocks("Sagittal", {0, 1, 0}, {0, 0, -1}, {1, 1, 3}, "A"),
            blocks("Oblique", {c, s, 0}, {0, 0, -1}, {1, 1.5, 2.5}, "A"),
            blocks("Elsewhere", {1, 0, 0}, {0, c, s}, {2, 2, 2}, "B")};
    window.resize(1100, 760);
    for (const LoadedSeriesPtr& series : all_) session().show(series);
    child<QAction>("layoutPlanes")->trigger();
  }

  Session& session() { return window.session(); }
  const Workspace& workspace() { return session().workspace(); }

  // Does one random act and returns its description.
  QByteArray act() {
    const std::vector<ViewId> ids = viewsOnScreen(workspace());
    const ViewId id = ids[std::size_t(below(int(ids.size())))];
    View* view = viewOf(id);
    switch (below(12)) {
      case 0:
      case 1:
      case 2: {
        const Qt::KeyboardModifiers keys[] = {{}, {}, {}, Qt::ControlModifier, Qt::AltModifier};
        const int notches = 1 + below(3);
        turnWheel(view, below(2) ? notches : -notches, keys[below(5)]);
        return "wheel";
      }
      case 3:
      case 4:
        pointAt(view, anyPlace(view));
        hover(view, pointed_->second);
        return "move";
      case 5: {
        const int keys[] = {Qt::Key_Up,  Qt::Key_Down, Qt::Key_PageUp, Qt::Key_PageDown, Qt::Key_Home,
                            Qt::Key_End, Qt::Key_Left, Qt::Key_Right,  Qt::Key_I,        Qt::Key_K,
                            Qt::Key_1,   Qt::Key_2,    Qt::Key_0,      Qt::Key_F};
        session().setFocus(id);
        QTest::keyClick(viewOf(id), Qt::Key(keys[below(14)]));
        return "key";
      }
      case 6: {
        const Qt::MouseButton buttons[] = {Qt::LeftButton, Qt::LeftButton, Qt::MiddleButton, Qt::RightButton};
        const QPointF from = anyPlace(view), to = anyPlace(view);
        pointAt(view, to);
        drag(view, from, to, buttons[below(4)], below(4) ? Qt::NoModifier : Qt::ShiftModifier);
        return "drag";
      }
      case 7:
        session().show(all_[std::size_t(below(int(all_.size())))], id);
        return "series";
      case 8: {
        const char* layouts[] = {"layoutOne", "layoutPlanes", "layoutBesidePlanes", "layoutTwo",
                                 "layoutFour"};
        child<QAction>(layouts[below(5)])->trigger();
        return "layout";
      }
      case 9: {
        const char* kinds[] = {"showAxial",   "showCoronal",      "showSagittal", "show3D",
                               "alignPlanes", "straightenPlanes", "linkScroll",   "interpolate"};
        QAction* action = child<QAction>(kinds[below(8)]);
        if (action->isEnabled()) action->trigger();
        return "menu";
      }
      case 10:
        child<QAction>(below(3) ? "undo" : "redo")->trigger();
        return "undo";
      default:
        if (below(3) == 0) {
          child<QAction>("hideNames")->trigger();
          return "names";
        }
        measure(view);
        return "measure";
    }
  }

  View* viewOf(ViewId id) {
    View* flat = window.views()->viewAs<FlatView>(id);
    return flat ? flat : window.views()->volumeView(id);
  }
  FlatView* slices(ViewId id) {
    FlatView* view = window.views()->viewAs<FlatView>(id);
    return view && view->isVisible() && view->shown() ? view : nullptr;
  }
  QString said() { return child<QLabel>("hoverText")->text(); }
  std::optional<std::pair<View*, QPointF>> pointed() {
    // A view that was hidden has no pointer. It must move first once the view returns.
    if (pointed_ && !pointed_->first->isVisible()) pointed_.reset();
    return pointed_;
  }
  // Returns where the screen differs from a repaint once all pictures are there. 3D views are left out
  // because they are still being drawn.
  QRect staleOnScreen() {
    QRect stale;
    const auto same = [&] {
      QImage now =
          window.screen()->grabWindow(window.winId()).toImage().convertToFormat(QImage::Format_RGB32);
      QImage anew = window.grab().toImage().convertToFormat(QImage::Format_RGB32);
      stale = anew.rect();
      if (now.size() != anew.size()) return false;
      const auto covered = [&](QImage& image) {
        for (const VolumeView* view : window.findChildren<VolumeView*>()) {
          if (!view->isVisible()) continue;
          QPainter(&image).fillRect(QRect(view->mapTo(&window, QPoint(0, 0)), view->QWidget::size()),
                                    Qt::black);
        }
      };
      covered(now);
      covered(anew);
      stale = differing(now, anew);
      return stale.isEmpty();
    };
    return QTest::qWaitFor(same, 10000) ? QRect() : stale;
  }

 private:
  int below(int n) { return int(chance_() % unsigned(n)); }
  QPointF anyPlace(const QWidget* view) {
    return {double(5 + below(view->width() - 10)), double(5 + below(view->height() - 10))};
  }
  // Moves the pointer to a view and leaves the previous one.
  void pointAt(View* view, QPointF at) {
    QEvent leave(QEvent::Leave);
    if (pointed_ && pointed_->first != view) QCoreApplication::sendEvent(pointed_->first, &leave);
    pointed_ = {view, at};
  }
  // Turns the wheel at the pointer, after moving it to the view if necessary.
  void turnWheel(View* view, int notches, Qt::KeyboardModifiers keys) {
    if (!pointed_ || pointed_->first != view) {
      pointAt(view, anyPlace(view));
      hover(view, pointed_->second);
    }
    QWheelEvent event(pointed_->second, view->mapToGlobal(pointed_->second), {}, {0, 120 * notches},
                      Qt::NoButton, keys, Qt::NoScrollPhase, false);
    QCoreApplication::sendEvent(view, &event);
  }
  void measure(View* view) {
    if (!qobject_cast<FlatView*>(view)) return;
    QTest::keyClick(view, below(2) ? Qt::Key_D : Qt::Key_E);
    const QPointF from = anyPlace(view), to = anyPlace(view);
    pointAt(view, to);
    drag(view, from, to);
  }

  std::mt19937 chance_;
  std::vector<LoadedSeriesPtr> all_;
  std::optional<std::pair<View*, QPointF>> pointed_;
};

SlicePlane planeOf(const Workspace& w, ViewId id, const LoadedSeries& shown, glm::ivec2 pixels) {
  return flatPlane(w.view(id), flatLookOf(w.view(id)), shown.volume->geometry(), crosshairOf(w, id, shown),
                   pixels);
}

// Returns the expected status line for a position in a slice: the nearest voxel's value and position.
QString valueAt(const LoadedSeries& shown, glm::dvec3 p) {
  const Volume& volume = *shown.volume;
  const glm::ivec3 v(glm::floor(volume.geometry().voxelFromPatient(p) + 0.5));
  if (glm::any(glm::lessThan(v, glm::ivec3(0))) || glm::any(glm::greaterThanEqual(v, volume.size())))
    return {};
  return QStringLiteral("%1 HU at %2").arg(volume.value(v.x, v.y, v.z)).arg(placeText(p));
}

// Returns the expected corner text of a plane: its name and the number of its acquired slice.
QStringList planeSaid(const LoadedSeries& shown, ViewKind kind, const SlicePlane& plane) {
  const VoxelGeometry& geometry = shown.volume->geometry();
  const glm::dvec3 k = glm::normalize(geometry.patientFromVoxelStep[2]);
  const double at = geometry.voxelFromPatient(plane.centre).z;
  const QString name = kind == ViewKind::axial     ? QStringLiteral("Axial")
                       : kind == ViewKind::coronal ? QStringLiteral("Coronal")
                                                   : QStringLiteral("Sagittal");
  const bool along = std::abs(glm::dot(k, plane.normal())) > 1 - 1e-6;
  if (along && std::abs(at - std::round(at)) < 1e-3 && at > -0.5 && at < geometry.size.z - 0.5)
    return {name, QStringLiteral("%1 / %2").arg(std::lround(at) + 1).arg(geometry.size.z)};
  return {name + QStringLiteral(", reformatted")};
}

// Each function returns what is wrong, or an empty text. `seen` counts the comparisons.

QString wrongCorner(Hand& w, int& seen) {
  const Workspace& now = w.workspace();
  for (const ViewId id : viewsOnScreen(now)) {
    FlatView* view = w.slices(id);
    if (!view) continue;
    const LoadedSeriesPtr shown = view->series();
    const glm::ivec2 pixels(view->pixels().width(), view->pixels().height());
    const SlicePlane plane = planeOf(now, id, *shown, pixels);
    if (*view->plane() != plane) return QStringLiteral("another plane");
    const Overlays over = view->overlays();
    const QStringList right = planeSaid(*shown, now.view(id).kind, plane);
    const QString date =
        namesHidden() ? QStringLiteral("(date hidden)") : QStringLiteral("2026-03-14 10:22:31");
    const QStringList left{patientText(shown->series), date, QStringLiteral("F, 45 y"),
                           seriesText(shown->series)};
    if (over.topRight.mid(0, right.size()) != right || over.topLeft.mid(0, left.size()) != left)
      return (over.topLeft + over.topRight).join(QLatin1Char('|'));
    ++seen;
  }
  return {};
}

QString wrongHover(Hand& w, int& seen) {
  const QString said = w.said();
  const auto pointed = w.pointed();
  if (!pointed) return said;
  const auto* view = qobject_cast<FlatView*>(pointed->first);
  if (!pointed->first->series()) return said;
  if (view && view->drawnMeasurements().empty()) {
    const QPointF at = pointed->second * view->devicePixelRatioF();
    const QString value = valueAt(*view->series(), view->plane()->patientFromPixel({at.x(), at.y()}));
    if (said != value) return QStringLiteral("'%1' for '%2'").arg(said, value);
    if (!value.isEmpty()) ++seen;
  }
  hover(pointed->first, pointed->second);
  return w.said() == said ? QString() : QStringLiteral("'%1' for '%2'").arg(said, w.said());
}

QString wrongPanel(Hand& w) {
  const Workspace& now = w.workspace();
  if (!seriesIn(now, now.focus)) return {};
  const Series& focus = *seriesIn(now, now.focus);
  const QString title = patientText(focus) + QStringLiteral(" - ") + seriesText(focus);
  if (!w.window.windowTitle().startsWith(title)) return w.window.windowTitle();
  const QString warning = w.child<QLabel>("warningText")->toolTip();
  if (!warning.contains(shownText(focus.warnings[0].sentence))) return warning;
  if (w.child<QAction>("link")->toolTip() != toolTipOf(linkSentence(now)))
    return w.child<QAction>("link")->toolTip();
  const auto* list = w.child<QTreeWidget>("measurementList");
  if (list->topLevelItemCount() != int(now.measurements.size())) return QStringLiteral("measurements");
  for (int row = 0; row < list->topLevelItemCount(); ++row) {
    const Measurement& m = now.measurements[std::size_t(row)];
    if (!list->topLevelItem(row)->text(2).contains(seriesText(*now.series.at(m.series).series)))
      return list->topLevelItem(row)->text(2);
  }
  return {};
}

}  // namespace

class TestSaid : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void theWheelTellsWhatComesUnderTheCursor();
  void everyTextFollowsFromWhatIsShown_data();
  void everyTextFollowsFromWhatIsShown();
};

void TestSaid::theWheelTellsWhatComesUnderTheCursor() {
  Hand w(1);
  FlatView* view = w.slices(w.slices(axialViewId) ? axialViewId : sagittalViewId);
  QVERIFY(view);
  const QPointF middle(view->width() / 2.0, view->height() / 2.0);
  hover(view, middle);
  const QString before = w.said();
  QVERIFY(!before.isEmpty());
  wheel(view, -2);
  QVERIFY2(w.said() != before, qPrintable(w.said()));
  const QPointF at = middle * view->devicePixelRatioF();
  QCOMPARE(w.said(), valueAt(*view->series(), view->plane()->patientFromPixel({at.x(), at.y()})));
}

void TestSaid::everyTextFollowsFromWhatIsShown_data() {
  QTest::addColumn<unsigned>("seed");
  const Seeds seeds = seedsOf(1, 5);
  for (int seed = seeds.first; seed < seeds.behindLast(); ++seed)
    QTest::addRow("seed %d", seed) << unsigned(seed);
}

void TestSaid::everyTextFollowsFromWhatIsShown() {
  QFETCH(unsigned, seed);
  constexpr int actions = 300;
  Hand w(seed);
  QVERIFY(QTest::qWaitForWindowExposed(&w.window));
  const bool readsScreen = QGuiApplication::platformName() == QStringLiteral("offscreen");
  int values = 0, corners = 0;
  for (int n = 0; n < actions; ++n) {
    const QString what = QStringLiteral("%1, %2: ").arg(n).arg(QString::fromLatin1(w.act()));
    QCoreApplication::processEvents();
    for (const QString& wrong : {wrongCorner(w, corners), wrongHover(w, values), wrongPanel(w)})
      QVERIFY2(wrong.isEmpty(), qPrintable(what + wrong));
    if (n % 5 != 0 || !readsScreen) continue;
    const QRect stale = w.staleOnScreen();
    if (!stale.isEmpty()) w.shot("stale");
    QVERIFY2(stale.isEmpty(), qPrintable(what + QStringLiteral("the screen at %1, %2, %3 x %4")
                                                    .arg(stale.x())
                                                    .arg(stale.y())
                                                    .arg(stale.width())
                                                    .arg(stale.height())));
  }
  w.session().prefer([](Preferences& p) { p.hideNames = false; });
  QVERIFY2(values > 10 && corners > 100, "what is compared was seen");
}

VOLUMEN_TEST(TestSaid);
#include "tst_said.moc"
