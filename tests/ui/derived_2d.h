#pragma once

#include <QMenu>
#include <QSlider>
#include <QTreeWidget>

#include "tests/fixtures/fixtures.h"
#include "tests/ui/gestures.h"
#include "tests/ui/journey.h"
#include "ui/views/view_grid.h"

namespace volumen::tests {

inline const char* const ct = "dicom-pydicom/test_files/CT_small.dcm";
inline const char* const presentation = "dicom-2d/made-here/pr-on-CT_small.dcm";
inline const char* const keyObjects = "dicom-2d/made-here/ko-on-CT_small.dcm";

/// A window that opens test files.
struct References2d : Journey {
  explicit References2d(const std::vector<const char*>& files) {
    window.resize(1440, 900);
    QStringList paths;
    for (const char* file : files) paths << QString::fromStdString(dataPath(file));
    window.open(paths);
  }

  Session& session() { return window.session(); }
  const Workspace& workspace() { return session().workspace(); }
  FlatView* view(ViewId id = axialViewId) { return window.views()->viewAs<FlatView>(id); }
  QTreeWidget* tree(const char* name = "studyTree") { return child<QTreeWidget>(name); }
  QTreeWidgetItem* item(const char* text, const char* list = "studyTree") {
    return tree(list)->findItems(QLatin1String(text), Qt::MatchContains | Qt::MatchRecursive).value(0);
  }
  bool has(const char* text, const char* list = "studyTree") {
    return QTest::qWaitFor([&] { return item(text, list) != nullptr; }, longest);
  }
  void click(const char* text, const char* list = "studyTree") {
    tree(list)->scrollToItem(item(text, list));
    QTest::mouseClick(tree(list)->viewport(), Qt::LeftButton, {},
                      tree(list)->visualItemRect(item(text, list)).center());
  }
  // Toggles the check box of an item.
  void tick(const char* text, const char* list) {
    tree(list)->setCurrentItem(item(text, list));
    QTest::keyClick(tree(list), Qt::Key_Space);
  }
  bool shows(const std::function<bool(const FlatView&)>& what, ViewId id = axialViewId) {
    return QTest::qWaitFor(
        [&] {
          const FlatView* v = view(id);
          return v && v->isVisible() && v->shown() && !v->picture().isNull() && what(*v);
        },
        longest);
  }
  bool showsFrame() {
    return shows([](const FlatView& v) { return frameIn(&v) != nullptr; });
  }
  bool isPresented(bool wanted = true) {
    return shows([&](const FlatView& v) { return frameIn(&v) && frameIn(&v)->how.has_value() == wanted; });
  }
  // Returns the pixel on screen once the picture is that of the workspace.
  QRgb seen(int column, int row) {
    FlatView* v = view();
    const auto isWhole = [&] { return v->picture().size() == v->pixels(); };
    if (!QTest::qWaitFor(isWhole, longest)) return 0;
    const glm::dvec2 at =
        v->plane()->pixelFromPatient(frameIn(v)->geometry().patientFromVoxel({column, row, 0}));
    return v->picture().pixel(int(at.x), int(at.y));
  }
  // Does `act` and waits for its picture.
  bool after(const std::function<void()>& act, ViewId id = axialViewId) {
    QSignalSpy shown(view(id), &FlatView::settled);
    act();
    return !shown.isEmpty() || shown.wait(longest);
  }
  bool looksAtPixels() {
    return after([&] {
      session().change(QStringLiteral("test"), [&](Workspace& w) {
        w.editView(axialViewId).flats.editOrAdd(view()->state().series).nearest = true;
      });
    });
  }
  // Opens the context menu by a right click.
  QMenu* menu(FlatView* on) {
    QTest::mouseClick(on, Qt::RightButton, {}, {200, 300});
    return QTest::qWaitFor([&] { return child<QMenu>("flatMenu") != nullptr; }, longest)
               ? child<QMenu>("flatMenu")
               : nullptr;
  }
  bool saysOnView(const char* text, ViewId id = axialViewId) {
    const Overlays o = view(id)->overlays();
    return (o.topRight + o.topLeft).join(QLatin1Char('\n')).contains(QString::fromUtf8(text));
  }
};

/// Returns null if there is no such action.
inline QAction* actionNamed(QMenu* menu, const char* text) {
  for (QAction* action : menu->actions())
    if (action->text().contains(QLatin1String(text))) return action;
  return nullptr;
}

#define NEED_REFERENCES() NEED_DATA(dataPath("dicom-2d"))

}  // namespace volumen::tests
